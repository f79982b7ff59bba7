/*
 * distance_oracle.h - the oracle of distances
 *
 * It shares no formula with the library.  A kind that is not elliptic is a plane
 * figure that turns about its axis.  The oracle computes the coordinates of the
 * point along the axis and away from it, then the point of each segment, ray and
 * arc of the figure that is nearest.  Comparisons are exact (real.h).
 */
#ifndef CYLINT_DISTANCE_ORACLE_H
#define CYLINT_DISTANCE_ORACLE_H

#include "cylint.h"

/* The numbers that cylint_distance() must give, each rounded once. */
struct oracle_closest {
    double distance, point[3], normal[3];
    int part, feature;    /* part -1: there is no surface */
    double by_feature[6]; /* elliptic kinds: the least distance of each */
    double length; /* elliptic kinds: of the longest of a, b, h and the vector
                      from the base to the point */
    int too_near;  /* elliptic kinds: the distance is not 0, but smaller than
                     2^-86 of that; it has an error of 2^-150 of that.  Both are
                     less if the exponents of the data differ much. */
    int is_tie;    /* elliptic kinds: another point has the same distance, but
                     for 2^-113 of that; on the same rim or cylinder, but for
                     2^-113 of the longest of a, b and h */
};

void oracle_distance(const cylint_shape *shape, const double point[3],
                     struct oracle_closest *expected);

/* The last distance was not rounded: how many units in its last place a
 * double is away from it; negative where |got| is the smaller one. */
double oracle_distance_error(double got);

/* The last distance is 0: the point is on the surface. */
int oracle_distance_is_zero(void);

#endif
