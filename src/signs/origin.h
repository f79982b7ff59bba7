/*
 * origin.h - on which side of a surface a line's origin lies, exactly
 */
#ifndef CYLINT_ORIGIN_H
#define CYLINT_ORIGIN_H

#include "cylint.h"

/* Not a cap: the lateral quadric, or the ball of a sphere. */
enum { CYLINT_LATERAL_SURFACE = -1 };

/* The sign of z from the plane of cap 0 or 1, or of the lateral quadric, which is
 * negative within. */
int cylint_sign_at_origin_plain(const cylint_shape *shape,
                                const cylint_line *line, int surface);
int cylint_sign_at_origin_fma(const cylint_shape *shape,
                              const cylint_line *line, int surface);

#endif
