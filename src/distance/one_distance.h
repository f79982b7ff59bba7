/*
 * one_distance.h - the distance of one point from one shape in doubles
 */
#ifndef CYLINT_ONE_DISTANCE_H
#define CYLINT_ONE_DISTANCE_H

#include "../shapes/shape_facts.h"
#include "cylint_distance.h"

/* Besides the wanted members: the distance, and that it can be 0. */
enum {
    CYLINT_WANT_DISTANCE = CYLINT_WANT_T,
    CYLINT_ON_SURFACE = CYLINT_WANT_NEAREST,
    CYLINT_WANT_GEOMETRY = CYLINT_WANT_POINT | CYLINT_WANT_NORMAL
};

/* The distance and, where wanted, the feature of a capped shape, with heads and
 * tails.  Writes the answer and returns 1 where all of it is certain, else
 * returns 0. */
typedef int cylint_head_tail_distance(const cylint_shape *shape,
                                      const double point[3],
                                      cylint_closest *answer);

/* By kind, without and with the feature; NULL: none.  `pairs` serves all
 * prepared shapes, with triples of doubles near the surface: it writes the
 * members of `want` that are certain, and returns the others;
 * CYLINT_ON_SURFACE if the distance is 0 or too small for a sign, and, of closed
 * shapes, the other members are those of a point on the surface. */
typedef struct {
    cylint_head_tail_distance *head_tail[CYLINT_KINDS][2];
    unsigned (*pairs)(const cylint_shape *shape, const double point[3],
                      unsigned want, cylint_closest *answer);
    /* The normal at a point of a feature of a cylinder or cone, where it is
     * certain: returns 1. */
    int (*normal)(const cylint_shape *shape, const double point[3], int feature,
                  double normal[3]);
} cylint_one_distances;

extern const cylint_one_distances cylint_one_distances_plain CYLINT_HIDDEN,
    cylint_one_distances_fma CYLINT_HIDDEN;

#endif
