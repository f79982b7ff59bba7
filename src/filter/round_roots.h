/*
 * round_roots.h - the ends of the overlap of a line and a round kind, as roots
 *
 * Lane i is the end at end i of the shape: on ball i where the line pierces
 * the disc of circle i, else on the cone.  If the chord is in one ball, both
 * lanes are on it, and lane 0 is where the line enters.
 */
#ifndef CYLINT_ROUND_ROOTS_H
#define CYLINT_ROUND_ROOTS_H

#include "local_roots.h"
#include "round_lines.h"
#include "round_residual_lanes.h"

/* cap: lanes on a ball.  top: of these, those on the ball about the top. */
INLINE end_parts ends_of(const round_verdict *v)
{
    return (end_parts){v->chord ? 3 : v->cone.pierced,
                       v->chord ? (v->chord & 2 ? 3 : 0) : 2};
}

/* Where the hits are: a sphere's surface is one part, which may be a ball of a
 * rounded cone. */
INLINE end_parts round_parts(end_parts e, const cylint_shape *shape, int kind)
{
    if (kind != ROUND_BALL)
        return e;
    return (end_parts){shape->surface == CYLINT_PART_LATERAL ? 0 : 3,
                       shape->surface == CYLINT_PART_CAP1 ? 3 : 0};
}

/* The same ball in both lanes. */
INLINE vd one_ball(vd x, unsigned top)
{
    const vd y = top ? v_turned(x) : x;
    return v_firsts(y, y);
}

/* A t^2 + 2 B t + C of each lane, and B^2 - A C, with bounds on errors.  scale:
 * of the residual, beside these. */
typedef struct {
    vd A, B, A_error, B_error, radicand, radicand_error, scale;
} round_quadratic;

INLINE round_quadratic quadratic_of_balls(const round_line *x,
                                          const round_verdict *v, vd A, vd B)
{
    const local_line *l = &x->l;
    round_quadratic q = {A,
                         B,
                         v_set(CYLINT_LOCAL_A * l->unit * l->D * l->D),
                         v_set(CYLINT_LOCAL_FORM * l->unit * l->Q * l->D),
                         v->g,
                         v->g_error,
                         v_set(1)};
    if (v->chord) {
        q.B = one_ball(B, v->chord & 2);
        q.radicand = one_ball(v->g, v->chord & 2);
        q.radicand_error = one_ball(v->g_error, v->chord & 2);
    }
    return q;
}

INLINE round_quadratic choose_cone(vm ball, const round_quadratic *q,
                                   const round_verdict *v,
                                   const local_quadratic *cone,
                                   const cylint_shape *shape, int tapered)
{
    const double c = tapered ? shape->local.cosine : 1;
    /* the roundings of c^2 and of the slope by it */
    const double G_error =
        tapered ? sum_of(4 * CYLINT_ROUNDING, v->cone.G, v->cone.G_error)
                : v->cone.G_error;
    return (round_quadratic){v_select(ball, q->A, v_set(cone->A)),
                             v_select(ball, q->B, v_set(cone->B)),
                             v_select(ball, q->A_error, v_set(cone->A_error)),
                             v_select(ball, q->B_error, v_set(cone->B_error)),
                             v_select(ball, q->radicand, v_set(v->cone.G)),
                             v_select(ball, q->radicand_error, v_set(G_error)),
                             v_select(ball, q->scale, v_set(c * c))};
}

/* As estimate_ends(). */
INLINE local_ends estimate_round(const round_quadratic *q, int up)
{
    local_ends at;
    const vd s = v_sqrt(q->radicand);
    const vd root = (up ? v_two(-1, 1) : v_two(1, -1)) * s;
    at.t = (root - q->B) * (v_set(1) / q->A);
    at.slope = (root + root) * q->scale;
    at.inverse = v_set(1) / at.slope;
    at.slope_error = v_set(4) * q->radicand_error * (q->scale * q->scale) *
                     v_abs(at.inverse);
    at.curvature = (v_abs(q->A) + q->A_error) * q->scale;
    /* the estimate is nearer to its root than to the other one */
    const vd off = v_sum_of(v_abs(at.t), q->A_error, q->B_error);
    at.usable = m_bits(m_and(v_le(off, v_set(0.25) * s),
                             v_lt(v_set(4) * q->radicand_error, q->radicand)));
    at.cap = m_from(0);
    at.first = !up;
    return at;
}

/* From the centre of each lane's ball to the line's origin. */
INLINE void from_centers(vpair from[3], const cylint_shape *shape,
                         const cylint_line *line, unsigned top)
{
    const double *c0 = top & 1 ? shape->top : shape->base;
    const double *c1 = top & 2 ? shape->top : shape->base;
    EACH(j, 3)
        from[j] = v_two_sum(v_set(line->o[j]), -v_two(c0[j], c1[j]));
}

INLINE void from_center(vpair from[3], const cylint_shape *shape,
                        const cylint_line *line)
{
    const vpair x = v_two_sum(v_load(line->o), -v_load(shape->base));
    const vpair y = vpair_turned(x);
    const pair z = two_diff(line->o[2], shape->base[2]);
    from[0] = vpair_firsts(x, x);
    from[1] = vpair_firsts(y, y);
    from[2] = twice(z.hi, z.lo);
}

INLINE vd radii_of(const cylint_shape *shape, unsigned top)
{
    return v_two(top & 1 ? shape->r1 : shape->r0,
                 top & 2 ? shape->r1 : shape->r0);
}

/* From the plane of the circle of each lane's ball. */
INLINE vpair height_over_circles(const vpair q[3], vd r,
                                 const cylint_shape *shape, int tapered)
{
    const cylint_local *f = &shape->local;
    vpair axis[3], shift = twice(0, 0);
    EACH(j, 3)
        axis[j] = twice(f->xyz[j][2], f->xyz_lo[j][2]);
    if (tapered)
        shift = shift_lanes(twice(f->sine, f->sine_lo), r);
    return height_lanes(q, axis, shift);
}

/* The residual of the cone in all lanes. */
INLINE vd cone_residual_at(vpair height, vpair surplus,
                           const cylint_shape *shape, int tapered)
{
    const cylint_local *f = &shape->local;
    if (!tapered)
        return cylinder_residual_lanes(surplus, height);
    const pair c = {f->cosine, f->cosine_lo}, c2 = pair_mul(c, c);
    return cone_residual_lanes(surplus, twice(c2.hi, c2.lo), height);
}

/* The point at t of each lane, from the centre of its ball.  at_origin: t = 0. */
INLINE void round_points(vpair q[3], const cylint_shape *shape,
                         const cylint_line *line, vd t, unsigned top, int kind,
                         int at_origin)
{
    if (kind == ROUND_BALL)
        from_center(q, shape, line);
    else
        from_centers(q, shape, line, top);
    if (at_origin)
        return;
    EACH(j, 3)
        q[j] = moved_lanes(q[j], t, v_set(line->d[j]), v_set(line->d_lo[j]));
}

INLINE vd round_radii(const cylint_shape *shape, unsigned top, int kind)
{
    return kind == ROUND_TAPERED ? radii_of(shape, top) : v_set(shape->r0);
}

/* The residual of each lane, in pairs. */
INLINE vd round_residual_at(const cylint_shape *shape, const cylint_line *line,
                            vd t, end_parts e, int kind)
{
    const int tapered = kind == ROUND_TAPERED;
    const vd r = round_radii(shape, e.top, kind);
    vpair q[3];
    round_points(q, shape, line, t, e.top, kind, 0);
    if (kind == ROUND_BALL || e.cap == 3)
        return ball_residual_lanes(q, r);
    const vpair surplus = surplus_lanes(q, r);
    const vpair height = height_over_circles(q, r, shape, tapered);
    return v_select(m_from(e.cap), surplus.hi + surplus.lo,
                    cone_residual_at(height, surplus, shape, tapered));
}

INLINE vd round_error(vd size, const cylint_shape *shape)
{
    return v_set(CYLINT_LOCAL_RESIDUAL * shape->local.error) * size;
}

/* `aside` if the point is outside.  No branch depends on the side. */
INLINE int state_of_side(unsigned inside, unsigned outside, int aside)
{
    if (!((inside | outside) & 1))
        return LOCAL_UNCERTAIN;
    return aside + (LOCAL_INSIDE - aside) * (int)(inside & 1);
}

/* Where a point near the surface lies, in pairs. */
INLINE int side_in_pairs(const cylint_shape *shape, const cylint_line *line,
                         double t, double Q, double D, int aside, int kind)
{
    const int tapered = kind == ROUND_TAPERED;
    const vd r = round_radii(shape, 2, kind);
    const vd size = size_at(v_set(t), Q, D);
    const vd error = round_error(size * size, shape);
    vpair q[3];
    round_points(q, shape, line, v_set(t), 2, kind, t == 0);
    if (kind == ROUND_BALL) {
        const sign_bits C = signs_beyond(ball_residual_lanes(q, r), error);
        return state_of_side(C.negative, C.positive, aside);
    }
    const vpair surplus = surplus_lanes(q, r);
    const vpair height = height_over_circles(q, r, shape, tapered);
    const sign_bits C = signs_beyond(surplus.hi + surplus.lo, error);
    const sign_bits z =
        signs_beyond(height.hi + height.lo, round_error(size, shape));
    const sign_bits side =
        signs_beyond(cone_residual_at(height, surplus, shape, tapered), error);
    const unsigned below = z.negative, above = z.positive >> 1;
    const unsigned between = z.positive & z.negative >> 1;
    return state_of_side(C.negative | C.negative >> 1 |
                             (between & side.negative),
                         (below & C.positive) | (above & C.positive >> 1) |
                             (~(below | above) & side.positive),
                         aside);
}

INLINE local_roots rounded_ends(const round_line *x, const cylint_shape *shape,
                                const cylint_line *line, const local_ends *at,
                                end_parts e, int kind)
{
    const vd size = size_at(at->t, x->l.Q, x->l.D);
    return stepped(at->t, round_residual_at(shape, line, at->t, e, kind),
                   round_error(size * size, shape), at);
}

#endif
