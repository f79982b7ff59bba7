/*
 * block.h - up to 8 pieces of shapes side by side
 *
 * Which of them a line may meet a block answers in floats (lanetest.h); the
 * answers are for cylint_intersect() to give.
 */
#ifndef CYLINT_EMBREE_BLOCK_H
#define CYLINT_EMBREE_BLOCK_H

#include <stdint.h>

#include "tree.h"
#include "trunk.h"

/*
 * Around the box's centre all lengths are whole numbers of steps, so three
 * cache lines hold 8 pieces: for each a circular cylinder, from axis point
 * p[0] to p[1] with radius r, that holds the piece.  Conical and elliptic
 * pieces are held by such cylinders too.
 */
typedef struct cylint_block {
    float center[3];               /* of the pieces' box */
    float per_unit;                /* steps per unit of length: 2^k */
    int16_t p[2][3][CYLINT_BLOCK];
    int16_t r[CYLINT_BLOCK];
    uint32_t number[CYLINT_BLOCK]; /* of the shape */
    uint8_t piece[CYLINT_BLOCK];   /* of it: index, and 16 (count - 1) */
    uint8_t used;                  /* lanes */
    uint8_t always;                /* bits: lanes without a cylinder */
    uint8_t spare[22];             /* to the end of a cache line */
} cylint_block;

/* Fills a block with 1 to 8 pieces, of a stem and in a box each; blur as in
 * cylint_view. */
void cylint_block_fill(cylint_block *block, const cylint_stem *stems,
                       const cylint_box *boxes, int used, double blur);

static inline cylint_piece cylint_block_piece(const cylint_block *b, int lane)
{
    return (cylint_piece){b->piece[lane] & 15, (b->piece[lane] >> 4) + 1};
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
