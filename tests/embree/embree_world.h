/*
 * embree_world.h - a device that counts its errors, a scene of shapes on it,
 * and the library's answers for the same shapes and float rays
 */
#ifndef CYLINT_EMBREE_WORLD_H
#define CYLINT_EMBREE_WORLD_H

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "draw.h"
#include "embree_rays.h"
#include "families.h"
#include "scenes.h"

/* -------------------------------------------------------------- device -- */

/* What the device's memory monitor counts. */
static struct {
    long long bytes; /* in use now */
    int requests;    /* allocations, including the refused one */
    int refuse;      /* the number of the one to refuse, from 1; 0: none */
} world_memory;

static int errors;
static enum RTCError world_last_error;

static inline void count_error(void *user, enum RTCError code, const char *text)
{
    (void)user;
    (void)text;
    errors++;
    world_last_error = code;
}

static inline bool watch(void *user, ssize_t bytes, bool post)
{
    (void)user;
    (void)post;
    if (bytes > 0) {
        const int number =
            __atomic_add_fetch(&world_memory.requests, 1, __ATOMIC_RELAXED);
        if (number == world_memory.refuse)
            return false;
    }
    __atomic_add_fetch(&world_memory.bytes, (long long)bytes, __ATOMIC_RELAXED);
    return true;
}

/* The one device of a program, its errors counted, its memory watched. */
static inline RTCDevice world_device(void)
{
    static RTCDevice device;
    if (!device) {
        device = rtcNewDevice("threads=1");
        if (!device ||
            rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_VERSION_MAJOR) !=
                RTC_VERSION_MAJOR) {
            fprintf(stderr, "no device of Embree %d\n", RTC_VERSION_MAJOR);
            exit(1);
        }
        rtcSetDeviceErrorFunction(device, count_error, NULL);
        rtcSetDeviceMemoryMonitorFunction(device, watch, NULL);
    }
    return device;
}

/* Errors since the last call. */
static inline int world_errors(void)
{
    const int since = errors;
    errors = 0;
    return since;
}

/* Whether a status is reported with the number of a shape or part and, by the
 * device, as one invalid argument since the last call of world_errors(). */
static inline int world_refused(const cylint_embree_problem *problem,
                                int status, size_t number)
{
    return world_errors() == 1 &&
           world_last_error == RTC_ERROR_INVALID_ARGUMENT &&
           problem->status == status && problem->shape == number;
}

/* --------------------------------------------------------------- scene -- */

/* A scene in which filters of contexts, or of arguments, are called. */
static inline RTCScene world_new_scene(void)
{
    RTCScene scene = rtcNewScene(world_device());
#if RTC_VERSION_MAJOR >= 4
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS);
#else
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
#endif
    return scene;
}

/* A committed scene that owns the geometry, with this number, and no other. */
static inline RTCScene scene_of(RTCGeometry geometry, unsigned id)
{
    RTCScene scene = world_new_scene();
    rtcSetGeometryMask(geometry, 0xffffffffu);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene, geometry, id);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene);
    return scene;
}

/* A committed scene that holds an instance of the other, with this number and, for
 * each time step, a matrix of three rows, column by column. */
static inline RTCScene world_instance(RTCScene of, unsigned id, int steps,
                                      const float *matrix)
{
    RTCGeometry instance =
        rtcNewGeometry(world_device(), RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(instance, of);
    rtcSetGeometryTimeStepCount(instance, (unsigned)steps);
    for (int i = 0; i < steps; i++)
        rtcSetGeometryTransform(instance, (unsigned)i,
                                RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR,
                                matrix + 12 * i);
    return scene_of(instance, id);
}

/* A committed scene that holds a cone curve of n nodes, x, y, z and radius, with
 * this number. */
static inline RTCScene world_curve(const float (*nodes)[4], size_t n,
                                   unsigned id)
{
    RTCGeometry curve =
        rtcNewGeometry(world_device(), RTC_GEOMETRY_TYPE_CONE_LINEAR_CURVE);
    unsigned *first = rtcSetNewGeometryBuffer(
        curve, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT, sizeof *first, n - 1);
    float *vertex = rtcSetNewGeometryBuffer(
        curve, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, sizeof *nodes, n);
    for (unsigned i = 0; i < n - 1; i++)
        first[i] = i;
    memcpy(vertex, nodes, n * sizeof *nodes);
    return scene_of(curve, id);
}

struct world {
    RTCScene scene;
    RTCGeometry geometry;
    const cylint_shape *shapes;
    size_t n;
    int bare; /* the hits have no u, v and Ng */
    /* Whether Embree may miss hits on the line; NULL: on none. */
    int (*may_miss)(const cylint_line *line);
    cylint_pack pack;
    void *pack_memory; /* of the pack */
};

/* A committed scene that holds the shapes alone; ends the test if there is none. */
static inline struct world world_made(const cylint_shape *shapes, size_t n,
                                      const cylint_embree_options *options)
{
    struct world w = {.shapes = shapes,
                      .n = n,
                      .bare = options && options->flags & CYLINT_EMBREE_BARE};
    cylint_embree_problem problem;
    w.geometry =
        cylint_embree_geometry(world_device(), shapes, n, options, &problem);
    w.pack_memory = malloc(cylint_pack_bytes(n) + 1);
    if (!w.geometry || !w.pack_memory) {
        fprintf(stderr, "%s, shape %lu\n",
                cylint_embree_strerror(problem.status),
                (unsigned long)problem.shape);
        exit(1);
    }
    w.scene = world_new_scene();
    rtcAttachGeometry(w.scene, w.geometry);
    rtcCommitScene(w.scene);
    cylint_pack_shapes(&w.pack, w.pack_memory, shapes, n);
    return w;
}

/* Commits the scene with this filter of the geometry, or with the shapes as they
 * are now.  Returns the status of the update. */
static inline void world_filter(struct world *w, RTCFilterFunctionN filter)
{
    rtcSetGeometryIntersectFilterFunction(w->geometry, filter);
    rtcSetGeometryOccludedFilterFunction(w->geometry, filter);
    rtcCommitGeometry(w->geometry);
    rtcCommitScene(w->scene);
}

static inline int world_update(struct world *w)
{
    const int status = cylint_embree_update(w->geometry, NULL);
    rtcCommitScene(w->scene);
    cylint_pack_shapes(&w->pack, w->pack_memory, w->shapes, w->n);
    return status;
}

static inline void world_free(struct world *w)
{
    rtcReleaseScene(w->scene);
    cylint_embree_release(w->geometry);
    free(w->pack_memory);
    memset(w, 0, sizeof *w);
}

/* A world that is freed at the end of its block. */
#define OWN_WORLD __attribute__((cleanup(world_free))) struct world

/* ------------------------------------------------------------- answers -- */

/* The least float that is not below x. */
static inline float world_float_above(double x)
{
    const float f = (float)x;
    return (double)f < x ? nextafterf(f, HUGE_VALF) : f;
}

/* tfar of a hit at t: that float, unless it is subnormal; or the ray's own, if that
 * is less. */
static inline float world_tfar(double t, float own)
{
    const float f = fabs(t) >= (double)FLT_MIN ? world_float_above(t)
                    : t > 0                    ? FLT_MIN
                                               : 0;
    return f < own ? f : own;
}

static inline int same(union ray_word word, float f)
{
    union ray_word expected;
    expected.f = f;
    return word.u == expected.u;
}

/* phi as a float below 1: v of a hit. */
static inline float world_turn(double phi)
{
    const float f = (float)phi;
    return f < 1 ? f : nextafterf(1, 0);
}

/* Whether a hit's words Ng, u and v, in this order, describe the library's hit. */
static inline int world_describes(const union ray_word got[5],
                                  const cylint_hit *hit)
{
    int good =
        same(got[3], (float)hit->z) && same(got[4], world_turn(hit->phi));
    for (int k = 0; k < 3; k++)
        good = good && same(got[k], (float)hit->normal[k]);
    return good;
}

/* Whether the answer to ray i is what cylint_nearest() returns, all members, bit
 * for bit.  Of a bare hit u, v and Ng are as before; a stream's are undefined. */
static inline int world_agrees(const struct world *w, struct rays *r, int i)
{
    const cylint_line line = rays_line(r, i);
    union ray_word described[5];
    cylint_hit hit;
    int kept = 1;
    const size_t shape = cylint_nearest(&w->pack, &line, CYLINT_WANT_ALL, &hit);
    for (int m = 0; m < 5; m++) {
        const int at = (HIT_NG + m) * r->n + i;
        described[m] = r->word[at];
        kept &= r->word[at].u == r->before[at].u;
    }
    kept |= !rays_are_native(w->scene, r->n);
    if (shape == w->n)
        return !rays_hit(r, i) && (kept || !w->bare) &&
               rays_at(r, RAY_TFAR, i)->u == r->before[RAY_TFAR * r->n + i].u;
    return rays_hit(r, i) && rays_at(r, HIT_PRIM, i)->u == shape &&
           same(*rays_at(r, RAY_TFAR, i),
                world_tfar(hit.t, r->before[RAY_TFAR * r->n + i].f)) &&
           (w->bare ? kept : world_describes(described, &hit));
}

/* The number of hits of a shape on ray i whose t, rounded up to a float, is t;
 * entry and exit may be one float. */
static inline int world_hits_at(const struct world *w, const struct rays *r,
                                int i, unsigned shape, float t)
{
    const cylint_line line = rays_line(r, i);
    cylint_answer answer;
    const int hits = shape < w->n ? cylint_intersect(&w->shapes[shape], &line,
                                                     CYLINT_WANT_T, &answer)
                                  : 0;
    int n = 0;
    for (int k = 0; k < hits; k++)
        n += world_float_above(answer.hit[k].t) == t;
    return n;
}

/* Prints the ray and its answer, beside that of the library. */
static inline void world_show(const struct world *w, struct rays *r, int i)
{
    const cylint_line line = rays_line(r, i);
    cylint_hit hit = {0};
    const size_t shape = cylint_nearest(&w->pack, &line, CYLINT_WANT_ALL, &hit);
    REPORT("span %a %a %a  %a %a %a  %a %a", line.o[0], line.o[1], line.o[2],
           line.d[0], line.d[1], line.d[2], line.tmin, line.tmax);
    REPORT("library: shape %lu of %lu, t %a, normal %a %a %a, z %a, phi %a",
           (unsigned long)shape, (unsigned long)w->n, hit.t, hit.normal[0],
           hit.normal[1], hit.normal[2], hit.z, hit.phi);
    fprintf(stderr, "    Embree: shape %d, geometry %d, t %a; Ng, u, v",
            (int)rays_at(r, HIT_PRIM, i)->u, (int)rays_at(r, HIT_GEOM, i)->u,
            rays_at(r, RAY_TFAR, i)->f);
    for (int m = HIT_NG; m <= HIT_V; m++)
        fprintf(stderr, " %a", r->word[m * r->n + i].f);
    fputc('\n', stderr);
}

/* Kinds of scenes that differ most. */
enum { WORLD_SCENES = 11 };
static const int world_scenes[WORLD_SCENES] = {
    SCENE_THIN,    SCENE_FAT,   SCENE_FIBRES,  SCENE_NEEDLES,
    SCENE_DISCS,   SCENE_MIXED, SCENE_DISTANT, SCENE_LENGTHS,
    SCENE_LATTICE, SCENE_ROUND, SCENE_STRANDS};

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

/* ------------------------------------------------- comparing with the library */

static const unsigned both_ways[2] = {0, CYLINT_EMBREE_SINGLE};

static inline struct world world_with(const cylint_shape *shapes, size_t n,
                                      unsigned how)
{
    return world_made(shapes, n, &(cylint_embree_options){.flags = how});
}

/* Replaces shapes 70 to 73 by some that are far from the others, or much larger,
 * and so beside the hierarchy: two equal balls below, a wall and a distant
 * stick. */
static inline void world_distant(cylint_shape *shapes)
{
    const double below[3] = {0, 0, -1e5},
                 wall[2][3] = {{1e4, 0, 0}, {1e4, 1, 0}};
    for (int i = 0; i < 2; i++)
        cylint_sphere(&shapes[70 + i], below, 1e5 - 3, CYLINT_ENDS_CAPPED);
    cylint_cylinder(&shapes[72], wall[0], wall[1], 9990, CYLINT_ENDS_CAP1);
    cylint_cone(&shapes[73], wall[0], 2, wall[1], 1, CYLINT_ENDS_OPEN);
}

/* For the world w of the shapes, with a hierarchy and then without. */
#define EACH_WAY(w, shapes, n)                                                \
    for (int way = 0; way < 2; way++)                                         \
        for (struct world w = world_with(shapes, n, both_ways[way]); w.scene; \
             world_free(&w))

/* A shape of a kind with these ends, near the origin and about 1 large. */
static inline cylint_shape any_shape(int kind, cylint_ends ends)
{
    const int family =
        family_named(kind < CYLINT_KIND_SPHERE ? "ordinary" : "round");
    struct family_case c;
    do
        family_case(random_bits(&stream), family, 0, &c);
    while (c.shape.kind != kind ||
           (int)c.shape_word != kind - CYLINT_KIND_CYLINDER);
    c.ends = kind == CYLINT_KIND_SPHERE ? CYLINT_ENDS_CAPPED : ends;
    family_make(&c);
    return c.shape;
}

enum { SOME = 200 };

/* Rays to points among SOME shapes, from up to three sides of their cube away, with
 * directions of lengths from 1e-3 to 1e3; some rays begin inside.  Half of the
 * packets are narrow, with nearly one origin and direction. */
static inline void aim_all(struct rays *r, int n)
{
    const double side = cbrt(SOME), far = between(0, 3);
    const double spread = chance(0.5) ? 1 : 0.05;
    float all[3];
    world_direction(all);
    rays_begin(r, n);
    for (int i = 0; i < n; i++) {
        float o[3], d[3];
        const double length = power(-3, 3);
        world_direction(d);
        for (int k = 0; k < 3; k++) {
            const double along = (1 - spread) * all[k] + spread * d[k];
            o[k] = (float)(side * (spread * between(-0.5, 0.5) - far * along));
            d[k] = (float)(length * along);
        }
        rays_add(r, i, o, d, 0, HUGE_VALF);
    }
}

/* Where Embree may miss hits, a reported one is a hit of its shape. */
static inline int world_accepts(const struct world *w, struct rays *r, int i)
{
    const cylint_line line = rays_line(r, i);
    return world_agrees(w, r, i) ||
           (w->may_miss && w->may_miss(&line) &&
            (!rays_hit(r, i) ||
             world_hits_at(w, r, i, rays_at(r, HIT_PRIM, i)->u,
                           rays_at(r, RAY_TFAR, i)->f) > 0));
}

static inline void check_answers_of(const struct world *w, struct rays *r)
{
    for (int i = 0; i < r->n; i++)
        if (r->valid[i] && !CHECK(world_accepts(w, r, i)))
            world_show(w, r, i);
    CHECK(rays_strayed(r, 0) == 0);
}

static inline void check_shadows_of(const struct world *w, struct rays *r)
{
    for (int i = 0; i < r->n; i++) {
        const cylint_line line = rays_line(r, i);
        const int expected = cylint_count(&w->pack, &line, 1) != 0;
        if (r->valid[i] &&
            !CHECK(rays_shadowed(r, i) == expected ||
                   (expected && w->may_miss && w->may_miss(&line))))
            world_show(w, r, i);
    }
    CHECK(rays_strayed(r, 1) == 0);
}

static inline void check_some_rays(const struct world *w)
{
    for (int i = 0; i < 100; i++) {
        struct rays r;
        aim_all(&r, rays_sizes[i % 4]);
        rays_intersect(&r, w->scene, NULL);
        check_answers_of(w, &r);
    }
}

/* Traces the rays for nearest and for any hit, and checks the answers; completes a
 * single bare hit.  Returns the number of nearest hits. */
static inline int check_both_queries(const struct world *w, struct rays *r,
                                     const struct rays_query *query)
{
    int hits = 0;
    rays_intersect(r, w->scene, query);
    check_answers_of(w, r);
    for (int i = 0; i < r->n; i++)
        hits += r->valid[i] && rays_hit(r, i);
    if (w->bare && r->n == 1 && hits) {
        struct world described = *w;
        described.bare = 0;
        cylint_embree_complete(w->geometry, (void *)r->word);
        check_answers_of(&described, r);
    }
    memcpy(r->word, r->before, sizeof r->word);
    rays_occluded(r, w->scene, query);
    check_shadows_of(w, r);
    return hits;
}

/* Traces n rays that are the same. */
static inline struct rays equal_rays(RTCScene scene, int n, const float o[3],
                                     const float d[3], float tnear, float tfar)
{
    struct rays r;
    rays_begin(&r, n);
    for (int i = 0; i < n; i++)
        rays_add(&r, i, o, d, tnear, tfar);
    rays_intersect(&r, scene, NULL);
    return r;
}

/* The same, and checks the answers. */
static inline struct rays traced(const struct world *w, int n, const float o[3],
                                 const float d[3], float tnear, float tfar)
{
    struct rays r = equal_rays(w->scene, n, o, d, tnear, tfar);
    check_answers_of(w, &r);
    return r;
}

#endif
