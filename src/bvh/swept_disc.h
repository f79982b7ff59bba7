/*
 * swept_disc.h - a bounded shape as a disc that is swept along an axis
 *
 * The section at z has its centre at base + z axis.  With k(z) = k0 + (k1-k0) z
 * its points are at most k(z) `across` from the axis, and along the axis at most
 * k(z) `along` from the centre (the members below).  A round shape is swept by a
 * ball: then both members are 1.  Slices are cut by planes across the axis.
 */
#ifndef CYLINT_BVH_SWEPT_DISC_H
#define CYLINT_BVH_SWEPT_DISC_H

#include "float_bounds.h"
#include "../shapes/shape_facts.h"
#include "cylint.h"

/* A sum of squares below this may have underflowed. */
#define CYLINT_LEAST_SQUARE (DBL_MIN * 0x1p60)

typedef struct cylint_swept_disc {
    double base[3], axis[3];
    double k[2];
    double across, along;
    double length;     /* of the axis */
    double a[3], b[3]; /* of elliptic shapes */
    int elliptic, round;
    int solid;    /* a cylinder with both caps */
    int ends;     /* a cylint_ends */
    double shift; /* of a round shape: cylint_section_shift(); of one ball 1 */
} cylint_swept_disc;

/* A slice of a shape: number `index` of `count` equal ones along z. */
typedef struct cylint_slice {
    uint16_t index, count;
} cylint_slice;

/* Shapes in coordinates (x - center) scale, where scale is a power of two.
 * line_error: the largest error of a line's points, in these
 * coordinates. */
typedef struct cylint_view {
    double center[3], scale, line_error;
    /* Returns a shape, which it may write to *spare: kind, ends and data; local
     * coordinates need not be written. */
    const cylint_shape *(*shape_at)(const void *owner, uint32_t number,
                                    cylint_shape *spare);
    const void *owner;
} cylint_view;

static inline const cylint_shape *cylint_shape_of_array(const void *shapes,
                                                        uint32_t number,
                                                        cylint_shape *spare)
{
    (void)spare;
    return (const cylint_shape *)shapes + number;
}

/* The shapes of an array in their own coordinates. */
static inline cylint_view cylint_plain_view(const cylint_shape *shapes)
{
    return (cylint_view){
        .scale = 1, .shape_at = cylint_shape_of_array, .owner = shapes};
}

void cylint_swept_disc_of(cylint_swept_disc *disc, const cylint_view *view,
                          const cylint_shape *shape);

static inline void cylint_swept_disc_at(cylint_swept_disc *disc,
                                        const cylint_view *view,
                                        uint32_t number)
{
    cylint_shape spare;
    cylint_swept_disc_of(disc, view,
                         view->shape_at(view->owner, number, &spare));
}

/* Writes reach[j]: the section at z reaches k(z) reach[j] from its centre along
 * coordinate j; of a round shape a disc across the axis does. */
void cylint_swept_disc_reach(const cylint_swept_disc *disc, double reach[3]);

/* The lateral part of a round shape at z belongs to the ball at z + s.  Returns an
 * upper bound of |s|, in z.  square: of the axis's length. */
static inline double cylint_section_shift(double k0, double k1, double square)
{
    const double slack = 1 + 0x1p-10; /* far more than the roundings */
    const double growth = fabs(k1 - k0);
    return growth > 0 ? cylint_larger(k0, k1) * growth / square * slack : 0;
}

/* A slice as the convex hull of two sections.  is_ball: the section is the ball
 * of that end. */
typedef struct cylint_slice_hull {
    double z[2], k[2];
    int is_ball[2];
} cylint_slice_hull;

/* Slices overlap by 2^-20 of their length, so that a z with a rounding error
 * still lies in the slice that cylint_slice_at() returns. */
cylint_slice_hull cylint_slice_hull_of(const cylint_swept_disc *disc,
                                       cylint_slice slice);
cylint_extent cylint_slice_box(const cylint_swept_disc *disc,
                               const double reach[3], cylint_slice slice);

/* The index of the slice that contains z.  The first and the last slice have
 * the round ends, where z is below 0 and above 1. */
static inline int cylint_slice_at(double z, int count)
{
    const int index = z > 0 ? (z < 1 ? (int)(z * count) : count) : 0;
    return index < count ? index : count - 1;
}

#endif
