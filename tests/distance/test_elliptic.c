/*
 * test_elliptic.c - floor distance: elliptic kinds
 *
 * Answers known by hand, and the nearest of many points of the surface: no point
 * of it may be nearer than the one that cylint_distance() finds.  The oracle's
 * tests are in test_oracle.c.  CYLINT_CASES is the number of shapes.
 */
#include <float.h>
#include <math.h>
#include <string.h>

#include "elliptic_solids.h"
#include "known_distances.h"

enum { CASES = 6000, POINTS = 4, ANGLES = 180 };

static const double origin[3] = {0, 0, 0};

/* x^2 / 4 + y^2 = 1 from z = 0 to z = 4. */
static cylint_shape tube(cylint_ends ends)
{
    static const double a[3] = {2, 0, 0}, b[3] = {0, 1, 0}, h[3] = {0, 0, 4};
    cylint_shape s;
    cylint_elliptic_cylinder(&s, origin, a, b, h, ends);
    return s;
}

/* A circular cone of radius 3 and height 4. */
static cylint_shape cone(cylint_ends ends)
{
    static const double a[3] = {3, 0, 0}, b[3] = {0, 3, 0}, h[3] = {0, 0, 4};
    cylint_shape s;
    cylint_elliptic_cone(&s, origin, a, b, h, 0, ends);
    return s;
}

#define CHECK_KNOWN(shape, known)                                            \
    check_known(#known, shape, known, (int)(sizeof known / sizeof known[0]), \
                1, 4)

/* The middle has two nearest points, y = 1 and y = -1: phi is 1/4 and 3/4. */
static void of_equal_points_the_first_is_taken(void)
{
    static const struct known capped[] = {
        {{0, 0, 2}, -1, 0, LATERAL, {0, 1, 2}, {0, 1, 0}},
        {{0, 0, 1}, -1, 0, LATERAL, {0, 1, 1}, {0, 1, 0}},
        {{0, 0, 3}, -1, 0, LATERAL, {0, 1, 3}, {0, 1, 0}},
    };
    static const struct known open[] = {
        {{0, 0, 2}, 1, 0, LATERAL, {0, 1, 2}, {0, 1, 0}},
        {{0, 0, 4}, 1, 0, RIM1, {0, 1, 4}, {0, 1, 0}},
        {{0, 0, 0}, 1, 0, RIM0, {0, 1, 0}, {0, 1, 0}},
    };
    static const struct known infinite[] = {
        {{0, 0, 100}, -1, 0, LATERAL, {0, 1, 100}, {0, 1, 0}},
    };
    CHECK_KNOWN(tube(CYLINT_ENDS_CAPPED), capped);
    CHECK_KNOWN(tube(CYLINT_ENDS_OPEN), open);
    CHECK_KNOWN(tube(CYLINT_ENDS_INFINITE), infinite);
    CHECK_KNOWN(tube(CYLINT_ENDS_NAPPE), infinite);
}

static void the_features_of_a_cylinder(void)
{
    static const struct known capped[] = {
        {{0.5, 0, 0.25}, -0.25, 1, CAP0, {0.5, 0, 0}, {0, 0, -1}},
        {{0.5, 0, 3.75}, -0.25, 2, CAP1, {0.5, 0, 4}, {0, 0, 1}},
        {{5, 0, 2}, 3, 0, LATERAL, {2, 0, 2}, {1, 0, 0}},
        {{0, -3, 1}, 2, 0, LATERAL, {0, -1, 1}, {0, -1, 0}},
        {{2, 0, 6}, 2, 0, RIM1, {2, 0, 4}, {1, 0, 0}},
        {{5, 0, -4}, 5, 0, RIM0, {2, 0, 0}, {1, 0, 0}},
        {{0, 0, 6}, 2, 2, CAP1, {0, 0, 4}, {0, 0, 1}},
        {{1, 0.5, -3}, 3, 1, CAP0, {1, 0.5, 0}, {0, 0, -1}},
    };
    CHECK_KNOWN(tube(CYLINT_ENDS_CAPPED), capped);
}

static void points_of_the_surface_have_the_distance_0(void)
{
    static const struct known capped[] = {
        {{2, 0, 2}, 0, 0, LATERAL, {2, 0, 2}, {1, 0, 0}},
        {{0, -1, 4}, 0, 0, RIM1, {0, -1, 4}, {0, -1, 0}},
        {{0, 1, 0}, 0, 0, RIM0, {0, 1, 0}, {0, 1, 0}},
        {{1, 0.5, 4}, 0, 2, CAP1, {1, 0.5, 4}, {0, 0, 1}},
        {{0, 0, 0}, 0, 1, CAP0, {0, 0, 0}, {0, 0, -1}},
    };
    static const struct known cap1[] = {
        {{0, 0, 4}, 0, 2, CAP1, {0, 0, 4}, {0, 0, 1}},
        {{0, 0, 0}, 1, 0, RIM0, {0, 1, 0}, {0, 1, 0}},
        {{0, 0, 3.5}, 0.5, 2, CAP1, {0, 0, 4}, {0, 0, 1}},
    };
    CHECK_KNOWN(tube(CYLINT_ENDS_CAPPED), capped);
    CHECK_KNOWN(tube(CYLINT_ENDS_CAP1), cap1);
}

static void the_features_of_a_cone(void)
{
    static const struct known capped[] = {
        {{0, 0, 3}, -0.6, 0, LATERAL, {0.48, 0, 3.36}, {0.8, 0, 0.6}},
        {{0, 0, 1}, -1, 1, CAP0, {0, 0, 0}, {0, 0, -1}},
        {{0, 0, 4}, 0, 0, APEX, {0, 0, 4}, {0, 0, 1}},
        {{0, 0, 5}, 1, 0, APEX, {0, 0, 4}, {0, 0, 1}},
        {{1.5, 0, 2}, 0, 0, LATERAL, {1.5, 0, 2}, {0.8, 0, 0.6}},
        {{7, 0, -3}, 5, 0, RIM0, {3, 0, 0}, {0.8, 0, 0.6}},
    };
    static const struct known nappe[] = {
        {{0, 0, 6}, 2, 0, APEX, {0, 0, 4}, {0, 0, 1}},
        {{0, 0, -1}, -3, 0, LATERAL, {2.4, 0, 0.8}, {0.8, 0, 0.6}},
    };
    static const struct known both[] = {
        {{5, 0, 4}, 4, 0, LATERAL, {1.8, 0, 1.6}, {0.8, 0, 0.6}},
        {{0, 0, 4}, 0, 0, APEX, {0, 0, 4}, {0, 0, -1}},
        {{0, 0, 9}, -3, 0, LATERAL, {2.4, 0, 7.2}, {0.8, 0, -0.6}},
    };
    CHECK_KNOWN(cone(CYLINT_ENDS_CAPPED), capped);
    CHECK_KNOWN(cone(CYLINT_ENDS_NAPPE), nappe);
    CHECK_KNOWN(cone(CYLINT_ENDS_INFINITE), both);
}

/* A shape that is many exponents smaller than the distance. */
static void far_away_the_distance_is_that_of_the_base(void)
{
    const double a[3] = {2e-300, 0, 0}, b[3] = {0, 1e-300, 0};
    const double h[3] = {0, 0, 4e-300};
    const double p[3] = {3, 0, 4}, q[3] = {3, 4, 0};
    cylint_shape s;
    cylint_closest got;
    cylint_elliptic_cylinder(&s, origin, a, b, h, CYLINT_ENDS_CAPPED);
    CHECK(cylint_distance(&s, p, WANT, &got) == 5);
    CHECK(got.feature == RIM1 && got.point[0] == 2e-300 &&
          got.point[2] == 4e-300);
    CHECK(cylint_safety(&s, p) <= 5 && cylint_safety(&s, p) > 4.9);
    cylint_elliptic_cylinder(&s, origin, a, b, h, CYLINT_ENDS_INFINITE);
    CHECK(cylint_distance(&s, q, WANT, &got) == 5);
    CHECK(got.feature == LATERAL && got.normal[0] == 0.6 &&
          got.normal[1] == 0.8);
}

/* The axis is x, the radius 1000: point and normal are multiples of (y, z). */
static void far_from_a_cylinder_point_and_normal_are_right(void)
{
    static const double a[3] = {0, -1000, 0}, b[3] = {0, 0, 1000},
                        h[3] = {-2, 0, 0};
    for (int e = 0; e < 1020; e++) {
        const double p[3] = {ldexp(-1.01, e), ldexp(-4.8, e), ldexp(0.325, e)},
                     size = hypot(-4.8, 0.325);
        const double n[3] = {0, -4.8 / size, 0.325 / size},
                     on[3] = {p[0], 1000 * n[1], 1000 * n[2]};
        cylint_shape s;
        cylint_closest got;
        cylint_elliptic_cone(&s, origin, a, b, h, 1, CYLINT_ENDS_INFINITE);
        const int inside = cylint_distance(&s, p, WANT, &got) < 0;
        if (!CHECK(inside == (size * ldexp(1, e) < 1000) &&
                   are_within(got.point, on, 8) &&
                   are_within(got.normal, n, 8)))
            REPORT("2^%d: point %a %a %a", e, got.point[0], got.point[1],
                   got.point[2]);
    }
}

/* The point minus the base is longer than the largest double, along the axis. */
static void differences_that_overflow_are_answered(void)
{
    static const double base[3] = {-0x1.8p1023, 0, 0}, a[3] = {0, 2, 0},
                        b[3] = {0, 0, 1}, h[3] = {4, 0, 0};
    static const struct known infinite[] = {
        {{0x1.8p1023, 3, 0}, 1, 0, LATERAL, {0x1.8p1023, 2, 0}, {0, 1, 0}},
        {{0x1.8p1023, 0, 4}, 3, 0, LATERAL, {0x1.8p1023, 0, 1}, {0, 0, 1}},
    };
    cylint_shape s;
    cylint_closest got;
    cylint_elliptic_cylinder(&s, base, a, b, h, CYLINT_ENDS_INFINITE);
    CHECK_KNOWN(s, infinite);
    cylint_elliptic_cylinder(&s, base, a, b, h, CYLINT_ENDS_CAPPED);
    CHECK(cylint_distance(&s, infinite[0].p, WANT, &got) == HUGE_VAL);
    CHECK(got.feature == RIM1 && got.point[1] == 2);
}

/* The sign is exact: a distance that is not 0 is not rounded to it. */
static void only_points_of_the_surface_have_the_distance_0(void)
{
    const double a[3] = {0x3p-1074, 0, 0}, b[3] = {0, 0x3p-1074, 0};
    const double h[3] = {0, 0, 0x9p-1074};
    const double p[3] = {0x2p-1074, 0x2p-1074, 0x4p-1074};
    cylint_shape s;
    cylint_closest got;
    cylint_elliptic_cylinder(&s, origin, a, b, h, CYLINT_ENDS_CAPPED);
    CHECK(cylint_contains(&s, p) == 1);
    CHECK(cylint_distance(&s, p, WANT, &got) == -0x1p-1074);
    CHECK(cylint_safety(&s, p) == 0 && !signbit(cylint_safety(&s, p)));
}

/* Products of such numbers underflow: the distance is inaccurate, but a number,
 * and its sign is right. */
static void wild_exponents_give_numbers(void)
{
    static const struct {
        double c[3], a[3], b[3], h[3], k;
        int ends;
        double p[3];
    } wild[] = {
        {{0x1p57, -0x1p-544, -0x1p-549},
         {-0x1p-369, 0x1p-183, 0},
         {-0x1p-262, -0x1p-679, 0x1p11},
         {0, 0, 0xd8p-1074},
         1,
         CYLINT_ENDS_INFINITE,
         {-0x1p-849, 0x1p-828, 0x1p-909}},
        {{-0x1p-905, 0x1p-221, 0x1p-110},
         {0x1f75aecp-1050, 0, 0},
         {0, 0x1.1370888bp+36, 0},
         {0, 0, 0x1.afd0ba678p-678},
         1,
         CYLINT_ENDS_CAPPED,
         {-0x1p-905, 0x1p-221, 0x1p-110}},
        {{0x1p-1017, -0x1p-853, 0},
         {0, 0, 0x9p-1074},
         {0x1.bad367a8p-865, 0, 0},
         {0, 0x1.57cf54a6p-59, 0},
         0x1.55cfb3cbp-886,
         CYLINT_ENDS_CAP1,
         {0x1p-194, 0x1p-277, -0x1p-764}},
        {{0, 0, 0},
         {0, 0, 0x1p-1074},
         {0x1p-1074, 0, 0},
         {0, 0x1p1000, 0},
         1,
         CYLINT_ENDS_INFINITE,
         {0, 0x1p10, 0x3p-1074}},
        {{-3, 3, 1}, /* a rim is nearest to this point inside, but for 2e-323 */
         {2, -1, -2},
         {2, -3, 0},
         {0, 0, 4},
         1,
         CYLINT_ENDS_CAPPED,
         {-1, 0x4p-1074, 1}},
    };
    for (size_t i = 0; i < sizeof wild / sizeof wild[0]; i++) {
        cylint_shape s;
        cylint_closest got;
        CHECK(cylint_elliptic_cone(&s, wild[i].c, wild[i].a, wild[i].b,
                                   wild[i].h, wild[i].k,
                                   (cylint_ends)wild[i].ends) == CYLINT_OK);
        const double d = cylint_distance(&s, wild[i].p, WANT, &got);
        const double safe = cylint_safety(&s, wild[i].p);
        const double *n = got.normal;
        const int side = cylint_contains(&s, wild[i].p);
        if (!CHECK(isfinite(d) && got.part >= 0 &&
                   fabs(n[0] * n[0] + n[1] * n[1] + n[2] * n[2] - 1) < 1e-9 &&
                   safe >= 0 && safe <= fabs(d)))
            REPORT("case %d: %g part %d normal %g %g %g safety %g", (int)i, d,
                   got.part, n[0], n[1], n[2], safe);
        if (wild[i].ends != CYLINT_ENDS_CAP1)
            CHECK((d > 0) == (side < 0) && (d < 0) == (side > 0));
    }
}

/* The point is inside; the rim x = 1, y = 0, z = 1 is 2^-1073 away.  In triples
 * the foot on cap 1 is on its rim, and that on the lateral surface at its end. */
static void next_to_a_rim_the_distance_is_small_inside(void)
{
    const double c[3] = {-2, -3, 0}, a[3] = {1, -2, 3}, b[3] = {2, 2, 1};
    const double h[3] = {-3, 1, -3}, p[3] = {-4, -4, -0x2p-1074};
    cylint_shape s;
    cylint_closest got;
    cylint_elliptic_cylinder(&s, c, a, b, h, CYLINT_ENDS_CAPPED);
    CHECK(cylint_contains(&s, p) == 1);
    const double d = cylint_distance(&s, p, WANT, &got);
    CHECK(d < 0 && d > -0x1p-100);
    CHECK(cylint_safety(&s, p) <= 0x1p-1073);
}

/* The same next to an apex at (0, 0, 4) and, of a double cone, at the origin. */
static void next_to_an_apex_the_distance_is_small_inside(void)
{
    const double a[3] = {3, 0, 0}, b[3] = {0, 2, 0}, h[3] = {1, 0, 4};
    const double at[3] = {0, 0, -4}, p[3] = {1, 0, -0x1p-1074};
    const double apart[3] = {-1, 0, -4}, q[3] = {0, 0, 0x1p-1074};
    cylint_shape s;
    cylint_closest got;
    cylint_elliptic_cone(&s, at, a, b, h, 0, CYLINT_ENDS_CAPPED);
    CHECK(cylint_contains(&s, p) == 1);
    const double d = cylint_distance(&s, p, WANT, &got);
    CHECK(d < 0 && d > -0x1p-100);
    cylint_elliptic_cone(&s, apart, a, b, h, 0, CYLINT_ENDS_INFINITE);
    CHECK(cylint_contains(&s, q) == 1);
    const double e = cylint_distance(&s, q, WANT, &got);
    CHECK(e < 0 && e > -0x1p-100);
}

/* Three stationary points are within 2e-6 of a sharp edge: in doubles their
 * form is below its rounding between them. */
static void zeros_that_doubles_hide_are_found(void)
{
    const double c[3] = {-3, 2, 0}, a[3] = {0, 0x1.757d59c683d18p-8, 0};
    const double b[3] = {0, 0, 0x1.664eca316e98dp+18};
    const double h[3] = {0x1.cef5f446e44ecp+10, 0, 0};
    const double p[3] = {0x1.ce354ee427eecp+10, 2, 2};
    cylint_shape s;
    cylint_closest got;
    cylint_elliptic_cone(&s, c, a, b, h, 0, CYLINT_ENDS_CAPPED);
    const double d = cylint_distance(&s, p, WANT, &got);
    if (!CHECK(fabs(d + 1.1125814148285373e-13) < 1e-28))
        REPORT("%.17g", d);
}

/* The zero in doubles is 1e-6 away, where the foot would be below the base by
 * 2e-11; it is above it by 1.5e-21. */
static void a_foot_next_to_an_end_is_placed_exactly(void)
{
    const double c[3] = {3, -2, -3}, a[3] = {2, -3, -1}, b[3] = {-3, -1, 3};
    const double h[3] = {0x1.ccbb84861f2d2p+16, -0x1.598ca3649761ep+17,
                         -0x1.ccb784861f2d2p+15};
    const double p[3] = {0, -3, 0x1.cbd7c9aa82f25p-69};
    cylint_shape s;
    cylint_closest got;
    cylint_elliptic_cylinder(&s, c, a, b, h, CYLINT_ENDS_CAPPED);
    const double d = cylint_distance(&s, p, WANT, &got);
    if (!CHECK(d > 0 && d < 1e-30 && got.feature == LATERAL))
        REPORT("%.17g", d);
}

/* ------------------------------------- the nearest of many points ------- */

/* Oblique, sometimes thin or nearly flat; its sizes differ by 10^3 at most. */
static void draw_shape(struct solid *e)
{
    const double thin = pow(10, between(-1.5, 0)),
                 flat = pow(10, between(-1.5, 1));
    const double lean[2] = {between(-2, 2), between(-2, 2)};
    for (int i = 0; i < 3; i++) {
        e->c[i] = between(-1, 1);
        e->a[i] = between(-1, 1);
        e->b[i] = thin * between(-1, 1);
        e->h[i] = flat * between(-1, 1) + lean[0] * e->a[i] + lean[1] * e->b[i];
    }
    e->k = random_int(&solid_stream, 3) ? between(0, 2) : 1;
}

/* The square of the distance of X from the segment on the ruling of an
 * angle. */
static double from_segment(const struct solid *e, const double X[3],
                           double angle, int bounded)
{
    double E[3], v[3], Ev = 0, vv = 0, sum = 0;
    for (int i = 0; i < 3; i++) {
        const double u = cos(angle) * e->a[i] + sin(angle) * e->b[i];
        E[i] = X[i] - e->c[i] - u;
        v[i] = e->h[i] + (e->k - 1) * u;
        Ev += E[i] * v[i];
        vv += v[i] * v[i];
    }
    const double z = bounded ? fmin(fmax(Ev / vv, 0), 1) : Ev / vv;
    for (int i = 0; i < 3; i++)
        sum += (E[i] - z * v[i]) * (E[i] - z * v[i]);
    return sum;
}

static void no_point_of_the_surface_is_nearer(void)
{
    const uint64_t cases = check_setting("CYLINT_CASES", CASES);
    long second = 0;
    for (uint64_t n = 0; n < cases; n++) {
        struct solid e;
        cylint_shape s;
        draw_shape(&e);
        const int bounded = random_int(&solid_stream, 3) != 0;
        if (!make_solid(&s, &e,
                        bounded ? CYLINT_ENDS_OPEN : CYLINT_ENDS_INFINITE))
            continue;
        for (int k = 0; k < POINTS; k++) {
            double X[3], d[ANGLES], least = HUGE_VAL;
            int minima = 0;
            cylint_closest got;
            place_in_solid(&e, between(-1.2, 1.2), between(-1.2, 1.2),
                           between(-0.2, 1.2), X);
            for (int i = 0; i < ANGLES; i++) {
                d[i] = from_segment(&e, X, 6.283185307179586 * i / ANGLES,
                                    bounded);
                least = fmin(least, d[i]);
            }
            for (int i = 0; i < ANGLES; i++)
                minima += d[i] < d[(i + 1) % ANGLES] &&
                          d[i] < d[(i + ANGLES - 1) % ANGLES];
            second += minima > 1;
            const double size = fabs(cylint_distance(&s, X, WANT, &got));
            if (!CHECK(size <= sqrt(least) * (1 + 0x1p-30) + 0x1p-40)) {
                report_solid(&e, s.ends, X);
                REPORT("%g, nearer: %g", size, sqrt(least));
            }
        }
    }
    printf("note: of %ld points, %ld have several local minima\n",
           (long)cases * POINTS, second);
    CHECK(second > (long)cases / 4);
}

int main(void)
{
    RUN(of_equal_points_the_first_is_taken);
    RUN(the_features_of_a_cylinder);
    RUN(points_of_the_surface_have_the_distance_0);
    RUN(the_features_of_a_cone);
    RUN(far_away_the_distance_is_that_of_the_base);
    RUN(far_from_a_cylinder_point_and_normal_are_right);
    RUN(differences_that_overflow_are_answered);
    RUN(only_points_of_the_surface_have_the_distance_0);
    RUN(wild_exponents_give_numbers);
    RUN(next_to_a_rim_the_distance_is_small_inside);
    RUN(next_to_an_apex_the_distance_is_small_inside);
    RUN(a_foot_next_to_an_end_is_placed_exactly);
    RUN(zeros_that_doubles_hide_are_found);
    RUN(no_point_of_the_surface_is_nearer);
    return check_end();
}
