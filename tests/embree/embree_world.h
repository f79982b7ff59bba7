/*
 * embree_world.h - a device that counts its errors, a scene of shapes on it,
 * and the library's answers for the same shapes and float rays
 */
#ifndef CYLINT_EMBREE_WORLD_H
#define CYLINT_EMBREE_WORLD_H

#include <string.h>

#include "draw.h"
#include "embree_rays.h"
#include "scenes.h"

/* The one device of a test program, its errors counted; memory is watched:
 * see world_memory. */
RTCDevice world_device(void);
int world_errors(void); /* since the last call */
enum RTCError world_last_error(void);

/* Whether a status is reported with the number of a shape or part and, by the
 * device, as one invalid argument since the last call of world_errors(). */
int world_refused(const cylint_embree_problem *problem, int status,
                  size_t number);

/* What the device's memory monitor saw. */
struct world_memory {
    long long bytes; /* in use now */
    int requests;    /* allocations, including the refused one */
    int refuse;      /* the number of the one to refuse, from 1; 0: none */
};
extern struct world_memory world_memory;

/* A scene in which filters of contexts, or of arguments, are called. */
RTCScene world_new_scene(void);

/* A committed scene that holds an instance of the other, with this number and, for
 * each time step, a matrix of three rows, column by column. */
RTCScene world_instance(RTCScene of, unsigned id, int steps,
                        const float *matrix);

/* A committed scene that holds a cone curve of n nodes, x, y, z and radius, with
 * this number. */
RTCScene world_curve(const float (*nodes)[4], size_t n, unsigned id);

struct world {
    RTCScene scene;
    RTCGeometry geometry;
    const cylint_shape *shapes;
    size_t n;
    cylint_pack pack;
    void *pack_memory; /* of the pack */
};

/* A committed scene that holds the shapes alone; ends the test if there is none. */
struct world world_made(const cylint_shape *shapes, size_t n,
                        const cylint_embree_options *options);
void world_free(struct world *w);

/* A world that is freed at the end of its block. */
#define OWN_WORLD __attribute__((cleanup(world_free))) struct world

/* Commits the scene with this filter of the geometry, or with the shapes as they
 * are now.  Returns the status of the update. */
void world_filter(struct world *w, RTCFilterFunctionN filter);
int world_update(struct world *w);

/* The least float that is not below x: tfar of a hit at t = x. */
float world_float_above(double x);

/* phi as a float below 1: v of a hit. */
float world_turn(double phi);

/* Whether the answer to ray i is what cylint_nearest() returns, all members,
 * bit for bit; `complete`: u, v and Ng too. */
int world_agrees(const struct world *w, struct rays *r, int i, int complete);

/* The number of hits of a shape on ray i whose t, rounded up to a float, is t;
 * entry and exit may be one float. */
int world_hits_at(const struct world *w, const struct rays *r, int i,
                  unsigned shape, float t);

/* Prints the ray and its answer, beside that of the library. */
void world_show(const struct world *w, struct rays *r, int i);

/* ------------------------------------------------------ drawing at random */

/* Kinds of scenes that differ most. */
enum { WORLD_SCENES = 11 };
extern const int world_scenes[WORLD_SCENES];

/* A unit vector, but for rounding. */
static inline void world_direction(float d[3])
{
    double u[3];
    random_direction(u);
    for (int k = 0; k < 3; k++)
        d[k] = (float)u[k];
}

/* Another n shapes of one of the kinds of scenes that all have a box: up to
 * SCENE_MIXED, or SCENE_LATTICE. */
static inline void world_shapes(int kind, cylint_shape *shapes, size_t n)
{
    OWN_SHAPES scene = scene_generate(kind, n, random_bits(&stream));
    memcpy(shapes, scene.shapes, n * sizeof *shapes);
}

#endif
