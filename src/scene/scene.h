/*
 * scene.h - the members of a scene
 */
#ifndef CYLINT_SCENE_SCENE_H
#define CYLINT_SCENE_SCENE_H

#include <math.h>
#include <stdint.h>

#include "cylint_scene.h"
#include "../bvh/traverse.h"
#include "frame.h"
#include "records.h"
#include "solids.h"

enum { CYLINT_SCENE_MOST_SHAPES = 1 << 28 };

struct cylint_scene {
    cylint_records records;
    size_t n;
    int is_finished;
    cylint_frame frame;
    cylint_view view; /* the shapes in the frame */
    cylint_bvh bvh;
    const cylint_traversal *traversal;
    const uint32_t
        *bounded; /* numbers of the shapes in the hierarchy; NULL: all */
    const uint32_t *others; /* numbers of the other shapes, ascending */
    size_t n_bounded, n_others;
    cylint_shape *copies; /* of the other shapes, in a pack */
    void *pack_memory;
    cylint_pack pack;
    double built_cost;          /* of the hierarchy; 0: it is as it was built */
    size_t own_bytes;           /* without the hierarchy's */
    cylint_scene_labels labels; /* end is NULL: none */
    cylint_solids solids;
    cylint_membership *given; /* the members of solids, unless in the file */
    cylint_memory file; /* of an opened scene; then the records, the hierarchy,
                            the lists and the labels lie in it */
};

/* The box of n shapes that a frame can contain. */
typedef struct cylint_shapes_box {
    double lo[3], hi[3];
    size_t n;
} cylint_shapes_box;

#define CYLINT_NO_BOX                                                        \
    {                                                                        \
        {HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}, 0 \
    }

/* Extends the box by a shape.  Returns 0 if no frame can contain the shape. */
int cylint_extend_by_shape(cylint_shapes_box *box, const cylint_shape *shape);

/* The number of shape i of those in the hierarchy. */
static inline size_t cylint_bounded_number(const cylint_scene *scene, size_t i)
{
    return scene->bounded ? scene->bounded[i] : i;
}

/* Sets the view to that of the frame. */
void cylint_scene_set_view(cylint_scene *scene);

/* Writes the shapes that are not in the hierarchy into their pack. */
void cylint_scene_pack_others(cylint_scene *scene);

/* Makes the parts of a scene that are not in its file: its functions and its
 * pack.  All other members are set.  Returns 0 if there is no memory. */
int cylint_scene_complete(cylint_scene *scene);

/* The first of n ascending numbers that is not below x; n: there is none. */
static inline size_t cylint_first_not_below(const uint32_t *numbers, size_t n,
                                            size_t x)
{
    size_t from = 0;
    while (from < n) {
        const size_t middle = from + (n - from) / 2;
        if (numbers[middle] < x)
            from = middle + 1;
        else
            n = middle;
    }
    return from;
}

/* The place of the checksum in the file, in bytes. */
enum { CYLINT_FILE_CHECKSUM = 32 };

/* The checksum of a file of at least 512 bytes, a multiple of 64, at the begin of
 * a cache line.  It does not depend on the bytes at the checksum's place. */
uint64_t cylint_file_checksum(const void *data, size_t bytes);

/* Writes the result to *status, unless it is NULL.  Returns the scene, or frees
 * it and returns NULL if the result is a failure. */
cylint_scene *cylint_scene_or_null(cylint_scene *scene,
                                   cylint_scene_status result,
                                   cylint_scene_status *status);

#endif
