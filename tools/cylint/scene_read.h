/*
 * scene_read.h - reads a scene from a file of shapes, or of a neuron's nodes
 *
 * A scene that was saved is opened by saved.h; scene_read() builds it again.
 */
#ifndef CYLINT_SCENE_READ_H
#define CYLINT_SCENE_READ_H

#include "scene.h"
#include "swc.h"

/* Reads shapes, one a line, or a neuron's nodes (swc.h), which become shapes of
 * this form.  ends: of shapes whose records do not state them, or NOT_GIVEN.
 * Stops at the first bad line.  Returns 0, or an exit status after a message. */
int scene_read_text(struct scene *scene, const char *file, int ends,
                    enum swc_form form);

/* The same, or adds the shapes of a saved scene, with their labels as tails. */
int scene_read(struct scene *scene, const char *file, int ends,
               enum swc_form form);

#endif
