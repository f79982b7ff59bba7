/*
 * swept_disc.h - a bounded shape as a disc that is swept along an axis
 *
 * The section at z has its centre at base + z axis.  With k(z) = k0 + (k1-k0) z
 * its points are at most k(z) across from the axis and at most k(z) along
 * from the centre along the axis.  A round shape is swept by a ball: then both
 * are k(z).
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
    double shift; /* a point at z is on a section between z - shift and
                     z + shift */
} cylint_swept_disc;

/* A piece of a shape: number `index` of `count` equal ones along z. */
typedef struct cylint_piece {
    int index, count;
} cylint_piece;

/* Shapes in coordinates (x - center) scale, where scale is a power of two.
 * line_error: the most by which a line's points are wrong, in these
 * coordinates. */
typedef struct cylint_view {
    const cylint_shape *shapes;
    double center[3], scale, line_error;
} cylint_view;

/* The shapes in their own coordinates. */
static inline cylint_view cylint_plain_view(const cylint_shape *shapes)
{
    return (cylint_view){.shapes = shapes, .scale = 1};
}

/*
 * The members of a swept disc that a leaf needs, in one cache line.  Leaves read
 * them in random order; the shapes themselves are larger and lie on the
 * caller's small pages.  Rounded members are rounded up.
 */
typedef struct cylint_packed_disc {
    double base[3], axis[3];
    float across[2]; /* reach across the axis at z = 0 and 1 */
    uint16_t slope;  /* reach along the axis / reach across: a half float */
    uint8_t ends;    /* a cylint_ends */
    uint8_t solid;   /* 1: a cylinder with both caps */
    uint32_t number; /* of the shape */
} cylint_packed_disc;

cylint_packed_disc cylint_packed_disc_of(const cylint_swept_disc *disc,
                                         const cylint_shape *shape,
                                         uint32_t number);

void cylint_swept_disc_of(cylint_swept_disc *disc, const cylint_view *view,
                          uint32_t number);

/* Writes reach[j]: the section at z reaches k(z) reach[j] from its centre along
 * coordinate j. */
void cylint_swept_disc_reach(const cylint_swept_disc *disc, double reach[3]);

/* The section at z touches the surface of a round shape at a z that differs by
 * the slope of the radius k (k1 - k0) / length^2, at most by this. */
static inline double cylint_section_shift(double k0, double k1, double square)
{
    const double slack = 1 + 0x1p-10; /* for k0 and k1 as floats */
    const double growth = fabs(k1 - k0);
    return growth > 0 ? cylint_larger(k0, k1) * growth / square * slack : 0;
}

/* The z range of a piece, and its box.  Pieces overlap by 2^-20 of their
 * length, so that a z with a rounding error still lies in the piece that
 * cylint_piece_at() returns. */
void cylint_piece_ends(cylint_piece piece, double shift, double z[2]);
cylint_extent cylint_piece_box(const cylint_swept_disc *disc,
                               const double reach[3], cylint_piece piece);

/* The box of a whole shape. */
cylint_extent cylint_swept_disc_box(const cylint_view *view, uint32_t number);

/* The index of the piece that contains z.  The first and the last piece have
 * the round ends, where z is below 0 and above 1. */
static inline int cylint_piece_at(double z, int count)
{
    const int index = z > 0 ? (z < 1 ? (int)(z * count) : count) : 0;
    return index < count ? index : count - 1;
}

#endif
