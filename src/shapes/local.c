/*
 * local.c - the local coordinates of a shape, in pairs
 */
#include "local.h"

#include <math.h>

#include "../numbers/bits.h"
#include "../numbers/double_double.h"
#include "../numbers/error_bounds.h"
#include "measure.h"
#include "shape_facts.h"

typedef struct {
    pair x[3], y[3], z[3];
} rows;

static pair plain(double x)
{
    return (pair){x, 0};
}

static void scale_row(pair row[3], pair factor)
{
    for (int i = 0; i < 3; i++)
        row[i] = pair_mul(row[i], factor);
}

/* 1 / sqrt(a): the double y nearest or next to it, and the next terms of
 * y (1 - e)^(-1/2), e = 1 - a y^2. */
static pair inverse_root(pair a)
{
    const double y = 1 / sqrt(a.hi);
    const pair ay2 = pair_mul(a, two_prod(y, y));
    const double e = (1 - ay2.hi) - ay2.lo;
    return fast_two_sum(y, y * e * (0.5 + 0.375 * e));
}

static pair dot(const pair u[3], const pair v[3])
{
    return pair_add(pair_add(pair_mul(u[0], v[0]), pair_mul(u[1], v[1])),
                    pair_mul(u[2], v[2]));
}

/* Unit vectors along the axis and across it: x is perpendicular to the
 * coordinate direction along which the axis is least.  Returns |axis|. */
static pair upright_rows(rows *m, const cylint_shape *s)
{
    pair w[3], square[3];
    for (int i = 0; i < 3; i++) {
        w[i] = (pair){s->axis[i], s->axis_lo[i]};
        square[i] = pair_mul(w[i], w[i]);
    }
    const int i = cylint_least_component(s->axis, s->axis_lo);
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const pair across2 = pair_add(square[j], square[k]);
    const pair length2 = pair_add(across2, square[i]);
    const pair to_unit = inverse_root(length2), level = inverse_root(across2);
    const pair across = pair_mul(across2, level);
    for (int c = 0; c < 3; c++)
        m->z[c] = pair_mul(w[c], to_unit);
    m->x[i] = plain(0);
    m->x[j] = pair_mul(w[k], level);
    m->x[k] = pair_neg(pair_mul(w[j], level));
    m->y[i] = pair_neg(pair_mul(across, to_unit));
    m->y[j] = pair_neg(pair_mul(m->z[i], m->x[k]));
    m->y[k] = pair_mul(m->z[i], m->x[j]);
    return pair_mul(length2, to_unit);
}

static void cross(pair xy[3], const double x[3], const double y[3])
{
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        xy[i] = pair_sub(two_prod(x[j], y[k]), two_prod(x[k], y[j]));
    }
}

/* The inverse of (a b h).  Returns the size of their determinant. */
static double inverse_rows(rows *m, const cylint_shape *s)
{
    cross(m->x, s->b, s->axis);
    cross(m->y, s->axis, s->a);
    cross(m->z, s->a, s->b);
    const pair a[3] = {plain(s->a[0]), plain(s->a[1]), plain(s->a[2])};
    const pair det = dot(a, m->x), inverse = pair_div(plain(1), det);
    scale_row(m->x, inverse);
    scale_row(m->y, inverse);
    scale_row(m->z, inverse);
    return fabs(det.hi);
}

/* The sum of the absolute values of a row. */
static double size_of(const pair row[3])
{
    return fabs(row[0].hi) + fabs(row[1].hi) + fabs(row[2].hi);
}

/* Multiplies the row of z by a power of two so that it is as large as the
 * others, within a factor of 2.  Returns the power. */
static double balance(rows *m)
{
    const double across = cylint_larger(size_of(m->x), size_of(m->y));
    const int e = cylint_exponent(across) - cylint_exponent(size_of(m->z));
    if (!(e > -200 && e < 200))
        return NAN;
    const double power = cylint_power_of_two(e);
    for (int i = 0; i < 3; i++)
        m->z[i] = (pair){m->z[i].hi * power, m->z[i].lo * power};
    return power;
}

/* The axis and the semi-axes are so long that no low part underflows. */
static int is_long_enough(const cylint_shape *s)
{
    if (s->kind == CYLINT_KIND_SPHERE)
        return 1;
    return cylint_largest(s->axis) >= CYLINT_LOCAL_LEAST &&
           (!cylint_is_elliptic(s->kind) ||
            (cylint_largest(s->a) >= CYLINT_LOCAL_LEAST &&
             cylint_largest(s->b) >= CYLINT_LOCAL_LEAST));
}

static void store(cylint_local *to, const rows *m)
{
    for (int i = 0; i < 3; i++) {
        to->xyz[i][0] = m->x[i].hi;
        to->xyz[i][1] = m->y[i].hi;
        to->xyz[i][2] = m->z[i].hi;
        to->xyz_lo[i][0] = m->x[i].lo;
        to->xyz_lo[i][1] = m->y[i].lo;
        to->xyz_lo[i][2] = m->z[i].lo;
    }
}

/* Writes x as a multiple of 2^-26 and the rest; |x| <= 1. */
static void split(pair x, double *hi, double *lo)
{
    *hi = (x.hi + CYLINT_UNIT_SNAP) - CYLINT_UNIT_SNAP;
    *lo = (x.hi - *hi) + x.lo;
}

static void store_split(cylint_local *to, const rows *m)
{
    for (int i = 0; i < 3; i++)
        split(m->z[i], &to->unit[i], &to->unit_lo[i]);
    split((pair){to->cosine, to->cosine_lo}, &to->turn[0], &to->turn_lo[0]);
    split((pair){to->sine, to->sine_lo}, &to->turn[1], &to->turn_lo[1]);
}

/* Writes cosine and sine, of a tapered shape with this growth of the radius
 * along the axis.  Returns the slope.  The cosine of a rounded cone has the error
 * of 1 - sine^2, which is larger relative to it. */
static pair measure_angle(cylint_local *to, const cylint_shape *s, pair slope)
{
    pair cosine = plain(1), sine = plain(0);
    if (s->kind == CYLINT_KIND_RCONE) {
        const pair rest = pair_sub(plain(1), pair_mul(slope, slope));
        sine = slope;
        if (rest.hi > 0) {
            cosine = pair_sqrt(rest);
            slope = pair_div(sine, cosine);
        }
        to->error /= rest.hi > 0 ? rest.hi : 0;
    } else if (cylint_is_tapered(s->kind)) {
        cosine = inverse_root(pair_add(plain(1), pair_mul(slope, slope)));
        sine = pair_mul(slope, cosine);
    }
    to->cosine = cosine.hi;
    to->cosine_lo = cosine.lo;
    to->sine = sine.hi;
    to->sine_lo = sine.lo;
    return slope;
}

static void identity_rows(rows *m)
{
    for (int i = 0; i < 3; i++) {
        m->x[i] = plain(i == 0);
        m->y[i] = plain(i == 1);
        m->z[i] = plain(i == 2);
    }
}

/* No form overflows (error_bounds.h). */
static int is_tame(const cylint_shape *s)
{
    const double norm = cylint_larger(s->local.norm, 1);
    return cylint_largest(s->base) <= CYLINT_FAR &&
           norm * norm * (1 + fabs(s->local.slope)) <= CYLINT_LOCAL_MOST;
}

/* A round shape whose local coordinates are not accurate has the height 0. */
static void check_round(cylint_shape *s)
{
    if (s->prepared && fabs(s->local.sine) <= CYLINT_LOCAL_STEEPEST)
        return;
    s->prepared = 0;
    s->local.height = 0;
}

void cylint_measure_local(cylint_shape *s)
{
    cylint_local *to = &s->local;
    rows m;
    pair height, slope;
    to->error = CYLINT_LOCAL_ERROR;
    if (s->kind == CYLINT_KIND_SPHERE) {
        identity_rows(&m);
        to->scale = to->square_scale = 1;
        height = slope = plain(0);
    } else if (cylint_is_elliptic(s->kind)) {
        const double det = inverse_rows(&m, s), power = balance(&m);
        const double cancelled = cylint_largest(s->a) * cylint_largest(s->b) *
                                 cylint_largest(s->axis) / det;
        to->error *= cylint_larger(1, cancelled);
        to->scale = det / power;
        to->square_scale = det * det;
        height = plain(power);
        slope = (pair){s->dr / power, s->dr_lo / power};
    } else {
        const pair length = upright_rows(&m, s);
        const double square = length.hi * length.hi;
        to->scale = cylint_has_tangent(s->kind) ? square : length.hi;
        to->square_scale =
            cylint_is_tapered(s->kind) && !cylint_is_round(s->kind)
                ? square * square
                : square;
        height = length;
        if (cylint_has_tangent(s->kind)) {
            const pair inverse = pair_div(plain(1), length);
            scale_row(m.x, inverse);
            scale_row(m.y, inverse);
            scale_row(m.z, inverse);
            height = plain(1);
        }
        slope = cylint_is_tapered(s->kind)
                    ? pair_div((pair){s->dr, s->dr_lo}, height)
                    : plain(0);
    }
    store(to, &m);
    if (!cylint_is_elliptic(s->kind)) {
        slope = measure_angle(to, s, slope);
        store_split(to, &m);
    }
    to->height = height.hi;
    to->height_lo = height.lo;
    to->slope = slope.hi;
    to->slope_lo = slope.lo;
    to->reach = (height.hi + cylint_larger(s->r0, s->r1)) * CYLINT_SLACK;
    to->snap = to->reach * CYLINT_LIMB_NEAR * CYLINT_LIMB_SNAP;
    to->norm =
        cylint_larger(cylint_larger(size_of(m.x), size_of(m.y)), size_of(m.z)) *
        CYLINT_SLACK;
    const int accurate = s->in_range && is_long_enough(s) && is_tame(s) &&
                         cylint_rounds_to_nearest() &&
                         (to->height > 0 || s->kind == CYLINT_KIND_SPHERE) &&
                         to->error <= CYLINT_LOCAL_WORST;
    s->prepared = accurate ? cylint_solid(s) : CYLINT_SOLID_NONE;
    if (cylint_is_round(s->kind))
        check_round(s);
}
