/*
 * float_filter_dots.h - where a line enters a shape, from dot products
 *
 * For float_filter.c.  Decides most questions at half the cost of
 * float_filter_lanes.h, whose notation this file uses; the error of a result is
 * larger for lines that are nearly parallel to the axis.
 *
 * The line is D + s u, the axis w, W = |w|, U = |u|, Dn = |D|.  Along the line
 *
 *   z = z0 + s dz,  z0 = D.w / ww,  dz = u.w / ww,
 *   k = k0 + s k1,  k0 = r0 + dr z0,  k1 = dr dz,  the radius at z,
 *   Q = a s^2 + 2 b s + c, negative inside of the lateral surface,
 *   a = uu - (u.w) dz - k1^2,  b = D.u - (D.w) dz - k0 k1,
 *   c = DD - (D.w) z0 - k0^2,  G = b^2 - a c.
 *
 * Errors, where u is a rounding, eps = 8 u, K = r0 + |dr| Dn / W and
 * L = |dr| U / W:
 *
 *   D: 2 u Dn.  w: u W.  u.w: 4 u U W.  D.w: 6 u Dn W.  1 / ww: 6.1 u of it.
 *   z0: 13.2 u Dn / W.  dz: 11.2 u U / W.
 *   k0: 21.3 u K.  k1: 18.3 u L.  dr: 6 u, of an acone.
 *   a: (20.3 U^2 + 38.7 L^2) u.  b: (24.3 Dn U + 41.7 K L) u.
 *   c: (29.3 Dn^2 + 44.7 K^2) u.
 *
 * With S = U^2 + L^2 and T = Dn^2 + K^2, |a| <= S, |b| <= sqrt(S T) and |c| <= T,
 * so these are at most 6 eps of S, sqrt(S T) and T, and the error of G is less
 * than 27 eps S T with the roundings of b^2 - a c.
 */
#ifndef CYLINT_EMBREE_FLOAT_FILTER_DOTS_H
#define CYLINT_EMBREE_FLOAT_FILTER_DOTS_H

#include "../bvh/float_bounds.h"
#include "../bvh/swept_disc.h"
#include "float_filter_lanes.h"

/* The coefficients, reciprocals of a and sqrt(G), and bounds on errors. */
typedef struct {
    double u[3], D[3], Dn;
    double z0, dz, k0, k1;
    double a, b, root, per_a, per_root, e_a, e_G;
} dots;

/* A hit at s and z with their errors. */
typedef struct {
    double s, s_error, z, z_error;
} axial_hit;

/* Sets u, D, w, r0, dr and from.  The error of D is that of load_question(). */
INLINE void load_dots(dots *x, question *q, const shape_columns *s,
                      const line_columns *l)
{
    double D0[3];
    EACH(j, 3)
        D0[j] = l->o[j] - s->base[j];
    q->from = origin_shift(l, D0);
    EACH(j, 3) {
        x->u[j] = l->d[j];
        x->D[j] = (D0[j] + q->from * l->d[j]) +
                  difference_error(l->o[j], s->base[j], D0[j]);
        q->w[j] = s->axis[j];
    }
    q->r0 = s->r0;
    q->dr = s->dr;
}

/* Returns HIT if the line certainly crosses the lateral surface. */
INLINE cylint_float_filter_result cross_by_dots(dots *x, question *q)
{
    const double uu = dot(x->u, x->u), DD = dot(x->D, x->D);
    const double alpha = dot(x->D, q->w), beta = dot(x->u, q->w);
    q->ww = dot(q->w, q->w);
    q->per_ww = 1 / q->ww;
    q->W = sqrt(q->ww);
    x->Dn = sqrt(DD);
    q->U = sqrt(uu);
    x->z0 = alpha * q->per_ww;
    x->dz = beta * q->per_ww;
    x->k0 = q->r0;
    x->k1 = 0;
    x->a = uu - beta * x->dz;
    x->b = dot(x->D, x->u) - alpha * x->dz;
    double S = uu, K = q->r0;
    if (q->dr != 0) {
        const double slope = fabs(q->dr) * q->W * q->per_ww;
        x->k0 = q->r0 + q->dr * x->z0;
        x->k1 = q->dr * x->dz;
        x->a -= x->k1 * x->k1;
        x->b -= x->k0 * x->k1;
        S += slope * slope * uu;
        K += slope * x->Dn;
    }
    const double c = DD - alpha * x->z0 - x->k0 * x->k0;
    const double G = x->b * x->b - x->a * c;
    x->e_a = 8 * 0x1p-50 * S;
    x->e_G = 28 * 0x1p-50 * S * (DD + K * K);
    if (!in_window(q))
        return CYLINT_FLOAT_FILTER_UNCERTAIN;
    if (G < -x->e_G)
        return CYLINT_FLOAT_FILTER_MISS;
    if (!(G > 16 * x->e_G && x->a > 8 * x->e_a))
        return CYLINT_FLOAT_FILTER_UNCERTAIN;
    x->root = sqrt(G);
    x->per_a = 1 / x->a;
    x->per_root = 1 / x->root;
    return CYLINT_FLOAT_FILTER_HIT;
}

/*
 * The root of Q before (sign = -1) or behind the middle.  The error of sqrt(G) is
 * at most 0.53 e_G / sqrt(G), with its rounding.  As G <= 2 S T, that of b is at
 * most 0.33 e_G / sqrt(G), and that of their sum's rounding 0.02 of it.  The
 * error of a is 6/8 e_a, at most a / 10.
 */
INLINE axial_hit lateral_at(const dots *x, const question *q, double sign)
{
    axial_hit at;
    at.s = (sign * x->root - x->b) * x->per_a;
    at.s_error = (x->e_G * x->per_root + fabs(at.s) * x->e_a) * fabs(x->per_a);
    const double X = x->Dn + fabs(at.s) * q->U;
    at.z = x->z0 + at.s * x->dz;
    at.z_error = at.s_error * fabs(x->dz) +
                 3 * 0x1p-50 * (X * (q->W * q->per_ww) + 0.0625);
    return at;
}

/* The radius at a hit and its error. */
INLINE double radius_at(const dots *x, const question *q, const axial_hit *at,
                        double *error)
{
    const double X = x->Dn + fabs(at->s) * q->U;
    *error = 3 * 0x1p-50 * (q->r0 + fabs(q->dr) * X * (q->W * q->per_ww));
    return q->r0 + q->dr * at->z;
}

/*
 * A step of Newton's from a root at which Q' / 2 is sign * sqrt(G), for hits of
 * which the floats would be uncertain.  Where s - root = d, Q is
 * d (2 sign sqrt(G) + a d), so that the step leaves
 *
 *   d (1 - sqrt(G) / root) - a d^2 / (2 root) - (the error of Q) / (2 root),
 *
 * and sqrt(G) / root differs from 1 by at most 0.53 e_G / G.
 */
INLINE void step_to_root(const dots *x, const question *q, double sign,
                         double Q, double Q_error, axial_hit *at)
{
    const double d = at->s_error;
    at->s -= sign * Q * (0.5 * x->per_root);
    at->s_error = d * (x->e_G * (x->per_root * x->per_root) + 0x1p-50) +
                  0.6 * x->per_root * (fabs(x->a) * (d * d) + Q_error) +
                  0x1p-52 * fabs(at->s);
    const double X = x->Dn + fabs(at->s) * q->U;
    at->z = x->z0 + at->s * x->dz;
    at->z_error = at->s_error * fabs(x->dz) +
                  3 * 0x1p-50 * (X * (q->W * q->per_ww) + 0.0625);
}

/* Whether the floats of a hit on a surface of radius r would be uncertain so often
 * that a step pays: at this error of the normal, about `limit` 2^27 times. */
INLINE int needs_step(const question *q, double r, const axial_hit *at,
                      double limit)
{
    return at->s_error * q->U > limit * r;
}

/*
 * The same on a cone, where Q = S |c|^2 / ww - k^2, c = P x w, S = 1, and on the
 * cone of a round kind (float_filter_round.h).  Errors: c: 3 eps W X, as in
 * describe_by_dots(); S and 1 / ww and their products: 22 u.
 */
INLINE void step_on_cone(const dots *x, const question *q, double S,
                         double sign, axial_hit *at)
{
    const double X = x->Dn + fabs(at->s) * q->U;
    const double e_c = 3 * 0x1p-50 * (q->W * X);
    double P[3], c[3], e_k;
    EACH(j, 3)
        P[j] = x->D[j] + at->s * x->u[j];
    cross(c, P, q->w);
    const double k = radius_at(x, q, at, &e_k), cc = dot(c, c);
    const double Q = S * cc * q->per_ww - k * k;
    const double e_Q =
        (e_c * (2 * size(c) + e_c) + 4 * 0x1p-50 * cc) * q->per_ww +
        e_k * (2 * fabs(k) + e_k) + 0x1p-50 * (k * k);
    step_to_root(x, q, sign, Q, e_Q, at);
}

/* For a chord that begins or ends (sign = 1) at s below the base or above the
 * top: whether it crosses that cap's plane.  Then moves the hit there. */
INLINE cylint_float_filter_result move_to_cap(const dots *x, const question *q,
                                              double sign, hit *h,
                                              axial_hit *at)
{
    const axial_hit other = lateral_at(x, q, -sign);
    const int top = at->z > 0.5;
    const double out = top ? at->z - 1 : -at->z;
    const double other_out = top ? other.z - 1 : -other.z;
    const double margin = other.z_error + 0x1p-50;
    if (!(out > at->z_error + 0x1p-50))
        return CYLINT_FLOAT_FILTER_UNCERTAIN;
    if (other_out > margin)
        return CYLINT_FLOAT_FILTER_MISS;
    const double perW = q->W * q->per_ww, dz = fabs(x->dz);
    if (!(other_out < -margin && dz > 16 * 0x1p-50 * q->U * perW))
        return CYLINT_FLOAT_FILTER_UNCERTAIN;
    const double per_dz = 1 / dz, rise = top - x->z0;
    h->capped = 1;
    h->top = top;
    at->s = (x->dz < 0 ? -rise : rise) * per_dz;
    at->s_error =
        4 * 0x1p-50 * (1 + (x->Dn + fabs(at->s) * q->U) * perW) * per_dz;
    at->z = top;
    at->z_error = 0;
    return CYLINT_FLOAT_FILTER_HIT;
}

/* Where the line enters or leaves (sign = 1) the closed shape. */
INLINE cylint_float_filter_result end_by_dots(const dots *x, const question *q,
                                              double sign, hit *h,
                                              axial_hit *at)
{
    *at = lateral_at(x, q, sign);
    h->capped = h->top = 0;
    const double margin = at->z_error + 0x1p-50;
    if (at->z > margin && at->z < 1 - margin)
        return CYLINT_FLOAT_FILTER_HIT;
    return move_to_cap(x, q, sign, h, at);
}

/* The members of a hit that its description reads. */
INLINE void describe_by_dots(const dots *x, const question *q,
                             const axial_hit *at, hit *h)
{
    const double X = x->Dn + fabs(at->s) * q->U;
    double P[3];
    EACH(j, 3)
        P[j] = x->D[j] + at->s * x->u[j];
    cross(h->c, P, q->w);
    h->e_c = q->W * (q->U * at->s_error + 3 * 0x1p-50 * X);
    h->z = at->z;
    h->z_error = at->z_error;
    h->k = x->k0 + at->s * x->k1;
    h->e_k = fabs(x->k1) * at->s_error +
             3 * 0x1p-50 * (q->r0 + fabs(q->dr) * X * (q->W * q->per_ww));
}

#endif
