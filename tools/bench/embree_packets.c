/*
 * embree_packets.c - rays in packets, beside the same rays one by one
 *
 * usage: embree_packets SECONDS MOST [KIND]
 *
 * Scenes of up to MOST cylinders; about SECONDS for each race.  In a race all
 * rivals are given the same rays one by one and in packets of 4, 8 and 16,
 * which are said to be coherent or not to be: all those take turns on one
 * core, and the least time of each counts.  A camera's rays come as tiles, 8
 * as 4 x 2, 16 as 4 x 4, whoever is asked.
 *
 * ratio: of rays a second, the curves asked in the same way being 1; best: the
 * curves asked in the way that is best for them being 1.
 */
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "embree_rivals.h"
#include "timing.h"

enum { RAYS = 100000, MOST_LANES = 16, WAYS = 8 };

/* How rays are asked: in packets of so many, said to be coherent. */
struct manner {
    int lanes, coherent;
};

static const struct manner manners[WAYS] = {{1, 0}, {4, 0}, {8, 0}, {16, 0},
                                            {1, 1}, {4, 1}, {8, 1}, {16, 1}};

struct contestant {
    const char *name;
    struct rival rival;
    struct timing least[WAYS];
    long hits[WAYS];
};

/* A packet with its hits, as Embree has it: member m of ray i of n is word m n
 * + i, for n = 1 too. */
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

/* ------------------------------------------------------------ questions -- */

/* What Embree is told beside the rays. */
struct asking {
    cylint_rtc_context context;
#if CYLINT_EMBREE == 4
    struct RTCIntersectArguments nearest;
    struct RTCOccludedArguments any;
#endif
};

static void begin_asking(struct asking *a, int coherent)
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

static void ask_nearest(struct asking *a, RTCScene scene, int lanes,
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

static void ask_any(struct asking *a, RTCScene scene, int lanes,
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

/* Rays as packets have them. */
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

typedef void query(struct asking *a, RTCScene scene, int lanes,
                   union packet *packet);

/* Returns how many hit: a geometry, or something, so that tfar is negative. */
static long trace(RTCScene scene, query *ask, const struct manner *how,
                  const unsigned *rays, int n)
{
    union packet packet __attribute__((aligned(64)));
    struct asking a;
    const int lanes = how->lanes;
    unsigned *geom = packet.word + GEOM_WORD * lanes;
    const unsigned *tfar = packet.word + TFAR_WORD * lanes;
    long hits = 0;
    begin_asking(&a, how->coherent);
    for (int i = 0; i < n; i += lanes) {
        memcpy(packet.word, rays + (size_t)i * RAY_WORDS,
               (size_t)lanes * RAY_WORDS * sizeof *rays);
        for (int k = 0; k < lanes; k++)
            geom[k] = RTC_INVALID_GEOMETRY_ID;
        ask(&a, scene, lanes, &packet);
        for (int k = 0; k < lanes; k++)
            hits += geom[k] != RTC_INVALID_GEOMETRY_ID || tfar[k] >> 31;
    }
    return hits;
}

/* ---------------------------------------------------------------- races -- */

static void compete(struct contestant *c, int n, query *ask,
                    unsigned *const rays[WAYS], int n_rays, double seconds)
{
    const struct timing start = timing_now();
    for (int i = 0; i < n; i++)
        for (int way = 0; way < WAYS; way++)
            c[i].least[way] = (struct timing){HUGE_VAL, HUGE_VAL};
    for (int round = 0; round < 3 || timing_since(start).ns < seconds * 1e9;
         round++)
        for (int way = 0; way < WAYS; way++)
            for (int i = 0; i < n; i++) {
                const struct timing begin = timing_now();
                c[i].hits[way] = trace(c[i].rival.scene, ask, &manners[way],
                                       rays[way], n_rays);
                timing_keep_least(&c[i].least[way], timing_since(begin));
            }
}

static void show(const char *scene, size_t n, const char *rays,
                 const struct contestant *c, int rivals, int n_rays)
{
    double best = HUGE_VAL;
    for (int way = 0; way < WAYS; way++)
        best = fmin(best, c[0].least[way].ns);
    for (int way = 0; way < WAYS; way++)
        for (int i = 0; i < rivals; i++)
            printf("%s\t%zu\t%s\t%d\t%s\t%s\t%.3f\t%.2f\t%.2f\t%.4f\n", scene,
                   n, rays, manners[way].lanes,
                   manners[way].coherent ? "coherent" : "incoherent", c[i].name,
                   n_rays / c[i].least[way].ns * 1e3,
                   c[0].least[way].ns / c[i].least[way].ns,
                   best / c[i].least[way].ns, (double)c[i].hits[way] / n_rays);
    fflush(stdout);
}

static void race(const char *scene, size_t n, const char *name, query *ask,
                 struct rays rays, struct contestant *c, int rivals,
                 double seconds)
{
    unsigned *lanes[WAYS];
    rays.n -= rays.n % MOST_LANES;
    for (int way = 0; way < WAYS; way++)
        lanes[way] = in_lanes(&rays, manners[way].lanes);
    compete(c, rivals, ask, lanes, rays.n, seconds);
    show(scene, n, name, c, rivals, rays.n);
    for (int way = 0; way < WAYS; way++)
        free(lanes[way]);
    free_rays(&rays);
}

static void run(const struct cylinder_kind *kind, size_t n, double seconds)
{
    const char *one = "threads=1";
    struct cylinders cylinders = draw_cylinders(kind, n);
    struct contestant c[] = {
        {.name = "curves", .rival = build_curves(&cylinders, 1, one)},
        {.name = "blocks", .rival = build_shapes(&cylinders, 0, one)},
        {.name = "blocks, no filters",
         .rival = build_shapes(&cylinders, CYLINT_EMBREE_NO_FILTERS, one)}};
    enum { RIVALS = sizeof c / sizeof *c };
    race(kind->name, n, "camera", ask_nearest, draw_camera_rays(RAYS), c,
         RIVALS, seconds);
    race(kind->name, n, "camera, occluded", ask_any, draw_camera_rays(RAYS), c,
         RIVALS, seconds);
    race(kind->name, n, "anyhow", ask_nearest, draw_incoherent_rays(RAYS), c,
         RIVALS, seconds);
    for (int i = 0; i < RIVALS; i++)
        free_rival(&c[i].rival);
    free_cylinders(&cylinders);
}

int main(int argc, char **argv)
{
    const double seconds = argc > 1 ? atof(argv[1]) : 1;
    const size_t most = argc > 2 ? (size_t)atof(argv[2]) : 1000000;
    const char *only = argc > 3 ? argv[3] : "";
    static const struct {
        const struct cylinder_kind *kind;
        size_t n;
    } scenes[] = {{&thin, 1000},  {&fat, 1000},     {&thin, 100000},
                  {&fat, 100000}, {&fibre, 100000}, {&thin, 1000000},
                  {&fat, 1000000}};
    timing_begin();
    flush_subnormals();
    printf("scene\tn\trays\tlanes\tsaid to be\trival\tMray/s\tratio\tbest\t"
           "hits/ray\n");
    for (size_t i = 0; i < sizeof scenes / sizeof scenes[0]; i++)
        if (scenes[i].n <= most && strstr(scenes[i].kind->name, only))
            run(scenes[i].kind, scenes[i].n, seconds);
    return 0;
}
