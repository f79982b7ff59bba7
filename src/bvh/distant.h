/*
 * distant.h - finds the few shapes that are far from all others, or much larger
 *
 * They are beside the hierarchy: with them, its floats would not distinguish the
 * others.
 */
#ifndef CYLINT_BVH_DISTANT_H
#define CYLINT_BVH_DISTANT_H

#include <stddef.h>

#include "bvh.h"

/* Shapes with larger coordinates are in no box, so that nothing overflows. */
#define CYLINT_BOX_MOST 0x1p400

/* The box of n shapes. */
typedef struct cylint_shapes_box {
    double lo[3], hi[3];
    size_t n;
} cylint_shapes_box;

#define CYLINT_NO_BOX                                                        \
    {                                                                        \
        {HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}, 0 \
    }

/* Adds a shape to the box.  Returns 0, and adds nothing, if no box can contain the
 * shape. */
int cylint_extend_by_shape(cylint_shapes_box *box, const cylint_shape *shape);

/* Finds which of the n shapes of a view shall be in the hierarchy: those in a box,
 * of all but a few, or of all space.  all: the box of all.  Returns whether all lie
 * in the box. */
int cylint_choose_box(cylint_shapes_box *inner, const cylint_view *view,
                      size_t n, const cylint_shapes_box *all);

/* Lists the shapes in the chosen box, and sets their own box.  Returns how many
 * there are, or SIZE_MAX if the watch stops. */
size_t cylint_list_near(const cylint_view *view, size_t n,
                        const cylint_shapes_box *inner, cylint_watch *watch,
                        uint32_t *number, cylint_shapes_box *box);

/* Builds a hierarchy of all shapes of the input and, if a few are distant, again
 * without them.  *all: the box of all.  number: memory for input->n numbers, not
 * used afterwards.  Returns what cylint_bvh_build() returns. */
cylint_bvh_status cylint_bvh_build_near(cylint_bvh *bvh,
                                        const cylint_bvh_input *input,
                                        uint32_t *number, size_t *refused,
                                        cylint_extent *all);

#endif
