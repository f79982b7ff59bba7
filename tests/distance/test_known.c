/*
 * test_known.c - floor distance: answers known by hand, and properties
 *
 * The oracle's tests are in test_oracle.c.  CYLINT_CASES is the number
 * of shapes of each family, with POINTS points each.  CYLINT_FAR is the number
 * of cases whose numbers have any exponents of doubles.
 */
#include <math.h>
#include <string.h>

#include "distance/nearest.h"
#include "distance/one_distance.h"
#include "distance_points.h"
#include "environment.h"
#include "known_distances.h"
#include "numbers/bits.h"
#include "shapes/layout.h"

enum { CASES = 60, POINTS = 4, FAR_CASES = 1000 };

static const double origin[3] = {0, 0, 0};

/* ------------------------------------------------------ known answers -- */

static cylint_shape cylinder(cylint_ends ends)
{
    static const double top[3] = {0, 0, 2};
    cylint_shape s;
    cylint_cylinder(&s, origin, top, 1, ends);
    return s;
}

/* The lateral surface has the slope 4/3: x = 3, z = 0 to x = 0, z = 4. */
static cylint_shape cone(cylint_ends ends)
{
    static const double top[3] = {0, 0, 4};
    cylint_shape s;
    cylint_cone(&s, origin, 3, top, 0, ends);
    return s;
}

/* The balls of radius 5 and 2 at the distance 5: sine -3/5. */
static cylint_shape round_cone(cylint_ends ends)
{
    static const double top[3] = {0, 0, 5};
    cylint_shape s;
    cylint_round_cone(&s, origin, 5, top, 2, ends);
    return s;
}

#define CHECK_KNOWN(shape, table)                                              \
    check_known(#table, shape, table, (int)(sizeof(table) / sizeof(table)[0]), \
                0, 0)

static void the_size_of_an_answer_is_that_of_the_header(void)
{
    CHECK(cylint_sizeof_closest() == sizeof(cylint_closest));
}

static void answers_about_a_capped_cylinder_are_known(void)
{
    static const struct known capped[] = {
        {{3, 0, 1}, 2, 0, LATERAL, {1, 0, 1}, {1, 0, 0}},
        {{0, 0.5, 1}, -0.5, 0, LATERAL, {0, 1, 1}, {0, 1, 0}},
        {{0, 0.5, -3}, 3, 1, CAP0, {0, 0.5, 0}, {0, 0, -1}},
        {{0.5, 0, 7}, 5, 2, CAP1, {0.5, 0, 2}, {0, 0, 1}},
        {{0.5, 0, 1.75}, -0.25, 2, CAP1, {0.5, 0, 2}, {0, 0, 1}},
        {{4, 0, -4}, 5, 0, RIM0, {1, 0, 0}, {1, 0, 0}},
        {{0, -4, 6}, 5, 0, RIM1, {0, -1, 2}, {0, -1, 0}},
        {{1, 0, 1}, 0, 0, LATERAL, {1, 0, 1}, {1, 0, 0}},
        {{0.5, 0.25, 0}, 0, 1, CAP0, {0.5, 0.25, 0}, {0, 0, -1}},
        {{1, 0, 2}, 0, 0, RIM1, {1, 0, 2}, {1, 0, 0}},
        /* right below a rim: the rim, not the cap */
        {{1, 0, -2}, 2, 0, RIM0, {1, 0, 0}, {1, 0, 0}},
        /* ties: lateral before caps, cap0 before cap1 */
        {{0.75, 0, 0.25}, -0.25, 0, LATERAL, {1, 0, 0.25}, {1, 0, 0}},
        /* on the axis: phi = 0 is the direction -y */
        {{0, 0, 1}, -1, 0, LATERAL, {0, -1, 1}, {0, -1, 0}},
    };
    CHECK_KNOWN(cylinder(CYLINT_ENDS_CAPPED), capped);
}

static void answers_of_other_ends_are_known(void)
{
    static const struct known open[] = {
        {{0.5, 0, 1}, 0.5, 0, LATERAL, {1, 0, 1}, {1, 0, 0}},
        {{0, 0, -1}, 1.4142135623730951, 0, RIM0, {0, -1, 0}, {0, -1, 0}},
        {{0, 0, 0}, 1, 0, RIM0, {0, -1, 0}, {0, -1, 0}},
    };
    static const struct known cap1[] = {
        {{0.5, 0, 1.75}, 0.25, 2, CAP1, {0.5, 0, 2}, {0, 0, 1}},
        {{0.5, 0, 0.25}, 0.5, 0, LATERAL, {1, 0, 0.25}, {1, 0, 0}},
        {{0.25, 0, -1}, 1.25, 0, RIM0, {1, 0, 0}, {1, 0, 0}},
    };
    static const struct known infinite[] = {
        {{0, 0.5, -7}, -0.5, 0, LATERAL, {0, 1, -7}, {0, 1, 0}},
        {{0, 3, 1e9}, 2, 0, LATERAL, {0, 1, 1e9}, {0, 1, 0}},
    };
    CHECK_KNOWN(cylinder(CYLINT_ENDS_OPEN), open);
    CHECK_KNOWN(cylinder(CYLINT_ENDS_CAP1), cap1);
    CHECK_KNOWN(cylinder(CYLINT_ENDS_INFINITE), infinite);
    CHECK_KNOWN(cylinder(CYLINT_ENDS_NAPPE), infinite);
}

static void answers_about_cones_are_known(void)
{
    static const struct known capped[] = {
        {{9.5, 0, 8}, 10, 0, LATERAL, {1.5, 0, 2}, {0.8, 0, 0.6}},
        {{0, 0, 6}, 2, 0, APEX, {0, 0, 4}, {0, 0, 1}},
        {{0, 0, 4}, 0, 0, APEX, {0, 0, 4}, {0, 0, 1}},
        {{6, 0, -4}, 5, 0, RIM0, {3, 0, 0}, {0.8, 0, 0.6}},
        {{0, 0, 1}, -1, 1, CAP0, {0, 0, 0}, {0, 0, -1}},
    };
    static const struct known infinite[] = {
        {{0, 0, 4}, 0, 0, APEX, {0, 0, 4}, {0, 0, -1}},
    };
    CHECK_KNOWN(cone(CYLINT_ENDS_CAPPED), capped);
    cylint_shape whole = cone(CYLINT_ENDS_INFINITE);
    CHECK_KNOWN(whole, infinite);
    /* the nearer nappe of a double cone; in the plane of the apex the one with
     * the base */
    static const double above[3] = {0, 0, 9}, beside[3] = {5, 0, 4};
    cylint_closest a;
    CHECK(cylint_distance(&whole, above, WANT, &a) == -3 && a.part == 0);
    CHECK(a.point[2] > 4 && a.normal[2] < 0);
    CHECK(cylint_distance(&whole, beside, WANT, &a) == 4);
    CHECK(a.point[2] < 4 && a.normal[2] > 0);
    cylint_shape nappe = cone(CYLINT_ENDS_NAPPE);
    CHECK(cylint_distance(&nappe, above, WANT, &a) == 5);
    CHECK(a.feature == APEX && a.normal[2] == 1);
}

/* Axes along z, apex at the origin.  Where a line or a point does not prefer a
 * nappe, the normal points towards the base, or, if the base is the apex, against
 * the axis. */
static void the_normal_at_the_apex_of_a_double_cone_is_stated(void)
{
    static const double below[3] = {0, 0, -2}, above[3] = {0, 0, 1},
                        top[3] = {0, 0, 3}, across[3] = {1, 0, 0};
    static const double expected[4] = {-1, 1, -1, -1};
    cylint_shape s[4];
    CHECK(!cylint_cone(&s[0], below, 2, origin, 0, CYLINT_ENDS_INFINITE) &&
          !cylint_cone(&s[1], above, 1, top, 3, CYLINT_ENDS_INFINITE) &&
          !cylint_cone(&s[2], origin, 0, top, 3, CYLINT_ENDS_INFINITE) &&
          !cylint_angle_cone(&s[3], origin, above, 45, CYLINT_ENDS_INFINITE));
    for (int i = 0; i < 4; i++) {
        const cylint_closest a = answer_to(&s[i], origin, WANT);
        cylint_answer hits;
        cylint_line line;
        CHECK(a.distance == 0 && a.feature == APEX);
        CHECK(a.normal[0] == 0 && a.normal[1] == 0 &&
              a.normal[2] == expected[i]);
        cylint_whole_line(&line, origin, across);
        CHECK(cylint_intersect(&s[i], &line, CYLINT_WANT_ALL, &hits) == 1);
        CHECK(hits.hit[0].normal[2] == expected[i]);
        for (int k = 0; k < 2; k++) {
            cylint_whole_line(&line, origin, k ? above : below);
            CHECK(cylint_intersect(&s[i], &line, CYLINT_WANT_ALL, &hits) == 1);
            CHECK(hits.hit[0].normal[2] == (k ? -1 : 1));
        }
    }
}

static void answers_about_round_shapes_are_known(void)
{
    static const struct known closed[] = {
        {{8, 0, 6}, 5, 0, RIM0, {4, 0, 3}, {0.8, 0, 0.6}},
        {{0, 0, -9}, 4, 1, CAP0, {0, 0, -5}, {0, 0, -1}},
        {{0, 0, 10}, 3, 2, CAP1, {0, 0, 7}, {0, 0, 1}},
    };
    cylint_shape s = round_cone(CYLINT_ENDS_CAPPED);
    CHECK_KNOWN(s, closed);
    static const double at_p0[3] = {0, 0, 0}, below[3] = {0, 0, -9};
    cylint_closest a;
    CHECK(cylint_distance(&s, at_p0, WANT, &a) == -5 && a.feature == RIM0);
    s = round_cone(CYLINT_ENDS_CAP1);
    CHECK(cylint_distance(&s, below, WANT, &a) == sqrt(16 + 144));
    CHECK(a.part == 0 && a.feature == RIM0);
    static const struct known ball[] = {
        {{3, 0, 4}, 4, 0, LATERAL, {0.6, 0, 0.8}, {0.6, 0, 0.8}},
        {{0, 0, 0}, -1, 0, LATERAL, {1, 0, 0}, {1, 0, 0}},
        {{0, 1, 0}, 0, 0, LATERAL, {0, 1, 0}, {0, 1, 0}},
    };
    cylint_sphere(&s, origin, 1, CYLINT_ENDS_CAPPED);
    CHECK_KNOWN(s, ball);
}

static void where_there_is_no_surface_the_distance_is_infinite(void)
{
    static const double near[3] = {0, 0, 1},
                        bad[2][3] = {{0, NAN, 0}, {HUGE_VAL, 0, 0}};
    cylint_closest a;
    cylint_shape s;
    cylint_round_cone(&s, origin, 5, near, 1, CYLINT_ENDS_CAP1);
    CHECK(cylint_distance(&s, near, 0, &a) == HUGE_VAL);
    CHECK(a.part == -1 && a.flags == 0);
    CHECK(cylint_safety(&s, near) == HUGE_VAL);
    cylint_round_cone(&s, origin, 5, near, 1, CYLINT_ENDS_CAP0);
    CHECK(cylint_distance(&s, near, WANT, &a) == 4 && a.part == 1);
    cylint_cylinder(&s, origin, origin, 1, CYLINT_ENDS_CAPPED);
    CHECK(cylint_distance(&s, near, 0, &a) == HUGE_VAL);
    CHECK(a.part == -1 && a.flags == CYLINT_FLAG_INVALID);
    CHECK(!cylint_on_surface(&s, near, 1e300));
    s = cylinder(CYLINT_ENDS_CAPPED);
    for (int i = 0; i < 2; i++) {
        CHECK(cylint_distance(&s, bad[i], WANT, &a) == HUGE_VAL);
        CHECK(a.part == -1 && a.flags == CYLINT_FLAG_INVALID);
        CHECK(cylint_safety(&s, bad[i]) == HUGE_VAL);
        CHECK(!cylint_on_surface(&s, bad[i], 1));
    }
}

static void a_point_is_on_a_surface_exactly_or_within_ulps(void)
{
    static const double on[3] = {0.6, 0.8, 1}, beside[3] = {1 + 0x1p-51, 0, 1},
                        exactly[3] = {1, 0, 1};
    const cylint_shape s = cylinder(CYLINT_ENDS_CAPPED);
    CHECK(!cylint_on_surface(&s, on, 0)); /* 0.6 and 0.8 are rounded */
    CHECK(cylint_on_surface(&s, on, 1));
    CHECK(cylint_on_surface(&s, exactly, 0));
    CHECK(!cylint_on_surface(&s, beside, 0));
    CHECK(!cylint_on_surface(&s, beside, 1.9));
    CHECK(cylint_on_surface(&s, beside, 2));
    CHECK(!cylint_on_surface(&s, exactly, -1));
    CHECK(!cylint_on_surface(&s, exactly, NAN));
}

static void the_distance_on_the_surface_has_no_sign(void)
{
    static const double top[3] = {0, 0, 2}, on[3] = {1, 0, 1};
    static const cylint_ends ends[] = {CYLINT_ENDS_CAPPED, CYLINT_ENDS_OPEN,
                                       CYLINT_ENDS_INFINITE};
    for (int i = 0; i < 3; i++) {
        cylint_shape s;
        cylint_closest a;
        cylint_cylinder(&s, origin, top, 1, ends[i]);
        const double distance = cylint_distance(&s, on, 0, &a);
        CHECK(distance == 0 && !signbit(distance) && !signbit(a.distance));
    }
}

static void every_exponent_is_answered(void)
{
    static const double least = 0x1p-1074, most = 0x1.fffffffffffffp1023;
    const double tiny[3] = {0, 0, 3 * least}, huge[3] = {most, 0, 0},
                 far[3] = {-most, -most, -most}, along[3] = {0, 0, 1},
                 beside[3] = {1, 0, least};
    cylint_closest a;
    cylint_shape s;
    cylint_sphere(&s, origin, least, CYLINT_ENDS_CAPPED);
    CHECK(cylint_distance(&s, tiny, WANT, &a) == 2 * least);
    CHECK(a.normal[2] == 1 && a.point[2] == least);
    CHECK(cylint_safety(&s, tiny) <= 2 * least);
    CHECK(cylint_distance(&s, huge, 0, &a) == most);
    cylint_cone(&s, origin, 1, along, 0.75, CYLINT_ENDS_INFINITE);
    CHECK(cylint_distance(&s, beside, 0, &a) == least);
    CHECK(cylint_safety(&s, beside) == 0 &&
          !signbit(cylint_safety(&s, beside)));
    CHECK(cylint_distance(&s, far, 0, &a) == HUGE_VAL && a.flags == 0);
    CHECK(cylint_safety(&s, far) == most);
    cylint_cylinder(&s, far, huge, most, CYLINT_ENDS_CAPPED);
    CHECK(cylint_distance(&s, origin, WANT, &a) < 0);
    CHECK(fabs(a.distance) > most / 4);
}

static void circles_of_tangency_are_lateral(void)
{
    static const double top[3] = {0, 0, 2}, at_base[3] = {3, 0, 0},
                        at_top[3] = {0, 3, 2}, beyond[3] = {3, 0, 2 + 0x1p-51},
                        before[3] = {0, 3, -0x1p-60};
    cylint_shape s;
    cylint_closest a;
    cylint_capsule(&s, origin, top, 1, CYLINT_ENDS_CAPPED);
    CHECK(cylint_distance(&s, at_base, WANT, &a) == 2);
    CHECK(a.part == CYLINT_PART_LATERAL && a.feature == CYLINT_FEATURE_RIM0);
    CHECK(cylint_distance(&s, at_top, WANT, &a) == 2);
    CHECK(a.part == CYLINT_PART_LATERAL && a.feature == CYLINT_FEATURE_RIM1);
    cylint_distance(&s, beyond, WANT, &a);
    CHECK(a.part == CYLINT_PART_CAP1 && a.feature == CYLINT_FEATURE_CAP1);
    cylint_distance(&s, before, WANT, &a);
    CHECK(a.part == CYLINT_PART_CAP0 && a.feature == CYLINT_FEATURE_CAP0);
}

/* The middle of the largest double and 2^1024. */
static void a_distance_is_rounded_to_infinity_from_its_middle_on(void)
{
    static const double most = 0x1.fffffffffffffp1023, half_ulp = 0x1p970;
    const double point[3] = {most, 0, 0};
    double center[3] = {-half_ulp, 0, 0};
    cylint_shape s;
    cylint_closest a;
    cylint_sphere(&s, center, 0x1p-1074, CYLINT_ENDS_CAPPED);
    CHECK(cylint_distance(&s, point, 0, &a) == most);
    center[0] = -half_ulp * (1 + 0x1p-52);
    cylint_sphere(&s, center, 0x1p-1074, CYLINT_ENDS_CAPPED);
    CHECK(cylint_distance(&s, point, 0, &a) == HUGE_VAL && a.flags == 0);
}

/* --------------------------------------------------------- properties -- */

typedef void property(const struct family_case *c, const double p[3]);

static void report(const struct family_case *c, const double p[3])
{
    REPORT_CASE(c);
    REPORT("point %a %a %a", p[0], p[1], p[2]);
}

static void over_families(property *check)
{
    const uint64_t cases = check_setting("CYLINT_CASES", CASES);
    const uint64_t seed = check_setting("CYLINT_SEED", 5);
    for (int f = 0; f < family_count(); f++)
        for (uint64_t i = 0; i < (family_is_wild(f) ? cases / 10 : cases);
             i++) {
            struct family_case c;
            family_case(seed, f, i, &c);
            uint64_t stream = seed + i * 64 + (uint64_t)f;
            for (int k = 0; k < POINTS; k++) {
                double p[3];
                draw_point(&c, &stream, p);
                if (!cylint_is_elliptic(c.shape.kind) && isfinite(p[0]) &&
                    isfinite(p[1]) && isfinite(p[2]))
                    check(&c, p);
            }
        }
}

/* The same for cases of any exponents. */
static void over_exponents(property *check, int elliptic)
{
    const uint64_t cases = check_setting("CYLINT_FAR", FAR_CASES);
    uint64_t stream = check_setting("CYLINT_SEED", 5);
    for (uint64_t i = 0; i < cases; i++) {
        struct family_case c;
        double p[3];
        if (draw_far_case(&c, &stream, p) &&
            cylint_is_elliptic(c.shape.kind) == elliptic)
            check(&c, p);
    }
}

/* All bits.  Members that were not written are equal because both answers were
 * cleared before. */
static int same(const cylint_closest *x, const cylint_closest *y)
{
    return memcmp(x, y, sizeof *x) == 0;
}

static void check_sign(const struct family_case *c, const double p[3])
{
    const cylint_shape *s = &c->shape;
    const cylint_closest a = answer_to(s, p, 0);
    const int within = cylint_contains(s, p);
    const int closed =
        !cylint_ends_are_planes(s->ends) || s->ends == CYLINT_ENDS_CAPPED;
    if (a.part == -1)
        return;
    if (!CHECK(closed ? cylint_sign(a.distance) == -within
                      : cylint_sign(a.distance) >= 0))
        report(c, p);
}

static void the_sign_is_that_of_contains(void)
{
    over_families(check_sign);
    over_exponents(check_sign, 0);
    over_exponents(check_sign, 1);
}

/* CYLINT_SIGNED: the shape of the same arguments with both caps. */
static void check_signed(const struct family_case *c, const double p[3])
{
    struct family_case closed = *c;
    if (cylint_ends_are_planes(c->ends))
        closed.ends = CYLINT_ENDS_CAPPED;
    family_make(&closed);
    const cylint_closest a = answer_to(&c->shape, p, WANT | CYLINT_SIGNED);
    const cylint_closest b = answer_to(&closed.shape, p, WANT);
    if (!CHECK(same(&a, &b)))
        report(c, p);
}

static void signed_distances_are_those_of_the_closed_solid(void)
{
    over_families(check_signed);
    over_exponents(check_signed, 0);
    over_exponents(check_signed, 1);
}

/* The members of `want` that pairs leave, and the distance; all are certain where
 * this is 0. */
static unsigned left_by_pairs(const cylint_shape *s, const double p[3],
                              unsigned want, cylint_closest *answer)
{
    return cylint_one_distances_plain.pairs(
        s, p, CYLINT_NO_FEATURE, want | CYLINT_WANT_DISTANCE, answer);
}

/* The distance does not need the direction from the axis to the point. */
static void pairs_decide_the_distance_from_points_on_the_axis(void)
{
    static const double tilted_base[3] = {1, 2, 3}, tilted_top[3] = {4, 6, 4},
                        middle[3] = {2.5, 4, 3.5};
    const cylint_shape upright[] = {cylinder(CYLINT_ENDS_CAPPED),
                                    cone(CYLINT_ENDS_CAPPED),
                                    round_cone(CYLINT_ENDS_CAPPED)};
    cylint_closest answer;
    cylint_shape tilted;
    for (int i = 0; i < 3; i++) {
        const double inside[3] = {0, 0, 0.7}, beyond[3] = {0, 0, -0.3};
        CHECK(!left_by_pairs(&upright[i], inside, 0, &answer));
        CHECK(!left_by_pairs(&upright[i], beyond, 0, &answer));
    }
    cylint_cylinder(&tilted, tilted_base, tilted_top, 0.1, CYLINT_ENDS_CAPPED);
    CHECK(!left_by_pairs(&tilted, middle, 0, &answer));
    CHECK(answer.distance == -0.1);
}

/* The answers of pairs, of both builds, and the exact ones. */
static void check_paths(const struct family_case *c, const double p[3])
{
    cylint_shape unprepared = c->shape;
    unprepared.library.flag[CYLINT_AT_PREPARED] = 0;
    unprepared.library.flag[CYLINT_AT_IN_RANGE] = 0;
    for (unsigned w = 0; w < 2; w++) {
        const unsigned want = w ? WANT : CYLINT_WANT_PART;
        const cylint_closest exact = answer_to(&unprepared, p, want);
        const cylint_closest usual = answer_to(&c->shape, p, want);
        cylint_closest plain;
        memset(&plain, 0, sizeof plain);
        const int certain = cylint_prepared(&c->shape) &&
                            !left_by_pairs(&c->shape, p, want, &plain);
        if (!CHECK(same(&exact, &usual) && (!certain || same(&exact, &plain))))
            report(c, p);
    }
    const cylint_closest all = answer_to(&c->shape, p, WANT);
    const cylint_closest alone = answer_to(&c->shape, p, 0);
    CHECK(all.distance == alone.distance);
    const cylint_closest parted = answer_to(&c->shape, p, CYLINT_WANT_PART);
    cylint_use_kernels("plain");
    const cylint_closest plain_alone = answer_to(&c->shape, p, 0);
    const cylint_closest plain = answer_to(&c->shape, p, CYLINT_WANT_PART);
    cylint_use_kernels(NULL);
    if (!CHECK(same(&alone, &plain_alone) && same(&parted, &plain)))
        report(c, p);
}

static void all_paths_return_the_same_bits(void)
{
    over_families(check_paths);
    over_exponents(check_paths, 0);
}

static double length_of(const double v[3])
{
    return hypot(hypot(v[0], v[1]), v[2]);
}

/* A triangle of 3, 4 and 5: the foot of a point on the lateral line is nearly
 * an end of it, within 1e-9, where no other feature is near. */
static void a_foot_at_an_end_is_decided_by_all_digits(void)
{
    const double low[3] = {3, -2, -2}, high[3] = {3, -2, 2};
    cylint_shape shapes[2];
    cylint_cone(&shapes[0], low, 0, high, 3, CYLINT_ENDS_CAPPED);
    cylint_round_cone(&shapes[1], low, 1, high, 3, CYLINT_ENDS_CAPPED);
    for (int k = 0; k < 2; k++) {
        cylint_shape unprepared = shapes[k];
        unprepared.library.flag[CYLINT_AT_PREPARED] = 0;
        for (int i = -64; i <= 64; i++) {
            const double p[3] = {6 + ldexp(i, -33), 2, 0.5 - ldexp(i, -35)};
            for (unsigned w = 0; w < 3; w++) {
                const unsigned want = w == 0   ? 0
                                      : w == 1 ? CYLINT_WANT_PART
                                               : WANT;
                const cylint_closest exact = answer_to(&unprepared, p, want);
                const cylint_closest usual = answer_to(&shapes[k], p, want);
                CHECK(same(&exact, &usual));
            }
        }
    }
}

/* A disc of height 2^-52 and radii 2^33 and 2^43 without its base: the centre of
 * the base is on the boundary of the solid, but not on the surface. */
static void what_is_missing_is_not_the_surface(void)
{
    const double low[3] = {0, 0, 0}, high[3] = {0, 0, 0x1p-52};
    cylint_shape s;
    cylint_cone(&s, low, 0x1p33, high, 0x1p43, CYLINT_ENDS_CAP1);
    CHECK(cylint_contains(&s, low) == 0);
    CHECK(answer_to(&s, low, 0).distance == 0x1p-52);
    CHECK(answer_to(&s, low, WANT).distance == 0x1p-52);
}

/* A point 2^-9 beyond the end of a capsule of length 2^56, on its axis: doubles do
 * not decide whether it is beyond. */
static void an_end_is_found_beside_a_long_axis(void)
{
    const double low[3] = {-0x1.f65962a4afaf4p-193, 0x1.9318e631248ap-29,
                           0x1.470ad53e8c98p+56};
    const double high[3] = {-0x1.44484d579a2ap-190, -0x1.5112ac9ed24ap-197,
                            -0x1.a072640f126f8p-202};
    const double p[3] = {0x1.311a343af89c8p-144, 0x1.9318e631248ap-29,
                         -0x1.7ba574cb8ba4p-9};
    cylint_shape s;
    cylint_capsule(&s, low, high, 0x1.872db365260aap+44, CYLINT_ENDS_CAPPED);
    CHECK(answer_to(&s, p, 0).distance == -0x1.872db365260a9p+44);
    cylint_use_kernels("plain");
    CHECK(answer_to(&s, p, 0).distance == -0x1.872db365260a9p+44);
    cylint_use_kernels(NULL);
}

/* The size that the manual relates the error of the safety to. */
static double safety_size(const cylint_shape *s, const double p[3],
                          double distance)
{
    const double length = length_of(cylint_axis(s));
    const double reach = s->kind == CYLINT_KIND_SPHERE
                             ? cylint_r0(s)
                             : length + fmax(cylint_r0(s), cylint_r1(s)) *
                                            cylint_radius_unit(s, length);
    double D[3];
    for (int i = 0; i < 3; i++)
        D[i] = p[i] - cylint_base(s)[i];
    return reach +
           (s->ends == CYLINT_ENDS_INFINITE ? 1.42 * length_of(D) : distance);
}

static double largest_gap;

/* How far the safety is below the distance, in 2^-52 sizes; 0 if it is the double
 * below. */
static double gap_of(const cylint_shape *s, const double p[3], double distance,
                     double safe)
{
    return safe >= nextafter(distance, 0)
               ? 0
               : (distance - safe) / safety_size(s, p, distance) * 0x1p52;
}

/* What must be the same in every environment. */
struct answers {
    cylint_closest one;
    double distance; /* of a batch */
    signed char part;
    int contains, on_surface;
    size_t closest;
};

static double ulps_of_questions;

/* A question is computed in each environment whose turn is a multiple of this. */
static int every_environment, turn_of_environment;

static void answer_all(const cylint_shape *s, const double p[3],
                       struct answers *to)
{
    const cylint_points points = {1, {&p[0], &p[1], &p[2]}};
    const cylint_closest_columns columns = {
        &to->distance, &to->part, NULL, {NULL}, {NULL}};
    cylint_closest unused;
    memset(to, 0, sizeof *to);
    to->one = answer_to(s, p, CYLINT_WANT_PART);
    cylint_distance_points(s, &points, &columns);
    to->contains = cylint_contains(s, p);
    to->on_surface = cylint_on_surface(s, p, ulps_of_questions);
    to->closest = cylint_closest_shape(s, 1, p, to->distance, 0, &unused);
}

static void check_environments(const struct family_case *c, const double p[3])
{
    struct answers want, got;
    answer_all(&c->shape, p, &want);
    const double far = fabs(want.one.distance);
    for (int i = 0; i < ENVIRONMENTS; i++) {
        const struct environment there = environment_of(i);
        if (!can_treat_subnormals(there.tiny) ||
            turn_of_environment++ % every_environment != 0)
            continue;
        environment_set(there);
        answer_all(&c->shape, p, &got);
        const double safe = cylint_safety(&c->shape, p);
        const cylint_closest all = answer_to(&c->shape, p, WANT);
        environment_reset();
        if (!CHECK(memcmp(&got, &want, sizeof got) == 0 && safe >= 0 &&
                   !signbit(safe) && safe <= far && !has_negative_zero(&all) &&
                   (far < 2 * DBL_MIN || /* may be flushed to 0 */
                    gap_of(&c->shape, p, far, safe) <= 32))) {
            report(c, p);
            REPORT("environment %d: distance %a and %a, safety %a", i, far,
                   got.one.distance, safe);
        }
    }
}

static void the_floating_point_environment_changes_nothing(void)
{
    ulps_of_questions = 3;
    every_environment = 1;
    over_families(check_environments);
    ulps_of_questions = 0x1p40;
    every_environment = 5;
    over_exponents(check_environments, 0);
}

static void check_safe(const struct family_case *c, const double p[3])
{
    const double distance = fabs(answer_to(&c->shape, p, 0).distance);
    const double safe = cylint_safety(&c->shape, p);
    if (!CHECK(safe >= 0 && safe <= distance))
        report(c, p);
}

static void safety_is_never_above_the_distance(void)
{
    over_families(check_safe);
    over_exponents(check_safe, 0);
}

static void check_gap(const struct family_case *c, const double p[3])
{
    const double distance = fabs(answer_to(&c->shape, p, 0).distance);
    const double gap =
        gap_of(&c->shape, p, distance, cylint_safety(&c->shape, p));
    largest_gap = fmax(largest_gap, gap);
    if (!CHECK(gap <= 16))
        report(c, p);
}

static void safety_is_little_below_the_distance(void)
{
    over_families(check_gap);
    over_exponents(check_gap, 0);
    printf("note: the safety is up to %.3g x 2^-52 sizes below the distance\n",
           largest_gap);
}

/* Scaling by a power of two scales the distance. */
static void check_scaled(const struct family_case *c, const double p[3])
{
    struct family_case far = *c;
    const int n = family_shape_size(c->shape_word);
    const double e = 0x1p40;
    double q[3];
    if (!cylint_in_range(&c->shape) || c->shape_word == FAMILY_ACONE)
        return;
    for (int i = 0; i < n; i++)
        far.shape_data[i] *= e;
    family_make(&far);
    for (int i = 0; i < 3; i++)
        q[i] = p[i] * e;
    const cylint_closest a = answer_to(&c->shape, p, CYLINT_WANT_PART);
    const cylint_closest b = answer_to(&far.shape, q, CYLINT_WANT_PART);
    if (!cylint_in_range(&far.shape) || fabs(a.distance) < 0x1p-900 ||
        fabs(a.distance) > 0x1p900)
        return;
    if (!CHECK(a.distance * e == b.distance && a.part == b.part &&
               a.feature == b.feature))
        report(c, p);
}

static void a_power_of_two_scales_the_distance(void)
{
    over_families(check_scaled);
}

int main(void)
{
    RUN(the_size_of_an_answer_is_that_of_the_header);
    RUN(answers_about_a_capped_cylinder_are_known);
    RUN(answers_of_other_ends_are_known);
    RUN(answers_about_cones_are_known);
    RUN(the_normal_at_the_apex_of_a_double_cone_is_stated);
    RUN(answers_about_round_shapes_are_known);
    RUN(where_there_is_no_surface_the_distance_is_infinite);
    RUN(a_point_is_on_a_surface_exactly_or_within_ulps);
    RUN(the_distance_on_the_surface_has_no_sign);
    RUN(every_exponent_is_answered);
    RUN(circles_of_tangency_are_lateral);
    RUN(a_distance_is_rounded_to_infinity_from_its_middle_on);
    RUN(the_sign_is_that_of_contains);
    RUN(signed_distances_are_those_of_the_closed_solid);
    RUN(pairs_decide_the_distance_from_points_on_the_axis);
    RUN(all_paths_return_the_same_bits);
    RUN(a_foot_at_an_end_is_decided_by_all_digits);
    RUN(what_is_missing_is_not_the_surface);
    RUN(an_end_is_found_beside_a_long_axis);
    RUN(the_floating_point_environment_changes_nothing);
    RUN(safety_is_never_above_the_distance);
    RUN(safety_is_little_below_the_distance);
    RUN(a_power_of_two_scales_the_distance);
    return check_end();
}
