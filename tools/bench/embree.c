/*
 * embree.c - shapes in scenes of Embree, beside its own linear curves
 *
 * Cylinders beside cone curves, round cones beside round curves.  The rays are
 * the same; "wrong" are rays for which the curves have another nearest shape.
 */
#include "embree.h"

#include <cylint_embree.h>
#include <string.h>
#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

#include "inputs.h"
#include "shapes/layout.h"

enum { RAYS = 160 * 160, LANES = 16 };
enum { CURVES = -1, MERGED = -2 }; /* in place of the adapter's flags */

/* A scene and its rays. */
struct world {
    RTCDevice device;
    RTCScene scene;
    RTCGeometry *part; /* of the adapter */
    size_t parts;
    double bytes;
};

static struct {
    cylint_line line[RAYS];
    struct world ours[KERNELS_MOST], curves;
    struct world bare[KERNELS_MOST]; /* or merged */
} in;

/* The adapter's scene that was made with the kernels in use. */
static const struct world *in_use(const struct world *worlds)
{
    return worlds == &in.curves ? worlds : &worlds[kernels_in_use()];
}

/* ---------------------------------------------------------------- scenes -- */

static bool count_bytes(void *user, ssize_t bytes, bool post)
{
    (void)post;
    *(double *)user += (double)bytes;
    return true;
}

/* Cone or round curves of the shapes first to last - 1. */
static RTCGeometry curves_of(RTCDevice device, const struct sticks *s,
                             size_t first, size_t last)
{
    const size_t n = last - first;
    RTCGeometry g = rtcNewGeometry(
        device, s->is_round ? RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE
                            : RTC_GEOMETRY_TYPE_CONE_LINEAR_CURVE);
    float *vertex = rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0,
                                            RTC_FORMAT_FLOAT4, 16, 2 * n);
    unsigned *index = rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0,
                                              RTC_FORMAT_UINT, 4, n);
    unsigned char *flags = rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_FLAGS, 0,
                                                   RTC_FORMAT_UCHAR, 1, n);
    for (size_t i = first; i < last; i++)
        for (int k = 0; k < 2; k++) {
            const cylint_shape *from = &s->shapes[i];
            const double *end = k ? cylint_top(from) : cylint_base(from);
            for (int j = 0; j < 3; j++)
                *vertex++ = (float)end[j];
            *vertex++ = (float)cylint_radii(from)[k];
        }
    for (size_t i = 0; i < n; i++) {
        index[i] = (unsigned)(2 * i);
        flags[i] = 0;
    }
    rtcSetGeometryMask(g, 0xFFFFFFFFu);
    rtcCommitGeometry(g);
    return g;
}

/* How many geometries: one for each cell. */
static size_t parts_of(const struct sticks *s)
{
    return s->side * s->side * s->side;
}

static cylint_embree_part cell(const struct sticks *s, size_t k)
{
    const size_t parts = parts_of(s), first = k * s->n / parts;
    return (cylint_embree_part){.shapes = s->shapes + first,
                                .n = (k + 1) * s->n / parts - first,
                                .geomID = (unsigned)k};
}

/* The geometry of cell k, or the one that is merged of all cells. */
static RTCGeometry geometry_of(RTCDevice device, const struct sticks *s,
                               size_t k, int flags)
{
    const cylint_embree_options options = {.flags = (unsigned)flags};
    const cylint_embree_part c = cell(s, k);
    const size_t parts = parts_of(s), first = (size_t)(c.shapes - s->shapes);
    if (flags == CURVES)
        return curves_of(device, s, first, first + c.n);
    if (flags != MERGED)
        return cylint_embree_geometry(device, c.shapes, c.n, &options, NULL);
    cylint_embree_part *part = allocate(parts * sizeof *part);
    for (k = 0; k < parts; k++)
        part[k] = cell(s, k);
    RTCGeometry g = cylint_embree_merge(device, part, parts, NULL, NULL);
    free(part);
    return g;
}

/* flags: of the adapter, CURVES or MERGED. */
static void build(struct world *w, const struct sticks *s, int flags)
{
    *w = (struct world){.device = embree_device(),
                        .parts = flags == MERGED ? 1 : parts_of(s)};
    rtcSetDeviceMemoryMonitorFunction(w->device, count_bytes, &w->bytes);
    w->scene = rtcNewScene(w->device);
    w->part = allocate(w->parts * sizeof *w->part);
    for (size_t k = 0; k < w->parts; k++) {
        w->part[k] = geometry_of(w->device, s, k, flags);
        require(w->part[k] != NULL, "no geometry was made");
        rtcAttachGeometry(w->scene, w->part[k]);
        if (flags == CURVES)
            rtcReleaseGeometry(w->part[k]);
    }
    rtcCommitScene(w->scene);
    rtcSetDeviceMemoryMonitorFunction(w->device, NULL, NULL);
}

static void release(struct world *w, int is_ours)
{
    if (!w->device)
        return;
    for (size_t k = 0; k < w->parts && is_ours; k++)
        cylint_embree_release(w->part[k]);
    free(w->part);
    rtcReleaseScene(w->scene);
    rtcReleaseDevice(w->device);
    w->device = NULL;
}

/* ----------------------------------------------------------------- turns -- */

static unsigned nearest_of(const struct world *w, int i, float *t)
{
    struct RTCRayHit at = {.ray = embree_ray(&in.line[i])};
    at.hit.geomID = at.hit.primID = RTC_INVALID_GEOMETRY_ID;
    embree_nearest(w->scene, &at);
    *t = at.ray.tfar;
    return at.hit.primID;
}

static inline double t_of(const struct world *w, int i)
{
    float t;
    return nearest_of(w, i, &t) != RTC_INVALID_GEOMETRY_ID ? (double)t : 0;
}

static inline int any_of(const struct world *w, int i)
{
    struct RTCRay ray = embree_ray(&in.line[i]);
    embree_any(w->scene, &ray);
    return ray.tfar < 0;
}

#define WORLD const struct world *w = in_use(input)
BENCH_TURN(nearest, WORLD, t_of(w, i))
BENCH_TURN(any, WORLD, any_of(w, i))

/* Sixteen neighbours at once, in Embree's layout: word m of ray i is word 16 m + i
 * of the packet. */
static double nearest_in_packets(const void *worlds, const int *order, int n)
{
    static const int valid[LANES] __attribute__((aligned(64))) = {
        -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1};
    const struct world *w = in_use(worlds);
    struct RTCRayHit16 all __attribute__((aligned(64)));
    double sum = 0;
    for (int k = 0; k + LANES <= n; k += LANES) {
        for (int i = 0; i < LANES; i++) {
            const struct RTCRay one = embree_ray(&in.line[order[k + i]]);
            for (size_t m = 0; m < sizeof one / 4; m++)
                memcpy((char *)&all.ray + 4 * (LANES * m + (size_t)i),
                       (const char *)&one + 4 * m, 4);
            all.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
        }
        embree_nearest16(valid, w->scene, &all);
        for (int i = 0; i < LANES; i++)
            if (all.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID)
                sum += (double)all.ray.tfar[i];
    }
    return sum;
}

/* -------------------------------------------------------------- contests -- */

enum { WHOLE = 1, IN_PARTS = 2 }; /* scenes of one geometry, of several */

static const struct {
    int of;
    const char *text;
    draw_rays *draw;
    bench_turn *turn;
    const struct world *worlds;
} questions[] = {
    {WHOLE | IN_PARTS, "nearest; incoherent", draw_incoherent, nearest,
     in.ours},
    {IN_PARTS, "nearest; incoherent", draw_incoherent, nearest, in.bare},
    {WHOLE, "any; incoherent", draw_incoherent, any, in.ours},
    {WHOLE, "any; incoherent; no filters", draw_incoherent, any, in.bare},
    {WHOLE | IN_PARTS, "nearest; camera", draw_coherent, nearest, in.ours},
    {IN_PARTS, "nearest; camera", draw_coherent, nearest, in.bare},
    {WHOLE, "nearest; camera; bare", draw_coherent, nearest, in.bare},
    {WHOLE, "nearest; camera; packets", draw_coherent, nearest_in_packets,
     in.ours}};

/* Several parts: a geometry for each cell, or all merged. */
static void compare(const struct sticks *s)
{
    const int of = s->side > 1 ? IN_PARTS : WHOLE;
    for (size_t q = 0; q < sizeof questions / sizeof *questions; q++) {
        char parts[32];
        if (!(questions[q].of & of))
            continue;
        snprintf(parts, sizeof parts, "%zu parts%s", parts_of(s),
                 questions[q].worlds == in.bare ? " merged" : "");
        questions[q].draw(RAYS, in.line);
        compete(&(struct contest){.subject = s->name,
                                  .question = questions[q].text,
                                  .setup = of == IN_PARTS ? parts : NULL,
                                  .rival = s->is_round ? "Embree's round curves"
                                                       : "Embree's cone curves",
                                  .theirs = questions[q].turn,
                                  .ours = questions[q].turn,
                                  .input = questions[q].worlds,
                                  .others = &in.curves,
                                  .questions = RAYS});
    }
}

static void print_figures(const struct sticks *s)
{
    int wrong = 0;
    draw_incoherent(RAYS, in.line);
    for (int i = 0; i < RAYS; i++) {
        float t;
        wrong +=
            nearest_of(&in.curves, i, &t) != nearest_of(&in.ours[0], i, &t);
    }
    print_figure(s->name, "wrong; incoherent", NULL, "curves", "%",
                 100.0 * wrong / RAYS, 0);
    print_figure(s->name, "a shape", NULL, "curves", "bytes",
                 in.curves.bytes / (double)s->n,
                 in.ours[0].bytes / (double)s->n);
}

static void compare_sticks(const struct sticks *s)
{
    const int is_whole = s->side == 1;
    build(&in.curves, s, CURVES);
    for (int k = 0; use_kernels(k); k++) {
        build(&in.ours[k], s, 0);
        build(&in.bare[k], s,
              is_whole ? CYLINT_EMBREE_NO_FILTERS | CYLINT_EMBREE_BARE
                       : MERGED);
    }
    compare(s);
    if (is_whole)
        print_figures(s);
    release(&in.curves, 0);
    for (int k = 0; k < KERNELS_MOST; k++) {
        release(&in.ours[k], 1);
        release(&in.bare[k], 1);
    }
}

void bench_embree(void)
{
    static const struct {
        const struct stick_kind *kind;
        double n;
        int is_round;
        size_t side;
    } scenes[] = {{&thin, 1e3, 0, 1},        {&fat, 1e3, 0, 1},
                  {&thin_sticks, 1e5, 0, 1}, {&fat_sticks, 1e5, 0, 1},
                  {&fibres, 1e5, 0, 1},      {&thin, 1e6, 0, 1},
                  {&thin_sticks, 1e6, 0, 1}, {&fat_sticks, 1e6, 0, 1},
                  {&thin_sticks, 1e6, 1, 1}, {&fat_sticks, 1e6, 1, 1},
                  {&thin_sticks, 1e5, 0, 8}, {&fat_sticks, 1e5, 0, 8},
                  {&fat_sticks, 1e5, 0, 18}};
#if defined(__SSE2__)
    _mm_setcsr(_mm_getcsr() | 0x8040); /* subnormals are 0: Embree's advice */
#endif
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++)
        with_sticks(scenes[i].kind, scenes[i].n, scenes[i].is_round,
                    scenes[i].side, compare_sticks);
}
