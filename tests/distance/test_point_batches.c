/*
 * test_point_batches.c - floor distance: batches of contains, safety and
 * on_surface return the bits of single questions
 *
 * The arrays of a batch begin or end at guard pages, at all addresses; its inputs
 * are read-only during the call.  Shapes are of all families, kinds and ends, and
 * refused ones; points are near their features, far away, and not finite.
 */
#include <math.h>
#include <string.h>

#include "check.h"
#include "cylint_distance.h"
#include "distance_points.h"
#include "environment.h"
#include "guarded.h"

enum { MOST = 600, FEW = 21 };

static struct guarded coordinates[3], shape_pages, sides, safeties, ons;

static void allocate_pages(void)
{
    for (int k = 0; k < 3; k++)
        coordinates[k] = guarded_allocate(MOST * sizeof(double));
    shape_pages = guarded_allocate(MOST * sizeof(cylint_shape));
    safeties = guarded_allocate(MOST * sizeof(double));
    sides = guarded_allocate(MOST);
    ons = guarded_allocate(MOST);
}

/* ----------------------------------------------------------- questions -- */

static struct family_case drawn[MOST];
static double place_of_case[MOST][3];

/* Points of the cases; some coordinates are not finite, or extreme. */
static void draw_points(size_t n, uint64_t stream)
{
    static const double odd[] = {NAN,     HUGE_VAL,  -HUGE_VAL, DBL_MAX,
                                 0x1p101, 0x1p-1074, -0.0};
    for (size_t i = 0; i < n; i++) {
        double *p = place_of_case[i];
        draw_point(&drawn[i], &stream, p);
        if (random_int(&stream, 12) == 0)
            p[random_int(&stream, 3)] = odd[random_int(&stream, 7)];
    }
}

static void draw_family(int family, size_t n)
{
    for (size_t i = 0; i < n; i++)
        family_case(41, family, i, &drawn[i]);
    draw_points(n, (uint64_t)family);
}

/* All families in turn, with all ends, any exponents, and refused shapes. */
static void draw_mixed(size_t n)
{
    uint64_t stream = 43;
    for (size_t i = 0; i < n; i++) {
        struct family_case *c = &drawn[i];
        family_case(42, (int)(i % (size_t)family_count()), i, c);
        if (!cylint_is_round(c->shape.kind))
            c->ends = (cylint_ends)random_int(&stream, 6);
        family_make(c);
    }
    draw_points(n, 44);
    for (size_t i = 0; i < n; i += 7) {
        drawn[i].shape_data[0] = NAN;
        if (i % 2)
            draw_far_case(&drawn[i], &stream, place_of_case[i]);
        else
            family_make(&drawn[i]);
    }
}

/* ------------------------------------------------------------- batches -- */

/* The answers of batches, `gap` bytes or doubles from the guard pages. */
struct answers {
    signed char *side, *on;
    double *safety;
};

static void *place(const struct guarded *pages, size_t n, size_t size,
                   size_t gap, int at_end)
{
    return guarded_place(pages, n * size, gap * size % 64, at_end);
}

static const cylint_shape *lay_shapes(size_t n, size_t gap, int at_end)
{
    cylint_shape *to = guarded_place(&shape_pages, n * sizeof *to,
                                     gap * sizeof(double) % 64, at_end);
    for (size_t i = 0; i < n; i++)
        to[i] = drawn[i].shape;
    guarded_permit(&shape_pages, 0);
    return to;
}

static cylint_points lay_points(size_t n, size_t gap, int at_end)
{
    double *x[3];
    for (int k = 0; k < 3; k++) {
        x[k] =
            place(&coordinates[k], n, sizeof(double), gap + (size_t)k, at_end);
        for (size_t i = 0; i < n; i++)
            x[k][i] = place_of_case[i][k];
        guarded_permit(&coordinates[k], 0);
    }
    return (cylint_points){n, {x[0], x[1], x[2]}};
}

static struct answers lay_answers(size_t n, size_t gap, int at_end)
{
    return (struct answers){place(&sides, n, 1, gap, at_end),
                            place(&ons, n, 1, gap + 1, at_end),
                            place(&safeties, n, sizeof(double), gap, at_end)};
}

static int only_answers_written(const struct answers *a, size_t n)
{
    return guarded_kept(&sides, a->side, n) && guarded_kept(&ons, a->on, n) &&
           guarded_kept(&safeties, a->safety, n * sizeof(double));
}

static void ask(const cylint_shape *shapes, int each,
                const cylint_points *points, double ulps,
                const struct answers *to)
{
    if (each) {
        cylint_contains_pairs(shapes, points, to->side);
        cylint_safety_pairs(shapes, points, to->safety);
        cylint_on_surface_pairs(shapes, points, ulps, to->on);
    } else {
        cylint_contains_points(shapes, points, to->side);
        cylint_safety_points(shapes, points, to->safety);
        cylint_on_surface_points(shapes, points, ulps, to->on);
    }
}

static int is_answer(const struct answers *a, size_t i, const cylint_shape *s,
                     const double p[3], double ulps)
{
    const double safety = cylint_safety(s, p);
    return a->side[i] == cylint_contains(s, p) &&
           memcmp(&a->safety[i], &safety, sizeof safety) == 0 &&
           a->on[i] == cylint_on_surface(s, p, ulps);
}

/* The first n points and shape number `one`, or the first n shapes if `one` is
 * MOST. */
static void check_batch(size_t one, size_t n, double ulps, size_t gap,
                        int at_end)
{
    const int each = one == MOST;
    const cylint_shape *shapes = lay_shapes(each ? n : one + 1, gap, at_end);
    const cylint_points points = lay_points(n, gap, at_end);
    const struct answers got = lay_answers(n, gap, at_end);
    ask(each ? shapes : shapes + one, each, &points, ulps, &got);
    CHECK(only_answers_written(&got, n));
    for (size_t i = 0; i < n; i++) {
        const struct family_case *c = &drawn[each ? i : one];
        if (!CHECK(is_answer(&got, i, &c->shape, place_of_case[i], ulps))) {
            REPORT_CASE(c);
            REPORT("kernels %s, point %zu: %a %a %a", cylint_kernels_in_use(),
                   i, place_of_case[i][0], place_of_case[i][1],
                   place_of_case[i][2]);
        }
    }
}

/* --------------------------------------------------------------- tests -- */

static void with_all_kernels(void test(void))
{
    for (int k = 0; cylint_kernels_name(k); k++) {
        CHECK(cylint_use_kernels(cylint_kernels_name(k)));
        test();
    }
    cylint_use_kernels(NULL);
}

static void check_families(void)
{
    for (int family = 0; family < family_count(); family++) {
        draw_family(family, 100);
        check_batch(MOST, 100, 0, 0, 1);
        for (size_t one = 0; one < 8; one++)
            check_batch(one, 90 + one, one % 2 ? 4 : 0, 0, 1);
    }
}

static void batches_of_all_families_answer_as_single_questions(void)
{
    with_all_kernels(check_families);
}

/* Longer than two blocks; shapes of all kinds and refused ones side by side. */
static void check_mixed(void)
{
    draw_mixed(MOST);
    check_batch(MOST, MOST, 0, 0, 1);
    check_batch(MOST, MOST, 3, 0, 0);
    for (size_t one = 0; one < 60; one++)
        check_batch(one, one % 12 ? 40 : MOST, 1, 0, 1);
}

static void mixed_batches_answer_as_single_questions(void)
{
    with_all_kernels(check_mixed);
}

static void check_addresses(void)
{
    draw_mixed(FEW);
    for (size_t n = 0; n <= FEW; n++)
        for (size_t gap = 0; gap < 8; gap++)
            for (int at_end = 0; at_end < 2; at_end++) {
                check_batch(MOST, n, 0, gap, at_end);
                check_batch(gap % 2 ? 3 : 10, n, 0, gap, at_end);
            }
}

static void batches_of_all_lengths_serve_all_addresses(void)
{
    with_all_kernels(check_addresses);
}

/* The single questions are asked in the same environment.  Sides are those of the
 * default one, and so are, but for elliptic kinds, the points on the surface. */
static void check_environment(struct environment there)
{
    enum { N = 100 };
    static signed char side[N], on[N], got_side[N], got_on[N];
    static double safety[N], x[3][N];
    static cylint_shape shapes[N];
    const cylint_points points = {N, {x[0], x[1], x[2]}};
    for (size_t i = 0; i < N; i++) {
        shapes[i] = drawn[i].shape;
        for (int k = 0; k < 3; k++)
            x[k][i] = place_of_case[i][k];
        side[i] = (signed char)cylint_contains(&shapes[i], place_of_case[i]);
        on[i] = (signed char)cylint_on_surface(&shapes[i], place_of_case[i], 2);
    }
    const struct answers got = {got_side, got_on, safety};
    int same = 1;
    environment_set(there);
    ask(&shapes[1], 0, &points, 2, &got);
    for (size_t i = 0; i < N; i++)
        same &= is_answer(&got, i, &shapes[1], place_of_case[i], 2);
    ask(shapes, 1, &points, 2, &got);
    for (size_t i = 0; i < N; i++)
        same &= is_answer(&got, i, &shapes[i], place_of_case[i], 2);
    environment_reset();
    CHECK(same);
    CHECK(memcmp(side, got_side, N) == 0);
    for (size_t i = 0; i < N; i++)
        CHECK(got_on[i] == on[i] || cylint_is_elliptic(shapes[i].kind));
}

static void check_environments(void)
{
    draw_mixed(MOST);
    everywhere(check_environment);
    for (int family = 0; family < family_count(); family += 5) {
        draw_family(family, MOST);
        everywhere(check_environment);
    }
}

static void batches_answer_as_single_questions_in_any_environment(void)
{
    with_all_kernels(check_environments);
}

/* Known by hand, without families. */
static void refused_shapes_and_points_answer_as_documented(void)
{
    static const double zero[3] = {0, 0, 0}, top[3] = {0, 0, 2};
    static const double x[4] = {0, 1, NAN, 9}, y[4] = {0, 0, 0, HUGE_VAL},
                        z[4] = {1, 1, 1, 1};
    static const signed char want[4] = {1, 0, -1, -1};
    const cylint_points points = {4, {x, y, z}};
    signed char side[4], on[4];
    double safety[4];
    cylint_shape s[4];
    for (int i = 0; i < 4; i++)
        cylint_cylinder(&s[i], zero, top, 1, CYLINT_ENDS_CAPPED);
    const struct answers to = {side, on, safety};
    for (int each = 0; each < 2; each++) {
        ask(s, each, &points, 0, &to);
        CHECK(memcmp(side, want, sizeof side) == 0);
        CHECK(on[0] == 0 && on[1] == 1 && on[2] == 0 && on[3] == 0);
        CHECK(safety[0] > 0.999 && safety[0] <= 1 && safety[1] == 0);
        CHECK(safety[2] == HUGE_VAL && safety[3] == HUGE_VAL);
    }
    for (int i = 0; i < 4; i++)
        CHECK(cylint_cylinder(&s[i], zero, zero, 1, CYLINT_ENDS_CAPPED) ==
              CYLINT_EAXIS);
    for (int each = 0; each < 2; each++) {
        ask(s, each, &points, HUGE_VAL, &to);
        for (int i = 0; i < 4; i++)
            CHECK(side[i] == -1 && on[i] == 0 && safety[i] == HUGE_VAL);
    }
}

int main(void)
{
    RUN(refused_shapes_and_points_answer_as_documented);
    if (family_count() > 0) {
        allocate_pages();
        RUN(batches_of_all_families_answer_as_single_questions);
        RUN(mixed_batches_answer_as_single_questions);
        RUN(batches_of_all_lengths_serve_all_addresses);
        RUN(batches_answer_as_single_questions_in_any_environment);
    }
    return check_end();
}
