/*
 * one_distance.h - the distance of one point from one shape in heads and tails,
 * pairs and triples
 */
#ifndef CYLINT_ONE_DISTANCE_H
#define CYLINT_ONE_DISTANCE_H

#include "../shapes/shape_facts.h"
#include "cylint_distance.h"

/* Bits beside those of wanted members: the distance; the distance can be 0. */
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

/* Writes the members of `want` that are certain, and returns the others, in pairs,
 * with triples near the surface.  Returns CYLINT_ON_SURFACE too where the distance
 * is undecided and the point can be on the surface: other members are then right if
 * it is and the surface is whole.  want: CYLINT_WANT_DISTANCE too. */
typedef unsigned cylint_in_pairs(const cylint_shape *shape,
                                 const double point[3], unsigned want,
                                 cylint_closest *answer);

/* By kind, without and with the feature; NULL: none.  `pairs` serves all
 * prepared shapes that are not elliptic. */
typedef struct {
    cylint_head_tail_distance *head_tail[CYLINT_KINDS][2];
    cylint_in_pairs *pairs;
} cylint_one_distances;

extern const cylint_one_distances cylint_one_distances_plain CYLINT_HIDDEN,
    cylint_one_distances_fma CYLINT_HIDDEN;

/* ------------------------------------------------------ elliptic kinds -- */

/* cylint_distance() of a valid elliptic shape and a finite point. */
double cylint_elliptic_distance(const cylint_shape *shape,
                                const double point[3], unsigned want,
                                cylint_closest *answer);

/* cylint_distance() without members.  proved: whether doubles, pairs or triples
 * near the surface prove it. */
double cylint_distance_alone(const cylint_shape *shape, const double point[3],
                             cylint_closest *answer, int *proved);

/* pairs: of a prepared shape, all members or none; where the distance is undecided,
 * part and normal or none.  safety: a lower bound of the absolute distance from it,
 * in doubles, in any rounding mode; 0 or less, or NaN, where there is none. */
typedef struct {
    cylint_in_pairs *pairs;
    double (*safety)(const cylint_shape *shape, const double point[3]);
} cylint_elliptic_kernels;

extern const cylint_elliptic_kernels cylint_elliptic_kernels_plain
    CYLINT_HIDDEN,
    cylint_elliptic_kernels_fma CYLINT_HIDDEN;

/* The double below the absolute value of cylint_elliptic_distance(), less the
 * error of that; 0 for a shape too flat to bound it, and where rounding is
 * directed: triples then have no bound on their errors. */
double cylint_below_elliptic(const cylint_shape *shape, const double point[3],
                             double below);

#endif
