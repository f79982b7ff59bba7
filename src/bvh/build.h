/*
 * build.h - builds the nodes of a bounding volume hierarchy over boxes
 */
#ifndef CYLINT_BVH_BUILD_H
#define CYLINT_BVH_BUILD_H

#include <stddef.h>
#include <stdint.h>

#include "swept_disc.h"
#include "watch.h"

/* Slices in a leaf, children of a node. */
enum { CYLINT_LEAF_SIZE = 8, CYLINT_CHILDREN = 8 };

/* The box of a slice of a shape. */
typedef struct cylint_boxed_slice {
    cylint_extent box;
    uint32_t number; /* of the shape */
    cylint_slice slice;
} cylint_boxed_slice;

/* The boxes of up to 8 children.  A box reaches from corner + step face[0] to
 * corner + step face[1], exactly.  Two cache lines. */
typedef struct cylint_node {
    float corner[3], step[3];
    uint8_t face[2][3][CYLINT_CHILDREN];
    uint32_t child[CYLINT_CHILDREN]; /* a node, or CYLINT_LEAF_FLAG | a leaf */
    uint8_t children, leaves; /* bits: children that exist; that are leaves */
    uint8_t spare[22];
} cylint_node;

#define CYLINT_LEAF_FLAG 0x80000000u

/* The most nodes on a path from the root to a leaf.  Below depth 24 (EVEN_DEPTH
 * in build.c) a node has about an eighth of its parent's boxes. */
enum { CYLINT_BVH_DEPTH = 24 + 16 };

/* The most children that wait to be visited at any time. */
enum { CYLINT_STACK_SIZE = CYLINT_BVH_DEPTH * (CYLINT_CHILDREN - 1) + 1 };

/* The leaves of these slices. */
static inline size_t cylint_leaves_for(size_t slices)
{
    return (slices + CYLINT_LEAF_SIZE - 1) / CYLINT_LEAF_SIZE;
}

/* The most nodes that a hierarchy over this number of leaves has, at least one. */
size_t cylint_build_most_nodes(size_t leaves);

/*
 * Sorts n > 0 boxes, so that [0, 8), [8, 16), ... are leaves, all full but the
 * last, and writes the nodes above them, the root first.  It splits from the
 * top down where the sum of area times number of leaves is least.  Bins, and
 * for many boxes a sample, approximate that place, which is then moved to the
 * nearest multiple of 8.  Returns the number of nodes, each of which stands before
 * its children, or 0 if the watch stops it.  The result does not depend on the
 * number of threads.
 */
size_t cylint_build_nodes(cylint_node *nodes, cylint_boxed_slice *boxes,
                          size_t n, const float center[3], float least_step,
                          int threads, cylint_watch *watch);

/* Writes the corner, relative to the centre of the hierarchy, the steps and the
 * faces of n children with these boxes. */
void cylint_node_place(cylint_node *node, const cylint_extent *boxes, int n,
                       const float center[3], float least_step);

/* Writes the faces of a child, rounded outward to whole steps from the corner. */
void cylint_node_place_child(cylint_node *node, int child,
                             const cylint_extent *box, const float center[3]);

#endif
