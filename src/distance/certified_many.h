/*
 * certified_many.h - distances of many points, in lanes
 */
#ifndef CYLINT_CERTIFIED_MANY_H
#define CYLINT_CERTIFIED_MANY_H

#include "../shapes/shape_facts.h"
#include "cylint_distance.h"

/* Points of a block. */
enum { CYLINT_POINT_BLOCK = 256 };

/* What the kernels serve: prepared shapes, capped, circular or round but not
 * given by an angle.  0: nothing.  Shapes of one class, their kind, can share
 * lanes. */
static inline int cylint_lane_class(const cylint_shape *s)
{
    return !cylint_prepared(s) || s->ends != CYLINT_ENDS_CAPPED ||
                   cylint_is_elliptic(s->kind) || cylint_has_tangent(s->kind)
               ? CYLINT_KIND_NONE
               : s->kind;
}

/*
 * Writes the distances and, unless NULL, the features of
 * n <= CYLINT_POINT_BLOCK points that are certain, writes the numbers of the
 * others to `rest`, and returns how many these are.  each = 0: from one shape
 * that the kernels serve; 1: point i from shape i, where LANES consecutive shapes
 * of a class share lanes.
 */
typedef int cylint_certify_many(const cylint_shape *shapes, int each,
                                const double *const xyz[3], int n,
                                double *distance, signed char *feature,
                                int *rest);

cylint_certify_many cylint_certify_many_plain, cylint_certify_many_avx2,
    cylint_certify_many_avx512;

#endif
