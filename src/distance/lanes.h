/*
 * lanes.h - distances of many points: their columns, and the kernels in lanes
 */
#ifndef CYLINT_DISTANCE_LANES_H
#define CYLINT_DISTANCE_LANES_H

#include "../shapes/shape_facts.h"
#include "cylint_distance.h"

static inline int cylint_has_vector(double *const column[3])
{
    return column[0] || column[1] || column[2];
}

static inline void cylint_write_vector(double *const column[3], size_t row,
                                       const double x[3])
{
    for (int i = 0; i < 3; i++)
        if (column[i])
            column[i][row] = x[i];
}

/* The members that the columns need. */
static inline unsigned cylint_wanted_of_closest(
    const cylint_closest_columns *to)
{
    return (to->part || to->feature ? CYLINT_WANT_PART : 0u) |
           (cylint_has_vector(to->point) ? CYLINT_WANT_POINT : 0u) |
           (cylint_has_vector(to->normal) ? CYLINT_WANT_NORMAL : 0u);
}

static inline void cylint_write_closest(const cylint_closest_columns *to,
                                        size_t row,
                                        const cylint_closest *answer)
{
    if (to->distance)
        to->distance[row] = answer->distance;
    if (to->part)
        to->part[row] = (signed char)answer->part;
    if (to->feature)
        to->feature[row] = (signed char)answer->feature;
    cylint_write_vector(to->point, row, answer->point);
    cylint_write_vector(to->normal, row, answer->normal);
}

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
