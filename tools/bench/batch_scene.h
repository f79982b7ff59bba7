/*
 * batch_scene.h - many shapes and many lines, of which a given share meet
 */
#ifndef BENCH_BATCH_SCENE_H
#define BENCH_BATCH_SCENE_H

#include "contestants.h"

/* Shapes and lines in every form that a contestant reads them in. */
struct scene {
    size_t n_shapes, n_lines;
    cylint_shape *shapes;
    struct subject *subjects; /* the same shapes for the plain quadratic */
    cylint_pack pack;
    cylint_line *lines;     /* twice over, so that pairs can be shifted */
    cylint_line *away;      /* the same lines, moved past everything */
    cylint_lines columns;   /* of `lines`, n_lines of them */
    double *numbers, *t[2]; /* what columns points to; room for answers */
    signed char *relation, *n;
    void *memory; /* the pack's */
};

/* Room for so many; stops the program if there is none. */
void scene_allocate(struct scene *s, size_t n_shapes, size_t n_lines);
void scene_free(struct scene *s);

/* After shapes and the first n_lines lines were set: the other forms.
 * with_domains: the lines are not all rays. */
void scene_finish(struct scene *s, int with_domains);

/* Packs only the first n shapes. */
void scene_use_first(struct scene *s, size_t n);

/* Shapes of a kind in a ball of that radius, rays through the ball from
 * without.  All 0.5 to 1.5 thick and 1 to 3 high, capped. */
void scene_scatter(struct scene *s, int kind, double radius);

/* The radius of the ball in which so many of all lines and shapes meet. */
double scene_radius(int kind, double share);

#endif
