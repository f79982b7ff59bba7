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
typedef struct cylint_members {
    const cylint_view *view;
    const uint32_t *numbers;
    size_t n;
    int threads;
    const cylint_memory_source *source;
} cylint_members;

/* A stem of every shape, and a box of every piece, in the order of shapes. */
typedef struct cylint_cut {
    cylint_memory stem_memory, box_memory;
    cylint_stem *stem;
    cylint_box *box;
    size_t n;          /* pieces */
    cylint_extent all; /* about them */
} cylint_cut;

typedef enum cylint_cut_status {
    CYLINT_CUT_OK,
    CYLINT_CUT_ESHAPE, /* not bounded, its box not one to be kept, or number
                           2^32 - 1 */
    CYLINT_CUT_EMEMORY /* refused */
} cylint_cut_status;

/* By exactly m->threads, at most CYLINT_CREW_MOST.  *refused: the first shape
 * for ESHAPE.  The cut is to be freed however it went. */
cylint_cut_status cylint_cut_shapes(cylint_cut *cut, const cylint_members *m,
                                    size_t *refused);

void cylint_cut_free(cylint_cut *cut);

#endif
