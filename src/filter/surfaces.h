/*
 * surfaces.h - the ends of the overlap of a line and a solid, as roots, in lanes
 *
 * An end lies on the lateral surface, on a plane or on a ball.  Its root is
 * estimated in doubles and corrected by Newton's step on a residual in pairs.
 * The bounds are those of error_bounds.h.
 */
#ifndef CYLINT_SURFACES_H
#define CYLINT_SURFACES_H

#include "kernel.h"

/* ---------------------------------------------------------- the ends ---- */

/* One end.  top: it is at z = 1; on_end: on the plane or the ball there, else on
 * the lateral surface.  exits: 1 where the line leaves the quadric of its surface,
 * -1 where it enters. */
typedef struct {
    vm top, on_end;
    vd exits;
} line_end;

/* Lanes whose second end is the first in t: of a bounded solid where the line goes
 * down, of a double cone where A < 0: the line first leaves the cone. */
INLINE vm is_backward(const local_line *l, const verdict *v, int solid)
{
    if (solid == CYLINT_SOLID_DOUBLE_CONE)
        return v_lt(v->A.v, v_set(0));
    if (!cylint_solid_has_planes(solid))
        return m_from(0);
    const vm down = v_lt(l->in.w, v_set(0));
    return cylint_solid_is_hull(solid) ? m_and_not(down, either_end(v->chord))
                                       : down;
}

/* End k.  Wide: the k-th in t.  Narrow: each lane has one of both. */
INLINE line_end end_number(const local_line *l, const verdict *v, int k,
                           int solid)
{
    const int narrow = ENDS == 1, planes = cylint_solid_has_planes(solid);
    const vm back = is_backward(l, v, solid), last = last_end(k);
    const vd order = ends_of(v_set(-1), v_set(1), k);
    line_end e;
    e.exits = v_if(narrow == planes, v_select(back, -order, order), order);
    e.top = narrow ? last : m_if(back, m_not(last), last);
    e.on_end = m_from(0);
    if (!planes)
        return e;
    e.on_end = m_at_end(e.top, v->pierced);
    if (cylint_solid_is_hull(solid)) {
        const vm in_ball = either_end(v->chord);
        e.on_end = m_or(in_ball, e.on_end);
        e.top = m_if(in_ball, m_of_end(v->chord, 1), e.top);
    }
    return e;
}

/* x of the end whose ball it is.  Narrow: this can be the end of the other lane. */
INLINE vd of_ball(const line_end *e, const vd x[ENDS])
{
    return v_select(e->top, of_end(x, 1), of_end(x, 0));
}

/* --------------------------------------------------------- estimates ---- */

/* A t^2 + 2 B t + C of a surface, and the radicand B^2 - A C. */
typedef struct {
    bounded_value A, B, radicand;
} quadratic;

INLINE bounded_value choose(vm m, bounded_value x, bounded_value y)
{
    return (bounded_value){v_select(m, x.v, y.v), v_select(m, x.e, y.e)};
}

/* of_ball() of a bounded value. */
INLINE bounded_value bounded_of_ball(const line_end *e,
                                     const bounded_value x[ENDS])
{
    return choose(e->top, bounded_of_end(x, 1), bounded_of_end(x, 0));
}

/* Call compute_balls() before. */
INLINE quadratic quadratic_of_end(const verdict *v, const line_end *e,
                                  int solid)
{
    const balls *b = &v->ball;
    quadratic q = {v->A, v->B, v->G};
    if (!cylint_solid_is_hull(solid))
        return q;
    return (quadratic){choose(e->on_end, b->A, q.A),
                       choose(e->on_end, bounded_of_ball(e, b->B), q.B),
                       choose(e->on_end, bounded_of_ball(e, b->g), q.radicand)};
}

/* An estimate t of a root, and what Newton's step needs: the slope of the residual
 * there, a bound on its error, and half the curvature of the residual.  is_near: t
 * is nearer to its root than to the other one, or the surface is a plane.  The root
 * is at most off / scale from t, if scale > 0. */
typedef struct {
    vd t, slope, slope_error, curvature, scale, off;
    vm is_near;
} estimate;

INLINE estimate estimate_end(const local_line *l, const verdict *v,
                             const line_end *e, int solid)
{
    const int discs = cylint_solid_has_discs(solid);
    const quadratic q = quadratic_of_end(v, e, solid);
    const vd s = v_sqrt(q.radicand.v), root = e->exits * s;
    vd num = root - q.B.v, den = q.A.v;
    estimate at;
    at.slope = root + root;
    at.curvature = v_abs(q.A.v) + q.A.e;
    if (discs) {
        num = v_select(e->on_end, -at_end(e->top, l->z), num);
        den = v_select(e->on_end, l->in.w, den);
        at.slope = v_select(e->on_end, l->in.w, at.slope);
        at.curvature = v_select(e->on_end, v_set(0), at.curvature);
    }
    at.t = num * (v_set(1) / den);
    /* 2 s has the error 2 e / s */
    at.slope_error = v_set(4) * q.radicand.e * v_abs(v_set(1) / at.slope);
    const vd off = v_sum_of(v_abs(at.t), q.A.e, q.B.e);
    at.is_near = m_and(v_le(off, v_set(0.25) * s),
                       v_lt(v_set(4) * q.radicand.e, q.radicand.v));
    /* A t + B = +-s: the error of s is at most e / s, half of slope_error.  The
     * roundings are 4, of s, the difference and the quotient. */
    at.scale = v_abs(q.A.v) - q.A.e;
    at.off =
        (off + at.slope_error) +
        v_set(8 * CYLINT_ROUNDING) * v_sum_of(v_abs(at.t), v_abs(q.A.v), s);
    if (discs) {
        at.slope_error =
            v_select(e->on_end, v_set(CYLINT_LOCAL_POSITION) * l->unit * l->D,
                     at.slope_error);
        const vd size = v_sum_of(v_abs(at.t), l->D, l->Q);
        at.scale = v_select(e->on_end, v_abs(l->in.w), at.scale);
        at.off =
            v_select(e->on_end,
                     v_set(2 * CYLINT_LOCAL_POSITION) * l->unit * size, at.off);
        at.is_near = m_or(at.is_near, e->on_end);
    }
    return at;
}

/* --------------------------------------------------------- residuals ---- */

/* Not less than any coordinate at t. */
INLINE vd size_at(vd t, const local_line *l)
{
    return v_sum_of(v_abs(t), l->D, l->Q);
}

INLINE vd height_error(const pair_line *in, vd size)
{
    return v_set(CYLINT_LOCAL_RESIDUAL) * in->error * size;
}

/* |p|^2, pp + low, and |x| + |y|. */
typedef struct {
    vpair pp;
    vd low, across;
} square_at;

INLINE square_at square_across(const pair_line *in, vd t)
{
    const vq T = q_join(t, t), step = q_mul(T, in->v.hi);
    const vq low = q_sum_of(T, in->v.lo, q_product_error(T, in->v.hi));
    const vqpair sum = q_two_sum(in->p.hi, step);
    const vqpair p = {sum.hi, q_add(sum.lo, q_add(in->p.lo, low))};
    const vq squares = q_mul(p.hi, p.hi), size = q_abs(p.hi);
    const vq tails = q_sum_of(q_add(q_add(p.hi, p.hi), p.lo), p.lo,
                              q_product_error(p.hi, p.hi));
    return (square_at){v_two_sum(q_low(squares), q_high(squares)),
                       q_low(tails) + q_high(tails),
                       q_low(size) + q_high(size)};
}

/*
 * The residual of the lateral surface at t, |p|^2 - rho^2, or of the ball of
 * radius r, |p|^2 + z^2 - r^2, in lanes of on_ball.  Near a root the high parts
 * cancel.
 */
INLINE bounded_value square_residual(const pair_line *in, const local_line *l,
                                     vd t, vm on_ball, vpair ball_z, vd ball_r,
                                     int solid)
{
    const int round = cylint_solid_is_round(solid);
    const int tapered = cylint_solid_is_tapered(solid);
    square_at at = square_across(in, t);
    vpair rho2, r = {ball_r, v_set(0)}, none = {v_set(0), v_set(0)};
    vd high = at.pp.hi, low = at.pp.lo + at.low;
    if (round && (V_HAS_FMA || m_any(on_ball))) {
        const vpair z = pick(on_ball, moved(ball_z, in->w, t), none);
        const vpair zz = vpair_square(z), all = v_two_sum(high, zz.hi);
        high = all.hi;
        low = low + (all.lo + zz.lo);
        at.across = at.across + v_abs(z.hi);
    }
    if (tapered) {
        const vpair rho = moved(in->rho, in->growth, t);
        r = round ? pick(on_ball, r, rho) : rho;
        rho2 = vpair_square(r);
        at.across = at.across + v_abs(r.hi);
    } else {
        rho2 = v_two_prod(in->rho.hi, in->rho.hi);
    }
    const vd most = l->taper * size_at(t, l), off = height_error(in, most);
    return (bounded_value){
        (high - rho2.hi) + (low - rho2.lo),
        off * v_sum_of(v_set(CYLINT_LOCAL_UNTRIMMED), most, at.across + off)};
}

INLINE bounded_value residual_at(const pair_line *in, const local_line *l, vd t,
                                 const line_end *e, int solid)
{
    if (cylint_solid_is_round(solid)) {
        const int ball = solid == CYLINT_SOLID_SPHERE;
        const vpair base = pairs_of_end(in->z, 0);
        const vpair z =
            ball ? base : pick(e->top, pairs_of_end(in->z, 1), base);
        const vd r = v_if(ball, l->in.r, of_ball(e, l->ball_r));
        return square_residual(in, l, t, ball ? m_if_all(1) : e->on_end, z, r,
                               solid);
    }
    const bounded_value side =
        square_residual(in, l, t, e->on_end, in->z[0], l->in.r, solid);
    if (!cylint_solid_has_discs(solid))
        return side;
    const vpair z =
        ENDS == 1 ? in->z[0] : pick(e->top, in->z[ENDS - 1], in->z[0]);
    const bounded_value plane = {rounded(moved(z, in->w, t)),
                                 height_error(in, size_at(t, l))};
    return choose(e->on_end, plane, side);
}

/* ------------------------------------------------------ Newton's step --- */

/* A root: value + tail with the error.  nearest: value is certainly the nearest
 * double.  From an estimate that is not near, neither holds. */
typedef struct {
    vd value, tail, error;
    vm nearest;
} root;

/* From its sum and error. */
INLINE root bounded_root(vd value, vd tail, vd error)
{
    const vd low = value + (tail - error), high = value + (tail + error);
    const vd size = v_abs(value);
    const vm in_range = m_and(v_lt(size, v_set(1 / CYLINT_ROOT_LEAST)),
                              v_lt(v_set(CYLINT_ROOT_LEAST), size));
    const vm nearest = m_and(v_eq(low, value), v_eq(high, value));
    return (root){value, tail, error, m_and(nearest, in_range)};
}

/*
 * Let f be a polynomial of degree 1 or 2 with the root t and f'(t) = s.  Then
 *
 *   f(t0) = s (t0 - t) + c (t0 - t)^2,   c = f'' / 2,
 *   t     = t0 - delta + c (t0 - t)^2 / s,   delta = f(t0) / s.
 *
 * With the slope at t0 in place of s only the sign of the last term changes.
 * For the lateral quadric Q(t) = A t^2 + 2 B t + C these are s = 2 (A t + B)
 * and c = A; for a plane c = 0.  tests/bounds/prove/local_newton.g proves that
 * CYLINT_LOCAL_SLACK suffices.
 *
 * From the estimate, or from t near it.  The difference of t and the step has no
 * error or, where the step is larger than t, one rounding of it.
 */
INLINE root step_from(vd t, bounded_value residual, const estimate *at)
{
    const vd inverse = v_set(1) / at->slope, delta = residual.v * inverse;
    /* mutant '*' -> '+': wider; slower */
    const vd scaled = v_set(CYLINT_LOCAL_SLACK) * v_abs(inverse);
    const vd relative =
        v_sum_of(scaled, at->slope_error,
                 v_set(CYLINT_LOCAL_SLACK * CYLINT_QUOTIENT_ROUNDING));
    /* |t0 - t| in multiples of CYLINT_LOCAL_DISTANCE, c in its square */
    const vd distance = v_sum_of(residual.e, v_abs(inverse), v_abs(delta));
    const vd c =
        v_set(CYLINT_LOCAL_DISTANCE * CYLINT_LOCAL_DISTANCE) * at->curvature;
    /* mutant '*' -> '+': wider, as these bounds are below 1; slower */
    const vd first = v_sum_of(v_abs(delta), relative, scaled * residual.e);
    /* mutant '*' -> '+': the same */
    const vd error = v_sum_of(scaled * c * distance, distance, first);
    const vd value = t - delta;
    return bounded_root(value, (t - value) - delta, error);
}

/* -------------------------------------------------------------- hits ---- */

/* Lanes whose end is a hit for certain, and others whose end may be one. */
typedef struct {
    vm hit, undecided;
} hits;

/* The root minus an end of the domain, rounded twice. */
INLINE vd beyond_limit(const root *r, vd limit)
{
    return (r->value - limit) + r->tail;
}

/* present: on a part that is present.  CYLINT_SLACK covers the roundings, and
 * 2^-900 ends of the domain that are subnormal: a processor may read them as 0. */
INLINE hits hits_of_roots(const root *r, const local_line *l, vm present)
{
    const vd most = v_sum_of(v_set(CYLINT_SLACK), r->error, v_set(0x1p-900));
    const signs first = signs_of(beyond_limit(r, of_end(l->limit, 0)), most);
    const signs last = signs_of(beyond_limit(r, of_end(l->limit, 1)), most);
    const vm in = m_and(m_and(first.positive, last.negative), r->nearest);
    const vm out = m_or(first.negative, last.positive);
    return (hits){m_and(present, in), m_and_not(present, m_or(in, out))};
}

/* The ends on parts that are present. */
INLINE vm is_present(const local_line *l, const verdict *v, const line_end *e,
                     int k, int solid)
{
    if (!cylint_solid_has_planes(solid))
        return v->exists[k];
    const vm cap = cylint_solid_is_hull(solid)
                       ? m_if(e->top, m_of_end(l->cap, 1), m_of_end(l->cap, 0))
                       : m_at_end(e->top, l->cap);
    return m_or(m_not(e->on_end), cap);
}

#endif
