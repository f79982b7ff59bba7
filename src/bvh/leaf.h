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
typedef struct cylint_block {
    float center[3];               /* of the pieces' box */
    uint16_t steps;                /* a unit: the upper half of a float */
    uint8_t used;                  /* lanes; and CYLINT_SOLID */
    uint8_t always;                /* bits: lanes without a cylinder */
    uint32_t p[2][CYLINT_BLOCK];   /* x, y, z: CYLINT_MIDDLE + steps, from the
                                      last bits on; and two bits of count */
    uint16_t r[CYLINT_BLOCK];      /* ends, index of the piece, steps */
    uint32_t number[CYLINT_BLOCK]; /* of the shape */
} cylint_block;

/* In the numbers above. */
enum {
    CYLINT_P_BITS = 10,
    CYLINT_P_MASK = 1023,
    CYLINT_MIDDLE = 512,
    CYLINT_R_BITS = 10,
    CYLINT_R_MASK = 1023
};

/* All pieces are those of cylinders with both caps. */
enum { CYLINT_SOLID = 0x80 };

/* Fills a block with 1 to 8 pieces, of a stem and in a box each; blur as in
 * cylint_view. */
void cylint_block_fill(cylint_block *block, const cylint_stem *stems,
                       const cylint_box *boxes, int used, double blur);

static inline cylint_piece cylint_block_piece(const cylint_block *b, int lane)
{
    return (cylint_piece){
        b->r[lane] >> CYLINT_R_BITS & 15,
        (int)(b->p[0][lane] >> 30 | b->p[1][lane] >> 30 << 2) + 1};
}

static inline int cylint_block_used(const cylint_block *b)
{
    return b->used & ~CYLINT_SOLID;
}

/* cylint_ends of the shape. */
static inline int cylint_block_ends(const cylint_block *b, int lane)
{
    return b->r[lane] >> (CYLINT_R_BITS + 4);
}

/* Steps a unit. */
static inline float cylint_block_steps(const cylint_block *b)
{
    return cylint_float_of_half(b->steps);
}

/*
 * Whether a hit at z on the lane's shape is that lane's to report.  Of all
 * pieces of a shape exactly one has each hit, so that nothing is told twice;
 * that one's lane is never left out while t is in the domain.
 */
static inline int cylint_block_owns(const cylint_block *block, int lane,
                                    double z)
{
    const cylint_piece piece = cylint_block_piece(block, lane);
    return cylint_piece_at(z, piece.count) == piece.index;
}

#endif
