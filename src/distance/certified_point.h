/*
 * certified_point.h - the nearest point and the normal in pairs of doubles
 *
 * With the axis a, the direction u from the axis to the point x and the normal
 * n = cosine u - sine a of the lateral surface:
 *
 *   lateral    x - distance n            rim        center + r u
 *   cap        x - (height) a            tangency   center + r n
 *   ball       center + r D / |D|        apex       center
 *
 * A component is accepted if every number within the bound on its error rounds
 * to the same double.
 */
#ifndef CYLINT_CERTIFIED_POINT_H
#define CYLINT_CERTIFIED_POINT_H

#include "../shapes/measure.h"
#include "half_plane.h"
#include "nearest.h"

#if LANES == 2

/*
 * Numbers with bounds on their errors.  The error of a number that is not exact
 * is at least CYLINT_POINT_UNDERFLOW, which covers what underflows, flushed to
 * zero or not.  An exact zero stays one.
 */
typedef struct {
    pair v;
    double error;
} certified;

static certified datum(double x)
{
    return (certified){{x, 0}, 0};
}

/* x - y of two data. */
static certified difference(double x, double y)
{
    const pair d = two_diff(x, y);
    const int equal = cylint_rank(x) == cylint_rank(y);
    return (certified){d, equal ? 0 : CYLINT_POINT_UNDERFLOW};
}

static int is_zero(certified x)
{
    return x.error == 0 && cylint_sign(x.v.hi) == 0;
}

INLINE certified with_error(pair v, double error, double size)
{
    return (certified){normalized(v), error + CYLINT_POINT_ROUNDING * size +
                                          CYLINT_POINT_UNDERFLOW};
}

static certified c_neg(certified x)
{
    return (certified){pair_neg(x.v), x.error};
}

INLINE certified c_sub(certified x, certified y)
{
    if (is_zero(y))
        return x;
    if (is_zero(x))
        return c_neg(y);
    return with_error(lazy_sub(x.v, y.v), x.error + y.error,
                      size_of(x.v) + size_of(y.v));
}

INLINE certified c_add(certified x, certified y)
{
    return c_sub(x, c_neg(y));
}

INLINE certified c_mul(certified x, certified y)
{
    const double a = size_of(x.v), b = size_of(y.v);
    if (is_zero(x) || is_zero(y))
        return datum(0);
    return with_error(lazy_mul(x.v, y.v), a * y.error + (b + y.error) * x.error,
                      a * b);
}

/* x / y; the error of y is far below y. */
static certified c_div(certified x, certified y)
{
    if (is_zero(x))
        return x;
    const pair v = pair_div(x.v, normalized(y.v));
    const double size = size_of(v);
    return with_error(v, (x.error + size * y.error) * 1.25 / size_of(y.v),
                      size);
}

/* Writes the component; whether it is certain. */
INLINE int c_write(certified x, double *to)
{
    *to = cylint_positive_zero(x.v.hi);
    return (x.error == 0 && cylint_sign(x.v.lo) == 0) ||
           is_certain(x.v, x.error);
}

/* The axis's direction and the direction from the axis to the point. */
typedef struct {
    certified a[3], u[3], D[3];
    int aligned; /* the coordinate along which the axis runs, or -1 */
} frame;

static int aligned_coordinate(const cylint_shape *s)
{
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        if (!cylint_sign(cylint_axis(s)[j]) && !cylint_sign(cylint_axis(s)[k]))
            return i;
    }
    return -1;
}

static void load_frame(frame *f, const cylint_shape *s, const double point[3],
                       const half_plane *m)
{
    const certified z = {normalized(m->z), m->error}, rho = {m->rho, m->error};
    const certified inverse = c_div(datum(1), rho);
    f->aligned = aligned_coordinate(s);
    for (int i = 0; i < 3; i++) {
        const pair a = {cylint_column(s, i)[2], cylint_column_lo(s, i)[2]};
        f->a[i] = cylint_sign(cylint_axis(s)[i]) ? with_error(a, 0, fabs(a.hi))
                                                 : datum(0);
        f->D[i] = difference(point[i], cylint_base(s)[i]);
        if (i == f->aligned) {
            f->u[i] = datum(0);
            continue;
        }
        const certified across =
            f->aligned >= 0 ? f->D[i] : c_sub(f->D[i], c_mul(z, f->a[i]));
        f->u[i] = c_mul(across, inverse);
    }
}

static certified lateral_normal(const frame *f, const cylint_shape *s, int i)
{
    const certified C = with_error(cylint_number_pair(s, CYLINT_AT_COSINE), 0,
                                   cylint_cosine(s));
    const certified S = with_error(cylint_number_pair(s, CYLINT_AT_SINE), 0,
                                   fabs(cylint_sine(s)));
    return cylint_is_tapered(s->kind)
               ? c_sub(c_mul(C, f->u[i]), c_mul(S, f->a[i]))
               : f->u[i];
}

/* A multiple of the axis's direction. */
static certified along_axis(const frame *f, int i, int sign)
{
    const certified a = f->a[i];
    return sign < 0 ? c_neg(a) : a;
}

/* Of a feature that is not on a ball.  d: the distance. */
static certified point_on(const frame *f, const cylint_shape *s,
                          const double point[3], int feature, certified d,
                          certified normal_i, int i)
{
    const int end = cylint_feature_end(feature);
    const double *center = end ? cylint_top(s) : cylint_base(s);
    if (feature == CYLINT_FEATURE_LATERAL)
        return c_sub(datum(point[i]), c_mul(d, normal_i));
    if (feature < CYLINT_FEATURE_RIM0) {
        if (f->aligned >= 0)
            return datum(i == f->aligned ? center[i] : point[i]);
        return c_sub(datum(point[i]), c_mul(d, normal_i));
    }
    return c_add(datum(center[i]),
                 c_mul(datum(cylint_end_factor(s, end)),
                       cylint_is_round(s->kind) ? normal_i : f->u[i]));
}

/* Lateral surface, cap, rim or apex. */
ASIDE int describe(const cylint_shape *s, const double point[3],
                   const half_plane *m, int feature, pair d, unsigned want,
                   cylint_closest *answer)
{
    const int end = cylint_feature_end(feature);
    const int cap =
        (feature == CYLINT_FEATURE_CAP0) | (feature == CYLINT_FEATURE_CAP1);
    const int apex = cylint_feature_is_apex(s, feature);
    int certain = is_off_axis(m);
    frame f;
    load_frame(&f, s, point, m);
    for (int i = 0; i < 3; i++) {
        const certified n =
            apex  ? along_axis(&f, i, cylint_apex_normal_sign(s, 0))
            : cap ? along_axis(&f, i, end ? 1 : -1)
                  : lateral_normal(&f, s, i);
        if (want & CYLINT_WANT_NORMAL)
            certain &= c_write(n, &answer->normal[i]);
        if (want & CYLINT_WANT_POINT)
            certain &= c_write(
                point_on(&f, s, point, feature, (certified){d, m->error}, n, i),
                &answer->point[i]);
    }
    return certain;
}

/* The ball about an end. */
ASIDE int describe_ball(const double point[3], const double center[3], double r,
                        unsigned want, cylint_closest *answer)
{
    certified D[3], square = datum(0);
    double half;
    int certain = 1;
    for (int i = 0; i < 3; i++) {
        D[i] = difference(point[i], center[i]);
        square = c_add(square, c_mul(D[i], D[i]));
    }
    const pair root = root_of(square.v, &half);
    const certified size = {root, CYLINT_POINT_ROUNDING * 8 * root.hi};
    const certified inverse = c_div(datum(1), size);
    for (int i = 0; i < 3; i++) {
        const certified n = c_mul(D[i], inverse);
        if (want & CYLINT_WANT_NORMAL)
            certain &= c_write(n, &answer->normal[i]);
        if (want & CYLINT_WANT_POINT)
            certain &= c_write(c_add(datum(center[i]), c_mul(datum(r), n)),
                               &answer->point[i]);
    }
    return certain;
}

#endif
#endif
