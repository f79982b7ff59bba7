/*
 * local.c - the local coordinates of a shape, in pairs
 *
 * Compiled once as it is and again for processors with a fused multiply-add.
 * Only exact products and their errors are fused: both write the same bits.
 */
#if !defined(__GNUC__)
#define CYLINT_ONE_LANE
#elif !defined(__AVX2__)
#define CYLINT_NARROW /* two lanes; else four */
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

/* From registers: a load of two lanes waits for numbers just stored one by
 * one. */
INLINE four four_of(double x, double y, double z, double w)
{
    return (four){{{v_two(x, y), v_set(0)}, {v_two(z, w), v_set(0)}}};
}

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

#elif LANES == 4

INLINE four four_of(double x, double y, double z, double w)
{
    return (four){{{v_four(x, y, z, w), v_set(0)}}};
}

/* (x1, x2, x0, x3). */
INLINE four turned(const four *x)
{
    return (four){
        {{v_turned_three(x->part[0].hi), v_turned_three(x->part[0].lo)}}};
}

INLINE pair last_of(const four *x)
{
    return (pair){v_last(x->part[0].hi), v_last(x->part[0].lo)};
}

INLINE void set_last(four *x, pair last)
{
    x->part[0] = (vpair){v_with_last(x->part[0].hi, last.hi),
                         v_with_last(x->part[0].lo, last.lo)};
}

#else

INLINE four four_of(double x, double y, double z, double w)
{
    return (four){{{x, 0}, {y, 0}, {z, 0}, {w, 0}}};
}

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

/* Not normalised. */
INLINE pair unnormalised_sum(pair x, pair y)
{
    const pair sum = two_sum(x.hi, y.hi);
    return (pair){sum.hi, sum.lo + (x.lo + y.lo)};
}

/* 1 / sqrt(a) of each: y is that of about a, and what follows are the next terms
 * of y (1 - e)^(-1/2), e = 1 - a y^2. */
INLINE vpair refined_inverse_roots(vpair a, vd y)
{
    const vpair yy = v_two_prod(y, y), ayy = v_two_prod(a.hi, yy.hi);
    const vd e = ((v_set(1) - ayy.hi) - ayy.lo) - (a.hi * yy.lo + a.lo * yy.hi);
    return (vpair){y, y * (e * (v_set(0.5) + v_set(0.375) * e))};
}

/* 1 / sqrt(a) of three numbers, from other numbers that are about as large: so the
 * roots begin early. */
INLINE void inverse_roots(pair root[3], const pair a[3], const double near[3])
{
    double hi[4], lo[4];
    const four v = four_of(near[0], near[1], near[2], 1),
               high = four_of(a[0].hi, a[1].hi, a[2].hi, 1),
               low = four_of(a[0].lo, a[1].lo, a[2].lo, 0);
    four r;
    EACH(k, PARTS)
        r.part[k] =
            refined_inverse_roots((vpair){high.part[k].hi, low.part[k].hi},
                                  v_set(1) / v_sqrt(v.part[k].hi));
    store_four(hi, lo, &r);
    EACH(k, 3)
        root[k] = (pair){hi[k], lo[k]};
}

/* The axis, and the growth of the radius along it.  A low part that underflows is
 * nothing beside an axis that is long enough. */
INLINE four axis_and_growth(const cylint_shape *s)
{
    const int two_points = cylint_has_end_points(s->kind);
    const double *top = two_points ? cylint_top(s) : cylint_axis(s);
    const double *base = cylint_base(s);
    const double one = two_points ? 1 : 0;
    const four to = four_of(top[0], top[1], top[2], cylint_r1(s));
    const four from = four_of(one * base[0], one * base[1], one * base[2],
                              one * cylint_r0(s));
    four w;
    EACH(k, PARTS)
        w.part[k] = v_two_sum(to.part[k].hi, -from.part[k].hi);
    return w;
}

/* The coordinate along which the axis is least, from which phi is counted.
 * Which one is unpredictable, so there is no branch but for equal ones. */
INLINE int least_of_axis(const double hi[4], const double lo[4])
{
    const double x = fabs(hi[0]), y = fabs(hi[1]), z = fabs(hi[2]);
    const double xy = cylint_smaller(x, y);
    const int least = y < x, last = z < xy;
    return x == y || z == xy ? cylint_least_component(hi, lo)
                             : least + last * (2 - least);
}

/* x in lanes of `e`, which is 1 there and else 0; y in the others. */
INLINE vpair chosen(vd e, vpair x, vpair y)
{
    const vd other = v_set(1) - e;
    return (vpair){e * x.hi + other * y.hi, e * x.lo + other * y.lo};
}

/* 1 / |w|; lateral2 and 1 / sqrt(lateral2), which is |w|^2 + dr^2 for a cone, |w|^2 -
 * dr^2 for a rounded cone, 1 + dr^2 for an acone, whose dr is its tangent. */
typedef struct {
    pair axis, lateral, lateral2;
} inverse_lengths;

/*
 * Unit vectors along the axis and across it: x is perpendicular to the
 * coordinate direction e along which the axis w is least.
 *
 *   h = 1 / |w|, l = 1 / |w x e|;  z = h w, x = l (w x e),
 *   y = z x x = h l (w (w.e) - e w.w)
 *
 * The component of the last vector along e is -|w x e|^2.  Beside z stands the
 * slope, beside x the height |w|.
 *
 * Errors, in units of u^2, u = 2^-53, each relative to its number: squares 6;
 * |w x e|^2 13, |w|^2 22; e of l 51, of h 64; l 47, h 55; x 67, z, slope and
 * height 90; y 140, of which CYLINT_LOCAL_ERROR allows 1024.
 */
INLINE inverse_lengths upright_rows(rows *m, const cylint_shape *s)
{
    static const double direction[3][4] = {
        {1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
    const four w = axis_and_growth(s);
    const four w1 = turned(&w), w2 = turned(&w1);
    double hi[4], lo[4], near[3], square_hi[4], square_lo[4];
    store_four(hi, lo, &w);
    const int least = least_of_axis(hi, lo);
    const double sign = s->kind == CYLINT_KIND_RCONE ? -1 : 1;
    const int tangent = cylint_has_tangent(s->kind);
    const double *e = direction[least];
    near[0] = hi[0] * hi[0] + hi[1] * hi[1] + hi[2] * hi[2];
    near[1] = near[0] - hi[least] * hi[least];
    near[2] = (tangent ? 1 : near[0]) + sign * (hi[3] * hi[3]);
    const vpair along = {v_set(hi[least]), v_set(lo[least])};
    const four e4 = four_of(e[0], e[1], e[2], 0);
    const four e1 = turned(&e4), e2 = turned(&e1);
    four square, x, y;
    EACH(k, PARTS) {
        const vd to1 = e1.part[k].hi, to2 = e2.part[k].hi;
        square.part[k] = vpair_mul(w.part[k], w.part[k]);
        x.part[k] = (vpair){w1.part[k].hi * to2 - w2.part[k].hi * to1,
                            w1.part[k].lo * to2 - w2.part[k].lo * to1};
        y.part[k] = vpair_mul(w.part[k], along);
    }
    store_four(square_hi, square_lo, &square);
    const int j = least == 0, k = 2 - (least == 2);
    const pair aside = unnormalised_sum((pair){square_hi[j], square_lo[j]},
                                        (pair){square_hi[k], square_lo[k]});
    const pair length2 =
        unnormalised_sum(aside, (pair){square_hi[least], square_lo[least]});
    const pair lateral2 =
        unnormalised_sum(tangent ? (pair){1, 0} : length2,
                         (pair){sign * square_hi[3], sign * square_lo[3]});
    const pair of[3] = {length2, aside, lateral2};
    pair root[3];
    inverse_roots(root, of, near);
    EACH(k, PARTS)
        y.part[k] =
            chosen(e4.part[k].hi, (vpair){v_set(-aside.hi), v_set(-aside.lo)},
                   y.part[k]);
    const four to_unit = all_four(root[0]);
    const four to_y = all_four(pair_mul(root[0], root[1]));
    four level = all_four(root[1]);
    set_last(&x, length2);
    set_last(&level, root[0]);
    m->z = products(&w, &to_unit);
    m->x = products(&x, &level);
    m->y = products(&y, &to_y);
    return (inverse_lengths){root[0], root[2], lateral2};
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
#if LANES == 4
    const v_row hi[4] = {m->x.part[0].hi, m->y.part[0].hi, m->z.part[0].hi,
                         m->z.part[0].hi};
    const v_row lo[4] = {m->x.part[0].lo, m->y.part[0].lo, m->z.part[0].lo,
                         m->z.part[0].lo};
    vd column[4];
    v_transpose(hi, column);
    EACH(i, 3)
        v_store(to + 3 * i, column[i]);
    v_transpose(lo, column);
    EACH(i, 3)
        v_store(to + 3 * i + CYLINT_LOW, column[i]);
#else
    const four *const row[3] = {&m->x, &m->y, &m->z};
    EACH(k, 3) {
        double hi[4], lo[4];
        store_four(hi, lo, row[k]);
        EACH(i, 3) {
            to[3 * i + k] = hi[i];
            to[3 * i + k + CYLINT_LOW] = lo[i];
        }
    }
#endif
}

INLINE void store_pair(cylint_shape *s, int at, pair x)
{
    s->library.number[at] = x.hi;
    s->library.number[at + CYLINT_LOW] = x.lo;
}

/* Writes cosine and sine of the lateral surface, and returns its slope, which of
 * a rounded cone is another one than dr / |w|, the one given.  A rounded cone's
 * cosine has the error of 1 - sine^2, which is larger relative to it: *error
 * grows. */
static pair measure_angle(cylint_shape *s, const inverse_lengths *inverse,
                          pair slope, pair height, double *error)
{
    const pair one = {1, 0}, dr = cylint_radius_growth(s);
    pair cosine = one, sine = {0, 0};
    if (s->kind == CYLINT_KIND_RCONE) {
        const double rest = inverse->lateral2.hi;
        sine = slope;
        if (rest > 0) {
            cosine = pair_mul(pair_mul(inverse->lateral2, inverse->axis),
                              inverse->lateral);
            slope = pair_mul(dr, inverse->lateral);
        }
        *error /= rest > 0 ? cosine.hi * cosine.hi : 0;
    } else if (s->kind == CYLINT_KIND_CONE) {
        cosine = pair_mul(height, inverse->lateral);
        sine = pair_mul(dr, inverse->lateral);
    } else if (s->kind == CYLINT_KIND_ACONE) {
        cosine = fast_two_sum(inverse->lateral.hi, inverse->lateral.lo);
        sine = pair_mul(dr, cosine);
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
        inverse = upright_rows(&m, s);
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
#if LANES == 4
    _mm256_zeroupper();
#endif
}
