/*
 * test_elliptic.c - floor distance: elliptic kinds
 *
 * No point of the surface may be nearer than the one that cylint_distance()
 * finds.  Answers known by hand are in known.txt, the oracle's tests in
 * test_oracle.c.  CYLINT_CASES is the number of shapes.
 */
#include <math.h>

#include "closest.h"
#include "elliptic_solids.h"

enum { CASES = 6000, POINTS = 4, ANGLES = 180 };

static const double origin[3] = {0, 0, 0};

/* The axis is x, the radius 1000: point and normal are multiples of (y, z). */
TEST(far_from_a_cylinder_point_and_normal_are_right)
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
                   are_within(got.point, on, 8, 0) &&
                   are_within(got.normal, n, 8, 0)))
            REPORT("2^%d: point %a %a %a", e, got.point[0], got.point[1],
                   got.point[2]);
    }
}

/* Oblique, sometimes thin or nearly flat; its sizes differ by 10^3 at most. */
static void draw_shape(struct solid *e)
{
    const double thin = power(-1.5, 0), flat = power(-1.5, 1);
    const double lean[2] = {between(-2, 2), between(-2, 2)};
    for (int i = 0; i < 3; i++) {
        e->c[i] = between(-1, 1);
        e->a[i] = between(-1, 1);
        e->b[i] = thin * between(-1, 1);
        e->h[i] = flat * between(-1, 1) + lean[0] * e->a[i] + lean[1] * e->b[i];
    }
    e->k = one_of(3) ? between(0, 2) : 1;
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

TEST(no_point_of_the_surface_is_nearer)
{
    const uint64_t cases = check_setting("CYLINT_CASES", CASES);
    long second = 0;
    for (uint64_t n = 0; n < cases; n++) {
        struct solid e;
        cylint_shape s;
        draw_shape(&e);
        const int bounded = one_of(3) != 0;
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
                report_solid(&e, (cylint_ends)s.ends, X);
                REPORT("%g, nearer: %g", size, sqrt(least));
            }
        }
    }
    printf("note: of %ld points, %ld have several local minima\n",
           (long)cases * POINTS, second);
    CHECK(second > (long)cases / 4);
}
