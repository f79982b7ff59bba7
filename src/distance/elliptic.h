/*
 * elliptic.h - the distance of elliptic kinds
 */
#ifndef CYLINT_ELLIPTIC_DISTANCE_H
#define CYLINT_ELLIPTIC_DISTANCE_H

#include "one_distance.h"

/* cylint_distance() of a valid elliptic shape and a finite point. */
double cylint_elliptic_distance(const cylint_shape *shape,
                                const double point[3], unsigned want,
                                cylint_closest *answer);

/* cylint_distance() without members.  proved: whether doubles, pairs or triples
 * near the surface prove it. */
double cylint_distance_alone(const cylint_shape *shape, const double point[3],
                             cylint_closest *answer, int *proved);

/* pairs: of a prepared shape, all members or none.  safety: a lower bound of the
 * absolute distance from it, in doubles, in any rounding mode; 0 or less, or NaN,
 * where there is none. */
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
