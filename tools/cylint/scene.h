/*
 * scene.h - the shapes of a file: of text, of a neuron's nodes, or a saved
 * scene
 */
#ifndef CYLINT_COMMAND_SCENE_H
#define CYLINT_COMMAND_SCENE_H

#include "cylint_scene.h"
#include "grammar.h"
#include "labels.h"
#include "solids.h"
#include "swc.h"

/* Zero it before use. */
struct scene {
    cylint_scene *shapes; /* NULL: none yet */
    size_t count;
    struct solids solids; /* that were read, for scene_build() */
    int keeps_labels;     /* else there are none */
    struct labels labels; /* the tails of the records */
};

/* All return 0, or an exit status after a message. */

/* Adds the shape of a record. */
int scene_add(struct scene *scene, const struct record *record);

/* Reads shapes, one a line, or a neuron's nodes (swc.h), which become shapes of
 * this form.  ends: of shapes whose records do not state them, or NOT_GIVEN.
 * Stops at the first bad line. */
int scene_read_text(struct scene *scene, const char *file, int ends,
                    enum swc_form form);

enum { NOT_SAVED = -1 };

/* Opens a saved scene.  Its file is mapped and checked.  Returns NOT_SAVED
 * if the file is something else, cannot be opened or is no regular file.
 * ends must be NOT_GIVEN, as the shapes have ends. */
int scene_open(struct scene *scene, const char *file, int ends);

/* As scene_read_text(), or adds the shapes of a saved scene, with their
 * labels as tails, and their solids. */
int scene_read(struct scene *scene, const char *file, int ends,
               enum swc_form form);

/* Builds the scene by this number of threads, 0: one for each processor, unless
 * that was done, and sets its solids. */
int scene_build(struct scene *scene, int threads);

/* Saves a scene that was built, with its labels. */
int scene_save(struct scene *scene, const char *file);

void scene_free(struct scene *scene);

#endif
