/*
 * round_lanes.h - capsules and rounded cones in lanes
 *
 * The signs of signs/round_forms_template.h say on which of the two balls and
 * the lateral surface the overlap begins and ends.  Each of the two stops is
 * then a root of the quadratic of its own surface.  With both E negative the
 * line can meet
 *
 *   ball 0 only         if N_0 > 0: it comes nearest to p_0 before plane 0,
 *   ball 1 only         if N_1 < 0,
 *   the lateral surface if N_0 < 0 < N_1,
 *
 * whichever of the planes it comes to first.
 */
#ifndef CYLINT_ROUND_LANES_H
#define CYLINT_ROUND_LANES_H

#include "sphere_lanes.h"

INLINE vm positive(bounded_value x)
{
    return v_lt(x.e, x.v);
}

INLINE vm negative(bounded_value x)
{
    return v_lt(x.v, -x.e);
}

/* A t^2 + 2 B t + C of one surface: A, B, and the radicand B^2 - A C. */
typedef struct {
    bounded_value A, B, radicand;
    vm known; /* well enough for a root */
} round_quadratic;

/* Of the ball about an end. */
INLINE round_quadratic quadratic_of_ball(const lanes_query *q, bounded_value g,
                                         int end)
{
    const terms_lanes *L = &q->L;
    const terms_sizes *N = &q->N;
    const bounded_value A =
        with_bound(dot_lanes(L, L->u, L->u), dot_sizes(N, N->u, N->u));
    const bounded_value B = with_bound(dot_lanes(L, L->D[end], L->u),
                                       dot_sizes(N, N->D[end], N->u));
    return (round_quadratic){A, B, g,
                             v_lt(v_set(1 / CYLINT_RADICAND) * g.e, g.v)};
}

INLINE round_quadratic quadratic_of_side(const lanes_query *q, bounded_value G)
{
    const terms_lanes *L = &q->L;
    const terms_sizes *N = &q->N;
    const bounded_value S =
        with_bound(form_root_of_S_lanes(L), form_root_of_S_sizes(N));
    const bounded_value A = with_bound(form_A_lanes(L), form_A_sizes(N));
    const bounded_value B = with_bound(form_B_lanes(L), form_B_sizes(N));
    const vm known = m_and(m_and(certain(A), certain(S)),
                           v_lt(v_set(1 / CYLINT_RADICAND) * G.e, G.v));
    return (round_quadratic){A, B, {S.v * G.v, S.v * G.e + S.e * G.v}, known};
}

INLINE round_quadratic choose_quadratic(vm m, const round_quadratic *x,
                                        const round_quadratic *y)
{
    return (round_quadratic){
        choose(m, x->A, y->A), choose(m, x->B, y->B),
        choose(m, x->radicand, y->radicand),
        m_or(m_and(m, x->known), m_and(m_not(m), y->known))};
}

/* Where the overlap begins or ends. */
typedef struct {
    bounded_value t, R;
    vd A; /* |A| */
} round_stop;

/* exits: -1 for the root at which the line enters, +1 for the other. */
INLINE round_stop root_of(const round_quadratic *f, vd exits, vm *uncertain)
{
    const vd R = v_sqrt(f->radicand.v);
    const bounded_value radical = {R, R * (f->radicand.e / f->radicand.v +
                                           v_set(CYLINT_RADICAL_ROUNDING))};
    const bounded_value numerator = {
        -f->B.v + exits * R, (f->B.e + radical.e) * v_set(CYLINT_LANES_SLACK)};
    *uncertain = m_not(m_and(f->known, v_lt(v_set(CYLINT_RADICAL_LEAST), R)));
    return (round_stop){quotient(numerator, f->A), radical, v_abs(f->A.v)};
}

/* What the signs say.  ball[i][k]: stop k is on ball i. */
typedef struct {
    vm misses, crosses;
    vm ball[2][2];
} round_verdict;

INLINE round_verdict round_signs(lanes_query *q, bounded_value G,
                                 const bounded_value g[2])
{
    const terms_lanes *L = &q->L;
    const terms_sizes *N = &q->N;
    bounded_value E[2], inward[2];
    vm in[2], out[2], between[2], beyond[2];
    EACH(i, 2) {
        E[i] = with_bound(form_E_lanes(L, i), form_E_sizes(N, i));
        inward[i] = with_bound(form_N_lanes(L, i) * v_set(i ? 1 : -1),
                               form_N_sizes(N, i));
        in[i] = positive(E[i]);
        out[i] = negative(E[i]);
        between[i] = positive(inward[i]);
        beyond[i] = negative(inward[i]);
    }
    const vm up = v_lt(v_set(0), q->beta.v), down = m_not(up);
    const vm outside = m_and(out[0], out[1]);
    const vm pierces = m_and(m_and(m_or(in[0], in[1]), certain(q->beta)),
                             m_and(m_or(in[0], out[0]), m_or(in[1], out[1])));
    const vm side = m_and(m_and(between[0], between[1]), positive(G));
    const vm no_side = m_or(negative(G), m_or(beyond[0], beyond[1]));
    vm chord[2], no_chord[2];
    EACH(i, 2) {
        chord[i] = m_and(outside, m_and(beyond[i], positive(g[i])));
        no_chord[i] = m_or(negative(g[i]), between[i]);
    }
    round_verdict v;
    v.misses = m_and(m_and(outside, no_side), m_and(no_chord[0], no_chord[1]));
    v.crosses =
        m_or(m_or(pierces, m_and(outside, side)), m_or(chord[0], chord[1]));
    EACH(i, 2) {
        const vm first = m_and(m_and(pierces, in[i]), i ? down : up);
        const vm last = m_and(m_and(pierces, in[i]), i ? up : down);
        v.ball[i][0] = m_or(chord[i], first);
        v.ball[i][1] = m_or(chord[i], last);
    }
    return v;
}

/* As lanes_classify(). */
INLINE lanes_verdict round_classify(lanes_query *q, const lanes_shape *s,
                                    const lanes_line *l, int kind, vm lanes,
                                    round_stop stop[2])
{
    const vm none = m_from(0);
    const vd lateral = v_set(CYLINT_PART_LATERAL);
    const bounded_value nowhere = {v_set(0), v_set(0)};
    lanes_verdict v = {
        none, none, {none, none}, none, {nowhere, nowhere}, {lateral, lateral}};
    EACH(k, 2)
        stop[k] = (round_stop){nowhere, nowhere, v_set(0)};
    load_terms(q, s, l, kind, 1);
    prepare_top_lanes(&q->L);
    prepare_top_sizes(&q->N);
    q->beta = with_bound(q->L.beta, form_beta_sizes(&q->N));
    const bounded_value G =
        with_bound(form_G_lanes(&q->L), form_G_sizes(&q->N));
    bounded_value g[2];
    EACH(i, 2)
        g[i] = with_bound(form_end_ball_lanes(&q->L, i),
                          form_end_ball_sizes(&q->N, i));
    const vm window = lanes_in_window(q, kind);
    const round_verdict is = round_signs(q, G, g);
    const vm alive = m_and(lanes, m_not(m_and(window, is.misses)));
    if (!m_any(alive))
        return v;

    const round_quadratic side = quadratic_of_side(q, G);
    const round_quadratic ball0 = quadratic_of_ball(q, g[0], 0);
    const round_quadratic ball1 = quadratic_of_ball(q, g[1], 1);
    vm uncertain = m_not(m_and(window, is.crosses));
    EACH(k, 2) {
        const vm on0 = is.ball[0][k], on1 = is.ball[1][k];
        const round_quadratic other = choose_quadratic(on1, &ball1, &side);
        const round_quadratic f = choose_quadratic(on0, &ball0, &other);
        vm unknown;
        stop[k] = root_of(&f, v_set(k ? 1 : -1), &unknown);
        uncertain = m_or(uncertain, unknown);
        v.stop[k] = stop[k].t;
        v.part[k] = v_select(on0, v_set(CYLINT_PART_CAP0),
                             v_select(on1, v_set(CYLINT_PART_CAP1), lateral));
    }
    v.cross = m_and(alive, m_not(uncertain));
    v.undecided = m_and(alive, uncertain);
    EACH(k, 2) {
        vm near;
        const vm in = within_domain(v.stop[k], l->tmin, l->tmax, &near);
        const vm there = m_and(v.cross, part_present(s, v.part[k]));
        v.hit[k] = m_and(there, in);
        v.undecided = m_or(v.undecided, m_and(there, near));
    }
    v.cross = m_and(v.cross, m_not(v.undecided));
    v.hit[0] = m_and(v.hit[0], v.cross);
    v.hit[1] = m_and(v.hit[1], v.cross);
    return v;
}

/* |w|^2 - dr^2. */
INLINE vpair hull_square(const vpair axis[3], vpair dr)
{
    const vpair across =
        vpair_add(vpair_mul(axis[0], axis[0]), vpair_mul(axis[1], axis[1]));
    const vpair length = vpair_add(across, vpair_mul(axis[2], axis[2]));
    return vpair_sub(length, vpair_mul(dr, dr));
}

/* One step of Newton's in lanes, by parts.  The residual is that of the ball or,
 * in units of |w|^2, of the cone (round_residual_template.h). */
INLINE lanes_root round_part_root(const lanes_slopes *q, const lanes_shape *s,
                                  const lanes_line *l, int kind, vd exits,
                                  bounded_value t, vd part)
{
    const vm top = v_eq(part, v_set(CYLINT_PART_CAP1));
    const vm ball = m_not(v_eq(part, v_set(CYLINT_PART_LATERAL)));
    const vd r = v_select(top, s->r[1], s->r[0]);
    vpair x[3], axis[3];
    vd center[3];
    root_centers(center, s, kind, part);
    EACH(i, 3) {
        x[i] = moved_lanes(v_two_sum(l->o[i], -center[i]), t.v, l->u[i],
                           l->u_lo[i]);
        axis[i] = (vpair){s->axis[i], s->axis_lo[i]};
    }
    const vpair surplus = surplus_lanes(x, r);
    const vd at = v_sum_of(v_abs(t.v), q->u, q->D), size = at + at + r;
    vd residual = surplus.hi + surplus.lo;
    vd error =
        v_set(CYLINT_LOCAL_RESIDUAL * CYLINT_LOCAL_ERROR * CYLINT_SLACK) *
        (size * size);
    if (m_any(m_not(ball))) {
        const vpair dr = {s->dr, s->dr_lo};
        const vpair height = height_lanes(x, axis, shift_lanes(dr, r));
        const vd cone =
            cone_residual_lanes(surplus, hull_square(axis, dr), height);
        const vd ww = v_set(3 * CYLINT_SLACK) * q->w * q->w;
        residual = v_select(ball, residual, cone);
        error = v_select(ball, error, error * ww);
    }
    return newton_root(residual, error, v_set(2) * exits * q->R.v,
                       v_set(2) * q->R.e, q->A, t);
}

#endif
