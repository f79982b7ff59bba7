/*
 * embree_round.c - rounded cones in an Embree scene beside Embree's own curves
 *
 * usage: embree_round SECONDS MOST [NAME]
 *
 * The same points and radii as cones and as rounded cones: Embree's cone curves
 * and round linear curves, and the adapter's shapes.  ratio: rays a second over
 * those of Embree's curves of that form (higher is better).
 *
 * wrong: rays of which the verdict or the nearest shape is wrong, a part of all.
 * The adapter is compared with all shapes one by one (cylint_nearest()), on as
 * many rays as SECONDS allow, at least 100; the curves are compared with the
 * adapter, on all rays.  off: rays of which t differs by more than 1e-4 of it.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "embree_race.h"

enum { RAYS = 100000, RIVALS = 4, LEAST_CHECKED = 100 };

/* The rivals in pairs: Embree's curves, then the adapter. */
struct scene {
    struct cylinders shapes[2]; /* cones, rounded cones */
    struct contestant rival[RIVALS];
};

/* A ray's nearest hit. */
struct nearest {
    unsigned shape;
    float t;
};

/* Rays that were compared, and those that differ. */
struct errors {
    int rays, wrong, off;
};

static void make_scene(struct scene *s, const struct cylinder_kind *kind,
                       size_t n)
{
    const char *one = "threads=1";
    static const char *const names[RIVALS] = {"cone curves", "adapter, cones",
                                              "round curves",
                                              "adapter, rounded cones"};
    for (int round = 0; round < 2; round++) {
        struct contestant *c = s->rival + 2 * round;
        s->shapes[round] = draw_cones(kind, n, round ? ROUND_CONES : CONES);
        c[0].rival = build_curves(&s->shapes[round], 1, one);
        c[1].rival = build_shapes(&s->shapes[round], 0, one);
    }
    for (int i = 0; i < RIVALS; i++)
        s->rival[i].name = names[i];
}

static void free_scene(struct scene *s)
{
    for (int i = 0; i < RIVALS; i++)
        free_rival(&s->rival[i].rival);
    for (int round = 0; round < 2; round++)
        free_cylinders(&s->shapes[round]);
}

static struct nearest trace_ray(const struct contestant *c,
                                const struct RTCRay *ray)
{
    cylint_rtc_context context;
    struct RTCRayHit at;
    cylint_rtc_init(&context);
    at.ray = *ray;
    at.hit.geomID = at.hit.primID = RTC_INVALID_GEOMETRY_ID;
    cylint_rtc_nearest(c->rival.scene, &context, &at);
    return (struct nearest){at.hit.primID, at.ray.tfar};
}

static void compare(struct errors *e, struct nearest x, struct nearest truth)
{
    e->rays++;
    if (x.shape != truth.shape)
        e->wrong++;
    else if (truth.shape != RTC_INVALID_GEOMETRY_ID)
        e->off += !(fabs((double)x.t - (double)truth.t) <=
                    1e-4 * fabs((double)truth.t));
}

static struct errors of_curves(const struct contestant *c,
                               const struct rays *rays)
{
    struct errors e = {0, 0, 0};
    for (int i = 0; i < rays->n; i++)
        compare(&e, trace_ray(&c[0], &rays->ray[i]),
                trace_ray(&c[1], &rays->ray[i]));
    return e;
}

static struct nearest among_all(const cylint_pack *pack,
                                const struct RTCRay *ray)
{
    const double o[3] = {ray->org_x, ray->org_y, ray->org_z};
    const double d[3] = {ray->dir_x, ray->dir_y, ray->dir_z};
    cylint_line line;
    cylint_hit hit;
    cylint_ray(&line, o, d);
    const size_t i = cylint_nearest(pack, &line, CYLINT_WANT_T, &hit);
    return i < pack->n ? (struct nearest){(unsigned)i, (float)hit.t}
                       : (struct nearest){RTC_INVALID_GEOMETRY_ID, 0};
}

static struct errors of_adapter(const struct contestant *c,
                                const struct cylinders *shapes,
                                const struct rays *rays, double seconds)
{
    struct errors e = {0, 0, 0};
    void *memory = need(cylint_pack_bytes(shapes->n));
    cylint_pack pack;
    cylint_pack_shapes(&pack, memory, shapes->shapes, shapes->n);
    const struct timing start = timing_now();
    for (int i = 0; i < rays->n && (i < LEAST_CHECKED ||
                                    timing_since(start).ns < seconds * 1e9);
         i++)
        compare(&e, trace_ray(&c[1], &rays->ray[i]),
                among_all(&pack, &rays->ray[i]));
    free(memory);
    return e;
}

static void show(const char *scene, size_t n, const char *kind,
                 const struct scene *s, const struct rays *rays,
                 const struct errors *errors)
{
    for (int i = 0; i < RIVALS; i++) {
        const struct contestant *c = &s->rival[i];
        printf("%s\t%zu\t%s\t%s\t%.3f\t%.2f\t%.4f\t%.3f\t%.1f", scene, n, kind,
               c->name, rays->n / c->least.ns * 1e3,
               s->rival[i / 2 * 2].least.ns / c->least.ns,
               (double)c->hits / rays->n, c->rival.build_seconds,
               c->rival.bytes / (double)n);
        if (errors)
            printf("\t%d\t%.2g\t%.2g", errors[i].rays,
                   (double)errors[i].wrong / errors[i].rays,
                   (double)errors[i].off / errors[i].rays);
        putchar('\n');
    }
    fflush(stdout);
}

static void run_nearest(struct scene *s, const struct cylinder_kind *kind,
                        const char *name, const struct rays *rays,
                        double seconds)
{
    struct errors errors[RIVALS];
    compete(s->rival, RIVALS, query_nearest, rays, seconds);
    for (int round = 0; round < 2; round++) {
        const struct contestant *c = s->rival + 2 * round;
        errors[2 * round] = of_curves(c, rays);
        errors[2 * round + 1] = of_adapter(c, &s->shapes[round], rays, seconds);
    }
    show(kind->name, s->shapes[0].n, name, s, rays, errors);
}

static void run(const struct scene_size *scene, double seconds)
{
    const struct cylinder_kind *kind = scene->kind;
    const size_t n = scene->n;
    struct scene s;
    struct rays incoherent = draw_incoherent_rays(RAYS);
    struct rays camera = draw_camera_rays(RAYS);
    make_scene(&s, kind, n);
    run_nearest(&s, kind, "incoherent", &incoherent, seconds);
    run_nearest(&s, kind, "coherent", &camera, seconds);
    compete(s.rival, RIVALS, query_any, &incoherent, seconds);
    show(kind->name, n, "occluded", &s, &incoherent, NULL);
    free_scene(&s);
    free_rays(&incoherent);
    free_rays(&camera);
}

int main(int argc, char **argv)
{
    static const struct scene_size scenes[] = {
        {&thin, 1000, 1},          {&fat, 1000, 1},
        {&fibre, 1000, 1},         {&fibre, 100000, 1},
        {&thin, 1000000, 1},       {&fat, 1000000, 1},
        {&thin_stick, 100000, 1},  {&fat_stick, 100000, 1},
        {&thin_stick, 1000000, 1}, {&fat_stick, 1000000, 1}};
    timing_begin();
    puts("# higher is better: Mray/s, ratio (to Embree's curves of that form); "
         "lower is better: build s, bytes/shape, wrong, off");
    printf("scene\tn\trays\trival\tMray/s\tratio\thits/ray\tbuild s\t"
           "bytes/shape\tchecked\twrong\toff\n");
    run_scenes(argc, argv, scenes, sizeof scenes / sizeof scenes[0], run);
    return 0;
}
