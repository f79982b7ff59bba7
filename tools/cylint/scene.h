/*
 * scene.h - the shapes that every line is intersected with
 */
#ifndef CYLINT_COMMAND_SCENE_H
#define CYLINT_COMMAND_SCENE_H

#include "columns.h"
#include "cylint.h"
#include "cylint_methods.h"
#include "grammar.h"
#include "search.h"
#include "solids.h"

struct scene {
    cylint_scene *shapes; /* NULL: none yet */
    size_t count;
    struct search search; /* once scene_prepare() was called */
    struct solids solids; /* that were read, for scene_prepare() */

    /* Called with the record of shape number `count`, unless NULL.  Returns
     * 0 or an exit status. */
    int (*also)(struct scene *scene, const struct record *record);
    void *context; /* for also() */
};

/* Adds the shape of a record and calls also().  Returns 0 or an exit status. */
int scene_add(struct scene *scene, const struct record *record);

/* Writes shape number i, from 0. */
void scene_shape(const struct scene *scene, size_t i, cylint_shape *shape);

/* Prepares the shapes for all queries without a method, and sets their solids.
 * Returns 0 or an exit status. */
int scene_prepare(struct scene *scene, enum accel accel, int threads);
void scene_free(struct scene *scene);

/* Intersects one line and one shape; NULL is cylint_intersect(). */
typedef cylint_method_fn *solver;

/* Returns 0 if the method does not support this shape. */
int solve(solver method, const cylint_shape *shape, const cylint_line *line,
          unsigned want, cylint_answer *answer);

struct left_out;

/* A line to intersect with the shapes of a scene. */
struct scene_query {
    solver method;
    const cylint_line *line;
    const struct left_out *left_out; /* shapes to leave out */
    signed char *hits;               /* for search_visit() */
};

/* Both write *row and return 0, or the number, from 1, of a shape that the
 * method does not support.  row->answer points to *answer. */
size_t scene_nearest(const struct scene *scene, const struct scene_query *q,
                     const struct fields *fields, cylint_answer *answer,
                     struct row *row);
/* Counts the shapes that are hit, up to `most`. */
size_t scene_count(const struct scene *scene, const struct scene_query *q,
                   unsigned long long most, struct row *row);

#endif
