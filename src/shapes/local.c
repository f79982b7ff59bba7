/*
 * local.c - the local coordinates of a shape, in pairs
 *
 * Compiled once as it is and again for processors with a fused multiply-add.
 * Only exact products and their errors are fused: both write the same bits.
 */
#ifdef __GNUC__
#define CYLINT_NARROW /* two lanes */
#else
#define CYLINT_ONE_LANE
#endif
#include "local.h"

#include <math.h>

#include "../numbers/bits.h"
#include "../numbers/double_double.h" /* before simd.h */
#include "../numbers/error_bounds.h"
#include "../numbers/simd.h"
#include "measure.h"
#include "shape_facts.h"

#ifndef CYLINT_MEASURE_LOCAL
#define CYLINT_MEASURE_LOCAL cylint_measure_local
#endif

/* Four pairs: a vector and another number. */
enum { PARTS = 4 / LANES };
typedef struct {
    vpair part[PARTS];
} four;

typedef struct {
    four x, y, z;
} rows;

INLINE four load_four(const double hi[4], const double lo[4])
{
    four x;
    EACH(k, PARTS)
        x.part[k] = (vpair){v_load(hi + k * LANES), v_load(lo + k * LANES)};
    return x;
}

INLINE void store_four(double hi[4], double lo[4], const four *x)
{
    EACH(k, PARTS) {
        v_store(hi + k * LANES, x->part[k].hi);
        v_store(lo + k * LANES, x->part[k].lo);
    }
}

#if LANES == 2

INLINE vpair both_firsts(vpair x, vpair y)
{
    return (vpair){v_firsts(x.hi, y.hi), v_firsts(x.lo, y.lo)};
}

INLINE vpair swapped(vpair x)
{
    return (vpair){v_turned(x.hi), v_turned(x.lo)};
}

/* (x1, x2, x0, x3). */
INLINE four turned(const four *x)
{
    return (four){{both_firsts(swapped(x->part[0]), x->part[1]),
                   both_firsts(x->part[0], swapped(x->part[1]))}};
}

INLINE pair last_of(const four *x)
{
    const vpair last = swapped(x->part[1]);
    return (pair){v_first(last.hi), v_first(last.lo)};
}

INLINE void set_last(four *x, pair last)
{
    x->part[1] =
        both_firsts(x->part[1], (vpair){v_set(last.hi), v_set(last.lo)});
}

#else

INLINE four turned(const four *x)
{
    return (four){{x->part[1], x->part[2], x->part[0], x->part[3]}};
}

INLINE pair last_of(const four *x)
{
    return (pair){x->part[3].hi, x->part[3].lo};
}

INLINE void set_last(four *x, pair last)
{
    x->part[3] = (vpair){last.hi, last.lo};
}

#endif

INLINE four all_four(pair x)
{
    four all;
    EACH(k, PARTS)
        all.part[k] = (vpair){v_set(x.hi), v_set(x.lo)};
    return all;
}

INLINE four products(const four *x, const four *y)
{
    four xy;
    EACH(k, PARTS) {
        const vpair p = vpair_mul(x->part[k], y->part[k]);
        xy.part[k] = v_fast_two_sum(p.hi, p.lo);
    }
    return xy;
}

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

/* x0 + x1 + x2 of numbers that are not negative, not normalised. */
INLINE pair sum_of_three(const four *x)
{
    double hi[4], lo[4];
    store_four(hi, lo, x);
    const pair two = two_sum(hi[0], hi[1]), all = two_sum(two.hi, hi[2]);
    return (pair){all.hi, all.lo + (two.lo + (lo[0] + (lo[1] + lo[2])))};
}

/* 1 / sqrt(a) of each: a double y, and the next terms of y (1 - e)^(-1/2),
 * e = 1 - a y^2. */
INLINE vpair inverse_roots(vpair a)
{
    const vd y = v_set(1) / v_sqrt(a.hi);
    const vpair yy = v_two_prod(y, y), ayy = v_two_prod(a.hi, yy.hi);
    const vd e = ((v_set(1) - ayy.hi) - ayy.lo) - (a.hi * yy.lo + a.lo * yy.hi);
    return (vpair){y, y * (e * (v_set(0.5) + v_set(0.375) * e))};
}

INLINE void inverse_root_of_two(pair root[2], pair a, pair b)
{
    const double hi[2] = {a.hi, b.hi}, lo[2] = {a.lo, b.lo};
    double root_hi[2], root_lo[2];
    for (int k = 0; k < 2; k += LANES) {
        const vpair r = inverse_roots((vpair){v_load(hi + k), v_load(lo + k)});
        v_store(root_hi + k, r.hi);
        v_store(root_lo + k, r.lo);
    }
    for (int k = 0; k < 2; k++)
        root[k] = (pair){root_hi[k], root_lo[k]};
}

static pair inverse_root(pair a)
{
    pair root[2];
    inverse_root_of_two(root, a, a);
    return root[0];
}

/* The axis, and the growth of the radius along it.  A low part that underflows is
 * nothing beside an axis that is long enough. */
INLINE four axis_and_growth(const cylint_shape *s)
{
    static const double none[4] = {0, 0, 0, 0};
    const int two_points = cylint_has_end_points(s->kind);
    const double *top = two_points ? cylint_top(s) : cylint_axis(s);
    const double *from = two_points ? cylint_base(s) : none; /* r0 follows */
    const double to[4] = {top[0], top[1], top[2], cylint_r1(s)};
    four w;
    EACH(k, PARTS)
        w.part[k] =
            v_two_sum(v_load(to + k * LANES), -v_load(from + k * LANES));
    return w;
}

/* The coordinate direction along which the axis is least, from which phi is
 * counted. */
INLINE four least_direction(const four *axis)
{
    static const double none[4] = {0, 0, 0, 0};
    double hi[4], lo[4], e[4] = {0, 0, 0, 0};
    store_four(hi, lo, axis);
    e[cylint_least_component(hi, lo)] = 1;
    return load_four(e, none);
}

/*
 * Unit vectors along the axis and across it: x is perpendicular to the
 * coordinate direction e along which the axis w is least.
 *
 *   h = 1 / |w|, l = 1 / |w x e|;  z = h w, x = l (w x e), y = z x x
 *
 * Beside z stands the slope, beside x the height |w|.  Returns h.
 *
 * Errors, in units of u^2, u = 2^-53, each relative to its number: squares 6;
 * |w x e|^2 13, |w|^2 22; e of l 41, of h 54; l 37, h 45; x 57, z, slope and
 * height 80; y 150, of which CYLINT_LOCAL_ERROR allows 1024.
 */
INLINE pair upright_rows(rows *m, const cylint_shape *s)
{
    const four w = axis_and_growth(s), e = least_direction(&w);
    const four w1 = turned(&w), w2 = turned(&w1);
    const four e1 = turned(&e), e2 = turned(&e1);
    four square, aside, x;
    EACH(k, PARTS) {
        const vd other = v_set(1) - e.part[k].hi;
        const vd to1 = e1.part[k].hi, to2 = e2.part[k].hi;
        const vpair p = vpair_mul(w.part[k], w.part[k]);
        square.part[k] = p;
        aside.part[k] = (vpair){p.hi * other, p.lo * other};
        x.part[k] = (vpair){w1.part[k].hi * to2 - w2.part[k].hi * to1,
                            w1.part[k].lo * to2 - w2.part[k].lo * to1};
    }
    const pair length2 = sum_of_three(&square);
    pair root[2];
    inverse_root_of_two(root, length2, sum_of_three(&aside));
    const four to_unit = all_four(root[0]);
    four level = all_four(root[1]);
    set_last(&x, length2);
    set_last(&level, root[0]);
    m->z = products(&w, &to_unit);
    m->x = products(&x, &level);
    m->y = cross(&m->z, &m->x);
    return root[0];
}

INLINE four vector(const double x[3])
{
    static const double none[4] = {0, 0, 0, 0};
    const double hi[4] = {x[0], x[1], x[2], 0};
    return load_four(hi, none);
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

/* A vector is so long that no low part underflows, and no product of its
 * components with those of others does: a zero of the matrix is a zero. */
static int is_long_enough(const double x[3])
{
    return cylint_largest(x) >= CYLINT_LOCAL_LEAST &&
           !cylint_is_small(x[0], CYLINT_LOCAL_TINY) &&
           !cylint_is_small(x[1], CYLINT_LOCAL_TINY) &&
           !cylint_is_small(x[2], CYLINT_LOCAL_TINY);
}

static int vectors_are_long_enough(const cylint_shape *s)
{
    if (s->kind == CYLINT_KIND_SPHERE)
        return 1;
    return is_long_enough(cylint_axis(s)) &&
           (!cylint_is_elliptic(s->kind) ||
            (is_long_enough(cylint_a(s)) && is_long_enough(cylint_b(s))));
}

INLINE void store_row(cylint_shape *s, int k, const four *row)
{
    double *to = s->library.number + CYLINT_AT_COLUMNS + k;
    double hi[4], lo[4];
    store_four(hi, lo, row);
    for (int i = 0; i < 3; i++) {
        to[3 * i] = hi[i];
        to[3 * i + CYLINT_LOW] = lo[i];
    }
}

INLINE void store_pair(cylint_shape *s, int at, pair x)
{
    s->library.number[at] = x.hi;
    s->library.number[at + CYLINT_LOW] = x.lo;
}

/* Writes cosine and sine, of a shape with this growth of the radius along the
 * axis.  Returns the slope.  The cosine of a rounded cone has the error of
 * 1 - sine^2, which is larger relative to it: *error grows. */
static pair measure_angle(cylint_shape *s, pair slope, double *error)
{
    const pair one = {1, 0};
    pair cosine = one, sine = {0, 0};
    if (s->kind == CYLINT_KIND_RCONE) {
        const pair rest = pair_sub(one, pair_mul(slope, slope));
        sine = slope;
        if (rest.hi > 0) {
            const pair inverse = inverse_root(rest);
            cosine = pair_mul(rest, inverse);
            slope = pair_mul(sine, inverse);
        }
        *error /= rest.hi > 0 ? rest.hi : 0;
    } else if (cylint_is_tapered(s->kind) && !cylint_is_elliptic(s->kind)) {
        const pair root = inverse_root(pair_add(one, pair_mul(slope, slope)));
        cosine = fast_two_sum(root.hi, root.lo);
        sine = pair_mul(slope, root);
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
           norm * norm * (1 + fabs(cylint_slope(s))) <= CYLINT_LOCAL_MOST;
}

void CYLINT_MEASURE_LOCAL(cylint_shape *s)
{
    rows m;
    pair height = {0, 0}, slope = {0, 0};
    double error = CYLINT_LOCAL_ERROR, *x = s->library.number;
    if (s->kind == CYLINT_KIND_SPHERE) {
        static const double one[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        m = (rows){vector(one[0]), vector(one[1]), vector(one[2])};
    } else if (cylint_is_elliptic(s->kind)) {
        const double det = inverse_rows(&m, s), power = balance(&m);
        const double cancelled = cylint_largest(cylint_a(s)) *
                                 cylint_largest(cylint_b(s)) *
                                 cylint_axis_size(s) / fabs(det);
        const pair growth = cylint_radius_growth(s);
        error *= cylint_larger(1, cancelled);
        s->library.flag[CYLINT_AT_LEFT_HANDED] = det < 0;
        height = (pair){power, 0};
        slope = (pair){growth.hi / power, growth.lo / power};
    } else {
        const pair inverse = upright_rows(&m, s);
        height = last_of(&m.x);
        slope = last_of(&m.z);
        if (cylint_has_tangent(s->kind)) {
            scale(&m, inverse);
            height = (pair){1, 0};
            slope = (pair){cylint_r1(s), 0};
        }
    }
    store_row(s, 0, &m.x);
    store_row(s, 1, &m.y);
    store_row(s, 2, &m.z);
    store_pair(s, CYLINT_AT_HEIGHT, height);
    store_pair(s, CYLINT_AT_SLOPE, measure_angle(s, slope, &error));
    x[CYLINT_AT_NORM] =
        cylint_larger(cylint_larger(size_of(&m.x), size_of(&m.y)),
                      size_of(&m.z)) *
        CYLINT_SLACK;
    x[CYLINT_AT_REACH] =
        (height.hi + cylint_larger(cylint_r0(s), cylint_r1(s))) * CYLINT_SLACK;
    x[CYLINT_AT_ERROR] = error;
    const int round = cylint_is_round(s->kind);
    const int accurate =
        cylint_in_range(s) && vectors_are_long_enough(s) && is_in_bounds(s) &&
        cylint_rounds_to_nearest() &&
        (height.hi > 0 || s->kind == CYLINT_KIND_SPHERE) &&
        error <= CYLINT_LOCAL_WORST &&
        (!round || fabs(cylint_sine(s)) <= CYLINT_LOCAL_STEEPEST);
    s->library.flag[CYLINT_AT_PREPARED] =
        accurate ? cylint_solid(s) : CYLINT_SOLID_NONE;
    if (round && !accurate)
        x[CYLINT_AT_HEIGHT] = 0;
}
