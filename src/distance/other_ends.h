/*
 * other_ends.h - distances in pairs, at one lane: from shapes with any ends, and
 * from angle cones
 *
 * The distance is that from the side of the feature that is outside a solid.  Where
 * the surface does not enclose a solid, write_certain() (one_distance.c) takes the
 * absolute value.
 */
#ifndef CYLINT_OTHER_ENDS_H
#define CYLINT_OTHER_ENDS_H

#include "pair_lanes.h"

/* The numbers of an angle cone in the lengths of the world: its local coordinates
 * count axis lengths.  Its top is not made of doubles. */
static void load_angle_cone(shape_lanes *s, const cylint_shape *shape)
{
    const cylint_shape *const at[1] = {shape};
    vpair squares[3], inverse;
    pairs_load_shapes(s, at);
    EACH(i, 3) {
        s->axis[i] = (vpair){cylint_axis(shape)[i], 0};
        squares[i] = vpair_square(s->axis[i]);
    }
    s->upright = m_from(0);
    s->height = pairs_trimmed(pairs_root(pairs_sum3(squares), &inverse));
    EACH(i, 3)
        s->axis[i] = pairs_trimmed(vpair_product(s->axis[i], inverse));
    s->r[1] =
        pairs_trimmed(vpair_product(s->height, (vpair){cylint_r1(shape), 0}));
    s->reach = (s->height.hi + s->r[1].hi) * CYLINT_SLACK;
}

/* A cap at the end `top`, the plane of which is at the signed distance `plane`, can
 * be nearer than the feature found.  x: across the axis from its circle. */
static void compare_with_cap(vnearest *n, const half_plane *m, vpair plane,
                             double x, int top)
{
    const double M = margin_of(m);
    const double difference = fabs(rounded(n->d.value)) - fabs(rounded(plane));
    if (x > M)
        return;
    n->certain &= (x < -M) & (fabs(difference) > M);
    if (difference > 0) {
        n->feature = CYLINT_FEATURE_CAP0 + top;
        n->d = pairs_rounded(plane, m->error);
    }
}

/* The lateral surface and the planes or balls of `caps`, 1 and 2. */
static void nearest_to_open(vnearest *n, half_plane *m, const shape_lanes *s,
                            unsigned caps, int kind)
{
    const int round = cylint_is_round(kind);
    const vpair rho = pairs_rho(m), z[2] = {m->z, m->above};
    const double C = s->cosine.hi, S = s->sine.hi;
    vpair x[2], y[2];
    double foot[2];
    for (int k = 0; k < 2; k++) {
        const vpair r = s->r[k];
        x[k] = vpair_sub(rho, round ? vpair_product(s->cosine, r) : r);
        y[k] = round ? vpair_add(z[k], vpair_product(s->sine, r)) : z[k];
        foot[k] = C * rounded(z[k]) + S * rounded(round ? rho : x[k]);
    }
    const vfoot at = foot_of(foot[0], foot[1], margin_of(m));
    const int end = foot[1] > 0, beyond = (foot[0] < 0) | end;
    /* Uncertain of a shape that is not higher than twice the margin. */
    n->certain =
        (at.before | at.on | at.after) & (s->height.hi > 2 * margin_of(m));
    if (!beyond) {
        const vpair line = round
                               ? vpair_sub(pairs_turned(s, rho, m->z), s->r[0])
                               : pairs_turned(s, x[0], m->z);
        n->feature = CYLINT_FEATURE_LATERAL;
        n->d = pairs_rounded(line, m->error);
    } else if (round && caps >> end & 1) {
        n->feature = CYLINT_FEATURE_CAP0 + end;
        n->d = pairs_from_ball(z[end], 0, s->r[end], m, 0);
    } else {
        n->feature = CYLINT_FEATURE_RIM0 + end;
        n->d = pairs_from_rim(x[end], y[end], m);
    }
    if (!round && caps)
        compare_with_cap(n, m, caps & 1 ? opposite(m->z) : m->above,
                         rounded(x[caps >> 1]), (int)caps >> 1);
}

/* An unbounded shape.  Beyond the apex the nearest nappe of a double cone is the
 * other one: the numbers of *s become its. */
static void nearest_to_unbounded(vnearest *n, half_plane *m, shape_lanes *s,
                                 int kind, int is_nappe)
{
    const vpair rho = pairs_rho(m);
    const double C = s->cosine.hi, S = s->sine.hi, M = margin_of(m);
    const double c = C * s->r[0].hi + S * rounded(m->z);
    if (cylint_is_tapered(kind))
        n->certain = is_nappe ? C * c + S * S * rounded(rho) > M : fabs(c) > M;
    if (cylint_is_tapered(kind) && !is_nappe && c < 0) {
        s->sine = opposite(s->sine);
        s->r[0] = opposite(s->r[0]);
    }
    n->d =
        pairs_rounded(pairs_turned(s, vpair_sub(rho, s->r[0]), m->z), m->error);
}

/* Of a shape of any kind and ends; the kind of an angle cone is that of a cone.
 * given: the feature, if the shape is capped, or CYLINT_NO_FEATURE. */
INLINE void find_nearest(vnearest *n, half_plane *m, shape_lanes *s,
                         const double point[3], const cylint_shape *shape,
                         int kind, int tangent, int given)
{
    const cylint_shape *const at[1] = {shape};
    if (tangent)
        load_angle_cone(s, shape);
    else
        pairs_load_shapes(s, at);
    pairs_load(m, s, point, kind != CYLINT_KIND_SPHERE);
    if (shape->ends == CYLINT_ENDS_CAPPED || kind == CYLINT_KIND_SPHERE) {
        n->feature = given;
        pairs_nearest(n, m, s, kind, given == CYLINT_NO_FEATURE);
        return;
    }
    *n = (vnearest){{{0, 0}, 0, 0, 0}, CYLINT_FEATURE_LATERAL, 1};
    if (cylint_ends_are_planes(shape->ends))
        nearest_to_open(n, m, s, cylint_caps_present(shape->ends), kind);
    else
        nearest_to_unbounded(n, m, s, kind, shape->ends == CYLINT_ENDS_NAPPE);
    if (!n->certain) /* another feature can be far nearer */
        n->d = pairs_rounded(n->d.value, HUGE_VAL);
}

#endif
