/*
 * motion.h - shapes between two states, and boxes that keep up with them
 */
#ifndef CYLINT_EMBREE_MOTION_H
#define CYLINT_EMBREE_MOTION_H

#include "../bvh/float_bounds.h"
#include "cylint_embree.h"

/* Whether there are shapes between: same constructor, same ends. */
int cylint_can_move_into(const cylint_shape *at_0, const cylint_shape *at_1);

/* The box at time 0 or 1 (step), such that boxes interpolated by Embree hold
 * the shape at every time. */
void cylint_motion_bounds(const cylint_shape *at_0, const cylint_shape *at_1,
                          int step, cylint_extent *box);

#endif
