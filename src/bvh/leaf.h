/*
 * leaf.h - up to 8 pieces of shapes side by side
 *
 * Which of them a line may meet is told in floats (leaf_test.h); the answers
 * are for cylint_intersect() to give.
 */
#ifndef CYLINT_BVH_LEAF_H
#define CYLINT_BVH_LEAF_H

#include <stdint.h>

#include "build.h"
#include "swept_disc.h"

/*
 * Around the box's centre all lengths are whole numbers of steps, so two
 * cache lines hold 8 pieces: for each a circular cylinder, from axis point
 * p[0] to p[1] with radius r, that holds the piece.  Conical and elliptic
 * pieces are held by such cylinders too.
 */
typedef struct cylint_leaf {
    float center[3]; /* of the pieces' box */
    uint16_t steps;  /* a unit: the upper half of a float */
    uint8_t used;    /* lanes; and CYLINT_LEAF_SOLID */
    uint8_t always;  /* bits: lanes without a cylinder */
    uint32_t
        p[2][CYLINT_LEAF_SIZE]; /* x, y, z: CYLINT_LEAF_MIDDLE + steps, from the
                                      last bits on; and two bits of count */
    uint16_t r[CYLINT_LEAF_SIZE];      /* ends, index of the piece, steps */
    uint32_t number[CYLINT_LEAF_SIZE]; /* of the shape */
} cylint_leaf;

/* In the numbers above. */
enum {
    CYLINT_LEAF_P_BITS = 10,
    CYLINT_LEAF_P_MASK = 1023,
    CYLINT_LEAF_MIDDLE = 512,
    CYLINT_LEAF_R_BITS = 10,
    CYLINT_LEAF_R_MASK = 1023
};

/* All pieces are those of cylinders with both caps. */
enum { CYLINT_LEAF_SOLID = 0x80 };

/* Fills a block with 1 to 8 pieces, of a stem and in a box each; blur as in
 * cylint_view. */
void cylint_leaf_fill(cylint_leaf *block, const cylint_packed_disc *stems,
                      const cylint_boxed_piece *boxes, int used, double blur);

static inline cylint_piece cylint_leaf_piece(const cylint_leaf *b, int lane)
{
    return (cylint_piece){
        b->r[lane] >> CYLINT_LEAF_R_BITS & 15,
        (int)(b->p[0][lane] >> 30 | b->p[1][lane] >> 30 << 2) + 1};
}

static inline int cylint_leaf_used(const cylint_leaf *b)
{
    return b->used & ~CYLINT_LEAF_SOLID;
}

/* cylint_ends of the shape. */
static inline int cylint_leaf_ends(const cylint_leaf *b, int lane)
{
    return b->r[lane] >> (CYLINT_LEAF_R_BITS + 4);
}

/* Steps a unit. */
static inline float cylint_leaf_steps(const cylint_leaf *b)
{
    return cylint_float_of_half(b->steps);
}

/*
 * Whether a hit at z on the lane's shape is that lane's to report.  Of all
 * pieces of a shape exactly one has each hit, so that nothing is told twice;
 * that one's lane is never left out while t is in the domain.
 */
static inline int cylint_leaf_owns(const cylint_leaf *block, int lane, double z)
{
    const cylint_piece piece = cylint_leaf_piece(block, lane);
    return cylint_piece_at(z, piece.count) == piece.index;
}

#endif
