/*
 * limb_distance.h - the distance of one point, for all processors
 */
#ifndef CYLINT_LIMB_DISTANCE_H
#define CYLINT_LIMB_DISTANCE_H

#include "../shapes/shape_facts.h"
#include "cylint_distance.h"

typedef double cylint_one_distance(const cylint_shape *shape,
                                   const double point[3], unsigned want,
                                   cylint_closest *answer);

/* The functions of each build, by kind, for prepared capped shapes, where neither
 * the point nor the normal is wanted.  The second one of a kind writes the
 * part. */
extern cylint_one_distance *const cylint_limb_plain[CYLINT_KINDS][2],
    *const cylint_limb_fma[CYLINT_KINDS][2];

#endif
