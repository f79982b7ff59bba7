/*
 * undecided_distance.h - distances that limb_distance.c leaves
 */
#ifndef CYLINT_UNDECIDED_DISTANCE_H
#define CYLINT_UNDECIDED_DISTANCE_H

#include "cylint_distance.h"

/* cylint_distance() by pairs, or, where they do not decide, by exact numbers. */
double cylint_undecided_distance(const cylint_shape *shape,
                                 const double point[3], unsigned want,
                                 cylint_closest *answer);

#endif
