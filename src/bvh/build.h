/*
 * build.h - boxes into blocks of 8 that lie together, and nodes above them
 */
#ifndef CYLINT_BVH_BUILD_H
#define CYLINT_BVH_BUILD_H

#include <stddef.h>
#include <stdint.h>

enum { CYLINT_BLOCK = 8, CYLINT_CHILDREN = 8 };

/* The box of a piece of a shape. */
typedef struct cylint_box {
    float lower[3];
    uint32_t stem; /* of which the piece is */
    float upper[3];
    uint16_t index, count; /* of the piece, among so many */
} cylint_box;

/* The boxes of up to 8 nodes or blocks: from corner + step times face[0] to
 * corner + step times face[1], exactly.  Two cache lines. */
typedef struct cylint_node {
    float corner[3], step[3];
    uint8_t face[2][3][CYLINT_CHILDREN];
    uint32_t child[CYLINT_CHILDREN]; /* a node, or CYLINT_LEAF | a block */
    uint8_t children;                /* bits: those that there are */
    uint8_t spare[23];
} cylint_node;

#define CYLINT_LEAF 0x80000000u

/* No path from the first node to a block is longer: see DEEP in build.c; from
 * there on each node has an eighth of its parent's boxes, nearly. */
enum { CYLINT_DEPTH = 24 + 16 };

/* Room for nodes above so many blocks, at least one. */
size_t cylint_tree_most_nodes(size_t blocks);

/*
 * Sorts n > 0 boxes so that the blocks [0, 8), [8, 16), ..., all full but the
 * last, are good leaves, and makes the nodes above them, the first one
 * first: from the top down, the boxes are split where the sum of area times
 * number of blocks is least, as far as bins and, of very many boxes, a sample
 * can tell, moved to the next multiple of 8.  Returns the number of nodes,
 * among which there are gaps.  The same for any number of threads.
 */
size_t cylint_tree_build(cylint_node *nodes, cylint_box *boxes, size_t n,
                         const float center[3], int threads);

/* The nodes without the gaps, each before those below it. */
void cylint_tree_copy(cylint_node *to, const cylint_node *from);

#endif
