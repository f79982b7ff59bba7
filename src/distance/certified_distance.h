/*
 * certified_distance.h - distances from pairs of doubles, or "undecided"
 */
#ifndef CYLINT_CERTIFIED_DISTANCE_H
#define CYLINT_CERTIFIED_DISTANCE_H

#include "nearest.h"

/* Writes *n and the distance and returns 1; or returns 0.  The shape is valid,
 * circular or round, and prepared; the point is finite. */
typedef int cylint_certified(const cylint_shape *shape, const double point[3],
                             nearest *n, double *distance);

cylint_certified cylint_certified_plain, cylint_certified_fma;

#endif
