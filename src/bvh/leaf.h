/*
 * leaf.h - a leaf: up to 8 slices of shapes, tested together
 *
 * leaf_test.h computes in floats which of them a line may hit.
 * cylint_intersect() then decides.
 */
#ifndef CYLINT_BVH_LEAF_H
#define CYLINT_BVH_LEAF_H

#include <stdint.h>

#include "build.h"

/*
 * Each slice is bounded by a circular cylinder with the axis p[0] p[1] and the
 * radius r, conical and elliptic slices too.  If all slices are round, each is
 * bounded by a capsule instead, which has no corners.  Coordinates are relative
 * to the centre, and all lengths are whole numbers of steps: so 8 slices fit into
 * two cache lines.
 */
typedef struct cylint_leaf {
    float center[3]; /* of the slices' box */
    uint16_t steps;  /* steps per unit of length: a bfloat16 */
    uint8_t used;    /* the number of lanes in use, | CYLINT_LEAF_SOLID or
                        CYLINT_LEAF_ROUND */
    uint8_t always;  /* bits: lanes without a cylinder, which always pass */
    /* from the lowest bits: x, y, z as CYLINT_LEAF_MIDDLE + steps, then two
     * bits of the slice's count - 1 */
    uint32_t p[2][CYLINT_LEAF_SIZE];
    uint16_t r[CYLINT_LEAF_SIZE];      /* steps; the slice's index; ends */
    uint32_t number[CYLINT_LEAF_SIZE]; /* of the shape */
} cylint_leaf;

/* The layout of p and r. */
enum {
    CYLINT_LEAF_P_BITS = 10,
    CYLINT_LEAF_P_MASK = 1023,
    CYLINT_LEAF_MIDDLE = 512,
    CYLINT_LEAF_R_BITS = 10,
    CYLINT_LEAF_R_MASK = 1023
};

/* All slices belong to cylinders with both caps; all to round shapes. */
enum { CYLINT_LEAF_SOLID = 0x80, CYLINT_LEAF_ROUND = 0x40 };

/* Fills a leaf with `used` slices, 1 to 8; discs[i] is the swept disc of the shape
 * of boxes[i].  line_error as in cylint_view. */
void cylint_leaf_fill(cylint_leaf *leaf, const cylint_swept_disc *discs,
                      const cylint_boxed_slice *boxes, int used,
                      double line_error);

static inline cylint_slice cylint_leaf_slice(const cylint_leaf *b, int lane)
{
    return (cylint_slice){
        b->r[lane] >> CYLINT_LEAF_R_BITS & 15,
        (uint16_t)((b->p[0][lane] >> 30 | b->p[1][lane] >> 30 << 2) + 1)};
}

static inline int cylint_leaf_used(const cylint_leaf *b)
{
    return b->used & ~(CYLINT_LEAF_SOLID | CYLINT_LEAF_ROUND);
}

/* The shape's ends, a cylint_ends. */
static inline int cylint_leaf_ends(const cylint_leaf *b, int lane)
{
    return b->r[lane] >> (CYLINT_LEAF_R_BITS + 4);
}

/* Steps per unit of length. */
static inline float cylint_leaf_steps(const cylint_leaf *b)
{
    return cylint_float_of_bfloat16(b->steps);
}

#endif
