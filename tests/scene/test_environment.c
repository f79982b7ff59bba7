/*
 * test_environment.c - floors batch and scene: every floating-point
 * environment
 *
 * Subnormal t are compared exactly, and lines with a subnormal direction are
 * valid.  Each test runs in all rounding modes, with subnormal results flushed
 * to zero or not, and subnormal operands treated as zero or not.
 */
#include <float.h>
#include <math.h>
#include <string.h>

#include "check.h"
#include "cylint.h"
#include "cylint_scene.h"
#include "environment.h"

static const double tiny = 0x1p-1074;

/* -------------------------------------------------- the nearest of many -- */

enum { DISCS = 11 };

/* Shapes whose lower caps a line along z hits at t = base[i]. */
static void nearest_of(const double base[DISCS], size_t n,
                       const cylint_line *line, size_t want,
                       struct environment there)
{
    static double memory[2000];
    cylint_shape shapes[DISCS];
    cylint_pack pack;
    cylint_hit hit = {0};
    for (size_t i = 0; i < n; i++) {
        const double p0[3] = {0, 0, base[i]}, p1[3] = {0, 0, 1};
        if (!CHECK(cylint_cylinder(&shapes[i], p0, p1, 1 + 0.01 * (double)i,
                                   CYLINT_ENDS_CAPPED) == CYLINT_OK))
            return;
    }
    cylint_scene *scene = cylint_scene_new(shapes, n, 1, NULL);
    if (!CHECK(cylint_pack_bytes(n) <= sizeof memory && scene))
        return;
    cylint_pack_shapes(&pack, memory, shapes, n);
    environment_set(there);
    const size_t in_pack = cylint_nearest(&pack, line, CYLINT_WANT_T, &hit);
    environment_reset();
    if (!CHECK(in_pack == want && hit.t == base[want]))
        REPORT("pack: %zu at %a, not %zu at %a", in_pack, hit.t, want,
               base[want]);
    environment_set(there);
    const size_t in_scene =
        cylint_scene_nearest(scene, line, CYLINT_WANT_T, &hit);
    environment_reset();
    if (!CHECK(in_scene == want && hit.t == base[want]))
        REPORT("scene: %zu at %a, not %zu at %a", in_scene, hit.t, want,
               base[want]);
    cylint_scene_free(scene);
}

static void the_least_of_subnormal_t(struct environment there)
{
    static const double o[3] = {0, 0, 0}, d[3] = {0, 0, 1};
    const double few[DISCS] = {8e-320, 6e-320, 4e-320, 2e-320};
    const double many[DISCS] = {9 * tiny,  7 * tiny,  -3 * tiny, 0,
                                -5 * tiny, -4 * tiny, 5 * tiny,  -5 * tiny,
                                tiny,      -tiny,     0.5};
    cylint_line ray, span, before, behind;
    cylint_ray(&ray, o, d);
    cylint_span(&span, o, d, -1, 1);
    cylint_span(&before, o, d, -4 * tiny, HUGE_VAL);
    cylint_span(&behind, o, d, 2 * tiny, 6 * tiny);
    nearest_of(few, 4, &ray, 3, there);
    nearest_of(few, 2, &ray, 1, there);
    nearest_of(many, DISCS, &ray, 3, there);
    nearest_of(many, DISCS, &span, 4, there);
    nearest_of(many, DISCS, &before, 5, there);
    nearest_of(many, DISCS, &behind, 6, there);
}

static void nearest_compares_subnormal_t_exactly(void)
{
    everywhere(the_least_of_subnormal_t);
}

/* ------------------------------------------------- scenes of wild shapes -- */

/* Whether the line hits the shape, alone and in a scene with a larger one. */
static void hits_in_a_scene(const cylint_shape *shape, const cylint_line *line)
{
    static const double p0[3] = {100, 0, 0}, p1[3] = {104, 0, 0};
    cylint_shape shapes[2] = {*shape};
    cylint_hit hit;
    cylint_answer a;
    cylint_cylinder(&shapes[1], p0, p1, 9, CYLINT_ENDS_CAPPED);
    cylint_scene *scene = cylint_scene_new(shapes, 2, 1, NULL);
    if (!CHECK(scene))
        return;
    CHECK(cylint_intersect(shape, line, CYLINT_WANT_T, &a) > 0);
    CHECK(cylint_scene_nearest(scene, line, CYLINT_WANT_T, &hit) == 0 &&
          hit.t == a.hit[0].t);
    cylint_scene_free(scene);
}

/* A disc with a subnormal axis, or with one whose square underflows; sections
 * with such semi-axes and a large factor. */
static void made_anywhere(struct environment there)
{
    static const double o[3] = {3, -5, 0.5}, d[3] = {0, 1, 0};
    static const double c[3] = {3, 0, 0}, h[3] = {0, 0, 1};
    static const double high[3] = {2.5, 0, 9}, along[3] = {0, 0, -1};
    const double length[] = {0x1p-1057, 0x1p-600, 0x1p-500};
    cylint_line line, fall;
    cylint_shape shape;
    cylint_ray(&line, o, d);
    cylint_ray(&fall, high, along);
    for (int i = 0; i < 3; i++) {
        const double p0[3] = {0, 0, 0}, p1[3] = {0, length[i], 0};
        const double a[3] = {length[i], 0, 0}, b[3] = {0, length[i], 0};
        const double up[3] = {0, 0, length[i]};
        environment_set(there);
        cylint_cylinder(&shape, p0, p1, 7, CYLINT_ENDS_CAPPED);
        hits_in_a_scene(&shape, &line);
        cylint_elliptic_cone(&shape, c, a, b, h, i ? 1 / length[i] : DBL_MAX,
                             CYLINT_ENDS_CAPPED);
        if (i)
            hits_in_a_scene(&shape, &fall);
        cylint_tangent_cone(&shape, p0, up, i ? 3 / length[i] : DBL_MAX,
                            CYLINT_ENDS_CAPPED);
        if (i)
            hits_in_a_scene(&shape, &fall);
        environment_reset();
    }
}

static void scenes_find_tiny_axes_and_huge_factors(void)
{
    everywhere(made_anywhere);
}

/* ------------------------------------------------------ largest exponents -- */

/* Coordinates whose differences are rounded and which overflow where they are
 * scaled: the same hits under every `want`. */
static void segments_at_the_largest_exponents(struct environment there)
{
    static const double a[3] = {-0x1.8p+1002, 0x1.8p+1002, 0};
    static const double b[3] = {0, -0x1p+1002, -0x1p+1001};
    static const double p0[3] = {0, -1, 0}, p1[3] = {0, DBL_MAX, 0};
    static const double far[3] = {0x0.008p-1022, -3.5, 0};
    static const double farther[3] = {0, -DBL_MAX, -0.5};
    static const double c[3] = {0x0.03p-1022, -3, DBL_MIN / 2};
    static const double e1[3] = {-DBL_MIN / 2, DBL_MIN / 2, 0};
    static const double e2[3] = {-0x0.028p-1022, DBL_MIN / 2, -0x1p-1074};
    static const double h[3] = {0x1p-1074, 0, 0x0.01p-1022};
    cylint_line line;
    cylint_shape shape;
    cylint_answer x;
    int n = 0, m = 0;
    cylint_segment(&line, a, b);
    cylint_cone(&shape, p0, 0x1.8p702, p1, DBL_MAX, CYLINT_ENDS_CAPPED);
    environment_set(there);
    for (unsigned want = 0; want < 2 * CYLINT_WANT_NEAREST; want++)
        n += cylint_intersect(&shape, &line, want, &x);
    cylint_intersect(&shape, &line, CYLINT_WANT_T | CYLINT_WANT_PART, &x);
    const int occluded = cylint_occluded(&shape, &line);
    environment_reset();
    CHECK(n == 2 * CYLINT_WANT_NEAREST && occluded &&
          x.hit[0].t == 0x1.7ffff7p-300 &&
          x.hit[0].side == CYLINT_SIDE_LEAVING);
    cylint_segment(&line, far, farther);
    cylint_elliptic_cylinder(&shape, c, e1, e2, h, CYLINT_ENDS_INFINITE);
    environment_set(there);
    for (unsigned want = 0; want < 2 * CYLINT_WANT_NEAREST; want++)
        m += cylint_intersect(&shape, &line, want, &x);
    environment_reset();
    CHECK(m == 0 && x.relation == CYLINT_RELATION_CROSS);
}

static void hits_at_the_largest_exponents_are_the_same(void)
{
    everywhere(segments_at_the_largest_exponents);
}

/* ------------------------------------------------------- subnormal lines -- */

enum { LINES = 952 };

struct columns {
    double t0[LINES], t1[LINES];
    signed char relation[LINES], n[LINES], part0[LINES], part1[LINES];
};

/* Every component of o and d is 0 or a few subnormals, the domain sometimes
 * empty by one of them. */
static void subnormal_lines(double column[8][LINES])
{
    for (int i = 0; i < LINES; i++) {
        for (int j = 0; j < 6; j++) {
            const int some = (i + 1) * (2 * j + 7) % 11 - 5;
            column[j][i] = some * (i % 3 == 0 ? tiny : 0x1p-1030);
        }
        const int from = i * 5 % 7 - 3, to = from + i * 3 % 5 - 1;
        column[6][i] = i % 2 ? from * tiny : -1e300;
        column[7][i] = i % 2 ? to * tiny : 1e300;
    }
}

static void query_columns(const cylint_shape *shape, double column[8][LINES],
                          int pairs, struct columns *to)
{
    static double memory[40000];
    static cylint_shape copies[LINES];
    const cylint_columns columns = {.relation = to->relation,
                                    .n = to->n,
                                    .t0 = to->t0,
                                    .t1 = to->t1,
                                    .part0 = to->part0,
                                    .part1 = to->part1};
    const cylint_lines lines = {LINES,
                                {column[0], column[1], column[2]},
                                {column[3], column[4], column[5]},
                                column[6],
                                column[7]};
    cylint_pack pack;
    memset(to, 0, sizeof *to);
    if (!pairs) {
        cylint_intersect_lines(shape, &lines, &columns);
        return;
    }
    for (int i = 0; i < LINES; i++)
        copies[i] = *shape;
    if (!CHECK(cylint_pack_bytes(LINES) <= sizeof memory))
        return;
    cylint_pack_shapes(&pack, memory, copies, LINES);
    cylint_intersect_pairs(&pack, &lines, &columns);
}

static void columns_of_subnormal_lines(struct environment there)
{
    static double column[8][LINES];
    static struct columns want, got;
    const double p0[3] = {0, 0, -tiny}, p1[3] = {0, 0, 2 * tiny};
    const double q0[3] = {0, 0, -1}, q1[3] = {0, 0, 1};
    cylint_shape shape[2];
    subnormal_lines(column);
    cylint_cylinder(&shape[0], p0, p1, 0x1p-1030, CYLINT_ENDS_CAPPED);
    cylint_cylinder(&shape[1], q0, q1, 1, CYLINT_ENDS_INFINITE);
    for (int i = 0; i < 4; i++) {
        query_columns(&shape[i / 2], column, i % 2, &want);
        environment_set(there);
        query_columns(&shape[i / 2], column, i % 2, &got);
        environment_reset();
        int differ = 0;
        for (int k = 0; k < LINES; k++)
            differ +=
                want.relation[k] != got.relation[k] || want.n[k] != got.n[k] ||
                memcmp(&want.t0[k], &got.t0[k], sizeof want.t0[k]) != 0 ||
                memcmp(&want.t1[k], &got.t1[k], sizeof want.t1[k]) != 0 ||
                want.part0[k] != got.part0[k] || want.part1[k] != got.part1[k];
        if (!CHECK(differ == 0))
            REPORT("%d of %d lines, %s, shape %d", differ, LINES,
                   i % 2 ? "pairs" : "one shape", i / 2);
    }
}

static void batches_of_subnormal_lines_are_the_same(void)
{
    everywhere(columns_of_subnormal_lines);
}

/* Ordinary lines whose domain is empty by a subnormal number. */
static void columns_of_empty_domains(struct environment there)
{
    static double column[8][LINES];
    static struct columns got;
    const double p0[3] = {0, 0, 0}, p1[3] = {0, 0, 1};
    cylint_shape shape;
    cylint_cylinder(&shape, p0, p1, 1, CYLINT_ENDS_CAPPED);
    memset(column, 0, sizeof column);
    for (int i = 0; i < LINES; i++) {
        column[2][i] = -1;
        column[3][i] = 0.1;
        column[5][i] = 1;
        column[6][i] = 2 * tiny;
        column[7][i] = (1 + i % 3) * tiny;
    }
    for (int pairs = 0; pairs < 2; pairs++) {
        environment_set(there);
        query_columns(&shape, column, pairs, &got);
        environment_reset();
        for (int i = 0; i < LINES; i++)
            CHECK(got.relation[i] == (i % 3 == 0 ? CYLINT_RELATION_MISS
                                                 : CYLINT_RELATION_CROSS) &&
                  got.n[i] == 0);
    }
}

static void subnormal_domains_are_empty_or_not(void)
{
    everywhere(columns_of_empty_domains);
}

static void every_subnormal_number_is_a_number(struct environment there)
{
    for (int e = 0; e < 52; e++) {
        const double x = ldexp(1, -1074 + e), y = -x;
        const double zero[3] = {0, 0, 0}, d[3] = {x, 0, 0}, b[3] = {0, y, 0};
        cylint_line line;
        cylint_shape shape;
        environment_set(there);
        const int made = cylint_ray(&line, zero, d) == CYLINT_OK &&
                         cylint_segment(&line, zero, b) == CYLINT_OK &&
                         cylint_span(&line, zero, b, y, x) == CYLINT_OK;
        const cylint_status refused = cylint_span(&line, zero, b, x, y);
        const int shapes = cylint_cylinder(&shape, zero, d, x,
                                           CYLINT_ENDS_OPEN) == CYLINT_OK &&
                           cylint_tangent_cone(&shape, zero, b, x,
                                               CYLINT_ENDS_OPEN) == CYLINT_OK;
        const cylint_status negative =
            cylint_cylinder(&shape, zero, d, y, CYLINT_ENDS_OPEN);
        environment_reset();
        CHECK(made && refused == CYLINT_EDOMAIN && shapes &&
              negative == CYLINT_ERADIUS);
    }
}

static void constructors_use_subnormal_numbers_exactly(void)
{
    everywhere(every_subnormal_number_is_a_number);
}

int main(void)
{
    RUN(nearest_compares_subnormal_t_exactly);
    RUN(scenes_find_tiny_axes_and_huge_factors);
    RUN(hits_at_the_largest_exponents_are_the_same);
    RUN(batches_of_subnormal_lines_are_the_same);
    RUN(subnormal_domains_are_empty_or_not);
    RUN(constructors_use_subnormal_numbers_exactly);
    return check_end();
}
