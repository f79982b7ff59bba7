/*
 * test_local_bounds.c - floor filter: error_bounds.h covers the errors of
 * local_forms_template.h
 *
 * The forms are compiled with an arithmetic that carries bounds: on a number,
 * on its low part, and on its error.  Units: Q = 1, D = 1, norm = 1.  Every
 * bound is a polynomial with positive coefficients in the radius r, the slope s
 * and the size of what is compared, and so is every constant's product.  So a
 * cell of a grid is covered if its greatest error is at most its least product.
 * Each note has the least value of a constant that would do.  It must be at most
 * the constant.  The greatest of them must be more than a quarter of it: these
 * are bounds with slack.
 */
#include <math.h>

#include "local_bounds.h"
#include "roots/roots.h"
#include "numbers/error_bounds.h"
#include "shapes/shape_facts.h"

/* ------------------------------------------------------- arithmetic ----- */

typedef struct {
    double size, lo, off;
} number;

/* One operation: doubles, u = 2^-52 in any rounding mode; or unnormalised
 * pairs (simd.h), whose high parts are exact and whose low parts are rounded to
 * nearest, 2^-53. */
static int in_pairs;

static number sum(number x, number y)
{
    const double size = x.size + y.size;
    if (!in_pairs)
        return (number){
            size, 0, x.off + y.off + CYLINT_ROUNDING * (size + x.off + y.off)};
    const double high = size + x.lo + y.lo, low = x.lo + y.lo;
    const double lo = 0x1p-53 * high + low * (1 + 0x1p-50);
    return (number){size, lo, x.off + y.off + 0x1p-53 * (low + lo)};
}

static number product(number x, number y)
{
    const double size = x.size * y.size;
    const double off = x.off * y.size + x.size * y.off + x.off * y.off;
    if (!in_pairs)
        return (number){size, 0, off + CYLINT_ROUNDING * (size + off)};
    const double a = x.size + x.lo, b = y.size + y.lo;
    const double cross = a * y.lo + x.lo * b;
    const double lo = 0x1p-53 * a * b + cross * (1 + 0x1p-50);
    return (number){size, lo, off + x.lo * y.lo + 0x1p-53 * (2 * cross + lo)};
}

/* A number that is known to be at most `size`. */
static number at_most(number x, double size)
{
    return (number){fmin(x.size, size), x.lo, x.off};
}

/* What local_forms_template.h calls TRIMMED is compared with another number.
 * If both are equal it is at most `cap`.  Its error is taken for least_off if
 * that is larger. */
static double cap = HUGE_VAL, least_off;

static number trimmed(number x)
{
    const double size = fmin(x.size, cap), off = fmax(x.off, least_off);
    return (number){size, in_pairs ? 0x1p-53 * (size + off) : 0, off};
}

#define INLINE static inline
#define NUM number
#define FORM(name) name##_bounds
#define SUB(x, y) sum(x, y)
#define MUL(x, y) product(x, y)
#define SUM_OF(x, y, z) sum(product(x, y), z)
#define NEGATED(x) (x)
#define TRIMMED(x) trimmed(x)
#include "filter/local_forms_template.h"

/* ------------------------------------------------------------- line ----- */

static double u; /* of error_bounds.h */

/* A number that is given exactly, or as a high part, or as a pair whose error
 * is `off`. */
static number given(double size, double off)
{
    if (in_pairs)
        return (number){size, 0x1p-53 * size, off};
    return (number){size, 0, CYLINT_ROUNDING * size + off};
}

static number known(double size)
{
    return (number){size, 0, 0};
}

/* What the shape's numbers err by beside a rounding, in doubles without low parts
 * (shapes/local_doubles.c), in any rounding mode: the matrix, height and slope,
 * and the angle of a round cone. */
static double matrix_off, height_off, angle_off;

/* The larger in each respect. */
static number worse(number x, number y)
{
    return (number){fmax(x.size, y.size), fmax(x.lo, y.lo), fmax(x.off, y.off)};
}

/* A row of the matrix times a vector of components up to 1.  The bound is
 * linear in the sizes of the entries, of which the sum is 1 and so is that of
 * their errors in units of u, so it is greatest where one entry has all.
 * transformed() and row_in_pairs() add the low parts in another order: in the
 * sum of each two numbers here as many roundings are counted, and of numbers as
 * large. */
static number row_times(number component)
{
    const number entry = given(1, in_pairs ? u : matrix_off), none = {0, 0, 0};
    number most = none;
    for (int all = 0; all < 3; all++) {
        number total = none;
        for (int j = 0; j < 3; j++) {
            const number term = j == all ? product(component, entry) : none;
            total = j ? sum(total, term) : term;
        }
        most = worse(most, total);
    }
    return at_most(most, 1);
}

/* The errors of the height and of the slope: relative, CYLINT_LOCAL_ERROR in
 * pairs (tests/filter/test_local_coordinates.c). */
static number relative(double size)
{
    return given(size, (in_pairs ? CYLINT_LOCAL_ERROR : height_off) * size);
}

/* Of a round cone: sine, cosine and slope have the relative error u in pairs,
 * and the planes and circles follow from these (frame.h). */
static int is_round;

static number of_angle(double size)
{
    return given(size, (in_pairs ? u : angle_off) * size);
}

/* z and r of the top's plane and circle, or of the top's ball. */
static number top_z, top_r;

static void load(line_bounds *l, double r, double slope)
{
    const number of_origin = row_times(given(1, 0)),
                 of_direction = row_times(given(1, 0));
    for (int i = 0; i < 2; i++) {
        l->p[i] = of_origin;
        l->v[i] = of_direction;
    }
    l->w = of_direction;
    l->z = of_origin;
    top_z = at_most(sum(of_origin, relative(1)), 1);
    l->r = top_r = known(r);
    l->slope = relative(slope);
    if (is_round) {
        const number circle = at_most(product(of_angle(1), known(r)), r);
        l->z = top_z = at_most(sum(top_z, circle), 1);
        l->r = top_r = circle;
        l->slope = of_angle(slope);
    }
    set_products_bounds(l);
}

/* ------------------------------------------------------------- grid ----- */

static constant POSITION = {"POSITION", CYLINT_LOCAL_POSITION, 0},
                A = {"A", CYLINT_LOCAL_A, 0},
                FORM_ERROR = {"FORM", CYLINT_LOCAL_FORM, 0},
                BALL = {"BALL", CYLINT_LOCAL_BALL, 0},
                RESIDUAL = {"RESIDUAL", CYLINT_LOCAL_RESIDUAL, 0};

static void judge(constant *c, const char *of)
{
    judge_in(c, of, in_pairs ? "pairs" : "doubles");
}

/* Radii from r to more_r and slopes from s to more_s, and the line of these. */
typedef struct {
    double r, more_r, s, more_s;
    line_bounds l;
} cell;

typedef void bound_of_cell(cell *c);

static void at_cell(bound_of_cell *of, double r, double more_r, double s,
                    double more_s)
{
    cell c = {.r = r, .more_r = more_r, .s = s, .more_s = more_s};
    load(&c.l, more_r, more_s);
    of(&c);
}

static void over_slopes(bound_of_cell *of, double r, double more_r)
{
    double more = FIRST_SLOPE;
    for (double s = 0; s < LAST_SLOPE; s = more, more *= STEP)
        at_cell(of, r, more_r, s, more);
}

static void over_cells(bound_of_cell *of)
{
    for (int i = 0; i < 40; i++)
        over_slopes(of, i / 40.0, (i + 1) / 40.0);
}

/* All slopes with the greatest radius. */
static void over_cones(bound_of_cell *of)
{
    over_slopes(of, 0, 1);
}

/* In doubles where the matrix has no low parts: the roundings of which
 * local_doubles.c gives the counts.  A round cone's cosine has its square
 * between 1 and 1 - CYLINT_LOCAL_STEEPEST^2. */
static void in_local_doubles(void (*test)(void))
{
    const double steepest = 1 - square(CYLINT_LOCAL_STEEPEST);
    matrix_off = 14.5 * CYLINT_ROUNDING;
    height_off = 10.5 * CYLINT_ROUNDING;
    for (int steep = 0; steep <= is_round; steep++) {
        const double cosine2 = steep ? steepest : 1;
        u = CYLINT_LOCAL_DOUBLES * CYLINT_ROUNDING / cosine2;
        angle_off = 13 * CYLINT_ROUNDING / cosine2;
        test();
    }
    matrix_off = height_off = angle_off = 0;
}

static void in_doubles(void (*test)(void))
{
    in_pairs = 0;
    u = (is_round ? CYLINT_LOCAL_ROUND : 1) * CYLINT_ROUNDING;
    test();
    in_local_doubles(test);
}

/* In doubles, with and without low parts of the matrix; in pairs with the least and
 * with the greatest u. */
static void in_each_arithmetic(void (*test)(void))
{
    static const double units[] = {CYLINT_LOCAL_ERROR, CYLINT_LOCAL_WORST};
    in_doubles(test);
    in_pairs = 1;
    for (int i = 0; i < 2; i++) {
        u = units[i];
        test();
    }
    in_pairs = 0;
}

/* ------------------------------------------------------------ forms ----- */

static void position_cell(cell *c)
{
    need(c->l.p[0].off, u);
    need(top_z.off, u);
    need(c->l.w.off, u); /* the slope of a cap's residual, with D for Q */
    /* is_ahead(): z w against 2 POSITION u Q D */
    need(product(top_z, c->l.w).off, 2 * u);
}

static void a_cell(cell *c)
{
    const number A = A_bounds(&c->l, 1);
    /* The estimate of a root rounds A t three times, and A itself. */
    need(A.off + (in_pairs ? 0 : 4 * 0x1p-53 * A.size), u * square(1 + c->s));
}

static void b_cell(cell *c)
{
    c->l.r = at_most(c->l.r, 1);
    need(B_bounds(&c->l, 1).off, u * square(1 + c->s));
}

static void n_cell(cell *c)
{
    need(N_bounds(&c->l, top_z, top_r, 1).off, u * (1 + c->s));
}

/* T, of which |v| |Y| may be as large as k. */
static void t_cell(cell *c)
{
    number Y[2];
    set_Y_bounds(&c->l, Y);
    need(T_bounds(&c->l, Y).off, u * (1 + c->s));
}

/*
 * E = a^2 - b^2, a = r |w|, b = |X|.  The computed E grows with a and falls with
 * b.  So if b >= a, it is at most what it is for b = a, where E = 0; and if
 * b <= a, it is at least that.  The sign is right if the value exceeds the
 * error for b = a <= r D.  That error grows with a, and, for |X| = a, it is
 * greatest if both components are equal.  G of a straight shape: a = r |v|,
 * b = |p x v|.
 */
static void e_cell(cell *c)
{
    cap = c->more_r / sqrt(2);
    need(E_bounds(&c->l, top_z, top_r).off,
         u * (c->r + CYLINT_LOCAL_SECOND * u));
    cap = HUGE_VAL;
}

static void straight_g_cell(cell *c)
{
    cap = c->more_r * sqrt(2);
    need(G_bounds(&c->l, 0, NULL).off, u * (c->r + CYLINT_LOCAL_SECOND * u));
    cap = HUGE_VAL;
}

/* The same for r near 0, where the second term decides. */
static void over_radii(bound_of_cell *of)
{
    double more = u / 16;
    for (double r = 0; r < 1; r = more, more = fmin(more * STEP, 1))
        at_cell(of, r, more, 0, 0);
}

/*
 * G = |Y|^2 - m^2 of a tapered shape, for |Y| = m = y.  The bound is
 * 2 off (|Y| + off), off = FORM / 2 u k Q D, where |Y|, the sum of the computed
 * components, is at least y less the error.
 */
static void tapered_g_cell(cell *c)
{
    number Y[2];
    set_Y_bounds(&c->l, Y);
    const double k = 1 + c->s, off = CYLINT_LOCAL_FORM / 2 * u * k;
    const double most = 2 * sqrt(2) * (1 + c->more_s);
    const double lost = sqrt(2) * fmax(Y[0].off, Y[1].off);
    double more_y = u * k / 64;
    for (double y = 0; y < most; y = more_y, more_y *= STEP) {
        number there[2] = {Y[0], Y[1]};
        cap = more_y;
        for (int i = 0; i < 2; i++)
            there[i].size = fmin(there[i].size, more_y / sqrt(2));
        if (in_pairs)
            for (int i = 0; i < 2; i++)
                there[i].lo = 0x1p-53 * (more_y + there[i].off);
        need(G_bounds(&c->l, 1, there).off,
             2 * off * (fmax(y - lost, 0) + off) / CYLINT_LOCAL_FORM);
    }
    cap = HUGE_VAL;
}

static void forms(void)
{
    static const struct {
        void (*over)(bound_of_cell *);
        bound_of_cell *of;
        constant *constant;
        const char *name;
    } all[] = {{over_cells, position_cell, &POSITION, ""},
               {over_cells, a_cell, &A, ""},
               {over_cells, b_cell, &FORM_ERROR, "of B"},
               {over_cells, n_cell, &FORM_ERROR, "of N"},
               {over_cells, t_cell, &FORM_ERROR, "of T"},
               {over_radii, e_cell, &FORM_ERROR, "of E"},
               {over_radii, straight_g_cell, &FORM_ERROR, "of G, straight"},
               {over_cones, tapered_g_cell, &FORM_ERROR, "of G, tapered"}};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        all[i].over(all[i].of);
        judge(all[i].constant, all[i].name);
    }
}

/* Of straight and of round cones. */
static void of_both(void (*in)(void (*)(void)), void (*test)(void))
{
    for (is_round = 1; is_round >= 0; is_round--)
        in(test);
    is_round = 0;
}

TEST(the_constants_cover_the_errors_of_the_forms)
{
    of_both(in_each_arithmetic, forms);
}

/*
 * g = a^2 - b^2 of a ball, a = r |d|, b^2 = m^2 + |X|^2: as E, for b = a, where
 * |d| is at most sqrt(3) D.  If m and both components of X have the same error,
 * that of g is greatest if all three are equal, and then they are r D at most.
 */
static void ball_g_cell(cell *c)
{
    cap = c->more_r;
    least_off = fmax(moment_bounds(&c->l).off, X_bounds(&c->l, top_z, 0).off);
    need(ball_g_bounds(&c->l, top_z, top_r).off,
         u * (c->r + CYLINT_LOCAL_SECOND * u));
    cap = HUGE_VAL;
    least_off = 0;
}

static void balls(void)
{
    line_bounds l;
    over_radii(ball_g_cell);
    judge(&BALL, "of g");
    load(&l, 1, 0);
    const number ball_A = ball_A_bounds(&l);
    need(ball_A.off + (in_pairs ? 0 : 4 * 0x1p-53 * ball_A.size), u);
    judge(&A, "of a ball");
    need(ball_B_bounds(&l, top_z).off, u);
    judge(&FORM_ERROR, "of B, ball");
}

TEST(the_forms_of_balls_have_their_bounds)
{
    in_each_arithmetic(balls);
}

/* ------------------------------------------------- a point of the line -- */

/* set_place_signs(): the point at t in units of |t| D + Q, whose least and
 * greatest share of |t| D have the greatest errors. */
static number at_t(number p, number v)
{
    const double shares[] = {0, 0x1p-30, 0.5, 1 - 0x1p-30};
    number most = {0, 0, 0};
    for (int i = 0; i < 4; i++) {
        const number t = known(shares[i]);
        const double rest = 1 - shares[i];
        const number from = {p.size * rest, p.lo * rest, p.off * rest};
        most = worse(most, sum(product(t, v), from));
    }
    return at_most(most, 1);
}

static void point_cell(cell *c)
{
    need(at_t(c->l.p[0], c->l.v[0]).off, u);
    need(at_t(top_z, c->l.w).off, u);
    const number z = at_t(c->l.z, c->l.w);
    need(sum(product(c->l.slope, z), c->l.r).off, u * (1 + c->s));
}

/* The side of the vertex: A t + B against 2 FORM. */
static void vertex_cell(cell *c)
{
    need(sum(product(known(1), A_bounds(&c->l, 1)), B_bounds(&c->l, 1)).off,
         2 * u * square(1 + c->s));
}

/* C = |p|^2 - rho^2 against 4 eP (widest + eP), eP = POSITION u k, for
 * |p| = |rho| <= widest. */
static void point_C_cell(cell *c)
{
    const number p = at_t(c->l.p[0], c->l.v[0]);
    const number z = at_t(c->l.z, c->l.w);
    const number rho = sum(product(c->l.slope, z), c->l.r);
    const double eP = u * (1 + c->s);
    double most = u / 16;
    for (double least = 0; least < 1 + c->more_s; least = most, most *= STEP) {
        const number x = at_most(p, most / sqrt(2)), y = at_most(rho, most);
        const number C = sum(product(y, y), sum(product(x, x), product(x, x)));
        need(C.off, 4 * eP * (least + CYLINT_LOCAL_POSITION * eP));
    }
}

/* set_place_signs(): C = |P|^2 - r^2 of a ball against 8 eZ (r + eZ), eZ = POSITION
 * u Q, for |P| = r; and A t + B of a ball. */
static void ball_at_t(void)
{
    line_bounds l;
    double most = u / 16;
    load(&l, 1, 0);
    const number p = at_t(l.p[0], l.v[0]);
    const number z = at_t(top_z, l.w);
    for (double least = 0; least < 1; least = most, most *= STEP) {
        const number x = at_most(p, most), high = at_most(z, most);
        const number pp = sum(product(x, x), product(x, x));
        const number C = sum(sum(product(high, high), pp),
                             product(known(most), known(most)));
        need(C.off, 8 * u * (least + CYLINT_LOCAL_POSITION * u));
    }
    judge(&POSITION, "of C, ball");
    need(
        sum(product(known(1), ball_A_bounds(&l)), ball_B_bounds(&l, top_z)).off,
        2 * u);
    judge(&FORM_ERROR, "of A t + B");
}

static void at_points(void)
{
    over_cells(point_cell);
    judge(&POSITION, is_round ? "at t, round" : "at t");
    over_cones(point_C_cell);
    judge(&POSITION, is_round ? "of C, round" : "of C at t");
    if (is_round)
        return;
    over_cells(vertex_cell);
    judge(&FORM_ERROR, "of A t + B");
}

TEST(the_signs_at_a_point_have_their_bounds)
{
    in_doubles(ball_at_t);
    of_both(in_doubles, at_points);
}

/* ----------------------------------------------------------- residuals -- */

/* The square of a pair whose low part need not be a rounding of the high one
 * (vpair_square()). */
static number square_of(number x)
{
    const double middle = 2 * x.size + x.lo, last = middle * x.lo;
    const double lo = 0x1p-53 * x.size * x.size + last;
    const double off = 2 * (x.size + x.lo) * x.off + x.off * x.off;
    return (number){x.size * x.size, lo, off + 0x1p-53 * (2 * last + lo)};
}

/*
 * square_residual(), in units of |t| D + Q: all of across = |x| + |y| + |z| +
 * |rho| in one of them, where the bound is greatest, since it is a sum of
 * convex functions of each.  The difference of the high parts is exact, or the
 * error is one rounding of it, and so is that of each sum with it: Newton's
 * step counts these, but for what the low parts add to them: at most eight
 * roundings.  Of a straight shape across has no rho; where |rho| is more than
 * twice across, the value is as large as rho^2, and the error of rho^2 is a
 * rounding of the value.
 */
static double square_off(number x, number rho)
{
    const number xx = square_of(x), square = square_of(rho);
    const double low = 0x1p-53 * xx.size + xx.lo + square.lo;
    return xx.off + square.off + 0x1p-53 * 8 * low;
}

static void residual_cell(cell *c)
{
    const number p = row_times(given(1, 0)), x = at_t(p, p);
    const number top = sum(p, relative(1)), z = at_t(top, p);
    const number slope = is_round ? of_angle(c->more_s) : relative(c->more_s);
    const number circle =
        is_round ? at_most(product(of_angle(1), known(c->more_r)), c->more_r)
                 : known(c->more_r);
    const number plane = is_round ? at_most(sum(p, circle), 1) : p;
    const number rho =
        at_t(sum(circle, product(slope, plane)), product(slope, p));
    const number none = {0, x.lo, x.off}, no_rho = {0, rho.lo, rho.off};
    double most = u;
    for (double least = 0; least < 2 + c->more_s; least = most, most *= STEP) {
        const double off = CYLINT_LOCAL_RESIDUAL * u * (1 + c->s);
        const double unit = u * (1 + c->s) *
                            (CYLINT_LOCAL_UNTRIMMED * (1 + c->s) + least + off);
        need(square_off(at_most(x, most), no_rho), unit);
        need(square_off(none, at_most(rho, most)), unit);
        need(square_off(at_most(x, most), known(2 * most)), unit);
        if (c->s == 0) /* a ball */
            need(square_off(at_most(z, most), known(2 * most)), unit);
    }
    need(x.off + 0x1p-53 * x.lo, u);
    need(z.off + 0x1p-53 * z.lo, u);
    if (is_round) { /* the plane of a circle */
        const number height = at_t(at_most(sum(top, circle), 1), p);
        need(height.off + 0x1p-53 * height.lo, u);
    }
    need(rho.off + 0x1p-53 * rho.lo, u * (1 + c->s));
}

static void residuals(void)
{
    if (!in_pairs)
        return;
    over_cells(residual_cell);
    judge(&RESIDUAL, "");
}

TEST(a_residual_in_pairs_has_its_bound)
{
    of_both(in_each_arithmetic, residuals);
}

TEST(no_constant_is_four_times_too_large)
{
    check_slack(&POSITION);
    check_slack(&A);
    check_slack(&FORM_ERROR);
    check_slack(&BALL);
    check_slack(&RESIDUAL);
}
