/*
 * single.c - one line, one shape: the library beside the leanest formula
 *
 * 4096 different pairs of line and shape.  Ordinary rays of which 93, 22 and 1
 * % hit, and rays that are hard: from far away, grazing, nearly parallel to the
 * axis, from the surface.
 */
#include "lean.h"

enum { PAIRS = 4096 };
enum family { ORDINARY, FAR, GRAZING, PARALLEL, SURFACE, FAMILIES };

static const char *const family_names[FAMILIES] = {
    "", "from 1e5 to 1e7 away", "grazing 1e-4 to 1e-13",
    "parallel 1e-3 to 1e-9", "from the surface"};

static struct {
    struct solid solid[PAIRS];
    cylint_shape shape[PAIRS];
    struct lean lean[PAIRS];
    cylint_line line[PAIRS];
    lean_line *both;
    lean_normal *first;
    uint64_t random;
} in;

/* ------------------------------------------------------------------ rays -- */

/* From a cube of 12 about the shape to a cube of 2 spread about its middle. */
static void ordinary_ray(int i, double spread)
{
    const double *middle = in.solid[i].middle;
    double o[3], d[3];
    for (int c = 0; c < 3; c++) {
        o[c] = middle[c] + between(&in.random, -6, 6);
        d[c] = middle[c] + between(&in.random, -spread, spread) - o[c];
    }
    normalise(d);
    make_ray(&in.line[i], o, d);
}

/* Draws all rays.  Returns the percentage of hits. */
static double ordinary_rays(double spread)
{
    int hits = 0;
    in.random = 11;
    for (int i = 0; i < PAIRS; i++) {
        ordinary_ray(i, spread);
        hits += cylint_occluded(&in.shape[i], &in.line[i]);
    }
    return (100 * hits + PAIRS / 2) / PAIRS;
}

/* A unit vector across the axis. */
static void draw_across(const struct solid *s, double v[3])
{
    double d[3];
    draw_direction(&in.random, d);
    cross3(v, d, s->axis);
    normalise(v);
}

/* A ray in the tangent plane of the middle's ruling, but for 1e-4 to 1e-13
 * radii. */
static void grazing_ray(int i)
{
    const struct solid *s = &in.solid[i];
    double x[3], n[3], w[3], o[3], d[3];
    const double sign = random_below(&in.random, 2) ? 1 : -1;
    const double excess = sign * power_between(&in.random, -13, -4);
    const double radius = 0.5 * (s->r0 + s->r1);
    draw_across(s, x);
    for (int c = 0; c < 3; c++)
        w[c] = s->axis[c];
    const double growth = (s->r1 - s->r0) / normalise(w);
    for (int c = 0; c < 3; c++)
        n[c] = x[c] - growth * w[c];
    normalise(n);
    cross3(d, w, x);
    for (int c = 0; c < 3; c++)
        o[c] = s->middle[c] + (x[c] + n[c] * excess) * radius - 6 * d[c];
    make_ray(&in.line[i], o, d);
}

static void parallel_ray(int i)
{
    const struct solid *s = &in.solid[i];
    double x[3], y[3], o[3], d[3];
    const double tilt = power_between(&in.random, -9, -3);
    draw_across(s, x);
    draw_across(s, y);
    for (int c = 0; c < 3; c++) {
        d[c] = s->axis[c] + tilt * y[c];
        o[c] = s->middle[c] + 0.25 * (s->r0 + s->r1) * x[c] - 6 * s->axis[c];
    }
    make_ray(&in.line[i], o, d);
}

static void far_ray(int i)
{
    double d[3], o[3];
    const double away = power_between(&in.random, 5, 7);
    draw_direction(&in.random, d);
    for (int c = 0; c < 3; c++)
        o[c] = in.solid[i].middle[c] + between(&in.random, -0.1, 0.1) -
               away * d[c];
    make_ray(&in.line[i], o, d);
}

/* From where an ordinary ray enters, reflected. */
static void surface_ray(int i)
{
    cylint_answer a;
    double d[3];
    do
        ordinary_ray(i, 0.2);
    while (cylint_intersect(&in.shape[i], &in.line[i],
                            CYLINT_WANT_POINT | CYLINT_WANT_NORMAL, &a) == 0);
    const double along = 2 * dot3(in.line[i].d, a.hit[0].normal);
    for (int c = 0; c < 3; c++)
        d[c] = in.line[i].d[c] - along * a.hit[0].normal[c];
    make_ray(&in.line[i], a.hit[0].point, d);
}

/* ----------------------------------------------------------------- turns -- */

static inline double lean_sum(int i)
{
    const cylint_line *l = &in.line[i];
    double t[2];
    return in.both(&in.lean[i], l->o, l->d, l->tmin, l->tmax, t) ? t[0] + t[1]
                                                                 : 0;
}

static inline double lean_first(int i)
{
    double t, n[3];
    return in.first(&in.lean[i], in.line[i].o, in.line[i].d, &t, n)
               ? t + n[0] + n[1] + n[2]
               : 0;
}

static inline double sum_of_both(int i)
{
    cylint_answer a;
    const int hits =
        cylint_intersect(&in.shape[i], &in.line[i], CYLINT_WANT_T, &a);
    return hits ? a.hit[0].t + a.hit[hits - 1].t : 0;
}

static inline double sum_of_nearest(int i)
{
    cylint_answer a;
    const cylint_hit *hit = &a.hit[0];
    return cylint_intersect(
               &in.shape[i], &in.line[i],
               CYLINT_WANT_T | CYLINT_WANT_NORMAL | CYLINT_WANT_NEAREST, &a)
               ? hit->t + hit->normal[0] + hit->normal[1] + hit->normal[2]
               : 0;
}

BENCH_TURN(lean_both, , lean_sum(i))
BENCH_TURN(lean_nearest, , lean_first(i))
BENCH_TURN(verdicts, , cylint_occluded(&in.shape[i], &in.line[i]))
BENCH_TURN(both_t, , sum_of_both(i))
BENCH_TURN(nearest_and_normal, , sum_of_nearest(i))

/* -------------------------------------------------------------- contests -- */

static void compare(const char *subject, const char *setup)
{
    static const struct {
        const char *name;
        bench_turn *theirs, *ours;
    } questions[] = {
        {"verdict", lean_both, verdicts},
        {"both t", lean_both, both_t},
        {"nearest t and normal", lean_nearest, nearest_and_normal}};
    for (int k = 0; k < 3; k++)
        compete(&(struct contest){.subject = subject,
                                  .question = questions[k].name,
                                  .setup = setup,
                                  .rival = "prepared quadratic",
                                  .theirs = questions[k].theirs,
                                  .ours = questions[k].ours,
                                  .questions = PAIRS,
                                  .shuffled = 1});
}

static void compare_hard(const char *subject)
{
    static void (*const make[FAMILIES])(int) = {NULL, far_ray, grazing_ray,
                                                parallel_ray, surface_ray};
    const enum kind kind = in.solid[0].kind;
    for (int family = FAR; family < FAMILIES; family++) {
        if ((kind == SPHERE || kind == ELLIPTIC) &&
            (family == GRAZING || family == PARALLEL))
            continue;
        in.random = 12;
        for (int i = 0; i < PAIRS; i++)
            make[family](i);
        compare(subject, family_names[family]);
    }
}

static void compare_kind(enum kind kind, int is_infinite)
{
    static const struct {
        int percent;
        const char *setup;
    } shares[] = {{93, "93 % hit"}, {22, "22 % hit"}, {1, "1 % hit"}};
    char subject[32];
    snprintf(subject, sizeof subject, "%s%s", is_infinite ? "infinite " : "",
             kind_names[kind]);
    if (!is_wanted(subject))
        return;
    in.random = 7;
    for (int i = 0; i < PAIRS; i++) {
        draw_solid(&in.random, kind, &in.solid[i]);
        in.solid[i].is_infinite = is_infinite;
        in.shape[i] = shape_of_solid(&in.solid[i]);
        lean_prepare(&in.lean[i], &in.solid[i]);
    }
    in.both = lean_lines[kind];
    in.first = lean_normals[kind];
    /* An infinite shape is hard to miss. */
    for (int k = 0; k < 3; k++)
        if (fabs(approach(ordinary_rays, 64, shares[k].percent) -
                 shares[k].percent) <= 3)
            compare(subject, shares[k].setup);
    compare_hard(subject);
}

void bench_single(void)
{
    for (int kind = 0; kind < KINDS; kind++)
        compare_kind((enum kind)kind, 0);
    compare_kind(CYLINDER, 1);
    compare_kind(CONE, 1);
}
