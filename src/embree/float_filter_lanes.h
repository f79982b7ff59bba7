/*
 * float_filter_lanes.h - where a line enters and leaves a cylinder or cone, and
 * the floats of a hit
 *
 * For float_filter.c, one question in each lane.
 *
 * The error of a quantity `f` is at most `e_f`.  A rounding is u = 2^-53; eps =
 * 2^-50 is eight of them.  The errors of vectors are lengths: a cross product
 * has at most 2 / sqrt(3) of the errors of its products.
 *
 * The line is D + s u, the axis w, W = |w|; U and Dn are sizes of u and D, at
 * least their lengths, which take no roots.  Along the line
 *
 *   z = z0 + s dz,  z0 = D.w / ww,  dz = u.w / ww,
 *   k = k0 + s k1,  k0 = r0 + dr z0,  k1 = dr dz,  the radius at z,
 *   Q = a s^2 + 2 b s + c, negative inside of the lateral surface,
 *   a = uu - (u.w) dz - k1^2,  b = D.u - (D.w) dz - k0 k1,
 *   c = DD - (D.w) z0 - k0^2,  G = b^2 - a c.
 *
 * Errors, where K = r0 + |dr| Dn / W and L = |dr| U / W:
 *
 *   D: 2 u Dn.  w: u W.  u.w: 4 u U W.  D.w: 6 u Dn W.  1 / ww: 6.1 u of it.
 *   z0: 13.2 u Dn / W.  dz: 11.2 u U / W.
 *   k0: 21.3 u K.  k1: 18.3 u L.  dr: u of it.
 *   a: (20.3 U^2 + 38.7 L^2) u.  b: (24.3 Dn U + 41.7 K L) u.
 *   c: (29.3 Dn^2 + 44.7 K^2) u.
 *
 * With S = U^2 + L^2 and T = Dn^2 + K^2, |a| <= S, |b| <= sqrt(S T) and |c| <= T,
 * so these are at most 6 eps of S, sqrt(S T) and T, and the error of G is less
 * than 27 eps S T with the roundings of b^2 - a c.
 *
 * Compiled as it is and again with fused multiply-add, which rounds less often:
 * the bounds hold either way.  Lanes that do not count divide by 1.
 */
#ifndef CYLINT_EMBREE_FLOAT_FILTER_LANES_H
#define CYLINT_EMBREE_FLOAT_FILTER_LANES_H

#include <float.h>
#include <stddef.h>

#include "../numbers/simd.h"
#include "float_filter.h"
#include "angle.h"

/* ------------------------------------------------------------ questions -- */

/* The line from the shape's base on: t = from + s. */
typedef struct {
    vd u[3], D[3], w[3], r0, dr, from;
    vd uu, Du, DD, ww, per_ww, U, Dn, W, per_W; /* per_W = W / ww */
    vd alpha, beta, z0, dz;                     /* D.w, u.w */
} question;

/* Q, where the line crosses its surface: reciprocals of a and sqrt(G), errors.
 * apart, of a cone: a < 0, and Q < 0 before the first root and behind the
 * second. */
typedef struct {
    vd a, b, root, per_a, per_root, e_a, e_G;
    vm apart;
} quadratic;

/* A hit at s and z with their errors.  capped: on a cap, top: on the top one. */
typedef struct {
    vd s, s_error, z, z_error;
    vm capped, top;
} hit;

/* hit: certainly a hit.  uncertain: undecided.  Neither: certainly no hit. */
typedef struct {
    vm hit, uncertain;
} verdict;

/* n eps. */
INLINE vd eps(double n)
{
    return v_set(n * 0x1p-50);
}

INLINE vd dot(const vd x[3], const vd y[3])
{
    return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

INLINE vd size(const vd x[3])
{
    return v_abs(x[0]) + v_abs(x[1]) + v_abs(x[2]);
}

INLINE void cross(vd to[3], const vd x[3], const vd y[3])
{
    to[0] = x[1] * y[2] - x[2] * y[1];
    to[1] = x[2] * y[0] - x[0] * y[2];
    to[2] = x[0] * y[1] - x[1] * y[0];
}

INLINE vm m_none(void)
{
    return m_from(0);
}

INLINE vd where_or_one(vm where, vd x)
{
    return v_select(where, x, v_set(1));
}

INLINE hit no_hit(void)
{
    const vd zero = v_set(0);
    return (hit){zero, zero, zero, zero, m_none(), m_none()};
}

/* Copies *other in the lanes `where`. */
INLINE void select_hit(hit *at, vm where, const hit *other)
{
    at->s = v_select(where, other->s, at->s);
    at->s_error = v_select(where, other->s_error, at->s_error);
    at->z = v_select(where, other->z, at->z);
    at->z_error = v_select(where, other->z_error, at->z_error);
    at->capped = m_if(where, other->capped, at->capped);
    at->top = m_if(where, other->top, at->top);
}

INLINE void select_quadratic(quadratic *c, vm where, const quadratic *other)
{
    c->a = v_select(where, other->a, c->a);
    c->root = v_select(where, other->root, c->root);
    c->per_root = v_select(where, other->per_root, c->per_root);
    c->e_G = v_select(where, other->e_G, c->e_G);
}

/* Loads the record at row[0], row[1], ...; r[i] is the radius at end i. */
INLINE void load_records(question *q, const char *const row[LANES], int small,
                         vd r[2])
{
    vd x[8];
    if (small) {
        v_columns_of_floats(row, 0, x);
        v_columns_of_floats(row, offsetof(cylint_small_record, p1), x + 4);
    } else {
        v_columns(row, 0, x);
        v_columns(row, offsetof(cylint_record, p1), x + 4);
    }
    EACH(j, 3) {
        q->D[j] = x[j]; /* the base, for load_lines() */
        q->w[j] = x[4 + j] - x[j];
    }
    r[0] = x[3];
    r[1] = x[7];
}

INLINE vd difference_error(vd x, vd y, vd difference)
{
    const vd minus_y = difference - x;
    return (x - (difference - minus_y)) - (y + minus_y);
}

INLINE vd origin_shift(vd near, const vd D0[3], const vd d[3])
{
    const vm known = v_le(v_abs(near), v_set((double)FLT_MAX));
    if (!m_any(m_not(known)))
        return near;
    return v_select(known, near, v_float(-dot(D0, d) / dot(d, d)));
}

/*
 * Moves the origin by from * u to a point near the shape, so that the errors are
 * relative to the shape's size, wherever the ray begins: to `near` if it is
 * known, else to the point nearest to the base.  u and `from` have 24 bits each,
 * so their product is exact.  The rounding error of o - base is added again
 * [Moller 1965, Knuth].  So D has no error but its own roundings.
 */
INLINE void load_lines(question *q, const char *const row[LANES])
{
    vd x[8], D0[3], base[3];
    v_columns(row, offsetof(cylint_float_filter_question, o), x);
    v_columns(row, offsetof(cylint_float_filter_question, d[1]), x + 4);
    EACH(j, 3) {
        base[j] = q->D[j];
        D0[j] = x[j] - base[j];
        q->u[j] = x[3 + j];
    }
    q->from = origin_shift(x[7], D0, q->u);
    EACH(j, 3)
        q->D[j] = (D0[j] + q->from * q->u[j]) +
                  difference_error(x[j], base[j], D0[j]);
    q->uu = dot(q->u, q->u);
    q->Du = dot(q->D, q->u);
    q->DD = dot(q->D, q->D);
    q->ww = dot(q->w, q->w);
    q->U = size(q->u);
    q->Dn = size(q->D);
    q->W = v_sqrt(q->ww);
}

/* Sets what follows from the axis.  ww: its square, or 1 where it has no length;
 * this does not wait for roots. */
INLINE void load_axis(question *q, vd ww)
{
    q->per_ww = v_set(1) / ww;
    q->per_W = q->W * q->per_ww;
    q->alpha = dot(q->D, q->w);
    q->beta = dot(q->u, q->w);
    q->z0 = q->alpha * q->per_ww;
    q->dz = q->beta * q->per_ww;
}

/* Products have at most ten lengths as factors.  If none of these is less than
 * 2^-90, a product flushed to zero is negligible.  An overflow gives an infinite
 * bound or NaN, and then nothing is certain. */
INLINE vm in_window(const question *q, vd radii)
{
    const vd least = v_set(0x1p-90);
    return m_and(v_lt(v_set(0x1p-89), radii), v_lt(least, q->U));
}

/* ------------------------------------------------------------- surfaces -- */

/*
 * Where the line certainly crosses the surface, and where it does not, from G,
 * in the lanes `known`.  Writes roots and reciprocals.
 *
 * Where a < 0 a line crosses a cone that it is steeper than, on both nappes: G
 * is not negative.
 */
INLINE verdict cross_surface(quadratic *c, vd G, vm known)
{
    const vm clear = m_and(v_lt(v_set(16) * c->e_G, G),
                           v_lt(v_set(8) * c->e_a, v_abs(c->a)));
    const vm is = m_and(known, clear);
    const vm is_not = m_and(known, v_lt(G, -c->e_G));
    c->root = c->per_a = c->per_root = v_set(1);
    if (m_any(is)) {
        c->root = v_sqrt(where_or_one(is, G));
        c->per_a = v_set(1) / where_or_one(is, c->a);
        c->per_root = v_set(1) / c->root;
    }
    return (verdict){is, m_not(m_or(is, is_not))};
}

INLINE verdict cross_discs(quadratic *c, question *q)
{
    const vm window = m_and(in_window(q, q->r0 + (q->r0 + q->dr)),
                            v_lt(v_set(0x1p-90), q->W));
    vd k0 = q->r0, S = q->uu, K = q->r0;
    c->apart = m_none();
    load_axis(q, q->ww);
    c->a = q->uu - q->beta * q->dz;
    c->b = q->Du - q->alpha * q->dz;
    if (m_any(m_not(v_eq(q->dr, v_set(0))))) {
        const vd slope = v_abs(q->dr) * q->per_W, k1 = q->dr * q->dz;
        k0 = q->r0 + q->dr * q->z0;
        c->a = c->a - k1 * k1;
        c->apart = v_lt(c->a, v_set(0));
        c->b = c->b - k0 * k1;
        S = S + slope * slope * q->uu;
        K = K + slope * q->Dn;
    }
    const vd from_axis = q->DD - q->alpha * q->z0 - k0 * k0;
    const vd G = c->b * c->b - c->a * from_axis;
    c->e_a = eps(8) * S;
    c->e_G = eps(28) * S * (q->DD + K * K);
    return cross_surface(c, G, window);
}

/* z at s, and its error.  The bound includes the error of the library's z: its
 * dividend and divisor are right to 2^-54 of themselves (hit.c), so with its
 * roundings it is right to eps |z| / 2.  eps / 16 of it is to spare. */
INLINE void set_z(const question *q, hit *at)
{
    const vd X = q->Dn + v_abs(at->s) * q->U;
    at->z = q->z0 + at->s * q->dz;
    at->z_error =
        at->s_error * v_abs(q->dz) + eps(3) * (X * q->per_W + v_set(0.0625));
}

/*
 * The root of Q before (end 0) or behind the middle: there the chord begins or
 * ends.  The error of sqrt(G) is at most 0.53 e_G / sqrt(G), with its rounding.
 * As G <= 2 S T, that of b is at most 0.33 e_G / sqrt(G), and that of their sum's
 * rounding 0.02 of it.  The error of a is 6/8 e_a, at most a / 10.
 */
INLINE hit chord_end(const quadratic *c, const question *q, int end)
{
    hit at;
    at.s = ((end ? c->root : -c->root) - c->b) * c->per_a;
    at.s_error =
        (c->e_G * c->per_root + v_abs(at.s) * c->e_a) * v_abs(c->per_a);
    at.capped = at.top = m_none();
    set_z(q, &at);
    return at;
}

/* The same on a shape between discs.  Where a < 0 the nappe with positive radii
 * is the second's if the radii grow along the line, and its chord has one end
 * only.  Its other end is beyond a cap. */
INLINE hit lateral_end(const quadratic *c, const question *q, int end)
{
    hit at = chord_end(c, q, end);
    if (m_any(c->apart)) {
        const vd zero = v_set(0), along = end ? q->dz : -q->dz;
        const vm endless = m_and(c->apart, v_lt(zero, q->dr * along));
        const vd beyond = v_select(v_lt(zero, along), v_set(2), v_set(-1));
        at.z = v_select(endless, beyond, at.z);
        at.z_error = v_select(endless, zero, at.z_error);
    }
    return at;
}

/* For chords that begin or end below the base or above the top: whether they
 * cross that cap's plane.  Then moves the hit there. */
INLINE verdict move_to_cap(const quadratic *c, const question *q, int end,
                           vm between, hit *at)
{
    const hit other = lateral_end(c, q, 1 - end);
    const vm top = v_lt(v_set(0.5), at->z);
    const vd one = v_set(1), dz = v_abs(q->dz);
    const vd out = v_select(top, at->z - one, -at->z);
    const vd other_out = v_select(top, other.z - one, -other.z);
    const vd margin = other.z_error + eps(1);
    const vm outside = m_and_not(v_lt(at->z_error + eps(1), out), between);
    const vm stays = m_and(outside, v_lt(margin, other_out));
    const vm comes = m_and(m_and(outside, v_lt(other_out, -margin)),
                           v_lt(eps(16) * q->U * q->per_W, dz));
    const vm decided = m_or(m_or(between, stays), comes);
    if (m_any(comes)) {
        const vd per_dz = one / where_or_one(comes, dz);
        const vd rise = v_select(top, one, v_set(0)) - q->z0;
        hit cap;
        cap.s = v_select(v_lt(q->dz, v_set(0)), -rise, rise) * per_dz;
        cap.s_error =
            eps(4) * (one + (q->Dn + v_abs(cap.s) * q->U) * q->per_W) * per_dz;
        cap.z = v_select(top, one, v_set(0));
        cap.z_error = v_set(0);
        cap.capped = comes;
        cap.top = top;
        select_hit(at, comes, &cap);
    }
    return (verdict){m_or(between, comes), m_not(decided)};
}

/* Where the line enters (end 0) or leaves the closed shape. */
INLINE verdict end_on_discs(const quadratic *c, const question *q, int end,
                            hit *at)
{
    *at = lateral_end(c, q, end);
    const vd margin = at->z_error + eps(1);
    const vm between =
        m_and(v_lt(margin, at->z), v_lt(at->z, v_set(1) - margin));
    if (!m_any(m_not(between)))
        return (verdict){between, m_none()};
    return move_to_cap(c, q, end, between, at);
}

/* ---------------------------------------------------------------- steps -- */

/* P = D + s u. */
INLINE void point_at(const question *q, const hit *at, vd P[3])
{
    EACH(j, 3)
        P[j] = q->D[j] + at->s * q->u[j];
}

/* The radius at a hit and its error. */
INLINE vd radius_at(const question *q, const hit *at, vd *error)
{
    const vd X = q->Dn + v_abs(at->s) * q->U;
    *error = eps(3) * (q->r0 + v_abs(q->dr) * X * q->per_W);
    return q->r0 + q->dr * at->z;
}

/*
 * A step of Newton's from a root at which Q' / 2 is -+sqrt(G) (end 0, 1), for hits
 * of which the floats would be uncertain.  Where s - root = d, Q is
 * d (2 Q'/2 + a d), so that the step leaves
 *
 *   d (1 - sqrt(G) / root) - a d^2 / (2 root) - (the error of Q) / (2 root),
 *
 * and sqrt(G) / root differs from 1 by at most 0.53 e_G / G.
 */
INLINE void step_to_root(const quadratic *c, const question *q, int end, vd Q,
                         vd Q_error, hit *at)
{
    const vd d = at->s_error, step = Q * (v_set(0.5) * c->per_root);
    at->s = end ? at->s - step : at->s + step;
    at->s_error = d * (c->e_G * (c->per_root * c->per_root) + eps(1)) +
                  v_set(0.6) * c->per_root * (v_abs(c->a) * (d * d) + Q_error) +
                  eps(0.25) * v_abs(at->s);
    set_z(q, at);
}

/*
 * The same on a cone, where Q = S |c|^2 / ww - k^2, c = P x w, S = 1, and on the
 * cone of a round kind (float_filter_round.h).  Errors: c: 3 eps W X; S and 1 / ww
 * and their products: 22 u.
 */
INLINE void step_on_cone(const quadratic *on, const question *q, vd S, int end,
                         hit *at)
{
    const vd X = q->Dn + v_abs(at->s) * q->U, e_c = eps(3) * (q->W * X);
    const vd two = v_set(2);
    vd P[3], c[3], e_k;
    point_at(q, at, P);
    cross(c, P, q->w);
    const vd k = radius_at(q, at, &e_k), cc = dot(c, c);
    const vd Q = S * cc * q->per_ww - k * k;
    const vd e_Q = (e_c * (two * size(c) + e_c) + eps(4) * cc) * q->per_ww +
                   e_k * (two * v_abs(k) + e_k) + eps(1) * (k * k);
    step_to_root(on, q, end, Q, e_Q, at);
}

/* ---------------------------------------------------------- description -- */

/* A vector N with errors e[].  Its length is 1 / per_length, with a relative
 * error of e_length. */
typedef struct {
    vd N[3], e[3], per_length, e_length;
} bounded_vector;

/* Rounds x to a float, stored as a double.  x has an error of at most e, which
 * includes the error of the library's x.  Returns whether the float is certain. */
INLINE vm to_float(vd x, vd e, vd *f)
{
    *f = v_float(x + e);
    return v_eq(v_float(x - e), *f);
}

/* c = P x w at the hit, and its error. */
INLINE vd across(const question *q, const hit *at, vd c[3])
{
    vd P[3];
    point_at(q, at, P);
    cross(c, P, q->w);
    return q->W * (q->U * at->s_error + eps(3) * (q->Dn + v_abs(at->s) * q->U));
}

/* a: w x c and its error, which follows from e_c, rounding included.  The error is
 * computed by component: a component that is zero because components of the
 * axis are zero stays exact. */
INLINE void lateral_direction(const question *q, const vd c[3], vd e_c,
                              bounded_vector *a)
{
    const vd x = v_abs(q->w[0]), y = v_abs(q->w[1]), z = v_abs(q->w[2]);
    cross(a->N, q->w, c);
    a->e[0] = (y + z) * e_c;
    a->e[1] = (z + x) * e_c;
    a->e[2] = (x + y) * e_c;
}

INLINE void select_vector(bounded_vector *a, vm where,
                          const bounded_vector *other)
{
    EACH(j, 3) {
        a->N[j] = v_select(where, other->N[j], a->N[j]);
        a->e[j] = v_select(where, other->e[j], a->e[j]);
    }
    a->per_length = v_select(where, other->per_length, a->per_length);
    a->e_length = v_select(where, other->e_length, a->e_length);
}

/* N / |N|. */
INLINE vm unit_floats(const bounded_vector *a, vd unit[3])
{
    vm certain = m_not(m_none());
    EACH(j, 3) {
        const vd x = a->N[j] * a->per_length;
        const vd e = a->e[j] * a->per_length + v_abs(x) * a->e_length;
        certain = m_and(certain, to_float(x, v_set(1.1) * e, &unit[j]));
    }
    return certain;
}

/*
 * The lateral normal is N = w x c - k dr w, of which `a` is w x c.  Between discs k
 * is the radius at the hit.  There |c| = k |w|, so the length of N is k |w| sqrt(ww
 * + dr^2).  Of a round kind k is the radius of the ball that the cone touches
 * there, |c|^2 = S k^2 ww, and the length is k ww.  `length` has a relative error
 * of 15 u plus that of k.
 */
INLINE vm lean_on_cone(const question *q, vd k, vd e_k, vd length,
                       bounded_vector *a)
{
    const vd dr = q->dr, lean = k * dr;
    const vd e_lean = v_abs(dr) * (e_k + eps(1) * v_abs(k));
    const vm certain = v_lt(v_set(32) * e_k, k);
    EACH(j, 3) {
        a->N[j] = a->N[j] - lean * q->w[j];
        a->e[j] = a->e[j] + e_lean * v_abs(q->w[j]);
    }
    a->per_length = v_set(1) / where_or_one(certain, length);
    a->e_length = e_k / where_or_one(certain, k) + eps(3);
    return certain;
}

/* The same between discs. */
INLINE vm lean_on_discs(const question *q, const hit *at, bounded_vector *a)
{
    const vm cone = m_not(v_eq(q->dr, v_set(0)));
    bounded_vector leaning = *a;
    vd e_k;
    a->per_length = q->per_ww / v_select(cone, v_set(1), q->r0);
    a->e_length = eps(3);
    if (!m_any(cone))
        return m_not(cone);
    const vd k = radius_at(q, at, &e_k);
    e_k = e_k + v_abs(q->dr * q->dz) * at->s_error;
    const vd length = k * (q->W * v_sqrt(q->ww + q->dr * q->dr));
    const vm certain = lean_on_cone(q, k, e_k, length, &leaning);
    select_vector(a, cone, &leaning);
    return m_or(certain, m_not(cone));
}

INLINE bounded_vector cap_normal(const question *q, vm top)
{
    bounded_vector a;
    EACH(j, 3) {
        a.N[j] = v_select(top, q->w[j], -q->w[j]);
        a.e[j] = v_set(0);
    }
    a.per_length = v_set(1) / q->W;
    a.e_length = eps(2);
    return a;
}

/*
 * phi = atan2(P.(w x v), P.v |w|) over 2 pi, where v = e x w, e being the unit
 * vector along which the axis is least.  That is atan2((w x c).e, -c.e |w|).
 */
INLINE vm describe_phi(const question *q, vd e_c, vd across_w, vd c, vd *phi)
{
    vd per_far;
    const vd turn = cylint_atan2_turns(across_w, -c * q->W, &per_far);
    /* both have an error of at most W e_c, so the angle one of less than
     * sqrt(2) / (2 pi) of that over the hypotenuse; 13/12 covers per_far */
    const vd part = q->W * e_c * per_far;
    const vd e = v_set(0.25) * part + v_set(CYLINT_ATAN2_TURNS_ERROR);
    const vm inside =
        m_and(v_lt(e, turn), v_lt(turn + e, v_set(1 - (double)FLT_EPSILON)));
    return m_and(m_and(v_lt(part, v_set(0.125)), inside),
                 to_float(turn, e, phi));
}

/* least[j]: the axis is least along coordinate j, the first such.  Returns
 * whether that is uncertain: of equal doubles other than 0 the low parts
 * decide. */
INLINE vm least_components(const question *q, vm least[3])
{
    const vd x = v_abs(q->w[0]), y = v_abs(q->w[1]), z = v_abs(q->w[2]);
    const vm y_less = v_lt(y, x);
    const vd xy = v_select(y_less, y, x);
    const vm tied = m_or(m_and(v_eq(x, y), v_le(x, z)), v_eq(xy, z));
    least[2] = v_lt(z, xy);
    least[1] = m_and_not(y_less, least[2]);
    least[0] = m_not(m_or(least[1], least[2]));
    return m_and(tied, v_lt(v_set(0), v_select(least[2], z, xy)));
}

/* The component of x along which the axis is least. */
INLINE vd along_least(const vd x[3], const vm least[3])
{
    return v_select(least[1], x[1], v_select(least[2], x[2], x[0]));
}

#endif
