/*
 * lanes.h - distances of many points, in lanes
 */
#ifndef CYLINT_DISTANCE_LANES_H
#define CYLINT_DISTANCE_LANES_H

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

/* The arrays of a block; NULL: not wanted.  Of point and normal all three
 * coordinates or none. */
typedef struct {
    double *distance;
    signed char *feature;
    double *point[3], *normal[3];
} cylint_lane_columns;

/*
 * Writes the wanted members of n <= CYLINT_POINT_BLOCK points, where all of them
 * are certain, writes the numbers of the other points to `rest`, and returns how
 * many these are.  each = 0: from one shape that the kernels serve; 1: point i from
 * shape i, where LANES consecutive shapes of a class share lanes.
 */
typedef int cylint_distance_lanes(const cylint_shape *shapes, int each,
                                  const double *const xyz[3], int n,
                                  const cylint_lane_columns *to, int *rest);

cylint_distance_lanes cylint_distance_lanes_plain, cylint_distance_lanes_avx2,
    cylint_distance_lanes_avx512;

#endif
