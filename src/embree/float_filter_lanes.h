/*
 * float_filter_lanes.h - where a line enters and leaves a shape
 *
 * For float_filter.c, one question in each lane.
 *
 * The error of a quantity `f` is at most `e_f`.  A rounding is u = 2^-53; eps =
 * 2^-50 is eight of them.  The errors of vectors are lengths: a cross product
 * has at most 2 / sqrt(3) of the errors of its products.
 *
 * The line is D + s u, the axis w, W = |w|; U and Dn are sizes of u and D, at
 * least their lengths, which take no roots.  With c = P x w, a cone is where
 *
 *   Q = S |c|^2 / ww - k^2 is negative,  k = r0 + dr z.
 *
 * Between discs k is the radius at z, and S = 1.  The cone of a round kind touches
 * both balls, of the radii r0 and r0 + dr, on the circles y = 0 and y = S, and
 * S = 1 - dr^2 / ww.  Along the line, where T = S + dr^2 / ww,
 *
 *   z = z0 + s dz,  z0 = D.w / ww,  dz = u.w / ww,
 *   y = y0 + s dz,  y0 = (D.w + r0 dr) / ww,
 *   Q = a s^2 + 2 b s + c,  a = S uu - T (u.w) dz,
 *   b = S D.u - (T D.w + r0 dr) dz,
 *   c = S DD - r0^2 - (T D.w + 2 r0 dr) z0,  G = b^2 - a c,
 *   ball i: |x|^2 = r_i^2,  x = D or D - w.
 *
 * The line enters a round solid where it enters the cone at y between 0 and S, or
 * ball 0 at y < 0, or ball 1 at y > S; it enters at most once.  If a > 0 and it
 * enters the cone at y < 0, then ball 0 decides: the solid's part of the cone at
 * y < 0 is in that ball, and the line cannot come to y > S without it.  If a < 0
 * and it enters the cone elsewhere, it enters the solid where it first enters a
 * ball.  All this holds for leaving.
 *
 * Errors, where K = Dn + r0 / sqrt(T), and |dr| < W unless S is below its error:
 *
 *   D: 2 u Dn.  w: u W.  u.w: 4 u U W.  D.w: 6 u Dn W.  1 / ww: 6.1 u of it.
 *   z0: 13.2 u Dn / W.  dz: 11.2 u U / W.  dr: u of it.
 *   S and y0 of round kinds: 12.1 u, 15.1 u K / W.  T between discs: 11.1 u of it.
 *   a: 35.2 u T U^2.  b: 40.2 u T K U.  c: 46.2 u T K^2.
 *
 * Of an angle cone w is exact and r0 is 0; dr is the tangent times W, with an error
 * of 3.5 u, but that of W cancels in dr^2 / ww: 8 u of T.
 *
 * As |a| <= T U^2, |b| <= T K U and |c| <= T K^2, the error of G is less than
 * 20.8 eps T^2 K^2 U^2 with the roundings of b^2 - a c.  So e_a = 8 eps T U^2 and
 * e_G = 24 eps T^2 K^2 U^2 fit chord_end(); T K^2 <= 5/4 (T DD + 4 r0^2).
 *
 * Of a ball, with N = Dn or Dn + W, R = r0 + |dr| and K = N + R: x: 3 u N,
 * x.u: 6 u N U, |x|^2 - r^2: 15 u K^2, b^2 - uu c: 34 u K^2 U^2.  There
 * e_G = 6 eps K^2 U^2 and e_a = eps U^2 fit chord_end(): G <= R^2 U^2 but for its
 * error, so that of b is less than 0.14 e_G / sqrt(G).
 *
 * tests/bounds/test_embree_float_bounds.c computes these bounds from the forms.
 *
 * Compiled as it is and again with fused multiply-add, which rounds less often:
 * the bounds hold either way.  Lanes that do not count divide by 1.
 */
#ifndef CYLINT_EMBREE_FLOAT_FILTER_LANES_H
#define CYLINT_EMBREE_FLOAT_FILTER_LANES_H

#include <float.h>
#include <stddef.h>

#include "../numbers/simd.h"
#include "shapes.h"

/* ------------------------------------------------------------ questions -- */

typedef cylint_float_filter_question question;

/* Q, whether the line certainly crosses its surface, and where: sqrt(G),
 * reciprocals of a and of that, errors. */
typedef struct {
    vd a, b, c, root, per_a, per_root, e_a, e_G;
    vm is, uncertain; /* neither: certainly not */
} quadratic;

/* The questions of the lanes; those that are not used repeat the first. */
typedef struct {
    question *of[LANES];
    unsigned used; /* bits of lanes */
    /* the line from the shape's base on: t = from + s */
    vd u[3], D[3], w[3], w_low[3], r0, dr, from;
    vd uu, Du, DD, ww, per_ww, U, Dn, W, per_W; /* per_W = W / ww */
    vd alpha, beta, z0, dz;                     /* D.w, u.w */
    vd S, T, y0, K, R;                          /* K: Dn + r0, R: r0 + |dr| */
    quadratic cone;
    vm is_angle; /* the shape is an angle cone: the record has w */
    vm is_ball;  /* the shape is a sphere, which has no cone */
    vm apart;    /* a < 0: Q < 0 before the first root and behind the second */
    vm within;   /* Q < 0 wherever z is that of a point of the shape */
    vm may, uncertain; /* the line may hit the shape; that is undecided */
} questions;

/* A hit at s and z with their errors.  at_end: on a cap or on the ball of an end;
 * top: of the top one. */
typedef struct {
    vd s, s_error, z, z_error;
    vm is, uncertain; /* neither: certainly no hit */
    vm at_end, top;
} hit;

/* n eps. */
INLINE vd eps(double n)
{
    return v_set(n * 0x1p-50);
}

INLINE vd v_dot(const vd x[3], const vd y[3])
{
    return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

INLINE vd size(const vd x[3])
{
    return v_abs(x[0]) + v_abs(x[1]) + v_abs(x[2]);
}

INLINE void v_cross(vd to[3], const vd x[3], const vd y[3])
{
    to[0] = x[1] * y[2] - x[2] * y[1];
    to[1] = x[2] * y[0] - x[0] * y[2];
    to[2] = x[0] * y[1] - x[1] * y[0];
}

INLINE vd where_or_one(vm where, vd x)
{
    return v_select(where, x, v_set(1));
}

/* Copies where *other is in the lanes `where`. */
INLINE void select_hit(hit *at, vm where, const hit *other)
{
    at->s = v_select(where, other->s, at->s);
    at->s_error = v_select(where, other->s_error, at->s_error);
    at->z = v_select(where, other->z, at->z);
    at->z_error = v_select(where, other->z_error, at->z_error);
    at->at_end = m_if(where, other->at_end, at->at_end);
    at->top = m_if(where, other->top, at->top);
}

/* Four numbers of each question, from `at` bytes on. */
INLINE void load_columns(const questions *q, size_t at, vd to[4])
{
    const char *row[LANES];
    for (int i = 0; i < LANES; i++)
        row[i] = (const char *)q->of[i];
    v_columns(row, at, to);
}

/*
 * Loads the shapes and the lines.  Moves the origin by from * u to `near`, so that
 * the errors are relative to the shape's size, wherever the ray begins.  u and
 * `from` have 24 bits each, so their product is exact.  The rounding error of
 * o - base is added again [Moller 1965, Knuth].  So D has no error but its own
 * roundings.
 */
INLINE void load_questions(questions *q)
{
    const vd zero = v_set(0);
    vd x[8], base[4], top[4];
    /* base and r0, top and r1; of an angle cone v and -k, u and k */
    load_columns(q, offsetof(question, record.p0), base);
    load_columns(q, offsetof(question, record.p1), top);
    load_columns(q, offsetof(question, near), x); /* and o */
    load_columns(q, offsetof(question, line.d), x + 4);
    q->r0 = base[3];
    q->dr = top[3] - base[3];
    q->is_angle = v_lt(base[3] * top[3], zero);
    q->from = x[0];
    EACH(j, 3) {
        const vpair o = v_two_sum(x[1 + j], -base[j]);
        const vd p0 = v_select(q->is_angle, zero, base[j]);
        const vpair w = v_two_sum(top[j], -p0);
        q->w[j] = w.hi;
        q->w_low[j] = w.lo;
        q->u[j] = x[4 + j];
        q->D[j] = (o.hi + q->from * q->u[j]) + o.lo;
    }
    if (m_any(q->is_angle)) {
        q->r0 = v_select(q->is_angle, zero, q->r0);
        q->dr =
            v_select(q->is_angle, top[3] * v_sqrt(v_dot(q->w, q->w)), q->dr);
    }
    q->uu = v_dot(q->u, q->u);
    q->Du = v_dot(q->D, q->u);
    q->DD = v_dot(q->D, q->D);
    q->ww = v_dot(q->w, q->w);
    q->U = size(q->u);
    q->Dn = size(q->D);
    q->W = v_sqrt(q->ww);
}

/* ------------------------------------------------------------- surfaces -- */

/*
 * Writes whether the line crosses the surface, from G, in `lanes`, and
 * the root and reciprocals.
 *
 * Where a < 0 a line crosses a cone that it is steeper than, on both nappes: G
 * is not negative.
 */
INLINE void cross_surface(quadratic *c, vd G, vm lanes)
{
    lanes = m_and(lanes, v_le(v_abs(G), v_set(DBL_MAX)));
    const vm clear = m_and(v_lt(v_set(16) * c->e_G, G),
                           v_lt(v_set(8) * c->e_a, v_abs(c->a)));
    const vm is = m_and(lanes, clear);
    const vm is_not = m_and(lanes, v_lt(G, -c->e_G));
    c->is = is;
    c->uncertain = m_not(m_or(is, is_not));
    c->root = c->per_a = c->per_root = v_set(1);
    if (m_any(is)) {
        c->root = v_sqrt(where_or_one(is, G));
        c->per_a = v_set(1) / where_or_one(is, c->a);
        c->per_root = v_set(1) / c->root;
    }
}

#define NUM vd
#define FORM(name) name
#define ADD(x, y) ((x) + (y))
#define SUB(x, y) ((x) - (y))
#define MUL(x, y) ((x) * (y))
#define MOST(x, T) (x)
#include "cone_form_template.h"

/*
 * Decides lines that are nearly parallel to the lateral surface, so that Q has one
 * sign wherever z is that of a point of the shape.  There |s| is at most `far`.
 * All of a shape lies where Q <= 0.  eps(12) is twice the error of b, eps(6) that
 * of c.  dz is larger than 2^17 times its error; 1.01 covers this, and roundings.
 */
INLINE void settle_parallel(questions *q, vm lanes, int is_round)
{
    quadratic *c = &q->cone;
    const vd one = v_set(1), dz = v_abs(q->dz), TK = q->T * q->K;
    const vm steep = m_and(lanes, v_lt(v_set(0x1p-30) * q->U * q->per_W, dz));
    const vd reach = q->R * q->per_W, beyond = is_round ? reach : v_set(0);
    const vd far =
        v_set(1.01) *
        ((one + v_abs(q->z0)) + (beyond + eps(2) * q->Dn * q->per_W)) /
        where_or_one(steep, dz);
    const vd change = far * (v_set(2) * v_abs(c->b) + far * v_abs(c->a));
    const vd most =
        v_set(1.01) * change +
        (far * (eps(12) * TK * q->U + far * c->e_a) + eps(6) * TK * q->K);
    const vm undecided = m_and(steep, c->uncertain);
    q->within = m_and(undecided, v_lt(c->c, -most));
    c->is = m_or(c->is, q->within);
    c->uncertain = m_and_not(
        c->uncertain, m_or(q->within, m_and(undecided, v_lt(most, c->c))));
}

/*
 * Writes which lines may hit the shape: between discs those that certainly cross
 * the cone, of a round kind those that do not certainly miss it.  uncertain:
 * products may underflow, or one ball may lie in the other, or, between discs, the
 * line is near the cone.
 *
 * Products have at most ten lengths as factors.  If none of these is less than
 * 2^-90, a product flushed to zero is negligible beside the shape.  Near an apex
 * and along a coordinate none is flushed, since coordinates and radii are 0 or at
 * least 2^-149 (filter_serves(), shapes.c).  An overflow gives an infinite bound or
 * NaN, and then nothing is certain, but for those of 1 / ww and of G:
 * cross_shape() and cross_surface() test them.
 */
INLINE void cross_shape(questions *q, int is_round)
{
    const vd least = v_set(0x1p-90), one = v_set(1);
    quadratic *c = &q->cone;
    q->is_ball = is_round ? m_not(v_lt(v_set(0), size(q->w))) : m_from(0);
    q->per_ww = one / v_select(q->is_ball, one, q->ww);
    q->per_W = q->W * q->per_ww;
    q->alpha = v_dot(q->D, q->w);
    q->beta = v_dot(q->u, q->w);
    q->R = q->r0 + v_abs(q->dr);
    q->K = q->Dn + q->r0;
    const vd slope2 = q->dr * q->dr * q->per_ww;
    const vd S = one - slope2, T = one + slope2;
    q->S = is_round ? S : one;
    q->T = is_round ? one : T;
    const vd G = cone_G(q, c);
    c->e_a = eps(8) * (q->T * q->uu);
    c->e_G =
        eps(30) * (q->T * q->uu) * (q->T * q->DD + v_set(4) * (q->r0 * q->r0));
    const vm sloped = m_and(m_and(v_lt(least, q->W), v_lt(least, q->per_W)),
                            v_lt(eps(8), q->S));
    const vm window =
        m_and(m_and(v_lt(v_set(0x1p-89), q->R), v_lt(least, q->U)),
              m_or(q->is_ball, sloped));
    const vm has_cone = m_and_not(window, q->is_ball);
    cross_surface(c, G, has_cone);
    q->within = m_from(0);
    if (m_any(m_and(has_cone, c->uncertain)))
        settle_parallel(q, has_cone, is_round);
    q->apart = v_lt(c->a, v_set(0));
    q->may = c->is;
    q->uncertain = c->uncertain;
    if (is_round) {
        const vm misses = m_and_not(has_cone, m_or(c->is, c->uncertain));
        q->may = m_and_not(window, misses);
        q->uncertain = m_not(window);
    }
}

/* The size of D + s u. */
INLINE vd size_along(const questions *q, vd s)
{
    return q->Dn + v_abs(s) * q->U;
}

/* z at s, and its error with that of the library's z, u |z|: 17 u of
 * size_along() / W besides that of s. */
INLINE void set_z(const questions *q, hit *at)
{
    at->z = q->z0 + at->s * q->dz;
    at->z_error =
        at->s_error * v_abs(q->dz) + eps(3) * size_along(q, at->s) * q->per_W;
}

/*
 * The root of Q before (end 0) or behind the middle: there the chord begins or
 * ends.  The error of sqrt(G) is at most 0.53 e_G / sqrt(G), with its rounding.
 * As G <= 2 (T K U)^2, that of b is at most 0.33 e_G / sqrt(G), and that of their
 * sum's rounding 0.02 of it.  The error of a is 6/8 e_a, at most a / 10.
 */
INLINE hit chord_end(const quadratic *c, const questions *q, int end)
{
    hit at;
    at.s = ((end ? c->root : -c->root) - c->b) * c->per_a;
    at.s_error =
        (c->e_G * c->per_root + v_abs(at.s) * c->e_a) * v_abs(c->per_a);
    at.is = c->is;
    at.uncertain = c->uncertain;
    at.at_end = at.top = m_from(0);
    set_z(q, &at);
    return at;
}

/* The same of the cone, which can have no such end: the chord of a line within is
 * endless.  Where a < 0 the nappe with positive radii between discs is the second's
 * if the radii grow along the line, and its chord has one end only.  The place of a
 * missing end is beyond the end of the shape.  y: z from the circle y = 0. */
INLINE hit lateral_end(const questions *q, int is_round, int end, vd *y)
{
    hit at = chord_end(&q->cone, q, end);
    const vd zero = v_set(0), along = end ? q->dz : -q->dz;
    const vm apart = m_and(q->apart, v_lt(zero, q->dr * along));
    const vm endless = is_round ? q->within : m_or(q->within, apart);
    const vd from_circle = q->y0 + at.s * q->dz;
    *y = is_round ? from_circle : at.z;
    if (m_any(endless)) {
        const vd beyond = v_select(v_lt(zero, along), v_set(2), v_set(-1));
        *y = v_select(endless, beyond, *y);
        at.z = v_select(endless, beyond, at.z);
        at.z_error = v_select(endless, zero, at.z_error);
    }
    return at;
}

/* Where the line enters (end 0) or leaves the solid on a cap beyond which the
 * lateral end lies.  It does if the chord's other end does not lie beyond it. */
INLINE hit end_on_cap(const questions *q, int top, int end)
{
    const vd zero = v_set(0), one = v_set(1), dz = v_abs(q->dz);
    vd y;
    hit at = lateral_end(q, 0, 1 - end, &y);
    const vd plane = v_set(top), margin = at.z_error + eps(1);
    const vd rise = plane - q->z0, out = top ? at.z - plane : plane - at.z;
    at.is = m_and(v_lt(out, -margin), v_lt(eps(16) * q->U * q->per_W, dz));
    at.uncertain = m_not(m_or(at.is, v_lt(margin, out)));
    if (!m_any(at.is))
        return at;
    const vd per_dz = one / where_or_one(at.is, dz);
    at.z = plane;
    at.z_error = zero;
    at.s = v_select(v_lt(q->dz, zero), -rise, rise) * per_dz;
    at.s_error = eps(4) * (one + size_along(q, at.s) * q->per_W) * per_dz;
    return at;
}

/* Where the line enters or leaves the ball about an end. */
INLINE hit end_on_ball(const questions *q, int top, int end)
{
    const vd r1 = q->r0 + q->dr, r = top ? r1 : q->r0;
    const vd N1 = q->Dn + q->W, K = (top ? N1 : q->Dn) + q->R;
    quadratic c;
    vd x[3];
    EACH(j, 3) {
        const vd x1 = q->D[j] - q->w[j];
        x[j] = top ? x1 : q->D[j];
    }
    c.a = q->uu;
    c.b = v_dot(x, q->u);
    c.e_G = eps(6) * q->uu * (K * K);
    c.e_a = eps(1) * q->uu;
    cross_surface(&c, ball_G(q->uu, c.b, v_dot(x, x), r), m_not(m_from(0)));
    return chord_end(&c, q, end);
}

/*
 * Where the line enters or leaves the closed solid: where its chord begins or ends
 * or, if that is beyond an end, on the cap or ball of that.  Beyond the balls'
 * circles the cone decides which ball is hit or, if it is flatter than the line
 * (`apart`), that it is the one which is entered first.  A sphere's only surface is
 * ball 0.
 */
INLINE hit end_on_shape(const questions *q, int is_round, int end)
{
    vd y;
    hit at = lateral_end(q, is_round, end, &y);
    const vd e = at.z_error + eps(is_round ? 3 : 1);
    const vm crosses = at.is;
    at.is = m_and(crosses, m_and(v_lt(e, y), v_lt(y, q->S - e)));
    at.uncertain = m_not(at.is);
    if (!m_any(at.uncertain))
        return at;
    const vm below = v_lt(y, -e), above = v_lt(q->S + e, y);
    const vm beyond = m_and(crosses, m_or(below, above));
    const vm both_ends = is_round ? q->apart : m_from(0);
    const vm mine[2] = {m_or(m_and(beyond, m_or(below, both_ends)), q->is_ball),
                        m_and(beyond, m_or(above, both_ends))};
    at.uncertain = m_and_not(at.uncertain, m_or(beyond, q->is_ball));
    for (int top = 0; top < 2; top++) {
        if (!m_any(mine[top]))
            continue;
        hit on = is_round ? end_on_ball(q, top, end) : end_on_cap(q, top, end);
        on.at_end = mine[top];
        on.top = top ? mine[top] : m_from(0);
        const vd before = end ? on.s - at.s : at.s - on.s;
        const vd error = on.s_error + at.s_error;
        const vm is = m_and(mine[top], on.is);
        const vm both = is_round ? m_and(is, at.is) : m_from(0);
        const vm comes =
            m_or(m_and_not(is, at.is), m_and(both, v_lt(error, before)));
        at.uncertain = m_or(at.uncertain,
                            m_or(m_and(mine[top], on.uncertain),
                                 m_and_not(both, v_lt(error, v_abs(before)))));
        select_hit(&at, comes, &on);
        at.is = m_or(at.is, is);
    }
    at.is = m_and_not(at.is, at.uncertain);
    return at;
}

/* ---------------------------------------------------------------- steps -- */

/* Writes c = P x w, where P = D + s u.  Returns the error of c, where that of s is
 * s_error. */
INLINE vd cross_at(const questions *q, vd s, vd s_error, vd c[3])
{
    vd P[3];
    EACH(j, 3)
        P[j] = q->D[j] + s * q->u[j];
    v_cross(c, P, q->w);
    return q->W * (q->U * s_error + eps(3) * size_along(q, s));
}

/* The radius of the cone at a hit and its error. */
INLINE vd cone_radius(const questions *q, const hit *at, vd *error)
{
    *error = eps(3) * (q->r0 + v_abs(q->dr) * size_along(q, at->s) * q->per_W);
    return q->r0 + q->dr * at->z;
}

/*
 * A step of Newton's from a root at which Q' / 2 is -+sqrt(G) (end 0, 1), in the
 * lanes `where`, for hits on the cone of which the floats would be uncertain.
 * Errors of Q: S and 1 / ww and their products: 22 u.  Where s - root = d, Q is
 * d (2 Q'/2 + a d), so that the step leaves
 *
 *   d (1 - sqrt(G) / root) - a d^2 / (2 root) - (the error of Q) / (2 root),
 *
 * and sqrt(G) / root differs from 1 by at most 0.53 e_G / G.
 */
INLINE void step_on_cone(const questions *q, int end, vm where, hit *at)
{
    const quadratic *const cone = &q->cone;
    const vd two = v_set(2);
    vd c[3], e_k;
    const vd e_c = cross_at(q, at->s, v_set(0), c);
    const vd k = cone_radius(q, at, &e_k), cc = v_dot(c, c);
    const vd e_Q = (e_c * (two * size(c) + e_c) + eps(4) * cc) * q->per_ww +
                   e_k * (two * v_abs(k) + e_k) + eps(1) * (k * k);
    const vd Q = q->S * cc * q->per_ww - k * k;
    const vd d = at->s_error, step = Q * (v_set(0.5) * cone->per_root);
    hit better = *at;
    better.s = end ? at->s - step : at->s + step;
    better.s_error =
        d * (cone->e_G * (cone->per_root * cone->per_root) + eps(1)) +
        v_set(0.6) * cone->per_root * (v_abs(cone->a) * (d * d) + e_Q) +
        eps(0.25) * v_abs(better.s);
    set_z(q, &better);
    select_hit(at, where, &better);
}

/* --------------------------------------------------------------- angles -- */

/*
 * atan2(y, x) / (2 pi), in [0, 1], with an error of at most
 * CYLINT_ATAN2_TURNS_ERROR.  *per_far is between 12/13 and 1 times
 * 1 / hypotenuse.
 *
 * The signs and the order of x and y reduce the angle to one between 0 and
 * pi / 4.  Its difference from pi / 8 has a tangent t of at most 0.4142136.  The
 * series of atan(t) alternates, so the truncation error is less than the first
 * omitted term, 0.4142136^29 / (58 pi) turns.  The bound with all roundings is
 * proved: tests/bounds/prove/turn.g.
 */
#define CYLINT_ATAN2_TURNS_ERROR 0x1.8bp-45

INLINE vd cylint_atan2_turns(vd y, vd x, vd *per_far)
{
#define TERM(n) v_set(0.15915494309189533577 / (n)) /* of 1 / (2 pi) */
    const vd c[14] = {TERM(1),   TERM(-3),  TERM(5),   TERM(-7), TERM(9),
                      TERM(-11), TERM(13),  TERM(-15), TERM(17), TERM(-19),
                      TERM(21),  TERM(-23), TERM(25),  TERM(-27)};
#undef TERM
    const vd tan_eighth = v_set(0.41421356237309504880);
    const vd ax = v_abs(x), ay = v_abs(y), wider = ax - ay;
    const vm lies = v_lt(ay, ax);
    const vd most = v_select(lies, ax, ay), least = v_select(lies, ay, ax);
    *per_far = v_set(1) / (most + least * tan_eighth);
    const vd t = (least - most * tan_eighth) * *per_far;
    const vd z = t * t, z2 = z * z, z4 = z2 * z2, z8 = z4 * z4;
    const vd low = (c[0] + c[1] * z) + z2 * (c[2] + c[3] * z) +
                   z4 * ((c[4] + c[5] * z) + z2 * (c[6] + c[7] * z));
    const vd high =
        (c[8] + c[9] * z) + z2 * (c[10] + c[11] * z) + z4 * (c[12] + c[13] * z);
    /* reflected if x and y were exchanged, and by both signs */
    const vd octant = v_set(0.125) - v_like(v_set(0.0625), wider);
    const vd quadrant = v_set(0.25) - v_like(v_set(0.25) - octant, x);
    const vd half = v_set(0.5) - v_like(v_set(0.5) - quadrant, y);
    const vd part = t * (low + z8 * high);
    const vd sign =
        v_like(v_set(1), wider) * v_like(v_set(1), x) * v_like(v_set(1), y);
    return half + sign * part;
}

#endif
