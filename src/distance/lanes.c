/*
 * lanes.c - distances of many points from capped shapes: distance_template.h in
 * lanes
 */
#include "lanes.h"

#include "describe_nearest.h"
#include "distance_types.h"

#ifndef CYLINT_DISTANCE_LANES
#define CYLINT_DISTANCE_LANES cylint_distance_lanes_plain
#endif

/* The points from i on, the last one again where there are no more. */
INLINE void load_points(vd x[3], const double *const xyz[3], int i, int n)
{
    EACH(k, 3) {
        double padded[LANES];
        if (i + LANES <= n) {
            x[k] = v_load(xyz[k] + i);
            continue;
        }
        for (int lane = 0; lane < LANES; lane++)
            padded[lane] = xyz[k][i + lane < n ? i + lane : n - 1];
        x[k] = v_load(padded);
    }
}

/* The shapes from i on, the last one again where there are no more.  Whether
 * the kernels serve them together. */
INLINE int find_shapes(const cylint_shape *at[LANES],
                       const cylint_shape *shapes, int i, int n)
{
    const int class_of_all = cylint_lane_class(shapes + i);
    int same = class_of_all != 0;
    for (int lane = 0; lane < LANES; lane++) {
        at[lane] = shapes + (i + lane < n ? i + lane : n - 1);
        same &= cylint_lane_class(at[lane]) == class_of_all;
    }
    return same;
}

/* Numbers of the lanes, of which the last block has fewer. */
INLINE void store(double *to, int i, int n, vd x)
{
    double of_lane[LANES];
    if (i + LANES <= n) {
        v_store(to + i, x);
        return;
    }
    v_store(of_lane, x);
    for (int lane = 0; i + lane < n; lane++)
        to[i + lane] = of_lane[lane];
}

INLINE void store_feature(signed char *to, int i, int n, vd x)
{
    double of_lane[LANES];
    v_store(of_lane, x);
    for (int lane = 0; lane < LANES && i + lane < n; lane++)
        to[i + lane] = (signed char)of_lane[lane];
}

/* Where all numbers within the error round to the same double. */
INLINE vm is_certain(const vnearest *n)
{
    return m_and(v_le(n->d.high, n->d.low), n->known);
}

/* With heads and tails: the distance, and the feature if `to` has it. */
INLINE vm answer_distances(const cylint_shape *const at[LANES],
                           const shape_lanes *s, const vd x[3], int i, int n,
                           const cylint_lane_columns *to)
{
    half_plane m;
    vnearest nearest;
    head_tail_nearest(&nearest, &m, s, x, at[0]->kind, to->feature != NULL);
    store(to->distance, i, n, nearest.d.low);
    if (to->feature)
        store_feature(to->feature, i, n, nearest.feature);
    return is_certain(&nearest);
}

/* In pairs: also point and normal. */
INLINE vm write_closest_lanes(const shape_lanes *s, const vd x[3], int i, int n,
                              const cylint_lane_columns *to, int kind)
{
    half_plane m;
    vnearest nearest;
    described_point members;
    pairs_nearest(&nearest, &m, s, x, kind, 1);
    describe_nearest(&members, &nearest, &m, s, x, kind);
    vm certain = m_and(is_certain(&nearest), v_le(v_set(CYLINT_DISTANCE_LEAST),
                                                  v_abs(nearest.d.low)));
    store(to->distance, i, n, nearest.d.low);
    if (to->feature)
        store_feature(to->feature, i, n, nearest.feature);
    if (to->point[0]) {
        certain = m_and(certain, members.point_known);
        EACH(k, 3)
            store(to->point[k], i, n, members.point[k]);
    }
    if (to->normal[0]) {
        certain = m_and(certain, members.normal_known);
        EACH(k, 3)
            store(to->normal[k], i, n, members.normal[k]);
    }
    return certain;
}

/* One text serves all kinds but the sphere, which has no axis. */
INLINE vm describe_any(int kind, const shape_lanes *s, const vd x[3], int i,
                       int n, const cylint_lane_columns *to)
{
    return kind == CYLINT_KIND_SPHERE
               ? write_closest_lanes(s, x, i, n, to, CYLINT_KIND_SPHERE)
               : write_closest_lanes(s, x, i, n, to, kind);
}

INLINE void load_shapes(shape_lanes *s, const cylint_shape *const at[LANES],
                        int described)
{
    if (described)
        pairs_load_shapes(s, at);
    else
        head_tail_load_shapes(s, at);
}

int CYLINT_DISTANCE_LANES(const cylint_shape *shapes, int each,
                          const double *const xyz[3], int n,
                          const cylint_lane_columns *to, int *rest)
{
    const cylint_shape *at[LANES];
    const int described = to->point[0] || to->normal[0];
    shape_lanes s;
    int left = 0;
    for (int lane = 0; lane < LANES; lane++)
        at[lane] = shapes;
    load_shapes(&s, at, described);
    for (int i = 0; i < n; i += LANES) {
        vd x[3];
        unsigned certain = 0;
        if (!each || find_shapes(at, shapes, i, n)) {
            if (each)
                load_shapes(&s, at, described);
            load_points(x, xyz, i, n);
            certain =
                m_bits(described ? describe_any(at[0]->kind, &s, x, i, n, to)
                                 : answer_distances(at, &s, x, i, n, to));
        }
        for (int lane = 0; lane < LANES && i + lane < n; lane++) {
            rest[left] = i + lane;
            left += !(certain >> lane & 1);
        }
    }
    return left;
}
