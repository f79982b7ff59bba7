/*
 * quicklanes.h - a hit in doubles, where doubles are certain of it, in lanes
 *
 * The mathematics of float_filter.c, of one question in plain doubles, and of
 * packet_filter.c, of as many as there are lanes.
 *
 * Every quantity comes with a bound on its error, in the same letters: `f` is
 * wrong by at most `e_f`.  Roundings u = 2^-53 are counted in eps = 2^-50,
 * eight of them; the axis, whose double is rounded once, is wrong by u, an
 * acone's radius by 6 u.  Those of vectors are of lengths: a cross product's
 * is at most 2 / sqrt(3) of those of its products.  W is the axis's length, U
 * and Dn are sizes of vectors, never less than that.
 *
 * Compiled as it is and, where the processor has fused multiply-add,
 * contracted: which rounds less, and all that is told is certain either way.
 * Lanes of which nothing is to be known are not divided by what may be 0.
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

/* Shapes and lines as they are asked for; near is not finite where nothing is
 * known. */
typedef struct {
    vd base[3], axis[3], r0, dr;
} cut_shape;

typedef struct {
    vd o[3], d[3], tmin, near;
} cut_line;

/* Of one in every lane, from the structs of float_filter.h at row[0], row[1], ... */
INLINE cut_shape shape_of(const char *const row[LANES], int small)
{
    vd x[8];
    if (!small) {
        v_columns(row, offsetof(cylint_float_filter_shape, base), x);
        v_columns(row, offsetof(cylint_float_filter_shape, axis[1]), x + 4);
        return (cut_shape){{x[0], x[1], x[2]}, {x[3], x[4], x[5]}, x[6], x[7]};
    }
    v_columns_of_floats(row, offsetof(cylint_float_filter_small, base), x);
    v_columns_of_floats(row, offsetof(cylint_float_filter_small, top), x + 4);
    /* differences that were doubles are the same doubles again */
    return (cut_shape){{x[0], x[1], x[2]},
                       {x[4] - x[0], x[5] - x[1], x[6] - x[2]},
                       x[3],
                       x[7] - x[3]};
}

INLINE cut_line line_of(const char *const row[LANES])
{
    vd x[8];
    v_columns(row, offsetof(cylint_float_filter_ray, o), x);
    v_columns(row, offsetof(cylint_float_filter_ray, d[1]), x + 4);
    return (cut_line){{x[0], x[1], x[2]}, {x[3], x[4], x[5]}, x[6], x[7]};
}

/* Neither: certainly not. */
typedef struct {
    vm hit, unsure;
} verdict;

/* So many eps. */
INLINE vd few(double n)
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

/* Products below are of at most ten lengths, none of which may be smaller than
 * this, if it matters beside the others: so what is flushed to zero does not.
 * What overflows leaves infinite bounds or NaN, of which nothing is certain. */
INLINE vm in_window(const question *q)
{
    const vd least = v_set(0x1p-90), R = q->r0 + v_abs(q->dr);
    return m_and(v_lt(least, R), m_and(v_lt(least, q->W), v_lt(least, q->U)));
}

/*
 * The origin is moved by `from` multiples of u to near the shape, so that what
 * follows has errors of the shape's size, however far the ray began: to what
 * is known to be near or, else, to the point nearest to the base.  u and
 * `from` having 24 bits, their product is exact; what is lost in o - base is
 * found again [Moller 1965, Knuth]; so D is wrong by its own roundings only.
 */
INLINE vd lost_by_difference(vd x, vd y, vd difference)
{
    const vd minus_y = difference - x;
    return (x - (difference - minus_y)) - (y + minus_y);
}

INLINE vd place_near(const cut_line *l, const vd D0[3])
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
INLINE void place(question *q, const cut_shape *s, const cut_line *l, vd D[3])
{
    vd D0[3];
    EACH(j, 3)
        D0[j] = l->o[j] - s->base[j];
    q->from = place_near(l, D0);
    EACH(j, 3)
        D[j] = (D0[j] + q->from * l->d[j]) +
               lost_by_difference(l->o[j], s->base[j], D0[j]);
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

/* Whether any is that of a cone. */
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
 * a > 0: Q < 0 between the roots, on one nappe.  a < 0: before the first root
 * and behind the second, on one nappe each; that where radii are positive is
 * the second's if they grow along the line, and its chord has no other end.
 * Either way the chord begins at (-b - sqrt(G)) / a and ends at (-b + sqrt(G))
 * / a.  Errors, S being the bound U (r0 W + |dr| Dn) of |g|:
 *
 *   f: 9 u Dn U W.   g: 14 u S.   ww gg: 37 u ww S^2.   ww + dr^2: 13 u of it.
 *   a: 10 u U^2 W^2 + 30 u dr^2 U^2; that of a cylinder is positive if G is.
 */
INLINE verdict cut(question *q, const vd u[3], const vd D[3])
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
        const vd e_a = few(4) * (N * N) + few(8) * (dr * dr * (q->U * q->U));
        known = m_and(known, m_or(m_not(cone), v_lt(e_a, v_abs(q->a))));
    }
    const vd G = ww * gg - slant * (f * f), e_f = few(2) * q->Dn * N;
    const vd e_G =
        few(6) * ww * (S * S) +
        slant * (e_f * (v_set(2) * v_abs(f) + e_f) + few(2) * (f * f));
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
    return (verdict){is, m_not(m_or(is, is_not))};
}

/*
 * What the line has at s: c = P x w = m + s n, z, k; and how far s is from
 * the root of Q that it is taken for, by what Q leaves there.
 *
 * With X = Dn + |s| U and K = r0 + |dr| X / W the errors are
 *
 *   c: 7 u Dn W + 6 u |s| U W < eps W X, alpha + s beta no more;
 *   k: 23 u K < 3 eps K, none of a cylinder's;
 *   Q: e_c (2 |c| + e_c) + e_k (2 |k| + e_k) ww + eps (cc + kk ww).
 *
 * s is on the root's side of the middle if a s + b, which is -+sqrt(G) as
 * computed, is certain of its sign.  Its errors: b: 13 u Dn U W^2 + 28 u |dr|
 * K U W;  s a: 10 u |s| U^2 W^2 + 31 u |dr| K U W;  and 4 u (|b| + sqrt(G))
 * for s.  Then |Q| = |s - root| |2 sqrt(G) +- a |s - root|| >= |s - root|
 * sqrt(G).  G being known to 1/16 of it and a to 1/2, this first bounds
 * a |s - root| by sqrt(G) / 5, and then |s - root| by 0.57 of |Q| / sqrt(G).
 *
 * z is compared with the library's, whose dividend has 54 bits beside its
 * divisor (keeps_digits() of hit.c), however small it is itself: so that is
 * wrong by 2^-54 = eps / 16 and by roundings of z, for which eps |z| has room.
 */
INLINE vm meet(const question *q, vd s, hit *at)
{
    const vd X = q->Dn + v_abs(s) * q->U, N = q->U * q->W;
    const vd e_c = few(1) * q->W * X, dr = v_abs(q->dr);
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
        e_k = v_select(is_cone(q), few(3) * K, e_k);
        e_H = e_H + few(8) * dr * K;
    }
    const vd c = size(at->c), cc = dot(at->c, at->c);
    const vd kkww = at->k * at->k * q->ww;
    vd e_Q = e_c * (v_set(2) * c + e_c) + few(1) * (cc + kkww);
    if (cones)
        e_Q = e_Q + e_k * (v_set(2) * v_abs(at->k) + e_k) * q->ww;
    const vd off = (v_abs(cc - kkww) + e_Q) * q->per_root;
    at->s_error = v_set(0.6) * off;
    at->e_c = e_c + N * at->s_error + few(1) * c;
    at->e_k = e_k + dr * N * q->per_ww * at->s_error;
    at->z_error = at->e_c * q->per_ww + few(1) * (v_abs(at->z) + v_set(0.0625));
    return m_and(v_lt(v_set(9) * v_abs(q->a) * off, q->root),
                 v_lt(N * e_H, q->root));
}

/* Where the line is as it begins (i = 0) or ceases to be inside the lateral
 * surface; none of them where that is uncertain. */
typedef struct {
    vm below, between, above; /* the base, both ends, the top */
} level;

INLINE level level_at(const question *q, int i, hit *at)
{
    const vm sure = meet(q, q->s[i], at), endless = q->endless[i];
    const vm rises = v_lt(v_set(0), q->beta);
    const vm beyond = i == 1 ? rises : m_not(rises); /* the top */
    const vm ends = m_and(sure, m_not(endless));
    const vd e = at->z_error + few(1);
    return (level){
        m_or(m_and(ends, v_lt(at->z, -e)), m_and(endless, m_not(beyond))),
        m_and(ends, m_and(v_lt(e, at->z), v_lt(at->z, v_set(1) - e))),
        m_or(m_and(ends, v_lt(v_set(1) + e, at->z)), m_and(endless, beyond))};
}

INLINE vm uncertain(const level *l)
{
    return m_not(m_or(l->below, m_or(l->between, l->above)));
}

/* Where the line pierces the plane of the base or the top. */
INLINE vm pierce(const question *q, vm top, hit *at)
{
    const vd rise = v_select(top, q->ww, v_set(0)) - q->alpha;
    const vd N = q->U * q->W, b = v_abs(q->beta), e_b = few(1) * N;
    const vm sure = v_lt(v_set(2) * e_b, b);
    const vd per_b = v_set(1) / v_select(sure, b, v_set(1));
    at->s = v_select(v_lt(q->beta, v_set(0)), -rise, rise) * per_b;
    at->s_error =
        v_set(2) *
            (few(1) * q->W * q->Dn + few(1) * (q->ww + v_abs(q->alpha)) +
             v_abs(at->s) * e_b) *
            per_b +
        few(1) * v_abs(at->s);
    EACH(j, 3)
        at->c[j] = q->m[j] + at->s * q->n[j];
    at->e_c = few(1) * (q->W * (q->Dn + v_abs(at->s) * q->U) + size(at->c)) +
              N * at->s_error;
    at->z = v_select(top, v_set(1), v_set(0));
    at->z_error = v_set(0);
    return sure;
}

/* What is the other's where that is so. */
INLINE void choose(hit *at, vm where, const hit *other)
{
    at->s = v_select(where, other->s, at->s);
    at->s_error = v_select(where, other->s_error, at->s_error);
    at->z = v_select(where, other->z, at->z);
    at->z_error = v_select(where, other->z_error, at->z_error);
    at->e_c = v_select(where, other->e_c, at->e_c);
    EACH(j, 3)
        at->c[j] = v_select(where, other->c[j], at->c[j]);
}

/* Where the chord that begins at s[i], outside both ends, comes upon a cap from
 * beyond it. */
INLINE verdict stop_at_cap(const question *q, int i, const level *here, hit *at)
{
    hit other, cap;
    const vm outside = m_or(here->below, here->above);
    const vm present =
        m_or(m_and(here->below, q->cap[0]), m_and(here->above, q->cap[1]));
    const level there = level_at(q, 1 - i, &other);
    const vm lost = m_and(outside, uncertain(&there));
    const vm stays =
        m_or(m_and(here->below, there.below), m_and(here->above, there.above));
    const vm comes = m_and(m_and(outside, present), m_not(m_or(lost, stays)));
    if (!m_any(comes))
        return (verdict){comes, lost};
    const vm sure = pierce(q, here->above, &cap);
    choose(at, comes, &cap);
    at->capped = comes;
    at->top = here->above;
    return (verdict){m_and(comes, sure), m_or(lost, m_and(comes, m_not(sure)))};
}

INLINE verdict stop(const question *q, int i, hit *at)
{
    const level here = level_at(q, i, at);
    const vm outside = m_or(here.below, here.above);
    verdict is = {here.between, uncertain(&here)};
    at->capped = at->top = m_none();
    if (m_any(outside)) {
        const verdict cap = stop_at_cap(q, i, &here, at);
        is.hit = m_or(is.hit, cap.hit);
        is.unsure = m_or(is.unsure, cap.unsure);
    }
    at->t = q->from + at->s;
    at->t_error = at->s_error + few(1) * v_abs(at->t);
    const vm later = v_lt(q->tmin + at->t_error, at->t);
    const vm before = v_lt(at->t, q->tmin - at->t_error);
    is.unsure = m_or(is.unsure, m_and(is.hit, m_not(m_or(later, before))));
    is.hit = m_and(is.hit, later);
    is.hit = m_and(is.hit, q->crosses);
    is.unsure = m_and(is.unsure, q->crosses);
    return is;
}

/* Whether the line comes into the lateral surface at all; if so it may stop()
 * there. */
INLINE verdict crosses(question *q, const cut_shape *s, const cut_line *l)
{
    vd D[3];
    place(q, s, l, D);
    return cut(q, l->d, D);
}

/* ---------------------------------------------------------- description -- */

/* Floats, as doubles. */
typedef struct {
    vd z, phi, normal[3];
} floats;

/* x, which is wrong by at most e, the library's own error included, as a
 * float, if that is certain. */
INLINE vm to_float(vd x, vd e, vd *f)
{
    *f = v_float(x + e);
    return v_eq(v_float(x - e), *f);
}

/* w x c, and its error from e_c, where rounding is counted, by component, so
 * that components that are zero because those of the axis are stay certain. */
INLINE void across(const question *q, const hit *at, vd N[3], vd e[3])
{
    const vd x = v_abs(q->w[0]), y = v_abs(q->w[1]), z = v_abs(q->w[2]);
    cross(N, q->w, at->c);
    e[0] = (y + z) * at->e_c;
    e[1] = (z + x) * at->e_c;
    e[2] = (x + y) * at->e_c;
}

/* A vector N, wrong by at most e[], the length of which is 1 / per_length, by
 * at most e_length of it. */
typedef struct {
    vd N[3], e[3], per_length, e_length;
} arrow;

INLINE void choose_arrow(arrow *a, vm where, const arrow *other)
{
    EACH(j, 3) {
        a->N[j] = v_select(where, other->N[j], a->N[j]);
        a->e[j] = v_select(where, other->e[j], a->e[j]);
    }
    a->per_length = v_select(where, other->per_length, a->per_length);
    a->e_length = v_select(where, other->e_length, a->e_length);
}

/* N / |N|. */
INLINE vm unit_floats(const arrow *a, vd unit[3])
{
    vm sure = m_not(m_none());
    EACH(j, 3) {
        const vd x = a->N[j] * a->per_length;
        const vd e = a->e[j] * a->per_length + v_abs(x) * a->e_length;
        sure = m_and(sure, to_float(x, v_set(1.1) * e, &unit[j]));
    }
    return sure;
}

/*
 * The lateral normal is N = w x c - k dr w.  On the surface, where |c| = k
 * |w|, it is as long as k |w| sqrt(ww + dr^2), which is known to 15 u of it,
 * and to what k is.
 */
INLINE vm lean(const question *q, const hit *at, const arrow *across_w,
               arrow *to)
{
    const vd dr = q->dr, k = at->k, lean = k * dr;
    const vd e_lean = v_abs(dr) * (at->e_k + few(1) * v_abs(k));
    const vm sure = v_lt(v_set(32) * at->e_k, k);
    const vd length = k * (q->W * v_sqrt(q->ww + dr * dr));
    EACH(j, 3) {
        to->N[j] = across_w->N[j] - lean * q->w[j];
        to->e[j] = across_w->e[j] + e_lean * v_abs(q->w[j]);
    }
    to->per_length = v_set(1) / v_select(sure, length, v_set(1));
    to->e_length = at->e_k / v_select(sure, k, v_set(1)) + few(3);
    return sure;
}

INLINE arrow upright(const question *q, vm top)
{
    arrow a;
    EACH(j, 3) {
        a.N[j] = v_select(top, q->w[j], -q->w[j]);
        a.e[j] = v_set(0);
    }
    a.per_length = v_set(1) / q->W;
    a.e_length = few(2);
    return a;
}

INLINE vm describe_normal(const question *q, const hit *at, arrow *across_w,
                          vd normal[3])
{
    const vm cone = is_cone(q), capped = at->capped;
    arrow a = *across_w;
    vm sure = m_not(m_none());
    a.per_length = q->per_ww / v_select(cone, v_set(1), q->r0);
    a.e_length = few(3);
    if (m_any(cone)) {
        arrow leaning;
        sure = m_or(lean(q, at, across_w, &leaning), m_not(cone));
        choose_arrow(&a, cone, &leaning);
    }
    if (m_any(capped)) {
        const arrow up = upright(q, at->top);
        choose_arrow(&a, capped, &up);
    }
    return m_and(m_or(sure, capped), unit_floats(&a, normal));
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
    /* both are wrong by at most W e_c, so the angle by less than sqrt(2) / (2
     * pi) of that over the hypotenuse, 13/12 at most for per_far */
    const vd part = q->W * at->e_c * per_far;
    const vd e = v_set(0.25) * part + v_set(CYLINT_ATAN2_TURNS_ERROR);
    const vm inside =
        m_and(v_lt(e, turn), v_lt(turn + e, v_set(1 - (double)FLT_EPSILON)));
    return m_and(m_and(v_lt(part, v_set(0.125)), inside),
                 to_float(turn, e, phi));
}

/* least[j]: whether the axis is least along coordinate j, the first such; not
 * known where only the low parts of coordinates tell: what is 0 has none. */
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
    arrow a;
    across(q, at, a.N, a.e);
    const vd across_w =
        v_select(least[1], a.N[1], v_select(least[2], a.N[2], a.N[0]));
    const vd c =
        v_select(least[1], at->c[1], v_select(least[2], at->c[2], at->c[0]));
    vm sure = to_float(at->z, at->z_error, &to->z);
    sure = m_and(sure, describe_phi(q, at, across_w, c, &to->phi));
    return m_and(sure, describe_normal(q, at, &a, to->normal));
}

#endif
