/*
 * local.c - the local coordinates of a shape, in pairs
 *
 * Compiled once as it is and again for processors with a fused multiply-add.
 * Only exact products and their errors are fused: both write the same bits, but for
 * errors that underflow, of a slope or sine below 2^-900 that is not 0.
 */
#define CYLINT_NARROW
#include "local.h"

#include <math.h>

#include "../numbers/bits.h"
#include "../numbers/error_bounds.h"
#include "../numbers/simd.h"
#include "measure.h"
#include "shape_facts.h"
#include "upright_template.h"

#ifndef CYLINT_MEASURE_LOCAL
#define CYLINT_MEASURE_LOCAL cylint_measure_local_plain
#endif

/* x cross y. */
INLINE four cross(const four *x, const four *y)
{
    const four x1 = turned(x), x2 = turned(&x1);
    const four y1 = turned(y), y2 = turned(&y1);
    four xy;
    EACH(k, PARTS) {
        const vpair d = vpair_sub(vpair_mul(x1.part[k], y2.part[k]),
                                  vpair_mul(x2.part[k], y1.part[k]));
        xy.part[k] = v_fast_two_sum(d.hi, d.lo);
    }
    return xy;
}

/* The axis, and the growth of the radius along it.  A low part that underflows is
 * nothing beside an axis that is long enough. */
INLINE four axis_and_growth(const cylint_shape *s)
{
    const int two_points = cylint_has_end_points(s->kind);
    const double *top = two_points ? cylint_top(s) : cylint_axis(s);
    const double *base = cylint_base(s);
    const double both = two_points ? 1 : 0;
    const four to = four_of(top[0], top[1], top[2], cylint_r1(s));
    const four from = four_of(both * base[0], both * base[1], both * base[2],
                              both * cylint_r0(s));
    four w;
    EACH(k, PARTS)
        w.part[k] = v_two_sum(to.part[k].hi, -from.part[k].hi);
    return w;
}

INLINE four vector(const double x[3])
{
    return four_of(x[0], x[1], x[2], 0);
}

static void scale(rows *m, pair factor)
{
    const four all = all_four(factor);
    m->x = products(&m->x, &all);
    m->y = products(&m->y, &all);
    m->z = products(&m->z, &all);
}

/* The inverse of (a b h).  Returns their determinant. */
static double inverse_rows(rows *m, const cylint_shape *s)
{
    const four a = vector(cylint_a(s)), b = vector(cylint_b(s)),
               h = vector(cylint_axis(s));
    double hi[4], lo[4];
    m->x = cross(&b, &h);
    m->y = cross(&h, &a);
    m->z = cross(&a, &b);
    const four ax = products(&a, &m->x);
    store_four(hi, lo, &ax);
    const pair two = pair_add((pair){hi[0], lo[0]}, (pair){hi[1], lo[1]});
    const pair det = pair_add(two, (pair){hi[2], lo[2]});
    scale(m, pair_div((pair){1, 0}, det));
    return det.hi;
}

/* The sum of the absolute values of a row. */
INLINE double size_of(const four *row)
{
    double hi[4], lo[4];
    store_four(hi, lo, row);
    return fabs(hi[0]) + fabs(hi[1]) + fabs(hi[2]);
}

/* Multiplies the row of z by a power of two so that it is as large as the
 * others, within a factor of 2.  Returns the power. */
static double balance(rows *m)
{
    const double across = cylint_larger(size_of(&m->x), size_of(&m->y));
    const int e = cylint_exponent(across) - cylint_exponent(size_of(&m->z));
    if (!(e > -200 && e < 200))
        return NAN;
    const double power = cylint_power_of_two(e);
    EACH(k, PARTS)
        m->z.part[k] = (vpair){m->z.part[k].hi * v_set(power),
                               m->z.part[k].lo * v_set(power)};
    return power;
}

static int vectors_are_long_enough(const cylint_shape *s)
{
    if (s->kind == CYLINT_KIND_SPHERE)
        return 1;
    return cylint_is_long_enough(cylint_axis(s)) &&
           (!cylint_is_elliptic(s->kind) ||
            (cylint_is_long_enough(cylint_a(s)) &&
             cylint_is_long_enough(cylint_b(s))));
}

/* Stores the columns of the matrix in whole vectors, which kernels load soon: the
 * number after a column is stored later. */
INLINE void store_rows(cylint_shape *s, const rows *m)
{
    double *to = s->library.number + CYLINT_AT_COLUMNS;
    const four *const row[3] = {&m->x, &m->y, &m->z};
    EACH(k, 3) {
        double hi[4], lo[4];
        store_four(hi, lo, row[k]);
        EACH(i, 3) {
            to[3 * i + k] = hi[i];
            to[3 * i + k + CYLINT_LOW] = lo[i];
        }
    }
}

INLINE void store_pair(cylint_shape *s, int at, pair x)
{
    s->library.number[at] = x.hi;
    s->library.number[at + CYLINT_LOW] = x.lo;
}

/* Writes cosine and sine of the lateral surface, and returns its slope.  slope: dr
 * / |w|, which is the sine of a round cone.  A round cone's cosine has the error of
 * 1 - sine^2, which is larger relative to it: *error grows. */
static pair measure_angle(cylint_shape *s, const inverse_lengths *inverse,
                          pair slope, pair height, double *error)
{
    const pair one = {1, 0};
    pair cosine = one, sine = {0, 0};
    if (cylint_is_tapered(s->kind) && !cylint_is_elliptic(s->kind)) {
        const pair dr = cylint_radius_growth(s);
        if (s->kind == CYLINT_KIND_RCONE) {
            sine = slope;
            cosine = cosine_of_hull(inverse);
            slope = pair_mul(dr, inverse->lateral);
            *error /= cosine.hi * cosine.hi;
        } else { /* the height of an acone is 1 */
            cosine = pair_mul(height, inverse->lateral);
            sine = pair_mul(dr, inverse->lateral);
        }
    }
    store_pair(s, CYLINT_AT_COSINE, cosine);
    store_pair(s, CYLINT_AT_SINE, sine);
    return slope;
}

/* No form overflows (error_bounds.h). */
static int is_in_bounds(const cylint_shape *s)
{
    const double norm = cylint_larger(cylint_norm(s), 1);
    return cylint_largest(cylint_base(s)) <= CYLINT_FAR &&
           norm * norm * (1 + fabs(cylint_slope(s))) <= CYLINT_LOCAL_MOST &&
           (!cylint_is_tapered(s->kind) ||
            fabs(cylint_slope(s)) >= CYLINT_LOCAL_LEAST_SLOPE);
}

void CYLINT_MEASURE_LOCAL(cylint_shape *s)
{
    rows m;
    pair height = {0, 0}, slope = {0, 0};
    inverse_lengths inverse = {{0, 0}, {0, 0}, {0, 0}};
    double error = CYLINT_LOCAL_ERROR, *x = s->library.number;
    double norm = CYLINT_LOCAL_NORM;
    if (s->kind == CYLINT_KIND_SPHERE) {
        static const double one[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        m = (rows){vector(one[0]), vector(one[1]), vector(one[2])};
        norm = 1;
    } else if (cylint_is_elliptic(s->kind)) {
        const double det = inverse_rows(&m, s), power = balance(&m);
        const double cancelled = cylint_largest(cylint_a(s)) *
                                 cylint_largest(cylint_b(s)) *
                                 cylint_axis_size(s) / fabs(det);
        const pair growth = cylint_radius_growth(s);
        error *= cylint_larger(1, cancelled);
        norm = cylint_larger(cylint_larger(size_of(&m.x), size_of(&m.y)),
                             size_of(&m.z));
        s->library.flag[CYLINT_AT_LEFT_HANDED] = det < 0;
        height = (pair){power, 0};
        slope = (pair){growth.hi / power, growth.lo / power};
    } else {
        const four axis = axis_and_growth(s);
        inverse = upright_rows(&m, &axis, s->kind == CYLINT_KIND_RCONE ? -1 : 1,
                               cylint_has_tangent(s->kind), s);
        height = last_of(&m.x);
        slope = last_of(&m.z);
        if (cylint_has_tangent(s->kind)) {
            scale(&m, inverse.axis);
            norm *= inverse.axis.hi;
            height = (pair){1, 0};
            slope = (pair){cylint_r1(s), 0};
        }
    }
    store_rows(s, &m);
    store_pair(s, CYLINT_AT_HEIGHT, height);
    store_pair(s, CYLINT_AT_SLOPE,
               measure_angle(s, &inverse, slope, height, &error));
    x[CYLINT_AT_NORM] = norm * CYLINT_SLACK;
    x[CYLINT_AT_REACH] =
        (height.hi + cylint_larger(cylint_r0(s), cylint_r1(s))) * CYLINT_SLACK;
    x[CYLINT_AT_ERROR] = error;
    x[CYLINT_AT_UNIT] = s->kind == CYLINT_KIND_RCONE
                            ? CYLINT_LOCAL_ROUND * CYLINT_ROUNDING
                            : CYLINT_ROUNDING;
    const int accurate =
        cylint_in_range(s) && vectors_are_long_enough(s) && is_in_bounds(s) &&
        cylint_rounds_to_nearest() &&
        /* untaken 1 of 4: vectors that are long enough have a height */
        (height.hi > 0 || s->kind == CYLINT_KIND_SPHERE) &&
        error <= CYLINT_LOCAL_WORST &&
        (!cylint_is_round(s->kind) ||
         fabs(cylint_sine(s)) <= CYLINT_LOCAL_STEEPEST);
    s->library.flag[CYLINT_AT_PREPARED] =
        accurate ? cylint_solid(s->kind, s->ends) : CYLINT_SOLID_NONE;
}
