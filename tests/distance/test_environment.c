/*
 * test_environment.c - floor distance: answers known by hand, in every
 * rounding mode and treatment of subnormals
 */
#include <math.h>

#include "environment.h"
#include "known_distances.h"

static const double origin[3] = {0, 0, 0};

/* In every environment: a product of ulps and the unit would be rounded, or
 * flushed to zero.  The distance is two units. */
static void check_two_units(struct environment e)
{
    static const double down[3] = {0, 0, -1}, p[3] = {0x1p-1073, 0x1p-1074, 0};
    cylint_shape s;
    cylint_closest a;
    cylint_tangent_cone(&s, origin, down, 1, CYLINT_ENDS_INFINITE);
    CHECK(cylint_distance(&s, p, 0, &a) == 0x1p-1073);
    environment_set(e);
    const int less = cylint_on_surface(&s, p, 0x1.fffffffffffffp0) ||
                     cylint_on_surface(&s, p, 0x1p-1074) ||
                     cylint_on_surface(&s, p, -0x1p-1074) ||
                     cylint_on_surface(&s, p, NAN);
    const int enough = cylint_on_surface(&s, p, 2) &&
                       cylint_on_surface(&s, p, 3.5) &&
                       cylint_on_surface(&s, p, HUGE_VAL);
    environment_reset();
    CHECK(!less && enough);
}

static void subnormal_units_are_compared_exactly(void)
{
    everywhere(check_two_units);
}

static void units_in_the_last_place_can_be_subnormal(void)
{
    const double small[3] = {0x1p-1000, 0, 0}, tiny[3] = {3 * 0x1p-1074, 0, 0};
    cylint_shape s;
    cylint_sphere(&s, origin, 0x1p-1000 - 0x1p-1052, CYLINT_ENDS_CAPPED);
    CHECK(cylint_on_surface(&s, small, 1));
    CHECK(!cylint_on_surface(&s, small, 0.9));
    cylint_sphere(&s, origin, 2 * 0x1p-1074, CYLINT_ENDS_CAPPED);
    CHECK(cylint_on_surface(&s, tiny, 1));
    CHECK(!cylint_on_surface(&s, tiny, 0.4));
}

static void an_infinite_distance_is_on_no_surface(void)
{
    static const double most = 0x1.fffffffffffffp1023;
    const double far[3] = {-most, 0, 0}, center[3] = {most, 0, 0};
    cylint_shape s;
    cylint_sphere(&s, center, 1, CYLINT_ENDS_CAPPED);
    CHECK(!cylint_on_surface(&s, far, HUGE_VAL));
    cylint_sphere(&s, origin, 1, CYLINT_ENDS_CAPPED);
    CHECK(cylint_on_surface(&s, far, HUGE_VAL));
    CHECK(!cylint_on_surface(&s, far, 0x1p53 - 2));
    CHECK(cylint_on_surface(&s, far, 0x1p53 - 1));
}

/* Squares of the coordinates overflow, and rounding downward and toward zero an
 * overflow is the largest double. */
static void check_safety_beyond_all_squares(struct environment e)
{
    static const double p0[3] = {3, 0, -3}, p1[3] = {4, 0, -3};
    for (int far = 490; far <= 1019; far++) {
        const double p[3] = {ldexp(-12.07, far), ldexp(4.21, far),
                             ldexp(13.45, far)};
        for (int ends = 0; ends < 6; ends++) {
            cylint_shape s;
            cylint_closest a;
            cylint_cone(&s, p0, 2, p1, 1, (cylint_ends)ends);
            const double d = fabs(cylint_distance(&s, p, 0, &a));
            environment_set(e);
            const double safe = cylint_safety(&s, p);
            environment_reset();
            if (!CHECK(safe > 0.999 * d && safe <= d))
                REPORT("2^%d, ends %d, rounding %d: safety %a, distance %a",
                       far, ends, e.rounding, safe, d);
        }
    }
}

static void a_safety_beyond_all_squares_is_below_the_distance(void)
{
    everywhere(check_safety_beyond_all_squares);
}

/* -0 + 0 is -0 rounding downward. */
static void check_zeros(struct environment e)
{
    static const double inside[3] = {0x1.eb851eb851eb8p-3, -0x1p-1074,
                                     -0x1.70a3d70a3d70ap-3},
                        beside[3] = {-3, -0.0, 1}, top[3] = {0, 0, 2};
    static const double a[3] = {2, 0, 0}, b[3] = {0, 1, 0};
    cylint_shape s[3];
    cylint_sphere(&s[0], origin, 0.3, CYLINT_ENDS_CAPPED);
    cylint_cylinder(&s[1], origin, top, 1, CYLINT_ENDS_CAPPED);
    cylint_elliptic_cylinder(&s[2], origin, a, b, top, CYLINT_ENDS_CAPPED);
    for (int i = 0; i < 3; i++) {
        environment_set(e);
        const cylint_closest q = answer_to(&s[i], i ? beside : inside, WANT);
        const double safe = cylint_safety(&s[i], i ? beside : inside);
        environment_reset();
        CHECK(!signbit(safe) && !has_negative_zero(&q));
    }
}

static void zeros_have_no_sign_in_any_environment(void)
{
    everywhere(check_zeros);
}

/* An end whose radius is the least double is no apex, and three units are more
 * than two: also where the processor reads both as zero. */
static void check_subnormal_shapes(struct environment e)
{
    static const double below[3] = {0, 0, -3}, top[3] = {0, 0, 2};
    const double unit = 0x1p-1074, p1[3] = {3 * unit, 2 * unit, 5 * unit};
    cylint_shape s[3];
    cylint_round_cone(&s[0], origin, unit, top, 1, CYLINT_ENDS_CAPPED);
    cylint_cone(&s[1], origin, unit, top, 1, CYLINT_ENDS_OPEN);
    cylint_cylinder(&s[2], origin, p1, 1, CYLINT_ENDS_INFINITE);
    for (int i = 0; i < 3; i++) {
        const double *p = i == 2 ? origin : below;
        const cylint_closest want = answer_to(&s[i], p, WANT);
        environment_set(e);
        const cylint_closest got = answer_to(&s[i], p, WANT),
                             parted = answer_to(&s[i], p, CYLINT_WANT_PART);
        environment_reset();
        CHECK(want.feature == (i == 0   ? CYLINT_FEATURE_CAP0
                               : i == 1 ? CYLINT_FEATURE_RIM0
                                        : CYLINT_FEATURE_LATERAL));
        CHECK(got.feature == want.feature && parted.feature == want.feature &&
              got.part == want.part && parted.part == want.part);
        CHECK(are_within(got.normal, want.normal, 4));
    }
}

static void subnormal_shapes_are_the_same_in_any_environment(void)
{
    everywhere(check_subnormal_shapes);
}

int main(void)
{
    RUN(subnormal_units_are_compared_exactly);
    RUN(units_in_the_last_place_can_be_subnormal);
    RUN(an_infinite_distance_is_on_no_surface);
    RUN(a_safety_beyond_all_squares_is_below_the_distance);
    RUN(zeros_have_no_sign_in_any_environment);
    RUN(subnormal_shapes_are_the_same_in_any_environment);
    return check_end();
}
