/*
 * intersect.h - cylint_intersect() by exact signs
 */
#ifndef CYLINT_INTERSECT_H
#define CYLINT_INTERSECT_H

#include "cylint.h"

/* As cylint_intersect(), without the filter. */
int cylint_intersect_by_signs(const cylint_shape *shape,
                              const cylint_line *line, unsigned want,
                              cylint_answer *answer);

#endif
