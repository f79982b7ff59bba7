/*
 * embree_scenes.c - random shapes in a cube, and rays through it
 */
#include "embree_scenes.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

const struct cylinder_kind thin = {"thin", 3, 1.0 / 20, 8};
const struct cylinder_kind fat = {"fat", 1.2, 1.0 / 3, 8};
const struct cylinder_kind fibre = {"fibre", 10, 1.0 / 500, 32};
const struct cylinder_kind thin_stick = {"thin stick", 1, 1.0 / 20, 8};
const struct cylinder_kind fat_stick = {"fat stick", 1, 1.0 / 3, 8};

void *need(size_t bytes)
{
    void *p = malloc(bytes ? bytes : 1);
    if (!p) {
        fprintf(stderr, "embree: out of memory\n");
        exit(4);
    }
    return p;
}

/* A random number in [0, 1) by xorshift64* [Vigna 2016]. */
static double draw(uint64_t *state)
{
    uint64_t x = *state;
    x ^= x >> 12;
    x ^= x << 25;
    x ^= x >> 27;
    *state = x;
    return (double)(x * 0x2545F4914F6CDD1Du >> 11) * 0x1p-53;
}

static void draw_unit(uint64_t *state, double v[3])
{
    const double z = 2 * draw(state) - 1,
                 a = 2 * 3.14159265358979 * draw(state);
    const double r = sqrt(1 - z * z);
    v[0] = r * cos(a);
    v[1] = r * sin(a);
    v[2] = z;
}

static void make_shape(const struct cylinders *c, size_t i)
{
    double p[2][3];
    const double r0 = c->radius[i][0], r1 = c->radius[i][1];
    for (int end = 0; end < 2; end++)
        for (int j = 0; j < 3; j++)
            p[end][j] = c->ends[i][end][j];
    if (c->form == ROUND_CONES)
        cylint_round_cone(&c->shapes[i], p[0], r0, p[1], r1,
                          CYLINT_ENDS_CAPPED);
    else
        cylint_cone(&c->shapes[i], p[0], r0, p[1], r1, CYLINT_ENDS_CAPPED);
}

static struct cylinders allocate(size_t n, enum form form, size_t parts)
{
    return (struct cylinders){n,
                              form,
                              need(n * sizeof(float[2][3])),
                              need(n * sizeof(float[2])),
                              need(n * sizeof(cylint_shape)),
                              parts};
}

/* In a cube of this side with this corner. */
static void draw_shapes(const struct cylinders *c,
                        const struct cylinder_kind *kind, uint64_t *state,
                        const double corner[3], double side)
{
    const double length = side * kind->length / cbrt((double)c->n);
    for (size_t i = 0; i < c->n; i++) {
        double u[3];
        draw_unit(state, u);
        for (int j = 0; j < 3; j++) {
            const double middle = corner[j] + side * draw(state);
            for (int end = 0; end < 2; end++)
                c->ends[i][end][j] =
                    (float)(middle + (end - 0.5) * length * u[j]);
        }
        for (int end = 0; end < 2; end++) {
            const double part =
                c->form == CYLINDERS ? 1 : 0.5 + 0.5 * draw(state);
            c->radius[i][end] = (float)(length * kind->radius * part);
        }
        make_shape(c, i);
    }
}

struct cylinders draw_cones(const struct cylinder_kind *kind, size_t n,
                            enum form form)
{
    static const double corner[3] = {0, 0, 0};
    uint64_t state = 20261121;
    const struct cylinders c = allocate(n, form, 1);
    draw_shapes(&c, kind, &state, corner, 1);
    return c;
}

struct cylinders draw_cells(const struct cylinder_kind *kind, size_t n,
                            size_t side)
{
    uint64_t state = 20261122;
    const size_t cells = side * side * side;
    const struct cylinders c = allocate(n / cells * cells, CYLINDERS, cells);
    for (size_t k = 0; k < cells; k++) {
        const struct cylinders part = part_of(&c, k);
        const double corner[3] = {(double)(k % side) / (double)side,
                                  (double)(k / side % side) / (double)side,
                                  (double)(k / side / side) / (double)side};
        draw_shapes(&part, kind, &state, corner, 1 / (double)side);
    }
    return c;
}

struct cylinders part_of(const struct cylinders *c, size_t part)
{
    const size_t n = c->n / c->parts, from = part * n;
    return (struct cylinders){
        n, c->form, c->ends + from, c->radius + from, c->shapes + from, 1};
}

struct cylinders draw_cylinders(const struct cylinder_kind *kind, size_t n)
{
    return draw_cones(kind, n, CYLINDERS);
}

void free_cylinders(struct cylinders *c)
{
    free(c->ends);
    free(c->radius);
    free(c->shapes);
}

static struct RTCRay ray_along(const double o[3], const double d[3])
{
    const double size = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    struct RTCRay ray = {0};
    ray.org_x = (float)o[0];
    ray.org_y = (float)o[1];
    ray.org_z = (float)o[2];
    ray.dir_x = (float)(d[0] / size);
    ray.dir_y = (float)(d[1] / size);
    ray.dir_z = (float)(d[2] / size);
    ray.tfar = HUGE_VALF;
    ray.mask = 0xFFFFFFFFu;
    return ray;
}

struct rays draw_incoherent_rays(int n)
{
    uint64_t state = 11261202;
    struct rays r = {n, need((size_t)n * sizeof *r.ray)};
    for (int i = 0; i < n; i++) {
        double o[3], d[3];
        draw_unit(&state, d);
        for (int j = 0; j < 3; j++)
            o[j] = draw(&state);
        r.ray[i] = ray_along(o, d);
    }
    return r;
}

/* The pixel of ray i.  A tile is 4 x 4 pixels, made of halves of 4 x 2, made
 * of quarters of 2 x 2. */
static void pixel_of(int i, int side, int *x, int *y)
{
    const int tile = i / 16, across = side / 4;
    *x = tile % across * 4 + (i & 1) + (i >> 2 & 1) * 2;
    *y = tile / across * 4 + (i >> 1 & 1) + (i >> 3 & 1) * 2;
}

struct rays draw_camera_rays(int n)
{
    const int side = (int)sqrt(n) / 4 * 4;
    struct rays r = {side * side, need((size_t)n * sizeof *r.ray)};
    for (int i = 0; i < r.n; i++) {
        int x, y;
        pixel_of(i, side, &x, &y);
        const double o[3] = {0.5, 0.5, -1};
        const double d[3] = {(x + 0.5) / side - 0.5, (y + 0.5) / side - 0.5, 1};
        r.ray[i] = ray_along(o, d);
    }
    return r;
}

void free_rays(struct rays *r)
{
    free(r->ray);
}

void flush_subnormals(void)
{
#if defined(__SSE2__)
    _mm_setcsr(_mm_getcsr() | 0x8040);
#endif
}

void run_scenes(int argc, char **argv, const struct scene_size *scenes,
                size_t count, void (*run)(const struct scene_size *, double))
{
    const double seconds = argc > 1 ? atof(argv[1]) : 1;
    const size_t most = argc > 2 ? (size_t)atof(argv[2]) : 1000000;
    const char *only = argc > 3 ? argv[3] : "";
    flush_subnormals();
    for (size_t i = 0; i < count; i++)
        if (scenes[i].n <= most && strstr(scenes[i].kind->name, only))
            run(&scenes[i], seconds);
}
