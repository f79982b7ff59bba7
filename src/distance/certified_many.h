/*
 * certified_many.h - distances of many points from one shape, in lanes
 */
#ifndef CYLINT_CERTIFIED_MANY_H
#define CYLINT_CERTIFIED_MANY_H

#include "cylint_distance.h"

/* Points of a block. */
enum { CYLINT_POINT_BLOCK = 256 };

/* Writes the distances and features of n <= CYLINT_POINT_BLOCK points that are
 * certain, writes the numbers of the others to `rest`, and returns how many these
 * are.  The shape is prepared, has the ends capped, and is circular or round
 * without an angle. */
typedef int cylint_certify_many(const cylint_shape *shape,
                                const double *const xyz[3], int n,
                                double *distance, signed char *feature,
                                int *rest);

cylint_certify_many cylint_certify_many_plain, cylint_certify_many_avx2,
    cylint_certify_many_avx512;

#endif
