/*
 * intersect.h - cylint_intersect() by exact signs, signs at a point, the nearest
 * hit of several shapes
 */
#ifndef CYLINT_INTERSECT_H
#define CYLINT_INTERSECT_H

#include "filter/filter.h"
#include "signs/sign.h"

/* As cylint_intersect(), without the filter. */
int cylint_intersect_by_signs(const cylint_shape *shape,
                              const cylint_line *line, unsigned want,
                              cylint_answer *answer);

/* Opens the query of a line through a point, for signs that depend only on that
 * point or on the shape.  Returns an error if the point is not finite. */
cylint_status cylint_open_at(cylint_query *q, const cylint_shape *shape,
                             cylint_line *line, const double point[3]);

/* Writes the wanted members of the line's nearest hit on a shape, of which t, part
 * and side are known.  Other members keep their values. */
static inline void cylint_describe_nearest(const cylint_shape *shape,
                                           const cylint_line *line,
                                           const cylint_hit *known,
                                           unsigned want, cylint_hit *hit)
{
    const unsigned missing = want & CYLINT_WANT_BESIDE_T;
    if (missing) {
        cylint_answer answer;
        answer.hit[0] = *hit;
        cylint_intersect(shape, line, missing | CYLINT_WANT_NEAREST, &answer);
        *hit = answer.hit[0];
    }
    if (want & CYLINT_WANT_T)
        hit->t = known->t;
    if (want & CYLINT_WANT_PART) {
        hit->part = known->part;
        hit->side = known->side;
    }
}

#endif
