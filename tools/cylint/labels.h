/*
 * labels.h - the tails of a scene's lines, which are the labels of its shapes
 *
 * The name of a shape is the first field of its label.
 */
#ifndef CYLINT_LABELS_H
#define CYLINT_LABELS_H

#include "names.h"
#include "scene.h"

/* The labels of shapes.  Zero it before use. */
struct labels {
    struct texts texts;        /* of a scene that is read */
    size_t longest;            /* bytes of the longest label */
    cylint_scene_labels table; /* the labels; end is NULL if there are none */
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

/* The label of a shape, counted from 0, and its name.  Their length is 0 if there
 * is none. */
struct label labels_get(const struct labels *labels, size_t shape);
struct label name_of_shape(const struct labels *labels, size_t shape);

#endif
