/*
 * build.h - boxes into blocks of 8 that lie together, and nodes above them
 */
#ifndef CYLINT_BVH_BUILD_H
#define CYLINT_BVH_BUILD_H

#include <stddef.h>
#include <stdint.h>

enum { CYLINT_LEAF_SIZE = 8, CYLINT_CHILDREN = 8 };

/* The box of a piece of a shape. */
typedef struct cylint_boxed_piece {
    float lower[3];
    uint32_t stem; /* of which the piece is */
    float upper[3];
    uint16_t index, count; /* of the piece, among so many */
} cylint_boxed_piece;

/* The boxes of up to 8 nodes or blocks: from corner + step times face[0] to
 * corner + step times face[1], exactly.  Two cache lines. */
typedef struct cylint_node {
    float corner[3], step[3];
    uint8_t face[2][3][CYLINT_CHILDREN];
    uint32_t child[CYLINT_CHILDREN]; /* a node, or CYLINT_LEAF_FLAG | a block */
    uint8_t children;                /* bits: those that there are */
    uint8_t spare[23];
} cylint_node;

#define CYLINT_LEAF_FLAG 0x80000000u

/* No path from the first node to a block is longer: see DEEP in build.c; from
 * there on each node has an eighth of its parent's boxes, nearly. */
enum { CYLINT_BVH_DEPTH = 24 + 16 };

/* Room for nodes above so many blocks, at least one. */
size_t cylint_build_most_nodes(size_t blocks);

/*
 * Sorts n > 0 boxes so that the blocks [0, 8), [8, 16), ..., all full but the
 * last, are good leaves, and makes the nodes above them, the first one
 * first: from the top down, the boxes are split where the sum of area times
 * number of blocks is least, as far as bins and, of very many boxes, a sample
 * can tell, moved to the next multiple of 8.  Returns the number of nodes,
 * among which there are gaps.  The same for any number of threads.
 */
size_t cylint_build_nodes(cylint_node *nodes, cylint_boxed_piece *boxes,
                          size_t n, const float center[3], int threads);

/* The nodes without the gaps, each before those below it. */
void cylint_build_compact(cylint_node *to, const cylint_node *from);

#endif
