/*
 * turns_lanes.h - the angle of a point in turns, in lanes (turns.h)
 */
#ifndef CYLINT_NUMBERS_TURNS_LANES_H
#define CYLINT_NUMBERS_TURNS_LANES_H

#include "error_bounds.h"
#include "turns.h"
#include "simd.h"

/* (atan(q) / q - 1) / (2 pi q^2) as a polynomial in z = q^2, the highest power
 * first: that through Chebyshev's four points of [0, CYLINT_TURN_TANGENT^2],
 * its coefficients rounded.  Its error is below CYLINT_TURN_SERIES. */
static const double turn_series[4] = {
    0x1.219d7dd2f8fe4p-6, -0x1.7483745cd7891p-6, 0x1.04c26be3ae7c6p-5,
    -0x1.b2995e7b7b603p-5};

/* The node next to the angle whose tangent is r, in turns, and its cosine and
 * sine.  Of NaN it is any. */
INLINE vd turn_node(vd r, vpair *cosine, vpair *sine)
{
    const vd most = v_set(0.125), step = v_set(0x1.8p44); /* of 2^-8 */
    const vd bend =
        v_sum_of(r, v_set(-CYLINT_TURN_CURVE), v_set(CYLINT_TURN_SLOPE));
    const vd near = v_sum_of(r, bend, step) - step;
    const vd node = v_select(v_lt(near, most), near, most);
    double k[LANES];
    const char *row[LANES];
    vd column[4];
    v_store(k, node * v_set(256));
    EACH(i, LANES)
        row[i] = (const char *)cylint_turn_node[(int)k[i]];
    v_columns(row, 0, column);
    *cosine = (vpair){column[0], column[1]};
    *sine = (vpair){column[2], column[3]};
    return node;
}

/* atan(q) in turns, lo not trimmed; z = q^2. */
INLINE vpair turn_of_tangent(vpair q, vd z)
{
    const vd per_radian = v_set(CYLINT_TURN_PER_RADIAN);
    vd series = v_set(turn_series[0]);
    EACH(i, 3)
        series = v_sum_of(series, z, v_set(turn_series[i + 1]));
    const vpair p = v_two_prod(q.hi, per_radian);
    const vd low = v_sum_of(q.hi, v_set(CYLINT_TURN_PER_RADIAN_LO), p.lo);
    const vd first = v_sum_of(-z, q.lo, q.lo); /* atan' = 1 - z + ... */
    return (vpair){
        p.hi, v_sum_of(q.hi * z, series, v_sum_of(first, per_radian, low))};
}

/*
 * The angle of (x, y), counted from the x axis towards the y axis, in [0, 1].
 * Each of x and y is 0, or |hi| is between 2^-400 and 2^400, |lo| <= 2^-50 |hi|;
 * not both are 0.  ex and ey are their absolute errors, 0 or at least 2^-600.  Of
 * the result |lo| <= ulp(hi) / 2; a little below the positive x axis hi is 1 and
 * lo is negative.
 *
 * *error bounds the difference from the angle, in [0, 1), of every point
 * within ex and ey of (x, y).  With the node, in turns, the angle a beyond it,
 * whose tangent is q, and `low`, the result's last sum, it is
 *
 *     CYLINT_TURN_INPUT (|x| ey + |y| ex) / |(x, y)|^2 + CYLINT_TURN_NODE node
 *       + |a| (CYLINT_TURN_CUBIC q^2 + CYLINT_TURN_RELATIVE) + 2^-53 |low|,
 *
 * below 2^-72.3 where ex = ey = 0, relative to the angle's distance from an
 * axis if that is small, and 0 on an axis.  It is 1 if there is no bound: if
 * ex + ey is CYLINT_TURN_NEAR |(x, y)| or more, or if such a point can be on the
 * other side of the positive x axis.
 */
INLINE vpair turns_of(vpair x, vpair y, vd ex, vd ey, vd *error)
{
    const vd zero = v_set(0), one = v_set(1);
    const vm left = v_lt(x.hi, zero), below = v_lt(y.hi, zero);
    const vpair across = {v_abs(x.hi), v_select(left, -x.lo, x.lo)};
    const vpair up = {v_abs(y.hi), v_select(below, -y.lo, y.lo)};
    const vm steep = v_lt(across.hi, up.hi);
    const vpair u = pick(steep, up, across), v = pick(steep, across, up);
    vpair cosine, sine;
    const vd node = turn_node(v.hi / u.hi, &cosine, &sine);
    const vpair uc = vpair_product(u, cosine), vs = vpair_product(v, sine);
    const vpair sum = v_fast_two_sum(uc.hi, vs.hi); /* v sin <= u cos */
    const vpair den = {sum.hi, sum.lo + (uc.lo + vs.lo)};
    const vpair num =
        vpair_sub(vpair_product(v, cosine), vpair_product(u, sine));
    const vd inverse = v_set(1) / den.hi;
    const vpair q = vpair_quotient(num, den, inverse);
    const vd z = q.hi * q.hi;
    const vpair a = turn_of_tangent(q, z);

    /* the octant: an axis, and the way from it */
    const vd way = v_like(one, x.hi * y.hi);
    const vd to = v_select(steep, -way, way);
    const vd x_axis = v_select(left, v_set(0.5), v_select(below, one, zero));
    const vd axis =
        v_select(steep, v_select(below, v_set(0.75), v_set(0.25)), x_axis);
    const vd turn = v_sum_of(to, node, axis);
    const vpair exact = v_fast_two_sum(turn, to * a.hi); /* |a| < 1/256 */
    const vd low = v_sum_of(to, a.lo, exact.lo);
    const vpair result = v_fast_two_sum(exact.hi, low);

    const vd moved = v_sum_of(ey, across.hi, ex * up.hi) * (inverse * inverse);
    const vd beyond_error = v_abs(a.hi) * v_sum_of(z, v_set(CYLINT_TURN_CUBIC),
                                                   v_set(CYLINT_TURN_RELATIVE));
    const vd rounding =
        v_sum_of(v_abs(low), v_set(CYLINT_NEAREST_ROUNDING), beyond_error);
    const vd e = v_sum_of(moved, v_set(CYLINT_TURN_INPUT),
                          v_sum_of(node, v_set(CYLINT_TURN_NODE), rounding));
    const vm near = v_lt(ex + ey, v_set(CYLINT_TURN_NEAR) * den.hi);
    const vm on_one_side =
        m_and(v_le(e, result.hi), v_le(e, (one - result.hi) - result.lo));
    *error = v_select(m_and(near, on_one_side), e, one);
    return result;
}

#endif
