/*
 * describe.h - the members of the hits of one line and one shape
 *
 * Narrow lanes (frame.h): lane i belongs to end i.
 */
#ifndef CYLINT_DESCRIBE_H
#define CYLINT_DESCRIBE_H

#include "../shapes/local.h"
#include "../signs/origin.h"
#include "members.h"
#include "pair_forms.h"
#include "plane.h"

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

/* The members of both lanes.  Where the processor flushes subnormal numbers, those
 * from such numbers are not certain.  The numbers are tested first: a product with
 * a subnormal result takes an Intel processor 150 cycles. */
static void members_of(cylint_hit_lanes *to, const source *from,
                       const pair_line *in, const hit_root *r, unsigned want)
{
    members_at(to, from, in, r, want, cylint_prepared(from->shape));
    if (has_tiny_numbers(from) && cylint_flushes_subnormals())
        to->certain = 0;
}

/* The lanes in which members of the hit are likely to be certain: the error of the
 * root is small beside the radius there.  No coordinate of the line's direction
 * exceeds D. */
INLINE vm precise_lanes(const hit_root *r, const pair_line *in, double D,
                        int solid)
{
    vd rho = in->rho.hi;
    if (cylint_solid_is_tapered(solid))
        rho = v_sum_of(r->t, in->growth.hi, rho);
    const vm precise =
        v_le(v_set(D) * r->error, v_set(CYLINT_MEMBER_LIKELY) * v_abs(rho));
    return cylint_solid_is_round(solid) ? precise : m_or(precise, r->on_end);
}

/* Writes the wanted members of the n hits, of which hit i is in lane `lane ^ i`,
 * and to q->undecided those that are not certain: all where they are not likely to
 * be. */
ASIDE void describe_roots(cylint_question *q, const pair_line *in,
                          const hit_root *at, int n, int lane)
{
    const source from = {q->shape, q->line};
    const int solid = cylint_prepared(q->shape);
    cylint_hit_lanes m;
    q->undecided[0] = q->undecided[1] = q->want & CYLINT_WANT_BESIDE_T;
    if (local_members(q->want, solid) &&
        (n == 2 ? 3 : 1u << lane) & ~m_bits(precise_lanes(at, in, q->D, solid)))
        return;
    members_of(&m, &from, in, at, q->want);
    for (int i = 0; i < n; i++)
        q->undecided[i] =
            write_lane(&q->described->hit[i], &m, q->want, lane ^ i);
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

/* ---------------------------------------------- from the nearest double -- */

/* The residual of the surface of a hit at a moved origin, in lane 0.  Sets slope
 * and curvature there. */
INLINE bounded_value surface_of(estimate *at, const source *from,
                                const pair_line *in, const hit_root *r,
                                int solid)
{
    const vd none = v_set(0), two = v_set(2);
    const vd size =
        v_max(v_max(world_size(in->size, 0), world_size(in->size, 1)),
              world_size(in->size, 2));
    const line_end e = {r->top, r->on_end, none};
    local_line l = no_line;
    forms f = no_forms;
    verdict v = no_verdict;
    set_sizes(&l, from->shape, from->line,
              v_first(origin_bound(size, from->shape)),
              v_first(direction_bound(from)), solid);
    forms_in_pairs(&f, &v.ball, &l, in, from->shape, solid);
    v.A = bounded_A(f.A, &l, l.taper);
    v.B = bounded_B(f.B, &l, l.taper);
    count_all_roundings(&v, solid);
    const quadratic q = quadratic_of_end(&v, &e, solid);
    const bounded_value x = residual_at(in, &l, none, &e, solid);
    bounded_value slope = {two * q.B.v, two * q.B.e};
    at->curvature = v_abs(q.A.v) + q.A.e;
    if (cylint_solid_has_discs(solid)) {
        bounded_value w = {l.in.w, v_set(CYLINT_LOCAL_POSITION) * l.unit * l.D};
        count_roundings(&w, 1);
        slope = choose(r->on_end, w, slope);
        at->curvature = v_select(r->on_end, none, at->curvature);
    }
    at->slope = slope.v;
    at->slope_error = slope.e;
    /* lane 1 is that of the plane at the top */
    return choose(r->top, (bounded_value){v_turned(x.v), v_turned(x.e)}, x);
}

/*
 * The root of which t is the nearest double, from the origin moved to t or nearer
 * to the root, by a step of Newton's.  Where the error of the slope is at most 1/16
 * of it and the curvature changes it by at most 1/8 on the way to the root, the
 * residual is at least 13/16 of the slope times the distance, as step_from() takes
 * it.  Elsewhere the root is at the origin within twice the rounding of t, or
 * CYLINT_MEMBER_NEAR: this serves members that do not change along the line.
 */
INLINE hit_root root_beside(const source *from, const pair_line *in, double t,
                            int part, int solid)
{
    const vm on_end = m_if_all(part != CYLINT_PART_LATERAL),
             top = m_if_all(part == CYLINT_PART_CAP1);
    hit_root r = {v_set(0), v_set(0), v_set(0), on_end, top};
    estimate at;
    const bounded_value residual = surface_of(&at, from, in, &r, solid);
    const root beside = step_from(v_set(0), residual, &at);
    const vd distance = v_set(CYLINT_ROUNDING * fabs(t)),
             size = v_abs(at.slope);
    const vm sure = m_and(v_le(v_set(16) * at.slope_error, size),
                          v_le(v_set(8) * at.curvature * distance, size));
    const vm near = m_and(v_le(v_abs(beside.value), distance),
                          v_le(beside.error, distance));
    const vm closer = m_and(sure, near);
    const vm in_range = v_lt(v_set(fabs(t)), v_set(1 / CYLINT_ROOT_LEAST));
    const vd rounding = v_select(
        in_range, v_sum_of(v_set(2), distance, v_set(CYLINT_MEMBER_NEAR)),
        v_set(HUGE_VAL));
    r.tail = v_select(closer, beside.value, v_set(0));
    r.error = v_select(closer, beside.error, rounding);
    return r;
}

/* Writes the wanted members of the hit in lane 0, as far as they are certain;
 * returns the others. */
static unsigned describe_root(cylint_hit *hit, const source *from,
                              const pair_line *in, const hit_root *r,
                              unsigned want)
{
    cylint_hit_lanes m;
    if (!want)
        return 0;
    members_of(&m, from, in, r, want);
    return write_lane(hit, &m, want, 0);
}

/* z and phi on a ball that is the whole of a round cone.  They are those of a
 * capsule with the same axis.  The root is that of the ball, from an origin at
 * t + tail. */
static unsigned describe_z_and_phi(cylint_hit *hit, const source *ball,
                                   const hit_root *r, double t, double tail,
                                   unsigned want)
{
    cylint_shape capsule;
    pair_line in;
    if (!want)
        return 0;
    cylint_ball_of(&capsule, ball->shape, cylint_is_reversed(ball->shape));
    capsule.kind = CYLINT_KIND_CAPSULE;
    capsule.library.number[CYLINT_AT_R0] = cylint_r0(ball->shape);
    capsule.library.number[CYLINT_AT_R1] = cylint_r0(ball->shape);
    cylint_measure_local_plain(&capsule);
    const source from = {&capsule, ball->line};
    if (!cylint_prepared(&capsule))
        return want;
    load_moved_pairs(&in, &from, t, tail, CYLINT_SOLID_CAPSULE);
    return describe_root(hit, &from, &in, r, want);
}

/* ------------------------------------------------------- exact roots -- */

/* The number near value + tail that has up to 24 digits more than a double.  Data
 * of few digits have such roots, and often these, or coordinates of the hit, are
 * the middle of two doubles. */
INLINE vpair short_pair(vd value, vd tail)
{
    const vd coarse = v_set(0x1p-24) * v_abs(value);
    return v_two_sum(value, (tail + coarse) - coarse);
}

/* Whether the root of a hit on `part` is such a number, next to t + tail, and its
 * point follows without error: then writes the nearest doubles. */
static int describe_exact_point(const source *from, double t, vd tail, int part,
                                double point[3])
{
    const int solid = cylint_prepared(from->shape);
    const int on_end =
        part != CYLINT_PART_LATERAL && cylint_solid_has_discs(solid);
    const int surface =
        on_end ? part - CYLINT_PART_CAP0 : CYLINT_LATERAL_SURFACE;
    const vpair near = short_pair(v_set(t), tail);
    const pair root = {v_first(near.hi), v_first(near.lo)};
    return !cylint_solid_is_hull(solid) &&
           /* untaken 1 of 4: no inexact point of an exact sign is known */
           CYLINT_SIGN_ON_LINE(from->shape, from->line, root, surface) == 0 &&
           cylint_exact_point(from->line, root, point);
}

/* The same of the wanted members beside t, from t and part of `partial`.  The point
 * is computed from the line's origin, the others from an origin at t. */
static unsigned describe_again(const cylint_shape *shape,
                               const cylint_line *line, unsigned want,
                               const cylint_hit *partial, cylint_hit *hit)
{
    const source from = {shape, line};
    const int solid = cylint_prepared(shape);
    const unsigned axial = CYLINT_WANT_Z | CYLINT_WANT_PHI;
    pair_line in;
    if (solid == CYLINT_SOLID_NONE)
        return cylint_plane_members(shape, line, want, hit);
    if (!line->in_range || !cylint_rounds_to_nearest())
        return want;
    double tail = 0;
    for (int step = 0; step < 2 && want; step++) {
        load_moved_pairs(&in, &from, partial->t, tail, solid);
        const hit_root r =
            root_beside(&from, &in, partial->t, partial->part, solid);
        hit_root from_origin = r;
        from_origin.t = v_set(partial->t);
        from_origin.tail = v_set(tail) + r.tail;
        want = describe_root(hit, &from, &in, &from_origin,
                             want & CYLINT_WANT_POINT) |
               describe_root(hit, &from, &in, &r,
                             want & ~(unsigned)CYLINT_WANT_POINT);
        if (solid == CYLINT_SOLID_SPHERE)
            want =
                (want & ~axial) | describe_z_and_phi(hit, &from, &r, partial->t,
                                                     tail, want & axial);
        if (!cylint_sign(v_first(r.tail)))
            break;
        if (want & CYLINT_WANT_POINT &&
            describe_exact_point(&from, partial->t, from_origin.tail,
                                 partial->part, hit->point))
            want &= ~(unsigned)CYLINT_WANT_POINT;
        tail += v_first(r.tail);
    }
    return want;
}

#endif
