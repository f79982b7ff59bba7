/*
 * embree_packets.c - rays in packets, beside the same rays one by one
 *
 * usage: embree_packets SECONDS MOST [KIND]
 *
 * Scenes have up to MOST cylinders; each race takes about SECONDS.  In a race
 * all rivals trace the same rays one by one and in packets of 4, 8 and 16, each
 * with Embree's flag `coherent` and with `incoherent`.  They take turns on one
 * core, and the least time of each counts.  A camera's rays are in tiles: a
 * packet of 8 is 4 x 2 pixels, a packet of 16 is 4 x 4.
 *
 * Ratios are of rays a second to Embree's cone curves (higher is better).
 * ratio: to the curves with the same packets and flag.  best: to the curves
 * with the packets and flag that are fastest for them.
 */
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "embree_rivals.h"
#include "timing.h"

enum { RAYS = 100000, MOST_LANES = 16, CALLS = 8 };

/* How rays are traced: the rays in a packet, and the flag `coherent`. */
struct call {
    int lanes, coherent;
};

static const struct call calls[CALLS] = {{1, 0}, {4, 0}, {8, 0}, {16, 0},
                                         {1, 1}, {4, 1}, {8, 1}, {16, 1}};

struct contestant {
    const char *name;
    struct rival rival;
    struct timing least[CALLS];
    long hits[CALLS];
};

/* A packet with its hits in Embree's layout: member m of ray i of n is word
 * m n + i, for n = 1 too. */
union packet {
    struct RTCRayHit one;
    struct RTCRayHit4 four;
    struct RTCRayHit8 eight;
    struct RTCRayHit16 sixteen;
    unsigned word[sizeof(struct RTCRayHit16) / 4];
};

enum {
    RAY_WORDS = sizeof(struct RTCRay) / 4,
    TFAR_WORD = offsetof(struct RTCRay, tfar) / 4,
    GEOM_WORD = RAY_WORDS + offsetof(struct RTCHit, geomID) / 4
};

/* -------------------------------------------------------------- queries -- */

/* The arguments of a query beside the rays. */
struct arguments {
    cylint_rtc_context context;
#if CYLINT_EMBREE == 4
    struct RTCIntersectArguments nearest;
    struct RTCOccludedArguments any;
#endif
};

static void set_arguments(struct arguments *a, int coherent)
{
    cylint_rtc_init(&a->context);
#if CYLINT_EMBREE == 4
    rtcInitIntersectArguments(&a->nearest);
    rtcInitOccludedArguments(&a->any);
    a->nearest.context = a->any.context = &a->context;
    a->nearest.flags = a->any.flags =
        coherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
#else
    a->context.flags = coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT
                                : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
#endif
}

#if CYLINT_EMBREE == 4
#define NEAREST(n, packet) rtcIntersect##n(valid, scene, packet, &a->nearest)
#define NEAREST_ONE(packet) rtcIntersect1(scene, packet, &a->nearest)
#define ANY(n, packet) rtcOccluded##n(valid, scene, packet, &a->any)
#define ANY_ONE(packet) rtcOccluded1(scene, packet, &a->any)
#else
#define NEAREST(n, packet) rtcIntersect##n(valid, scene, &a->context, packet)
#define NEAREST_ONE(packet) rtcIntersect1(scene, &a->context, packet)
#define ANY(n, packet) rtcOccluded##n(valid, scene, &a->context, packet)
#define ANY_ONE(packet) rtcOccluded1(scene, &a->context, packet)
#endif

static const int valid[MOST_LANES] __attribute__((aligned(64))) = {
    -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1};

static void query_nearest(struct arguments *a, RTCScene scene, int lanes,
                          union packet *packet)
{
    switch (lanes) {
    case 1:
        NEAREST_ONE(&packet->one);
        break;
    case 4:
        NEAREST(4, &packet->four);
        break;
    case 8:
        NEAREST(8, &packet->eight);
        break;
    default:
        NEAREST(16, &packet->sixteen);
        break;
    }
}

static void query_any(struct arguments *a, RTCScene scene, int lanes,
                      union packet *packet)
{
    switch (lanes) {
    case 1:
        ANY_ONE(&packet->one.ray);
        break;
    case 4:
        ANY(4, &packet->four.ray);
        break;
    case 8:
        ANY(8, &packet->eight.ray);
        break;
    default:
        ANY(16, &packet->sixteen.ray);
        break;
    }
}

/* The rays in the layout of packets. */
static unsigned *in_lanes(const struct rays *rays, int lanes)
{
    unsigned *words = need((size_t)rays->n * RAY_WORDS * sizeof *words);
    for (int i = 0; i < rays->n; i++) {
        unsigned *packet = words + (size_t)(i - i % lanes) * RAY_WORDS;
        for (int m = 0; m < RAY_WORDS; m++)
            memcpy(&packet[m * lanes + i % lanes],
                   (const char *)&rays->ray[i] + 4 * m, 4);
    }
    return words;
}

typedef void query(struct arguments *a, RTCScene scene, int lanes,
                   union packet *packet);

/* Traces n rays.  Returns the number of hits: rays with a geometry ID or, of
 * occlusion queries, with a negative tfar. */
static long trace(RTCScene scene, query *query_rays, const struct call *how,
                  const unsigned *rays, int n)
{
    union packet packet __attribute__((aligned(64)));
    struct arguments a;
    const int lanes = how->lanes;
    unsigned *geom = packet.word + GEOM_WORD * lanes;
    const unsigned *tfar = packet.word + TFAR_WORD * lanes;
    long hits = 0;
    set_arguments(&a, how->coherent);
    for (int i = 0; i < n; i += lanes) {
        memcpy(packet.word, rays + (size_t)i * RAY_WORDS,
               (size_t)lanes * RAY_WORDS * sizeof *rays);
        for (int k = 0; k < lanes; k++)
            geom[k] = RTC_INVALID_GEOMETRY_ID;
        query_rays(&a, scene, lanes, &packet);
        for (int k = 0; k < lanes; k++)
            hits += geom[k] != RTC_INVALID_GEOMETRY_ID || tfar[k] >> 31;
    }
    return hits;
}

/* ---------------------------------------------------------------- races -- */

static void compete(struct contestant *c, int n, query *query_rays,
                    unsigned *const rays[CALLS], int n_rays, double seconds)
{
    const struct timing start = timing_now();
    for (int i = 0; i < n; i++)
        for (int k = 0; k < CALLS; k++)
            c[i].least[k] = (struct timing){HUGE_VAL, HUGE_VAL};
    for (int round = 0; round < 3 || timing_since(start).ns < seconds * 1e9;
         round++)
        for (int k = 0; k < CALLS; k++)
            for (int i = 0; i < n; i++) {
                const struct timing begin = timing_now();
                c[i].hits[k] = trace(c[i].rival.scene, query_rays, &calls[k],
                                     rays[k], n_rays);
                timing_keep_least(&c[i].least[k], timing_since(begin));
            }
}

static void show(const char *scene, size_t n, const char *rays,
                 const struct contestant *c, int rivals, int n_rays)
{
    double best = HUGE_VAL;
    for (int k = 0; k < CALLS; k++)
        best = fmin(best, c[0].least[k].ns);
    for (int k = 0; k < CALLS; k++)
        for (int i = 0; i < rivals; i++)
            printf("%s\t%zu\t%s\t%d\t%s\t%s\t%.3f\t%.2f\t%.2f\t%.4f\n", scene,
                   n, rays, calls[k].lanes,
                   calls[k].coherent ? "coherent" : "incoherent", c[i].name,
                   n_rays / c[i].least[k].ns * 1e3,
                   c[0].least[k].ns / c[i].least[k].ns, best / c[i].least[k].ns,
                   (double)c[i].hits[k] / n_rays);
    fflush(stdout);
}

static void race(const char *scene, size_t n, const char *name,
                 query *query_rays, struct rays rays, struct contestant *c,
                 int rivals, double seconds)
{
    unsigned *lanes[CALLS];
    rays.n -= rays.n % MOST_LANES;
    for (int k = 0; k < CALLS; k++)
        lanes[k] = in_lanes(&rays, calls[k].lanes);
    compete(c, rivals, query_rays, lanes, rays.n, seconds);
    show(scene, n, name, c, rivals, rays.n);
    for (int k = 0; k < CALLS; k++)
        free(lanes[k]);
    free_rays(&rays);
}

static void run(const struct scene_size *scene, double seconds)
{
    const struct cylinder_kind *kind = scene->kind;
    const size_t n = scene->n;
    const char *one = "threads=1";
    struct cylinders cylinders = draw_cylinders(kind, n);
    struct contestant c[] = {
        {.name = "curves", .rival = build_curves(&cylinders, 1, one)},
        {.name = "adapter", .rival = build_shapes(&cylinders, 0, one)},
        {.name = "adapter, no filters",
         .rival = build_shapes(&cylinders, CYLINT_EMBREE_NO_FILTERS, one)}};
    enum { RIVALS = sizeof c / sizeof *c };
    race(kind->name, n, "camera", query_nearest, draw_camera_rays(RAYS), c,
         RIVALS, seconds);
    race(kind->name, n, "camera, occluded", query_any, draw_camera_rays(RAYS),
         c, RIVALS, seconds);
    race(kind->name, n, "incoherent", query_nearest, draw_incoherent_rays(RAYS),
         c, RIVALS, seconds);
    for (int i = 0; i < RIVALS; i++)
        free_rival(&c[i].rival);
    free_cylinders(&cylinders);
}

int main(int argc, char **argv)
{
    static const struct scene_size scenes[] = {
        {&thin, 1000, 1},  {&fat, 1000, 1},     {&thin, 100000, 1},
        {&fat, 100000, 1}, {&fibre, 100000, 1}, {&thin, 1000000, 1},
        {&fat, 1000000, 1}};
    timing_begin();
    puts("# higher is better: Mray/s, ratio and best (to Embree's cone "
         "curves)");
    printf("scene\tn\trays\tlanes\tflag\trival\tMray/s\tratio\tbest\t"
           "hits/ray\n");
    run_scenes(argc, argv, scenes, sizeof scenes / sizeof scenes[0], run);
    return 0;
}
