/*
 * test_local_residuals.c - floor filter: error_bounds.h covers the errors of
 * residuals in levels, and of an operation on triples
 *
 * As test_local_bounds.c does for the forms: the residuals are computed with
 * bounds in place of numbers, in units of the line's size.
 */
#include <math.h>

#include "local_bounds.h"
#include "distance/error_bounds.h"
#define INLINE static inline

static constant LEVELS = {"LEVELS", CYLINT_LOCAL_LEVELS, 0},
                ROUNDING = {"TRIPLE_ROUNDING", CYLINT_TRIPLE_ROUNDING, 0},
                CLOSE = {"CLOSE_ERROR", CYLINT_CLOSE_ERROR, 0};

/*
 * Triples (triple.h).  After a triple_sum |b| is at most 2^-53 |a| + c and the
 * third number at most c and 2^-52 |b|, where c counts what cancelled before.  A
 * fast_two_sum is exact if its first number is the larger one or a multiple of
 * the last digit of the other.  That is so but for what c adds to b, and then
 * it errs by at most 2^-52 of that.
 */
typedef struct {
    double size, c, off;
} triple_number;

static triple_number triple_sum_of(double size, double last, double unordered,
                                   double off)
{
    /* at most six roundings of last, and that of the final fast_two_sum */
    return (triple_number){size, last * (1 + 0x1p-50),
                           off + 8 * 0x1p-53 * last + 0x1p-52 * unordered};
}

static triple_number triple_plus(triple_number x, triple_number y)
{
    const double size = x.size + y.size, c = x.c + y.c;
    const double b = 0x1.001p-53 * size + c, u_hi = b + 0x1p-53 * (size + c);
    return triple_sum_of(size, c + 0x1p-53 * (b + u_hi), c, x.off + y.off);
}

static double second_of(triple_number x)
{
    return 0x1.001p-53 * x.size + x.c;
}

static double third_of(triple_number x)
{
    return fmin(x.c, 0x1p-52 * second_of(x));
}

static triple_number triple_times(triple_number x, triple_number y)
{
    const double size = x.size * y.size;
    const double xb = second_of(x), yb = second_of(y);
    const double c = x.size * y.c + x.c * y.size;
    const double middle = x.size * yb + xb * y.size + 0x1p-53 * size;
    const double xc = third_of(x), yc = third_of(y);
    const double left_out = xb * yc + xc * yb + xc * yc;
    const double off = x.off * y.size + x.size * y.off + x.off * y.off;
    return triple_sum_of(size, c + xb * yb + 3 * 0x1p-53 * middle, c,
                         off + left_out);
}

/*
 * levels.h, step by step.  a, b, c: the sizes of the levels, of which
 * a and b have no error.
 */
typedef struct {
    double a, b, c, off;
} level_number;

static void add_to_c(level_number *x, double size)
{
    x->c += size;
    x->off += 0x1p-53 * x->c;
}

static void add_to_b(level_number *x, double size)
{
    x->b += size;
    add_to_c(x, 0x1p-53 * x->b);
}

static void add_to_a(level_number *x, double size)
{
    x->a += size;
    add_to_b(x, 0x1p-53 * x->a);
}

static void add_product_to_a(level_number *x, double size)
{
    add_to_a(x, size);
    add_to_b(x, 0x1p-53 * size);
}

static void add_product_to_b(level_number *x, double size)
{
    add_to_b(x, size);
    add_to_c(x, 0x1p-53 * size);
}

static void add(level_number *sum, level_number x)
{
    add_to_a(sum, x.a);
    add_to_b(sum, x.b);
    add_to_c(sum, x.c);
    sum->off += x.off;
}

/* Three lanes. */
static void add_three(level_number *sum, level_number x)
{
    for (int i = 0; i < 3; i++)
        add(sum, x);
}

/* Three roundings of the terms of c; the products of b and c, and of two c, are
 * left out. */
static level_number product_of(level_number x, level_number y)
{
    level_number xy = {0, 0, 0, 0};
    add_to_c(&xy, x.a * y.c + x.c * y.a + x.b * y.b);
    add_product_to_a(&xy, x.a * y.a);
    add_product_to_b(&xy, x.a * y.b);
    add_product_to_b(&xy, x.b * y.a);
    xy.off += 3 * 0x1p-53 * xy.c + x.b * y.c + x.c * y.b + x.c * y.c +
              (x.a + x.b + x.c) * y.off + x.off * (y.a + y.b + y.c) +
              x.off * y.off;
    return xy;
}

static level_number squared(level_number x)
{
    return product_of(x, x);
}

/* A sum that is known to be at most `size`, in level a. */
static level_number within(level_number x, double size)
{
    x.a = fmin(x.a, size + x.b + x.c);
    return x;
}

/* The error of a coordinate in doubles that round to nearest. */
static const double near = CYLINT_LOCAL_POSITION * 0x1p-53;

/* F: of the vectors that are subtracted, `vectors` have no low part. */
static level_number distance_from_point(int vectors)
{
    level_number F = {1, 0x1p-53, 0, 0};
    add_product_to_a(&F, 1);
    add_product_to_b(&F, 0x1p-53);
    for (int i = 0; i < vectors; i++)
        add_product_to_a(&F, 1);
    if (vectors == 1)
        add_product_to_b(&F, 0x1p-53);
    return F;
}

/* r0 + dr (s + e), where e is known with the error e_off. */
static level_number radius_of(double dr, double e, double e_off)
{
    level_number rho = {1, 0, 0, dr * e_off};
    add_product_to_a(&rho, dr);
    add_product_to_b(&rho, 0x1p-53 * dr);
    add_product_to_b(&rho, dr * e);
    add_to_c(&rho, 0x1p-52 * dr * e);
    rho.off += 3 * 0x1p-53 * rho.c;
    return within(rho, 1 + dr);
}

/* The axis, |w| = 1. */
static const level_number W = {1, 0x1p-53, 0, 0};

/* In units of |t| D + Q, |w| = 1.  The radius of an acone is in multiples of
 * |w|. */
static void circular_levels(double s, double more_s, int is_acone)
{
    const level_number F = within(distance_from_point(1), 1);
    level_number g = {0, 0, 0, 0}, Q = {0, 0, 0, 0}, WW = {0, 0, 0, 0};
    add_three(&g, product_of(F, W));
    add_three(&WW, squared(W));
    /* e is as large as the error of s; the length in pairs has twice the error
     * of the matrix */
    const double e = near, e_off = g.off + 0x1p-50 * g.c + e * 0x1p-93;
    const level_number rho = radius_of(more_s, e, e_off);
    add_three(&Q, squared(F));
    if (is_acone)
        add(&Q, product_of(squared(rho), within(WW, 1)));
    else
        add(&Q, squared(rho));
    add_to_c(&Q, e * e);
    const double unit = CYLINT_LOCAL_ERROR * CYLINT_LOCAL_ERROR;
    need(Q.off + 2 * 0x1p-53 * Q.c + 2 * e * e_off, unit * square(1 + s));
    need(g.off + 0x1p-53 * g.c, unit);
}

/*
 * The same of a straight shape.  The low parts of F.w: of each lane the error of
 * a product, a times the low part of w, and b; they and the errors of two sums
 * are added with nine roundings at most, and c and the product of b and the low
 * part are left out.
 */
static void straight_levels(void)
{
    const level_number F = within(distance_from_point(1), 1);
    level_number Q = {1, 0x1p-53, 0, 0};
    const double low = 3 * (2 * 0x1p-53 + F.b) + 2 * 3 * 0x1p-53;
    const double e = near, e_off = 3 * (F.c + F.off + 0x1p-53 * F.b) +
                                   9 * 0x1p-53 * low + 4 * 0x1p-53 * e;
    add_three(&Q, squared(F));
    add_to_c(&Q, e * e);
    need(Q.off + 2 * 0x1p-53 * Q.c + 2 * e * e_off,
         CYLINT_LOCAL_ERROR * CYLINT_LOCAL_ERROR);
}

/* A ball, and the cone of a round cone, |w| = 1 and |dr| <= 1. */
static void round_levels(void)
{
    const double unit = CYLINT_LOCAL_ERROR * CYLINT_LOCAL_ERROR;
    const level_number F = within(distance_from_point(0), 1);
    level_number surplus = {1, 0x1p-53, 0, 0}, rest = {0, 0, 0, 0};
    level_number height = {0, 0, 0, 0};
    add_three(&surplus, squared(F));
    need(surplus.off + 0x1p-53 * surplus.c, unit);
    add_three(&rest, squared(W));
    add(&rest, squared(W));
    add_three(&height, product_of(F, W));
    add_product_to_a(&height, 1);
    add_product_to_b(&height, 0x1p-53);
    level_number Q = product_of(within(surplus, 3), within(rest, 1));
    add(&Q, squared(within(height, 3)));
    need(Q.off + 0x1p-53 * Q.c, unit);
}

/* |a| = |b| = |w| = 1, det = 1 / c: rows of the matrix have sums of at most
 * sqrt(3) c, and |P| is at most 1. */
static void elliptic_levels(double s, double more_s)
{
    const level_number F = distance_from_point(3);
    const double size = 3 * near, norm = sqrt(3), c = 1;
    const double f = norm * size;
    const double f_off = norm * (F.off + 0x1p-53 * F.c) +
                         CYLINT_LOCAL_ERROR * c * f + 8 * 0x1p-105 * f;
    level_number Q = {0, 0, 0, 0};
    for (int i = 0; i < 2; i++) {
        add_product_to_a(&Q, 1);
        add_product_to_b(&Q, 2 * f);
        add_to_c(&Q, 0x1p-50 * f + f * f);
        Q.off += 2 * f_off + 4 * 0x1p-53 * Q.c + 0x1p-48 * f * f;
    }
    add(&Q, squared(radius_of(more_s, f, f_off)));
    const double unit = CYLINT_LOCAL_ERROR * CYLINT_LOCAL_ERROR;
    need(Q.off + 0x1p-53 * Q.c, unit * square(1 + s));
    need(f_off, unit);
}

TEST(a_residual_in_levels_has_its_bound)
{
    double more = FIRST_SLOPE;
    straight_levels();
    for (double s = 0; s < LAST_SLOPE; s = more, more *= STEP) {
        circular_levels(s, more, 0);
        circular_levels(s, more, 1);
        elliptic_levels(s, more);
    }
    judge_in(&LEVELS, "levels", "levels");
    round_levels();
    judge_in(&LEVELS, "round levels", "levels");
}

/* One operation on triples of the size 1, |c| <= 2^-104. */
TEST(an_operation_on_triples_has_its_bound)
{
    const triple_number x = {1, 0x1p-104, 0};
    need(triple_plus(x, x).off, 2);
    need(triple_times(x, x).off, 1);
    judge_in(&ROUNDING, "", "triples");
}

static triple_number triple_dot_of(const triple_number x[3],
                                   const triple_number y[3])
{
    return triple_plus(
        triple_plus(triple_times(x[0], y[0]), triple_times(x[1], y[1])),
        triple_times(x[2], y[2]));
}

/* The height over a tangent plane (elliptic_pairs.h), of shapes of the size 1, k -
 * 1 and the size of D from it.  cos and sin are divided by their length, which is
 * nearly 1. */
static void elliptic_height(double D, double k1)
{
    const triple_number one = {1, 0, 0}, k = {k1, 0, 0}, from = {D, 0, 0};
    const triple_number square = triple_times(one, one);
    const triple_number excess = triple_plus(triple_plus(square, square), one);
    const triple_number cos =
        triple_plus(one, (triple_number){0, 0, excess.off / 2});
    const triple_number turned = triple_times(one, cos);
    const triple_number u = triple_plus(turned, turned);
    const triple_number v = triple_plus(one, triple_times(k, u));
    const triple_number product = triple_times(u, v);
    const triple_number N = triple_plus(product, product);
    const triple_number E = triple_plus(from, u);
    const triple_number n =
        triple_dot_of((triple_number[]){E, E, E}, (triple_number[]){N, N, N});
    need(n.off, n.size);
}

TEST(the_height_over_a_tangent_plane_has_its_bound)
{
    for (int i = -300; i <= 300; i++)
        for (int j = -300; j <= 300; j++)
            elliptic_height(ldexp(1, i), ldexp(1, j));
    judge_in(&CLOSE, "elliptic kinds", "triples");
}

/* A value that is known to be at most `size`. */
static triple_number at_most(triple_number x, double size)
{
    x.size = fmin(x.size, size);
    return x;
}

static triple_number difference_of_squares(triple_number x, triple_number y,
                                           triple_number z)
{
    return triple_plus(triple_times(x, y), triple_times(z, z));
}

/* near_surface.h, where the size that over_sum() gets is 1: no length is larger,
 * nor is the radius of a cone beside the point. */
static const triple_number ONE = {1, 0, 0},
                           ONES[3] = {{1, 0, 0}, {1, 0, 0}, {1, 0, 0}};

/* |w| = 1.  Of an angle cone's rim r^2 |w|^2 takes the place of r^2. */
static void close_plane_ball_and_cylinder(void)
{
    const triple_number dot = triple_dot_of(ONES, ONES), one = at_most(dot, 1);
    const triple_number ball = triple_plus(dot, triple_times(ONE, one));
    need(dot.off, 1);
    need(ball.off, CYLINT_CLOSE_SQUARES);
    need(difference_of_squares(at_most(ball, 1), one, one).off,
         CYLINT_CLOSE_SQUARES);
}

/* length: |w|.  radius: of the cone beside the point. */
static void close_cone(double length, double dr, double rho, double radius,
                       int is_round)
{
    const double unit = length * length;
    const triple_number slope = {dr, 0, 0}, w = {length, 0, 0};
    const triple_number W = at_most(triple_dot_of((triple_number[]){w, w, w},
                                                  (triple_number[]){w, w, w}),
                                    unit),
                        Dw = at_most(
                            triple_dot_of(ONES, (triple_number[]){w, w, w}),
                            length);
    const triple_number across =
        at_most(difference_of_squares(triple_dot_of(ONES, ONES), W, Dw),
                square(rho) * unit);
    const triple_number T =
        at_most(triple_plus(triple_times(W, ONE), triple_times(slope, Dw)),
                radius * unit);
    const triple_number factor =
        is_round ? triple_plus(W, triple_times(slope, slope)) : W;
    const double form =
        difference_of_squares(across, at_most(factor, unit), T).off;
    /* T is in the divisor, too */
    const double off = form + fabs(rho - radius) * unit * T.off;
    need(off, CYLINT_CLOSE_SQUARES * unit * unit *
                  (is_round ? 1 : hypot(1, dr / length)));
}

static void close_direction(void)
{
    const triple_number X = difference_of_squares(ONE, ONE, ONE);
    need(triple_plus(triple_times(ONE, X), triple_times(ONE, X)).off,
         CYLINT_CLOSE_DIRECTION);
}

TEST(a_distance_in_triples_has_its_bound)
{
    close_plane_ball_and_cylinder();
    judge_in(&CLOSE, "planes, balls", "triples");
    for (double length = 1; length > 0x1p-100; length /= 16)
        for (double dr = 1; dr > 0x1p-120; dr /= 16)
            for (double rho = 1; rho > 0x1p-100; rho /= 16)
                for (double radius = 1; radius > 0x1p-200; radius /= 16) {
                    close_cone(length, dr, rho, radius, 0);
                    if (dr < length)
                        close_cone(length, dr, rho, radius, 1);
                }
    judge_in(&CLOSE, "cones", "triples");
    close_direction();
    judge_in(&CLOSE, "directions", "triples");
}

TEST(no_constant_is_four_times_too_large)
{
    check_slack(&LEVELS);
    check_slack(&ROUNDING);
}
