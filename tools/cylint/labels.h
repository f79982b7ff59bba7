/*
 * labels.h - the tails of a scene's lines: names of its shapes
 *
 * They are kept only if a column or a record needs them.
 */
#ifndef CYLINT_LABELS_H
#define CYLINT_LABELS_H

#include <stddef.h>

#include "scene.h"

/* Zero it before use. */
struct labels {
    char *bytes; /* of all labels, one after the other */
    size_t length, capacity;
    size_t *end; /* end of each shape's label in bytes */
    size_t count, end_capacity;
    size_t longest; /* bytes of the longest label */
};

struct label {
    const char *text;
    size_t length;
};

/* Makes scene_read() store the labels here. */
void labels_collect(struct labels *labels, struct scene *scene);
void labels_free(struct labels *labels);

/* The label of a shape, counted from 0.  Its length is 0 if there is none. */
struct label labels_get(const struct labels *labels, size_t shape);

#endif
