/*
 * boxes.h - the boxes of a scene's bounded shapes
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
    struct vector middle; /* of the box of all shapes */
    double size;          /* the diagonal of that box; 0: no shape is bounded */
};

/* Returns 0 or an exit status. */
int boxes_make(struct boxes *boxes, const struct scene *scene);
void boxes_free(struct boxes *boxes);

struct vector box_middle(const struct box *box);

/* The maximum of direction . point over all boxes. */
double reach(const struct boxes *boxes, struct vector direction);

#endif
