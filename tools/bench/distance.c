/*
 * distance.c - one point, one shape: the library beside the leanest formulas
 *
 *     distance [TURNS [BUILD]]
 *
 * 4096 different pairs of point and shape; nanoseconds a question, the minimum
 * of TURNS turns (120), in order and shuffled.  The rival is lean_distance.h.
 * Mode "batch": cylint_distance_points() for 4096 points and one shape, where the
 * rival has that shape too.
 * CSV: build, shape, family, order, mode, the rival's ns, cylint's ns, ratio,
 * per cent of points for which the rival's sign is wrong.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>

#include "cylint_distance.h"
#include "lean_distance.h"
#include "timing.h"
#include "vectors.h"

enum { PAIRS = 4096 };
enum family { NEAR, INSIDE, FAR, SURFACE, ROUNDED, FAMILIES };
enum mode { RIVAL, DISTANCE, POINT, SAFETY, MODES };

static const char *const family_names[FAMILIES] = {
    "near", "inside", "far 1e5..1e7", "1e-14..1e-10 from the surface",
    "on the surface but for rounding"};
static const char *const mode_names[MODES] = {NULL, "distance",
                                              "distance and point", "safety"};
static const struct kind {
    const char *name;
    int kind;
} kinds[] = {
    {"cylinder", CYLINT_KIND_CYLINDER}, {"cone", CYLINT_KIND_CONE},
    {"sphere", CYLINT_KIND_SPHERE},     {"capsule", CYLINT_KIND_CAPSULE},
    {"rcone", CYLINT_KIND_RCONE},
};
enum { KINDS = sizeof kinds / sizeof kinds[0] };

static cylint_shape shapes[PAIRS];
static struct lean_solid prepared[PAIRS];
static double points[PAIRS][3], middle[PAIRS][3];
static int order[2][PAIRS];
static gsl_rng *rng;
static volatile double sink;

static double between(double low, double high)
{
    return low + (high - low) * gsl_rng_uniform(rng);
}

static void must(int ok, const char *what)
{
    if (!ok) {
        fprintf(stderr, "distance: %s\n", what);
        exit(1);
    }
}

/* A shape near the origin, about 1 long, 0.05 to 0.5 thick. */
static void make_shape(int i, int kind)
{
    double p0[3], p1[3], axis[3];
    const double r0 = between(0.2, 0.5), r1 = between(0.05, 0.45);
    for (int c = 0; c < 3; c++) {
        p0[c] = between(-1, 1);
        axis[c] = between(-1, 1);
        p1[c] = p0[c] + axis[c];
        middle[i][c] = 0.5 * (p0[c] + p1[c]);
    }
    const double least = r0 - 0.5 * sqrt(dot3(axis, axis));
    const cylint_ends ends = CYLINT_ENDS_CAPPED;
    cylint_shape *s = &shapes[i];
    must((kind == CYLINT_KIND_CYLINDER ? cylint_cylinder(s, p0, p1, r0, ends)
          : kind == CYLINT_KIND_CONE   ? cylint_cone(s, p0, r0, p1, r1, ends)
          : kind == CYLINT_KIND_SPHERE ? cylint_sphere(s, middle[i], r0, ends)
          : kind == CYLINT_KIND_CAPSULE
              ? cylint_capsule(s, p0, p1, r0, ends)
              : cylint_round_cone(s, p0, r0, p1, fmax(r1, least), ends)) ==
             CYLINT_OK,
         "a shape was refused");
    lean_solid_of(&prepared[i], s);
}

static void around(int i, double size, double point[3])
{
    for (int c = 0; c < 3; c++)
        point[c] = middle[i][c] + between(-size, size);
}

static void far_point(int i, double point[3])
{
    double d[3];
    const double distance = pow(10, between(5, 7));
    gsl_ran_dir_3d(rng, &d[0], &d[1], &d[2]);
    for (int c = 0; c < 3; c++)
        point[c] = middle[i][c] + distance * d[c];
}

static void make_point(int i, enum family family)
{
    cylint_closest a;
    if (family == FAR) {
        far_point(i, points[i]);
        return;
    }
    around(i, 1, points[i]);
    while (family == INSIDE && cylint_contains(&shapes[i], points[i]) < 0)
        around(i, 0.5, points[i]);
    if (family == SURFACE || family == ROUNDED) {
        const double size = family == SURFACE ? pow(10, between(-14, -10)) : 0;
        const double off = gsl_rng_uniform(rng) < 0.5 ? -size : size;
        cylint_distance(&shapes[i], points[i],
                        CYLINT_WANT_POINT | CYLINT_WANT_NORMAL, &a);
        for (int c = 0; c < 3; c++)
            points[i][c] = a.point[c] + off * a.normal[c];
    }
}

static double turn(enum mode mode, const int *at, lean_distance *formula)
{
    double sum = 0;
    cylint_closest a;
    const struct timing start = timing_now();
    for (int k = 0; k < PAIRS; k++) {
        const int i = at[k];
        if (mode == RIVAL) {
            sum += formula(&prepared[i], points[i]);
        } else if (mode == SAFETY) {
            sum += cylint_safety(&shapes[i], points[i]);
        } else if (mode == DISTANCE) {
            sum += cylint_distance(&shapes[i], points[i], 0, &a);
        } else {
            sum += cylint_distance(&shapes[i], points[i],
                                   CYLINT_WANT_POINT | CYLINT_WANT_PART, &a);
            sum += a.point[0] + a.point[1] + a.point[2];
        }
    }
    const double ns = timing_since(start).ns / PAIRS;
    sink = sum;
    return ns;
}

/* In a new order each time; the pass before warms the caches. */
static double shuffled_turn(enum mode mode, lean_distance *formula)
{
    turn(mode, order[1], formula);
    gsl_ran_shuffle(rng, order[1], PAIRS, sizeof order[1][0]);
    return turn(mode, order[1], formula);
}

static double wrong_signs(lean_distance *formula)
{
    int wrong = 0;
    for (int i = 0; i < PAIRS; i++) {
        const double d = formula(&prepared[i], points[i]);
        wrong += (d < 0) - (d > 0) != cylint_contains(&shapes[i], points[i]);
    }
    return 100.0 * wrong / PAIRS;
}

static void race(const char *build, const struct kind *k, enum family family,
                 int turns)
{
    lean_distance *formula = lean_distance_of(&shapes[0]);
    double least[2][MODES];
    for (int i = 0; i < PAIRS; i++)
        make_point(i, family);
    for (int mode = 0; mode < MODES; mode++)
        least[0][mode] = least[1][mode] = HUGE_VAL;
    for (int n = 0; n < turns; n++)
        for (int mode = 0; mode < MODES; mode++) {
            const double in_order = turn((enum mode)mode, order[0], formula);
            const double shuffled = shuffled_turn((enum mode)mode, formula);
            least[0][mode] = fmin(least[0][mode], in_order);
            least[1][mode] = fmin(least[1][mode], shuffled);
        }
    for (int o = 0; o < 2; o++)
        for (int mode = DISTANCE; mode < MODES; mode++)
            printf("%s,%s,%s,%s,%s,%.1f,%.1f,%.2f,%.1f\n", build, k->name,
                   family_names[family], o ? "shuffled" : "in order",
                   mode_names[mode], least[o][RIVAL], least[o][mode],
                   least[o][mode] / least[o][RIVAL], wrong_signs(formula));
    fflush(stdout);
}

static double batch_turn(enum mode mode, lean_distance *formula)
{
    static double xyz[3][PAIRS], distance[PAIRS];
    const cylint_points all = {PAIRS, {xyz[0], xyz[1], xyz[2]}};
    const cylint_closest_columns answers = {.distance = distance};
    double sum = 0;
    for (int i = 0; i < PAIRS; i++)
        for (int c = 0; c < 3; c++)
            xyz[c][i] = points[i][c];
    const struct timing start = timing_now();
    if (mode == DISTANCE)
        cylint_distance_points(&shapes[0], &all, &answers);
    for (int i = 0; mode == RIVAL && i < PAIRS; i++)
        sum += formula(&prepared[0], points[i]);
    const double ns = timing_since(start).ns / PAIRS;
    sink = sum + distance[0];
    return ns;
}

/* Many points near one shape, or inside. */
static void race_batch(const char *build, const struct kind *k,
                       enum family family, int turns)
{
    lean_distance *formula = lean_distance_of(&shapes[0]);
    double least[2] = {HUGE_VAL, HUGE_VAL};
    for (int i = 0; i < PAIRS; i++) {
        around(0, 1, points[i]);
        while (family == INSIDE && cylint_contains(&shapes[0], points[i]) < 0)
            around(0, 0.5, points[i]);
    }
    for (int n = 0; n < turns; n++)
        for (int mode = RIVAL; mode <= DISTANCE; mode++)
            least[mode] =
                fmin(least[mode], batch_turn((enum mode)mode, formula));
    printf("%s,%s,%s,one shape,batch,%.1f,%.1f,%.2f,0.0\n", build, k->name,
           family_names[family], least[RIVAL], least[DISTANCE],
           least[DISTANCE] / least[RIVAL]);
}

int main(int argc, char **argv)
{
    const int turns = argc > 1 ? atoi(argv[1]) : 120;
    const char *build = argc > 2 ? argv[2] : "-";
    must((rng = gsl_rng_alloc(gsl_rng_mt19937)) != NULL, "out of memory");
    for (int i = 0; i < PAIRS; i++)
        order[0][i] = order[1][i] = i;
    timing_begin();
    printf("build,shape,family,order,mode,lean_ns,cylint_ns,ratio,"
           "lean_wrong_signs_percent\n");
    for (int k = 0; k < KINDS; k++) {
        gsl_rng_set(rng, 7);
        for (int i = 0; i < PAIRS; i++)
            make_shape(i, kinds[k].kind);
        for (int family = 0; family < FAMILIES; family++)
            race(build, &kinds[k], (enum family)family, turns);
        race_batch(build, &kinds[k], NEAR, turns);
        race_batch(build, &kinds[k], INSIDE, turns);
    }
    gsl_rng_free(rng);
    return 0;
}
