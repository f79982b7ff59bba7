/*
 * test_batch.c - batches of points return the bits of single questions, in the
 * lanes of all builds
 *
 * The batches are those of distances, contains, safety and on_surface.  Their
 * arrays begin or end at guard pages, at all addresses; inputs are read-only
 * during the call. Shapes are of all families, kinds and ends, and refused
 * ones; points are near their features, far away, and not finite.
 */
#include <math.h>
#include <string.h>

#define CHECK_OWN_MAIN
#include "closest.h"
#include "distance/lanes.h"
#include "distance_points.h"
#include "environment.h"
#include "guarded.h"

enum { MOST = 600, FEW = 21, COLUMNS = 12 };
enum { DISTANCE, PART, FEATURE, POINT, SIDE = 9, ON, SAFETY };
enum { ALL = (1 << COLUMNS) - 1, MEMBERS = 0x3f << POINT };

/* -------------------------------------------------------------- layout -- */

static struct guarded coordinates[3], shape_pages, pages[COLUMNS];
static void *column[COLUMNS];

static size_t size_of(int k)
{
    return k == PART || k == FEATURE || k == SIDE || k == ON ? 1
                                                             : sizeof(double);
}

static void allocate_pages(void)
{
    for (int k = 0; k < 3; k++)
        coordinates[k] = guarded_allocate(MOST * sizeof(double));
    shape_pages = guarded_allocate(MOST * sizeof(cylint_shape));
    for (int k = 0; k < COLUMNS; k++)
        pages[k] = guarded_allocate(MOST * size_of(k));
}

static struct family_case drawn[MOST];
static double place_of_case[MOST][3];

static void *place(const struct guarded *p, size_t n, size_t size, size_t gap,
                   int at_end)
{
    return guarded_place(p, n * size, gap * size % 64, at_end);
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

/* The columns of `mask`. */
static cylint_closest_columns lay_answers(size_t n, unsigned mask, size_t gap,
                                          int at_end)
{
    for (int k = 0; k < COLUMNS; k++) {
        column[k] = place(&pages[k], n, size_of(k), gap + (size_t)k, at_end);
        if (!(mask >> k & 1))
            column[k] = NULL;
    }
    return (cylint_closest_columns){column[DISTANCE],
                                    column[PART],
                                    column[FEATURE],
                                    {column[3], column[4], column[5]},
                                    {column[6], column[7], column[8]}};
}

/* ------------------------------------------------------------- batches -- */

/* each: point i and shape i; else point i and the one shape. */
static void answer_batches(const cylint_shape *shapes, int each,
                           const cylint_points *points, double ulps,
                           const cylint_closest_columns *to)
{
    (each ? cylint_distance_pairs : cylint_distance_points)(shapes, points, to);
    if (column[SIDE])
        (each ? cylint_contains_pairs : cylint_contains_points)(shapes, points,
                                                                column[SIDE]);
    if (column[SAFETY])
        (each ? cylint_safety_pairs : cylint_safety_points)(shapes, points,
                                                            column[SAFETY]);
    if (column[ON])
        (each ? cylint_on_surface_pairs
              : cylint_on_surface_points)(shapes, points, ulps, column[ON]);
}

/* Whether element i of the columns is what single questions return. */
static int is_answer(size_t i, const cylint_shape *s, const double p[3],
                     double ulps)
{
    int described = 0;
    for (int k = POINT; k < SIDE; k++)
        described |= column[k] != NULL;
    const cylint_closest a =
        answer_to(s, p, described ? WANT : CYLINT_WANT_PART);
    const double value[COLUMNS] = {
        a.distance,  0,           0,
        a.point[0],  a.point[1],  a.point[2],
        a.normal[0], a.normal[1], a.normal[2],
        0,           0,           column[SAFETY] ? cylint_safety(s, p) : 0};
    for (int k = 0; k < COLUMNS; k++) {
        const int missing = k >= FEATURE && k < SIDE && a.part == -1;
        int same = 1;
        if (!column[k])
            continue;
        if (size_of(k) == 1)
            same = (missing && k == FEATURE) ||
                   ((const signed char *)column[k])[i] ==
                       (k == PART      ? a.part
                        : k == FEATURE ? a.feature
                        : k == SIDE    ? cylint_contains(s, p)
                                       : cylint_on_surface(s, p, ulps));
        else
            same = missing ? isnan(((const double *)column[k])[i])
                           : memcmp((const double *)column[k] + i, &value[k],
                                    sizeof *value) == 0;
        if (!same)
            return 0;
    }
    return 1;
}

struct layout {
    size_t gap;
    int at_end;
    unsigned mask;
    double ulps;
};

/* The first n points and shape number `one`, or the first n shapes if it is
 * MOST. */
static void check_batch(size_t one, size_t n, const struct layout *at)
{
    const int each = one == MOST;
    const cylint_shape *shapes =
        lay_shapes(each ? n : one + 1, at->gap, at->at_end);
    const cylint_points points = lay_points(n, at->gap, at->at_end);
    const cylint_closest_columns to =
        lay_answers(n, at->mask, at->gap, at->at_end);
    answer_batches(each ? shapes : shapes + one, each, &points, at->ulps, &to);
    for (int k = 0; k < COLUMNS; k++)
        CHECK(
            guarded_kept(&pages[k], column[k], column[k] ? n * size_of(k) : 0));
    for (size_t i = 0; i < n; i++) {
        const struct family_case *c = &drawn[each ? i : one];
        if (!CHECK(is_answer(i, &c->shape, place_of_case[i], at->ulps))) {
            REPORT_CASE(c);
            REPORT("kernels %s, point %zu: %a %a %a", cylint_kernels_in_use(),
                   i, place_of_case[i][0], place_of_case[i][1],
                   place_of_case[i][2]);
        }
    }
}

/* ----------------------------------------------------------- questions -- */

static const struct layout usual = {0, 1, ALL, 0};
static const struct layout without_members = {0, 1, ALL & ~MEMBERS, 3};

/* Points of the cases; some coordinates are not finite, or extreme. */
static void draw_points(size_t n, uint64_t seed)
{
    static const double odd[] = {NAN,     HUGE_VAL,  -HUGE_VAL, DBL_MAX,
                                 0x1p101, 0x1p-1074, -0.0};
    stream = seed;
    for (size_t i = 0; i < n; i++) {
        double *p = place_of_case[i];
        draw_point(&drawn[i], p);
        if (one_of(12) == 0)
            set_any(p, odd[one_of(7)]);
    }
}

/* n times this case, with points about its shape. */
static void draw_points_about(const struct family_case *c, size_t n,
                              uint64_t seed)
{
    for (size_t i = 0; i < n; i++)
        drawn[i] = *c;
    draw_points(n, seed);
}

/* All families in turn, with all ends, any exponents, and refused shapes. */
static void draw_mixed(size_t n)
{
    stream = 43;
    for (size_t i = 0; i < n; i++) {
        struct family_case *c = &drawn[i];
        family_case(42, (int)(i % (size_t)family_count()), i, c);
        if (!cylint_is_round(c->shape.kind))
            c->ends = (cylint_ends)one_of(6);
        family_make(c);
    }
    draw_points(n, 44);
    for (size_t i = 0; i < n; i += 7)
        if (i % 2) {
            draw_far_point(&drawn[i], 0, place_of_case[i]);
        } else {
            drawn[i].shape_data[0] = NAN;
            family_make(&drawn[i]);
        }
}

/* Cases of a family, two of three with both caps, which lanes serve; their
 * points. */
static void draw_family(int family, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        family_case(41, family, i, &drawn[i]);
        if (i % 3)
            drawn[i].ends = CYLINT_ENDS_CAPPED;
        family_make(&drawn[i]);
    }
    draw_points(n, (uint64_t)family);
}

/* ---------------------------------------------------------------- tests -- */

TEST(batches_of_all_families_answer_as_single_questions)
{
    EACH_KERNELS(k) {
        for (int family = 0; family < family_count(); family++) {
            draw_family(family, 97);
            check_batch(MOST, 97, &usual);
            check_batch(MOST, 97, &without_members);
            for (size_t one = 0; one < 9; one++) {
                struct family_case c;
                family_case(21, family, one, &c);
                if (one % 2)
                    c.ends = CYLINT_ENDS_CAPPED;
                family_make(&c);
                draw_points_about(&c, 40 + one, one * 99 + (uint64_t)family);
                check_batch(0, 40 + one,
                            one % 4 < 2 ? &usual : &without_members);
            }
        }
    }
}

/* Longer than two blocks; shapes of all kinds and refused ones side by side.  Every
 * column can be wanted alone. */
TEST(mixed_batches_answer_as_single_questions)
{
    EACH_KERNELS(k) {
        draw_mixed(MOST);
        check_batch(MOST, MOST, &usual);
        check_batch(MOST, MOST, &without_members);
        for (size_t one = 0; one < 60; one++)
            check_batch(one, one % 30 ? 20 : MOST,
                        one % 2 ? &without_members : &usual);
        check_batch(MOST, CYLINT_POINT_BLOCK + 1, &usual);
        for (size_t one = 0; one < 10; one++)
            check_batch(one, CYLINT_POINT_BLOCK + 1, &usual);
        for (int c = 0; c <= COLUMNS; c++) { /* one column, or none */
            const struct layout at = {0, 1, c < COLUMNS ? 1u << c : 0, 0};
            check_batch(MOST, MOST, &at);
            for (size_t one = 0; one < 20; one++)
                check_batch(one, 40, &at);
        }
    }
}

TEST(batches_of_all_lengths_serve_all_addresses)
{
    EACH_KERNELS(k) {
        draw_mixed(FEW);
        for (size_t n = 0; n <= FEW; n++)
            for (size_t i = 0; i < 16; i++) {
                const struct layout at = {i / 2, (int)i % 2,
                                          n % 4 ? ALL & ~MEMBERS : ALL, 0};
                check_batch(MOST, n, &at);
                check_batch(i % 4 < 2 ? 3 : 10, n, &at);
            }
    }
}

/* The single calls are made in the same environment.  Sides are those of the
 * default one, and so are, but for elliptic kinds, the points on the surface. */
static void check_environment(struct environment there)
{
    enum { N = 100 };
    signed char side[N], on[N];
    int same = 1;
    for (size_t i = 0; i < N; i++) {
        side[i] =
            (signed char)cylint_contains(&drawn[i].shape, place_of_case[i]);
        on[i] = (signed char)cylint_on_surface(&drawn[i].shape,
                                               place_of_case[i], 2);
    }
    const cylint_shape *shapes = lay_shapes(N, 0, 1);
    const cylint_points points = lay_points(N, 0, 1);
    const cylint_closest_columns to = lay_answers(N, ALL, 0, 1);
    environment_set(there);
    answer_batches(&shapes[1], 0, &points, 2, &to);
    for (size_t i = 0; i < N; i++)
        same &= is_answer(i, &shapes[1], place_of_case[i], 2);
    answer_batches(shapes, 1, &points, 2, &to);
    for (size_t i = 0; i < N; i++)
        same &= is_answer(i, &shapes[i], place_of_case[i], 2);
    environment_reset();
    CHECK(same && memcmp(side, column[SIDE], N) == 0);
    for (size_t i = 0; i < N; i++)
        CHECK(((signed char *)column[ON])[i] == on[i] ||
              cylint_is_elliptic(drawn[i].shape.kind));
}

TEST(batches_answer_as_single_questions_in_any_environment)
{
    EACH_KERNELS(k) { /* cases of all families; then of some, other ones each */
        draw_mixed(MOST);
        EACH_ENVIRONMENT(there)
            check_environment(there);
        for (int family = k; family < family_count(); family += 15) {
            draw_family(family, 100);
            EACH_ENVIRONMENT(there)
                check_environment(there);
        }
    }
}

/* Above the upper end of the lateral line its distance and that of the end's plane
 * are one double: lanes have to subtract the right one from the point. */
TEST(cones_that_are_nearly_discs_have_their_nearest_points)
{
    enum { N = 40 };
    struct family_case c = case_of("cone 0 0 0 1.25  0 0 1 0.5");
    stream = 45;
    EACH_KERNELS(k)
        for (int flat = 24; flat < 60; flat++) {
            c.shape_data[6] = ldexp(1, -flat);
            family_make(&c);
            for (size_t i = 0; i < N; i++) {
                drawn[i] = c;
                place_of_case[i][0] = 0.5 + power(-12, -1);
                place_of_case[i][1] = 0;
                place_of_case[i][2] = between(0, 1);
            }
            check_batch(0, N, &usual);
        }
}

/* Of shape 0 no part is present. */
TEST(of_equal_shapes_the_first_is_closest)
{
    static const double p[3] = {5, 0, 1}, odd[3] = {5, 0, HUGE_VAL};
    static const cylint_shape refused; /* all zero */
    const cylint_shape s[3] = {shape_of("rcone 0 0 0 5  0 0 1 1 ends=cap1"),
                               shape_of("cylinder 0 0 0  0 0 2  1"),
                               shape_of("cylinder 0 0 0  0 0 2  1")};
    cylint_closest a;
    CHECK(cylint_closest_shape(s, 3, p, 4, CYLINT_WANT_PART, &a) == 1);
    CHECK(cylint_closest_shape(s + 1, 2, p, 4, CYLINT_WANT_PART, &a) == 0);
    CHECK(a.distance == 4 && a.feature == CYLINT_FEATURE_LATERAL);
    CHECK(cylint_closest_shape(s, 3, p, NAN, 0, &a) == 3);
    CHECK(cylint_closest_shape(s, 0, p, HUGE_VAL, 0, &a) == 0);
    CHECK(cylint_closest_shape(s, 1, p, HUGE_VAL, 0, &a) == 1);
    CHECK(cylint_closest_shape(s, 3, odd, HUGE_VAL, 0, &a) == 3);
    CHECK(cylint_closest_shape(&refused, 1, p, HUGE_VAL, 0, &a) == 1);
}

int main(void)
{
    allocate_pages();
    return check_all();
}
