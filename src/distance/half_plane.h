/*
 * half_plane.h - a point and a shape in the half plane through the axis and the
 * point, in pairs of doubles
 *
 * A pair here is not normalised: lo can be some ulps of hi.
 */
#ifndef CYLINT_HALF_PLANE_H
#define CYLINT_HALF_PLANE_H

#include "../numbers/double_double.h" /* before simd.h */
#include "../numbers/simd.h"
#include "../shapes/shape_facts.h"
#include "cylint.h"
#include "error_bounds.h"

#if LANES == 2

INLINE pair lazy_sub(pair a, pair b)
{
    const pair d = two_diff(a.hi, b.hi);
    return (pair){d.hi, d.lo + (a.lo - b.lo)};
}

INLINE pair lazy_add(pair a, pair b)
{
    const pair s = two_sum(a.hi, b.hi);
    return (pair){s.hi, s.lo + (a.lo + b.lo)};
}

INLINE pair lazy_mul(pair a, pair b)
{
    const pair p = two_prod(a.hi, b.hi);
    return (pair){p.hi, sum_of(a.hi, b.lo, sum_of(a.lo, b.hi, p.lo))};
}

INLINE pair lazy_square(pair a)
{
    const pair p = two_prod(a.hi, a.hi);
    return (pair){p.hi, sum_of(2 * a.hi, a.lo, p.lo)};
}

INLINE double size_of(pair a)
{
    return fabs(a.hi);
}

INLINE pair normalized(pair a)
{
    return fast_two_sum(a.hi, a.lo);
}

/* A function of simd.h: sqrt() would also set errno. */
INLINE double double_root(double x)
{
    return v_first(v_sqrt(v_set(x)));
}

/* sqrt(a) of a normal pair.  *half: 1 / (2 sqrt(a)), nearly. */
INLINE pair root_of(pair a, double *half)
{
    const double s = double_root(a.hi);
    const pair p = two_prod(s, s);
    *half = 0.5 / s;
    return (pair){s, (((a.hi - p.hi) - p.lo) + a.lo) * *half};
}

/* The square, lo^2 included. */
INLINE pair whole_square(pair a)
{
    const pair p = two_prod(a.hi, a.hi);
    return (pair){p.hi, sum_of(sum_of(2, a.hi, a.lo), a.lo, p.lo)};
}

/* sqrt(x^2 + y^2), where the high parts have cancelled. */
ASIDE pair short_length(pair x, pair y)
{
    const pair a = lazy_square(normalized(x)), b = lazy_square(normalized(y));
    const pair sum = two_sum(a.hi, b.hi);
    double half;
    return root_of(normalized((pair){sum.hi, sum.lo + (a.lo + b.lo)}), &half);
}

/* sqrt(x^2 + y^2).  The root begins before the low parts are there. */
INLINE pair length_of(pair x, pair y)
{
    const pair a = whole_square(x), b = whole_square(y);
    const pair sum = two_sum(a.hi, b.hi);
    const double s = double_root(sum.hi), half = 0.5 / s;
    const pair p = two_prod(s, s);
    const double rest = (sum.hi - p.hi) + ((sum.lo - p.lo) + (a.lo + b.lo));
    const double step = rest * half;
    if (!(fabs(step) <= CYLINT_ROOT_STEP * s))
        return short_length(x, y);
    return (pair){s, step - step * step * half};
}

typedef struct {
    pair z, rho;
    double size;  /* |D| <= size <= 2 |D|, D the point from the base */
    double error; /* of z, rho, and combinations of both with factors of at
                     most 1 in size */
} half_plane;

/* The point minus a point of the shape. */
INLINE void point_from(const double point[3], const double from[3], pair D[3])
{
    EACH(i, 3)
        D[i] = two_diff(point[i], from[i]);
}

/* (D.w, D.D) in two lanes.  All digits of the first terms are in hi, and lo
 * does not wait for it. */
INLINE vpair dots(const pair D[3], const pair w[3])
{
    vd hi[3], lo[3];
    EACH(i, 3) {
        const vd x = v_set(D[i].hi), y = v_two(w[i].hi, D[i].hi);
        const vpair p = v_two_prod(x, y);
        hi[i] = p.hi;
        lo[i] = v_sum_of(x, v_two(w[i].lo, D[i].lo),
                         v_sum_of(v_set(D[i].lo), y, p.lo));
    }
    const vpair s = v_two_sum(hi[0], hi[1]), t = v_two_sum(s.hi, hi[2]);
    return (vpair){t.hi, (s.lo + t.lo) + (lo[0] + (lo[1] + lo[2]))};
}

/*
 * sqrt(dd - t), 0 <= t <= dd but for rounding.  The difference of the high parts
 * is exact but for its own low part.  The rest of dd and t is far below it
 * unless the root is far below sqrt(dd), so the root begins before the rest is
 * there, and two steps correct it.
 */
INLINE pair root_of_difference(pair dd, pair t, double *half)
{
    const pair d = fast_two_sum(dd.hi, -t.hi);
    const double s = double_root(d.hi);
    const pair p = two_prod(s, s);
    *half = 0.5 / s;
    const double rest = (d.hi - p.hi) - (p.lo - (d.lo + (dd.lo - t.lo)));
    const double step = rest * *half;
    return (pair){s, step - step * step * *half};
}

INLINE double size_along(const pair D[3])
{
    return fabs(D[0].hi) + fabs(D[1].hi) + fabs(D[2].hi);
}

/* The bound on the errors of a root of a difference. */
INLINE double error_of_root(double size, double half, double reach)
{
    const double thin = size * half;
    return thin <= CYLINT_THINNEST
               ? CYLINT_HALF_PLANE_ERROR * (size * thin + reach)
               : HUGE_VAL;
}

/* z and |D|^2 of the point D from the base. */
INLINE void load_sums(pair *z, pair *dd, const pair D[3], const pair w[3])
{
    double hi[2], lo[2];
    const vpair sums = dots(D, w);
    v_store(hi, sums.hi);
    v_store(lo, sums.lo);
    *z = (pair){hi[0], lo[0]};
    *dd = (pair){hi[1], lo[1]};
}

/* rho of a point near the axis, where D.D - z^2 has lost its digits, from x and y.
 * Where their squares would underflow, rho is 0 within the error. */
ASIDE void load_across(half_plane *m, const cylint_shape *s, const pair D[3],
                       double reach)
{
    pair x[2] = {{0, 0}, {0, 0}};
    EACH(i, 3)
        for (int k = 0; k < 2; k++)
            x[k] = pair_add(x[k],
                            pair_mul(D[i], (pair){cylint_column(s, i)[k],
                                                  cylint_column_lo(s, i)[k]}));
    m->rho = size_of(x[0]) + size_of(x[1]) > CYLINT_DISTANCE_LEAST
                 ? length_of(x[0], x[1])
                 : (pair){0, 0};
    m->error = CYLINT_HALF_PLANE_ERROR * (m->size + reach);
}

/* Whether the point is so far from the axis that its direction from it has
 * digits. */
INLINE int is_off_axis(const half_plane *m)
{
    return m->size < 2 * CYLINT_THINNEST * m->rho.hi;
}

/* w: the direction of the axis, a unit vector, or a vector of the given length.
 * reach: of the shape. */
INLINE void load_along(half_plane *m, const cylint_shape *s,
                       const double point[3], const pair w[3],
                       const pair *length, double reach)
{
    pair D[3], dd;
    double half;
    point_from(point, cylint_base(s), D);
    load_sums(&m->z, &dd, D, w);
    if (length)
        m->z = pair_div(normalized(m->z), *length);
    m->rho = root_of_difference(dd, lazy_square(m->z), &half);
    m->size = size_along(D);
    m->error = error_of_root(m->size, half, reach);
    if (!(m->error < HUGE_VAL) && !length)
        load_across(m, s, D, reach);
}

INLINE void load_row(pair w[3], const cylint_shape *s)
{
    EACH(i, 3)
        w[i] = (pair){cylint_column(s, i)[2], cylint_column_lo(s, i)[2]};
}

INLINE void load_half_plane(half_plane *m, const cylint_shape *s,
                            const double point[3])
{
    pair w[3];
    load_row(w, s);
    load_along(m, s, point, w, NULL, cylint_reach(s));
}

/* Whether every number within `error` of d rounds to d.hi; d is normal. */
INLINE int is_certain(pair d, double error)
{
    const double most = error + CYLINT_NEAREST_MARGIN * fabs(d.hi);
    return (d.hi + (d.lo + most) == d.hi) & (d.hi + (d.lo - most) == d.hi) &
           (fabs(d.hi) >= CYLINT_DISTANCE_LEAST);
}

#endif
#endif
