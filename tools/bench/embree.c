/*
 * embree.c - shapes in an Embree scene beside Embree's own curves
 *
 * usage: embree SECONDS MOST
 *
 * Scenes have up to MOST cylinders.  Each race of all rivals over one kind of
 * rays takes about SECONDS on one core; the least time of several turns
 * counts.  ratio: rays a second over those of Embree's cone curves (higher is
 * better).
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "embree_rivals.h"
#include "timing.h"

enum { RAYS = 100000, MOST_RIVALS = 8 };

struct contestant {
    const char *name;
    struct rival rival;
    struct timing least;
    long hits;
    double t; /* sum of all hits */
};

static void query_nearest(struct contestant *c, const struct rays *rays)
{
    cylint_rtc_context context;
    cylint_rtc_init(&context);
    c->hits = 0;
    c->t = 0;
    for (int i = 0; i < rays->n; i++) {
        struct RTCRayHit at;
        at.ray = rays->ray[i];
        at.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        cylint_rtc_nearest(c->rival.scene, &context, &at);
        if (at.hit.geomID != RTC_INVALID_GEOMETRY_ID) {
            c->hits++;
            c->t += (double)at.ray.tfar;
        }
    }
}

static void query_any(struct contestant *c, const struct rays *rays)
{
    cylint_rtc_context context;
    cylint_rtc_init(&context);
    c->hits = 0;
    c->t = 0;
    for (int i = 0; i < rays->n; i++) {
        struct RTCRay ray = rays->ray[i];
        cylint_rtc_any(c->rival.scene, &context, &ray);
        c->hits += ray.tfar < 0;
    }
}

typedef void query(struct contestant *c, const struct rays *rays);

/* Runs rounds for `seconds`, at least three; in a round each rival has a
 * turn. */
static void compete(struct contestant *c, int n, query *trace,
                    const struct rays *rays, double seconds)
{
    const struct timing start = timing_now();
    for (int i = 0; i < n; i++)
        c[i].least = (struct timing){HUGE_VAL, HUGE_VAL};
    for (int round = 0; round < 3 || timing_since(start).ns < seconds * 1e9;
         round++)
        for (int i = 0; i < n; i++) {
            const struct timing begin = timing_now();
            trace(&c[i], rays);
            timing_keep_least(&c[i].least, timing_since(begin));
        }
}

static int make_rivals(struct contestant *c, const struct cylinder_kind *kind,
                       const struct cylinders *cylinders, int all)
{
    const char *one = "threads=1";
    const int segments = segments_for(cylinders, kind);
    int n = 0;
    c[n++] = (struct contestant){.name = "curves",
                                 .rival = build_curves(cylinders, 1, one)};
    if (all && segments > 1)
        c[n++] = (struct contestant){
            .name = "curves, split by hand",
            .rival = build_curves(cylinders, segments, one)};
    c[n++] = (struct contestant){.name = "adapter",
                                 .rival = build_shapes(cylinders, 0, one)};
    if (all) {
        c[n++] = (struct contestant){
            .name = "adapter, bare",
            .rival = build_shapes(cylinders, CYLINT_EMBREE_BARE, one)};
        c[n++] = (struct contestant){
            .name = "adapter, no filters",
            .rival = build_shapes(cylinders, CYLINT_EMBREE_NO_FILTERS, one)};
    }
    if (all && kind != &fibre) { /* boxes of fibres are mostly empty */
        c[n++] = (struct contestant){
            .name = "adapter, one shape per primitive",
            .rival = build_shapes(cylinders, CYLINT_EMBREE_SINGLE, one)};
    }
    return n;
}

static void show(const char *scene, size_t n, const char *rays,
                 const struct contestant *c, int rivals, int n_rays)
{
    for (int i = 0; i < rivals; i++)
        printf("%s\t%zu\t%s\t%s\t%.3f\t%.2f\t%.4f\t%.3f\t%.1f\n", scene, n,
               rays, c[i].name, n_rays / c[i].least.ns * 1e3,
               c[0].least.ns / c[i].least.ns, (double)c[i].hits / n_rays,
               c[i].rival.build_seconds, c[i].rival.bytes / (double)n);
    fflush(stdout);
}

static void run(const struct cylinder_kind *kind, size_t n, int all,
                double seconds)
{
    struct contestant c[MOST_RIVALS];
    struct cylinders cylinders = draw_cylinders(kind, n);
    struct rays incoherent = draw_incoherent_rays(RAYS);
    struct rays camera = draw_camera_rays(RAYS);
    const int rivals = make_rivals(c, kind, &cylinders, all);
    compete(c, rivals, query_nearest, &incoherent, seconds);
    show(kind->name, n, "incoherent", c, rivals, incoherent.n);
    compete(c, rivals, query_nearest, &camera, seconds);
    show(kind->name, n, "coherent", c, rivals, camera.n);
    compete(c, rivals, query_any, &incoherent, seconds);
    show(kind->name, n, "occluded", c, rivals, incoherent.n);
    for (int i = 0; i < rivals; i++)
        free_rival(&c[i].rival);
    free_rays(&incoherent);
    free_rays(&camera);
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
        int all;
    } scenes[] = {
        {&thin, 1000, 1},    {&fat, 1000, 1},    {&thin, 10000, 0},
        {&thin, 100000, 1},  {&fat, 100000, 1},  {&fibre, 100000, 1},
        {&thin, 1000000, 1}, {&fat, 1000000, 1}, {&thin, 10000000, 0}};
    timing_begin();
    flush_subnormals();
    puts("# higher is better: Mray/s, ratio (to Embree's cone curves); "
         "lower is better: build s, bytes/shape");
    printf("scene\tn\trays\trival\tMray/s\tratio\thits/ray\tbuild s\t"
           "bytes/shape\n");
    for (size_t i = 0; i < sizeof scenes / sizeof scenes[0]; i++)
        if (scenes[i].n <= most && strstr(scenes[i].kind->name, only))
            run(scenes[i].kind, scenes[i].n, scenes[i].all, seconds);
    return 0;
}
