/*
 * search.h - finds the shapes of a scene that a line hits, or that are near a
 * point
 *
 * It uses batches of all shapes or a hierarchy of boxes, whichever is faster.
 * Both return the same bits.  Any number of threads may search.
 */
#ifndef CYLINT_SEARCH_H
#define CYLINT_SEARCH_H

#include "cylint.h"
#include "cylint_distance.h"

/* The last two are the same. */
enum accel { ACCEL_AUTO, ACCEL_NONE, ACCEL_TREE, ACCEL_EMBREE };

extern const char *const accel_words[]; /* in that order, then NULL */

struct search {
    const cylint_shape *shapes;
    size_t count;
    cylint_pack pack;            /* not used with ACCEL_TREE */
    void *memory;                /* the pack's */
    struct hierarchy *hierarchy; /* NULL: batches only */
    int threads;                 /* to build it */
};

/* Prepares `count` shapes with this number of threads; 0: one for each
 * processor.  The shapes must not change while the search is used.  Returns 0,
 * or an exit status after a message. */
int search_make(struct search *s, const cylint_shape *shapes, size_t count,
                enum accel accel, int threads);
void search_free(struct search *s);

/* Returns the number of the shape that is hit first, or `count`.  Writes the
 * wanted members of its hit. */
size_t search_nearest(const struct search *s, const cylint_line *line,
                      unsigned want, cylint_hit *hit);

/* Returns the number of shapes that are hit, at most `enough` unless that is
 * 0. */
size_t search_count(const struct search *s, const cylint_line *line,
                    size_t enough);

/* Writes the numbers of the shapes that are hit, ascending from `first`, at
 * most `capacity` of them, and returns how many.  hits: one char for each shape;
 * keep it unchanged between calls for the same line. */
size_t search_hits(const struct search *s, const cylint_line *line,
                   signed char *hits, size_t first, size_t *numbers,
                   size_t capacity);

/* The absolute distance of a point from the surface of a shape; NaN if the shape
 * has no surface. */
double search_distance(const struct search *s, size_t shape,
                       const double point[3]);

/* The same for points, as in cylint_scene.h. */
size_t search_closest(const struct search *s, const double point[3],
                      double radius, unsigned want, cylint_closest *closest);
size_t search_within_count(const struct search *s, const double point[3],
                           double radius, size_t enough);

/* Writes also the distances of the shapes. */
size_t search_within(const struct search *s, const double point[3],
                     double radius, size_t first, size_t *numbers,
                     double *distances, size_t capacity);

#endif
