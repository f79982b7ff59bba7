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

/*
 * Writes the wanted members of the points from `from` to end - 1, at most
 * CYLINT_POINT_BLOCK, where all of them are certain.  Writes the numbers of the
 * others to `uncertain`, and returns how many these are.  each = 0: from one shape
 * that the kernels serve; 1: point i from shape i, where LANES consecutive shapes
 * of a class share lanes.
 */
typedef size_t cylint_distance_lanes(const cylint_shape *shapes, size_t each,
                                     const cylint_points *points, size_t from,
                                     size_t end,
                                     const cylint_closest_columns *answers,
                                     size_t *uncertain);

cylint_distance_lanes cylint_distance_lanes_plain, cylint_distance_lanes_avx2,
    cylint_distance_lanes_avx512;

#endif
