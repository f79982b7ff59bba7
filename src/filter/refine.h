/*
 * refine.h - questions that the kernels of one.c do not decide
 *
 * The signs of the line, or those at the ends of its domain, in pairs; then roots
 * by a second step of Newton's on residuals in levels; then roots that have few
 * more digits than a double, exactly.
 */
#ifndef CYLINT_REFINE_H
#define CYLINT_REFINE_H

#include "../signs/origin.h"
#include "levels.h"
#include "one_answer.h"
#include "plane.h"

/* ------------------------------------------- the forms in pairs, rounded -- */

/* Zeros, without which compilers warn where `solid` is not a constant. */
static const local_line no_line;
static const forms no_forms;
static const verdict no_verdict;

/* The planes and circles of the ends. */
INLINE void set_planes(vpair z[1], vpair r[1], const pair_line *in,
                       const cylint_shape *shape, int solid)
{
    const source from = {shape, NULL};
    const vd r0 = v_set(cylint_r0(shape)), both = v_load(cylint_radii(shape));
    z[0] = in->z[0];
    r[0].hi = v_if(cylint_solid_is_tapered(solid), both, r0);
    r[0].lo = v_set(0);
    if (solid == CYLINT_SOLID_ROUND_CONE)
        move_to_circle_in_pairs(z, r, &from);
}

/* The line of the forms. */
INLINE void set_pairs(line_pairs *x, const pair_line *in, vpair z, vpair r,
                      const cylint_shape *shape, int solid)
{
    const int tapered = cylint_solid_is_tapered(solid);
    EACH(i, 2) {
        x->p[i] = pairs_of_two(in->p, i);
        x->v[i] = pairs_of_two(in->v, i);
    }
    x->z = pairs_of_end(&z, 0);
    x->r = pairs_of_end(&r, 0);
    x->w = in->w;
    x->slope =
        vpair_set(tapered ? cylint_slope(shape) : 0,
                  tapered ? cylint_number_pair(shape, CYLINT_AT_SLOPE).lo : 0);
    set_products_pairs(x);
}

/* The forms in pairs, rounded; and the line rounded. */
INLINE void forms_in_pairs(forms *f, balls *b, local_line *l,
                           const pair_line *in, const cylint_shape *shape,
                           int solid)
{
    const int tapered = cylint_solid_is_tapered(solid);
    const int ball = solid == CYLINT_SOLID_SPHERE;
    vpair z[1], r[1], Y[2] = {vpair_set(0, 0), vpair_set(0, 0)};
    line_pairs x;
    set_planes(z, r, in, shape, solid);
    set_pairs(&x, in, z[0], r[0], shape, solid);
    l->z[0] = rounded(z[0]);
    l->in.w = rounded(x.w);
    l->in.slope = x.slope.hi;
    if (cylint_solid_is_round(solid)) {
        const vpair center = ball ? x.z : in->z[0];
        const vpair radius = {l->ball_r[0], v_set(0)};
        f->A = rounded(ball_A_pairs(&x));
        f->B = rounded(ball_B_pairs(&x, center));
        f->G = rounded(ball_g_pairs(&x, center, radius));
        if (ball)
            return;
        set_balls(b, l, f->A, &f->B, &f->G);
    }
    if (tapered)
        set_Y_pairs(&x, Y);
    EACH(i, 2)
        f->Y[i] = v_if(tapered, rounded(Y[i]), v_set(0));
    f->G = rounded(G_pairs(&x, tapered, Y));
    f->A = rounded(A_pairs(&x, tapered));
    f->B = rounded(B_pairs(&x, tapered));
    if (solid == CYLINT_SOLID_NAPPE)
        f->T = rounded(T_pairs(&x, Y));
    if (!cylint_solid_has_planes(solid))
        return;
    f->E[0] = rounded(E_pairs(&x, z[0], r[0]));
    f->N[0] = rounded(N_pairs(&x, z[0], r[0], tapered));
}

/* Adds to the bound the roundings of a value; of A also that of A t where t is
 * estimated. */
INLINE void count_roundings(bounded_value *x, int roundings)
{
    x->e = v_sum_of(v_set(roundings * CYLINT_ROUNDING), v_abs(x->v), x->e);
}

INLINE void count_all_roundings(verdict *v)
{
    count_roundings(&v->G, 1);
    count_roundings(&v->A, 2);
    count_roundings(&v->B, 1);
    count_roundings(&v->ball.g[0], 1);
    count_roundings(&v->ball.A, 2);
    count_roundings(&v->ball.B[0], 1);
}

/* ------------------------------------------------------ signs in pairs -- */

/* The signs at the ends of the domain, in pairs, but for at->past.  What no lane
 * needs is not computed. */
INLINE void point_in_pairs(point_signs *at, const local_line *l,
                           const pair_line *in, vd t, const cylint_shape *shape,
                           int solid)
{
    const vd eZ = height_error(in, size_at(t, l));
    const vm all = m_from(3), none = m_from(0);
    vpair plane[1], r[1];
    vm between = all;
    at->side = at->rho = (signs){none, none};
    EACH(i, 2)
        at->above[i] = at->ball[i] = at->side;
    if (solid == CYLINT_SOLID_NAPPE) {
        const vpair rho = moved(in->rho, in->growth, t);
        at->rho = signs_of(rho.hi + rho.lo, l->taper * eZ);
    }
    if (cylint_solid_has_planes(solid)) {
        set_planes(plane, r, in, shape, solid);
        EACH(i, 2)
            at->above[i] =
                signs_of(rounded(moved(pairs_of_end(plane, i), in->w, t)), eZ);
        between = m_not(m_or(at->above[0].negative, at->above[1].positive));
    }
    if (cylint_solid_is_hull(solid))
        EACH_FUSED(i, 2) {
            const vm within = i ? at->above[1].negative : at->above[0].positive;
            if (!m_any(m_not(within)))
                continue;
            const bounded_value C =
                square_residual(in, l, t, all, pairs_of_end(in->z, i),
                                of_end(l->ball_r, i), solid);
            at->ball[i] = signs_of(C.v, C.e);
        }
    if (!m_any(between))
        return;
    const bounded_value side =
        square_residual(in, l, t, m_if_all(solid == CYLINT_SOLID_SPHERE),
                        pairs_of_end(in->z, 0), l->in.r, solid);
    at->side = signs_of(side.v, side.e);
}

/* Whether the line certainly lies in the plane of an end, one of coordinates. */
INLINE int lies_in_plane(const source *from)
{
    const cylint_line *line = from->line;
    int lies = 0;
    for (int i = 0; i < 3; i++) {
        vm here;
        const vpair plane = plane_coordinate(from, i, m_from(2), &here);
        here = m_and(here, m_and(v_eq(plane.hi, v_set(line->o[i])),
                                 v_eq(plane.lo, v_set(0))));
        lies |= m_any(here) && !cylint_too_small(line->o[i]) &&
                cylint_sign(line->d[i]) == 0;
    }
    return lies;
}

/* Whether the line is certainly parallel to the axis: both run along the same
 * coordinate.  Then it is on the side of its origin. */
INLINE int runs_along_axis(const source *from)
{
    const double *w = cylint_axis(from->shape), *d = from->line->d;
    int runs = 0;
    for (int i = 0; i < 3; i++)
        runs |= cylint_runs_along(w, i) && cylint_runs_along(d, i);
    return runs;
}

/* ------------------------------ a line that begins or ends at a surface -- */

/* Sets the uncertain sign in the lane of an end of the domain that is the line's
 * origin.  The domain is closed: a point of the surface counts as the one just
 * before tmin or after tmax.  rises: the sign of the slope there. */
INLINE void settle(signs *x, unsigned lane, int rises, const cylint_question *q,
                   int surface)
{
    if (m_bits(m_or(x->positive, x->negative)) & lane)
        return;
    int sign = CYLINT_SIGN_ON_LINE(q->shape, q->line, (pair){0, 0}, surface);
    if (sign == 0)
        sign = lane == 1 ? -rises : rises;
    if (sign > 0)
        x->positive = m_or(x->positive, m_from(lane));
    if (sign < 0)
        x->negative = m_or(x->negative, m_from(lane));
}

/*
 * The signs at an end of the domain that is the line's origin; not of hulls.  up:
 * the sign of w, which is certain where the line pierces a plane; 0 for a point.  A
 * line that pierces none and begins on a plane begins outside the lateral surface:
 * then the sign of z decides nothing.
 */
INLINE void settle_at_origin(point_signs *at, unsigned lane, int up,
                             const cylint_question *q, int solid)
{
    settle(&at->side, lane, q->rises, q, CYLINT_LATERAL_SURFACE);
    if (!cylint_solid_has_discs(solid))
        return;
    EACH(i, 2) {
        settle(&at->above[i], lane, up, q, i);
        const signs plane =
            q->ends.back ? reversed(at->above[i]) : at->above[i];
        const vm pierced = m_from(q->ends.on_end >> i & 1 ? lane : 0);
        at->past = signs_if(pierced, plane, at->past);
    }
}

/* The lanes of ends of the domain that are 0. */
INLINE unsigned limits_at_origin(const cylint_line *line)
{
    return (cylint_sign(line->tmin) == 0 ? 1u : 0) |
           (cylint_sign(line->tmax) == 0 ? 2u : 0);
}

/* A root that is exactly value + tail.  Only such roots have the error 0.  The tail
 * is at most half a step of the doubles, so no double lies between. */
INLINE root exact_root(vd value, vd tail)
{
    return (root){value, tail, v_set(0), m_from(3)};
}

/* x where m, else y. */
INLINE root root_if(vm m, const root *x, const root *y)
{
    return (root){
        v_select(m, x->value, y->value), v_select(m, x->tail, y->tail),
        v_select(m, x->error, y->error), m_if(m, x->nearest, y->nearest)};
}

/* Writes the root `exact` to those lanes of `needed` whose root it is: it lies
 * within the error, it is a root of the surface, and the other root of that
 * surface, which is as far away as the slope over the curvature, is farther than
 * both can be from each other. */
INLINE void try_root(root *r, const root *exact, const estimate *at,
                     unsigned needed, const cylint_question *q, int solid)
{
    const vd off = (exact->value - r->value) + (exact->tail - r->tail),
             distance = v_sum_of(v_set(2 * CYLINT_ROUNDING),
                                 v_abs(exact->value), v_set(4) * r->error),
             reach =
                 v_sum_of(v_set(4) * at->curvature, distance, at->slope_error);
    const vm near = v_le(v_abs(off), v_set(2) * r->error);
    unsigned found =
        needed & m_bits(m_and(near, v_lt(reach, v_abs(at->slope))));
    double t[2], tail[2];
    if (!found || cylint_solid_is_hull(solid))
        return;
    v_store(t, exact->value);
    v_store(tail, exact->tail);
    EACH(i, 2) {
        const int plane =
            q->ends.on_end >> i & 1 && cylint_solid_has_discs(solid);
        const int surface =
            plane ? (int)(q->ends.top >> i & 1) : CYLINT_LATERAL_SURFACE;
        if (found >> i & 1 &&
            CYLINT_SIGN_ON_LINE(q->shape, q->line, (pair){t[i], tail[i]},
                                surface) != 0)
            found &= ~(1u << i);
    }
    *r = root_if(m_from(found), exact, r);
}

/* Writes the roots of planes of coordinates, if the line's direction is a power of
 * two there: then they are differences of two doubles. */
ASIDE void set_roots_of_planes(root *r, const cylint_question *q)
{
    const source from = {q->shape, q->line};
    const vd none = v_set(0);
    for (int i = 0; i < 3; i++) {
        const double o = q->line->o[i], d = q->line->d[i];
        vm is_fixed;
        const vpair plane =
            plane_coordinate(&from, i, m_from(q->ends.top), &is_fixed);
        const vm here = m_and(m_and(is_fixed, m_from(q->ends.on_end)),
                              v_eq(plane.lo, none));
        if (!m_any(here) || cylint_bits(d) << 12 != 0 ||
            cylint_sign(q->line->d_lo[i]) != 0 || cylint_too_small(o))
            continue;
        const vpair rise = v_two_sum(plane.hi, v_set(-o));
        const root exact =
            exact_root(v_sum_of(rise.hi, v_set(1 / d), none), /* no -0 */
                       rise.lo * v_set(1 / d));
        *r = root_if(here, &exact, r);
    }
}

/* The number near value + tail that has up to 24 digits more than a double.  Data
 * of few digits have such roots, and often these are the middle of two doubles. */
INLINE vpair short_pair(vd value, vd tail)
{
    const vd coarse = v_set(0x1p-24) * v_abs(value);
    return v_two_sum(value, (tail + coarse) - coarse);
}

/* The hits; of exact roots all are decided.  The domain is closed, and its ends are
 * 0 or not tiny. */
INLINE hits exact_hits(const root *r, const local_line *l, vm present)
{
    const vd none = v_set(0);
    const vm exact = v_eq(r->error, none);
    const vm in = m_and(v_le(none, beyond_limit(r, of_end(l->limit, 0))),
                        v_le(beyond_limit(r, of_end(l->limit, 1)), none));
    const hits h = hits_of_roots(r, l, present);
    return (hits){m_if(exact, m_and(present, in), h.hit),
                  m_and_not(h.undecided, exact)};
}

/* ------------------------------------------------------------ points ---- */

/* 1 inside, -1 outside, 0 neither for certain. */
INLINE int side_of_place(place where)
{
    return (int)(m_bits(where.inside) & 1) - (int)(m_bits(where.before) & 1);
}

/* The signs that pairs leave uncertain, of a point near the surface, are computed
 * exactly.  A point with a coordinate that is not finite is undecided. */
INLINE int contains_exactly(point_signs *at, const cylint_question *q,
                            int solid)
{
    if (cylint_solid_is_hull(solid) || solid == CYLINT_SOLID_NAPPE ||
        !cylint_is_finite(q->line->o))
        return CYLINT_SIGN_UNDECIDED;
    settle_at_origin(at, 1, 0, q, solid);
    return side_of_place(place_of_point(at, solid));
}

/* A point near the surface of any solid. */
static int contains_in_pairs(const cylint_shape *shape, const double point[3])
{
    const int solid = cylint_prepared(shape);
    const cylint_line line = {
        .o = {point[0], point[1], point[2]}, .d = {1}, .in_range = 1};
    cylint_question q = {.shape = shape, .line = &line};
    local_line l = no_line;
    point_signs at = no_point_signs;
    pair_line in;
    if (!cylint_rounds_to_nearest())
        return CYLINT_SIGN_UNDECIDED;
    load_place(&l, point, shape, solid);
    l.unit = v_set(cylint_frame_error(shape));
    load_any_pairs(&in, shape, &line, 0);
    point_in_pairs(&at, &l, &in, v_set(0), shape, solid);
    const int side = side_of_place(place_of_point(&at, solid));
    return side != 0 ? side : contains_exactly(&at, &q, solid);
}

/* ------------------------------------------------------------ stages --- */

/* The signs of a line in pairs, then its hits by roots, also without t. */
static int refine_line(cylint_question *q)
{
    const cylint_shape *shape = q->shape;
    const int solid = cylint_prepared(shape);
    const source from = {shape, q->line};
    local_line l = no_line;
    pair_line in;
    forms f = no_forms;
    verdict v = no_verdict;
    if (solid == CYLINT_SOLID_WHOLE_CYLINDER && runs_along_axis(&from))
        return cylint_answer_parallel(contains_in_pairs(shape, q->line->o),
                                      q->answer);
    v.ball.computed = 1;
    v.exists[0] = m_from(3);
    set_sizes(&l, q, solid);
    load_any_pairs(&in, shape, q->line, 1);
    forms_in_pairs(&f, &v.ball, &l, &in, shape, solid);
    v.G = bounded_G(&f, &l, solid);
    judge(&v, &f, &l, solid);
    if (m_bits(m_or(v.misses, v_lt(v.G.v, -v.G.e))) & 1)
        return write_miss(q->answer);
    const int in_plane = has_end_planes(solid) && lies_in_plane(&from);
    if (in_plane)
        judge_in_plane(&v, m_from(3));
    q->is_along = in_plane && cylint_solid_has_discs(solid);
    if (!(m_bits(m_and(v.crosses, v.sided)) & 1))
        return leave_undecided(q, CYLINT_REFINE_NONE);
    count_all_roundings(&v);
    return answer_by_roots(&l, &v, &in, q, solid);
}

/* The hits of a line that crosses, by signs in pairs at the ends of the domain; on
 * which sides of the chord these lie is in q->past. */
INLINE int refine_ends(cylint_question *q, int solid)
{
    local_line l = no_line;
    pair_line in;
    verdict v = no_verdict;
    point_signs at = no_point_signs;
    set_sizes(&l, q, solid);
    const vd t = near_limit(l.limit[0]);
    load_any_pairs(&in, q->shape, q->line, m_bits(v_eq(t, v_set(0))) != 3);
    v.exists[0] = m_from(q->exists);
    v.A.v = v_set(q->A);
    at.past = (signs){m_from(q->past[0]), m_from(q->past[1])};
    point_in_pairs(&at, &l, &in, t, q->shape, solid);
    place where = place_of(&at, &v, l.limit[0], solid);
    const unsigned origin =
        limits_at_origin(q->line) &
        ~m_bits(m_or(m_or(where.before, where.inside), where.after));
    if (origin && !cylint_solid_is_hull(solid)) {
        EACH(i, 2)
            if (origin >> i & 1)
                settle_at_origin(&at, 1u << i, q->ends.back ? -1 : 1, q, solid);
        where = place_of(&at, &v, l.limit[0], solid);
    }
    return answer_by_places(&where, q->ends, q, solid);
}

/* A root of 0, or a second step, with residuals in levels for the ends that are
 * needed.  The first step may have led so far that the slope differs there: then
 * the second one is not certain. */
static int refine_roots(cylint_question *q)
{
    const cylint_shape *shape = q->shape;
    const int solid = cylint_prepared(shape);
    const cylint_end_bits bits = q->ends;
    const estimate at = {.slope = v_load(q->slope),
                         .slope_error = v_load(q->slope_error),
                         .curvature = v_load(q->curvature)};
    const root zero = exact_root(v_set(0), v_set(0));
    root r = bounded_root(v_load(q->value), v_load(q->tail), v_load(q->error));
    local_line l;
    pair_line in;
    if (cylint_too_small(q->line->tmin) || cylint_too_small(q->line->tmax))
        return CYLINT_UNDECIDED;
    if (q->want & CYLINT_WANT_BESIDE_T)
        load_any_pairs(&in, shape, q->line, 1);
    set_sizes(&l, q, solid);
    const vm present = m_from(q->ends.present);
    if (cylint_solid_has_discs(solid))
        set_roots_of_planes(&r, q);
    try_root(&r, &zero, &at, q->ends.present, q, solid);
    hits h = exact_hits(&r, &l, present);
    unsigned needed = ends_needed(h, bits, q->want);
    if (!needed)
        return write_hits(m_bits(h.hit), bits, &r, &in, q, solid);
    const vm is_near = v_le((r.error + v_abs(r.tail)) * at.curvature,
                            v_set(CYLINT_LOCAL_NEAR) * v_abs(at.slope));
    double t[2], residual[2] = {0, 0};
    v_store(t, r.value);
    /* nearly always one of them: no branch depends on which */
    for (unsigned ends = needed; ends; ends &= ends - 1) {
        const int i = (int)(ends >> 1 & ~ends);
        residual[i] = residual_in_levels(shape, q->line, t[i],
                                         (int)(q->ends.top >> i & 1),
                                         (int)(q->ends.on_end >> i & 1));
    }
    const bounded_value level = bounded_levels(v_load(residual), r.value, &l,
                                               m_from(q->ends.on_end), solid);
    const root better = step_from(r.value, level, &at);
    r = root_if(m_and(m_from(needed), is_near), &better, &r);
    h = exact_hits(&r, &l, present);
    needed = ends_needed(h, bits, q->want);
    if (needed) {
        const vpair coarse = short_pair(r.value, r.tail);
        const root near = exact_root(coarse.hi, coarse.lo);
        try_root(&r, &near, &at, needed, q, solid);
        h = exact_hits(&r, &l, present);
    }
    if (ends_needed(h, bits, q->want))
        return CYLINT_UNDECIDED;
    return write_hits(m_bits(h.hit), bits, &r, &in, q, solid);
}

#endif
