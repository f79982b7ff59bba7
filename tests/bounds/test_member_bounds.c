/*
 * test_member_bounds.c - floor filter: the bounds of members.h and describe.h
 * against the oracle
 *
 * Computes the members of hits of random lines with random shapes, as one.c does,
 * and compares them with those of the oracle.  The root given to members.h errs by
 * at most its error, often by all of it.  Each note has the largest error of a
 * number over its bound, which must be at most 1.  A bound 0 is that of an exact
 * number.
 *
 * Shapes and lines are those of the families.  CYLINT_CASES is the number of hits.
 */
#define CYLINT_NARROW
#define CYLINT_SIGN_ON_LINE cylint_sign_on_line_plain
#include "numbers/simd.h"

#if LANES == 2
#include <math.h>
#include <stdint.h>

#include "check.h"
#include "families.h"
#include "filter/describe.h"
#include "draw.h"
#include "oracle.h"
#include "true_shape.h"

enum { BITS = 448, ROOTS = 6 }; /* roots given of each hit */

/* --------------------------------------------------------------- truth -- */

/* Everything true of a hit.  Local coordinates as in local.h.  The part of a sphere
 * is the lateral surface. */
static struct {
    true_shape shape;
    const oracle_hit *hit;
    int part, is_on_ball, has_normal;
    vector at; /* local coordinates */
    real radius;
} the;

static void set_true_hit(const cylint_shape *s, const cylint_answer *a, int i)
{
    const int solid = cylint_prepared(s), ball = solid == CYLINT_SOLID_SPHERE;
    vector q;
    the.hit = oracle_real_hit(i);
    the.part = ball ? CYLINT_PART_LATERAL : a->hit[i].part;
    the.is_on_ball = ball || (the.part != CYLINT_PART_LATERAL &&
                              cylint_solid_is_round(solid));
    for (int j = 0; j < 3; j++)
        q[j] = minus(the.hit->point[j], real_of(cylint_base(s)[j]));
    for (int j = 0; j < 3; j++)
        the.at[j] = dot(the.shape.row[j], q);
    the.radius = real_of(cylint_r0(s));
    if (s->kind == CYLINT_KIND_RCONE)
        the.radius = over(the.radius, the.shape.cosine);
    the.radius = plus(the.radius, times(the.shape.slope, the.at[2]));
    the.has_normal = the.is_on_ball || the.part != CYLINT_PART_LATERAL ||
                     sign_of(the.radius) != 0;
}

/* Whether t is 0 or within the range of roots. */
static int is_in_range(real root)
{
    const double t = fabs(mpfr_get_d(root->x, RND));
    return t == 0 || (t < CYLINT_WINDOW && t > 1 / CYLINT_WINDOW);
}

/* --------------------------------------------------------------- judge -- */

/* of_pair: where the root errs less than a pair.  Bounds add up all roundings, so
 * it is below `share`; beyond it a bound lacks a factor. */
typedef struct {
    const char *name;
    double share, worst, of_pair;
    long n;
    int is_normal;
} number;
static int root_is_pair;

static number X = {"local x", 0x1p-5, 0, 0, 0, 0},
              Y = {"local y", 0x1p-5, 0, 0, 0, 0},
              Z = {"local z", 0x1p-5, 0, 0, 0, 0},
              RHO = {"rho", 0x1p-6, 0, 0, 0, 0},
              POINT = {"point", 0x1p-1, 0, 0, 0, 0},
              OF_LATERAL = {"normal, lateral", 0x1p-4, 0, 0, 0, 1},
              OF_SKEW = {"normal, skew rows", 0x1p-5, 0, 0, 0, 1},
              OF_BALL = {"normal, ball", 0x1p-4, 0, 0, 0, 1},
              OF_PLANE = {"normal, plane", 0x1p-7, 0, 0, 0, 1},
              OF_SKEW_PLANE = {"normal, skew plane", 0x1p-8, 0, 0, 0, 1},
              HEIGHT = {"z", 0x1p-4, 0, 0, 0, 0}, PHI = {"phi", 1, 0, 0, 0, 0},
              ROOT = {"nearer_root()", 1, 0, 0, 0, 0};

static const struct family_case *case_now;

/* hi + lo against the true number, with the bound in units.  At an apex there
 * is no normal, and angles and normals are NaN, or their bounds are: then
 * nothing is certain.  Bounds of normals are of first order: a larger one makes
 * nothing certain either. */
static void judge_number(number *x, int component, double hi, double lo,
                         double bound, real truth)
{
    const double size = fabs(hi + lo);
    if (!(bound < HUGE_VAL) || !(size < HUGE_VAL) ||
        (x->is_normal && (!the.has_normal || bound * CYLINT_MEMBER_UNIT >
                                                 CYLINT_FIRST_ORDER * size)))
        return;
    const real off = minus(minus(truth, real_of(hi)), real_of(lo));
    const double size_of_off = fabs(mpfr_get_d(off->x, MPFR_RNDA));
    const double error = /* 0: that of the truth can be larger */
        sign_of(off) ? size_of_off / CYLINT_MEMBER_UNIT : 0;
    const double ratio = error == 0 ? 0 : error / bound;
    x->n++;
    x->worst = fmax(x->worst, ratio);
    if (root_is_pair)
        x->of_pair = fmax(x->of_pair, ratio);
    if (!CHECK(ratio <= 1)) {
        REPORT("%s %d: %g; part %d, t %a", x->name, component, ratio, the.part,
               mpfr_get_d(the.hit->t->x, RND));
        REPORT_CASE(case_now);
    }
}

static void judge_pairs(number *x, int component, const bounded_pairs *pairs,
                        real truth)
{
    double hi[LANES], lo[LANES], e[LANES];
    v_store(hi, pairs->v.hi);
    v_store(lo, pairs->v.lo);
    v_store(e, pairs->e);
    judge_number(x, component, hi[0], lo[0], e[0], truth);
}

static number *normal_now(void)
{
    const int skew = cylint_has_skew_rows(case_now->shape.kind);
    return the.is_on_ball                    ? &OF_BALL
           : the.part != CYLINT_PART_LATERAL ? skew ? &OF_SKEW_PLANE : &OF_PLANE
           : skew                            ? &OF_SKEW
                                             : &OF_LATERAL;
}

static void judge_members(const source *from, const pair_line *in,
                          const hit_root *r, int solid)
{
    const int ball = solid == CYLINT_SOLID_SPHERE;
    const local_hit h = hit_at(from, in, r, solid);
    bounded_pairs x[3];
    judge_pairs(&X, 0, &h.x, the.at[0]);
    judge_pairs(&Y, 1, &h.y, the.at[1]);
    judge_pairs(&Z, 2, &h.z, the.at[2]);
    if (!ball)
        judge_pairs(&RHO, 0, &h.rho, the.radius);
    normal_of(x, &h, from, r, solid);
    for (int j = 0; j < 3; j++)
        judge_pairs(normal_now(), j, &x[j], the.hit->normal[j]);
    if (ball)
        return;
    x[0] = height_share(&h, from);
    x[1] = angle_of(&h, from);
    judge_pairs(&HEIGHT, 0, &x[0], the.hit->z);
    judge_pairs(&PHI, 0, &x[1], the.hit->phi);
}

static void judge_point(const source *from, const hit_root *r, int solid)
{
    bounded_pairs x[3];
    point_of(x, from, r, solid);
    for (int j = 0; j < 3; j++) {
        judge_pairs(&POINT, j, &x[j], the.hit->point[j]);
    }
}

/* The true root, wrong by at most the error that it returns. */
static hit_root any_root(void)
{
    double t = mpfr_get_d(the.hit->t->x, RND);
    if (t != 0 && one_of(4) == 0) /* an end of step_from() */
        t = nextafter(t, one_of(2) ? HUGE_VAL : -HUGE_VAL);
    const real low = minus(the.hit->t, real_of(t));
    double tail = mpfr_get_d(low->x, RND);
    const double error = one_of(4) ? ldexp(t, -54 - one_of(60)) : 0;
    tail += one_of(3) ? (one_of(2) ? error : -error) : error * between(-1, 1);
    const double most = off_by(low, tail, 0);
    root_is_pair = error == 0;
    return (hit_root){v_set(t), v_set(tail),
                      v_set(one_of(2) ? most : fmax(most, fabs(error))),
                      m_from(the.part != CYLINT_PART_LATERAL ? 3 : 0),
                      m_from(the.part == CYLINT_PART_CAP1 ? 3 : 0)};
}

/* The root after a step of Newton's from there. */
static void judge_step(const source *from, const pair_line *in, hit_root r,
                       int solid)
{
    double tail[LANES], error[LANES];
    const vd before = r.error;
    r = nearer_root(&r, from, in, v_first(direction_bound(from)), solid);
    v_store(tail, r.tail);
    v_store(error, v_set(1 / CYLINT_MEMBER_UNIT) * r.error);
    if (v_first(r.error) < v_first(before))
        judge_number(&ROOT, 0, tail[0], 0, error[0],
                     minus(the.hit->t, real_of(v_first(r.t))));
}

/* ---------------------------------------------------------------- test -- */

static void judge_hit(const source *from)
{
    const int solid = cylint_prepared(from->shape);
    pair_line in;
    load_pairs(&in, from, 1, solid);
    for (int k = 0; k < ROOTS; k++) {
        const hit_root r = any_root();
        judge_point(from, &r, solid);
        judge_members(from, &in, &r, solid);
        judge_step(from, &in, r, solid);
    }
}

TEST(errors_of_members_are_within_their_bounds)
{
    const uint64_t hits = check_setting("CYLINT_CASES", 1 << 17);
    uint64_t n = 0;
    for (uint64_t i = 0; n < hits; i++)
        for (int family = 0; family < family_count(); family++) {
            struct family_case c;
            cylint_answer a;
            family_case(24, family, i, &c);
            c.line = whole_of(c.line);
            const source from = {&c.shape, &c.line};
            if (family_is_wild(family) || !cylint_prepared(&c.shape) ||
                !c.line.in_range || has_tiny_numbers(&from))
                continue;
            case_now = &c;
            real_fixed(BITS);
            set_true_shape(&the.shape, &c.shape);
            oracle_intersect(&c.shape, &c.line, CYLINT_WANT_ALL, &a);
            for (int k = 0; k < a.n; k++) {
                set_true_hit(&c.shape, &a, k);
                if (is_in_range(the.hit->t)) {
                    judge_hit(&from);
                    n += ROOTS;
                }
            }
        }
}

TEST(each_number_was_compared_and_had_an_error_of_its_share)
{
    (void)describe_known;
    static const number *const all[] = {
        &X,          &Y,       &Z,       &RHO,      &POINT,
        &OF_LATERAL, &OF_SKEW, &OF_BALL, &OF_PLANE, &OF_SKEW_PLANE,
        &HEIGHT,     &PHI,     &ROOT};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        printf(
            "note: %-18s error over its bound: %.6f, of a root in pairs %.3g; "
            "%ld\n",
            all[i]->name, all[i]->worst, all[i]->of_pair, all[i]->n);
        CHECK(all[i]->worst > 0 && all[i]->n > 0 &&
              all[i]->of_pair <= all[i]->share);
    }
}

#else

#include "program.h"

int main(void)
{
    return check_skip("no vectors of two doubles");
}

#endif
