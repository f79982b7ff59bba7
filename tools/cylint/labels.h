/*
 * labels.h - the tails of a scene's lines: names of its shapes
 *
 * They are kept only where a column or a record needs them.
 */
#ifndef CYLINT_LABELS_H
#define CYLINT_LABELS_H

#include <stddef.h>

#include "scene.h"

/* Zero it before use. */
struct labels {
    char *bytes; /* of all labels, one after the other */
    size_t length, room;
    size_t *end; /* of each shape's label in bytes */
    size_t count, places;
    size_t longest; /* bytes of the longest label */
};

struct label {
    const char *text;
    size_t length;
};

/* Sees to it that scene_read() keeps the labels here. */
void labels_keep(struct labels *labels, struct scene *scene);
void labels_free(struct labels *labels);

/* The label of a shape, from 0; its length is 0 if the shape has none. */
struct label labels_get(const struct labels *labels, size_t shape);

#endif
