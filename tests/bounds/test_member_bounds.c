/*
 * test_member_bounds.c - floor filter: the bounds of members.h and describe.h
 * against MPFR
 *
 * Computes the members of hits of random lines with random shapes, as one.c does,
 * and in MPFR from the numbers that a shape is made of and the exact root.  The
 * root given to members.h errs by at most its error, often by all of it.  Each note
 * has the largest error of a number over its bound, which must be at most 1.  A
 * bound 0 is that of an exact number.
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
#include "true_shape.h"

enum { BITS = 448, ROOTS = 12 };

/* --------------------------------------------------------------- truth -- */

/* Everything true.  Local coordinates as in local.h. */
static struct {
    true_shape shape;
    vector d, p, v; /* p: the line's origin, v: its direction, local */
    real r0, r1, rho, growth;
    int has_normal;
    vector at, point, normal; /* of the hit; at: local coordinates */
    real t, radius, z, phi;
} the;

static void set_true_line(const cylint_shape *s, const cylint_line *line)
{
    const true_shape *of = &the.shape;
    vector q;
    set_difference(q, line->o, cylint_base(s));
    for (int j = 0; j < 3; j++)
        the.d[j] = plus(real_of(line->d[j]), real_of(line->d_lo[j]));
    for (int i = 0; i < 3; i++) {
        the.p[i] = dot(the.shape.row[i], q);
        the.v[i] = dot(the.shape.row[i], the.d);
    }
    the.r0 = real_of(cylint_r0(s));
    the.r1 = real_of(cylint_r1(s));
    the.rho = s->kind == CYLINT_KIND_RCONE ? over(the.r0, of->cosine) : the.r0;
    the.rho = plus(the.rho, times(of->slope, the.p[2]));
    the.growth = times(of->slope, the.v[2]);
}

/* A surface of the shape: the lateral one, or that of an end. */
typedef struct {
    int on_end, top, ball;
} surface;

static surface any_surface(int solid)
{
    const int ball = solid == CYLINT_SOLID_SPHERE;
    surface f = {0, 0, ball};
    if (!ball && cylint_solid_is_bounded(solid) && one_of(2)) {
        f.on_end = 1;
        f.top = one_of(2);
        f.ball = cylint_solid_is_round(solid);
    }
    return f;
}

/* z from the plane or the centre of the end. */
static real above_end(real z, const surface *f)
{
    return f->top ? minus(z, the.shape.height) : z;
}

/* x x' + y y' + sign u u' of two vectors, where u is the surface's last term: rho
 * of the lateral one, z of a ball. */
static real form(const surface *f, vector x, real rho, vector y, real rho2)
{
    const real flat = plus(times(x[0], y[0]), times(x[1], y[1]));
    return f->ball ? plus(flat, times(x[2], y[2]))
                   : minus(flat, times(rho, rho2));
}

/* Sets the.t to a root; returns whether there is one. */
static int set_true_root(const surface *f, int solid, int second)
{
    vector p = {the.p[0], the.p[1], above_end(the.p[2], f)};
    real a = the.v[2], b = p[2];
    if (!f->on_end || f->ball) {
        const real r =
            f->top && cylint_solid_is_tapered(solid) ? the.r1 : the.r0;
        real c = form(f, p, the.rho, p, the.rho);
        if (f->ball)
            c = minus(c, square_of(r));
        a = form(f, the.v, the.growth, the.v, the.growth);
        b = form(f, p, the.rho, the.v, the.growth);
        const real D = minus(square_of(b), times(a, c));
        if (sign_of(D) < 0)
            return 0;
        b = second ? plus(b, root_of(D)) : minus(b, root_of(D));
    }
    if (sign_of(a) == 0)
        return 0;
    the.t = negated(over(b, a));
    const double t = fabs(mpfr_get_d(the.t->x, RND));
    return t == 0 || (t < CYLINT_WINDOW && t > 1 / CYLINT_WINDOW);
}

/* from + t by */
static real at_t(real from, real by)
{
    return plus(from, times(the.t, by));
}

static void set_true_normal(const surface *f)
{
    const int plane = f->on_end && !f->ball;
    const real along = plane     ? real_of(f->top ? 1 : -1)
                       : f->ball ? above_end(the.at[2], f)
                                 : negated(times(the.shape.slope, the.radius));
    scale(the.normal, along, the.shape.row[2]);
    for (int i = 0; i < 2 && !plane; i++)
        for (int j = 0; j < 3; j++)
            the.normal[j] =
                plus(the.normal[j], times(the.at[i], the.shape.row[i][j]));
    the.has_normal = sign_of(norm(the.normal)) != 0;
    divide(the.normal, the.normal, norm(the.normal));
}

static void set_true_hit(const cylint_shape *s, const cylint_line *line,
                         const surface *f)
{
    const int sign = cylint_is_elliptic(s->kind) ? 1 : -1;
    for (int i = 0; i < 3; i++) {
        the.at[i] = at_t(the.p[i], the.v[i]);
        the.point[i] = at_t(real_of(line->o[i]), the.d[i]);
    }
    the.radius = at_t(the.rho, the.growth);
    set_true_normal(f);
    if (s->kind == CYLINT_KIND_SPHERE)
        return;
    the.z = over(the.at[2], the.shape.height);
    the.phi = real_turns(times(real_of(sign), the.at[0]),
                         times(real_of(sign), the.at[1]), BITS);
}

/* --------------------------------------------------------------- judge -- */

typedef struct {
    const char *name;
    double worst, of_pair; /* of_pair: where the root errs less than a pair */
    long n;
    int is_normal;
} number;
static int root_is_pair;

static number X = {"local x", 0, 0, 0, 0}, Y = {"local y", 0, 0, 0, 0},
              Z = {"local z", 0, 0, 0, 0}, RHO = {"rho", 0, 0, 0, 0},
              POINT = {"point", 0, 0, 0, 0},
              OF_SIDE = {"normal, lateral", 0, 0, 0, 1},
              OF_SKEW = {"normal, skew rows", 0, 0, 0, 1},
              OF_BALL = {"normal, ball", 0, 0, 0, 1},
              OF_PLANE = {"normal, plane", 0, 0, 0, 1},
              OF_SKEW_PLANE = {"normal, skew plane", 0, 0, 0, 1},
              HEIGHT = {"z", 0, 0, 0, 0}, PHI = {"phi", 0, 0, 0, 0},
              ROOT[2] = {{"root_beside(), 1st", 0, 0, 0, 0},
                         {"root_beside(), 2nd", 0, 0, 0, 0}};

static const struct family_case *case_now;
static const surface *surface_now;

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
    const double error = off_by(truth, hi, lo) / CYLINT_MEMBER_UNIT;
    const double ratio = error == 0 ? 0 : error / bound;
    x->n++;
    x->worst = fmax(x->worst, ratio);
    if (root_is_pair)
        x->of_pair = fmax(x->of_pair, ratio);
    if (!CHECK(ratio <= 1)) {
        REPORT("%s %d: %g; end %d, top %d, t %a", x->name, component, ratio,
               surface_now->on_end, surface_now->top,
               mpfr_get_d(the.t->x, RND));
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

static number *normal_now(int solid)
{
    const int skew = cylint_has_skew_rows(case_now->shape.kind);
    return surface_now->ball ? &OF_BALL
           : surface_now->on_end && !cylint_solid_is_round(solid)
               ? skew ? &OF_SKEW_PLANE : &OF_PLANE
           : skew ? &OF_SKEW
                  : &OF_SIDE;
}

static void judge_members(const source *from, const pair_line *in,
                          const hit_root *r, int solid)
{
    const int ball = solid == CYLINT_SOLID_SPHERE;
    const local_hit h = hit_at(from, in, r, 1, solid);
    bounded_pairs x[3];
    judge_pairs(&X, 0, &h.x, the.at[0]);
    judge_pairs(&Y, 1, &h.y, the.at[1]);
    judge_pairs(&Z, 2, &h.z, the.at[2]);
    if (!ball)
        judge_pairs(&RHO, 0, &h.rho, the.radius);
    normal_of(x, &h, from, r, solid);
    for (int j = 0; j < 3; j++)
        judge_pairs(normal_now(solid), j, &x[j], the.normal[j]);
    if (ball)
        return;
    x[0] = height_share(&h, from);
    x[1] = angle_of(&h, from);
    judge_pairs(&HEIGHT, 0, &x[0], the.z);
    judge_pairs(&PHI, 0, &x[1], the.phi);
}

static void judge_point(const source *from, const hit_root *r, int solid)
{
    bounded_pairs x[3];
    point_of(x, from, r, solid);
    for (int j = 0; j < 3; j++) {
        const double *o = from->line->o, *d = from->line->d;
        /* far below each bound but 0, and above the roundings of the truth */
        const double size = fabs(o[j]) + fabs(v_first(r->t) * d[j]);
        x[j].e = x[j].e + v_set(0x1p-400 / CYLINT_MEMBER_UNIT * size);
        judge_pairs(&POINT, j, &x[j], the.point[j]);
    }
}

/* The members from an origin near the hit, of which the root is r - t - tail. */
static void judge_moved(const source *from, hit_root r, int solid)
{
    const double t = v_first(r.t), tail = v_first(r.tail);
    const double moved = one_of(2)   ? 0
                         : one_of(2) ? tail
                                     : tail * between(0, 2);
    pair_line in;
    load_moved_pairs(&in, from, t, moved, solid);
    r.t = v_set(0);
    r.tail = v_set(tail - moved);
    r.error = r.error + v_set(0x1p-52 * fabs(tail - moved));
    judge_members(from, &in, &r, solid);
}

/* The true root, wrong by at most the error that it returns. */
static hit_root any_root(const surface *f)
{
    double t = mpfr_get_d(the.t->x, RND);
    if (t != 0 && one_of(4) == 0) /* an end of step_from() */
        t = nextafter(t, one_of(2) ? HUGE_VAL : -HUGE_VAL);
    const real rest = minus(the.t, real_of(t));
    double tail = mpfr_get_d(rest->x, RND);
    const double error = one_of(4) ? ldexp(t, -54 - one_of(60)) : 0;
    tail += one_of(3) ? (one_of(2) ? error : -error) : error * between(-1, 1);
    const double most = off_by(rest, tail, 0);
    root_is_pair = error == 0;
    return (hit_root){v_set(t), v_set(tail),
                      v_set(one_of(2) ? most : fmax(most, fabs(error))),
                      m_from(f->on_end ? 3 : 0), m_from(f->top ? 3 : 0)};
}

static void judge_roots(const source *from, const surface *f, int solid)
{
    double error[LANES], tail = 0;
    const double t = mpfr_get_d(the.t->x, RND);
    const int part = !f->on_end ? CYLINT_PART_LATERAL
                     : f->top   ? CYLINT_PART_CAP1
                                : CYLINT_PART_CAP0;
    for (int step = 0; step < 2; step++) {
        pair_line in;
        load_moved_pairs(&in, from, t, tail, solid);
        const hit_root r = root_beside(from, &in, t, part, solid);
        v_store(error, v_set(1 / CYLINT_MEMBER_UNIT) * r.error);
        if (!(error[0] < HUGE_VAL))
            return;
        judge_number(&ROOT[step], 0, tail, v_first(r.tail), error[0],
                     minus(the.t, real_of(t)));
        tail += v_first(r.tail);
    }
}

/* ---------------------------------------------------------------- test -- */

static int judge_line(const struct family_case *c)
{
    const cylint_shape *s = &c->shape;
    const cylint_line *line = &c->line;
    const int solid = cylint_prepared(s);
    const source from = {s, line};
    const surface f = any_surface(solid);
    if (!set_true_root(&f, solid, one_of(2)))
        return 0;
    set_true_hit(s, line, &f);
    case_now = c;
    surface_now = &f;
    pair_line in;
    load_pairs(&in, &from, 1, solid);
    const hit_root r = any_root(&f);
    judge_point(&from, &r, solid);
    judge_members(&from, &in, &r, solid);
    judge_moved(&from, r, solid);
    judge_roots(&from, &f, solid);
    return 1;
}

TEST(errors_of_members_are_within_their_bounds)
{
    const uint64_t hits = check_setting("CYLINT_CASES", 1 << 17);
    uint64_t n = 0;
    for (uint64_t i = 0; n < hits; i++)
        for (int family = 0; family < family_count(); family++) {
            struct family_case c;
            family_case(24, family, i, &c);
            if (family_is_wild(family) || !cylint_prepared(&c.shape) ||
                !c.line.in_range ||
                has_tiny_numbers(&(source){&c.shape, &c.line}))
                continue;
            real_fixed(BITS);
            set_true_shape(&the.shape, &c.shape);
            set_true_line(&c.shape, &c.line);
            for (int k = 0; k < ROOTS; k++)
                n += (uint64_t)judge_line(&c);
        }
}

TEST(each_number_was_compared_and_had_an_error)
{
    (void)describe_again;
    (void)load_any_pairs;
    static const number *const all[] = {
        &X,       &Y,       &Z,       &RHO,      &POINT,
        &OF_SIDE, &OF_SKEW, &OF_BALL, &OF_PLANE, &OF_SKEW_PLANE,
        &HEIGHT,  &PHI,     &ROOT[0], &ROOT[1]};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        printf(
            "note: %-18s error over its bound: %.6f, of a root in pairs %.3g; "
            "%ld\n",
            all[i]->name, all[i]->worst, all[i]->of_pair, all[i]->n);
        CHECK(all[i]->worst > 0 && all[i]->n > 0);
    }
}

#else

#include "program.h"

int main(void)
{
    return check_skip("no vectors of two doubles");
}

#endif
