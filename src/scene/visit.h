/*
 * visit.h - the shapes of a scene that a line hits, or that are near a point
 *
 * All queries are callbacks of these visits.
 */
#ifndef CYLINT_SCENE_VISIT_H
#define CYLINT_SCENE_VISIT_H

#include "cylint_pieces.h"
#include "scene.h"

/* A shape that a visit has found. */
typedef struct cylint_found {
    size_t number;
    double at; /* t of the first hit, if it is wanted; or the distance, signed
                  where it is that to a solid */
    const cylint_hit *hit;     /* of a line; NULL if no member is wanted */
    const cylint_shape *shape; /* of a line: if a member is wanted; of a point:
                                  with closed ends if its solid counts */
    double distance;           /* of a point, as cylint_distance() returns it */
    cylint_interval chord;     /* of a line, in a visit of chords */
} cylint_found;

/* Returns what a cylint_scene_hit or a cylint_scene_near does: HUGE_VAL changes
 * nothing. */
typedef double cylint_use_found(void *context, const cylint_found *found);

typedef struct cylint_visit_options {
    size_t except; /* the number of a shape that is left out, or the number of
                      all shapes */
    unsigned want;
    int is_of_chords;
    int may_repeat;     /* a shape may come more than once: faster */
    int in_no_order;    /* no nearer hit makes others unwanted: faster */
    size_t first_other; /* the first of scene->others that is tested */
} cylint_visit_options;

/*
 * As cylint_scene_visit().  Hits beyond t = `last` are not wanted.
 *
 * is_of_chords: calls back for each chord of each shape, except late members
 * (scene.h).  A shape may come more than once, with the same chords.  `except` and
 * `want` have no effect.  Chords that begin beyond the t that the callback returned
 * last are not wanted.
 *
 * Of chords, returns whether a t that the callback returned may have left out some.
 */
int cylint_visit_line(const cylint_scene *scene, const cylint_line *line,
                      const cylint_visit_options *options, double last,
                      cylint_use_found *callback, void *context);

/* Which shapes a visit of a point finds. */
typedef enum cylint_nearness {
    CYLINT_NEAR_SURFACE, /* those whose surface is within the radius */
    CYLINT_NEAR_SOLID, /* those whose closed solid is, by the signed distance */
    CYLINT_HOLDING,    /* those whose closed solid holds the point; the radius
                            is 0, and the callback gets no distance */
    CYLINT_HOLDING_EARLY /* the same without late members (scene.h) */
} cylint_nearness;

/* The nearness that the `want` of a query selects. */
static inline cylint_nearness cylint_nearness_of(unsigned want)
{
    return want & CYLINT_SIGNED ? CYLINT_NEAR_SOLID : CYLINT_NEAR_SURFACE;
}

/* As cylint_scene_visit_point(); may_repeat: as above. */
void cylint_visit_point(const cylint_scene *scene, const double point[3],
                        double radius, cylint_nearness nearness, int may_repeat,
                        cylint_use_found *callback, void *context);

#endif
