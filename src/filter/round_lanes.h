/*
 * round_lanes.h - capsules and rounded cones in lanes
 *
 * In the local coordinates of each lane's shape, as for one line
 * (round_lines.h): the planes of the two circles cut the shape into a part of
 * ball 0, a cone between planes, and a part of ball 1.  Each of the two stops is
 * a root of the quadratic of its own surface.  A capsule is a rounded cone whose
 * slope is 0.
 */
#ifndef CYLINT_ROUND_LANES_H
#define CYLINT_ROUND_LANES_H

#include "local_lanes.h"

/* The lines.  in: z and r of the planes and circles.  No coordinate of the
 * origin exceeds Q, none of the direction D. */
typedef struct {
    line_many in;
    balls_many balls;
    vd Q, D, taper;
    vm in_range;
} lanes_round;

INLINE vd row_of_frame(const lanes_frame *f, int row, const vd x[3])
{
    return v_sum_of(x[2], f->xyz[2][row],
                    v_sum_of(x[1], f->xyz[1][row], x[0] * f->xyz[0][row]));
}

INLINE void load_round_lanes(lanes_round *x, const lanes_shape *s,
                             const lanes_line *l)
{
    const lanes_frame *f = &s->frame;
    const vd most = v_set(CYLINT_WINDOW), least = v_set(1 / CYLINT_WINDOW);
    line_many *in = &x->in;
    vd from[3];
    EACH(i, 3)
        from[i] = l->o[i] - s->base[i];
    const vd size = v_largest(l->u), z = row_of_frame(f, 2, from);
    x->balls.z = EACH_OF_TWO(z, z - f->height);
    x->balls.r = EACH_OF_TWO(s->r[0], s->r[1]);
    in->p = EACH_OF_TWO(row_of_frame(f, 0, from), row_of_frame(f, 1, from));
    in->v = EACH_OF_TWO(row_of_frame(f, 0, l->u), row_of_frame(f, 1, l->u));
    in->w = two_of(row_of_frame(f, 2, l->u));
    in->z = two_sum_of(two_of(f->sine), x->balls.r, x->balls.z);
    in->r = two_times(two_of(f->cosine), x->balls.r);
    in->slope = two_of(f->slope);
    set_products_many(in);
    x->Q = v_sum_of(v_largest(from), f->norm, f->reach);
    x->D = size * f->norm;
    x->taper = v_set(1) + v_abs(f->slope);
    x->in_range = m_and(m_and(v_le(least, size), v_le(size, most)),
                        m_and(v_le(x->Q, most), v_lt(v_set(0), f->height)));
}

/* Twice the error of a rounding, of coordinates from the circles' planes. */
#define ROUND_UNIT (CYLINT_LOCAL_ROUND * CYLINT_ROUNDING)

/* A t^2 + 2 B t + C of one surface: A, B, and the radicand B^2 - A C.  scale: of
 * the residual, beside these. */
typedef struct {
    bounded_value A, B, radicand;
    vd scale;
} round_quadratic;

INLINE round_quadratic choose_quadratic(vm m, const round_quadratic *x,
                                        const round_quadratic *y)
{
    return (round_quadratic){choose(m, x->A, y->A), choose(m, x->B, y->B),
                             choose(m, x->radicand, y->radicand),
                             v_select(m, x->scale, y->scale)};
}

/* Where the overlap begins or ends.  R and A: of the residual. */
typedef struct {
    bounded_value t, R;
    vd A; /* |A| */
} round_stop;

/* exits: -1 for the root at which the line enters, +1 for the other. */
INLINE round_stop root_of(const round_quadratic *f, vd exits, vm *uncertain)
{
    const vd R = v_sqrt(f->radicand.v);
    const vd R_error =
        R * (f->radicand.e / f->radicand.v + v_set(CYLINT_RADICAL_ROUNDING));
    const bounded_value numerator = {
        -f->B.v + exits * R, (f->B.e + R_error) * v_set(CYLINT_LANES_SLACK)};
    const vm known =
        m_and(certain(f->A),
              v_lt(v_set(1 / CYLINT_RADICAND) * f->radicand.e, f->radicand.v));
    *uncertain = m_not(m_and(known, v_lt(v_set(CYLINT_RADICAL_LEAST), R)));
    return (round_stop){quotient(numerator, f->A),
                        {R * f->scale, R_error * f->scale},
                        v_abs(f->A.v) * f->scale};
}

/* Of the cone.  Y: r v - slope X_0. */
INLINE bounded_value cone_G(const lanes_round *x, vtwo Y)
{
    const vd off =
        v_set(0.5 * CYLINT_LOCAL_FORM * ROUND_UNIT) * x->Q * x->D * x->taper;
    return (bounded_value){G_many(&x->in, 1, &Y).a,
                           (off + off) * (v_abs(Y.a) + v_abs(Y.b) + off)};
}

INLINE round_quadratic quadratic_of_cone(const lanes_round *x, bounded_value G,
                                         const lanes_frame *f)
{
    const vtwo AB = AB_many(&x->in, 1);
    const vd D = x->taper * x->D, Q = x->taper * x->Q;
    /* the roundings of c^2 and of the slope by it */
    const bounded_value radicand = {
        G.v, v_sum_of(v_set(4 * CYLINT_ROUNDING), v_abs(G.v), G.e)};
    return (round_quadratic){
        {AB.a, v_set(CYLINT_LOCAL_A * ROUND_UNIT) * D * D},
        {AB.b, v_set(CYLINT_LOCAL_FORM * ROUND_UNIT) * Q * D},
        radicand,
        f->cosine * f->cosine};
}

INLINE void quadratics_of_balls(round_quadratic ball[2], const lanes_round *x,
                                const bounded_value g[2])
{
    const vtwo B = ball_B_many(&x->in, &x->balls);
    const bounded_value A = {ball_A_many(&x->in).a,
                             v_set(CYLINT_LOCAL_A * ROUND_UNIT) * x->D * x->D};
    const vd error = v_set(CYLINT_LOCAL_FORM * ROUND_UNIT) * x->Q * x->D;
    ball[0] = (round_quadratic){A, {B.a, error}, g[0], v_set(1)};
    ball[1] = (round_quadratic){A, {B.b, error}, g[1], v_set(1)};
}

/* What the signs say.  chord: lanes whose chord is in ball i.  cap: lanes that
 * pierce the disc of circle i. */
typedef struct {
    vm misses, crosses, chord[2], cap[2];
} round_verdict;

INLINE round_verdict round_signs(const lanes_round *x, bounded_value G,
                                 bounded_value g[2])
{
    const vd u = v_set(ROUND_UNIT), QDD = u * x->Q * x->D * x->D;
    const vd second = v_set(CYLINT_LOCAL_SECOND) * u * x->Q;
    const vd r0 = x->balls.r.a, r1 = x->balls.r.b;
    const vd eE = v_set(CYLINT_LOCAL_FORM) * QDD * (v_max(r0, r1) + second);
    const vd eN = v_set(CYLINT_LOCAL_FORM) * QDD * x->taper;
    const vtwo E = E_many(&x->in), N = N_many(&x->in, 1);
    const vtwo ball = ball_g_many(&x->in, &x->balls);
    const cap_masks c = {{masks_of(E.a, eE), masks_of(E.b, eE)},
                         {masks_of(-N.a, eN), masks_of(N.b, eN)},
                         {v_lt(G.e, G.v), v_lt(G.v, -G.e)}};
    const vm past = misses_of_masks(&c); /* the cone */
    round_verdict v;
    g[0] =
        (bounded_value){ball.a, v_set(CYLINT_LOCAL_BALL) * QDD * (r0 + second)};
    g[1] =
        (bounded_value){ball.b, v_set(CYLINT_LOCAL_BALL) * QDD * (r1 + second)};
    v.misses = past;
    v.crosses = m_from(0);
    EACH(i, 2) {
        const sign_masks in_ball = masks_of(g[i].v, g[i].e);
        const vm there = m_and(past, c.inward[i].negative);
        v.chord[i] = m_and(there, in_ball.positive);
        v.misses = m_and(v.misses, m_or(m_not(there), in_ball.negative));
        v.crosses = m_or(v.crosses, v.chord[i]);
        v.cap[i] = c.E[i].positive;
    }
    const vm sided = m_and(m_or(c.E[0].positive, c.E[0].negative),
                           m_or(c.E[1].positive, c.E[1].negative));
    v.crosses = m_and(m_or(v.crosses, crosses_of_masks(&c)), sided);
    return v;
}

/* As lanes_classify(). */
INLINE lanes_verdict round_classify(lanes_slopes *q, const lanes_shape *s,
                                    const lanes_line *l, vm lanes,
                                    round_stop stop[2])
{
    const vm none = m_from(0);
    const vd lateral = v_set(CYLINT_PART_LATERAL);
    const bounded_value nowhere = {v_set(0), v_set(0)};
    lanes_verdict v = {
        none, none, {none, none}, none, {nowhere, nowhere}, {lateral, lateral}};
    EACH(k, 2)
        stop[k] = (round_stop){nowhere, nowhere, v_set(0)};
    lanes_round x;
    load_round_lanes(&x, s, l);
    const bounded_value G = cone_G(&x, Y_many(&x.in));
    bounded_value g[2];
    const round_verdict is = round_signs(&x, G, g);
    const vm alive = m_and(
        lanes, m_not(m_and(x.in_range, m_or(is.misses, v_lt(G.v, -G.e)))));
    *q = (lanes_slopes){nowhere, nowhere,  v_set(0), x.Q,
                        x.D,     v_set(0), v_set(0)};
    if (!m_any(alive))
        return v;

    round_quadratic ball[2];
    const round_quadratic side = quadratic_of_cone(&x, G, &s->frame);
    quadratics_of_balls(ball, &x, g);
    const vm down = v_lt(x.in.w.a, v_set(0));
    const vm one_ball = m_or(is.chord[0], is.chord[1]);
    vm uncertain = m_not(m_and(x.in_range, is.crosses));
    EACH(k, 2) {
        const vm last = k ? m_not(down) : down; /* at the top's end */
        const vm top = m_or(is.chord[1], m_and(last, m_not(one_ball)));
        const vm cap =
            m_or(m_and(top, is.cap[1]), m_and(m_not(top), is.cap[0]));
        const vm on_ball = m_or(one_ball, cap);
        const round_quadratic of = choose_quadratic(top, &ball[1], &ball[0]);
        const round_quadratic f = choose_quadratic(on_ball, &of, &side);
        vm unknown;
        stop[k] = root_of(&f, v_set(k ? 1 : -1), &unknown);
        uncertain = m_or(uncertain, unknown);
        v.stop[k] = stop[k].t;
        v.part[k] = v_select(
            on_ball,
            v_select(top, v_set(CYLINT_PART_CAP1), v_set(CYLINT_PART_CAP0)),
            lateral);
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

/* One step of Newton's in lanes, by parts.  The residual is that of the ball or
 * of the cone (round_residual_template.h). */
INLINE lanes_root round_part_root(const lanes_slopes *q, const lanes_shape *s,
                                  const lanes_line *l, vd exits,
                                  bounded_value t, vd part)
{
    const lanes_frame *f = &s->frame;
    const vm top = v_eq(part, v_set(CYLINT_PART_CAP1));
    const vm ball = m_not(v_eq(part, v_set(CYLINT_PART_LATERAL)));
    const vd r = v_select(top, s->r[1], s->r[0]);
    vpair x[3], axis[3];
    EACH(i, 3) {
        const vd center = v_select(top, s->top[i], s->base[i]);
        x[i] =
            moved_lanes(v_two_sum(l->o[i], -center), t.v, l->u[i], l->u_lo[i]);
        axis[i] = (vpair){f->xyz[i][2], f->axis_lo[i]};
    }
    const vpair surplus = surplus_lanes(x, r);
    const vd size = v_sum_of(v_abs(t.v), q->u, q->D);
    const vd error =
        v_set(CYLINT_LOCAL_RESIDUAL * CYLINT_SLACK) * f->error * (size * size);
    vd residual = surplus.hi + surplus.lo;
    if (m_any(m_not(ball))) {
        const vpair cosine = {f->cosine, f->cosine_lo};
        const vpair sine = {f->sine, f->sine_lo};
        const vpair height = height_lanes(x, axis, shift_lanes(sine, r));
        const vd cone =
            cone_residual_lanes(surplus, vpair_mul(cosine, cosine), height);
        residual = v_select(ball, residual, cone);
    }
    return newton_root(residual, error, v_set(2) * exits * q->R.v,
                       v_set(2) * q->R.e, q->A, t);
}

INLINE vtwo select_both(vm a, vm b, vd x, vd y)
{
    return EACH_OF_TWO(v_select(a, x, y), v_select(b, x, y));
}

/* The same for both stops.  q: of each. */
INLINE void round_part_roots(lanes_root root[2], const round_stop stop[2],
                             const lanes_slopes *q, const lanes_shape *s,
                             const lanes_line *l, const bounded_value at[2],
                             const vd part[2])
{
    const lanes_frame *f = &s->frame;
    const vd cap1 = v_set(CYLINT_PART_CAP1), side = v_set(CYLINT_PART_LATERAL);
    const vm top[2] = {v_eq(part[0], cap1), v_eq(part[1], cap1)};
    const vm lateral[2] = {v_eq(part[0], side), v_eq(part[1], side)};
    const vtwo r = select_both(top[0], top[1], s->r[1], s->r[0]);
    const vtwo t = EACH_OF_TWO(at[0].v, at[1].v);
    vtwo_pair x[3], axis[3];
    EACH(i, 3) {
        const vtwo center =
            select_both(top[0], top[1], -s->top[i], -s->base[i]);
        const vtwo_pair from = pair_of_two(v_two_sum(l->o[i], center.a),
                                           v_two_sum(l->o[i], center.b));
        x[i] = moved_both(from, t, two_of(l->u[i]), two_of(l->u_lo[i]));
        axis[i] = both_pairs(f->xyz[i][2], f->axis_lo[i]);
    }
    const vtwo_pair surplus = surplus_both(x, r);
    vtwo residual = two_plus(surplus.hi, surplus.lo);
    if (m_any(m_or(lateral[0], lateral[1]))) {
        const vpair cosine = {f->cosine, f->cosine_lo};
        const vpair square = vpair_mul(cosine, cosine);
        const vtwo_pair height = height_both(
            x, axis, shift_both(both_pairs(f->sine, f->sine_lo), r));
        const vtwo cone = cone_residual_both(
            surplus, both_pairs(square.hi, square.lo), height);
        residual = EACH_OF_TWO(v_select(lateral[0], cone.a, residual.a),
                               v_select(lateral[1], cone.b, residual.b));
    }
    EACH(k, 2) {
        const vd size = v_sum_of(v_abs(at[k].v), q->u, q->D);
        root[k] = newton_root(k ? residual.b : residual.a,
                              v_set(CYLINT_LOCAL_RESIDUAL * CYLINT_SLACK) *
                                  f->error * (size * size),
                              v_set(k ? 2 : -2) * stop[k].R.v,
                              v_set(2) * stop[k].R.e, stop[k].A, at[k]);
    }
}

#endif
