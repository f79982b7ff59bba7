/*
 * scene_text.h - shapes as text of the grammar, which is read as the same shapes
 */
#ifndef CYLINT_SCENE_TEXT_H
#define CYLINT_SCENE_TEXT_H

#include "output.h"
#include "scene.h"
#include "text.h"

enum { RECORD_MOST = 512 }; /* bytes of a record without its solids and label */

/* Writes the numbers of a shape, in the grammar's order; that of an acone is its
 * tangent, not its angle.  Returns the enum shape_kind that made the shape: a round
 * cone can be a ball. */
int numbers_of_shape(const cylint_shape *shape, double number[13]);

/* A record to write. */
struct shape_record {
    const cylint_shape *shape;
    const struct solids *solids;
    const cylint_member *member; /* those of this shape */
    size_t members;
    struct string label;
};

/* Appends the record and a line feed.  The text has space for LINE_MOST bytes and
 * RECORD_MOST.  Returns NULL, or why text cannot hold the record; then the text is
 * as before.  digits: as of cylint_write_number(). */
const char *put_record(struct text *t, const struct shape_record *record,
                       int digits);

/* Writes all shapes of a scene that was read from `file`, with solids and labels.
 * Returns 0, or an exit status after a message. */
int scene_write_text(struct scene *scene, const char *file, int digits,
                     struct output *out);

#endif
