/*
 * distance.c - one point, one shape: the library beside the leanest formulas
 *
 * 4096 different pairs of point and shape; of a batch one shape.  The rivals
 * return the signed distance only.  Elliptic kinds have no rival.
 */
#include "cylint_distance.h"
#include "lean.h"

enum { PAIRS = 4096 };
enum family { NEAR, INSIDE, FAR, SURFACE, FAMILIES };

static const char *const family_names[FAMILIES] = {
    "near", "inside", "from 1e5 to 1e7 away", "1e-14 to 1e-10 away"};

static struct {
    cylint_shape shape[PAIRS];
    struct lean_body lean[PAIRS];
    double point[PAIRS][3];
    double column[3][PAIRS], distance[PAIRS]; /* of a batch */
    lean_distance *formula;
    uint64_t random;
} in;

static void draw_around(int shape, double size, double point[3])
{
    middle_of(&in.shape[shape], point);
    for (int c = 0; c < 3; c++)
        point[c] += between(&in.random, -size, size);
}

static void draw_point(int shape, enum family family, double point[3])
{
    double d[3], off;
    draw_around(shape, 1, point);
    while (family == INSIDE && cylint_contains(&in.shape[shape], point) < 0)
        draw_around(shape, 0.5, point);
    if (family == FAR) {
        off = power_between(&in.random, 5, 7);
        draw_direction(&in.random, d);
        add3(point, off, d);
    }
    if (family == SURFACE) {
        cylint_closest a;
        off = power_between(&in.random, -14, -10);
        if (random_below(&in.random, 2) == 0)
            off = -off;
        cylint_distance(&in.shape[shape], point,
                        CYLINT_WANT_POINT | CYLINT_WANT_NORMAL, &a);
        along3(point, a.point, off, a.normal);
    }
}

/* ----------------------------------------------------------------- turns -- */

static inline double distance_of(int i, unsigned want)
{
    cylint_closest a = {.point = {0, 0, 0}};
    return cylint_distance(&in.shape[i], in.point[i], want, &a) + a.point[0];
}

BENCH_TURN(formula, , in.formula(&in.lean[i], in.point[i]))
BENCH_TURN(distance, const unsigned want = *(const unsigned *)input,
           distance_of(i, want))
BENCH_TURN(safety, , cylint_safety(&in.shape[i], in.point[i]))

static double formula_batch(const void *input, const int *order, int n)
{
    (void)input, (void)order;
    for (int i = 0; i < n; i++)
        in.distance[i] = in.formula(&in.lean[0], in.point[i]);
    return in.distance[0];
}

static double batch(const void *input, const int *order, int n)
{
    const cylint_points all = {(size_t)n,
                               {in.column[0], in.column[1], in.column[2]}};
    const cylint_closest_columns answers = {.distance = in.distance};
    (void)input, (void)order;
    cylint_distance_points(&in.shape[0], &all, &answers);
    return in.distance[0];
}

/* -------------------------------------------------------------- contests -- */

static const unsigned only_distance = 0, everything = CYLINT_WANT_POINT |
                                                      CYLINT_WANT_NORMAL |
                                                      CYLINT_WANT_PART;

static void compare(const char *name, enum family family, bench_turn *ours,
                    const void *input)
{
    const int is_batch = ours == batch;
    compete(&(struct contest){.subject = kind_names[in.shape[0].kind],
                              .question = name,
                              .setup = family_names[family],
                              .rival = in.formula ? "prepared distance" : NULL,
                              .theirs = is_batch ? formula_batch : formula,
                              .ours = ours,
                              .input = input,
                              .questions = PAIRS,
                              .is_shuffled = !is_batch});
}

static void compare_family(enum family family)
{
    for (int i = 0; i < PAIRS; i++)
        draw_point(i, family, in.point[i]);
    compare("distance", family, distance, &only_distance);
    compare("distance + point + normal", family, distance, &everything);
    compare("safety", family, safety, NULL);
    if (family == FAR || family == SURFACE)
        return;
    for (int i = 0; i < PAIRS; i++) {
        draw_point(0, family, in.point[i]);
        for (int c = 0; c < 3; c++)
            in.column[c][i] = in.point[i][c];
    }
    compare("batch of points", family, batch, NULL);
}

void bench_distance(void)
{
    for (int kind = 0; kind < KINDS; kind++) {
        if (!is_wanted(kind_names[kind]))
            continue;
        in.random = 7;
        for (int i = 0; i < PAIRS; i++) {
            in.shape[i] = draw_shape(&in.random, kind, 0);
            lean_prepare_body(&in.lean[i], &in.shape[i]);
        }
        in.formula = lean_distances[kind];
        for (int family = 0; family < FAMILIES; family++)
            compare_family((enum family)family);
    }
}
