/*
 * boundary.h - the feature on which a point of the surface lies
 */
#ifndef CYLINT_BOUNDARY_H
#define CYLINT_BOUNDARY_H

#include "cylint.h"

enum { CYLINT_NO_FEATURE = -1 };

/* Of a circular or elliptic shape and a point for which cylint_contains() is 0, by
 * exact signs; CYLINT_NO_FEATURE where `ends` leaves out that part. */
int cylint_boundary_feature(const cylint_shape *shape, const double point[3]);

#endif
