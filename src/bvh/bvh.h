/*
 * bvh.h - a bounding volume hierarchy over slices of shapes: builds it (bvh.c),
 * adapts it to shapes that have moved (refit.c), checks one of a file (sound.c)
 */
#ifndef CYLINT_BVH_BVH_H
#define CYLINT_BVH_BVH_H

#include <stddef.h>

#include "leaf.h"
#include "memory.h"
#include "watch.h"

typedef struct cylint_bvh {
    cylint_memory node_memory, leaf_memory;
    const cylint_leaf *leaves; /* NULL if there are none */
    const cylint_node *nodes;  /* the root first */
    size_t n_leaves, n_nodes;  /* 0 and 0, or neither */
    cylint_extent box;         /* of all shapes, empty if there are none */
    float center[3];           /* of the box: the origin of nodes' corners */
    float pad;                 /* the error of each side of a box, beside 2^-19
                                  of the distance of the line's origin */
    float longest;             /* side of the box */
    float least_step;          /* of nodes */
} cylint_bvh;

/* The n shapes with the given numbers (NULL: numbers 0 to n - 1), the number of
 * threads that build the hierarchy, the source of its memory, and its watch,
 * NULL for none. */
typedef struct cylint_bvh_input {
    const cylint_view *view;
    const uint32_t *numbers;
    size_t n;
    int threads;
    const cylint_memory_source *source;
    cylint_watch *watch;
} cylint_bvh_input;

typedef enum cylint_bvh_status {
    CYLINT_BVH_OK,
    CYLINT_BVH_ESHAPE,  /* a shape is unbounded, its box is invalid, or its
                          number is 2^32 - 1 */
    CYLINT_BVH_EMEMORY, /* out of memory */
    CYLINT_BVH_ESTOPPED /* by the watch */
} cylint_bvh_status;

/*
 * Builds a hierarchy on as many threads as cylint_threads_for() allows; the
 * result does not depend on their number.  Each slice of each shape is in one
 * lane of one leaf.  On failure nothing stays allocated; for ESHAPE *refused
 * is the first such shape.
 */
cylint_bvh_status cylint_bvh_build(cylint_bvh *bvh,
                                   const cylint_bvh_input *input,
                                   size_t *refused);

/* Ranks shapes 0 to n - 1 in the order in which leaves first name them, then those
 * in no leaf: number[] of each rank, rank[] of each number.  Replaces the numbers
 * in the leaves, which no query uses yet, by ranks.  Returns how many are in
 * leaves. */
size_t cylint_bvh_rank(cylint_bvh *bvh, size_t n, uint32_t *number,
                       uint32_t *rank);

/* Sets the members that follow from the box. */
void cylint_bvh_set_box(cylint_bvh *bvh, const cylint_extent *box,
                        double line_error);

void cylint_bvh_free(cylint_bvh *bvh);

/*
 * Shapes [first, first + n) have moved, within the box of the hierarchy.  Their
 * slices stay in their lanes; leaves that contain one, and the nodes above these,
 * are bounded again.  No box is larger than a new build over the same leaves would
 * make it, but for up to two steps of the faces of each node below.  before: a box
 * that contains the boxes of these slices as they were; NULL: all space.  Returns
 * the box of all shapes, if any of them has moved.
 */
cylint_extent cylint_bvh_refit(cylint_bvh *bvh, const cylint_view *view,
                               uint32_t first, uint32_t n,
                               const cylint_extent *before);

/* The mean number of nodes and leaves that a traversal visits for a random line
 * through the centre of one of their boxes.  After a refit the boxes are those of
 * the same nodes. */
double cylint_bvh_cost(const cylint_bvh *bvh);

/*
 * Whether the nodes and leaves form a tree as cylint_bvh_build() makes it: each is
 * in it once, in this order, no path is longer than CYLINT_BVH_DEPTH, all numbers
 * of shapes are less than n, and all floats are finite.  Then a traversal ends, and
 * reads nothing outside.  The boxes are not compared with the shapes.
 */
int cylint_bvh_is_sound(const cylint_bvh *bvh, size_t n);

#endif
