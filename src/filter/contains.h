/*
 * contains.h - on which side of a solid's surface one point lies
 *
 * Narrow lanes (frame.h).  Signs in doubles, then in pairs, then exact ones.
 */
#ifndef CYLINT_CONTAINS_H
#define CYLINT_CONTAINS_H

#include "refine.h"

/* 1 inside, -1 outside, 0 neither for certain. */
INLINE int side_of_place(place where)
{
    return (int)(m_bits(where.inside) & 1) - (int)(m_bits(where.before) & 1);
}

INLINE int contains_in_doubles(const cylint_shape *shape, const double point[3],
                               int solid)
{
    local_line l = no_line;
    load_place(&l, point, shape, solid);
    return side_of_place(place_in_doubles(&l, solid));
}

/* The signs that pairs leave uncertain, of a point near the surface, are computed
 * exactly.  A point with a coordinate that is not finite is undecided. */
INLINE int contains_exactly(point_signs *at, const cylint_question *q,
                            int solid)
{
    const int ball = cylint_solid_is_ball(solid);
    if (!has_signs_on_line(solid) || cylint_solid_is_nappe(solid) ||
        !cylint_is_finite(q->line->o))
        return CYLINT_SIDE_UNDECIDED;
    settle(ball ? &at->ball[0] : &at->side, 1, 0, q, CYLINT_LATERAL_SURFACE);
    if (cylint_solid_is_bounded(solid) && !ball)
        EACH(i, 2)
            settle(&at->above[i], 1, 0, q, i);
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
    first_line first;
    if (!cylint_rounds_to_nearest())
        return CYLINT_SIDE_UNDECIDED;
    load_point(&first, point, shape, solid);
    q.Q = v_first(first.Q);
    set_sizes(&l, q.shape, q.line, q.Q, q.D, solid);
    load_any_pairs(&in, shape, &line, 0);
    point_in_pairs(&at, &l, &in, v_set(0), shape, solid);
    const int side = side_of_place(place_of_point(&at, solid));
    return side != 0 ? side : contains_exactly(&at, &q, solid);
}

#endif
