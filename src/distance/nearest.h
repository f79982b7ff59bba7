/*
 * nearest.h - what is nearest to a point
 */
#ifndef CYLINT_NEAREST_H
#define CYLINT_NEAREST_H

#include "../numbers/bits.h"
#include "../shapes/shape_facts.h"
#include "cylint_distance.h"

enum { CYLINT_NO_FEATURE = -1 };

/* The end that a cap or a rim belongs to; 0 for the lateral surface. */
CYLINT_INLINE int cylint_feature_end(int feature)
{
    return (feature == CYLINT_FEATURE_CAP1) | (feature == CYLINT_FEATURE_RIM1);
}

/* The feature that an answer states: a ball has one; a cap or a rim of radius 0 is
 * an apex. */
CYLINT_INLINE int cylint_stated_feature(const cylint_shape *s, int feature)
{
    if (s->kind == CYLINT_KIND_SPHERE)
        return cylint_surface(s);
    const double factor = cylint_end_factor(s, cylint_feature_end(feature));
    return feature != CYLINT_FEATURE_LATERAL && cylint_sign(factor) == 0
               ? CYLINT_FEATURE_APEX
               : feature;
}

/* Rims and apex are lateral.  Caps have the numbers of their parts. */
CYLINT_INLINE int cylint_feature_part(int feature)
{
    return feature >= CYLINT_FEATURE_RIM0 ? CYLINT_PART_LATERAL : feature;
}

/* On a cap or a round end. */
CYLINT_INLINE int cylint_is_on_end(int feature)
{
    return cylint_feature_part(feature) != CYLINT_PART_LATERAL;
}

CYLINT_INLINE void cylint_write_feature(const cylint_shape *s, int feature,
                                        cylint_closest *answer)
{
    answer->feature = cylint_stated_feature(s, feature);
    answer->part = cylint_feature_part(answer->feature);
}

/* The sign of the point's distance from the plane of cap 0 or 1, or with
 * CYLINT_LATERAL_SURFACE (signs/origin.h) of the lateral quadric, which is
 * negative within. */
int cylint_side_of(const cylint_shape *shape, const double point[3],
                   int surface);

/* Of a cylinder, cone or elliptic shape and a point for which cylint_contains() is
 * 0, by exact signs; CYLINT_NO_FEATURE of other kinds, and where `ends` leaves out
 * that part. */
int cylint_boundary_feature(const cylint_shape *shape, const double point[3]);

#endif
