/*
 * lean_distance.h - the leanest formulas for the distance from a prepared shape
 *
 * The shape keeps its base, unit axis, length and radii.  The result is the
 * signed distance in doubles, without part or nearest point.  It is wrong where
 * digits cancel, and so is its sign near the surface.
 * [Quilez, iquilezles.org/articles/distfunctions]
 */
#ifndef BENCH_LEAN_DISTANCE_H
#define BENCH_LEAN_DISTANCE_H

#include "cylint.h"

struct lean_solid {
    double base[3]; /* cylinder: the middle of the axis */
    double axis[3]; /* unit; capsule: w = p1 - p0 */
    double half;    /* of the height */
    double r0, r1;
    double slope, level; /* rcone: sine and cosine of the cone's slope */
    double inverse;      /* cone: 1 / the squared length of its side;
                            capsule: 1 / w.w */
};

typedef double lean_distance(const struct lean_solid *solid,
                             const double point[3]);

/* Prepares a capped cylinder or cone, a sphere, capsule or rcone. */
void lean_solid_of(struct lean_solid *to, const cylint_shape *shape);

/* The formula for a prepared shape. */
lean_distance *lean_distance_of(const cylint_shape *shape);

#endif
