/*
 * overlap.h - where the overlap of a line and a shape begins and ends, from exact
 * signs
 */
#ifndef CYLINT_OVERLAP_H
#define CYLINT_OVERLAP_H

#include "roots.h"

/* An end of the overlap. */
typedef struct {
    cylint_root root;
    int part, side, apex;
} cylint_stop;

/* The relation, and the ends that the overlap has, ascending. */
typedef struct {
    int relation, n;
    cylint_stop at[2];
} cylint_overlap;

/* The overlap with a shape of any kind but the round ones, and with a round one. */
cylint_overlap cylint_overlap_of(cylint_query *q);
cylint_overlap cylint_round_overlap(cylint_query *q);

/* Where the origin of the line lies: 1 inside a round kind, 0 on its boundary, -1
 * outside. */
int cylint_round_contains(cylint_query *q);

/* The overlap with Q <= 0, where that is one interval between its roots: a chord, a
 * point or nothing. */
cylint_overlap cylint_chord_overlap(cylint_query *q, int relation, int apex);

int cylint_radius_is_zero(const cylint_query *q, int end);

static inline cylint_overlap cylint_no_overlap(void)
{
    cylint_overlap v = {
        CYLINT_RELATION_MISS, 0, {{ROOT_APEX, 0, 0, 0}, {ROOT_APEX, 0, 0, 0}}};
    return v;
}

static inline cylint_overlap cylint_one_stop(int relation, cylint_root root,
                                             int side, int apex)
{
    cylint_overlap v = cylint_no_overlap();
    v.relation = relation;
    v.n = 1;
    v.at[0] = (cylint_stop){root, CYLINT_PART_LATERAL, side, apex};
    return v;
}

static inline cylint_overlap cylint_two_stops(int relation, cylint_stop first,
                                              cylint_stop last)
{
    cylint_overlap v = cylint_no_overlap();
    v.relation = relation;
    v.n = 2;
    v.at[0] = first;
    v.at[1] = last;
    v.at[0].side = CYLINT_SIDE_ENTERING;
    v.at[1].side = CYLINT_SIDE_LEAVING;
    return v;
}

static inline cylint_overlap cylint_touch_at(cylint_stop s)
{
    return cylint_one_stop(CYLINT_RELATION_TOUCH, s.root, CYLINT_SIDE_BOTH,
                           s.apex);
}

static inline cylint_stop cylint_lateral_stop(cylint_root root)
{
    return (cylint_stop){root, CYLINT_PART_LATERAL, 0, 0};
}

#endif
