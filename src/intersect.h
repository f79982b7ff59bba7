/*
 * intersect.h - the second way of cylint_intersect()
 */
#ifndef CYLINT_INTERSECT_H
#define CYLINT_INTERSECT_H

#include "cylint.h"

/* As cylint_intersect(), without the filter; point, normal, z and phi only
 * where they are wanted without CYLINT_WANT_FAST. */
int cylint_intersect_by_signs(const cylint_shape *shape,
                              const cylint_line *line, unsigned want,
                              cylint_answer *answer);

#endif
