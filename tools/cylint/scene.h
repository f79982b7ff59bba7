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

struct scene {
    cylint_shape *shapes;
    size_t count, room;
    struct search search; /* once scene_prepare() was called */

    /* What else is done with the record of shape number `count`; NULL:
     * nothing.  Returns 0 or an exit status. */
    int (*also)(struct scene *scene, const struct record *record);
    void *context; /* of that */
};

/* Adds one shape, with what else is done with its record.  Returns 0 or an
 * exit status. */
int scene_add(struct scene *scene, const struct record *record);

/* Reads a file of shapes, one a line, or of a neuron's nodes (swc.h).
 * Returns 0 or an exit status, having said what is wrong: the first bad line
 * stops it. */
int scene_read(struct scene *scene, const char *file, int ends);
/* Prepares the shapes for all questions without a method.  Returns 0 or an
 * exit status. */
int scene_prepare(struct scene *scene, enum accel accel, int threads);
void scene_free(struct scene *scene);

/* Intersects one line and one shape; NULL is cylint_intersect(). */
typedef cylint_method_fn *solver;

/* Returns 0 if the method does not answer for this shape. */
int ask(solver method, const cylint_shape *shape, const cylint_line *line,
        unsigned want, cylint_answer *answer);

struct left_out;

/* A line to intersect with the shapes of a scene. */
struct question {
    solver method;
    const cylint_line *line;
    const struct left_out *left_out; /* these excepted */
    signed char *hits;               /* a char per shape, for search_hits() */
};

/* Both fill *row and return 0, or the number of the shape, from 1, that the
 * method does not answer for.  *answer is what row->answer points to. */
size_t scene_nearest(const struct scene *scene, const struct question *q,
                     unsigned want, cylint_answer *answer, struct row *row);
/* Counts the shapes that are hit, `most` of them at most. */
size_t scene_count(const struct scene *scene, const struct question *q,
                   unsigned long long most, struct row *row);

#endif
