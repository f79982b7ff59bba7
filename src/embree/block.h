/*
 * block.h - up to 8 pieces of shapes side by side, and which of them a line
 * may meet
 *
 * A block answers in floats, conservatively: a lane is left out only if the
 * line certainly does not meet its piece within the domain.  Lines come in
 * doubles and are moved to the block's centre in doubles, so a block is as
 * discerning far from the origin as near it.  The answers are for
 * cylint_intersect() to give.
 */
#ifndef CYLINT_EMBREE_BLOCK_H
#define CYLINT_EMBREE_BLOCK_H

#include <stdint.h>

#include "trunk.h"

enum { CYLINT_BLOCK = 8 };

/*
 * Around `center` all lengths are whole numbers of steps, so three cache
 * lines hold 8 pieces: for each a circular cylinder, from axis point p[0] to
 * p[1] with radius r, that holds the piece.  Conical and elliptic pieces are
 * held by such cylinders too.
 */
typedef struct cylint_block {
    float center[3];
    float per_unit;                /* steps per unit of length: 2^k */
    int16_t p[2][3][CYLINT_BLOCK];
    int16_t r[CYLINT_BLOCK];
    uint32_t number[CYLINT_BLOCK]; /* of the shape */
    uint8_t index[CYLINT_BLOCK];   /* of the piece ... */
    uint8_t count[CYLINT_BLOCK];   /* ... among so many */
    uint8_t used;                  /* lanes */
    uint8_t always;                /* bits: lanes without a cylinder */
    uint8_t spare[14];
} cylint_block;

/* What goes into a block. */
typedef struct cylint_block_entry {
    uint32_t number;
    cylint_piece piece;
} cylint_block_entry;

/* Fills a block with 1 to 8 pieces, whose boxes lie within `box`. */
void cylint_block_fill(cylint_block *block, const cylint_view *view,
                       const cylint_block_entry *entries, int used,
                       const struct RTCBounds *box);

/* A box around the block's pieces. */
void cylint_block_box(const cylint_block *block, const cylint_view *view,
                      struct RTCBounds *box);

/*
 * The lanes (bits) whose pieces o + t d may meet within tmin <= t <= tmax;
 * least[lane] is then no larger than the least such t.  d as it is or off by
 * 2^-52 of its length (the high parts of a segment's).
 */
typedef unsigned cylint_block_test(const cylint_block *block,
                                   const double o[3], const double d[3],
                                   double tmin, double tmax,
                                   double least[CYLINT_BLOCK]);

/* The build for this processor. */
cylint_block_test *cylint_block_test_used(void);

/* The builds. */
extern cylint_block_test cylint_block_test_plain, cylint_block_test_avx2;

/*
 * Whether a hit at z on the lane's shape is that lane's to report.  Of all
 * pieces of a shape exactly one has each hit, so that nothing is told twice;
 * that one's lane is never left out while t is in the domain.
 */
static inline int cylint_block_owns(const cylint_block *block, int lane,
                                    double z)
{
    return block->count[lane] == 1 ||
           cylint_piece_at(z, block->count[lane]) == block->index[lane];
}

#endif
