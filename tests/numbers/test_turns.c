/*
 * test_turns.c - turns.h and turns_lanes.h against MPFR
 *
 * Computes the nodes and constants again.  Measures the errors of angles over
 * their bounds: in lanes of every width, with and without fused multiply-add,
 * of exact and of inexact points, and from exact numbers (roots/hit.c) in each
 * rounding mode.  CYLINT_CASES is the number of points.
 */
#include <fenv.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>

#include "check.h"
#include "dispatch.h"
#include "numbers/error_bounds.h"
#include "roots/roots.h"
#include "numbers/turns_lanes.h"
#include "draw.h"
#include "real.h"
#include "turn_points.h"

enum { BITS = 220, BLOCK = 8192 };

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

/* --------------------------------------------------------------- lanes -- */

typedef struct {
    const char *name;
    turns_of_points *run;
    double exact, inexact, largest; /* errors over bounds; a bound */
} lanes_build;

static lanes_build builds[] = {
    {"plain", turns_plain, 0, 0, 0},
#ifdef CYLINT_BUILDS_X86
    {"one lane", turns_one, 0, 0, 0}, {"narrow, fused", turns_narrow, 0, 0, 0},
    {"avx2", turns_avx2, 0, 0, 0},    {"avx512", turns_avx512, 0, 0, 0},
#endif
};

/* How many of them this processor runs. */
static size_t build_count(void)
{
#ifdef CYLINT_BUILDS_X86
    return CYLINT_OF_BUILD(2, 4, 5);
#else
    return 1;
#endif
}

static turn_point exact_points[BLOCK], inexact_points[BLOCK];
static true_turn truth[BLOCK];
static turn_answer answers[BLOCK];

/* Returns the largest error over its bound. */
static double worst_of(lanes_build *b, const turn_point *p)
{
    double worst = 0;
    b->run(BLOCK, p, answers);
    for (int i = 0; i < BLOCK; i++) {
        const turn_answer *a = answers + i;
        const double error = error_of(a->turn, truth + i);
        if (!CHECK(error <= a->error && a->turn.hi + a->turn.lo == a->turn.hi))
            REPORT("%s: atan2(%a + %a, %a + %a), errors %a and %a: %a + %a, "
                   "error %g of %g",
                   b->name, p[i].y.hi, p[i].y.lo, p[i].x.hi, p[i].x.lo, p[i].ey,
                   p[i].ex, a->turn.hi, a->turn.lo, error, a->error);
        if (error > 0 && a->error < 1)
            worst = fmax(worst, error / a->error);
        if (p == exact_points)
            b->largest = fmax(b->largest, a->error);
    }
    return worst;
}

/* -------------------------------------------------------- exact numbers -- */

static const int modes[] = {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD,
                            FE_TOWARDZERO};
static double worst_exact;

static void judge_exact_numbers(void)
{
    static cylint_arena arena;
    for (int i = 0; i < BLOCK; i++) {
        const turn_point *p = exact_points + i;
        for (int m = 0; m < 4; m++) {
            fesetround(modes[m]);
            cylint_arena_open(&arena);
            const exact x = cylint_exact_of_sum(&arena, p->x.hi, p->x.lo),
                        y = cylint_exact_of_sum(&arena, p->y.hi, p->y.lo);
            const pair turn =
                cylint_exact_round(&arena, cylint_angle(&arena, x, y));
            fesetround(FE_TONEAREST);
            const double error = error_of(turn, truth + i);
            if (!CHECK(error <= CYLINT_ANGLE_ERROR * truth[i].head))
                REPORT("mode %d: atan2(%a + %a, %a + %a): %a + %a", m, p->y.hi,
                       p->y.lo, p->x.hi, p->x.lo, turn.hi, turn.lo);
            if (error > 0)
                worst_exact = fmax(worst_exact, error / truth[i].head);
        }
    }
}

TEST(angles_have_their_bounds)
{
    const uint64_t cases = check_setting("CYLINT_CASES", 1 << 17);
    for (uint64_t n = 0; n < cases; n += BLOCK) {
        for (int i = 0; i < BLOCK; i++) {
            exact_points[i] = any_point();
            truth[i] = turn_of(exact_points + i);
            inexact_points[i] = inexact(exact_points[i]);
        }
        for (size_t k = 0; k < build_count(); k++) {
            lanes_build *b = builds + k;
            b->exact = fmax(b->exact, worst_of(b, exact_points));
            b->inexact = fmax(b->inexact, worst_of(b, inexact_points));
        }
        judge_exact_numbers();
    }
    for (size_t k = 0; k < build_count(); k++) {
        const lanes_build *b = builds + k;
        printf("note: %-13s error over its bound: exact points %.3f, inexact "
               "%.3f; largest bound 2^%.2f\n",
               b->name, b->exact, b->inexact, log2(b->largest));
        CHECK(b->exact <= 1 && b->inexact <= 1);
        CHECK(log2(b->largest) < -72.3);
    }
    printf("note: exact numbers, error over its bound: %.3f\n",
           worst_exact / CYLINT_ANGLE_ERROR);
}
