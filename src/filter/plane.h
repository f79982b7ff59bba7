/*
 * plane.h - the hit of a line on the plane of a half-space, and its members, in
 * pairs
 */
#ifndef CYLINT_PLANE_H
#define CYLINT_PLANE_H

#include "../numbers/bits.h"
#include "filter.h"

/* x.n.  2^-900 covers products that underflow, and components of n that are read
 * as 0, where x is at most CYLINT_FAR.  Where each product has a factor 0, x.n is
 * exactly 0, and the error, too. */
CYLINT_INLINE bounded_pair cylint_along_normal(const pair x[3],
                                               const double n[3])
{
    const pair X = two_prod(x[0].hi, n[0]), Y = two_prod(x[1].hi, n[1]),
               Z = two_prod(x[2].hi, n[2]);
    const pair two = two_sum(X.hi, Y.hi), all = two_sum(two.hi, Z.hi);
    const double low = (x[0].lo * n[0] + x[1].lo * n[1]) + x[2].lo * n[2];
    const double errors = ((X.lo + Y.lo) + Z.lo) + (two.lo + all.lo);
    const double size = fabs(X.hi) + fabs(Y.hi) + fabs(Z.hi);
    int is_zero = !(size > 0);
    EACH(i, 3)
        is_zero = is_zero && (!cylint_sign(x[i].hi) || !cylint_sign(n[i]));
    return (bounded_pair){two_sum(all.hi, low + errors),
                          is_zero ? 0 : CYLINT_PLANE_ERROR * size + 0x1p-900};
}

/* x - p as pairs, exactly.  Returns 0 if a coordinate is tiny, or a difference
 * exceeds CYLINT_FAR. */
CYLINT_INLINE int cylint_from_plane(const cylint_shape *s, const double x[3],
                                    pair from[3])
{
    int serves = 1;
    EACH(i, 3) {
        const double p = cylint_base(s)[i];
        from[i] = two_diff(x[i], p);
        serves &= !cylint_too_small(x[i]);
        serves &= !cylint_too_small(p);
        serves &= fabs(from[i].hi) <= CYLINT_FAR;
    }
    return serves;
}

/* The length of the normal. */
static inline bounded_pair cylint_normal_length(const double n[3])
{
    pair square = {0, 0};
    for (int i = 0; i < 3; i++)
        square = pair_add(square, two_prod(n[i], n[i]));
    const pair length = pair_sqrt(square);
    return (bounded_pair){length, length.hi * (0x1p-103 + CYLINT_PAIR_SQRT)};
}

/* Writes the signed distance of a point at `from` from p, with `above` along the
 * normal; from a plane of coordinates it is a difference.  Returns 0 if its
 * rounding is uncertain.  The thread rounds to nearest, and the shape is in
 * range. */
static inline int cylint_plane_distance(const cylint_shape *s,
                                        const pair from[3], bounded_pair above,
                                        double *distance)
{
    const double *n = cylint_axis(s);
    for (int i = 0; i < 3; i++)
        if (cylint_runs_along(n, i) && fabs(from[i].hi) > 0x1p-400) {
            *distance = from[i].hi * cylint_sign(n[i]);
            return 1;
        }
    const bounded_pair d = cylint_quotient(above, cylint_normal_length(n));
    *distance = d.v.hi + 0.0; /* no -0 */
    return cylint_is_rounded(d) || cylint_is_exact_zero(above);
}

/* 1 if the point is behind the plane, 0 if it is on it, -1 if it is before it; or
 * CYLINT_SIGN_UNDECIDED. */
static inline int cylint_side_of_plane(const cylint_shape *s,
                                       const double point[3])
{
    pair from[3];
    if (!cylint_is_plane(s->kind) || !cylint_in_range(s) ||
        !cylint_rounds_to_nearest() || !cylint_from_plane(s, point, from))
        return CYLINT_SIGN_UNDECIDED;
    const bounded_pair above = cylint_along_normal(from, cylint_axis(s));
    return cylint_is_exact_zero(above)     ? 0
           : above.v.hi > 2 * above.error  ? -1
           : above.v.hi < -2 * above.error ? 1
                                           : CYLINT_SIGN_UNDECIDED;
}

/* The slope of the height above the plane along the line, in *slope, and the root.
 * Returns 0 if pairs do not serve the line's origin, or the slope is not certainly
 * far from 0. */
CYLINT_INLINE int cylint_line_to_plane(const cylint_shape *s,
                                       const cylint_line *line,
                                       bounded_pair *slope, bounded_pair *t)
{
    pair from[3], d[3];
    const int serves = cylint_from_plane(s, line->o, from);
    EACH(i, 3)
        d[i] = (pair){line->d[i], line->d_lo[i]};
    *slope = cylint_along_normal(d, cylint_axis(s));
    if (!serves || !(fabs(slope->v.hi) > 0x1p60 * slope->error))
        return 0;
    /* inexact ones have an error of more than 2^-1022: the slope is below 2^122 */
    *t = cylint_quotient(cylint_along_normal(from, cylint_axis(s)), *slope);
    t->v = pair_neg(t->v);
    return 1;
}

/* Whether pairs serve.  A number that overflows fails later comparisons. */
static inline int cylint_pairs_serve(const cylint_shape *s,
                                     const cylint_line *line)
{
    return cylint_is_plane(s->kind) && line->in_range && cylint_in_range(s) &&
           cylint_rounds_to_nearest();
}

/* Of a line parallel to the plane, on a side of it. */
static inline int cylint_answer_parallel(int side, cylint_answer *answer)
{
    answer->relation = side > 0    ? CYLINT_RELATION_CROSS
                       : side == 0 ? CYLINT_RELATION_ALONG
                                   : CYLINT_RELATION_MISS;
    answer->n = 0;
    return side == CYLINT_SIGN_UNDECIDED ? CYLINT_UNDECIDED : 0;
}

/* Relation, n, and the wanted t, part and side of a line; or CYLINT_UNDECIDED. */
static inline int cylint_intersect_plane(const cylint_shape *s,
                                         const cylint_line *line, unsigned want,
                                         cylint_answer *answer)
{
    bounded_pair slope, t;
    if (!cylint_pairs_serve(s, line))
        return CYLINT_UNDECIDED;
    if (!cylint_line_to_plane(s, line, &slope, &t))
        return cylint_is_exact_zero(slope)
                   ? cylint_answer_parallel(cylint_side_of_plane(s, line->o),
                                            answer)
                   : CYLINT_UNDECIDED;
    const int after_first = cylint_side_of_number(t, line->tmin),
              after_last = cylint_side_of_number(t, line->tmax);
    answer->relation = CYLINT_RELATION_CROSS;
    answer->n = after_first >= 0 && after_last <= 0;
    if (after_first == CYLINT_SIGN_UNDECIDED ||
        after_last == CYLINT_SIGN_UNDECIDED ||
        (answer->n && want & CYLINT_WANT_T && !cylint_is_rounded(t) &&
         !cylint_is_exact_zero(t)))
        return CYLINT_UNDECIDED;
    if (answer->n && want & CYLINT_WANT_T)
        answer->hit[0].t = t.v.hi + 0.0; /* no -0 */
    if (answer->n && want & CYLINT_WANT_PART) {
        answer->hit[0].part = CYLINT_PART_LATERAL;
        answer->hit[0].side =
            slope.v.hi > 0 ? CYLINT_SIDE_LEAVING : CYLINT_SIDE_ENTERING;
    }
    return answer->n;
}

/* ------------------------------------------------------------ members -- */

/* Coordinate i of the hit at t.  Where the plane is perpendicular to its direction,
 * all points of the plane have that of p. */
static inline int cylint_plane_coordinate(const cylint_shape *s,
                                          const cylint_line *line,
                                          bounded_pair t, int i, double *x)
{
    const double *n = cylint_axis(s);
    const pair d = {line->d[i], line->d_lo[i]}, o = {line->o[i], 0};
    const int is_across = cylint_runs_along(n, i);
    if (is_across || cylint_sign(d.hi) == 0 || cylint_is_exact_zero(t)) {
        *x = cylint_positive_zero(is_across ? cylint_base(s)[i] : line->o[i]);
        return 1;
    }
    const pair step = pair_mul(t.v, d);
    const double size = fabs(step.hi) + fabs(o.hi);
    const bounded_pair at = {pair_add(o, step),
                             fabs(d.hi) * t.error * 0x1.01p0 + 0x1p-102 * size};
    *x = at.v.hi;
    return cylint_is_rounded(at);
}

/* The normal of length 1.  Returns whether all components are certain. */
static inline int cylint_plane_normal(const cylint_shape *s, double normal[3])
{
    const double *n = cylint_axis(s);
    const bounded_pair length = cylint_normal_length(n);
    int certain = 1;
    for (int i = 0; i < 3; i++) {
        const bounded_pair x = {{n[i], 0}, 0};
        const bounded_pair unit = cylint_quotient(x, length);
        normal[i] = unit.v.hi + 0.0; /* no -0 */
        certain &= cylint_sign(n[i]) == 0 || cylint_is_rounded(unit);
    }
    return certain;
}

/* Writes the wanted members beside t of the hit, as far as they are certain;
 * returns the others. */
static inline unsigned cylint_plane_members(const cylint_shape *s,
                                            const cylint_line *line,
                                            unsigned want, cylint_hit *hit)
{
    bounded_pair slope, t;
    unsigned undecided = want & (CYLINT_WANT_POINT | CYLINT_WANT_NORMAL);
    if (!cylint_pairs_serve(s, line))
        return want;
    if (want & CYLINT_WANT_Z)
        hit->z = 0;
    if (want & CYLINT_WANT_PHI)
        hit->phi = 0;
    if ((undecided & CYLINT_WANT_NORMAL) && cylint_plane_normal(s, hit->normal))
        undecided &= ~(unsigned)CYLINT_WANT_NORMAL;
    /* untaken 1 of 4: of a hit that pairs decided, and along the normal, the slope
     * is far from 0 */
    if ((undecided & CYLINT_WANT_POINT) &&
        cylint_line_to_plane(s, line, &slope, &t)) {
        int is_certain = 1;
        for (int i = 0; i < 3; i++)
            is_certain &=
                cylint_plane_coordinate(s, line, t, i, &hit->point[i]);
        if (is_certain)
            undecided &= ~(unsigned)CYLINT_WANT_POINT;
    }
    return undecided;
}

#endif
