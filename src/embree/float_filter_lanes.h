/*
 * float_filter_lanes.h - the mathematics of the float filter
 *
 * For float_filter.c, one question in plain doubles, and for packet_filter.c,
 * one question in each vector lane.
 *
 * The error of a quantity `f` is at most `e_f`.  A rounding is u = 2^-53; eps =
 * 2^-50 is eight of them.  The double of the axis is rounded once, an acone's
 * radius has an error of 6 u.  The errors of vectors are lengths: a cross
 * product has at most 2 / sqrt(3) of the errors of its products.  W is the
 * length of the axis.  U and Dn are sizes of vectors, at least their lengths.
 *
 * Compiled as it is and again with fused multiply-add, which rounds less often:
 * the bounds hold either way.  Unused lanes divide by 1.
 */
#ifndef CYLINT_EMBREE_FLOAT_FILTER_LANES_H
#define CYLINT_EMBREE_FLOAT_FILTER_LANES_H

#include <float.h>
#include <stddef.h>

#include "../numbers/simd.h"
#include "float_filter.h"
#include "angle.h"

#if LANES == 1
typedef cylint_float_filter_state question;
typedef cylint_float_filter_hit hit;
#else
typedef struct {
    CYLINT_FLOAT_FILTER_MEMBERS(vd, vm)
} question;
typedef struct {
    CYLINT_FLOAT_FILTER_HIT_MEMBERS(vd, vm)
} hit;
#endif

/* Shapes and lines, one in each lane.  near as in cylint_float_filter_ray. */
typedef struct {
    vd base[3], axis[3], r0, dr;
} shape_columns;

typedef struct {
    vd o[3], d[3], tmin, near;
} line_columns;

/* Loads the structs of float_filter.h at row[0], row[1], ... */
INLINE shape_columns shape_of(const char *const row[LANES], int small)
{
    vd x[8];
    if (!small) {
        v_columns(row, offsetof(cylint_float_filter_shape, base), x);
        v_columns(row, offsetof(cylint_float_filter_shape, axis[1]), x + 4);
        return (shape_columns){
            {x[0], x[1], x[2]}, {x[3], x[4], x[5]}, x[6], x[7]};
    }
    v_columns_of_floats(row, offsetof(cylint_float_filter_small, base), x);
    v_columns_of_floats(row, offsetof(cylint_float_filter_small, top), x + 4);
    /* cylint_float_filter_small_of() checked that these are exact */
    return (shape_columns){{x[0], x[1], x[2]},
                           {x[4] - x[0], x[5] - x[1], x[6] - x[2]},
                           x[3],
                           x[7] - x[3]};
}

INLINE line_columns line_of(const char *const row[LANES])
{
    vd x[8];
    v_columns(row, offsetof(cylint_float_filter_ray, o), x);
    v_columns(row, offsetof(cylint_float_filter_ray, d[1]), x + 4);
    return (line_columns){{x[0], x[1], x[2]}, {x[3], x[4], x[5]}, x[6], x[7]};
}

/* hit: certainly a hit.  uncertain: undecided.  Neither: certainly no hit. */
typedef struct {
    vm hit, uncertain;
} hit_result;

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

/* Products below have at most ten lengths as factors.  If none of these is less
 * than 2^-90, a product flushed to zero is negligible.  An overflow gives an
 * infinite bound or NaN, and then nothing is certain.  The sum of the radii is not
 * positive if the record is not that of a cylinder or cone. */
INLINE vm in_window(const question *q)
{
    const vd least = v_set(0x1p-90), radii = q->r0 + (q->r0 + q->dr);
    return m_and(v_lt(v_set(0x1p-89), radii),
                 m_and(v_lt(least, q->W), v_lt(least, q->U)));
}

/*
 * Moves the origin by from * u to a point near the shape, so that the errors
 * below are relative to the shape's size, wherever the ray begins: to `near` if
 * it is known, else to the point nearest to the base.  u and `from` have 24 bits
 * each, so their product is exact.  The rounding error of o - base is added
 * again [Moller 1965, Knuth].  So D has no error but its own roundings.
 */
INLINE vd difference_error(vd x, vd y, vd difference)
{
    const vd minus_y = difference - x;
    return (x - (difference - minus_y)) - (y + minus_y);
}

INLINE vd origin_shift(const line_columns *l, const vd D0[3])
{
    const vm known = v_le(v_abs(l->near), v_set((double)FLT_MAX));
    if (!m_any(m_not(known)))
        return l->near;
    return v_select(known, l->near, v_float(-dot(D0, l->d) / dot(l->d, l->d)));
}

/*
 * Errors: D's 2 u Dn, beta's 4 u U W, alpha's 6 u W Dn, ww's 5 u ww; with n's
 * 4 u U W and m's 6 u Dn W.
 */
INLINE void load_question(question *q, const shape_columns *s,
                          const line_columns *l, vd D[3])
{
    vd D0[3];
    EACH(j, 3)
        D0[j] = l->o[j] - s->base[j];
    q->from = origin_shift(l, D0);
    EACH(j, 3)
        D[j] = (D0[j] + q->from * l->d[j]) +
               difference_error(l->o[j], s->base[j], D0[j]);
    EACH(j, 3)
        q->w[j] = s->axis[j];
    q->r0 = s->r0;
    q->ww = dot(q->w, q->w);
    q->per_ww = v_set(1) / q->ww;
    q->W = v_sqrt(q->ww);
    q->dr = s->dr;
    q->U = size(l->d);
    q->Dn = size(D);
    q->alpha = dot(D, q->w);
    q->beta = dot(l->d, q->w);
    cross(q->n, l->d, q->w);
    cross(q->m, D, q->w);
    q->tmin = l->tmin;
}

/* The lanes with a cone. */
INLINE vm is_cone(const question *q)
{
    return m_not(v_eq(q->dr, v_set(0)));
}

/*
 * With n = u x w and P = D + s u, Q(s) = |P x w|^2 - (r0 + dr P.w / ww)^2 ww =
 * a s^2 + 2 b s + c, a quarter of its discriminant being G, in the form that
 * does not cancel for origins far away:
 *
 *   a = nn - dr^2 beta^2 / ww,   b = m.n - k dr beta,   m = D x w,
 *   k = r0 + dr alpha / ww,      f = D.n,   g = r0 n + dr u x D,
 *   G = ww gg - (ww + dr^2) ff.
 *
 * If a > 0, Q < 0 between the roots, on one nappe.  If a < 0, Q < 0 before the
 * first root and behind the second, on one nappe each.  The nappe with positive
 * radii is the second's if the radii grow along the line; its chord has one end
 * only.  In both cases the chord begins at (-b - sqrt(G)) / a and ends at
 * (-b + sqrt(G)) / a.  Errors, where S = U (r0 W + |dr| Dn) bounds |g|:
 *
 *   f: 9 u Dn U W.   g: 14 u S.   ww gg: 37 u ww S^2.   ww + dr^2: 13 u of it.
 *   a: 10 u U^2 W^2 + 30 u dr^2 U^2; a cylinder's a is positive if G is.
 */
INLINE hit_result cross_lateral(question *q, const vd u[3], const vd D[3])
{
    const vd r0 = q->r0, dr = q->dr, kb = dr * q->beta;
    const vd ww = q->ww, N = q->U * q->W, f = dot(D, q->n);
    const vm cone = is_cone(q);
    vm known = in_window(q);
    vd S = r0 * N, slant = ww, b = dot(q->m, q->n), gg;
    q->a = dot(q->n, q->n);
    gg = r0 * r0 * q->a;
    if (m_any(cone)) {
        vd g[3];
        cross(g, u, D);
        EACH(j, 3)
            g[j] = r0 * q->n[j] + dr * g[j];
        gg = v_select(cone, dot(g, g), gg);
        S = S + v_abs(dr) * q->U * q->Dn;
        slant = slant + dr * dr;
        b = b - (r0 + dr * q->alpha * q->per_ww) * kb;
        q->a = q->a - kb * kb * q->per_ww;
        const vd e_a = eps(4) * (N * N) + eps(8) * (dr * dr * (q->U * q->U));
        known = m_and(known, m_or(m_not(cone), v_lt(e_a, v_abs(q->a))));
    }
    const vd G = ww * gg - slant * (f * f), e_f = eps(2) * q->Dn * N;
    const vd e_G =
        eps(6) * ww * (S * S) +
        slant * (e_f * (v_set(2) * v_abs(f) + e_f) + eps(2) * (f * f));
    const vm is = m_and(known, v_lt(v_set(16) * e_G, G));
    const vm is_not = m_and(known, v_lt(G, -e_G));
    q->crosses = is;
    if (m_any(is)) {
        const vd per_a = v_set(1) / v_select(is, q->a, v_set(1));
        q->root = v_sqrt(v_select(is, G, v_set(1)));
        q->per_root = v_set(1) / q->root;
        q->s[0] = (-b - q->root) * per_a;
        q->s[1] = (-b + q->root) * per_a;
        const vm apart = v_lt(q->a, v_set(0)), grows = v_lt(v_set(0), kb);
        q->endless[0] = m_and(apart, m_not(grows));
        q->endless[1] = m_and(apart, grows);
    }
    return (hit_result){is, m_not(m_or(is, is_not))};
}

/*
 * Evaluates the line at s: c = P x w = m + s n, z and the radius k.  The residual
 * of Q there bounds the distance of s from the root.
 *
 * With X = Dn + |s| U and K = r0 + |dr| X / W the errors are
 *
 *   c: 7 u Dn W + 6 u |s| U W < eps W X, alpha + s beta no more than that;
 *   k: 23 u K < 3 eps K, for a cylinder 0;
 *   Q: e_c (2 |c| + e_c) + e_k (2 |k| + e_k) ww + eps (cc + kk ww).
 *
 * s is on the root's side of the middle if the sign of a s + b, which is
 * -+sqrt(G), is certain.  Its errors: b: 13 u Dn U W^2 + 28 u |dr| K U W;
 * s a: 10 u |s| U^2 W^2 + 31 u |dr| K U W;  s: 4 u (|b| + sqrt(G)).
 * Then |Q| = |s - root| |2 sqrt(G) +- a |s - root|| >= |s - root| sqrt(G).  The
 * error of G is at most G / 16 and that of a at most a / 2.  So this first
 * bounds a |s - root| by sqrt(G) / 5, and then |s - root| by
 * 0.57 |Q| / sqrt(G).
 *
 * The bound of z includes the error of the library's z: its dividend and divisor
 * are right to 2^-54 of themselves (hit.c), so with its roundings it is right to
 * eps |z| / 2.  The eps / 16 besides is to spare.
 */
INLINE vm evaluate_at(const question *q, vd s, hit *at)
{
    const vd X = q->Dn + v_abs(s) * q->U, N = q->U * q->W;
    const vd e_c = eps(1) * q->W * X, dr = v_abs(q->dr);
    const int cones = m_any(is_cone(q));
    vd e_k = v_set(0), e_H = v_set(4) * e_c;
    EACH(j, 3)
        at->c[j] = q->m[j] + s * q->n[j];
    at->s = s;
    at->z = (q->alpha + s * q->beta) * q->per_ww;
    at->k = q->r0;
    if (cones) {
        const vd K = q->r0 + dr * X * (q->W * q->per_ww);
        at->k = at->k + q->dr * at->z;
        e_k = v_select(is_cone(q), eps(3) * K, e_k);
        e_H = e_H + eps(8) * dr * K;
    }
    const vd c = size(at->c), cc = dot(at->c, at->c);
    const vd kkww = at->k * at->k * q->ww;
    vd e_Q = e_c * (v_set(2) * c + e_c) + eps(1) * (cc + kkww);
    if (cones)
        e_Q = e_Q + e_k * (v_set(2) * v_abs(at->k) + e_k) * q->ww;
    const vd root_error = (v_abs(cc - kkww) + e_Q) * q->per_root;
    at->s_error = v_set(0.6) * root_error;
    at->e_c = e_c + N * at->s_error + eps(1) * c;
    at->e_k = e_k + dr * N * q->per_ww * at->s_error;
    at->z_error = at->e_c * q->per_ww + eps(1) * (v_abs(at->z) + v_set(0.0625));
    return m_and(v_lt(v_set(9) * v_abs(q->a) * root_error, q->root),
                 v_lt(N * e_H, q->root));
}

/* Where the chord begins (i = 0) or ends (i = 1): below the base, between base
 * and top, above the top.  None of these where that is uncertain. */
typedef struct {
    vm below, between, above;
} axial_range;

INLINE axial_range axial_range_at(const question *q, int i, hit *at)
{
    const vm certain = evaluate_at(q, q->s[i], at), endless = q->endless[i];
    const vm rises = v_lt(v_set(0), q->beta);
    const vm beyond = i == 1 ? rises : m_not(rises); /* the top */
    const vm ends = m_and(certain, m_not(endless));
    const vd e = at->z_error + eps(1);
    return (axial_range){
        m_or(m_and(ends, v_lt(at->z, -e)), m_and(endless, m_not(beyond))),
        m_and(ends, m_and(v_lt(e, at->z), v_lt(at->z, v_set(1) - e))),
        m_or(m_and(ends, v_lt(v_set(1) + e, at->z)), m_and(endless, beyond))};
}

INLINE vm uncertain(const axial_range *l)
{
    return m_not(m_or(l->below, m_or(l->between, l->above)));
}

/* Computes where the line crosses the plane of the base or the top. */
INLINE vm hit_plane(const question *q, vm top, hit *at)
{
    const vd rise = v_select(top, q->ww, v_set(0)) - q->alpha;
    const vd N = q->U * q->W, b = v_abs(q->beta), e_b = eps(1) * N;
    const vm certain = v_lt(v_set(2) * e_b, b);
    const vd per_b = v_set(1) / v_select(certain, b, v_set(1));
    at->s = v_select(v_lt(q->beta, v_set(0)), -rise, rise) * per_b;
    at->s_error =
        v_set(2) *
            (eps(1) * q->W * q->Dn + eps(1) * (q->ww + v_abs(q->alpha)) +
             v_abs(at->s) * e_b) *
            per_b +
        eps(1) * v_abs(at->s);
    EACH(j, 3)
        at->c[j] = q->m[j] + at->s * q->n[j];
    at->e_c = eps(1) * (q->W * (q->Dn + v_abs(at->s) * q->U) + size(at->c)) +
              N * at->s_error;
    at->z = v_select(top, v_set(1), v_set(0));
    at->z_error = v_set(0);
    return certain;
}

/* Copies *other in the lanes `where`. */
INLINE void select_hit(hit *at, vm where, const hit *other)
{
    at->s = v_select(where, other->s, at->s);
    at->s_error = v_select(where, other->s_error, at->s_error);
    at->z = v_select(where, other->z, at->z);
    at->z_error = v_select(where, other->z_error, at->z_error);
    at->e_c = v_select(where, other->e_c, at->e_c);
    EACH(j, 3)
        at->c[j] = v_select(where, other->c[j], at->c[j]);
}

/* For chords that begin or end at s[i] below the base or above the top: the hit
 * on the cap that the chord crosses. */
INLINE hit_result hit_cap(const question *q, int i, const axial_range *here,
                          hit *at)
{
    hit other, cap;
    const vm outside = m_or(here->below, here->above);
    const vm present =
        m_or(m_and(here->below, q->cap[0]), m_and(here->above, q->cap[1]));
    const axial_range there = axial_range_at(q, 1 - i, &other);
    const vm lost = m_and(outside, uncertain(&there));
    const vm stays =
        m_or(m_and(here->below, there.below), m_and(here->above, there.above));
    const vm comes = m_and(m_and(outside, present), m_not(m_or(lost, stays)));
    if (!m_any(comes))
        return (hit_result){comes, lost};
    const vm certain = hit_plane(q, here->above, &cap);
    select_hit(at, comes, &cap);
    at->capped = comes;
    at->top = here->above;
    return (hit_result){m_and(comes, certain),
                        m_or(lost, m_and(comes, m_not(certain)))};
}

INLINE hit_result hit_at_end(const question *q, int i, hit *at)
{
    const axial_range here = axial_range_at(q, i, at);
    const vm outside = m_or(here.below, here.above);
    hit_result is = {here.between, uncertain(&here)};
    at->capped = at->top = m_none();
    if (m_any(outside)) {
        const hit_result cap = hit_cap(q, i, &here, at);
        is.hit = m_or(is.hit, cap.hit);
        is.uncertain = m_or(is.uncertain, cap.uncertain);
    }
    at->t = q->from + at->s;
    at->t_error = at->s_error + eps(1) * v_abs(at->t);
    const vm later = v_lt(q->tmin + at->t_error, at->t);
    const vm before = v_lt(at->t, q->tmin - at->t_error);
    is.uncertain =
        m_or(is.uncertain, m_and(is.hit, m_not(m_or(later, before))));
    is.hit = m_and(is.hit, later);
    is.hit = m_and(is.hit, q->crosses);
    is.uncertain = m_and(is.uncertain, q->crosses);
    return is;
}

/* Loads the question.  hit: the line crosses the lateral surface, and
 * hit_at_end() decides about hits. */
INLINE hit_result load_and_cross(question *q, const shape_columns *s,
                                 const line_columns *l)
{
    vd D[3];
    load_question(q, s, l, D);
    return cross_lateral(q, l->d, D);
}

/* ---------------------------------------------------------- description -- */

/* Floats, stored as doubles. */
typedef struct {
    vd z, phi, normal[3];
} floats;

/* Rounds x to a float.  x has an error of at most e, which includes the error of
 * the library's x.  Returns whether the float is certain. */
INLINE vm to_float(vd x, vd e, vd *f)
{
    *f = v_float(x + e);
    return v_eq(v_float(x - e), *f);
}

/* w x c and its error, which follows from e_c, rounding included.  The error is
 * computed by component: a component that is zero because components of the
 * axis are zero stays exact. */
INLINE void lateral_direction(const question *q, const hit *at, vd N[3],
                              vd e[3])
{
    const vd x = v_abs(q->w[0]), y = v_abs(q->w[1]), z = v_abs(q->w[2]);
    cross(N, q->w, at->c);
    e[0] = (y + z) * at->e_c;
    e[1] = (z + x) * at->e_c;
    e[2] = (x + y) * at->e_c;
}

#if LANES == 1
typedef cylint_bounded_vector bounded_vector;
#else
typedef struct {
    CYLINT_BOUNDED_VECTOR_MEMBERS(vd)
} bounded_vector;
#endif

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
 * The lateral normal is N = w x c - k dr w.  On the surface |c| = k |w|, so its
 * length is k |w| sqrt(ww + dr^2), with a relative error of 15 u plus that of k.
 */
INLINE vm cone_normal(const question *q, const hit *at,
                      const bounded_vector *across_w, bounded_vector *to)
{
    const vd dr = q->dr, k = at->k, lean = k * dr;
    const vd e_lean = v_abs(dr) * (at->e_k + eps(1) * v_abs(k));
    const vm certain = v_lt(v_set(32) * at->e_k, k);
    const vd length = k * (q->W * v_sqrt(q->ww + dr * dr));
    EACH(j, 3) {
        to->N[j] = across_w->N[j] - lean * q->w[j];
        to->e[j] = across_w->e[j] + e_lean * v_abs(q->w[j]);
    }
    to->per_length = v_set(1) / v_select(certain, length, v_set(1));
    to->e_length = at->e_k / v_select(certain, k, v_set(1)) + eps(3);
    return certain;
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

INLINE vm describe_normal(const question *q, const hit *at,
                          bounded_vector *across_w, vd normal[3])
{
    const vm cone = is_cone(q), capped = at->capped;
    bounded_vector a = *across_w;
    vm certain = m_not(m_none());
    a.per_length = q->per_ww / v_select(cone, v_set(1), q->r0);
    a.e_length = eps(3);
    if (m_any(cone)) {
        bounded_vector leaning;
        certain = m_or(cone_normal(q, at, across_w, &leaning), m_not(cone));
        select_vector(&a, cone, &leaning);
    }
    if (m_any(capped)) {
        const bounded_vector up = cap_normal(q, at->top);
        select_vector(&a, capped, &up);
    }
    return m_and(m_or(certain, capped), unit_floats(&a, normal));
}

/*
 * phi = atan2(P.(w x v), P.v |w|) over 2 pi, where v = e x w, e being the unit
 * vector along which the axis is least.  That is atan2((w x c).e, -c.e |w|).
 */
INLINE vm describe_phi(const question *q, const hit *at, vd across_w, vd c,
                       vd *phi)
{
    vd per_far;
    const vd turn = cylint_atan2_turns(across_w, -c * q->W, &per_far);
    /* both have an error of at most W e_c, so the angle one of less than
     * sqrt(2) / (2 pi) of that over the hypotenuse; 13/12 covers per_far */
    const vd part = q->W * at->e_c * per_far;
    const vd e = v_set(0.25) * part + v_set(CYLINT_ATAN2_TURNS_ERROR);
    const vm inside =
        m_and(v_lt(e, turn), v_lt(turn + e, v_set(1 - (double)FLT_EPSILON)));
    return m_and(m_and(v_lt(part, v_set(0.125)), inside),
                 to_float(turn, e, phi));
}

/* least[j]: the axis is least along coordinate j, the first such.  Returns
 * whether that is certain: of equal doubles other than 0 the low parts decide. */
INLINE vm least_components(const question *q, vm least[3])
{
    const vd x = v_abs(q->w[0]), y = v_abs(q->w[1]), z = v_abs(q->w[2]);
    const vm y_less = v_lt(y, x);
    const vd xy = v_select(y_less, y, x);
    const vm tied = m_or(m_and(v_eq(x, y), v_le(x, z)), v_eq(xy, z));
    least[2] = v_lt(z, xy);
    least[1] = m_and(y_less, m_not(least[2]));
    least[0] = m_not(m_or(least[1], least[2]));
    return m_not(m_and(tied, v_lt(v_set(0), v_select(least[2], z, xy))));
}

INLINE vm describe_lanes(const question *q, const hit *at, const vm least[3],
                         floats *to)
{
    bounded_vector a;
    lateral_direction(q, at, a.N, a.e);
    const vd across_w =
        v_select(least[1], a.N[1], v_select(least[2], a.N[2], a.N[0]));
    const vd c =
        v_select(least[1], at->c[1], v_select(least[2], at->c[2], at->c[0]));
    vm certain = to_float(at->z, at->z_error, &to->z);
    certain = m_and(certain, describe_phi(q, at, across_w, c, &to->phi));
    return m_and(certain, describe_normal(q, at, &a, to->normal));
}

#endif
