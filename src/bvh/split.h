/*
 * split.h - shapes cut into pieces that their boxes are tight about
 */
#ifndef CYLINT_BVH_SPLIT_H
#define CYLINT_BVH_SPLIT_H

#include <stddef.h>

#include "memory.h"
#include "build.h"
#include "swept_disc.h"

/* n shapes of the given numbers (NULL: those from 0 on), for so many threads,
 * with memory from the source. */
typedef struct cylint_bvh_input {
    const cylint_view *view;
    const uint32_t *numbers;
    size_t n;
    int threads;
    const cylint_memory_source *source;
} cylint_bvh_input;

/* A stem of every shape, and a box of every piece, in the order of shapes. */
typedef struct cylint_split {
    cylint_memory stem_memory, box_memory;
    cylint_packed_disc *stem;
    cylint_boxed_piece *box;
    size_t n;          /* pieces */
    cylint_extent all; /* about them */
} cylint_split;

typedef enum cylint_bvh_status {
    CYLINT_BVH_OK,
    CYLINT_BVH_ESHAPE, /* not bounded, its box not one to be kept, or number
                           2^32 - 1 */
    CYLINT_BVH_EMEMORY /* refused */
} cylint_bvh_status;

/* By exactly m->threads, at most CYLINT_THREADS_MOST.  *refused: the first shape
 * for ESHAPE.  The cut is to be freed however it went. */
cylint_bvh_status cylint_split_shapes(cylint_split *cut,
                                      const cylint_bvh_input *m,
                                      size_t *refused);

void cylint_split_free(cylint_split *cut);

#endif
