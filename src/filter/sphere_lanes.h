/*
 * sphere_lanes.h - balls and spheres in lanes
 *
 * The forms are those of a ball in local coordinates (local_forms_template.h),
 * which are here the world's.  The bounds on errors are in error_bounds.h.
 */
#ifndef CYLINT_SPHERE_LANES_H
#define CYLINT_SPHERE_LANES_H

#include "lanes.h"

/* The two numbers of local_forms_template.h, of every lane. */
typedef struct {
    vd a, b;
} vtwo;

#define EACH_OF_TWO(x, y) ((vtwo){(x), (y)})
#define V vtwo
#define FORM(name) name##_many
#define ADD(x, y) EACH_OF_TWO((x).a + (y).a, (x).b + (y).b)
#define SUB(x, y) EACH_OF_TWO((x).a - (y).a, (x).b - (y).b)
#define MUL(x, y) two_times(x, y)
#define SUM_OF(x, y, z) two_sum_of(x, y, z)
#define NEGATED(x) two_negated(x)
#define TRIMMED(x) (x)
#define SUMS(x, y) two_sums(x, y)
#define TURNED(x) two_turned(x)
#define FIRSTS(x) two_firsts(x, x)
#define PAIRED(x, y) two_firsts(x, y)

INLINE vtwo two_times(vtwo x, vtwo y)
{
    return EACH_OF_TWO(x.a * y.a, x.b * y.b);
}

INLINE vtwo two_sum_of(vtwo x, vtwo y, vtwo z)
{
    return EACH_OF_TWO(v_sum_of(x.a, y.a, z.a), v_sum_of(x.b, y.b, z.b));
}

INLINE vtwo two_negated(vtwo x)
{
    return EACH_OF_TWO(-x.a, -x.b);
}

INLINE vtwo two_sums(vtwo x, vtwo y)
{
    return EACH_OF_TWO(x.a + x.b, y.a + y.b);
}

INLINE vtwo two_turned(vtwo x)
{
    return EACH_OF_TWO(x.b, x.a);
}

INLINE vtwo two_firsts(vtwo x, vtwo y)
{
    return EACH_OF_TWO(x.a, y.a);
}

INLINE vtwo two_of(vd x)
{
    return EACH_OF_TWO(x, x);
}

#include "local_forms_template.h"

#include "round_residual_lanes.h"

/* Of both roots in each lane.  The operations on one alternate with those on
 * the other, so that neither waits for its own results. */
typedef struct {
    vtwo hi, lo;
} vtwo_pair;

INLINE vtwo_pair pair_of_two(vpair a, vpair b)
{
    return (vtwo_pair){EACH_OF_TWO(a.hi, b.hi), EACH_OF_TWO(a.lo, b.lo)};
}

INLINE vtwo_pair both_pairs(vd hi, vd lo)
{
    return (vtwo_pair){two_of(hi), two_of(lo)};
}

INLINE vtwo two_plus(vtwo x, vtwo y)
{
    return EACH_OF_TWO(x.a + y.a, x.b + y.b);
}

INLINE vtwo two_minus(vtwo x, vtwo y)
{
    return EACH_OF_TWO(x.a - y.a, x.b - y.b);
}

#define V vtwo
#define PAIR vtwo_pair
#define FORM(name) name##_both
#define ADD(x, y) two_plus(x, y)
#define SUB(x, y) two_minus(x, y)
#define SUM_OF(x, y, z) two_sum_of(x, y, z)
#define NEGATED(x) two_negated(x)
#define RESULT(x, y, rest) two_plus(two_plus(x, y), rest)
#define TWO_SUM(x, y) \
    pair_of_two(v_two_sum((x).a, (y).a), v_two_sum((x).b, (y).b))
#define TWO_PROD(x, y) \
    pair_of_two(v_two_prod((x).a, (y).a), v_two_prod((x).b, (y).b))
#include "round_residual_template.h"

/* A ball of radius r in every lane, and the line from its centre.  No
 * coordinate of the direction exceeds D, none of the origin Q. */
typedef struct {
    line_many line;
    vd r, X, D, Q;
} lanes_ball;

INLINE lanes_ball ball_and_line(const vd center[3], vd r, const vd o[3],
                                const vd u[3])
{
    lanes_ball b;
    vd x[3];
    EACH(i, 3)
        x[i] = o[i] - center[i];
    b.line.p = (vtwo){x[0], x[1]};
    b.line.v = (vtwo){u[0], u[1]};
    b.line.z = two_of(x[2]);
    b.line.w = two_of(u[2]);
    b.r = r;
    b.X = v_largest(x);
    b.D = v_largest(u);
    b.Q = b.X + r;
    return b;
}

/* Twice the error of a rounding, and what rounds the bounds themselves. */
#define LANES_UNIT v_set(CYLINT_ROUNDING *CYLINT_SLACK)

INLINE bounded_value ball_g_of(const lanes_ball *b)
{
    const vd error =
        v_set(CYLINT_LOCAL_BALL) * LANES_UNIT * (b->D * b->D) *
        (b->Q * v_sum_of(v_set(CYLINT_LOCAL_SECOND) * LANES_UNIT, b->Q, b->r));
    return (bounded_value){one_ball_g_many(&b->line, b->line.z, two_of(b->r)).a,
                           error};
}

INLINE bounded_value ball_A_of(const lanes_ball *b)
{
    return (bounded_value){ball_A_many(&b->line).a,
                           v_set(CYLINT_LOCAL_A) * LANES_UNIT * b->D * b->D};
}

INLINE bounded_value ball_B_of(const lanes_ball *b)
{
    const balls_many ball = {b->line.z, two_of(b->r)};
    return (bounded_value){ball_B_many(&b->line, &ball).a,
                           v_set(CYLINT_LOCAL_FORM) * LANES_UNIT * b->Q * b->D};
}

/* A t + B. */
INLINE bounded_value ball_slope_at(const lanes_ball *b, double t)
{
    const vd size = v_sum_of(v_set(fabs(t)), b->D, b->Q);
    return (bounded_value){v_sum_of(v_set(t), ball_A_of(b).v, ball_B_of(b).v),
                           v_set(2 * CYLINT_LOCAL_FORM) * LANES_UNIT * size *
                               b->D};
}

/* Where no form over- or underflows. */
INLINE vm ball_in_window(const lanes_ball *b)
{
    const vd most = v_set(CYLINT_WINDOW), least = v_set(1 / CYLINT_WINDOW);
    return m_and(v_le(v_max(b->D, b->Q), most), v_le(least, b->D));
}

/* The lanes that pass by for certain. */
INLINE vm passes_ball(const lanes_ball *b)
{
    const bounded_value g = ball_g_of(b);
    return m_and(ball_in_window(b), v_lt(g.v, -g.e));
}

/* Relation and hits, and for rounding R and A of q, and the largest
 * components. */
INLINE lanes_verdict sphere_classify(lanes_slopes *q, const lanes_shape *s,
                                     const lanes_line *l, vm lanes)
{
    const vm none = m_from(0);
    const vd lateral = v_set(CYLINT_PART_LATERAL);
    const bounded_value nowhere = {v_set(0), v_set(0)};
    const lanes_ball b = ball_and_line(s->base, s->r[0], l->o, l->u);
    const bounded_value g = ball_g_of(&b);
    const vm window = ball_in_window(&b);
    const vm alive = m_and(lanes, m_not(m_and(window, v_lt(g.v, -g.e))));
    lanes_verdict v = {
        none, none, {none, none}, none, {nowhere, nowhere}, {lateral, lateral}};
    if (!m_any(alive))
        return v;

    const bounded_value A = ball_A_of(&b), B = ball_B_of(&b);
    const vd root = v_sqrt(g.v);
    const bounded_value R = {
        root, root * (g.e / g.v + v_set(CYLINT_RADICAL_ROUNDING))};
    const vm known = m_and(m_and(window, certain(A)),
                           v_lt(v_set(1 / CYLINT_RADICAND) * g.e, g.v));
    v.cross = m_and(alive, known);
    v.undecided = m_and(alive, m_not(known));
    EACH(i, 2) {
        const vd exits = v_set(i ? 1 : -1);
        const bounded_value numerator = {
            -B.v + exits * R.v, (B.e + R.e) * v_set(CYLINT_LANES_SLACK)};
        vm near;
        v.stop[i] = quotient(numerator, A);
        v.hit[i] = within_domain(v.stop[i], l->tmin, l->tmax, &near);
        v.undecided = m_or(v.undecided, m_and(v.cross, near));
    }
    v.cross = m_and(v.cross, m_not(v.undecided));
    v.hit[0] = m_and(v.hit[0], v.cross);
    v.hit[1] = m_and(v.hit[1], v.cross);
    *q = (lanes_slopes){R, nowhere, A.v, b.X, b.D, v_set(0), v_set(0)};
    return v;
}

/* Both roots, exits of the second only. */
INLINE void round_sphere_roots(lanes_root root[2], const lanes_slopes *q,
                               const lanes_shape *s, const lanes_line *l,
                               const bounded_value at[2])
{
    const vd r = s->r[0];
    const vtwo t = EACH_OF_TWO(at[0].v, at[1].v);
    vtwo_pair x[3];
    EACH(i, 3) {
        const vpair from = v_two_sum(l->o[i], -s->base[i]);
        x[i] = moved_both(both_pairs(from.hi, from.lo), t, two_of(l->u[i]),
                          two_of(l->u_lo[i]));
    }
    const vtwo residual = ball_residual_both(x, two_of(r));
    EACH(k, 2) {
        const vd size = v_sum_of(v_abs(at[k].v), q->u, q->D + r);
        root[k] = newton_root(
            k ? residual.b : residual.a,
            v_set(CYLINT_LOCAL_RESIDUAL * CYLINT_LOCAL_ERROR * CYLINT_SLACK) *
                size * size,
            v_set(k ? 2 : -2) * q->R.v, v_set(2) * q->R.e, q->A, at[k]);
    }
}

INLINE lanes_root round_sphere_root(const lanes_slopes *q, const lanes_shape *s,
                                    const lanes_line *l, vd exits,
                                    bounded_value t)
{
    const vd r = s->r[0];
    vpair x[3];
    EACH(i, 3)
        x[i] = moved_lanes(v_two_sum(l->o[i], -s->base[i]), t.v, l->u[i],
                           l->u_lo[i]);
    const vd size = v_sum_of(v_abs(t.v), q->u, q->D + r);
    return newton_root(
        ball_residual_lanes(x, r),
        v_set(CYLINT_LOCAL_RESIDUAL * CYLINT_LOCAL_ERROR * CYLINT_SLACK) *
            size * size,
        v_set(2) * exits * q->R.v, v_set(2) * q->R.e, q->A, t);
}

#endif
