/* embree_world.c - see embree_world.h */
#include "embree_world.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* -------------------------------------------------------------- device -- */

struct world_memory world_memory;

static int errors;
static enum RTCError last_error;

static void count_error(void *user, enum RTCError code, const char *text)
{
    (void)user;
    (void)text;
    errors++;
    last_error = code;
}

static bool watch(void *user, ssize_t bytes, bool post)
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

RTCDevice world_device(void)
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

int world_errors(void)
{
    const int since = errors;
    errors = 0;
    return since;
}

enum RTCError world_last_error(void)
{
    return last_error;
}

int world_refused(const cylint_embree_problem *problem, int status,
                  size_t number)
{
    return world_errors() == 1 && last_error == RTC_ERROR_INVALID_ARGUMENT &&
           problem->status == status && problem->shape == number;
}

/* --------------------------------------------------------------- scene -- */

RTCScene world_new_scene(void)
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
static RTCScene scene_of(RTCGeometry geometry, unsigned id)
{
    RTCScene scene = world_new_scene();
    rtcSetGeometryMask(geometry, 0xffffffffu);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene, geometry, id);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene);
    return scene;
}

RTCScene world_instance(RTCScene of, unsigned id, int steps,
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

RTCScene world_curve(const float (*nodes)[4], size_t n, unsigned id)
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

struct world world_made(const cylint_shape *shapes, size_t n,
                        const cylint_embree_options *options)
{
    struct world w = {.shapes = shapes, .n = n};
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

void world_filter(struct world *w, RTCFilterFunctionN filter)
{
    rtcSetGeometryIntersectFilterFunction(w->geometry, filter);
    rtcSetGeometryOccludedFilterFunction(w->geometry, filter);
    rtcCommitGeometry(w->geometry);
    rtcCommitScene(w->scene);
}

int world_update(struct world *w)
{
    const int status = cylint_embree_update(w->geometry, NULL);
    rtcCommitScene(w->scene);
    cylint_pack_shapes(&w->pack, w->pack_memory, w->shapes, w->n);
    return status;
}

void world_free(struct world *w)
{
    rtcReleaseScene(w->scene);
    cylint_embree_release(w->geometry);
    free(w->pack_memory);
    memset(w, 0, sizeof *w);
}

/* ------------------------------------------------------------- answers -- */

float world_float_above(double x)
{
    const float f = (float)x;
    return (double)f < x ? nextafterf(f, HUGE_VALF) : f;
}

static int same(union ray_word word, float f)
{
    union ray_word expected;
    expected.f = f;
    return word.u == expected.u;
}

float world_turn(double phi)
{
    const float f = (float)phi;
    return f < 1 ? f : nextafterf(1, 0);
}

int world_agrees(const struct world *w, struct rays *r, int i, int complete)
{
    const cylint_line line = rays_line(r, i);
    cylint_hit hit;
    const size_t shape = cylint_nearest(&w->pack, &line, CYLINT_WANT_ALL, &hit);
    int agrees;
    if (shape == w->n)
        return !rays_hit(r, i) &&
               rays_at(r, RAY_TFAR, i)->u == r->before[RAY_TFAR * r->n + i].u;
    agrees = rays_hit(r, i) && rays_at(r, HIT_PRIM, i)->u == shape &&
             same(*rays_at(r, RAY_TFAR, i), world_float_above(hit.t));
    if (complete && agrees) {
        agrees = same(*rays_at(r, HIT_U, i), (float)hit.z) &&
                 same(*rays_at(r, HIT_V, i), world_turn(hit.phi));
        for (int k = 0; k < 3; k++)
            agrees = agrees && same(r->word[(HIT_NG + k) * r->n + i],
                                    (float)hit.normal[k]);
    }
    return agrees;
}

int world_hits_at(const struct world *w, const struct rays *r, int i,
                  unsigned shape, float t)
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

void world_show(const struct world *w, struct rays *r, int i)
{
    const cylint_line line = rays_line(r, i);
    cylint_hit hit = {0};
    const size_t shape = cylint_nearest(&w->pack, &line, CYLINT_WANT_ALL, &hit);
    fprintf(stderr, "    span %a %a %a  %a %a %a  %a %a\n", line.o[0],
            line.o[1], line.o[2], line.d[0], line.d[1], line.d[2], line.tmin,
            line.tmax);
    if (shape < w->n)
        fprintf(stderr,
                "    library: shape %lu, t %a, z %a, phi %a, "
                "normal %a %a %a\n",
                (unsigned long)shape, hit.t, hit.z, hit.phi, hit.normal[0],
                hit.normal[1], hit.normal[2]);
    else
        fprintf(stderr, "    library: no shape\n");
    fprintf(stderr,
            "    Embree:  geometry %d, shape %u, t %a, u %a, v %a, "
            "Ng %a %a %a\n",
            (int)rays_at(r, HIT_GEOM, i)->u, rays_at(r, HIT_PRIM, i)->u,
            rays_at(r, RAY_TFAR, i)->f, rays_at(r, HIT_U, i)->f,
            rays_at(r, HIT_V, i)->f, rays_at(r, HIT_NG, i)->f,
            r->word[(HIT_NG + 1) * r->n + i].f,
            r->word[(HIT_NG + 2) * r->n + i].f);
}

const int world_scenes[WORLD_SCENES] = {
    SCENE_THIN,    SCENE_FAT,   SCENE_FIBRES,  SCENE_NEEDLES,
    SCENE_DISCS,   SCENE_MIXED, SCENE_DISTANT, SCENE_LENGTHS,
    SCENE_LATTICE, SCENE_ROUND, SCENE_STRANDS};
