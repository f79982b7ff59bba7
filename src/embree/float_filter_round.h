/*
 * float_filter_round.h - where a line enters a sphere, capsule or rounded cone
 *
 * For float_filter.c, in the notation of float_filter_dots.h.  The cone that
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
 * e_G = 38 eps K^2 U^2 fit lateral_at(): |b^2 - a c| <= 6 K^2 U^2, so the error of
 * b is less than 0.33 e_G / sqrt(G).
 *
 * Of a ball, with N = Dn or Dn + W, R = r0 + |dr| and K = N + R: x: 3 u N,
 * x.u: 6 u N U, |x|^2 - r^2: 15 u K^2, b^2 - uu c: 34 u K^2 U^2.  There
 * e_G = 6 eps K^2 U^2 and e_a = eps U^2 fit lateral_at(): G <= R^2 U^2 but for its
 * error, so that of b is less than 0.14 e_G / sqrt(G).
 *
 * tests/bounds/test_embree_float_bounds.c computes these bounds from the forms.
 */
#ifndef CYLINT_EMBREE_FLOAT_FILTER_ROUND_H
#define CYLINT_EMBREE_FLOAT_FILTER_ROUND_H

#include "float_filter_dots.h"

#define NUM double
#define FORM(name) name
#define ADD(x, y) ((x) + (y))
#define SUB(x, y) ((x) - (y))
#define MUL(x, y) ((x) * (y))
#define SMALL(x) (x)
#include "round_forms_template.h"

/* cone, ball: the coefficients of the cone and of the ball in ball_at().
 * slanted: the sign of a, or 0.  crosses: whether the line crosses the cone,
 * uncertain if `slanted` is 0.  is_ball: it is a sphere, which has no cone. */
typedef struct {
    dots cone, ball;
    double uu, Du, DD, R;
    int is_ball;
    double S, y0, K;
    int slanted;
    cylint_float_filter_result crosses;
} round_dots;

/* Records of round kinds have negative radii. */
INLINE int is_round(const shape_columns *s)
{
    return s->r0 + (s->r0 + s->dr) < 0;
}

/* Returns 0 if products may underflow: see in_window(). */
INLINE int load_round(round_dots *x, question *q, const shape_columns *s,
                      const line_columns *l)
{
    load_dots(&x->cone, q, s, l);
    q->r0 = -s->r0;
    q->dr = -s->dr;
    x->uu = dot(x->cone.u, x->cone.u);
    x->Du = dot(x->cone.D, x->cone.u);
    x->DD = dot(x->cone.D, x->cone.D);
    x->cone.Dn = sqrt(x->DD);
    x->R = q->r0 + fabs(q->dr);
    q->U = sqrt(x->uu);
    q->ww = dot(q->w, q->w);
    q->W = sqrt(q->ww);
    q->per_ww = 0;
    x->cone.z0 = x->cone.dz = x->y0 = 0;
    x->cone.a = x->cone.b = x->cone.root = x->cone.per_a = 0;
    x->cone.per_root = x->cone.e_a = x->cone.e_G = 0;
    x->ball = x->cone;
    x->S = 1;
    x->K = x->cone.Dn + q->r0;
    x->slanted = 0;
    x->crosses = CYLINT_FLOAT_FILTER_UNCERTAIN;
    x->is_ball = !(size(q->w) > 0);
    return (x->R > 0x1p-90) & (q->U > 0x1p-90) &
           ((q->W > 0x1p-90) | x->is_ball);
}

/* Whether a hull's cone is crossed, and where. */
INLINE void cross_cone(round_dots *x, question *q)
{
    dots *c = &x->cone;
    round_cone f;
    q->per_ww = 1 / q->ww;
    const round_terms terms = {x->uu,           x->Du,           x->DD,
                               dot(c->D, q->w), dot(c->u, q->w), q->per_ww,
                               q->r0,           q->dr,           1};
    set_round_cone(&f, &terms);
    const double G = f.G;
    x->S = f.S;
    x->y0 = f.y0;
    c->z0 = f.z0;
    c->dz = f.dz;
    c->a = f.a;
    c->b = f.b;
    c->e_a = 8 * 0x1p-50 * x->uu;
    c->e_G = 38 * 0x1p-50 * x->uu * (x->K * x->K);
    x->slanted = c->a > 8 * c->e_a ? 1 : c->a < -8 * c->e_a ? -1 : 0;
    if (!x->slanted || !(x->S > 8 * 0x1p-50))
        return;
    if (G < -c->e_G) /* then a > 0: a steep line crosses the double cone */
        x->crosses = CYLINT_FLOAT_FILTER_MISS;
    if (!(G > 16 * c->e_G))
        return;
    x->crosses = CYLINT_FLOAT_FILTER_HIT;
    c->root = sqrt(G);
    c->per_a = 1 / c->a;
    c->per_root = 1 / c->root;
}

/* Where y at a hit is: 0 below 0, 1 between 0 and S, 2 above S, or -1. */
INLINE int range_of_y(const round_dots *x, const question *q,
                      const axial_hit *at)
{
    const double X = x->K + fabs(at->s) * q->U;
    const double y = x->y0 + at->s * x->cone.dz;
    const double e = at->s_error * fabs(x->cone.dz) +
                     3 * 0x1p-50 * (X * (q->W * q->per_ww) + 1);
    return y < -e ? 0 : ((y > e) & (y < x->S - e)) ? 1 : y > x->S + e ? 2 : -1;
}

/* Where the line enters or leaves (sign = 1) the ball about an end. */
INLINE cylint_float_filter_result ball_at(round_dots *x, const question *q,
                                          int top, double sign, axial_hit *at)
{
    dots *d = &x->ball;
    double DD = x->DD, r = q->r0, N = x->cone.Dn;
    d->z0 = x->cone.z0;
    d->dz = x->cone.dz;
    d->b = x->Du;
    if (top) {
        double D1[3];
        EACH(j, 3)
            D1[j] = d->D[j] - q->w[j];
        DD = dot(D1, D1);
        d->b = dot(D1, d->u);
        r = q->r0 + q->dr;
        N = N + q->W;
    }
    const double K = N + x->R, G = round_ball_G(x->uu, d->b, DD, r);
    d->a = x->uu;
    d->e_G = 6 * 0x1p-50 * x->uu * (K * K);
    d->e_a = 0x1p-50 * x->uu;
    if (G < -d->e_G)
        return CYLINT_FLOAT_FILTER_MISS;
    if (!(G > 16 * d->e_G))
        return CYLINT_FLOAT_FILTER_UNCERTAIN;
    d->root = sqrt(G);
    d->per_root = 1 / d->root;
    d->per_a = 1 / x->uu;
    *at = lateral_at(d, q, sign);
    if (x->is_ball)
        at->z_error = 0;
    return CYLINT_FLOAT_FILTER_HIT;
}

/* The same for a line that may hit either ball.  misses_cone: it certainly does
 * not enter or leave by the lateral surface. */
INLINE cylint_float_filter_result either_ball(round_dots *x, const question *q,
                                              double sign, int misses_cone,
                                              hit *h, axial_hit *at)
{
    int misses = misses_cone;
    EACH(top, 2) {
        const cylint_float_filter_result is = ball_at(x, q, top, sign, at);
        const int range =
            is == CYLINT_FLOAT_FILTER_HIT ? range_of_y(x, q, at) : -1;
        if (range == 2 * top) {
            h->capped = 1;
            h->top = top;
            return CYLINT_FLOAT_FILTER_HIT;
        }
        misses &= is == CYLINT_FLOAT_FILTER_MISS || range >= 0;
    }
    return misses ? CYLINT_FLOAT_FILTER_MISS : CYLINT_FLOAT_FILTER_UNCERTAIN;
}

/* Where the line enters or leaves (sign = 1) the solid. */
INLINE cylint_float_filter_result round_end(round_dots *x, const question *q,
                                            double sign, hit *h, axial_hit *at)
{
    int range = -1;
    h->capped = h->top = 0;
    if (x->is_ball)
        return ball_at(x, q, 0, sign, at);
    if (x->crosses == CYLINT_FLOAT_FILTER_MISS)
        return CYLINT_FLOAT_FILTER_MISS;
    if (x->crosses == CYLINT_FLOAT_FILTER_HIT) {
        *at = lateral_at(&x->cone, q, sign);
        range = range_of_y(x, q, at);
        if (range == 1)
            return CYLINT_FLOAT_FILTER_HIT;
        if (range >= 0 && x->slanted > 0) {
            h->capped = 1;
            h->top = range == 2;
            return ball_at(x, q, h->top, sign, at);
        }
    }
    return either_ball(x, q, sign, range >= 0, h, at);
}

/* A step of Newton's on a ball, where Q = |P|^2 - r^2.  The error of P is at most
 * 6 u X, that of r 2 u R. */
INLINE void step_on_ball(const round_dots *x, const question *q, int top,
                         double sign, axial_hit *at)
{
    const double r = top ? q->r0 + q->dr : q->r0;
    const double X = x->cone.Dn + fabs(at->s) * q->U + (top ? q->W : 0);
    double P[3];
    EACH(j, 3)
        P[j] = (x->cone.D[j] + at->s * x->cone.u[j]) - (top ? q->w[j] : 0);
    const double PP = dot(P, P), e_P = 0x1p-50 * X;
    const double e_Q = e_P * (2 * size(P) + e_P) + 0x1p-50 * (PP + x->R * x->R);
    step_to_root(&x->ball, q, sign, PP - r * r, e_Q, at);
    if (x->is_ball)
        at->z_error = 0;
}

/* A step of Newton's on the surface of a hit. */
INLINE void step_on_round(const round_dots *x, const question *q, double sign,
                          const hit *h, axial_hit *at)
{
    if (h->capped || x->is_ball)
        step_on_ball(x, q, h->top, sign, at);
    else
        step_on_cone(&x->cone, q, x->S, sign, at);
}

/* ---------------------------------------------------------- description -- */

/* The unit normal on the ball about an end: N = (x + s u) / r. */
INLINE void ball_normal(const round_dots *x, const question *q,
                        const axial_hit *at, int top, bounded_vector *to)
{
    const double r = top ? q->r0 + q->dr : q->r0, W = top ? q->W : 0;
    const double X = x->cone.Dn + fabs(at->s) * q->U + W;
    const double e = q->U * at->s_error + 0x1p-50 * X;
    EACH(j, 3) {
        const double w = top ? q->w[j] : 0, step = at->s * x->cone.u[j];
        const double sizes = fabs(x->cone.D[j]) + fabs(step) + fabs(w);
        to->N[j] = (x->cone.D[j] + step) - w;
        to->e[j] = sizes > 0 ? e : 0;
    }
    to->per_length = 1 / r;
    to->e_length = 0x1p-50 * (x->R * fabs(to->per_length) + 1);
}

/*
 * The cone touches the ball of radius k = r0 + h dr about h w, h = y / S, and has
 * the normal (P - h w) / k there, which is (w x c) / (ww k) - (dr / ww) w.  The
 * errors of the factors of w x c and w are at most 11 u of them, and S has one of
 * 11.2 u.  The factor 1.1 covers their products if e_h and e_k are below 1/16;
 * else e_length is so large that nothing is certain.
 */
INLINE void cone_hull_normal(const round_dots *x, const question *q,
                             const axial_hit *at, const double across[3],
                             const double e_across[3], bounded_vector *to)
{
    const double X = x->K + fabs(at->s) * q->U, per_S = 1 / x->S;
    const double h = (x->y0 + at->s * x->cone.dz) * per_S;
    const double e_h = 1.1 * per_S *
                       (at->s_error * fabs(x->cone.dz) +
                        3 * 0x1p-50 * (X * (q->W * q->per_ww) + 1));
    const double k = q->r0 + h * q->dr, per_k = 1 / k;
    const double e_k = (e_h * fabs(q->dr) + 0x1p-50 * x->R) * fabs(per_k);
    const double scale = q->per_ww * per_k, lean = q->dr * q->per_ww;
    EACH(j, 3) {
        const double out = across[j] * scale, along = lean * q->w[j];
        to->N[j] = out - along;
        to->e[j] =
            1.1 * (e_across[j] * fabs(scale) + fabs(out) * (e_k + 2 * 0x1p-50) +
                   fabs(along) * (2 * 0x1p-50));
    }
    to->per_length = 1;
    to->e_length = 0x1p-50 + 16 * (e_h * e_h + e_k * e_k);
}

/* The members of a hit that its description reads. */
INLINE void describe_round(const round_dots *x, const question *q, double sign,
                           axial_hit *at, hit *h)
{
    double across[3], e_across[3];
    if (needs_step(q, x->R, at, 0x1p-38))
        step_on_round(x, q, sign, h, at);
    h->round = 1 + x->is_ball;
    h->z = at->z;
    h->z_error = at->z_error;
    h->e_c = 0;
    EACH(j, 3)
        h->c[j] = across[j] = e_across[j] = 0;
    if (!x->is_ball) {
        const double X = x->cone.Dn + fabs(at->s) * q->U;
        double P[3];
        EACH(j, 3)
            P[j] = x->cone.D[j] + at->s * x->cone.u[j];
        cross(h->c, P, q->w);
        h->e_c = q->W * (q->U * at->s_error + 3 * 0x1p-50 * X);
        lateral_direction(q, h, across, e_across);
    }
    if (h->capped || x->is_ball)
        ball_normal(x, q, at, h->top, &h->normal);
    else
        cone_hull_normal(x, q, at, across, e_across, &h->normal);
}

#endif
