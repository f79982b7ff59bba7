/*
 * single.c - one line, one shape: the library beside the leanest formula
 *
 *     single [TURNS [BUILD [SHAPE]]]
 *
 * 4096 different pairs of line and shape; nanoseconds a question, the minimum
 * of TURNS turns (120), in order and shuffled.  With SHAPE: only shapes whose
 * name contains it.  The rival is lean.h.  CSV:
 * build, shape, family, line, percent of hits, order, mode, rival, its ns,
 * cylint's ns, ratio.  Hard families have two rivals: the lean formula, and
 * the library's own ordinary question with 93 % of hits ("own").
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>

#include "lean.h"
#include "timing.h"
#include "vectors.h"
#include "../../src/shapes/layout.h"

enum { PAIRS = 4096, MODES = 3, CALLS = 2 * MODES };
enum line_kind { RAY, SEGMENT, LINE };
enum family { ORDINARY, FAR, GRAZING, PARALLEL, SURFACE, FAMILIES };

static const char *const mode_names[MODES] = {"verdict", "nearest", "both"};
static const char *const line_names[] = {"ray", "segment", "line"};
static const char *const family_names[FAMILIES] = {
    "ordinary", "far 1e5..1e7", "grazing 1e-4..1e-13", "parallel 1e-3..1e-9",
    "on the surface"};

static const struct kind {
    const char *name;
    int kind;
    cylint_ends ends;
} kinds[] = {
    {"cylinder capped", CYLINT_KIND_CYLINDER, CYLINT_ENDS_CAPPED},
    {"cone capped", CYLINT_KIND_CONE, CYLINT_ENDS_CAPPED},
    {"ecylinder capped", CYLINT_KIND_ECYLINDER, CYLINT_ENDS_CAPPED},
    {"cylinder infinite", CYLINT_KIND_CYLINDER, CYLINT_ENDS_INFINITE},
    {"cone infinite", CYLINT_KIND_CONE, CYLINT_ENDS_INFINITE},
    {"sphere", CYLINT_KIND_SPHERE, CYLINT_ENDS_CAPPED},
    {"capsule", CYLINT_KIND_CAPSULE, CYLINT_ENDS_CAPPED},
    {"rcone", CYLINT_KIND_RCONE, CYLINT_ENDS_CAPPED},
};
enum { KINDS = sizeof kinds / sizeof kinds[0] };

static cylint_shape shapes[PAIRS];
static cylint_line lines[PAIRS];
static struct lean_shape prepared[PAIRS];
static double middle[PAIRS][3];
static int order[2][PAIRS];
static gsl_rng *rng;
static volatile double sink;

static double between(double low, double high)
{
    return low + (high - low) * gsl_rng_uniform(rng);
}

static double power_between(double low, double high)
{
    return pow(10, between(low, high));
}

static double unit(double v[3])
{
    const double size = sqrt(dot3(v, v));
    for (int i = 0; i < 3; i++)
        v[i] /= size;
    return size;
}

static void must(int ok, const char *what)
{
    if (!ok) {
        fprintf(stderr, "single: %s\n", what);
        exit(1);
    }
}

/* A shape near the origin, about 1 long, 0.2 to 0.5 thick. */
static void make_shape(int i, const struct kind *k)
{
    double p0[3], p1[3], axis[3], a[3], b[3];
    const double r0 = between(0.2, 0.5), r1 = between(0.05, 0.45);
    for (int c = 0; c < 3; c++) {
        p0[c] = between(-1, 1);
        axis[c] = between(-1, 1);
        p1[c] = p0[c] + axis[c];
        middle[i][c] = 0.5 * (p0[c] + p1[c]);
    }
    cylint_status status;
    if (k->kind == CYLINT_KIND_ECYLINDER) {
        gsl_ran_dir_3d(rng, &a[0], &a[1], &a[2]);
        for (int c = 0; c < 3; c++) {
            const int j = (c + 1) % 3, l = (c + 2) % 3;
            b[c] = r1 * (axis[j] * a[l] - axis[l] * a[j]);
            a[c] *= r0;
        }
        status = cylint_elliptic_cylinder(&shapes[i], p0, a, b, axis, k->ends);
    } else if (k->kind == CYLINT_KIND_CONE) {
        status = cylint_cone(&shapes[i], p0, r0, p1, r1, k->ends);
    } else if (k->kind == CYLINT_KIND_SPHERE) {
        status = cylint_sphere(&shapes[i], middle[i], r0, k->ends);
    } else if (k->kind == CYLINT_KIND_CAPSULE) {
        status = cylint_capsule(&shapes[i], p0, p1, r0, k->ends);
    } else if (k->kind == CYLINT_KIND_RCONE) {
        const double r = r0 - 0.5 * sqrt(dot3(axis, axis));
        status =
            cylint_round_cone(&shapes[i], p0, r0, p1, r1 > r ? r1 : r, k->ends);
    } else {
        status = cylint_cylinder(&shapes[i], p0, p1, r0, k->ends);
    }
    must(status == CYLINT_OK, "a shape was refused");
    lean_prepare(&prepared[i], &shapes[i]);
}

static void make_line(int i, enum line_kind kind, const double o[3],
                      const double d[3])
{
    double end[3];
    for (int c = 0; c < 3; c++)
        end[c] = o[c] + d[c];
    const cylint_status status =
        kind == SEGMENT ? cylint_segment(&lines[i], o, end)
        : kind == RAY   ? cylint_ray(&lines[i], o, d)
                        : cylint_whole_line(&lines[i], o, d);
    must(status == CYLINT_OK, "a line was refused");
}

/* From a cube of 12 about the shape to a cube of 2 spread about its middle;
 * a segment goes twice as far. */
static void ordinary_line(int i, enum line_kind kind, double spread)
{
    double o[3], d[3];
    for (int c = 0; c < 3; c++)
        o[c] = middle[i][c] + between(-6, 6);
    for (int c = 0; c < 3; c++)
        d[c] = middle[i][c] + spread * between(-1, 1) - o[c];
    if (kind == SEGMENT)
        for (int c = 0; c < 3; c++)
            d[c] *= 2;
    else
        unit(d);
    make_line(i, kind, o, d);
}

static int lean_hits(int i, double t[2])
{
    const cylint_line *l = &lines[i];
    return lean_formula(&shapes[i])(&prepared[i], l->o, l->d, l->tmin, l->tmax,
                                    t);
}

static double share_of_hits(void)
{
    int hits = 0;
    double t[2];
    for (int i = 0; i < PAIRS; i++)
        hits += lean_hits(i, t) > 0;
    return 100.0 * hits / PAIRS;
}

/* Lines of which that many per cent hit: the spread by bisection. */
static double ordinary_lines(enum line_kind kind, double wanted)
{
    double low = 0, high = 64;
    for (int step = 0; step < 24; step++) {
        const double spread = 0.5 * (low + high);
        gsl_rng_set(rng, 11);
        for (int i = 0; i < PAIRS; i++)
            ordinary_line(i, kind, spread);
        *(share_of_hits() > wanted ? &low : &high) = spread;
    }
    return share_of_hits();
}

/* A unit vector across the axis of shape i. */
static void across(int i, double v[3])
{
    const double *w = cylint_axis(&shapes[i]), ww = dot3(w, w);
    do {
        gsl_ran_dir_3d(rng, &v[0], &v[1], &v[2]);
        const double along = dot3(v, w) / ww;
        for (int c = 0; c < 3; c++)
            v[c] -= along * w[c];
    } while (dot3(v, v) < 0.1);
    unit(v);
}

/* The radius at the middle; of an elliptic shape the lesser semi-axis. */
static double middle_radius(int i)
{
    const cylint_shape *s = &shapes[i];
    if (s->kind != CYLINT_KIND_ECYLINDER)
        return 0.5 * (cylint_r0(s) + cylint_r1(s));
    const double aa = dot3(cylint_a(s), cylint_a(s)),
                 bb = dot3(cylint_b(s), cylint_b(s));
    return sqrt(aa < bb ? aa : bb);
}

/* A ray that passes the middle's ruling at r (1 + excess), nearly level. */
static void grazing_line(int i)
{
    const double *w = cylint_axis(&shapes[i]);
    double x[3], o[3], d[3];
    const double excess =
        (gsl_rng_uniform(rng) < 0.5 ? -1 : 1) * power_between(-13, -4);
    across(i, x);
    const double radius = middle_radius(i);
    const double growth =
        (cylint_r1(&shapes[i]) - cylint_r0(&shapes[i])) / sqrt(dot3(w, w));
    /* the normal of the surface: x less the growth along the axis */
    double n[3], tangent[3];
    for (int c = 0; c < 3; c++)
        n[c] = x[c] - growth * w[c] / sqrt(dot3(w, w));
    unit(n);
    for (int c = 0; c < 3; c++) {
        const int j = (c + 1) % 3, k = (c + 2) % 3;
        tangent[c] = w[j] * x[k] - w[k] * x[j];
    }
    unit(tangent);
    for (int c = 0; c < 3; c++) {
        d[c] = tangent[c];
        o[c] = middle[i][c] + x[c] * radius + n[c] * radius * excess - 6 * d[c];
    }
    make_line(i, RAY, o, d);
}

static void parallel_line(int i)
{
    double x[3], y[3], o[3], d[3];
    const double tilt = power_between(-9, -3), at = 0.5 * middle_radius(i);
    across(i, x);
    across(i, y);
    for (int c = 0; c < 3; c++) {
        d[c] = cylint_axis(&shapes[i])[c] + tilt * y[c];
        o[c] = middle[i][c] + at * x[c] - 6 * cylint_axis(&shapes[i])[c];
    }
    make_line(i, RAY, o, d);
}

static void far_line(int i)
{
    double d[3], o[3];
    gsl_ran_dir_3d(rng, &d[0], &d[1], &d[2]);
    const double distance = power_between(5, 7);
    for (int c = 0; c < 3; c++)
        o[c] = middle[i][c] + between(-0.1, 0.1) - distance * d[c];
    make_line(i, RAY, o, d);
}

/* From where an ordinary ray enters, reflected. */
static void surface_line(int i)
{
    cylint_answer a;
    double d[3];
    do
        ordinary_line(i, RAY, 0.2);
    while (cylint_intersect(&shapes[i], &lines[i],
                            CYLINT_WANT_POINT | CYLINT_WANT_NORMAL, &a) == 0);
    const double *n = a.hit[0].normal;
    const double along = 2 * dot3(lines[i].d, n);
    for (int c = 0; c < 3; c++)
        d[c] = lines[i].d[c] - along * n[c];
    make_line(i, RAY, a.hit[0].point, d);
}

static void hard_lines(enum family family)
{
    static void (*const make[FAMILIES])(int) = {NULL, far_line, grazing_line,
                                                parallel_line, surface_line};
    gsl_rng_set(rng, 12);
    for (int i = 0; i < PAIRS; i++)
        make[family](i);
}

/* One turn: the rival's three modes are one formula; `both` adds both ends. */
static double turn(int call, const int *at, lean_intersect *formula)
{
    static const unsigned want[MODES] = {0, CYLINT_WANT_T | CYLINT_WANT_NEAREST,
                                         CYLINT_WANT_T};
    const int mode = call % MODES;
    double sum = 0, t[2];
    cylint_answer a;
    const struct timing start = timing_now();
    for (int k = 0; k < PAIRS; k++) {
        const int i = at[k];
        const cylint_line *l = &lines[i];
        if (call < MODES) {
            const int n =
                formula(&prepared[i], l->o, l->d, l->tmin, l->tmax, t);
            if (n)
                sum += mode == 0 ? 1 : mode == 1 ? t[2 - n] : t[0] + t[1];
        } else if (mode == 0) {
            sum += cylint_occluded(&shapes[i], l);
        } else {
            const int n = cylint_intersect(&shapes[i], l, want[mode], &a);
            if (n)
                sum += mode == 1 ? a.hit[0].t : a.hit[0].t + a.hit[n - 1].t;
        }
    }
    const double ns = timing_since(start).ns / PAIRS;
    sink = sum;
    return ns;
}

/* In a new order each time; caches are warmed by the pass before. */
static double shuffled_turn(int call, lean_intersect *formula)
{
    turn(call, order[1], formula);
    gsl_ran_shuffle(rng, order[1], PAIRS, sizeof order[1][0]);
    return turn(call, order[1], formula);
}

static void measure(double least[2][CALLS], int turns, lean_intersect *formula)
{
    for (int call = 0; call < CALLS; call++)
        least[0][call] = least[1][call] = HUGE_VAL;
    for (int n = 0; n < turns; n++)
        for (int call = 0; call < CALLS; call++) {
            const double ordered = turn(call, order[0], formula);
            const double shuffled = shuffled_turn(call, formula);
            if (ordered < least[0][call])
                least[0][call] = ordered;
            if (shuffled < least[1][call])
                least[1][call] = shuffled;
        }
}

static void print_row(const char *build, const struct kind *k,
                      enum family family, enum line_kind line, double hits,
                      int o, int mode, const char *rival, double theirs,
                      double ours)
{
    printf("%s,%s,%s,%s,%.0f,%s,%s,%s,%.1f,%.1f,%.2f\n", build, k->name,
           family_names[family], line_names[line], hits,
           o ? "shuffled" : "in order", mode_names[mode], rival, theirs, ours,
           ours / theirs);
    fflush(stdout);
}

static void print_lean(const char *build, const struct kind *k,
                       enum family family, enum line_kind line, double hits,
                       double least[2][CALLS], const char *rival)
{
    for (int o = 0; o < 2; o++)
        for (int m = 0; m < MODES; m++)
            print_row(build, k, family, line, hits, o, m, rival, least[o][m],
                      least[o][MODES + m]);
}

static void race_kind(const char *build, const struct kind *k, int turns)
{
    static const double shares[] = {93, 50, 22, 5, 1};
    double own[2][CALLS], least[2][CALLS];
    gsl_rng_set(rng, 7);
    for (int i = 0; i < PAIRS; i++)
        make_shape(i, k);
    lean_intersect *formula = lean_formula(&shapes[0]);
    for (int line = RAY; line <= LINE; line++)
        for (int s = 0; s < 5; s++) {
            if (line != RAY && s % 2)
                continue;
            const double hits = ordinary_lines((enum line_kind)line, shares[s]);
            if (fabs(hits - shares[s]) > 3)
                continue; /* an unbounded shape is hard to miss */
            measure(least, turns, formula);
            print_lean(build, k, ORDINARY, (enum line_kind)line, hits, least,
                       "lean");
            if (line == RAY && s == 0)
                for (int o = 0; o < 2; o++)
                    for (int call = 0; call < CALLS; call++)
                        own[o][call] = least[o][call];
            if (line == RAY && s == 0 && formula == lean_cylinder &&
                k->ends == CYLINT_ENDS_CAPPED) {
                double shader[2][CALLS];
                measure(shader, turns, lean_shader);
                print_lean(build, k, ORDINARY, RAY, hits, shader, "shader");
            }
        }
    for (int family = FAR; family < FAMILIES; family++) {
        if ((family == GRAZING && formula == lean_elliptic) ||
            ((family == GRAZING || family == PARALLEL) &&
             formula == lean_sphere))
            continue; /* a sphere has no ruling */
        hard_lines((enum family)family);
        const double hits = share_of_hits();
        measure(least, turns, formula);
        print_lean(build, k, (enum family)family, RAY, hits, least, "lean");
        for (int o = 0; o < 2; o++)
            for (int m = 0; m < MODES; m++)
                print_row(build, k, (enum family)family, RAY, hits, o, m, "own",
                          own[o][MODES + m], least[o][MODES + m]);
    }
}

int main(int argc, char **argv)
{
    const int turns = argc > 1 ? atoi(argv[1]) : 120;
    const char *build = argc > 2 ? argv[2] : "-";
    must((rng = gsl_rng_alloc(gsl_rng_mt19937)) != NULL, "out of memory");
    for (int i = 0; i < PAIRS; i++)
        order[0][i] = order[1][i] = i;
    timing_begin();
    printf("build,shape,family,line,hits_percent,order,mode,rival,rival_ns,"
           "cylint_ns,ratio\n");
    for (int k = 0; k < KINDS; k++)
        if (argc <= 3 || strstr(kinds[k].name, argv[3]))
            race_kind(build, &kinds[k], turns);
    gsl_rng_free(rng);
    return 0;
}
