/*
 * certified_distance.h - distances from pairs of doubles, or "undecided"
 */
#ifndef CYLINT_CERTIFIED_DISTANCE_H
#define CYLINT_CERTIFIED_DISTANCE_H

#include "cylint_distance.h"

/* Writes the distance and, if wanted, part and feature, and returns 1; or
 * returns 0.  The shape is prepared.  For refused and elliptic shapes and points
 * that are not finite it returns 0. */
typedef int cylint_certified(const cylint_shape *shape, const double point[3],
                             unsigned want, cylint_closest *answer);

cylint_certified cylint_certified_plain, cylint_certified_fma;

#endif
