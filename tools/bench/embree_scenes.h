/*
 * embree_scenes.h - random shapes in a cube, and rays through it
 *
 * All numbers are floats, so that Embree's own curves have the same numbers as
 * the shapes.
 */
#ifndef BENCH_EMBREE_SCENES_H
#define BENCH_EMBREE_SCENES_H

#include <cylint_embree.h>

#include "embree/api.h"

/* length in multiples of the mean spacing, radius in multiples of the
 * length. */
struct cylinder_kind {
    const char *name;
    double length, radius;
    int most_segments; /* of a curve that is split by hand */
};

extern const struct cylinder_kind thin, fat, fibre;

/* As long as the mean spacing, so that few overlap. */
extern const struct cylinder_kind thin_stick, fat_stick;

/* Which shape is made of two points and a radius at each. */
enum form { CYLINDERS, CONES, ROUND_CONES };

struct cylinders {
    size_t n;
    enum form form;
    float (*ends)[2][3];
    float (*radius)[2]; /* of cylinders all equal, but read one by one */
    cylint_shape *shapes;
    size_t parts; /* the geometries of a scene, of n / parts shapes each */
};

/* n capped cylinders in the unit cube; exits if there is no memory. */
struct cylinders draw_cylinders(const struct cylinder_kind *kind, size_t n);

/* The same as cones or rounded cones, of radii between half of the cylinders'
 * and all of it. */
struct cylinders draw_cones(const struct cylinder_kind *kind, size_t n,
                            enum form form);

/* About n of them, the same number in each of side^3 cells of the unit cube.  Each
 * cell is a part. */
struct cylinders draw_cells(const struct cylinder_kind *kind, size_t n,
                            size_t side);

/* The shapes of a part. */
struct cylinders part_of(const struct cylinders *c, size_t part);
void free_cylinders(struct cylinders *c);

struct rays {
    int n;
    struct RTCRay *ray;
};

/* Incoherent: random origins in the cube and random directions.  Camera: rays
 * of a camera in front of the cube in the order of packets: 4 successive rays
 * are a tile of 2 x 2 pixels, 8 of 4 x 2, 16 of 4 x 4. */
struct rays draw_incoherent_rays(int n);
struct rays draw_camera_rays(int n);
void free_rays(struct rays *r);

/* A scene of a benchmark; `all`: with every rival. */
struct scene_size {
    const struct cylinder_kind *kind;
    size_t n;
    int all;
};

/* Runs the scenes with at most MOST shapes whose kind's name contains ONLY.
 * The arguments are SECONDS MOST ONLY (1 1e6 and all), of which `run` is given
 * SECONDS.  Flushes subnormals. */
void run_scenes(int argc, char **argv, const struct scene_size *scenes,
                size_t count, void (*run)(const struct scene_size *, double));

/* Sets flush-to-zero and denormals-are-zero, as Embree advises renderers. */
void flush_subnormals(void);

/* malloc(); exits if there is no memory. */
void *need(size_t bytes);

#endif
