/*
 * sort.h - boxes into an order in which each 8 lie together
 */
#ifndef CYLINT_EMBREE_SORT_H
#define CYLINT_EMBREE_SORT_H

#include <stddef.h>
#include <stdint.h>

enum { CYLINT_BLOCK = 8 };

/* The box of a piece of a shape. */
typedef struct cylint_box {
    float lower[3];
    uint32_t number;       /* of the shape */
    float upper[3];
    uint16_t index, count; /* of the piece, among so many */
} cylint_box;

/*
 * Sorts n boxes, so that the blocks [0, 8), [8, 16), ... , all full but the
 * last, are good leaves of a hierarchy: from the top down, the boxes are
 * split where the sum of area times number of blocks is least, as far as bins
 * can tell, moved to the next multiple of 8.
 */
void cylint_sort_boxes(cylint_box *boxes, size_t n);

#endif
