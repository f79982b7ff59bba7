/*
 * swept_disc.h - what all bounded shapes look like from far: discs along an axis
 *
 * The section at z is centred at base + z axis.  With k(z) = k0 + (k1-k0) z
 * it reaches k(z) across from the axis' line and k(z) along along that.
 */
#ifndef CYLINT_BVH_SWEPT_DISC_H
#define CYLINT_BVH_SWEPT_DISC_H

#include "float_bounds.h"
#include "cylint.h"

typedef struct cylint_swept_disc {
    double base[3], axis[3];
    double k[2];
    double across, along;
    double length;     /* of the axis */
    double a[3], b[3]; /* of elliptic shapes */
    int elliptic;
} cylint_swept_disc;

/* Whether it looks like that. */
static inline int cylint_is_bounded(const cylint_shape *s)
{
    return s->kind != CYLINT_KIND_NONE && s->ends < CYLINT_ENDS_INFINITE;
}

/* A piece of a shape: number `index` of `count` equal ones along z. */
typedef struct cylint_piece {
    int index, count;
} cylint_piece;

/* Shapes in coordinates (x - center) scale, scale a power of two.  `blur` is
 * how far, in these, a line is from where it is said to be. */
typedef struct cylint_view {
    const cylint_shape *shapes;
    double center[3], scale, blur;
} cylint_view;

/* The shapes as they are. */
static inline cylint_view cylint_plain_view(const cylint_shape *shapes)
{
    return (cylint_view){.shapes = shapes, .scale = 1};
}

/*
 * What a block needs of a trunk, in a cache line: when blocks are filled their
 * shapes lie here and there, and the shapes are large and the caller's, on
 * small pages.  Numbers that are rounded are no smaller than in the trunk.
 */
typedef struct cylint_packed_disc {
    double base[3], axis[3];
    float across[2]; /* reach across the axis at z = 0 and 1 */
    uint16_t slant;  /* reach along it, in multiples of that: half a float */
    uint8_t ends;    /* cylint_ends */
    uint8_t solid;   /* 1: a cylinder with both caps */
    uint32_t number; /* of the shape */
} cylint_packed_disc;

cylint_packed_disc cylint_packed_disc_of(const cylint_swept_disc *trunk,
                                         const cylint_shape *shape,
                                         uint32_t number);

void cylint_swept_disc_of(cylint_swept_disc *trunk, const cylint_view *view,
                          uint32_t number);

/* The section at z reaches k(z) reach[j] from its centre along coordinate j. */
void cylint_swept_disc_reach(const cylint_swept_disc *trunk, double reach[3]);

/* z of the ends of a piece, and a box that holds it, a little longer: pieces
 * overlap by 2^-20 of their length, so that a z that is not quite right
 * still lies in the piece it seems to. */
void cylint_piece_ends(cylint_piece piece, double z[2]);
cylint_extent cylint_piece_box(const cylint_swept_disc *trunk,
                               const double reach[3], cylint_piece piece);

/* That of all of a shape. */
cylint_extent cylint_swept_disc_box(const cylint_view *view, uint32_t number);

/* The piece that z, in [0, 1], belongs to. */
static inline int cylint_piece_at(double z, int count)
{
    const int index = (int)(z * count);
    return index < count ? index : count - 1;
}

#endif
