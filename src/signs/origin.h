/*
 * origin.h - on which side of a surface a line's origin lies, exactly
 */
#ifndef CYLINT_ORIGIN_H
#define CYLINT_ORIGIN_H

#include "cylint.h"

/* Not a cap: the lateral quadric, or the ball of a sphere. */
enum { CYLINT_LATERAL_SURFACE = -1 };

#ifndef CYLINT_SIGN_AT_ORIGIN /* of this build */
#define CYLINT_SIGN_AT_ORIGIN cylint_sign_at_origin
#endif

/* The sign of z from the plane of cap 0 or 1, or of the lateral quadric, which is
 * negative within. */
int CYLINT_SIGN_AT_ORIGIN(const cylint_shape *shape, const cylint_line *line,
                          int surface);

#endif
