/*
 * inputs.h - random shapes, and scenes of sticks
 */
#ifndef BENCH_INPUTS_H
#define BENCH_INPUTS_H

#include "bench.h"
#include "cylint_scene.h"
#include "random.h"
#include "vectors.h"

/* Tables by kind of shape; without an entry the kind is not measured. */
enum { KINDS = CYLINT_KIND_RCONE + 1 };
extern const char *const kind_names[KINDS];

double between(uint64_t *random, double low, double high);
double power_between(uint64_t *random, double low, double high); /* of ten */
void draw_direction(uint64_t *random, double d[3]);

/* Even in a ball about the origin. */
void draw_in_ball(uint64_t *random, double radius, double p[3]);

/* Capped, near the origin, about 1 long and 0.1 to 1 thick.  ball: its middle is in
 * a ball of this radius, unless that is 0. */
cylint_shape draw_shape(uint64_t *random, int kind, double ball);

/* The middle of the axis; of a sphere the centre. */
void middle_of(const cylint_shape *s, double middle[3]);

/* Finds by bisection the argument, from 0 to `most`, at which a falling function
 * has the value `wanted`.  The last call is near it, so the input that the function
 * draws stays; returns the value of that call. */
double approach(double (*function)(double), double most, double wanted);

/* Makes a ray, or ends the program. */
void make_ray(cylint_line *ray, const double o[3], const double d[3]);

/* -------------------------------------------------------------- sticks -- */

/* Shapes in random directions that fill the unit cube.  All numbers are floats, so
 * that Embree's curves are the same shapes. */

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
    cylint_shape *shapes;
};

/* Draws n sticks and calls measure(), if the user wants so many and their name. */
void with_sticks(const struct stick_kind *kind, double n, int is_round,
                 size_t side, void (*measure)(const struct sticks *s));

/* From random points of the cube in random directions; or from one eye in front
 * of the cube, sixteen in a tile of 4 x 4 pixels.  All numbers are floats.  n: the
 * square of a multiple of 4. */
typedef void draw_rays(int n, cylint_line *ray);
draw_rays draw_incoherent, draw_coherent;

/* A scene keeps the kernels with which it is made: makes one for each. */
void make_scenes(const struct sticks *s);
const cylint_scene *scene_in_use(void);
void free_scenes(void);

#endif
