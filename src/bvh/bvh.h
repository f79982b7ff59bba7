/*
 * bvh.h - pieces of shapes, those that lie together in blocks, and nodes
 * above them
 */
#ifndef CYLINT_BVH_BVH_H
#define CYLINT_BVH_BVH_H

#include <stddef.h>

#include "leaf.h"
#include "split.h"
#include "memory.h"

typedef struct cylint_bvh {
    cylint_memory memory; /* of the blocks and nodes */
    const cylint_leaf *blocks;
    const cylint_node *nodes; /* above them, the first one first */
    size_t n;                 /* blocks; 0: there are no nodes */
    cylint_extent box;        /* of all, or of nothing */
    float center[3];          /* its middle: nodes' corners are from there */
    float pad;                /* what boxes may miss on each side, beside
                                  2^-20 of how far the line begins */
    float near_by;            /* how far from the centre that is not much */
} cylint_bvh;

/*
 * Groups the shapes, by as many threads as are wanted (cylint_threads_for()),
 * which all make of it the same.  Every piece of every shape is in one lane of
 * one block.  Where that is not OK nothing is left; *refused is the first
 * shape for ESHAPE.
 */
cylint_bvh_status cylint_bvh_build(cylint_bvh *group,
                                   const cylint_bvh_input *members,
                                   size_t *refused);

void cylint_bvh_free(cylint_bvh *group);

#endif
