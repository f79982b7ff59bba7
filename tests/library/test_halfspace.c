/*
 * test_halfspace.c - a half-space: exact answers on integers, times powers of two
 *
 * With small integers t, the point and the squared distance are quotients of
 * integers, so one division rounds them.
 */
#include <float.h>
#include <math.h>

#include "check.h"
#include "cylint.h"
#include "cylint_distance.h"
#include "cylint_methods.h"
#include "cylint_pieces.h"
#include "environment.h"
#include "intersect.h"
#include "random.h"
#include "same.h"

enum { CASES = 20000, MOST = 9 };

static uint64_t rng;

static int integer(void)
{
    return random_int(&rng, 2 * MOST + 1) - MOST;
}

/* Integers and powers of two: p and o have one, n and d have others. */
static struct {
    int p[3], n[3], o[3], d[3];
    int length, normal, direction;
    cylint_shape shape;
    cylint_line line;
    int above, slope; /* (o - p).n, d.n */
} c;

static void scale(double to[3], const int from[3], int e)
{
    for (int i = 0; i < 3; i++)
        to[i] = ldexp(from[i], e);
}

static int make_case(int most_exponent)
{
    double p[3], n[3], o[3], d[3];
    c.above = c.slope = 0;
    for (int i = 0; i < 3; i++) {
        c.p[i] = integer();
        c.n[i] = random_int(&rng, 3) ? integer() : 0;
        c.o[i] = integer();
        c.d[i] = random_int(&rng, 3) ? integer() : 0;
        c.above += (c.o[i] - c.p[i]) * c.n[i];
        c.slope += c.d[i] * c.n[i];
    }
    c.length = random_int(&rng, 2 * most_exponent + 1) - most_exponent;
    c.normal = random_int(&rng, 2 * most_exponent + 1) - most_exponent;
    c.direction = random_int(&rng, 2 * most_exponent + 1) - most_exponent;
    scale(p, c.p, c.length);
    scale(o, c.o, c.length);
    scale(n, c.n, c.normal);
    scale(d, c.d, c.direction);
    return cylint_halfspace(&c.shape, p, n) == CYLINT_OK &&
           cylint_whole_line(&c.line, o, d) == CYLINT_OK;
}

static void check_hit(const cylint_hit *hit)
{
    const double nn = c.n[0] * c.n[0] + c.n[1] * c.n[1] + c.n[2] * c.n[2];
    const double t = -(double)c.above / c.slope;
    CHECK(hit->t == ldexp(t, c.length - c.direction));
    CHECK(hit->part == CYLINT_PART_LATERAL && hit->z == 0 && hit->phi == 0);
    CHECK(!signbit(hit->z) && !signbit(hit->phi) &&
          (hit->t != 0 || !signbit(hit->t)));
    CHECK(hit->side ==
          (c.slope > 0 ? CYLINT_SIDE_LEAVING : CYLINT_SIDE_ENTERING));
    for (int i = 0; i < 3; i++) {
        const double x =
            (double)(c.o[i] * c.slope - c.above * c.d[i]) / c.slope;
        const long double n = (long double)c.n[i] / sqrtl(nn);
        if (!CHECK(hit->point[i] == ldexp(x, c.length)))
            REPORT("%a, not %a", hit->point[i], ldexp(x, c.length));
        CHECK(fabsl(hit->normal[i] - n) <= 0.501L * DBL_EPSILON * fabsl(n));
    }
}

TEST(a_line_has_the_hit_of_the_plane)
{
    rng = 1;
    for (int i = 0; i < CASES; i++) {
        cylint_answer a;
        if (!make_case(i % 2 ? 480 : 0))
            continue;
        const int n = cylint_intersect(&c.shape, &c.line, CYLINT_WANT_ALL, &a);
        CHECK(n == (c.slope != 0));
        CHECK(a.relation == (c.slope != 0 || c.above < 0 ? CYLINT_RELATION_CROSS
                             : c.above == 0              ? CYLINT_RELATION_ALONG
                                            : CYLINT_RELATION_MISS));
        if (n == 1)
            check_hit(&a.hit[0]);
        c.line.tmin = 0;
        CHECK(
            cylint_occluded(&c.shape, &c.line) ==
            (c.slope != 0 && (c.above == 0 || (c.above < 0) == (c.slope > 0))));
    }
}

/* 1/3 is rounded down, 1/5 up, 1/2 is a double. */
TEST(a_root_beside_a_limit_is_compared_exactly)
{
    static const double o[3] = {0, 0, 0}, up[3] = {0, 0, 1};
    static const struct {
        double slope;
        int from_t_on, up_to_t; /* in [t, 2], in [0, t] */
    } known[] = {{3, 1, 0}, {5, 0, 1}, {2, 1, 1}};
    cylint_shape s;
    cylint_line line;
    cylint_halfspace(&s, up, up);
    for (int i = 0; i < 3; i++) {
        const double d[3] = {1, 0, known[i].slope};
        const double t = 1 / known[i].slope;
        cylint_span(&line, o, d, t, 2);
        CHECK(cylint_occluded(&s, &line) == known[i].from_t_on);
        cylint_span(&line, o, d, 0, t);
        CHECK(cylint_occluded(&s, &line) == known[i].up_to_t);
    }
}

/* The distance 1 + n 2^-53 lies in the middle of two doubles. */
static void check_ties(struct environment there)
{
    static const double up[3] = {0, 0, 1}, z[3] = {0, 0, 1};
    for (int n = 1; n < 8; n += 2) {
        const double below[3] = {0, 0, -n * 0x1p-53};
        cylint_shape s;
        cylint_closest a;
        cylint_halfspace(&s, below, up);
        environment_set(there);
        const double distance = cylint_distance(&s, z, 0, &a);
        environment_reset();
        CHECK(distance == 1 + (n + 1) / 4 * 0x1p-51);
    }
}

TEST(a_distance_between_two_doubles_is_rounded_to_even)
{
    everywhere(check_ties);
}

TEST(members_can_be_wanted_alone)
{
    static const unsigned wants[] = {CYLINT_WANT_T, CYLINT_WANT_POINT,
                                     CYLINT_WANT_NORMAL, CYLINT_WANT_Z};
    rng = 8;
    for (int i = 0; i < CASES / 20; i++) {
        cylint_answer all, a;
        if (!make_case(0) ||
            cylint_intersect(&c.shape, &c.line, CYLINT_WANT_ALL, &all) < 1)
            continue;
        for (size_t k = 0; k < sizeof wants / sizeof *wants; k++) {
            CHECK(cylint_intersect(&c.shape, &c.line, wants[k], &a) == 1);
            CHECK(same_hit(&a.hit[0], &all.hit[0], wants[k]));
        }
    }
}

TEST(a_segment_has_its_exact_difference)
{
    rng = 2;
    for (int i = 0; i < CASES; i++) {
        int b[3], slope = 0;
        double from[3], to[3];
        cylint_answer a;
        if (!make_case(300))
            continue;
        for (int j = 0; j < 3; j++) {
            b[j] = integer();
            slope += (b[j] - c.o[j]) * c.n[j];
        }
        scale(from, c.o, c.length);
        scale(to, b, c.length);
        if (cylint_segment(&c.line, from, to) != CYLINT_OK)
            continue;
        const int n = cylint_intersect(&c.shape, &c.line, CYLINT_WANT_T, &a);
        const double t = -(double)c.above / slope;
        CHECK(n == (slope != 0 && t >= 0 && t <= 1));
        CHECK(n == 0 || a.hit[0].t == t);
    }
}

TEST(distances_and_sides_are_those_of_the_plane)
{
    rng = 3;
    for (int i = 0; i < CASES / 4; i++) {
        cylint_closest at;
        double point[3];
        if (!make_case(i % 2 ? 300 : 0))
            continue;
        const double nn = c.n[0] * c.n[0] + c.n[1] * c.n[1] + c.n[2] * c.n[2];
        scale(point, c.o, c.length);
        CHECK(cylint_contains(&c.shape, point) ==
              (c.above < 0) - (c.above > 0));
        const double d = cylint_distance(&c.shape, point,
                                         CYLINT_WANT_PART | CYLINT_WANT_POINT |
                                             CYLINT_WANT_NORMAL | CYLINT_SIGNED,
                                         &at);
        const long double exact = ldexpl(c.above / sqrtl(nn), c.length);
        CHECK(fabsl(d - exact) <= 0.501L * DBL_EPSILON * fabsl(exact));
        CHECK(d == at.distance && at.part == CYLINT_PART_LATERAL &&
              at.feature == CYLINT_FEATURE_LATERAL);
        CHECK(d == cylint_distance(&c.shape, point, 0, &at));
        const double safe = cylint_safety(&c.shape, point);
        CHECK(safe <= fabs(d) && safe >= 0.99 * fabs(d));
        for (int j = 0; j < 3; j++) {
            const long double x = c.o[j] - c.above * c.n[j] / (long double)nn;
            const long double n = c.n[j] / sqrtl(nn);
            CHECK(fabsl(at.point[j] - ldexpl(x, c.length)) <=
                  4 * DBL_EPSILON * ldexpl(fabsl(x), c.length) +
                      ldexpl(1e-18L, c.length));
            CHECK(fabsl(at.normal[j] - n) <= 2 * DBL_EPSILON * fabsl(n));
        }
    }
}

TEST(batches_answer_as_one_question_does)
{
    enum { N = 37 };
    static cylint_shape shapes[N];
    static cylint_line lines[N];
    static double column[6][N], tmin[N], tmax[N], t0[N];
    static signed char relation[N], n[N];
    const cylint_lines from = {.n = N,
                               .o = {column[0], column[1], column[2]},
                               .d = {column[3], column[4], column[5]},
                               .tmin = tmin,
                               .tmax = tmax};
    const cylint_columns to = {.relation = relation, .n = n, .t0 = t0};
    cylint_pack pack;
    void *memory = malloc(cylint_pack_bytes(N));
    rng = 4;
    for (int i = 0; i < N;) {
        if (!make_case(0))
            continue;
        shapes[i] = c.shape;
        lines[i] = c.line;
        for (int j = 0; j < 3; j++) {
            column[j][i] = c.line.o[j];
            column[j + 3][i] = c.line.d[j];
        }
        tmin[i] = -HUGE_VAL;
        tmax[i++] = HUGE_VAL;
    }
    cylint_pack_shapes(&pack, memory, shapes, N);
    for (int mode = 0; mode < 3; mode++) {
        if (mode == 0)
            cylint_intersect_shapes(&pack, &lines[0], &to);
        else if (mode == 1)
            cylint_intersect_lines(&shapes[0], &from, &to);
        else
            cylint_intersect_pairs(&pack, &from, &to);
        for (int i = 0; i < N; i++) {
            cylint_answer a;
            cylint_intersect(&shapes[mode == 1 ? 0 : i],
                             &lines[mode == 0 ? 0 : i], CYLINT_WANT_T, &a);
            CHECK(a.relation == relation[i] && a.n == n[i]);
            CHECK(a.n == 0 || a.hit[0].t == t0[i]);
        }
    }
    free(memory);
}

TEST(bad_arguments_are_refused)
{
    const double p[3] = {0, 0, 0}, x[3] = {1, 0, 0}, bad[3] = {0, NAN, 1};
    cylint_shape s;
    CHECK(cylint_halfspace(&s, p, p) == CYLINT_EAXIS && s.kind == 0);
    CHECK(cylint_halfspace(&s, bad, x) == CYLINT_ENONFINITE);
    CHECK(cylint_halfspace(&s, p, bad) == CYLINT_ENONFINITE);
    CHECK(cylint_halfspace(&s, p, x) == CYLINT_OK &&
          s.kind == CYLINT_KIND_HALFSPACE && s.ends == CYLINT_ENDS_INFINITE);
}

TEST(methods_refuse_it)
{
    const double p[3] = {0, 0, 0}, x[3] = {1, 0, 0};
    cylint_shape s;
    cylint_line line;
    cylint_halfspace(&s, p, x);
    cylint_whole_line(&line, p, x);
    for (const cylint_method *m = cylint_methods(); m->name; m++) {
        cylint_answer a;
        if (!CHECK(m->answer(&s, &line, CYLINT_WANT_T, &a) == CYLINT_EMETHOD))
            REPORT("%s", m->name);
    }
}

TEST(boxes_end_at_planes_across_a_coordinate)
{
    const double p[3] = {1, 2, 3}, n[3] = {0, -2, 0}, oblique[3] = {1, 1, 0};
    double lo[3], hi[3];
    cylint_shape s;
    cylint_halfspace(&s, p, n);
    cylint_bounds(&s, lo, hi);
    CHECK(lo[0] == -HUGE_VAL && hi[0] == HUGE_VAL && lo[1] == 2 &&
          hi[1] == HUGE_VAL && lo[2] == -HUGE_VAL);
    cylint_halfspace(&s, p, oblique);
    cylint_bounds(&s, lo, hi);
    CHECK(lo[0] == -HUGE_VAL && hi[0] == HUGE_VAL && hi[1] == HUGE_VAL);
}

TEST(points_can_leave_the_plane)
{
    rng = 5;
    for (int i = 0; i < 1000; i++) {
        cylint_answer a;
        double point[3];
        if (!make_case(0) ||
            !cylint_intersect(&c.shape, &c.line, CYLINT_WANT_ALL, &a))
            continue;
        for (int side = -1; side <= 1; side += 2)
            CHECK(cylint_outside(&c.shape, &a.hit[0], side, point) == 1 &&
                  cylint_contains(&c.shape, point) == side);
    }
}

TEST(chords_are_half_lines)
{
    rng = 6;
    for (int i = 0; i < CASES; i++) {
        cylint_interval chord[2];
        if (!make_case(i % 2 ? 300 : 0))
            continue;
        const double t =
            ldexp(-(double)c.above / c.slope, c.length - c.direction);
        const int n = cylint_chord(&c.shape, &c.line, chord);
        if (c.slope == 0) {
            CHECK(n == (c.above <= 0) && (n == 0 || (chord[0].t0 == -HUGE_VAL &&
                                                     chord[0].t1 == HUGE_VAL)));
            c.line.tmin = -9;
            c.line.tmax = 8;
            CHECK(cylint_chord(&c.shape, &c.line, chord) == n &&
                  (n == 0 || (chord[0].t0 == -9 && chord[0].t1 == 8)));
            continue;
        }
        CHECK(n == 1 && chord[0].t0 == (c.slope > 0 ? -HUGE_VAL : t) &&
              chord[0].t1 == (c.slope > 0 ? t : HUGE_VAL));
    }
}

/* Random doubles, also nearly parallel and far, of all sizes. */
TEST(pairs_and_signs_agree)
{
    rng = 7;
    for (int i = 0; i < 10 * CASES; i++) {
        double x[4][3];
        cylint_answer a, b;
        for (int k = 0; k < 4; k++)
            for (int j = 0; j < 3; j++)
                x[k][j] = ldexp(random_mantissa(&rng) *
                                    (random_int(&rng, 2) ? 1 : -1),
                                i % 3 ? random_int(&rng, 1 + i % 60) : 0);
        if (i % 5 == 0) /* nearly parallel */
            x[3][2] = -(x[3][0] * x[1][0] + x[3][1] * x[1][1]) / x[1][2];
        if (cylint_halfspace(&c.shape, x[0], x[1]) != CYLINT_OK ||
            cylint_ray(&c.line, x[2], x[3]) != CYLINT_OK)
            continue;
        cylint_line without_pairs = c.line;
        without_pairs.in_range = 0;
        cylint_intersect(&c.shape, &c.line, CYLINT_WANT_ALL, &a);
        cylint_intersect_by_signs(&c.shape, &without_pairs, CYLINT_WANT_ALL,
                                  &b);
        CHECK(a.n == b.n && a.relation == b.relation &&
              (a.n == 0 || same_hit(&a.hit[0], &b.hit[0], CYLINT_WANT_ALL)));
    }
}
