/*
 * test_environment.c - floors shape and intersect: no floating-point environment
 * changes constructors and named cases
 *
 * Shapes are made and questions answered in the default environment and in each
 * other one.  The statuses, every bit of the differences that constructors
 * compute and of all members of hits must agree.  scene/test_paths.c does this
 * for random cases and all calls.
 */
#include <math.h>

#include "check.h"
#include "environment.h"
#include "same.h"
#include "shapes/shape_facts.h"

/* The differences that constructors compute: axis, dr and d, high and low parts. */
enum { DIFFERENCES = 14, CASES = 400 };

struct answers {
    int line_status, shape_status, kind, left_handed, contains;
    double made[DIFFERENCES];
    cylint_answer all;
};

static void answer(const struct family_case *c, struct answers *to)
{
    memset(to, 0, sizeof *to);
    to->line_status = (int)c->line_status;
    to->shape_status = (int)c->shape_status;
    to->kind = c->shape.kind;
    to->left_handed = cylint_left_handed(&c->shape);
    for (int i = 0; i < 3; i++) {
        to->made[i] = cylint_axis(&c->shape)[i];
        to->made[i + 3] = cylint_axis_pair(&c->shape, i).lo;
        to->made[i + 6] = c->line.d[i];
        to->made[i + 9] = c->line.d_lo[i];
    }
    to->made[12] = cylint_radius_growth(&c->shape).hi;
    to->made[13] = cylint_radius_growth(&c->shape).lo;
    cylint_intersect(&c->shape, &c->line, CYLINT_WANT_ALL, &to->all);
    to->contains = cylint_contains(&c->shape, c->line_data);
}

static int same_made(const struct answers *x, const struct answers *y)
{
    int same = x->line_status == y->line_status &&
               x->shape_status == y->shape_status && x->kind == y->kind &&
               x->left_handed == y->left_handed && x->contains == y->contains;
    for (int i = 0; i < DIFFERENCES; i++)
        same = same && (x->made[i] == y->made[i]);
    return same;
}

/* Makes the case in the default or the other environment and answers it in the
 * default or the other one. */
static void compare(struct family_case c, struct environment there)
{
    static const char *const where[] = {
        "answered there", "made and answered there", "made there"};
    struct answers want, got[3];
    family_make(&c);
    answer(&c, &want);
    environment_set(there);
    answer(&c, &got[0]);
    family_make(&c);
    answer(&c, &got[1]);
    environment_reset();
    answer(&c, &got[2]);
    for (int i = 0; i < 3; i++)
        if (!CHECK(same_made(&got[i], &want) &&
                   same_answer(&got[i].all, &want.all, CYLINT_WANT_ALL)))
            report_answers(&c, where[i], &got[i].all, &want.all);
}

static void compare_ends(struct family_case c, cylint_ends ends,
                         struct environment there)
{
    c.ends = ends;
    compare(c, there);
}

static void made_of_families(struct environment there)
{
    const uint64_t seed = check_setting("CYLINT_SEED", 1) + 9;
    EACH_CASE(c, seed, check_setting("CYLINT_CASES", 20))
        compare(c, there);
}

TEST(shapes_and_lines_are_made_the_same)
{
    everywhere(made_of_families);
}

/* Frusta whose radii differ by a subnormal number and whose axes are subnormal;
 * radii and axes of one subnormal unit; tiny radii far from the origin, and
 * subnormal offsets among other tiny numbers, which must not be lost before
 * scaling. */
static void subnormal_shapes(struct environment there)
{
    static const double size[] = {0x1p-1022, 0x1.8p-1021, 0x1p-1000, 0x1p-1060,
                                  0x1p-1074};
    const double s = 0x1p-1074;
    for (int i = 0; i < 5; i++)
        for (int ends = CYLINT_ENDS_CAPPED; ends <= CYLINT_ENDS_NAPPE; ends++) {
            const double x = size[i];
            const double line[] = {0, x, -3 * x, x, -x, 4 * x};
            const double cone[] = {0, 0, x, x, 0, s, 4 * x, x + 2 * s};
            const double rod[] = {x, x, x, x, x, x + s, x};
            compare_ends(family_of(FAMILY_LINE, line, FAMILY_CONE, cone),
                         (cylint_ends)ends, there);
            compare_ends(family_of(FAMILY_SEGMENT, line, FAMILY_CYLINDER, rod),
                         (cylint_ends)ends, there);
        }
    for (int e = 0; e < 70; e++) {
        const double x = 0x1p-1005, y = ldexp(1, -1074 + e);
        const double line[] = {x + y, y, -3 * x, y, s, x};
        const double rod[] = {y, s, 0, 0, s, x, x + y};
        compare_ends(family_of(FAMILY_LINE, line, FAMILY_CYLINDER, rod),
                     e % 2 ? CYLINT_ENDS_INFINITE : CYLINT_ENDS_CAPPED, there);
    }
}

/* A base a subnormal number beside the line; axes of which two components differ by
 * one, which decides where phi is 0. */
static void subnormal_differences(struct environment there)
{
    const double s = 0x1p-1072, along[] = {-3, 0, 4, 1, 0, 0};
    const double ellipse[] = {-3, s, 3, 8, 0, 0, 0, 8, 0, 0, 0, 2};
    const double rod[] = {0, -1, 2, -2, 1, s, 4};
    const double frustum[] = {s, 0, 0, 2, -2, 2, 1, 3};
    compare(family_of(FAMILY_LINE, along, FAMILY_ECYLINDER, ellipse), there);
    compare(family_of(FAMILY_LINE, along, FAMILY_CYLINDER, rod), there);
    compare(family_of(FAMILY_LINE, along, FAMILY_CONE, frustum), there);
}

/* Domains whose ends, or hits whose t, are subnormal. */
static void subnormal_domains(struct environment there)
{
    const double s = 0x1p-1074, rod[] = {0, 0, 0, 0, 0, 3 * s, 1};
    const double huge_step[] = {1, 0, -3, 0, 0, 0x1p1023};
    const double unit[] = {0, 0, 0, 0, 0, 1, 1};
    for (int i = 0; i < 81; i++) {
        const double line[] = {
            0, 0, 0, 0, 0, 1, (i / 9 - 4) * s, (i % 9 - 4) * s};
        compare(family_of(FAMILY_SPAN, line, FAMILY_CYLINDER, rod), there);
    }
    compare(family_of(FAMILY_RAY, huge_step, FAMILY_CYLINDER, unit), there);
}

/* Each power of two below the normal numbers. */
static void subnormal_arguments(struct environment there)
{
    for (int e = 0; e < 52; e++) {
        const double x = ldexp(1, -1074 + e), y = -x;
        const double zero[3] = {0, 0, 0}, d[3] = {x, 0, 0}, b[3] = {0, y, 0};
        cylint_line line;
        cylint_shape shape;
        environment_set(there);
        const int made =
            !cylint_ray(&line, zero, d) && !cylint_segment(&line, zero, b) &&
            !cylint_span(&line, zero, b, y, x) &&
            !cylint_cylinder(&shape, zero, d, x, CYLINT_ENDS_OPEN) &&
            !cylint_tangent_cone(&shape, zero, b, x, CYLINT_ENDS_OPEN);
        const cylint_status domain = cylint_span(&line, zero, b, x, y);
        const cylint_status radius =
            cylint_cylinder(&shape, zero, d, y, CYLINT_ENDS_OPEN);
        environment_reset();
        CHECK(made && domain == CYLINT_EDOMAIN && radius == CYLINT_ERADIUS);
    }
}

TEST(subnormal_numbers_are_not_lost)
{
    if (!can_treat_subnormals(FLUSH | ZERO))
        puts("note: this processor cannot flush subnormals");
    everywhere(subnormal_arguments);
    everywhere(subnormal_shapes);
    everywhere(subnormal_differences);
    everywhere(subnormal_domains);
}

/* Squares of the distance overflow, to infinity or to the largest double. */
static void overflowing_squares(struct environment there)
{
    const double rod[] = {2, 2, -1, 1, 0, 1, 3};
    const double cone[] = {-3, 0, 2, 2, 1, -3, 2, 1};
    for (int e = 60; e < 1020; e++) {
        const double back[] = {3, ldexp(0x1.f39b9148p0, e), -1, 0, 1, 0};
        const double past[] = {ldexp(1, e), 3, 0, -2, -1, 2};
        compare(family_of(FAMILY_LINE, back, FAMILY_CYLINDER, rod), there);
        compare_ends(family_of(FAMILY_LINE, past, FAMILY_CONE, cone),
                     CYLINT_ENDS_INFINITE, there);
    }
}

TEST(squares_that_overflow_are_no_matter)
{
    everywhere(overflowing_squares);
}

static void rounded_tangents(struct environment there)
{
    const double v[] = {0, 0, 0}, u[] = {0, 0, 1};
    for (int i = 0; i < 10 * CASES; i++) {
        const double part = (double)(i + 1) / (double)(10 * CASES + 1);
        const double angle = i % 3 == 0   ? 90 * part
                             : i % 3 == 1 ? 90 - part * 0x1p-20
                                          : ldexp(part, -1 - i % 1070);
        cylint_shape want, got;
        const cylint_status status =
            cylint_angle_cone(&want, v, u, angle, CYLINT_ENDS_CAPPED);
        environment_set(there);
        const cylint_status other =
            cylint_angle_cone(&got, v, u, angle, CYLINT_ENDS_CAPPED);
        environment_reset();
        if (!CHECK(status == other &&
                   same_double(cylint_r1(&want), cylint_r1(&got))))
            REPORT("acone 0 0 0  0 0 1  %a: got %a, want %a", angle,
                   cylint_r1(&got), cylint_r1(&want));
    }
}

TEST(tangents_of_angles_are_the_same)
{
    everywhere(rounded_tangents);
}

/* Signs that doubles cannot decide: of B for lines parallel to a ruling, and of
 * u.w at an apex, which decides the normal. */
static void long_signs(struct environment there)
{
    const struct family_case c =
        case_of("line 0 0 0  1 -0x1.fffffffffffffp-1 0  "
                "acone 0 0 0  1 1 0  45  ends=infinite");
    cylint_answer a;
    compare(case_of("line 0x1.0000000000001p0 0 1  1 0 1  "
                    "acone 0 0 0  0 0 1  45  ends=infinite"),
            there);
    compare(c, there);
    environment_set(there);
    cylint_intersect(&c.shape, &c.line, CYLINT_WANT_NORMAL, &a);
    environment_reset();
    CHECK(a.n == 1 && a.hit[0].normal[0] < 0 && a.hit[0].normal[1] < 0);
}

TEST(signs_by_more_than_doubles_are_the_same)
{
    everywhere(long_signs);
}

/* ------------------------------------------------------------ self-test -- */

static void detected(struct environment there)
{
    const int want =
        (there.rounding == FE_TONEAREST ? 0 : CYLINT_SELFTEST_DIRECTED) |
        (there.tiny & FLUSH ? CYLINT_SELFTEST_FLUSHED : 0) |
        (there.tiny & ZERO ? CYLINT_SELFTEST_ZEROED : 0);
    environment_set(there);
    const int found = cylint_selftest();
    environment_reset();
    if (!CHECK(found == want))
        REPORT("found %d, not %d", found, want);
}

TEST(the_selftest_detects_each_environment)
{
    CHECK(cylint_selftest() == 0);
    everywhere(detected);
}

static void kept(struct environment there)
{
    for (int family = 0; family < family_count(); family++) {
        struct family_case c;
        struct answers answers;
        double lo[3], hi[3];
        family_case(1, family, 0, &c);
        environment_set(there);
        const int before = cylint_selftest();
        family_make(&c);
        answer(&c, &answers);
        cylint_bounds(&c.shape, lo, hi);
        const int after = cylint_selftest(), rounding = fegetround();
        environment_reset();
        CHECK(before == after && rounding == there.rounding);
    }
}

TEST(no_function_changes_the_environment)
{
    everywhere(kept);
}
