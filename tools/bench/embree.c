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

#include "embree_race.h"

enum { RAYS = 100000, MOST_RIVALS = 8 };

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

static void run(const struct scene_size *scene, double seconds)
{
    const struct cylinder_kind *kind = scene->kind;
    const size_t n = scene->n;
    struct contestant c[MOST_RIVALS];
    struct cylinders cylinders = draw_cylinders(kind, n);
    struct rays incoherent = draw_incoherent_rays(RAYS);
    struct rays camera = draw_camera_rays(RAYS);
    const int rivals = make_rivals(c, kind, &cylinders, scene->all);
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
    static const struct scene_size scenes[] = {
        {&thin, 1000, 1},        {&fat, 1000, 1},
        {&thin, 10000, 0},       {&thin, 100000, 1},
        {&fat, 100000, 1},       {&fibre, 100000, 1},
        {&thin, 1000000, 1},     {&fat, 1000000, 1},
        {&thin, 10000000, 0},    {&thin_stick, 100000, 0},
        {&fat_stick, 100000, 0}, {&thin_stick, 1000000, 0},
        {&fat_stick, 1000000, 0}};
    timing_begin();
    puts("# higher is better: Mray/s, ratio (to Embree's cone curves); "
         "lower is better: build s, bytes/shape");
    printf("scene\tn\trays\trival\tMray/s\tratio\thits/ray\tbuild s\t"
           "bytes/shape\n");
    run_scenes(argc, argv, scenes, sizeof scenes / sizeof scenes[0], run);
    return 0;
}
