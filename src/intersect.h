/*
 * intersect.h - cylint_intersect() by exact signs, and signs at a point
 */
#ifndef CYLINT_INTERSECT_H
#define CYLINT_INTERSECT_H

#include "signs/sign.h"

/* As cylint_intersect(), without the filter. */
int cylint_intersect_by_signs(const cylint_shape *shape,
                              const cylint_line *line, unsigned want,
                              cylint_answer *answer);

/* Opens the query of a line through a point, for signs that depend only on that
 * point or on the shape.  Returns an error if the point is not finite. */
cylint_status cylint_open_at(cylint_query *q, const cylint_shape *shape,
                             cylint_line *line, const double point[3]);

#endif
