/*
 * origin.h - on which side of a surface a line's origin lies, exactly, or another
 * point of the line
 */
#ifndef CYLINT_ORIGIN_H
#define CYLINT_ORIGIN_H

#include "../numbers/double_double.h"
#include "cylint.h"

/* Not a cap: the lateral quadric, or the ball of a sphere. */
enum { CYLINT_LATERAL_SURFACE = -1 };

/* The sign at o + t d of z from the plane of cap 0 or 1, or of the lateral quadric,
 * which is negative within.  If t is not 0, it can be CYLINT_SIGN_UNDECIDED
 * (sign.h). */
int cylint_sign_on_line_plain(const cylint_shape *shape,
                              const cylint_line *line, pair t, int surface);
int cylint_sign_on_line_fma(const cylint_shape *shape, const cylint_line *line,
                            pair t, int surface);

#endif
