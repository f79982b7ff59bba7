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

cylint_overlap cylint_overlap_of(cylint_query *q);

/* Where the origin of the line lies: 1 inside a round kind, 0 on its boundary, -1
 * outside. */
int cylint_round_contains(cylint_query *q);

#endif
