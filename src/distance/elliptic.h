/*
 * elliptic.h - the distance of elliptic kinds
 */
#ifndef CYLINT_ELLIPTIC_DISTANCE_H
#define CYLINT_ELLIPTIC_DISTANCE_H

#include "cylint_distance.h"

/* cylint_distance() of a valid elliptic shape and a finite point. */
double cylint_elliptic_distance(const cylint_shape *shape,
                                const double point[3], unsigned want,
                                cylint_closest *answer);

/* The same in pairs, and in triples near the surface: writes the members of
 * `want` (one_distance.h) that are certain, and returns the others. */
unsigned cylint_elliptic_in_pairs_plain(const cylint_shape *shape,
                                        const double point[3], unsigned want,
                                        cylint_closest *answer);
unsigned cylint_elliptic_in_pairs_fma(const cylint_shape *shape,
                                      const double point[3], unsigned want,
                                      cylint_closest *answer);

/* The normal at a point of a feature, where it is certain: returns 1. */
int cylint_elliptic_normal_plain(const cylint_shape *shape,
                                 const double point[3], int feature,
                                 double normal[3]);
int cylint_elliptic_normal_fma(const cylint_shape *shape, const double point[3],
                               int feature, double normal[3]);

/* A lower bound of the absolute distance from a prepared shape, in doubles, in
 * any rounding mode; 0 or less, or NaN, where there is none. */
double cylint_elliptic_safety_plain(const cylint_shape *shape,
                                    const double point[3]);
double cylint_elliptic_safety_fma(const cylint_shape *shape,
                                  const double point[3]);

/* The double below the absolute value of cylint_elliptic_distance(), less the
 * error of that; 0 for a shape too flat to bound it, and where rounding is
 * directed: triples then have no bound on their errors. */
double cylint_below_elliptic(const cylint_shape *shape, const double point[3],
                             double below);

#endif
