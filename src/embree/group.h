/*
 * group.h - shapes cut into pieces, pieces that lie together in blocks, and
 * nodes above them
 */
#ifndef CYLINT_EMBREE_GROUP_H
#define CYLINT_EMBREE_GROUP_H

#include <stddef.h>

#include "block.h"
#include "memory.h"

typedef struct cylint_group {
    cylint_memory memory;      /* of the blocks and nodes */
    const cylint_block *blocks;
    const cylint_node *nodes;  /* above them, the first one first */
    size_t n;                  /* blocks; 0: there are no nodes */
    float center[3];           /* of the box of all: nodes' corners are from
                                  there */
    float pad;                 /* what boxes may miss on each side, beside
                                  2^-20 of how far the line begins */
    float near_by;             /* how far from the centre that is not much */
} cylint_group;

/*
 * Groups the n shapes of the given numbers (NULL: those from 0 on), all
 * bounded and with boxes that Embree keeps; n < 2^32 - 1.  Returns 0 where
 * memory was refused: nothing is left.
 * Every piece of every shape is in one lane of one block.
 */
int cylint_group_make(cylint_group *group, RTCDevice device,
                      const cylint_view *view, const uint32_t *numbers,
                      size_t n);

void cylint_group_free(cylint_group *group);

#endif
