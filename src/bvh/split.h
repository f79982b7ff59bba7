/*
 * split.h - splits shapes into pieces with tight boxes
 */
#ifndef CYLINT_BVH_SPLIT_H
#define CYLINT_BVH_SPLIT_H

#include <stddef.h>

#include "memory.h"
#include "build.h"
#include "swept_disc.h"
#include "watch.h"

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

/* The box of every piece, in the order of shapes, in memory that has room for the
 * leaves of these pieces too. */
typedef struct cylint_split {
    cylint_memory memory;
    cylint_boxed_piece *box;
    size_t n;          /* pieces */
    cylint_extent all; /* the box of all pieces */
} cylint_split;

static inline cylint_boxed_piece cylint_boxed(const cylint_extent *box,
                                              uint32_t number,
                                              cylint_shape_piece piece)
{
    return (cylint_boxed_piece){{box->lower[0], box->lower[1], box->lower[2]},
                                number,
                                {box->upper[0], box->upper[1], box->upper[2]},
                                (uint16_t)piece.index,
                                (uint16_t)piece.count};
}

typedef enum cylint_bvh_status {
    CYLINT_BVH_OK,
    CYLINT_BVH_ESHAPE,  /* a shape is unbounded, its box is invalid, or its
                          number is 2^32 - 1 */
    CYLINT_BVH_EMEMORY, /* out of memory */
    CYLINT_BVH_ESTOPPED /* by the watch */
} cylint_bvh_status;

/* Uses exactly input->threads threads, at most CYLINT_THREADS_MOST.  For ESHAPE
 * *refused is the first such shape.  The caller frees the memory after a failure
 * too. */
cylint_bvh_status cylint_split_shapes(cylint_split *split,
                                      const cylint_bvh_input *input,
                                      size_t *refused);

#endif
