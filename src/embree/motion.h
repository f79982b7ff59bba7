/*
 * motion.h - moving shapes and their boxes
 */
#ifndef CYLINT_EMBREE_MOTION_H
#define CYLINT_EMBREE_MOTION_H

#include "../bvh/float_bounds.h"
#include "cylint_embree.h"
#include "float_filter.h"

/* Whether the two states have the same constructor and the same ends. */
int cylint_can_move_into(const cylint_shape *at_0, const cylint_shape *at_1);

/* The record between two, or one that the filter does not decide. */
void cylint_embree_record_between(const cylint_record *at_0,
                                  const cylint_record *at_1, double time,
                                  cylint_record *to);

/* The box at time 0 or 1 (step).  The boxes that Embree interpolates between the
 * two contain the shape at every time. */
cylint_extent cylint_motion_box(const cylint_shape *at_0,
                                const cylint_shape *at_1, int step);

#endif
