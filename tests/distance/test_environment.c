/*
 * test_environment.c - floor distance: answers known by hand, in every
 * rounding mode and treatment of subnormals
 */
#include <math.h>

#include "closest.h"
#include "environment.h"

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

TEST(subnormal_units_are_compared_exactly)
{
    everywhere(check_two_units);
}

TEST(units_in_the_last_place_can_be_subnormal)
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

TEST(an_infinite_distance_is_on_no_surface)
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

/* Nearest to the surface, rims and balls.  Radii are subnormal, so that coordinates
 * of nearest points are. */
static cylint_status make_tiny(int i, cylint_shape *s, double p[3])
{
    static const double top[3] = {0, 0, 1}, tiny[3] = {0, 0, 3 * 0x1p-1074};
    const double r = 0x1.8p-1060, z[] = {0.5, 2, 2, 3, -1, 2};
    p[0] = 3;
    p[1] = -4;
    p[2] = i < 6 ? z[i] : 0;
    return i < 2    ? cylint_cylinder(s, origin, top, r, CYLINT_ENDS_CAPPED)
           : i == 2 ? cylint_cone(s, origin, 0, top, r, CYLINT_ENDS_CAPPED)
           : i < 5
               ? cylint_round_cone(s, origin, 2 * r, top, r, CYLINT_ENDS_CAPPED)
           : i == 5 ? cylint_cylinder(s, origin, tiny, r, CYLINT_ENDS_CAPPED)
                    : cylint_sphere(s, origin, r, CYLINT_ENDS_CAPPED);
}

static void check_tiny_members(struct environment e)
{
    for (int i = 0; i < 7; i++) {
        double p[3];
        cylint_shape s;
        CHECK(make_tiny(i, &s, p) == CYLINT_OK);
        const cylint_closest known = answer_to(&s, p, WANT);
        environment_set(e);
        const cylint_closest a = answer_to(&s, p, WANT);
        environment_reset();
        const double ulps = e.rounding == FE_TONEAREST ? 0 : 4;
        if (!CHECK(a.distance == known.distance && a.feature == known.feature &&
                   are_within(a.point, known.point, ulps, 0) &&
                   are_within(a.normal, known.normal, ulps, 0)))
            REPORT("case %d, rounding %d, subnormals %d: point %a %a %a, "
                   "normal %a %a %a",
                   i, e.rounding, e.tiny, a.point[0], a.point[1], a.point[2],
                   a.normal[0], a.normal[1], a.normal[2]);
    }
}

TEST(subnormal_numbers_of_nearest_points_and_normals_are_not_flushed)
{
    everywhere(check_tiny_members);
}

static void check_huge_point(struct environment e)
{
    static const double apex[3] = {0x1p450, 0, 0x1.fffffffffffffp1023};
    static const double axis[3] = {-1, 3, 0x1.2p271}, p[3] = {0, 0, -2};
    cylint_shape s;
    cylint_tangent_cone(&s, apex, axis, 1, CYLINT_ENDS_CAPPED);
    environment_set(e);
    const cylint_closest a = answer_to(&s, p, WANT);
    environment_reset();
    CHECK(a.feature == CYLINT_FEATURE_APEX && a.point[2] == apex[2]);
}

TEST(a_point_at_the_largest_double_is_finite_in_every_rounding_mode)
{
    everywhere(check_huge_point);
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

TEST(a_safety_beyond_all_squares_is_below_the_distance)
{
    everywhere(check_safety_beyond_all_squares);
}
