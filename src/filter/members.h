/*
 * members.h - point, normal, z and phi of a hit from its root, in lanes
 *
 * They are sums, products and quotients of the coordinates of the hit, which are
 * computed in pairs at the root.  Each has a bound on its error.  A component
 * whose rounding is certain is the double nearest to the real number; the
 * others are computed by a later stage.
 *
 * In local coordinates (local.h) the outward normal of a hit (x, y, z) is
 *
 *   of the lateral surface  x X + y Y - slope rho Z
 *   of a ball               x X + y Y + (z - z of its centre) Z
 *   of a plane              Z or -Z
 *
 * with the rows X, Y and Z of the matrix.  The first has the length rho / cosine
 * where the rows have length 1, the second that of the radius.
 *
 * A bound is a sum of sizes of terms, so it is 0 where all terms are: the zeros of
 * upright shapes and of lines in a plane of coordinates are certain.  Bounds are
 * counted in units of CYLINT_MEMBER_UNIT: a bound that underflows to 0 in this unit
 * is that of a number that rounds to 0.
 */
#ifndef CYLINT_MEMBERS_H
#define CYLINT_MEMBERS_H

#include "../numbers/turns_lanes.h"
#include "surfaces.h"

/* A hit: |root - (t + tail)| is at most the error.  on_end, top: see line_end. */
typedef struct {
    vd t, tail, error;
    vm on_end, top;
} hit_root;

/* ------------------------------------------------- the shape and line -- */

/* Column j of a row of the matrix. */
INLINE vpair entry_at(const source *from, int row, int j)
{
    return pair_at(from, CYLINT_AT_COLUMNS + 3 * j + row);
}

/* What the errors of the entries are relative to: the entry itself or, where it may
 * have cancelled, the norm; an entry 0 is exact. */
INLINE void set_entry_sizes(vd size[3][3], const source *from)
{
    const vm elliptic = fact_of(from, FACT_ELLIPTIC);
    EACH(row, 3)
        EACH(j, 3)
            size[row][j] = v_abs(entry_at(from, row, j).hi);
    if (!m_any(elliptic))
        return;
    EACH(row, 3)
        EACH(j, 3) {
            const vm other = m_and(elliptic, v_lt(v_set(0), size[row][j]));
            size[row][j] =
                v_select(other, number_at(from, CYLINT_AT_NORM), size[row][j]);
        }
}

INLINE bounded_pairs zero_pairs(void)
{
    return (bounded_pairs){{v_set(0), v_set(0)}, v_set(0)};
}

/* ----------------------------------------------------------- the hit --- */

/* from + (t + tail) by.  Where terms cancel, lo can exceed hi. */
INLINE vpair at_root(vpair from, vpair by, const hit_root *r)
{
    vpair step = v_two_prod(r->t, by.hi);
    step.lo = v_sum_of(r->tail, by.hi, v_sum_of(r->t, by.lo, step.lo));
    return vpair_add(from, step);
}

/* The hit in local coordinates, z from the base; rho is the radius of the lateral
 * surface there.  error: of the root, unit: of a number of size 1, both in units
 * of the bounds. */
typedef struct {
    bounded_pairs x, y, z, rho;
    vd error, unit, entry_size[3][3];
} local_hit;

/* The bound on a coordinate: the error of the matrix, which is relative to the
 * hit's coordinates, that of pairs, relative to their terms, and what that of the
 * root adds.  size: in units of 1 / CYLINT_MEMBER_SCALE, so that no product of a
 * subnormal number with an entry or the root's error is 0. */
INLINE vd coordinate_error(const local_hit *h, const vd size[3], int row, vd v,
                           int solid)
{
    vd sum = size[row];
    if (solid != CYLINT_SOLID_SPHERE) {
        sum = v_set(0);
        EACH(j, 3)
            sum = v_sum_of(h->entry_size[row][j], size[j], sum);
    }
    return v_sum_of(h->unit * v_set(1 / CYLINT_MEMBER_SCALE), sum,
                    v_abs(v) * h->error);
}

INLINE local_hit hit_at(const source *from, const pair_line *in,
                        const hit_root *r, int solid)
{
    const vpair vx = pairs_of_two(in->v, 0), vy = pairs_of_two(in->v, 1);
    const vd scale = v_set(CYLINT_MEMBER_SCALE);
    const vd most_t =
        scale * (v_abs(r->t) + v_set(1 / CYLINT_MEMBER_FAR) * r->error);
    vd size[3];
    local_hit h;
    h.unit = v_set(CYLINT_MEMBER_COORDINATE / CYLINT_MEMBER_UNIT) * in->error;
    h.error = v_set(1 / CYLINT_MEMBER_UNIT) * r->error;
    EACH(j, 3) {
        const vd o = from_base_at(from, j), d = direction_at(from, j).hi;
        const vd terms = v_sum_of(most_t, v_abs(d), scale * v_abs(o));
        size[j] = v_sum_of(scale, v_abs(v_sum_of(r->t, d, o)),
                           v_set(CYLINT_MEMBER_FAR) * terms);
    }
    set_entry_sizes(h.entry_size, from);
    h.x = (bounded_pairs){at_root(pairs_of_two(in->p, 0), vx, r),
                          coordinate_error(&h, size, 0, vx.hi, solid)};
    h.y = (bounded_pairs){at_root(pairs_of_two(in->p, 1), vy, r),
                          coordinate_error(&h, size, 1, vy.hi, solid)};
    h.z = (bounded_pairs){at_root(pairs_of_end(in->z, 0), in->w, r),
                          coordinate_error(&h, size, 2, in->w.hi, solid)};
    h.rho = (bounded_pairs){in->rho, v_set(0)};
    if (cylint_solid_is_tapered(solid)) {
        const vd slope = v_abs(number_at(from, CYLINT_AT_SLOPE));
        const vd r0 = number_at(from, CYLINT_AT_R0);
        const vpair rho = at_root(in->rho, in->growth, r);
        h.rho.v = v_two_sum(rho.hi, rho.lo);
        h.rho.e =
            v_set(2) * v_sum_of(h.unit * r0, v_set(1) + slope, slope * h.z.e);
    }
    return h;
}

/* ---------------------------------------------------------- roundings -- */

/* Writes the double nearest to x.  Returns the lanes in which it is certain: all
 * numbers within x.e + beside |x| of x round to it. */
INLINE vm rounds(bounded_pairs x, double beside, vd *to)
{
    const vpair s = v_two_sum(x.v.hi, x.v.lo);
    const vd e =
        v_sum_of(v_set(beside), v_abs(s.hi), v_set(CYLINT_MEMBER_UNIT) * x.e);
    const vd up = s.hi + (s.lo + e), down = s.hi + (s.lo - e);
    const vm large = v_le(v_set(CYLINT_MEMBER_LEAST), v_abs(s.hi));
    *to = up + v_set(0); /* no -0 */
    return m_and(v_eq(up, down), m_or(large, v_eq(x.e, v_set(0))));
}

/* The same of three components, which are stored. */
INLINE vm round_vector(double to[3][8], const bounded_pairs x[3], double beside)
{
    vm certain = m_if_all(1);
    EACH(i, 3) {
        vd nearest;
        certain = m_and(certain, rounds(x[i], beside, &nearest));
        v_store(to[i], nearest);
    }
    return certain;
}

/* ------------------------------------------------------------ members -- */

/* o + t d: no local coordinates.  In a plane of coordinates exactly. */
INLINE void point_of(bounded_pairs to[3], const source *from, const hit_root *r,
                     int solid)
{
    const vd error = v_set(1 / CYLINT_MEMBER_UNIT) * r->error;
    EACH(i, 3) {
        const vpair d = direction_at(from, i),
                    o = {origin_at(from, i), v_set(0)};
        const vd sizes = v_sum_of(v_abs(r->t), v_abs(d.hi), v_abs(o.hi));
        to[i] = (bounded_pairs){
            at_root(o, d, r),
            v_sum_of(v_abs(d.hi), error,
                     v_set(CYLINT_MEMBER_PLACE / CYLINT_MEMBER_UNIT) * sizes)};
    }
    if (cylint_solid_has_discs(solid) && m_any(r->on_end))
        EACH(i, 3) {
            vm is_fixed;
            const bounded_pairs x = {
                plane_coordinate(from, i, r->top, &is_fixed), v_set(0)};
            to[i] = choose_pairs(m_and(is_fixed, r->on_end), x, to[i]);
        }
}

INLINE bounded_pairs negated_where(vm m, bounded_pairs x)
{
    return (bounded_pairs){
        {v_select(m, -x.v.hi, x.v.hi), v_select(m, -x.v.lo, x.v.lo)}, x.e};
}

/* x by.  relative: the relative error of `by`.  Where the terms of x
 * cancel, the low part of the product can be the larger one. */
INLINE bounded_pairs product(bounded_pairs x, vpair by, vd relative)
{
    const vpair p = vpair_mul(x.v, by);
    return (bounded_pairs){
        p, v_sum_of(v_abs(p.hi + p.lo), relative, v_abs(by.hi) * x.e)};
}

/* z from the centre of the ball of an end. */
INLINE bounded_pairs from_center(const local_hit *h, const hit_root *r,
                                 const source *from, int solid)
{
    bounded_pairs z = h->z;
    if (solid != CYLINT_SOLID_SPHERE) {
        const vpair height = pair_at(from, CYLINT_AT_HEIGHT);
        const vpair above = vpair_sub(z.v, height);
        z = choose_pairs(
            r->top, (bounded_pairs){above, v_sum_of(h->unit, height.hi, z.e)},
            z);
    }
    return z;
}

/* The lanes of hits on a ball of a round solid. */
INLINE vm on_ball(const hit_root *r, int solid)
{
    return solid == CYLINT_SOLID_SPHERE ? m_if_all(1) : r->on_end;
}

/* The radius of the ball of an end. */
INLINE vd ball_radius(const hit_root *r, const source *from, int solid)
{
    const vd r0 = number_at(from, CYLINT_AT_R0);
    return cylint_solid_is_tapered(solid)
               ? v_select(r->top, number_at(from, CYLINT_AT_R1), r0)
               : r0;
}

/* x, y and z of the normal x X + y Y + z Z on the lateral surface or on a ball, of
 * a shape whose rows have length 1.  The bounds are of first order in the relative
 * error of rho, `relative`: each is at least this part of its term, so no sum of
 * terms is certain where it is not small. */
INLINE void unit_normal(bounded_pairs n[3], const local_hit *h,
                        const hit_root *r, const source *from, int solid)
{
    const int tapered = cylint_solid_is_tapered(solid);
    const vm inside_out = v_lt(h->rho.v.hi, v_set(0));
    bounded_pairs divisor = h->rho, z = zero_pairs();
    vpair one = {v_set(1), v_set(0)}, cosine = one;
    if (tapered) {
        divisor = negated_where(inside_out, divisor);
        cosine = pair_at(from, CYLINT_AT_COSINE);
    }
    if (cylint_solid_is_round(solid)) {
        const vm ball_lanes = on_ball(r, solid);
        const bounded_pairs ball = {{ball_radius(r, from, solid), v_set(0)},
                                    v_set(0)};
        divisor = choose_pairs(ball_lanes, ball, divisor);
        cosine = pick(ball_lanes, one, cosine);
    }
    const vd inverse = v_set(1) / divisor.v.hi;
    const vpair quotient = vpair_quotient(cosine, divisor.v, inverse);
    const vpair by = v_fast_two_sum(quotient.hi, quotient.lo);
    const vd relative = v_sum_of(divisor.e, inverse, h->unit);
    if (tapered) { /* the sign of rho is certain where bounds are small */
        const vpair sine = pair_at(from, CYLINT_AT_SINE);
        z = (bounded_pairs){opposite(sine),
                            v_set(2) * relative * v_abs(sine.hi)};
        z = negated_where(inside_out, z);
    }
    if (cylint_solid_is_round(solid))
        z = choose_pairs(on_ball(r, solid),
                         product(from_center(h, r, from, solid), by, relative),
                         z);
    n[0] = product(h->x, by, relative);
    n[1] = product(h->y, by, relative);
    n[2] = z;
}

/* The same on the lateral surface, not of length 1. */
INLINE void gradient(bounded_pairs n[3], const local_hit *h, const source *from,
                     int solid)
{
    const vpair one = {v_set(1), v_set(0)};
    n[0] = product(h->x, one, h->unit);
    n[1] = product(h->y, one, h->unit);
    n[2] = zero_pairs();
    if (cylint_solid_is_tapered(solid)) {
        const vpair slope = pair_at(from, CYLINT_AT_SLOPE);
        n[2] = product(h->rho, opposite(slope), h->unit);
    }
}

/* Component i of x X + y Y, and of z Z if the solid has slopes along the axis. */
INLINE bounded_pairs component_of(const bounded_pairs x[3], const local_hit *h,
                                  const source *from, int i, int solid)
{
    const int terms =
        cylint_solid_is_tapered(solid) || cylint_solid_is_round(solid) ? 3 : 2;
    bounded_pairs sum = zero_pairs();
    EACH(k, 3) {
        if (k == terms)
            break;
        const vpair entry = entry_at(from, k, i);
        const vpair p = vpair_mul(entry, x[k].v);
        sum.v = k == 0 ? p : vpair_add(sum.v, p);
        sum.e = v_sum_of(h->entry_size[k][i], x[k].e, sum.e);
    }
    return sum;
}

/* Component i of Z or -Z. */
INLINE bounded_pairs plane_component(const local_hit *h, const source *from,
                                     const hit_root *r, int i)
{
    const vpair z = entry_at(from, 2, i);
    const bounded_pairs up = {z, h->entry_size[2][i] * h->unit};
    return negated_where(m_not(r->top), up);
}

/* The vector n of length 1. */
INLINE void normalise(bounded_pairs n[3], vd unit)
{
    vpair square = {v_set(0), v_set(0)};
    vd error = v_set(0);
    EACH(i, 3) {
        n[i].v = v_two_sum(n[i].v.hi, n[i].v.lo);
        square = vpair_add(square, vpair_mul(n[i].v, n[i].v));
        error = error + n[i].e;
    }
    const vpair by = vpair_inverse_root(square);
    const vd relative = v_sum_of(error, by.hi, unit);
    EACH(i, 3)
        n[i] = product(n[i], by, relative);
}

INLINE void normal_of(bounded_pairs n[3], const local_hit *h,
                      const source *from, const hit_root *r, int solid)
{
    const vm skew = fact_of(from, FACT_SKEW);
    bounded_pairs local[3], inclined[3];
    unit_normal(local, h, r, from, solid);
    if (m_any(skew)) {
        gradient(inclined, h, from, solid);
        EACH(i, 3)
            local[i] = choose_pairs(skew, inclined[i], local[i]);
    }
    EACH(i, 3)
        n[i] = solid == CYLINT_SOLID_SPHERE
                   ? local[i]
                   : component_of(local, h, from, i, solid);
    if (cylint_solid_has_discs(solid))
        EACH(i, 3)
            n[i] =
                choose_pairs(r->on_end, plane_component(h, from, r, i), n[i]);
    if (m_any(skew))
        normalise(n, h->unit);
}

/* z from the base over the height. */
INLINE bounded_pairs height_share(const local_hit *h, const source *from)
{
    const vpair height = pair_at(from, CYLINT_AT_HEIGHT);
    const vd inverse = v_set(1) / height.hi;
    const vpair q = vpair_quotient(h->z.v, height, inverse);
    return (bounded_pairs){
        q, v_sum_of(h->unit, v_abs(q.hi), v_set(1.01) * h->z.e * inverse)};
}

INLINE vm z_of(vd *to, const local_hit *h, const source *from,
               const hit_root *r, int solid)
{
    const vm certain = rounds(height_share(h, from), 0, to);
    if (!cylint_solid_has_discs(solid))
        return certain;
    *to = v_select(r->on_end, v_select(r->top, v_set(1), v_set(0)), *to);
    return m_or(r->on_end, certain);
}

/* A bound in units as a number: 0 or at least 2^-600. */
INLINE vd in_turns(vd bound)
{
    const vd least = v_select(v_lt(v_set(0), bound), v_set(0x1p-600), v_set(0));
    return v_sum_of(bound, v_set(CYLINT_MEMBER_UNIT), least);
}

/* The angle is counted from the semi-axis a, that is x; of circular kinds from e x
 * axis, that is -x (local.c). */
INLINE bounded_pairs angle_of(const local_hit *h, const source *from)
{
    const vm circular = m_not(fact_of(from, FACT_ELLIPTIC));
    const bounded_pairs x = negated_where(circular, h->x),
                        y = negated_where(circular, h->y);
    vd error;
    const vpair turns =
        turns_of(v_two_sum(x.v.hi, x.v.lo), v_two_sum(y.v.hi, y.v.lo),
                 in_turns(x.e), in_turns(y.e), &error);
    return (bounded_pairs){turns, error * v_set(1 / CYLINT_MEMBER_UNIT)};
}

/* Hits on an axis that runs along a coordinate: every term of x and y is 0. */
INLINE vm lies_on_axis(const local_hit *h, const source *from,
                       const hit_root *r)
{
    const vd none = v_set(0);
    const vm stays = v_eq(v_abs(r->t) + r->error, none);
    vm on_axis = m_if_all(1);
    EACH(j, 3) {
        const vd d = v_abs(direction_at(from, j).hi);
        const vd entries = h->entry_size[0][j] + h->entry_size[1][j];
        const vd sizes =
            v_select(stays, none, d) + v_abs(from_base_at(from, j));
        on_axis = m_and(on_axis, m_or(v_eq(entries, none), v_eq(sizes, none)));
    }
    return on_axis;
}

/* phi is 0 on the axis. */
INLINE vm phi_of(vd *to, const local_hit *h, const source *from,
                 const hit_root *r)
{
    const vm certain = rounds(angle_of(h, from), CYLINT_MEMBER_TIE, to);
    const vm on_axis = lies_on_axis(h, from, r);
    *to =
        v_select(v_lt(*to, v_set(1)), *to, v_set(1 - CYLINT_NEAREST_ROUNDING));
    *to = v_select(on_axis, v_set(0), *to);
    return m_or(certain, on_axis);
}

INLINE unsigned of_member(unsigned i, vm certain)
{
    return m_bits(certain) << 8 * i;
}

/* The wanted members that depend on the local coordinates of the hit. */
INLINE unsigned local_members(unsigned want, int solid)
{
    const unsigned axial = CYLINT_WANT_Z | CYLINT_WANT_PHI;
    return want &
           (CYLINT_WANT_NORMAL | (solid == CYLINT_SOLID_SPHERE ? 0 : axial));
}

/* Spheres have z = phi = 0.  Those of a ball that is the whole of a round cone
 * are not certain here. */
INLINE void members_at(cylint_hit_lanes *to, const source *from,
                       const pair_line *in, const hit_root *r, unsigned want,
                       int solid)
{
    const int ball = solid == CYLINT_SOLID_SPHERE;
    const unsigned local = local_members(want, solid);
    unsigned certain = 0;
    bounded_pairs x[3];
    vd nearest;
    if (want & CYLINT_WANT_POINT) {
        point_of(x, from, r, solid);
        certain |= of_member(CYLINT_MEMBER_POINT,
                             round_vector(to->number + CYLINT_HIT_POINT, x, 0));
    }
    if (ball) {
        v_store(to->number[CYLINT_HIT_Z], v_set(0));
        v_store(to->number[CYLINT_HIT_PHI], v_set(0));
        certain |= of_member(CYLINT_MEMBER_Z, fact_of(from, FACT_NO_AXIS)) |
                   of_member(CYLINT_MEMBER_PHI, fact_of(from, FACT_NO_AXIS));
    }
    to->certain = certain;
    if (!local)
        return;
    const local_hit h = hit_at(from, in, r, solid);
    if (local & CYLINT_WANT_NORMAL) {
        normal_of(x, &h, from, r, solid);
        certain |= of_member(
            CYLINT_MEMBER_NORMAL,
            round_vector(to->number + CYLINT_HIT_NORMAL, x, CYLINT_MEMBER_TIE));
    }
    if (local & CYLINT_WANT_Z) {
        certain |=
            of_member(CYLINT_MEMBER_Z, z_of(&nearest, &h, from, r, solid));
        v_store(to->number[CYLINT_HIT_Z], nearest);
    }
    if (local & CYLINT_WANT_PHI) {
        certain |= of_member(CYLINT_MEMBER_PHI, phi_of(&nearest, &h, from, r));
        v_store(to->number[CYLINT_HIT_PHI], nearest);
    }
    to->certain = certain;
}

/* Writes the wanted members of a lane; returns those that are not certain. */
INLINE unsigned write_lane(cylint_hit *hit, const cylint_hit_lanes *m,
                           unsigned want, int lane)
{
    const uint32_t uncertain = ~m->certain >> lane & 0x01010101;
    if (want & CYLINT_WANT_POINT)
        EACH(i, 3)
            hit->point[i] = m->number[CYLINT_HIT_POINT + i][lane];
    if (want & CYLINT_WANT_NORMAL)
        EACH(i, 3)
            hit->normal[i] = m->number[CYLINT_HIT_NORMAL + i][lane];
    if (want & CYLINT_WANT_Z)
        hit->z = m->number[CYLINT_HIT_Z][lane];
    if (want & CYLINT_WANT_PHI)
        hit->phi = m->number[CYLINT_HIT_PHI][lane];
    /* the product moves bit 8 i to 28 + i */
    return (unsigned)(uncertain * 0x10204080 >> 28) * CYLINT_WANT_POINT & want;
}

#endif
