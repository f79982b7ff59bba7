/*
 * float_filter_describe.h - the floats of a hit
 *
 * For float_filter.c, in the notation of float_filter_lanes.h.
 */
#ifndef CYLINT_EMBREE_FLOAT_FILTER_DESCRIBE_H
#define CYLINT_EMBREE_FLOAT_FILTER_DESCRIBE_H

#include "angle.h"
#include "float_filter_lanes.h"

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
INLINE vd across(const questions *q, const hit *at, vd c[3])
{
    vd P[3];
    point_at(q, at, P);
    cross(c, P, q->w);
    return q->W * (q->U * at->s_error + eps(3) * (q->Dn + v_abs(at->s) * q->U));
}

/* a: w x c and its error, which follows from e_c, rounding included, and its length
 * on a cylinder.  The error is computed by component: a component that is zero
 * because components of the axis are zero stays exact. */
INLINE void lateral_direction(const questions *q, const vd c[3], vd e_c,
                              bounded_vector *a)
{
    const vd x = v_abs(q->w[0]), y = v_abs(q->w[1]), z = v_abs(q->w[2]);
    cross(a->N, q->w, c);
    a->e[0] = (y + z) * e_c;
    a->e[1] = (z + x) * e_c;
    a->e[2] = (x + y) * e_c;
    a->per_length = q->per_ww / where_or_one(v_lt(v_set(0), q->r0), q->r0);
    a->e_length = eps(3);
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
 * The lateral normal is N = S (w x c) - k dr w, of which `a` is w x c.  As |c|^2 =
 * k^2 ww / S, its length is k |w| sqrt(S ww + dr^2), with a relative error of 20 u
 * plus that of k.
 */
INLINE vm lean_on_cone(const questions *q, const hit *at, vm lateral,
                       bounded_vector *a)
{
    const vd dr = q->dr;
    vd e_k;
    if (!m_any(m_not(v_eq(dr, v_set(0)))))
        return lateral;
    const vd k = radius_at(q, at, &e_k), lean = k * dr;
    e_k = e_k + v_abs(dr * q->dz) * at->s_error;
    const vd e_lean = v_abs(dr) * (e_k + eps(1) * v_abs(k));
    const vm certain = m_and(lateral, v_lt(v_set(32) * e_k, k));
    EACH(j, 3) {
        const vd N = q->S * a->N[j];
        a->e[j] =
            q->S * a->e[j] + eps(2) * v_abs(a->N[j]) + e_lean * v_abs(q->w[j]);
        a->N[j] = N - lean * q->w[j];
    }
    const vd length = k * (q->W * v_sqrt(q->S * q->ww + dr * dr));
    a->per_length = v_set(1) / where_or_one(certain, length);
    a->e_length = e_k / where_or_one(certain, k) + eps(3);
    return certain;
}

/* The outward normal on a cap, or on the ball about an end, in the lanes `where`:
 * -w or w, or P from the centre. */
INLINE void set_end_normal(const questions *q, const hit *at, int is_round,
                           vm where, bounded_vector *a)
{
    const vd zero = v_set(0), one = v_set(1);
    vd P[3], e = zero, length = q->W, e_length = eps(2);
    if (is_round) {
        const vd X = point_on_ball(q, at, P);
        const vd r = v_select(at->top, q->r0 + q->dr, q->r0);
        e = q->U * at->s_error + eps(1) * X;
        length = where_or_one(v_lt(zero, r), r);
        e_length = eps(1) * (q->R / length + one);
    }
    EACH(j, 3) {
        const vd w = q->w[j], center = v_select(at->top, w, zero);
        const vd sizes =
            v_abs(q->D[j]) + v_abs(at->s * q->u[j]) + v_abs(center);
        const vd N = is_round ? P[j] : v_select(at->top, w, -w);
        a->N[j] = v_select(where, N, a->N[j]);
        a->e[j] =
            v_select(where, v_select(v_lt(zero, sizes), e, zero), a->e[j]);
    }
    a->per_length = v_select(where, one / length, a->per_length);
    a->e_length = v_select(where, e_length, a->e_length);
}

/*
 * phi = atan2(P.(w x v), P.v |w|) over 2 pi, where v = e x w, e being the unit
 * vector along which the axis is least.  That is atan2((w x c).e, -c.e |w|).
 */
INLINE vm describe_phi(const questions *q, vd e_c, vd across_w, vd c, vd *phi)
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

/* |x| < |y|, both with what their roundings lost, and with their signs. */
INLINE vm is_less(vd x, vd x_lost, vd y, vd y_lost)
{
    return m_or(v_lt(x, y), m_and(v_eq(x, y), v_lt(x_lost, y_lost)));
}

/* least[j]: the axis is least along coordinate j, the first such. */
INLINE void find_least(const questions *q, vm least[3])
{
    const vd x = v_abs(q->w[0]), y = v_abs(q->w[1]), z = v_abs(q->w[2]);
    vm y_less = v_lt(y, x), z_less = v_lt(z, v_select(y_less, y, x));
    if (m_any(v_eq((x - y) * (y - z) * (z - x), v_set(0)))) {
        vd base[4], top[4], lost[3];
        load_ends(q, base, top);
        EACH(j, 3)
            lost[j] = v_select(q->is_angle, v_set(0),
                               v_like(v_set(1), q->w[j]) *
                                   difference_error(top[j], base[j], q->w[j]));
        y_less = is_less(y, lost[1], x, lost[0]);
        z_less = is_less(z, lost[2], v_select(y_less, y, x),
                         v_select(y_less, lost[1], lost[0]));
    }
    least[2] = z_less;
    least[1] = m_and_not(y_less, z_less);
    least[0] = m_not(m_or(least[1], least[2]));
}

/* The component of x along which the axis is least. */
INLINE vd along_least(const vd x[3], const vm least[3])
{
    return v_select(least[1], x[1], v_select(least[2], x[2], x[0]));
}

#endif
