/*
 * embree_many.c - many small geometries, beside one of all their shapes
 *
 * usage: embree_many SECONDS
 *
 * A cube has 100,000 sticks of one spacing in 512 or in 5832 cells.  Embree's cone
 * curves are a geometry a cell, the adapter's shapes are one a cell, and merged
 * into one of all.  Each race takes about SECONDS.  time: that of a ray
 * over that of the curves (lower is better).
 */
#include <stdio.h>
#include <stdlib.h>

#include "embree_race.h"

enum { SHAPES = 100000, RAYS = 100000, RIVALS = 3 };

static void race(const struct cylinder_kind *kind, size_t parts,
                 const char *name, struct contestant *c,
                 const struct rays *rays, double seconds)
{
    compete(c, RIVALS, query_nearest, rays, seconds);
    for (int i = 0; i < RIVALS; i++)
        printf("%s\t%zu\t%s\t%s\t%.3f\t%.2f\n", kind->name, parts, name,
               c[i].name, rays->n / c[i].least.ns * 1e3,
               c[i].least.ns / c[0].least.ns);
    fflush(stdout);
}

static void run(const struct cylinder_kind *kind, size_t side, double seconds)
{
    const char *one = "threads=1";
    struct cylinders cells = draw_cells(kind, SHAPES, side), all = cells;
    struct rays incoherent = draw_incoherent_rays(RAYS);
    struct rays camera = draw_camera_rays(RAYS);
    all.parts = 1;
    struct contestant c[RIVALS] = {
        {.name = "curves", .rival = build_curves(&cells, 1, one)},
        {.name = "adapter", .rival = build_shapes(&cells, 0, one)},
        {.name = "adapter, merged", .rival = build_shapes(&all, 0, one)}};
    race(kind, cells.parts, "incoherent", c, &incoherent, seconds);
    race(kind, cells.parts, "coherent", c, &camera, seconds);
    for (int i = 0; i < RIVALS; i++)
        free_rival(&c[i].rival);
    free_rays(&incoherent);
    free_rays(&camera);
    free_cylinders(&cells);
}

int main(int argc, char **argv)
{
    const double seconds = argc > 1 ? atof(argv[1]) : 1;
    timing_begin();
    flush_subnormals();
    puts("scene\tgeometries\trays\trival\tMray/s\ttime");
    run(&thin_stick, 8, seconds);
    run(&fat_stick, 8, seconds);
    run(&thin_stick, 18, seconds);
    run(&fat_stick, 18, seconds);
    return 0;
}
