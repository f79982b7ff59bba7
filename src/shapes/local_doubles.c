/*
 * local_doubles.c - the local coordinates of a shape, in doubles
 *
 * They take a tenth of the time that pairs take, and most lines that a scene
 * tests need no more: signs are certain with the larger unit.
 */
#define CYLINT_NARROW
#include "local.h"

#include <math.h>

#include "../numbers/bits.h"
#include "../numbers/error_bounds.h"
#include "../numbers/simd.h"
#include "shape_facts.h"

/* Stores x and y together, as kernels load them: two stores delay that load. */
INLINE void store_two(double *to, double x, double y)
{
#if LANES == 2
    v_store(to, v_two(x, y));
#else
    to[0] = x;
    to[1] = y;
#endif
}

INLINE void store_column(double *number, int i, double x, double y, double z)
{
    double *to = number + CYLINT_AT_COLUMNS + 3 * i;
    store_two(to, x, y);
    to[2] = z;
}

/* 1 / sqrt(x), 1 / sqrt(y). */
INLINE void inverse_roots_of_two(double root[2], double x, double y)
{
#if LANES == 2
    v_store(root, v_set(1) / v_sqrt(v_two(x, y)));
#else
    root[0] = 1 / sqrt(x);
    root[1] = 1 / sqrt(y);
#endif
}

/*
 * w is the axis, i a coordinate along which it is not long: |(w_j, w_k)| >= |w| /
 * sqrt(2), where i, j, k is a cyclic order.
 *
 *   h = 1 / |w|, l = 1 / |(w_j, w_k)|
 *   z = h w,  x = l (0, w_k, -w_j),  y = z x x
 *
 * Relative errors, in roundings: of w and dr 1, |(w_j, w_k)|^2 4, |w|^2 5, l 4,
 * h 4.5, z 6.5, x 6, y 14.5, height |w|^2 h 10.5, slope dr h 6.5.
 */
typedef struct {
    double length2, per_length, height, slope;
} upright;

INLINE upright store_rows_in_doubles(double *number, const double p0[3],
                                     const double p1[3], double dr)
{
    /* without a branch, because i is unpredictable */
    const int far = fabs(p1[0] - p0[0]) > fabs(p1[2] - p0[2]);
    const int i = 2 * far, j = 1 - far, k = 2 - far;
    const double wi = p1[i] - p0[i], wj = p1[j] - p0[j], wk = p1[k] - p0[k];
    const double across2 = wj * wj + wk * wk, length2 = wi * wi + across2;
    double root[2];
    inverse_roots_of_two(root, length2, across2);
    const double h = root[0], l = root[1];
    const double zi = h * wi, xj = l * wk, xk = -(l * wj);
    store_column(number, i, 0, -(h * across2 * l), zi);
    store_column(number, j, xj, -(zi * xk), h * wj);
    store_column(number, k, xk, zi * xj, h * wk);
    return (upright){length2, h, length2 * h, dr * h};
}

/*
 * Cosine and sine of a round cone.  c = cosine^2 = 1 - sine^2; |w|^2 - dr^2 has
 * an error of 9 roundings of |w|^2, which are 9 / c of itself.  So those of its
 * inverse root and of slope and cosine are less than 13 / c roundings.
 */
INLINE void store_angle(double *number, upright is, double dr)
{
    const double lateral2 = is.length2 - dr * dr, root = 1 / sqrt(lateral2);
    const double cosine2 = lateral2 * (is.per_length * is.per_length);
    number[CYLINT_AT_SINE] = is.slope;
    number[CYLINT_AT_COSINE] = lateral2 * root * is.per_length;
    number[CYLINT_AT_SLOPE] = dr * root;
    number[CYLINT_AT_UNIT] =
        CYLINT_LOCAL_DOUBLES * CYLINT_ROUNDING * CYLINT_SLACK / cosine2;
}

void cylint_local_in_doubles(cylint_shape *s, int kind, int ends,
                             const cylint_record *from)
{
    double *x = s->library.number;
    const double *p0 = from->p0, r0 = from->r0, r1 = from->r1, dr = r1 - r0;
    s->kind = kind;
    s->ends = ends;
    s->library.flag[CYLINT_AT_IN_RANGE] = 1;
    s->library.flag[CYLINT_AT_SURFACE] = CYLINT_PART_LATERAL;
    s->library.flag[CYLINT_AT_PREPARED] = cylint_solid(kind, ends);
    store_two(x + CYLINT_AT_BASE, p0[0], p0[1]);
    x[CYLINT_AT_BASE + 2] = p0[2];
    store_two(x + CYLINT_AT_R0, r0, r1);
    const upright is = store_rows_in_doubles(x, p0, from->p1, dr);
    x[CYLINT_AT_HEIGHT] = is.height;
    x[CYLINT_AT_SLOPE] = is.slope;
    x[CYLINT_AT_UNIT] = CYLINT_LOCAL_DOUBLES * CYLINT_ROUNDING;
    if (kind == CYLINT_KIND_RCONE)
        store_angle(x, is, dr);
    x[CYLINT_AT_NORM] = CYLINT_LOCAL_NORM * CYLINT_SLACK;
    x[CYLINT_AT_REACH] = (is.height + cylint_larger(r0, r1)) * CYLINT_SLACK;
}
