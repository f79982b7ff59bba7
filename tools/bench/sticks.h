/*
 * sticks.h - shapes in random directions that fill the unit cube, and rays
 *
 * All numbers are floats, so that Embree's curves are the same shapes.
 */
#ifndef BENCH_STICKS_H
#define BENCH_STICKS_H

#include "cylint_scene.h"
#include "inputs.h"

/* length in mean distances of neighbours, radius in lengths. */
struct stick_kind {
    const char *name;
    double length, radius;
};

/* Sticks as long as the mean distance; thin, fat and fibres overlap. */
extern const struct stick_kind thin_sticks, fat_sticks, thin, fat, fibres;

struct sticks {
    char name[32]; /* of the kind, and n */
    size_t n;
    size_t side;  /* of side^3 equal cells; cell k begins with k n / side^3 */
    int is_round; /* round cones, else cylinders */
    float (*end)[2][3], (*radius)[2];
    cylint_shape *shapes;
};

/* Draws n sticks and calls ask(), if the user wants so many and their name. */
void with_sticks(const struct stick_kind *kind, double n, int is_round,
                 size_t side, void (*ask)(const struct sticks *s));

/* From random points of the cube in random directions; or from one eye in front
 * of the cube, sixteen in a tile of 4 x 4 pixels.  n: the square of a multiple
 * of 4. */
typedef void draw_rays(int n, float (*ray)[2][3]);
draw_rays draw_incoherent, draw_coherent;
/* The same as lines. */
void draw_lines(draw_rays *draw, int n, cylint_line *line);

/* A scene keeps the kernels with which it is made: makes one for each. */
void make_scenes(const struct sticks *s);
const cylint_scene *scene_in_use(void);
void free_scenes(void);

#endif
