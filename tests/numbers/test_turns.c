/*
 * test_turns.c - turns.h and turns_lanes.h against MPFR
 *
 * Computes the nodes and constants again.  Measures the errors of angles over
 * their bounds: in one lane, of exact and of inexact points, and from exact numbers
 * (roots/hit.c) in each rounding mode.  library/test_batch.c compares the angles of
 * all lanes.  CYLINT_CASES is the number of points.
 */
#define CYLINT_ONE_LANE
#include <math.h>
#include <stdint.h>
#include <stdlib.h>

#include "check.h"
#include "environment.h"
#include "numbers/error_bounds.h"
#include "roots/roots.h"
#include "numbers/turns_lanes.h"
#include "draw.h"
#include "real.h"

enum { BITS = 220 };

static double radians(double turns)
{
    return turns * 6.283185307179586;
}

/* ----------------------------------------------------------- constants -- */

static void check_pair(real x, double hi, double lo, const char *name, int k)
{
    const double wanted = near_double(x);
    const double wanted_lo = near_double(minus(x, real_of(wanted)));
    if (!CHECK(hi == wanted && lo == wanted_lo))
        REPORT("%s %d must be %a, %a", name, k, wanted, wanted_lo);
}

TEST(nodes_are_cosines_and_sines_in_pairs)
{
    real_fixed(BITS);
    const real turn = times(real_of(2), real_pi());
    check_pair(over(real_of(1), turn), CYLINT_TURN_PER_RADIAN,
               CYLINT_TURN_PER_RADIAN_LO, "turns per radian", 0);
    for (int k = 0; k <= 32; k++) {
        const double *node = cylint_turn_node[k];
        const real angle = times(turn, real_of(k * 0x1p-8));
        check_pair(function_of(mpfr_cos, angle), node[0], node[1], "cosine", k);
        check_pair(function_of(mpfr_sin, angle), node[2], node[3], "sine", k);
    }
}

/* So |q| is at most the tangent of 0.637 nodes. */
TEST(the_node_is_nearer_than_0_637_nodes)
{
    double most = 0;
    for (int i = 0; i <= 100000; i++) {
        const double r = i * 1e-5;
        const double guess =
            256 * r * (CYLINT_TURN_SLOPE - CYLINT_TURN_CURVE * r);
        most = fmax(most, fabs(guess - 256 * atan(r) / radians(1)));
    }
    printf("note: a guess is within %.4f nodes\n", most);
    CHECK(most < 0.137);
    CHECK(tan(radians(0.637 / 256)) < CYLINT_TURN_TANGENT);
}

TEST(the_series_has_its_error)
{
    double most = 0;
    for (int i = 1; i <= 20000; i++) {
        real_fixed(BITS);
        const real q = real_of(CYLINT_TURN_TANGENT * i / 20000);
        const real qq = square_of(q), turn = times(real_of(2), real_pi());
        const real beyond =
            minus(over(function_of(mpfr_atan, q), q), real_of(1));
        real series = real_of(turn_series[0]);
        for (int k = 1; k < 4; k++)
            series = plus(times(series, qq), real_of(turn_series[k]));
        const real off = minus(over(beyond, times(turn, qq)), series);
        most = fmax(most, fabs(mpfr_get_d(off->x, RND)));
    }
    printf("note: error of the series over its bound: %.3f\n",
           most / CYLINT_TURN_SERIES);
    CHECK(most <= CYLINT_TURN_SERIES);
}

/* -------------------------------------------------------------- points -- */

/* lo is up to eight units in the last place of hi. */
static pair untrimmed(double hi)
{
    return (pair){hi, one_of(4) ? between(-1, 1) * hi * 0x1p-50 : 0};
}

/* 0, or either sign and down to 2^-n, about. */
static double any_small(int n)
{
    if (one_of(8) == 0)
        return 0;
    const double x = between(-1, 1);
    return ldexp(x, -one_of(n));
}

/* Near a multiple of 1/512 turns: a node, between two, an axis, a diagonal. */
static void near_a_node(double *x, double *y)
{
    const double a = radians(one_of(512) / 512.0);
    const double off = any_small(60);
    *x = cos(a) - off * sin(a);
    *y = sin(a) + off * cos(a);
}

static void near_an_axis(double *x, double *y)
{
    *x = one_of(2) ? between(-1, 1) : -1;
    *y = any_small(400);
}

typedef struct {
    pair x, y;
    double ex, ey;
} turn_point;

static turn_point any_point(void)
{
    double x, y;
    switch (one_of(8)) {
    case 0:
    case 1:
        x = between(-1, 1), y = between(-1, 1);
        break;
    case 2: /* a diagonal */
        x = between(-1, 1), y = one_of(2) ? x : -x;
        y *= 1 + one_of(3) * 0x1p-52;
        break;
    case 3:
        x = one_of(41) - 20, y = one_of(41) - 20;
        break;
    case 4:
        near_an_axis(&x, &y);
        break;
    default:
        near_a_node(&x, &y);
    }
    if (x == 0 && y == 0)
        x = 1;
    const int swap = one_of(2), far = one_of(4) ? 0 : one_of(2) ? 390 : -390;
    x = fabs(x) < 0x1p-400 ? 0 : ldexp(x, far > 0 || fabs(x) > 0.1 ? far : 0);
    y = fabs(y) < 0x1p-400 ? 0 : ldexp(y, far > 0 || fabs(y) > 0.1 ? far : 0);
    const pair p = untrimmed(swap ? y : x), q = untrimmed(swap ? x : y);
    return (turn_point){p, q, 0, 0};
}

/* The angle of a point, with three doubles. */
typedef struct {
    double head, middle, tail;
} true_turn;

static true_turn turn_of(const turn_point *p)
{
    const int gap = abs(ilogb(p->x.hi == 0 ? p->y.hi : p->x.hi) -
                        ilogb(p->y.hi == 0 ? p->x.hi : p->y.hi));
    real_fixed(BITS + gap); /* from an axis */
    const real turn =
        real_turns(plus(real_of(p->x.hi), real_of(p->x.lo)),
                   plus(real_of(p->y.hi), real_of(p->y.lo)), BITS + gap);
    true_turn t;
    t.head = near_double(turn);
    const real rest = minus(turn, real_of(t.head));
    t.middle = near_double(rest);
    t.tail = near_double(minus(rest, real_of(t.middle)));
    return t;
}

static double error_of(pair turn, const true_turn *t)
{
    return fabs((turn.hi - t->head) + ((turn.lo - t->middle) - t->tail));
}

/* Moves x by at most `size`, and *e to how far it is moved. */
static pair moved(pair x, double size, double *e)
{
    const double by = one_of(3) ? size : size * between(-1, 1);
    const pair to = two_sum(x.hi, x.lo + (one_of(2) ? by : -by));
    *e = fabs((to.hi - x.hi) + (to.lo - x.lo)) * (1 + 0x1p-50);
    return *e < 0x1p-500 ? (*e = 0, x) : to;
}

/* Inexact in one coordinate or both, relative to it or to the other. */
static turn_point inexact(turn_point p)
{
    const double far = hypot(p.x.hi, p.y.hi), most = ldexp(far, -one_of(110));
    turn_point q = p;
    if (one_of(4))
        q.x = moved(p.x, one_of(2) ? most : most * fabs(p.x.hi) / far, &q.ex);
    if (one_of(4))
        q.y = moved(p.y, one_of(2) ? most : most * fabs(p.y.hi) / far, &q.ey);
    return q.x.hi == 0 && q.y.hi == 0 ? p : q;
}

/* -------------------------------------------------------------- angles -- */

/* The error over its bound; 0 if there is no bound. */
static double judge_lanes(const turn_point *p, const true_turn *truth,
                          double *bound)
{
    const vpair x = {p->x.hi, p->x.lo}, y = {p->y.hi, p->y.lo};
    const vpair turn = turns_of(x, y, p->ex, p->ey, bound);
    const double error = error_of((pair){turn.hi, turn.lo}, truth);
    if (!CHECK(error <= *bound && turn.hi + turn.lo == turn.hi))
        REPORT("atan2(%a + %a, %a + %a), errors %a and %a: %a + %a, error %g "
               "of %g",
               p->y.hi, p->y.lo, p->x.hi, p->x.lo, p->ey, p->ex, turn.hi,
               turn.lo, error, *bound);
    return error > 0 && *bound < 1 ? error / *bound : 0;
}

/* The largest error over its bound of all rounding modes. */
static double judge_exact_numbers(const turn_point *p, const true_turn *truth)
{
    static cylint_arena arena;
    double worst = 0;
    for (int m = 0; m < ROUNDINGS; m++) {
        fesetround(roundings[m]);
        cylint_arena_open(&arena);
        const exact x = cylint_exact_of_sum(&arena, p->x.hi, p->x.lo),
                    y = cylint_exact_of_sum(&arena, p->y.hi, p->y.lo);
        const pair turn =
            cylint_exact_round(&arena, cylint_angle(&arena, x, y));
        fesetround(FE_TONEAREST);
        const double error = error_of(turn, truth),
                     bound = CYLINT_ANGLE_ERROR * truth->head;
        if (!CHECK(error <= bound))
            REPORT("mode %d: atan2(%a + %a, %a + %a): %a + %a", m, p->y.hi,
                   p->y.lo, p->x.hi, p->x.lo, turn.hi, turn.lo);
        worst = fmax(worst, error > 0 ? error / bound : 0);
    }
    return worst;
}

TEST(angles_have_their_bounds)
{
    const uint64_t cases = check_setting("CYLINT_CASES", 1 << 17);
    double worst[3] = {0, 0, 0}, largest = 0, bound;
    for (uint64_t n = 0; n < cases; n++) {
        const turn_point p = any_point();
        const true_turn truth = turn_of(&p);
        const turn_point moved = inexact(p);
        worst[0] = fmax(worst[0], judge_lanes(&p, &truth, &bound));
        largest = fmax(largest, bound);
        worst[1] = fmax(worst[1], judge_lanes(&moved, &truth, &bound));
        worst[2] = fmax(worst[2], judge_exact_numbers(&p, &truth));
    }
    printf("note: error over its bound: exact points %.3f, inexact %.3f, exact "
           "numbers %.3f; largest bound of exact points 2^%.2f\n",
           worst[0], worst[1], worst[2], log2(largest));
    CHECK(log2(largest) < -72.3);
}
