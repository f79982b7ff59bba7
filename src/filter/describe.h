/*
 * describe.h - the members of the hits of one line and one shape
 *
 * Narrow lanes (frame.h): lane i belongs to end i.
 */
#ifndef CYLINT_DESCRIBE_H
#define CYLINT_DESCRIBE_H

#include "members.h"

/* Whether a coordinate of the line, or its difference from the base, can be
 * subnormal. */
static int has_tiny_numbers(const source *from)
{
    const double *o = from->line->o, *d = from->line->d,
                 *base = cylint_base(from->shape);
    int tiny = 0;
    EACH(i, 3)
        tiny |= cylint_too_small(o[i]) | cylint_too_small(d[i]) |
                cylint_too_small(base[i]);
    return tiny;
}

/* The lanes in which members of the hit are likely to be certain: the error of the
 * root is small beside the radius there.  No coordinate of the line's direction
 * exceeds D. */
INLINE vm precise_lanes(const hit_root *r, const pair_line *in, double D,
                        int solid)
{
    const vd rho = v_sum_of(r->t, in->growth.hi, in->rho.hi);
    const vm precise =
        v_le(v_set(D) * r->error, v_set(CYLINT_MEMBER_LIKELY) * v_abs(rho));
    return cylint_solid_is_round(solid) ? precise : m_or(precise, r->on_end);
}

/*
 * The root by a step of Newton's from t + tail.  Let f be the residual there, 2 s
 * its slope, c half its curvature, and x the distance of the root, which is at most
 * the error before.  Then x = -(f + c x^2) / (2 s).  With the errors f' and s' the
 * error after the step is at most (f' + (2 s' + c x) x) / (2 s).  Roots on discs
 * stay as they are: their lanes are precise.
 */
ASIDE hit_root nearer_root(const hit_root *r, const source *from,
                           const pair_line *in, double D, int solid)
{
    const vd none = v_set(0), unit = v_set(CYLINT_MEMBER_UNIT);
    const hit_root here = {r->t, r->tail, none, r->on_end, r->top};
    const local_hit h = hit_at(from, in, &here, solid);
    const vm on_end = on_ball(r, solid);
    const vd R = v_select(on_end, ball_radius(r, from, solid), none);
    const bounded_pairs up = from_center(&h, r, from, solid);
    const bounded_pairs x[3] = {h.x, h.y, choose_pairs(on_end, up, h.rho)};
    const vd growth[3] = {pairs_of_two(in->v, 0).hi, pairs_of_two(in->v, 1).hi,
                          v_select(on_end, in->w.hi, -in->growth.hi)};
    const vd most = v_set(D) + v_abs(in->growth.hi);
    bounded_pairs f = {opposite(v_two_prod(R, R)), none};
    vd s = none, s_error = none;
    EACH_FUSED(i, 3) {
        const vpair X = v_two_sum(x[i].v.hi, x[i].v.lo);
        const vd off = unit * x[i].e, size = v_abs(X.hi) + off;
        const vpair square = vpair_square(X);
        const vm adds = i < 2 ? m_if_all(1) : on_end;
        f.v = vpair_add(f.v, pick(adds, square, opposite(square)));
        f.e = f.e + v_sum_of(h.unit, square.hi, v_set(2) * size * x[i].e);
        s = v_sum_of(X.hi, growth[i], s);
        s_error = v_sum_of(
            most, v_sum_of(v_set(8 * CYLINT_ROUNDING), size, off), s_error);
    }
    const vd c = v_set(3) * most * most;
    const vd inverse = v_set(0.5) / s;
    const vd step = rounded(f.v) * inverse;
    const vd moved = v_sum_of(v_sum_of(c, r->error, v_set(2) * s_error),
                              r->error, unit * f.e);
    const vd error =
        v_set(CYLINT_SLACK) *
        v_sum_of(v_abs(inverse), moved,
                 v_set(2 * CYLINT_ROUNDING) * (v_abs(step) + v_abs(r->tail)));
    vm nearer = v_lt(error, r->error);
    if (cylint_solid_has_discs(solid))
        nearer = m_and_not(nearer, r->on_end);
    return (hit_root){r->t, v_select(nearer, r->tail - step, r->tail),
                      v_select(nearer, error, r->error), r->on_end, r->top};
}

/* The members of both lanes.  Where the processor flushes subnormal numbers, those
 * from such numbers are not certain.  The numbers are tested first: a product with
 * a subnormal result takes an Intel processor 150 cycles. */
ASIDE void members_of(cylint_hit_lanes *to, const source *from,
                      const pair_line *in, const hit_root *r, unsigned want)
{
    members_at(to, from, in, r, want, cylint_prepared(from->shape));
    if (has_tiny_numbers(from) && cylint_flushes_subnormals())
        to->certain = 0;
}

/* Writes the wanted members of the n hits, of which hit i is in lane `lane ^ i`,
 * and to q->undecided those that are not certain. */
ASIDE void describe_roots(cylint_question *q, const pair_line *in,
                          const hit_root *at, int n, int lane)
{
    const source from = {q->shape, q->line};
    const int solid = cylint_prepared(q->shape);
    cylint_hit_lanes m;
    hit_root r;
    if (m_any(m_not(precise_lanes(at, in, q->D, solid)))) {
        r = nearer_root(at, &from, in, q->D, solid);
        if (m_any(m_not(precise_lanes(&r, in, q->D, solid))))
            r = nearer_root(&r, &from, in, q->D, solid);
        at = &r;
    }
    members_of(&m, &from, in, at, q->want);
    for (int i = 0; i < n; i++)
        q->undecided[i] = write_lane(&q->described[i], &m, q->want, lane ^ i);
}

/* The same by copies, so that its caller keeps the line and the roots in
 * registers. */
INLINE void describe_hits(cylint_question *q, const pair_line *in,
                          const root *r, cylint_end_bits e, int n, int lane)
{
    const pair_line copy = *in;
    const hit_root at = {r->value, r->tail, r->error, m_from(e.on_end),
                         m_from(e.top)};
    describe_roots(q, &copy, &at, n, lane);
}

/* Of a hit of which t is known, the double nearest to the root.  Returns the wanted
 * members that are not certain. */
static unsigned describe_known(const cylint_shape *shape,
                               const cylint_line *line, unsigned want,
                               const cylint_hit *known, cylint_hit *hit)
{
    const source from = {shape, line};
    const double t = known->t;
    const hit_root at = {v_set(t), v_set(0),
                         v_set(CYLINT_ROUNDING * fabs(t) + CYLINT_MEMBER_NEAR),
                         m_if_all(known->part != CYLINT_PART_LATERAL),
                         m_if_all(known->part == CYLINT_PART_CAP1)};
    cylint_question q;
    pair_line in;
    if (!cylint_prepared(shape) || !line->in_range ||
        !(fabs(t) < 1 / CYLINT_ROOT_LEAST) || !cylint_rounds_to_nearest())
        return want;
    q.shape = shape;
    q.line = line;
    q.want = want;
    q.described = hit;
    q.D = v_first(direction_bound(&from));
    load_any_pairs(&in, shape, line, 1);
    describe_roots(&q, &in, &at, 1, 0);
    return q.undecided[0];
}

#endif
