/*
 * lanes.c - distances of many points from capped shapes: distance_template.h in
 * lanes
 */
#include "lanes.h"

#include "describe_nearest.h"
#include "head_tail.h"

#ifndef CYLINT_DISTANCE_LANES
#define CYLINT_DISTANCE_LANES cylint_distance_lanes_plain
#endif

/* Loads the points from i on, of which there are n; further lanes get the last one
 * again. */
INLINE void load_points(vd x[3], const double *const xyz[3], size_t i, size_t n)
{
    size_t at[LANES];
    for (size_t lane = 0; lane < LANES; lane++)
        at[lane] = i + (lane < n ? lane : n - 1);
    EACH(k, 3)
        x[k] = n >= LANES ? v_load(xyz[k] + i) : v_pick(xyz[k], at);
}

/* Writes the shape of each lane, of which there are n; further lanes get the last
 * one again.  Returns whether the kernels serve them together. */
INLINE int find_shapes(const cylint_shape *at[LANES],
                       const cylint_shape *shapes, size_t n)
{
    const int class_of_all = cylint_lane_class(shapes);
    int same = class_of_all != 0;
    for (size_t lane = 0; lane < LANES; lane++) {
        at[lane] = shapes + (lane < n ? lane : n - 1);
        same &= cylint_lane_class(at[lane]) == class_of_all;
    }
    return same;
}

ASIDE void store_first(double *to, size_t n, vd x)
{
    double of_lane[LANES];
    v_store(of_lane, x);
    for (size_t lane = 0; lane < n; lane++)
        to[lane] = of_lane[lane];
}

/* The first n numbers of the lanes, to elements i and on of a column that is
 * wanted. */
INLINE void store(double *to, size_t i, size_t n, vd x)
{
    if (to && n >= LANES)
        v_store(to + i, x);
    else if (to)
        store_first(to + i, n, x);
}

/* Without a vector among its arguments: then compilers clear the upper halves of
 * registers. */
ASIDE void write_features(const cylint_closest_columns *to, size_t i, size_t n,
                          const cylint_shape *const at[LANES],
                          const double of_lane[LANES])
{
    for (size_t lane = 0; lane < LANES && lane < n; lane++) {
        const int feature = cylint_stated_feature(at[lane], (int)of_lane[lane]);
        if (to->feature)
            to->feature[i + lane] = (signed char)feature;
        if (to->part)
            to->part[i + lane] = (signed char)cylint_feature_part(feature);
    }
}

INLINE void store_features(const cylint_closest_columns *to, size_t i, size_t n,
                           const cylint_shape *const at[LANES], vd x)
{
    double of_lane[LANES];
    v_store(of_lane, x);
    write_features(to, i, n, at, of_lane);
}

/* Writes what is wanted, and returns the lanes where all of that is certain.
 * described: whether point and normal are wanted, which needs pairs; distance and
 * feature alone are computed with heads and tails. */
INLINE vm write_lanes(const cylint_shape *const at[LANES], int kind,
                      const shape_lanes *s, const vd x[3], size_t i, size_t n,
                      const cylint_closest_columns *to, unsigned want,
                      int described)
{
    const int with_part = (want & CYLINT_WANT_PART) != 0;
    const int axial = kind != CYLINT_KIND_SPHERE;
    half_plane m;
    vnearest nearest;
    described_point members;
    if (described) {
        pairs_load(&m, s, x, axial);
        pairs_load_rho(&m);
        pairs_nearest(&nearest, &m, s, kind, 1);
    } else {
        head_tail_load(&m, s, x, axial);
        head_tail_nearest(&nearest, &m, s, kind, with_part);
    }
    vm certain = m_and(v_le(nearest.d.high, nearest.d.low), nearest.certain);
    store(to->distance, i, n, nearest.d.low);
    if (with_part)
        store_features(to, i, n, at, nearest.feature);
    if (!described)
        return certain;
    describe_nearest(&members, &nearest, &m, s, x, kind);
    certain = m_and(certain,
                    v_le(v_set(CYLINT_DISTANCE_LEAST), v_abs(nearest.d.low)));
    if (want & CYLINT_WANT_POINT)
        certain = m_and(certain, members.point_certain);
    if (want & CYLINT_WANT_NORMAL)
        certain = m_and(certain, members.normal_certain);
    EACH(k, 3) {
        store(to->point[k], i, n, members.point[k]);
        store(to->normal[k], i, n, members.normal[k]);
    }
    return certain;
}

INLINE void load_shapes(shape_lanes *s, const cylint_shape *const at[LANES],
                        int described)
{
    if (described)
        pairs_load_shapes(s, at);
    else
        head_tail_load_shapes(s, at);
}

size_t CYLINT_DISTANCE_LANES(const cylint_shape *shapes, size_t each,
                             const cylint_points *points, size_t from,
                             size_t end, const cylint_closest_columns *answers,
                             size_t *uncertain)
{
    const cylint_shape *at[LANES];
    const cylint_closest_columns to = *answers; /* may stay in registers */
    const double *const xyz[3] = {points->xyz[0], points->xyz[1],
                                  points->xyz[2]};
    const unsigned want = cylint_wanted_of_closest(&to);
    const int described =
        (want & (CYLINT_WANT_POINT | CYLINT_WANT_NORMAL)) != 0;
    shape_lanes s;
    size_t count = 0;
    for (int lane = 0; lane < LANES; lane++)
        at[lane] = shapes;
    load_shapes(&s, at, described);
    for (size_t i = from; i < end; i += LANES) {
        const size_t n = end - i;
        vd x[3];
        unsigned certain = 0;
        if (!each || find_shapes(at, shapes + i, n)) {
            const int kind = at[0]->kind;
            if (each)
                load_shapes(&s, at, described);
            load_points(x, xyz, i, n);
            certain = m_bits(
                !described ? write_lanes(at, kind, &s, x, i, n, &to, want, 0)
                : kind == CYLINT_KIND_SPHERE /* it has no axis */
                    ? write_lanes(at, CYLINT_KIND_SPHERE, &s, x, i, n, &to,
                                  want, 1)
                    : write_lanes(at, kind, &s, x, i, n, &to, want, 1));
        }
        for (size_t lane = 0; lane < LANES && lane < n; lane++) {
            uncertain[count] = i + lane;
            count += !(certain >> lane & 1);
        }
    }
    return count;
}
