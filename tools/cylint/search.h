/*
 * search.h - finds the shapes of a scene that a line hits
 *
 * By batches of all shapes or, where it pays, by a hierarchy of boxes: the
 * answers are the same bits.  Any number of threads may search.
 */
#ifndef CYLINT_SEARCH_H
#define CYLINT_SEARCH_H

#include "cylint.h"

/* The last two are the same. */
enum accel { ACCEL_AUTO, ACCEL_NONE, ACCEL_TREE, ACCEL_EMBREE };

extern const char *const accel_words[]; /* in that order, then NULL */

struct search {
    const cylint_shape *shapes;
    size_t count;
    cylint_pack pack;  /* unless there is a hierarchy from the beginning */
    void *memory;      /* the pack's */
    struct tree *tree; /* NULL: batches only */
    int threads;       /* to build it */
};

/* Prepares `count` shapes, which the caller keeps, by so many threads (0: as
 * many as there are processors).  Returns 0 or an exit status, having said
 * what is wrong. */
int search_make(struct search *s, const cylint_shape *shapes, size_t count,
                enum accel accel, int threads);
void search_free(struct search *s);

/* The number of the shape that is hit first, or `count`; *t is where, unless
 * `t` is NULL. */
size_t search_nearest(const struct search *s, const cylint_line *line,
                      double *t);

/* Shapes that are hit; at most `enough`, unless that is 0. */
size_t search_count(const struct search *s, const cylint_line *line,
                    size_t enough);

/* Writes the numbers of the shapes from `first` on that are hit, ascending,
 * `room` of them at most, and returns how many.  hits: a char per shape,
 * which keeps its contents between calls for the same line. */
size_t search_hits(const struct search *s, const cylint_line *line,
                   signed char *hits, size_t first, size_t *numbers,
                   size_t room);

#endif
