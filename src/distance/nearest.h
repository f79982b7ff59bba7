/*
 * nearest.h - what is nearest to a point
 */
#ifndef CYLINT_NEAREST_H
#define CYLINT_NEAREST_H

#include "cylint_distance.h"

typedef struct {
    int part, feature;
    int end;  /* of a cap, rim or apex */
    int sign; /* of the distance */
} nearest;

#endif
