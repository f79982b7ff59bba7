/*
 * single.c - one line, one shape: the library beside the leanest formula
 *
 * 4096 different pairs of line and shape.  Ordinary rays of which 93, 22 and 1
 * % hit, and rays from far away and from the surface.  `methods` has grazing lines
 * and lines nearly parallel to the axis.
 */
#include "lean.h"

enum { PAIRS = 4096 };

static struct {
    cylint_shape shape[PAIRS];
    struct lean lean[PAIRS];
    cylint_line line[PAIRS];
    double middle[PAIRS][3];
    const struct lean_formulas *formulas;
    uint64_t random;
} in;

/* ------------------------------------------------------------------ rays -- */

/* From a cube of 12 about the shape to a cube of 2 spread about its middle. */
static void ordinary_ray(int i, double spread)
{
    const double *middle = in.middle[i];
    double o[3], d[3];
    for (int c = 0; c < 3; c++) {
        o[c] = middle[c] + between(&in.random, -6, 6);
        d[c] = middle[c] + between(&in.random, -spread, spread) - o[c];
    }
    unit3(d, d);
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

static void far_ray(int i)
{
    double d[3], o[3];
    const double away = power_between(&in.random, 5, 7);
    draw_direction(&in.random, d);
    for (int c = 0; c < 3; c++)
        o[c] = in.middle[i][c] + between(&in.random, -0.1, 0.1) - away * d[c];
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
    along3(d, in.line[i].d, -along, a.hit[0].normal);
    make_ray(&in.line[i], a.hit[0].point, d);
}

/* ----------------------------------------------------------------- turns -- */

static inline double lean_sum(int i)
{
    const cylint_line *l = &in.line[i];
    double t[2];
    return in.formulas->line(&in.lean[i], l->o, l->d, l->tmin, l->tmax, t)
               ? t[0] + t[1]
               : 0;
}

static inline double lean_first(int i)
{
    double t, n[3];
    return in.formulas->normal(&in.lean[i], in.line[i].o, in.line[i].d, &t, n)
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
                                  .is_shuffled = 1});
}

static void compare_hard(const char *subject, void (*make)(int),
                         const char *setup)
{
    in.random = 12;
    for (int i = 0; i < PAIRS; i++)
        make(i);
    compare(subject, setup);
}

static void compare_kind(int kind)
{
    static const struct {
        int percent;
        const char *setup;
    } shares[] = {{93, "93 % hit"}, {22, "22 % hit"}, {1, "1 % hit"}};
    const char *subject = kind_names[kind];
    in.random = 7;
    for (int i = 0; i < PAIRS; i++) {
        in.shape[i] = draw_shape(&in.random, kind, 0);
        middle_of(&in.shape[i], in.middle[i]);
        lean_prepare(&in.lean[i], &in.shape[i]);
    }
    in.formulas = &lean_formulas[kind];
    for (int k = 0; k < 3; k++) {
        approach(ordinary_rays, 64, shares[k].percent);
        compare(subject, shares[k].setup);
    }
    compare_hard(subject, far_ray, "from 1e5 to 1e7 away");
    compare_hard(subject, surface_ray, "from the surface");
}

void bench_single(void)
{
    for (int kind = 0; kind < KINDS; kind++)
        if (is_wanted(kind_names[kind]))
            compare_kind(kind);
}
