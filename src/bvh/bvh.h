/*
 * bvh.h - a bounding volume hierarchy over pieces of shapes
 */
#ifndef CYLINT_BVH_BVH_H
#define CYLINT_BVH_BVH_H

#include <stddef.h>

#include "leaf.h"
#include "split.h"
#include "memory.h"

typedef struct cylint_bvh {
    cylint_memory node_memory, leaf_memory;
    const cylint_leaf *leaves; /* NULL if there are none */
    const cylint_node *nodes;  /* the root first */
    size_t n_leaves, n_nodes;  /* 0 and 0, or neither */
    cylint_extent box;         /* of all shapes, empty if there are none */
    float center[3];           /* of the box: the origin of nodes' corners */
    float pad;                 /* the error of each side of a box, beside 2^-20
                                  of the distance of the line's origin */
    float near_distance;       /* origins within it are near the centre */
} cylint_bvh;

/*
 * Builds a hierarchy on as many threads as cylint_threads_for() allows; the
 * result does not depend on their number.  Each piece of each shape is in one
 * lane of one leaf.  On failure nothing stays allocated; for ESHAPE *refused
 * is the first such shape.
 */
cylint_bvh_status cylint_bvh_build(cylint_bvh *bvh,
                                   const cylint_bvh_input *input,
                                   size_t *refused);

/* Sets the members that follow from the box. */
void cylint_bvh_set_box(cylint_bvh *bvh, const cylint_extent *box,
                        double line_error);

void cylint_bvh_free(cylint_bvh *bvh);

#endif
