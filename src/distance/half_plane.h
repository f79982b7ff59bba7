/*
 * half_plane.h - a point and a shape in the half plane through the axis and
 * the point, in lanes
 *
 * The half plane has the coordinates z along the axis, from the base, and rho
 * across it.  There the lateral surface is a line with the direction (cosine,
 * sine).
 */
#ifndef CYLINT_HALF_PLANE_H
#define CYLINT_HALF_PLANE_H

#include "../numbers/simd.h"
#include "../shapes/shape_facts.h"
#include "error_bounds.h"
#include "nearest.h"

/* The numbers of the shapes of all lanes, in the form of a type of numbers.
 * own[i]: the axis runs along coordinate i; along: along any.  top_low: 0 but for
 * an angle cone. */
typedef struct {
    vpair axis[3], cosine, sine, height, r[2];
    vd base[3], top[3], top_low[3], reach;
    vm own[3], along;
} shape_lanes;

/* A point.  above: z minus the height.  square: of rho.  error: of rho, z and
 * combinations of both with factors of at most 1.  The other members belong to
 * head_tail.h or to pair_lanes.h. */
typedef struct {
    vpair z, above, square;
    vd size, error; /* size: at least |D|, the height and the radii */
    vd snap, rough_z, rough_square;
    vpair rho, D[3], across[3], inverse; /* inverse: of rho */
    vd across_error[3], z_error, rho_error;
    vd plane_error; /* of z and above as distances; at one lane */
    vm rho_is_exact;
} half_plane;

/* A distance in the form of its type, and rounded with the error subtracted and
 * added. */
typedef struct {
    vpair value;
    vd low, high, error;
} vdistance;

typedef struct {
    vdistance d;
    vd feature;
    vm certain; /* the feature is certain */
} vnearest;

INLINE vd of_lanes(const cylint_shape *const at[LANES], int number)
{
    double of_lane[LANES];
    for (int lane = 0; lane < LANES; lane++)
        of_lane[lane] = at[lane]->library.number[number];
    return v_load(of_lane);
}

INLINE vpair pair_of_lanes(const cylint_shape *const at[LANES], int number)
{
    return (vpair){of_lanes(at, number), of_lanes(at, number + CYLINT_LOW)};
}

/* ------------------------------------------------- features, in doubles -- */

/* Where the foot certainly is: not after the start of the lateral line, between its
 * ends, not before its end. */
typedef struct {
    vm before, on, after;
} vfoot;

INLINE vfoot foot_of(vd before, vd after, vd M)
{
    return (vfoot){v_le(before, -M), m_and(v_lt(M, before), v_lt(after, -M)),
                   v_le(M, after)};
}

INLINE vd feature_at(vm top, int at_base, int at_top)
{
    return v_select(top, v_set(at_top), v_set(at_base));
}

/* A point and a shape between two planes.  a: the distance from the lateral line.
 * x0, x1: across the axis from its ends.  before, after: from its start and its end
 * to the foot, along the line. */
typedef struct {
    vd z, above, a, x0, x1, before, after;
} vsection;

/* Doubles have the right sign of every number that is larger than this. */
INLINE vd margin_of(const half_plane *m)
{
    return v_sum_of(v_set(CYLINT_FEATURE_MARGIN), m->size, m->error);
}

/* The feature of a closed shape, and where it is certain. */
INLINE void find_feature(vnearest *n, const half_plane *m, const vsection *p)
{
    const vd M = margin_of(m);
    const vd t = p->z + p->above, a = p->a;
    const vm top = v_lt(v_set(0), t);
    const vd b = v_max(-p->z, p->above);
    const vd x = v_select(top, p->x1, p->x0);
    const vm less = v_lt(a, b);
    const vm inside = m_and(v_lt(a, -M), v_lt(b, -M));
    const vm half = v_lt(M, v_abs(t));
    const vm tie = m_or(v_le(v_abs(a - b), M), m_and_not(less, half));
    const vm outside = m_or(v_lt(M + M, a), v_lt(M, b));
    const vm beyond = m_and(v_lt(M, b), v_lt(x, -M));
    const vm not_beyond = m_or(v_lt(b, -M), v_lt(M, x));
    const vfoot foot = foot_of(p->before, p->after, M);
    const vm sides = m_or(foot.on, m_or(foot.before, foot.after));
    const vm cap = m_or(m_and(inside, less), beyond);
    const vm lateral = m_or(inside, foot.on);
    n->certain = m_or(m_and(inside, m_not(tie)),
                      m_and(outside, m_or(beyond, m_and(not_beyond, sides))));
    n->feature = v_select(
        lateral, v_set(CYLINT_FEATURE_LATERAL),
        feature_at(foot.after, CYLINT_FEATURE_RIM0, CYLINT_FEATURE_RIM1));
    n->feature =
        v_select(cap, feature_at(top, CYLINT_FEATURE_CAP0, CYLINT_FEATURE_CAP1),
                 n->feature);
}

INLINE vm is_feature(const vnearest *n, int feature)
{
    return v_eq(n->feature, v_set(feature));
}

/* Where both are positive. */
INLINE vm are_positive(vd x, vd y)
{
    return m_and(v_lt(v_set(0), x), v_lt(v_set(0), y));
}

#endif
