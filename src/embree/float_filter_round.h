/*
 * float_filter_round.h - where a line enters a sphere, capsule or rounded cone
 *
 * For float_filter.c, in the notation of float_filter_lanes.h.  The cone that
 * touches both balls contains the solid, and touches ball 0 on the circle y = 0
 * and ball 1 on the circle y = S (signs/round_forms_template.h).  Along the line
 *
 *   y = y0 + s dz,  y0 = (D.w + r0 dr) / ww,  S = 1 - dr^2 / ww,
 *   Q = a s^2 + 2 b s + c,  negative inside of the cone,
 *   a = S uu - (u.w) dz,  b = S D.u - (D.w + r0 dr) dz,
 *   c = S (DD - r0^2) - (D.w + r0 dr) y0,  G = b^2 - a c,
 *   ball i: |x|^2 = r_i^2,  x = D or D - w.
 *
 * The line enters the solid where it enters the cone at y between 0 and S, or
 * ball 0 at y < 0, or ball 1 at y > S; it enters at most once.  If a > 0 and it
 * enters the cone at y < 0, then ball 0 decides: the solid's part of the cone at
 * y < 0 is in that ball, and the line cannot come to y > S without it.  All this
 * holds for leaving.
 *
 * Errors, where K = Dn + r0, and |dr| < W unless S is below its error:
 *
 *   D: 2 u Dn.  w: u W.  u.w: 4 u U W.  D.w: 6 u Dn W.  1 / ww: 6.1 u of it.
 *   dr: u of it.  D.w + r0 dr: 7 u K W.  y0: 14.2 u K / W.  dz: 11.2 u U / W.
 *   S: 11.2 u.  DD - r0^2: 8 u K^2.
 *   a: 32.4 u U^2.  b: 39.2 u K U.  c: 44.4 u K^2.
 *
 * As |a| <= U^2, |b| <= 2 K U and |c| <= 2 K^2, the error of G is less than
 * 35 eps K^2 U^2 with the roundings of b^2 - a c, and e_a = 8 eps U^2 and
 * e_G = 38 eps K^2 U^2 fit chord_end(): |b^2 - a c| <= 6 K^2 U^2, so the error of
 * b is less than 0.33 e_G / sqrt(G).
 *
 * Of a ball, with N = Dn or Dn + W, R = r0 + |dr| and K = N + R: x: 3 u N,
 * x.u: 6 u N U, |x|^2 - r^2: 15 u K^2, b^2 - uu c: 34 u K^2 U^2.  There
 * e_G = 6 eps K^2 U^2 and e_a = eps U^2 fit chord_end(): G <= R^2 U^2 but for its
 * error, so that of b is less than 0.14 e_G / sqrt(G).
 *
 * tests/bounds/test_embree_float_bounds.c computes these bounds from the forms.
 */
#ifndef CYLINT_EMBREE_FLOAT_FILTER_ROUND_H
#define CYLINT_EMBREE_FLOAT_FILTER_ROUND_H

#include "float_filter_lanes.h"

#define NUM vd
#define FORM(name) name
#define ADD(x, y) ((x) + (y))
#define SUB(x, y) ((x) - (y))
#define MUL(x, y) ((x) * (y))
#define SMALL(x) (x)
#include "round_forms_template.h"

/* The surfaces of a shape; of one between discs only the cone.  is_ball: it is a
 * sphere, which has no cone.  crosses: the line crosses the cone.
 * leans: a of the cone is certainly positive.  ball: the quadratic of the ball
 * that was hit. */
typedef struct {
    quadratic cone, ball;
    vd S, y0, K, R;
    vm is_ball, crosses, leans;
} surfaces;

/* Where y is: below 0, between 0 and S, above S, or none of these. */
typedef struct {
    vm below, between, above;
} range;

INLINE range range_of_y(const surfaces *x, const question *q, const hit *at)
{
    const vd X = x->K + v_abs(at->s) * q->U, y = x->y0 + at->s * q->dz;
    const vd e =
        at->s_error * v_abs(q->dz) + eps(3) * (X * q->per_W + v_set(1));
    return (range){v_lt(y, -e), m_and(v_lt(e, y), v_lt(y, x->S - e)),
                   v_lt(x->S + e, y)};
}

/* uncertain: products may underflow (see in_window()), or one ball may lie in the
 * other.  Neither: the line misses the cone. */
INLINE verdict cross_round(surfaces *x, question *q)
{
    const vd zero = v_set(0), least = v_set(0x1p-90);
    round_cone f;
    quadratic *c = &x->cone;
    x->is_ball = m_not(v_lt(zero, size(q->w)));
    x->R = q->r0 + v_abs(q->dr);
    q->Dn = v_sqrt(q->DD);
    x->K = q->Dn + q->r0;
    load_axis(q, v_select(x->is_ball, v_set(1), q->ww));
    const round_terms terms = {q->uu,     q->Du, q->DD, q->alpha, q->beta,
                               q->per_ww, q->r0, q->dr, v_set(1)};
    set_round_cone(&f, &terms);
    x->S = f.S;
    x->y0 = f.y0;
    c->a = f.a;
    c->b = f.b;
    c->e_a = eps(8) * q->uu;
    c->e_G = eps(38) * q->uu * (x->K * x->K);
    const vm window =
        m_and(in_window(q, x->R),
              m_or(x->is_ball, m_and(v_lt(least, q->W), v_lt(eps(8), x->S))));
    const vm hull = m_and_not(window, x->is_ball);
    const verdict v = cross_surface(c, f.G, hull);
    x->crosses = v.hit;
    x->leans = v_lt(v_set(8) * c->e_a, c->a);
    x->ball = *c;
    const vm misses = m_and_not(hull, m_or(v.hit, v.uncertain));
    return (verdict){m_and_not(window, misses), m_not(window)};
}

/* Where the line enters or leaves the ball about an end. */
INLINE verdict end_on_ball(const surfaces *x, const question *q, int top,
                           int end, quadratic *c, hit *at)
{
    vd DD = q->DD, r = q->r0, N = q->Dn;
    c->b = q->Du;
    if (top) {
        vd D1[3];
        EACH(j, 3)
            D1[j] = q->D[j] - q->w[j];
        DD = dot(D1, D1);
        c->b = dot(D1, q->u);
        r = q->r0 + q->dr;
        N = N + q->W;
    }
    const vd K = N + x->R;
    c->a = q->uu;
    c->e_G = eps(6) * q->uu * (K * K);
    c->e_a = eps(1) * q->uu;
    const verdict v =
        cross_surface(c, round_ball_G(q->uu, c->b, DD, r), m_not(m_none()));
    if (m_any(v.hit)) {
        *at = chord_end(c, q, end);
        at->z_error = v_select(x->is_ball, v_set(0), at->z_error);
        at->capped = m_not(x->is_ball);
        at->top = top ? at->capped : m_none();
    }
    return v;
}

/*
 * Where the line enters or leaves the solid.  A sphere's only surface is ball 0.
 * `sure` lanes know the ball.  The others take the cone and both balls in turn;
 * they miss the solid if each of these is missed, or is hit elsewhere.
 */
INLINE verdict end_on_round(surfaces *x, const question *q, int end, hit *at)
{
    range at_cone = {x->is_ball, m_none(), m_none()};
    *at = no_hit();
    if (m_any(x->crosses)) {
        *at = chord_end(&x->cone, q, end);
        const range r = range_of_y(x, q, at);
        at_cone.below = m_or(m_and(x->crosses, r.below), x->is_ball);
        at_cone.between = m_and(x->crosses, r.between);
        at_cone.above = m_and(x->crosses, r.above);
    }
    vm hits = at_cone.between, uncertain = m_none();
    const vm beyond = m_or(at_cone.below, at_cone.above);
    const vm sure = m_and(beyond, m_or(x->leans, x->is_ball));
    const vm either = m_not(m_or(hits, sure));
    vm misses = m_and(either, beyond);
    for (int top = 0; top < 2; top++) {
        quadratic c;
        hit ball = no_hit();
        const vm known = m_and(sure, top ? at_cone.above : at_cone.below);
        const vm mine = m_or(known, m_and_not(either, hits));
        if (!m_any(mine))
            continue;
        const verdict v = end_on_ball(x, q, top, end, &c, &ball);
        vm elsewhere = m_none();
        if (m_any(m_and(mine, v.hit))) {
            const range r = range_of_y(x, q, &ball);
            const vm comes =
                m_and(m_and(mine, v.hit), m_or(known, top ? r.above : r.below));
            elsewhere = m_and(v.hit, m_or(r.between, m_or(r.below, r.above)));
            select_hit(at, comes, &ball);
            select_quadratic(&x->ball, comes, &c);
            hits = m_or(hits, comes);
        }
        uncertain = m_or(uncertain, m_and(known, v.uncertain));
        misses = m_and(misses,
                       m_or(m_not(mine),
                            m_or(m_not(m_or(v.hit, v.uncertain)), elsewhere)));
    }
    uncertain = m_or(uncertain, m_and_not(either, m_or(hits, misses)));
    return (verdict){hits, uncertain};
}

INLINE vm is_on_ball(const surfaces *x, const hit *at)
{
    return m_or(at->capped, x->is_ball);
}

/* P from the centre of the ball of the hit, and the size of its terms. */
INLINE vd point_on_ball(const question *q, const hit *at, vd P[3])
{
    const vd zero = v_set(0);
    point_at(q, at, P);
    EACH(j, 3)
        P[j] = P[j] - v_select(at->top, q->w[j], zero);
    return q->Dn + v_abs(at->s) * q->U + v_select(at->top, q->W, zero);
}

/* A step of Newton's on the surface of a hit.  On a ball Q = |P|^2 - r^2; the
 * error of P is at most 6 u X, that of r 2 u R. */
INLINE void step_on_round(const surfaces *x, const question *q, int end,
                          hit *at)
{
    const vm on_ball = is_on_ball(x, at);
    const hit begin = *at;
    if (m_any(m_not(on_ball)))
        step_on_cone(&x->cone, q, x->S, end, at);
    if (m_any(on_ball)) {
        hit ball = begin;
        vd P[3];
        const vd r = v_select(at->top, q->r0 + q->dr, q->r0);
        const vd e_P = eps(1) * point_on_ball(q, &ball, P), PP = dot(P, P);
        const vd e_Q =
            e_P * (v_set(2) * size(P) + e_P) + eps(1) * (PP + x->R * x->R);
        step_to_root(&x->ball, q, end, PP - r * r, e_Q, &ball);
        ball.z_error = v_select(x->is_ball, v_set(0), ball.z_error);
        select_hit(at, on_ball, &ball);
    }
}

/* ---------------------------------------------------------- description -- */

/* The unit normal on the ball about an end: N = (x + s u) / r. */
INLINE bounded_vector ball_normal(const surfaces *x, const question *q,
                                  const hit *at)
{
    const vd zero = v_set(0);
    const vd r = v_select(at->top, q->r0 + q->dr, q->r0);
    bounded_vector to;
    const vd X = point_on_ball(q, at, to.N);
    const vd e = q->U * at->s_error + eps(1) * X;
    EACH(j, 3) {
        const vd w = v_select(at->top, q->w[j], zero);
        const vd sizes = v_abs(q->D[j]) + v_abs(at->s * q->u[j]) + v_abs(w);
        to.e[j] = v_select(v_lt(zero, sizes), e, zero);
    }
    to.per_length = v_set(1) / where_or_one(v_lt(zero, r), r);
    to.e_length = eps(1) * (x->R * v_abs(to.per_length) + v_set(1));
    return to;
}

/* The cone touches the ball of radius k = r0 + h dr about h w, h = y / S.  S has an
 * error of 11.2 u; the factor 1.1 covers products of errors. */
INLINE vm lean_on_round(const surfaces *x, const question *q, const hit *at,
                        vm lateral, bounded_vector *a)
{
    const vd one = v_set(1), X = x->K + v_abs(at->s) * q->U;
    const vd per_S = one / where_or_one(lateral, x->S);
    const vd h = (x->y0 + at->s * q->dz) * per_S;
    const vd e_h = v_set(1.1) * per_S *
                   (at->s_error * v_abs(q->dz) + eps(3) * (X * q->per_W + one));
    const vd k = q->r0 + h * q->dr;
    const vd e_k = e_h * v_abs(q->dr) + eps(1) * x->R;
    return lean_on_cone(q, k, e_k, k * q->ww, a);
}

#endif
