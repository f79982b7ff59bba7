/*
 * batch_scene.h - many shapes and lines with a given share of hits
 */
#ifndef BENCH_BATCH_SCENE_H
#define BENCH_BATCH_SCENE_H

#include "contestants.h"
#include "lean.h"

/* Shapes and lines in every form that a contestant reads. */
struct scene {
    size_t n_shapes, n_lines;
    cylint_shape *shapes;
    struct subject *subjects; /* the same shapes for the plain quadratic */
    struct lean_shape *lean;  /* and round kinds for their formula, */
    lean_intersect *formula;  /* which is NULL for others */
    cylint_pack pack;
    cylint_line *lines; /* two copies, so that pairs can be shifted */
    cylint_line *away;  /* the same lines, moved so that they miss everything */
    cylint_lines columns;   /* of `lines`, n_lines of them */
    double *numbers, *t[2]; /* the columns; memory for answers */
    signed char *relation, *n;
    void *memory; /* of the pack */
};

/* Allocates memory; exits if there is none. */
void scene_allocate(struct scene *s, size_t n_shapes, size_t n_lines);
void scene_free(struct scene *s);

/* Computes the other forms from the shapes and the first n_lines lines.
 * with_domains: some lines are not rays. */
void scene_finish(struct scene *s, int with_domains);

/* Whether a formula answers one by one. */
int scene_has_rival(const struct scene *s);

/* Packs only the first n shapes. */
void scene_use_first(struct scene *s, size_t n);

/* Random capped shapes of one kind in a ball of the given radius, and rays
 * through the ball from outside.  Shape radius 0.5 to 1.5, height 1 to 3. */
void scene_scatter(struct scene *s, int kind, double radius);

/* The radius of the ball at which `share` of all tests are hits. */
double scene_radius(int kind, double share);

#endif
