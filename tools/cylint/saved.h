/*
 * saved.h - scenes in files of cylint_scene_save()
 */
#ifndef CYLINT_SAVED_H
#define CYLINT_SAVED_H

#include <stddef.h>

#include "scene.h"

enum { NOT_SAVED = -1 };

/* Opens a saved scene.  Its file is mapped and checked.  Returns 0; NOT_SAVED if
 * the file is something else, cannot be opened or is no regular file; or an exit
 * status after a message.  ends: must be NOT_GIVEN, as its shapes have ends. */
int saved_open(struct scene *scene, const char *file, int ends);

/* Whether these bytes are the begin of a file of a scene. */
int saved_begins(const char *bytes, size_t length);

/* Adds the shapes of a scene, opened from `file`, to another, with their labels
 * as tails, and their solids.  Returns 0, or an exit status after a message. */
int saved_add(const struct scene *saved, const char *file, struct scene *scene);

/* Builds the scene by this number of threads and saves it with its labels.
 * Returns 0, or an exit status after a message. */
int saved_write(struct scene *scene, int threads, const char *file);

#endif
