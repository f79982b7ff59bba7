/*
 * intersect.h - cylint_intersect() by exact signs, signs at a point, and the
 * wanted members of a hit
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

/* Writes the wanted members of a hit, of which t, part and side are known.  Other
 * members keep their values. */
static inline void cylint_write_hit(const cylint_shape *shape,
                                    const cylint_line *line,
                                    const cylint_hit *known, unsigned want,
                                    cylint_hit *hit)
{
    cylint_hit all = *hit;
    all.t = known->t;
    all.part = known->part;
    all.side = known->side;
    if (want & CYLINT_WANT_BESIDE_T)
        cylint_describe(shape, line, want, &all);
    if (!(want & CYLINT_WANT_T))
        all.t = hit->t;
    if (!(want & CYLINT_WANT_PART)) {
        all.part = hit->part;
        all.side = hit->side;
    }
    *hit = all;
}

#endif
