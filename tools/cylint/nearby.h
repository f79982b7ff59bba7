/*
 * nearby.h - the shapes of a scene that are near a point
 */
#ifndef CYLINT_NEARBY_H
#define CYLINT_NEARBY_H

#include "cylint_distance.h"
#include "left_out.h"
#include "search.h"

/* A point and a radius.  A shape is near if it is within the radius, as of
 * cylint_scene.h, and it is not left out. */
struct nearby {
    const struct search *search;
    const double *point;
    double radius;
    unsigned want; /* 0 or CYLINT_SIGNED */
    const struct left_out *left_out;
};

/* Returns the number, from 1, of the nearest of these shapes, of equal distances
 * the lowest; 0 if there is none. */
size_t nearby_closest(const struct nearby *n);

/* Returns how many there are, at most `most`. */
unsigned long long nearby_count(const struct nearby *n,
                                unsigned long long most);

#endif
