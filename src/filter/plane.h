/*
 * plane.h - where a line meets the plane of a half-space, in pairs
 */
#ifndef CYLINT_PLANE_H
#define CYLINT_PLANE_H

#include "../numbers/bits.h"
#include "../numbers/double_double.h"
#include "../numbers/error_bounds.h"
#include "filter.h"

/* A number and a bound of its error. */
typedef struct {
    pair v;
    double error;
} plane_number;

/*
 * x.n.  Each product has an error of CYLINT_PAIR_MUL of its size, and two sums have
 * CYLINT_PAIR_ADD each of the sum of sizes: in all less than 16 2^-106 of that.  The
 * first part of the slack covers the roundings of the bound; 2^-900 covers products
 * that underflow.
 */
static inline plane_number cylint_along_normal(const pair x[3],
                                               const double n[3])
{
    pair sum = {0, 0};
    double size = 0;
    for (int i = 0; i < 3; i++) {
        const pair product = pair_mul(x[i], (pair){n[i], 0});
        sum = pair_add(sum, product);
        size += fabs(product.hi);
    }
    return (plane_number){sum, 0x1.1p-102 * size + 0x1p-900};
}

/* The root -above / slope.  Its error: those of both numbers, and the quotient's. */
static inline plane_number cylint_plane_root(plane_number above,
                                             plane_number slope)
{
    const pair t = pair_div(pair_neg(above.v), slope.v);
    const double size = fabs(t.hi);
    return (plane_number){t, (above.error + size * slope.error) /
                                     fabs(slope.v.hi) * 0x1.01p0 +
                                 size * (2 * CYLINT_PAIR_DIV)};
}

/* The sign of the root minus a limit of the domain, or 0 if it is uncertain. */
static inline int cylint_root_side(plane_number t, double limit)
{
    if (t.v.hi != limit)
        return t.v.hi > limit ? 1 : -1;
    return t.v.lo > t.error ? 1 : t.v.lo < -t.error ? -1 : 0;
}

/* Relation, n, t, part and side of a line that meets the plane at one point; or
 * CYLINT_UNDECIDED.  The thread rounds to nearest.  A number that overflowed fails the
 * comparisons. */
static inline int cylint_meets_plane(const cylint_shape *s,
                                     const cylint_line *line,
                                     cylint_answer *answer)
{
    pair from[3], d[3];
    for (int i = 0; i < 3; i++) {
        from[i] = cylint_difference(line->o[i], cylint_base(s)[i]);
        d[i] = (pair){line->d[i], line->d_lo[i]};
    }
    const plane_number slope = cylint_along_normal(d, cylint_axis(s));
    if (!(fabs(slope.v.hi) > 0x1p60 * slope.error))
        return CYLINT_UNDECIDED;
    const plane_number t =
        cylint_plane_root(cylint_along_normal(from, cylint_axis(s)), slope);
    const double size = fabs(t.v.hi);
    if (!(size > 0x1p-400 && size < 0x1p400 &&
          t.v.hi + (t.v.lo + t.error) == t.v.hi &&
          t.v.hi + (t.v.lo - t.error) == t.v.hi))
        return CYLINT_UNDECIDED;
    const int after_first = cylint_root_side(t, line->tmin),
              after_last = cylint_root_side(t, line->tmax);
    if (after_first == 0 || after_last == 0)
        return CYLINT_UNDECIDED;
    answer->relation = CYLINT_RELATION_CROSS;
    answer->n = after_first > 0 && after_last < 0;
    answer->hit[0].t = t.v.hi;
    answer->hit[0].part = CYLINT_PART_LATERAL;
    answer->hit[0].side =
        slope.v.hi > 0 ? CYLINT_SIDE_LEAVING : CYLINT_SIDE_ENTERING;
    return answer->n;
}

#endif
