/*
 * reader_scene.h - reads a file of shapes and their labels
 */
#ifndef CYLINT_PYTHON_READER_SCENE_H
#define CYLINT_PYTHON_READER_SCENE_H

#include "cylint_scene.h"

/* Labels are one behind the other; label i ends at label_end[i].  label_bytes is
 * NULL if no shape has one.  The caller frees the scene and the arrays. */
typedef struct cylint_python_scene {
    cylint_scene *shapes;   /* begun; NULL: there are none */
    cylint_member *members; /* of solids, for the finished scene */
    size_t n_members;
    size_t count;
    char *label_bytes;
    uint64_t *label_end;
} cylint_python_scene;

/* Returns 0 or an exit status.  ends: of shapes whose line does not say, or
 * -1. */
int cylint_python_read(const char *file, int ends, int round,
                       cylint_python_scene *scene);

#endif
