/*
 * search.h - finds the shapes of a scene that a line hits, or that are near a
 * point
 *
 * By the library's scene, or by batches of all shapes, for comparison.  Both
 * return the same bits.  Any number of threads may search.
 */
#ifndef CYLINT_SEARCH_H
#define CYLINT_SEARCH_H

#include "cylint_scene.h"

/* All but ACCEL_NONE are the same: scripts name them. */
enum accel { ACCEL_AUTO, ACCEL_NONE, ACCEL_TREE, ACCEL_EMBREE };

extern const char *const accel_words[]; /* in that order, then NULL */

struct search {
    const cylint_scene *scene;
    size_t count;
    /* ACCEL_NONE: all shapes in a pack; else NULL */
    cylint_shape *shapes;
    void *memory; /* the pack's */
    cylint_pack pack;
};

/* Builds the scene, unless that was done, with this number of threads; 0: one
 * for each processor.  Returns 0, or an exit status after a message. */
int search_build(cylint_scene *scene, int threads);

/* Builds the scene, or packs its shapes.  Returns 0, or an exit status after a
 * message. */
int search_make(struct search *s, cylint_scene *scene, enum accel accel,
                int threads);
void search_free(struct search *s);

/* The bytes of an array `hits` of the functions below. */
size_t search_bytes(const struct search *s);

/* As cylint_scene_visit(): ACCEL_NONE in the order of shapes.  hits: memory of
 * search_bytes(). */
void search_visit(const struct search *s, const cylint_line *line,
                  unsigned want, signed char *hits, cylint_scene_hit *callback,
                  void *context);

/* Writes the numbers of the shapes that are hit, ascending from `first`, at
 * most `capacity` of them, and returns how many.  Keep hits[] unchanged between
 * calls for the same line. */
size_t search_hits(const struct search *s, const cylint_line *line,
                   signed char *hits, size_t first, size_t *numbers,
                   size_t capacity);

/* As cylint_scene_visit_point() and cylint_scene_within(). */
void search_visit_point(const struct search *s, const double point[3],
                        double radius, unsigned want,
                        cylint_scene_near *callback, void *context);
size_t search_within(const struct search *s, const double point[3],
                     double radius, unsigned want, size_t first,
                     size_t *numbers, double *distances, size_t capacity);

/* The distance that these compare. */
static inline double search_compared(unsigned want, double distance)
{
    return want & CYLINT_SIGNED || !(distance < 0) ? distance : -distance;
}

#endif
