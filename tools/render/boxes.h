/*
 * boxes.h - the boxes of a scene's bounded solids
 *
 * A shape that is in no solid is itself a solid.  The box of a solid contains it:
 * it is the common part of the boxes of its clauses.
 */
#ifndef CYLINT_BOXES_H
#define CYLINT_BOXES_H

#include <stddef.h>

#include "vector.h"

struct scene;

struct box {
    struct vector low, high;
};

struct boxes {
    struct box *box;
    size_t count;
    struct vector middle; /* of the box of all */
    double size;          /* the diagonal of that box; 0: none is bounded */
};

/* Sorts the members of solids.  Returns 0 or an exit status. */
int boxes_make(struct boxes *boxes, const struct scene *scene);
void boxes_free(struct boxes *boxes);

struct vector box_middle(const struct box *box);

/* The maximum of direction . point over all boxes. */
double reach(const struct boxes *boxes, struct vector direction);

#endif
