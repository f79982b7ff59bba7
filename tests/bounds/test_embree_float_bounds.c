/*
 * test_embree_float_bounds.c - floor embree: the bounds and the records of the
 * float filter
 *
 * The forms of cones and balls run over an arithmetic that carries bounds on a
 * number and on its error, in units u = 2^-53 of one rounding.  |w| = |u| = 1, and
 * what is compared is K = |D| + r0 / sqrt(T) = 1.  The errors of dot products are
 * those of float_filter_lanes.h.
 */
#include <float.h>
#include <math.h>
#include <string.h>

#define CYLINT_ONE_LANE
#include "check.h"
#include "embree/shapes.h"
#include "embree/float_filter_lanes.h"
#include "families.h"
#include "numbers/bits.h"

typedef struct {
    double size, off;
} number;

static number with_rounding(double size, double off)
{
    return (number){size, off + size};
}

static number sum(number x, number y)
{
    return with_rounding(x.size + y.size, x.off + y.off);
}

static number product(number x, number y)
{
    return with_rounding(x.size * y.size, x.off * y.size + x.size * y.off);
}

static number at_most(number x, double most)
{
    return (number){fmin(x.size, most), x.off};
}

typedef struct {
    number uu, Du, DD, alpha, beta, per_ww, r0, dr, S, T, y0, z0, dz;
} questions_bounds;

typedef struct {
    number a, b, c;
} quadratic_bounds;

#define NUM number
#define FORM(name) name##_bounds
#define ADD(x, y) sum(x, y)
#define SUB(x, y) sum(x, y)
#define MUL(x, y) product(x, y)
#define MOST(x, T) at_most(x, (T).size)
#include "embree/cone_form_template.h"

/* An error is at most `most` eps (8 u); *share: the greatest part of that. */
static void is_within(const char *what, number x, double most, double *share)
{
    const double part = x.off / (8 * most);
    if (!CHECK(part <= 1))
        REPORT("%s: %g eps, allowed %g", what, x.off / 8, most);
    *share = fmax(*share, part);
}

/* Sets S and T as load_axis() does; r0 is such that K is 1. */
static void set_slope(questions_bounds *q, double slope, int is_round)
{
    const number one = {1, 0};
    q->dr = (number){slope, slope};
    const number slope2 = product(product(q->dr, q->dr), q->per_ww);
    q->S = is_round ? at_most(sum(one, slope2), 1) : one;
    q->T = is_round ? one : sum(one, slope2);
    q->r0 = (number){(1 - q->alpha.size) * sqrt(q->T.size), 0};
}

/* The bounds of float_filter_lanes.h.  chord_end() needs errors of at most 6/8 e_a
 * and 0.33 e_G / sqrt(G); of a cone G <= 2 T^2, of a ball G <= 1. */
TEST(the_errors_of_cones_and_balls_are_within_their_bounds)
{
    double a = 0, b = 0, c = 0, G = 0, S = 0, y = 0, z = 0, ball_b = 0,
           ball_G = 0;
    for (int i = 0; i <= 100; i++) {
        const double D = 0.01 * i, r0 = 1 - D;
        for (int turn = 0; turn <= 60; turn++) {
            const int is_round = turn <= 10;
            questions_bounds q = {.uu = {1, 3},
                                  .Du = {D, 5 * D},
                                  .DD = {D * D, 7 * D * D},
                                  .alpha = {D, 6 * D},
                                  .beta = {1, 4},
                                  .per_ww = {1, 6.1}};
            quadratic_bounds x;
            set_slope(&q, is_round ? 0.1 * turn : 0.1 * (turn - 11), is_round);
            const double T = q.T.size;
            is_within("G", cone_G_bounds(&q, &x), 24 * T * T, &G);
            is_within("a", x.a, 6 * T, &a);
            is_within("b", x.b, 0.33 * 24 / sqrt(2) * T, &b);
            is_within("c", x.c, 6 * T, &c);
            is_within("S", q.S, 2, &S);
            is_within("z", q.z0, 2, &z);
            if (is_round)
                is_within("y", q.y0, 3, &y);
        }
        /* x, of size D, has an error of 3 u D, and r one of 2 u (r0 + |dr|) */
        const number xu = {D, 6 * D}, xx = {D * D, 9 * D * D}, r = {r0, 2 * r0},
                     uu = {1, 3};
        is_within("ball, b", xu, 0.33 * 6, &ball_b);
        is_within("ball, G", ball_G_bounds(uu, xu, xx, r), 6, &ball_G);
    }
    const double least[] = {a, b, c, G, S, y, z, ball_b, ball_G};
    for (int i = 0; i < 9; i++) /* no bound is four times too large */
        if (!CHECK(least[i] > 0.25))
            REPORT("bound %d: %g of it would do", i, least[i]);
}

/* ----------------------------------------------------- records, angles -- */

/* Whether a shape has a small record, which then holds the numbers of the large
 * one. */
static int is_kept_small(const cylint_shape *shape, cylint_record *read)
{
    const cylint_view view = cylint_plain_view(shape);
    cylint_embree_shapes one = {.size = 0};
    cylint_record large;
    CHECK(cylint_embree_shapes_copy(
        &one, &(cylint_bvh_input){.view = &view, .n = 1, .threads = 1}));
    cylint_filter_record_of(&large, shape);
    cylint_embree_record(&one, 0, read);
    cylint_memory_free(&one.memory);
    return one.size == CYLINT_SMALL_RECORD &&
           CHECK(memcmp(&large, read, sizeof large) == 0);
}

/* r0, r1: the signs of these numbers of a small record.  One ball in the other: z
 * depends on the axis, the parts on the ends. */
TEST(only_shapes_made_of_normal_floats_have_small_records)
{
    static const struct {
        int is_small, r0, r1;
        const char *shape;
    } of[] = {{1, 1, 1, "cylinder 1 2 3  4 5 6  0.5"},
              {1, 1, 1, "cylinder -0 2 3  4 5 6  0.5"},
              {1, 1, 1, "cylinder 0x1p-126 2 3  4 5 6  0.5"},
              {1, 1, 1, "cone -0 2 3 0.5  4 5 6 1"},
              {1, 1, 1, "cone 0x1p-126 2 3 0.5  4 5 6 1"},
              {1, -1, 1, "acone 1 2 3  0 0 1  45"},
              {1, -1, -1, "sphere 1 2 3  1"},
              {1, 0, -1, "rcone 1 2 3 0  4 5 6 1 ends=open"},
              {0, 0, 0, "cylinder 0.1 2 3  4 5 6  0.5"},
              {0, 0, 0, "cylinder 1 2 3  4 5 6  0.1"},
              {0, 0, 0, "cylinder 0x1p-140 2 3  4 5 6  0.5"},
              {0, 0, 0, "cylinder 0x1p-1070 2 3  4 5 6  0.5"},
              {0, 0, 0, "cylinder 0x1p200 2 3  4 5 6  0.5"},
              {0, 0, 0, "cone 1 2 3 0.1  4 5 6 1"},
              {0, 0, 0, "cone 0x1p-140 2 3 0.5  4 5 6 1"},
              {0, 0, 0, "acone 1 2 3  0 0 1  30"},
              {0, 0, 0, "rcone 1 2 3 1  4 5 6 9 ends=open"},
              {0, 0, 0, "ecylinder 1 2 3  1 0 0  0 1 0  0 0 1"}};
    for (size_t i = 0; i < sizeof of / sizeof *of; i++) {
        const cylint_shape shape = shape_of(of[i].shape);
        cylint_record record;
        const int small = is_kept_small(&shape, &record);
        if (!CHECK(small == of[i].is_small &&
                   (!small || (cylint_sign(record.r0) == of[i].r0 &&
                               cylint_sign(record.r1) == of[i].r1))))
            REPORT("%s: small %d, radii %g and %g", of[i].shape, small,
                   record.r0, record.r1);
    }
}

/* Compared with long doubles; the bound is not far above the largest error. */
TEST(the_error_of_an_angle_is_within_its_bound)
{
    const long double two_pi = 6.283185307179586476925286766559L;
    double most = 0;
    for (int i = 0; i < 1000000; i++) {
        const double phi = 6.2831853 * (i + 0.5) / 1e6;
        const double length = ldexp(1 + 1e-6 * i, i % 200 - 100);
        const double x = length * cos(phi), y = length * sin(phi);
        double per_far;
        const double turn = cylint_atan2_turns(y, x, &per_far);
        long double exact = atan2l(y, x) / two_pi;
        exact += exact < 0;
        most = fmax(most, (double)fabsl(turn - exact));
        if (!CHECK(per_far * hypot(x, y) <= 1 + 0x1p-50 &&
                   per_far * hypot(x, y) > 12 / 13.0))
            REPORT("1 / %a of %a, %a", per_far, x, y);
    }
    if (!CHECK(most <= CYLINT_ATAN2_TURNS_ERROR &&
               most > 0.5 * CYLINT_ATAN2_TURNS_ERROR))
        REPORT("by %a", most);
}
