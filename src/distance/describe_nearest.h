/*
 * describe_nearest.h - the nearest point and the normal there in pairs, in lanes
 *
 * With the axis w, the direction u from the axis to the point x, the distance d and
 * the normal n = cosine u - sine w of the lateral surface:
 *
 *   lateral    x - d n              rim        centre + r u
 *   cap        x - (height) w       tangency   centre + r n
 *   ball       centre + r D / |D|   apex       centre
 *
 * A component is certain if every number within the bound on its error rounds
 * to the same double.  Bounds are sums of the sizes of terms, so the zeros of a
 * shape along a coordinate are certain.  No term underflows: of points with a
 * coordinate below CYLINT_DISTANCE_LEAST from the base, and not 0, and on a ball
 * or rim with such a radius, nothing is certain.
 */
#ifndef CYLINT_DESCRIBE_NEAREST_H
#define CYLINT_DESCRIBE_NEAREST_H

#include "pair_lanes.h"

/* The point and the normal, and where all their components are certain. */
typedef struct {
    vd point[3], normal[3];
    vm point_certain, normal_certain;
} described_point;

/* What a point is nearest to.  is_top: it belongs to the top. */
typedef struct {
    vm is_lateral, is_plane, is_ball, is_apex, is_top;
} vfeature;

INLINE vfeature feature_of(const vnearest *n, const shape_lanes *s, int kind)
{
    const vm none = m_from(0);
    const int round = cylint_is_round(kind);
    vfeature f;
    f.is_top = m_or(is_feature(n, CYLINT_FEATURE_CAP1),
                    is_feature(n, CYLINT_FEATURE_RIM1));
    const vm is_cap = m_or(is_feature(n, CYLINT_FEATURE_CAP0),
                           is_feature(n, CYLINT_FEATURE_CAP1));
    const vd r = v_select(f.is_top, s->r[1].hi, s->r[0].hi);
    f.is_lateral = is_feature(n, CYLINT_FEATURE_LATERAL);
    f.is_apex = m_and_not(v_eq(r, v_set(0)), f.is_lateral);
    f.is_ball = round ? m_and_not(is_cap, f.is_apex) : none;
    f.is_plane = round ? none : m_and_not(is_cap, f.is_apex);
    if (kind == CYLINT_KIND_SPHERE)
        f = (vfeature){none, none, m_not(none), none, none};
    return f;
}

/* Where x certainly rounds to *to.  A certain zero has no error. */
INLINE vm rounds(bounded_pairs x, vd *to)
{
    const vpair s = pairs_trimmed(x.v);
    const vd e = v_sum_of(v_set(CYLINT_NEAREST_MARGIN), v_abs(s.hi), x.e);
    *to = s.hi + v_set(0); /* no -0 */
    return v_eq(s.hi + (s.lo + e), s.hi + (s.lo - e));
}

/* Component i of the direction from the axis. */
INLINE bounded_pairs across_axis(const half_plane *m, int i)
{
    const vd relative =
        v_sum_of(m->rho_error, m->inverse.hi, v_set(CYLINT_PAIR_QUOTIENT));
    const vpair u = vpair_product(m->across[i], m->inverse);
    return (bounded_pairs){
        u, v_sum_of(m->across_error[i], m->inverse.hi, v_abs(u.hi) * relative)};
}

/* A multiple of u and one of the axis: a u + b w. */
typedef struct {
    vpair a, b;
} multiples;

/* Of the normal: cosine and -sine, or of a plane and an apex 0 and 1 or -1. */
INLINE multiples normal_of(const vfeature *f, const shape_lanes *s, int kind)
{
    const vd zero = v_set(0), one = v_set(1);
    const int tapered = cylint_is_tapered(kind);
    const vm axial = m_or(f->is_plane, f->is_apex);
    const vpair C = tapered ? s->cosine : (vpair){one, zero},
                S = tapered ? opposite(s->sine) : (vpair){zero, zero};
    const vpair side = {v_select(f->is_top, one, -one), zero};
    return (multiples){pick(axial, (vpair){zero, zero}, C),
                       pick(axial, side, S)};
}

INLINE bounded_pairs sum_of_multiples(const multiples *k, bounded_pairs u,
                                      vpair w)
{
    const vpair across = vpair_product(k->a, u.v),
                along = vpair_product(k->b, w);
    const vd sizes = v_abs(across.hi) + v_abs(along.hi);
    return (bounded_pairs){
        vpair_add(across, along),
        v_sum_of(v_abs(k->a.hi), u.e, v_set(CYLINT_POINT_ROUNDING) * sizes)};
}

/* from + factor e.  Where terms of both cancelled, their low parts can be as large
 * as the high ones: they are trimmed. */
INLINE bounded_pairs step_along(vpair from, bounded_pairs factor,
                                bounded_pairs e)
{
    const vpair step =
        vpair_product(pairs_trimmed(factor.v), pairs_trimmed(e.v));
    const vpair to = vpair_add(from, step);
    const vd error =
        v_sum_of(factor.e, v_abs(e.v.hi) + e.e, v_abs(factor.v.hi) * e.e);
    return (bounded_pairs){
        to,
        v_sum_of(v_set(CYLINT_PAIR_QUOTIENT), v_abs(step.hi),
                 v_sum_of(v_set(CYLINT_PAIR_PLACE), v_abs(from.hi), error))};
}

/* The direction of D from the centre of a ball; at one lane, in the centre of a
 * sphere, that of the first coordinate. */
typedef struct {
    vpair D[3], inverse;
} from_center;

INLINE from_center load_center(const half_plane *m, const shape_lanes *s,
                               const vd x[3], vm is_top, int ball)
{
    from_center c;
    vpair squares[3];
    if (ball) {
        EACH(i, 3)
            c.D[i] = m->D[i];
        c.inverse = m->inverse;
        if (LANES == 1 && m_any(v_eq(m->square.hi, v_set(0))))
            c.D[0].hi = c.inverse.hi = v_set(1);
        return c;
    }
    EACH(i, 3) {
        c.D[i] = v_two_sum(x[i], -v_select(is_top, s->top[i], s->base[i]));
        squares[i] = vpair_square(c.D[i]);
    }
    pairs_root(pairs_sum3(squares), &c.inverse);
    return c;
}

/* Where the doubles serve: no coordinate of a difference and no radius that is
 * multiplied is tiny, and the direction from the axis, or from the centre of a
 * ball, is certain. */
INLINE vm is_regular(const half_plane *m, const vfeature *f, vd r,
                     const from_center *c)
{
    const vd zero = v_set(0), least = v_set(CYLINT_DISTANCE_LEAST);
    const vm no_radius = m_or(m_or(f->is_lateral, f->is_plane), v_eq(r, zero));
    const vm off_axis = v_lt(v_set(4) * m->rho_error * m->inverse.hi, v_set(1));
    vm regular = m_or(m_and(v_lt(zero, m->inverse.hi), off_axis),
                      m_or(f->is_plane, f->is_ball));
    regular = m_and(regular, m_or(no_radius, v_le(least, r)));
    EACH(i, 3) {
        const vd x = v_abs(m->D[i].hi);
        regular = m_and(regular, m_or(v_le(least, x), v_eq(x, zero)));
        if (c) {
            const vd y = v_abs(c->D[i].hi);
            regular = m_and(regular, m_or(v_le(least, y), v_eq(y, zero)));
        }
    }
    if (c)
        regular =
            m_and(regular, m_or(m_not(f->is_ball), v_lt(zero, c->inverse.hi)));
    return regular;
}

/* Coordinate i of the point, where it is one of the centre or of the point x: of an
 * apex, of a rim and a cap about a coordinate axis. */
INLINE vm given_coordinate(vd *to, const shape_lanes *s, const vfeature *f,
                           vd center, vd x, int i, int round)
{
    const vm own = round ? m_from(0) : m_and_not(s->own[i], f->is_lateral);
    const vm beside = m_and(m_and_not(s->along, s->own[i]), f->is_plane);
    const vm given = m_or(m_or(own, beside), f->is_apex);
    *to = v_select(given, v_select(beside, x, center) + v_set(0),
                   *to); /* no -0 */
    return given;
}

INLINE void describe_nearest(described_point *to, const vnearest *n,
                             const half_plane *m, const shape_lanes *s,
                             const vd x[3], int kind)
{
    /* mutant '0' -> '1': slower, the members are left to the next stage */
    const vd zero = v_set(0);
    const int round = cylint_is_round(kind), ball = kind == CYLINT_KIND_SPHERE;
    const int tapered = cylint_is_tapered(kind);
    const vfeature f = feature_of(n, s, kind);
    const vpair r = pick(f.is_top, s->r[1], s->r[0]);
    const vm from_x = m_or(f.is_lateral, f.is_plane);
    const bounded_pairs factor = {
        pick(from_x, opposite(n->d.value), r),
        v_select(from_x, n->d.error, v_set(CYLINT_POINT_ROUNDING) * r.hi)};
    const multiples k = normal_of(&f, s, kind);
    const int any_given = m_any(m_or(s->along, f.is_apex));
    from_center c;
    if (round)
        c = load_center(m, s, x, f.is_top, ball);
    const vm regular = is_regular(m, &f, r.hi, round ? &c : NULL);
    to->point_certain = to->normal_certain = m_and(n->certain, regular);
    EACH(i, 3) {
        const vpair center = pick(f.is_top, (vpair){s->top[i], s->top_low[i]},
                                  (vpair){s->base[i], zero});
        bounded_pairs u = {{zero, zero}, zero}, normal = u;
        if (!ball) {
            u = across_axis(m, i);
            normal = sum_of_multiples(&k, u, s->axis[i]);
        }
        if (round) {
            const vpair q = vpair_product(c.D[i], c.inverse);
            const bounded_pairs radial = {q, v_set(CYLINT_PAIR_QUOTIENT) *
                                                 v_abs(q.hi)};
            normal = ball ? radial : choose_pairs(f.is_ball, radial, normal);
        }
        /* x - d n, or the centre and r times a direction */
        const bounded_pairs direction =
            tapered && !round ? choose_pairs(from_x, normal, u) : normal;
        const vm certain =
            rounds(step_along(pick(from_x, (vpair){x[i], zero}, center), factor,
                              direction),
                   &to->point[i]);
        const vm given = any_given ? given_coordinate(&to->point[i], s, &f,
                                                      center.hi, x[i], i, round)
                                   : m_from(0);
        to->normal_certain =
            m_and(to->normal_certain, rounds(normal, &to->normal[i]));
        to->point_certain = m_and(to->point_certain, m_or(certain, given));
    }
}

#endif
