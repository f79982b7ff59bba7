/*
 * test_round_constructors.c - floor shape: constructors of spheres, capsules
 * and rounded cones
 */
#include <float.h>
#include <math.h>
#include <string.h>

#include "check.h"
#include "cylint.h"
#include "random.h"
#ifdef HAVE_MPFR
#include "oracle.h"
#include "shapes/layout.h"
#endif

static const double zero[3] = {0, 0, 0}, up[3] = {0, 0, 2};

static void good_arguments_are_accepted(void)
{
    for (int ends = CYLINT_ENDS_CAPPED; ends <= CYLINT_ENDS_NAPPE + 1; ends++) {
        const cylint_ends e = (cylint_ends)ends;
        const cylint_status hull =
            ends <= CYLINT_ENDS_CAP1 ? CYLINT_OK : CYLINT_EENDS;
        cylint_shape s;
        CHECK(cylint_sphere(&s, up, 1, e) ==
              (ends == CYLINT_ENDS_CAPPED ? CYLINT_OK : CYLINT_EENDS));
        CHECK(s.kind == (ends == CYLINT_ENDS_CAPPED ? CYLINT_KIND_SPHERE
                                                    : CYLINT_KIND_NONE));
        CHECK(cylint_capsule(&s, zero, up, 1, e) == hull);
        CHECK(s.kind == (hull ? CYLINT_KIND_NONE : CYLINT_KIND_CAPSULE));
        CHECK(cylint_round_cone(&s, zero, 1, up, 0.5, e) == hull);
        CHECK(s.kind == (hull ? CYLINT_KIND_NONE : CYLINT_KIND_RCONE));
        CHECK(cylint_round_cone(&s, zero, 1, up, 1, e) == hull);
        CHECK(s.kind == (hull ? CYLINT_KIND_NONE : CYLINT_KIND_CAPSULE));
    }
}

static void wrong_numbers_are_refused(void)
{
    static const double bad[3] = {NAN, HUGE_VAL, -HUGE_VAL};
    cylint_shape s;
    for (int i = 0; i < 3; i++) {
        const double p[3] = {0, bad[i], 0};
        CHECK(cylint_sphere(&s, p, 1, CYLINT_ENDS_CAPPED) == CYLINT_ENONFINITE);
        CHECK(cylint_sphere(&s, up, bad[i], CYLINT_ENDS_CAPPED) ==
              CYLINT_ENONFINITE);
        CHECK(cylint_capsule(&s, p, up, 1, CYLINT_ENDS_CAPPED) ==
              CYLINT_ENONFINITE);
        CHECK(cylint_capsule(&s, up, p, 1, CYLINT_ENDS_CAPPED) ==
              CYLINT_ENONFINITE);
        CHECK(cylint_round_cone(&s, zero, bad[i], up, 1, CYLINT_ENDS_CAPPED) ==
              CYLINT_ENONFINITE);
        CHECK(cylint_round_cone(&s, zero, 1, up, bad[i], CYLINT_ENDS_CAPPED) ==
              CYLINT_ENONFINITE);
        CHECK(s.kind == CYLINT_KIND_NONE);
    }
    CHECK(cylint_sphere(&s, up, 0, CYLINT_ENDS_CAPPED) == CYLINT_ERADIUS);
    CHECK(cylint_sphere(&s, up, -1, CYLINT_ENDS_OPEN) == CYLINT_ERADIUS);
    CHECK(cylint_capsule(&s, zero, up, 0, CYLINT_ENDS_OPEN) == CYLINT_ERADIUS);
    CHECK(cylint_round_cone(&s, zero, 0, up, 0, CYLINT_ENDS_OPEN) ==
          CYLINT_ERADIUS);
    CHECK(cylint_round_cone(&s, zero, 1, up, -5e-324, CYLINT_ENDS_OPEN) ==
          CYLINT_ERADIUS);
    CHECK(cylint_round_cone(&s, zero, 0, up, 5e-324, CYLINT_ENDS_OPEN) ==
          CYLINT_OK);
}

static int is_ball(const cylint_shape *s, const double c[3], double r, int part)
{
    return s->kind == CYLINT_KIND_SPHERE && cylint_r0(s) == r &&
           cylint_surface(s) == part &&
           memcmp(cylint_base(s), c, 3 * sizeof(double)) == 0;
}

static void the_ball_that_holds_the_other_is_the_shape(void)
{
    cylint_shape s;
    CHECK(cylint_round_cone(&s, zero, 3, up, 1, CYLINT_ENDS_OPEN) == CYLINT_OK);
    CHECK(is_ball(&s, zero, 3, CYLINT_PART_CAP0));
    CHECK(cylint_round_cone(&s, zero, 1, up, 3, CYLINT_ENDS_CAP0) == CYLINT_OK);
    CHECK(is_ball(&s, up, 3, CYLINT_PART_CAP1));
    CHECK(cylint_round_cone(&s, zero, nextafter(3, 0), up, 1,
                            CYLINT_ENDS_CAPPED) == CYLINT_OK);
    CHECK(s.kind == CYLINT_KIND_RCONE);
    CHECK(cylint_capsule(&s, up, up, 1, CYLINT_ENDS_CAPPED) == CYLINT_OK);
    CHECK(is_ball(&s, up, 1, CYLINT_PART_CAP0));
    CHECK(cylint_round_cone(&s, zero, 0, zero, 1, CYLINT_ENDS_CAPPED) ==
          CYLINT_OK);
    CHECK(is_ball(&s, zero, 1, CYLINT_PART_CAP1));
    CHECK(cylint_sphere(&s, up, 2, CYLINT_ENDS_CAPPED) == CYLINT_OK);
    CHECK(is_ball(&s, up, 2, CYLINT_PART_LATERAL));
}

/* z and phi of a hit are those of the axis from p0 to p1, also where only the
 * ball about p1 is left.  Without axis they are 0. */
static void z_and_phi_of_a_ball_are_those_of_the_axis(void)
{
    const double o[3] = {0, 0, -9}, y[3] = {0, 1, -9}, d[3] = {0, 0, 1};
    cylint_shape s;
    cylint_line line;
    cylint_answer a;
    cylint_whole_line(&line, o, d);
    cylint_round_cone(&s, zero, 1, up, 3, CYLINT_ENDS_CAPPED);
    CHECK(cylint_intersect(&s, &line, CYLINT_WANT_ALL, &a) == 2);
    CHECK(a.hit[0].t == 8 && a.hit[0].z == -0.5 && a.hit[0].phi == 0);
    CHECK(a.hit[1].t == 14 && a.hit[1].z == 2.5);
    CHECK(a.hit[0].part == CYLINT_PART_CAP1 && a.hit[1].normal[2] == 1);
    cylint_capsule(&s, up, up, 1, CYLINT_ENDS_CAPPED);
    CHECK(cylint_intersect(&s, &line, CYLINT_WANT_ALL, &a) == 2);
    CHECK(a.hit[0].t == 10 && a.hit[0].z == 0 && a.hit[1].phi == 0);
    cylint_whole_line(&line, y, d);
    for (int turned = 0; turned < 2; turned++) {
        cylint_round_cone(&s, turned ? up : zero, 1, turned ? zero : up, 3,
                          CYLINT_ENDS_CAPPED);
        CHECK(cylint_intersect(&s, &line, CYLINT_WANT_ALL, &a) == 2);
        CHECK(a.hit[0].phi == (turned ? 0 : 0.5));
        CHECK(fabs(a.hit[1].z - (turned ? 1 - sqrt(2) : 1 + sqrt(2))) < 1e-15);
    }
    cylint_round_cone(&s, up, 1.5, up, 1, CYLINT_ENDS_CAPPED);
    CHECK(cylint_intersect(&s, &line, CYLINT_WANT_ALL, &a) == 2);
    CHECK(a.hit[0].z == 0 && a.hit[0].phi == 0 && a.hit[1].phi == 0);
}

#ifdef HAVE_MPFR

/* sum[0] + sum[1] = x^2 or, with a negative sign, -x^2, exactly. */
static void add_square(double sum[2], double x, int sign)
{
    sum[0] = sign * (x * x);
    sum[1] = sign * fma(x, x, -(x * x));
}

/* |w|^2 <= dr^2 decides which kind it is; here w = p1 and dr are exact. */
static void the_kind_is_decided_exactly(void)
{
    uint64_t stream = 15;
    long balls = 0, cones = 0;
    for (int i = 0; i < 100000; i++) {
        double w[3], sum[8];
        const double scale = ldexp(1, random_int(&stream, 200) - 100);
        for (int j = 0; j < 3; j++)
            w[j] =
                scale * (random_int(&stream, 2) ? random_int(&stream, 40) - 20
                                                : random_unit(&stream));
        double r = sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
        for (int k = random_int(&stream, 3); k > 0; k--)
            r = nextafter(r, random_int(&stream, 2) ? HUGE_VAL : 0);
        for (int j = 0; j < 3; j++)
            add_square(sum + 2 * j, w[j], 1);
        add_square(sum + 6, r, -1);
        const int is_cone = oracle_sum_sign(sum, 8) > 0;
        cylint_shape s;
        if (r == 0)
            continue;
        const int end = random_int(&stream, 2);
        CHECK(cylint_round_cone(&s, zero, end ? r : 0, w, end ? 0 : r,
                                CYLINT_ENDS_CAPPED) == CYLINT_OK);
        if (!CHECK(s.kind ==
                   (is_cone ? CYLINT_KIND_RCONE : CYLINT_KIND_SPHERE)))
            REPORT("rcone 0 0 0 %a  %a %a %a %a", end ? r : 0, w[0], w[1], w[2],
                   end ? 0 : r);
        balls += !is_cone;
        cones += is_cone;
    }
    CHECK(balls > 20000 && cones > 20000);
}

#endif

int main(void)
{
    RUN(good_arguments_are_accepted);
    RUN(wrong_numbers_are_refused);
    RUN(the_ball_that_holds_the_other_is_the_shape);
    RUN(z_and_phi_of_a_ball_are_those_of_the_axis);
#ifdef HAVE_MPFR
    RUN(the_kind_is_decided_exactly);
#endif
    return check_end();
}
