/*
 * labels.h - the tails of a scene's lines: names of its shapes
 *
 * They are kept only if a column or a record needs them.
 */
#ifndef CYLINT_LABELS_H
#define CYLINT_LABELS_H

#include <stddef.h>
#include <stdint.h>

#include "scene.h"

/* Zero it before use. */
struct labels {
    char *bytes; /* of all labels, one after the other */
    size_t length, capacity;
    uint64_t *end; /* end of each shape's label in bytes */
    size_t count, end_capacity;
    size_t longest;            /* bytes of the longest label */
    cylint_scene_labels table; /* the labels; end is NULL if there are none */
};

struct label {
    const char *text;
    size_t length;
};

/* Makes scene_add() store the labels here. */
void labels_collect(struct labels *labels, struct scene *scene);
/* Gives the scene the labels that were collected, after all its shapes. */
void labels_give(struct labels *labels, struct scene *scene);
/* Uses the labels of a scene that was opened from `file`, in their place.  Returns
 * 0, or an exit status after a message. */
int labels_take(struct labels *labels, const struct scene *scene,
                const char *file);
void labels_free(struct labels *labels);

/* The label of a shape, counted from 0.  Its length is 0 if there is none. */
struct label labels_get(const struct labels *labels, size_t shape);

#endif
