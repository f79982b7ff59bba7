/*
 * cost_inputs.h - the questions of cost.c: two kinds of ordinary work
 *
 * Lines from a Sobol sequence and random shapes, with a given share of hits;
 * and a drawing on an integer grid: 20 % of the lines are exactly parallel to
 * the axis, 2 % are exactly tangent, the rest pass through two grid points.
 */
#ifndef BENCH_COST_INPUTS_H
#define BENCH_COST_INPUTS_H

#include "contestants.h"

enum cost_shape {
    COST_CYLINDER_INFINITE,
    COST_CYLINDER_CAPPED,
    COST_CONE_INFINITE,
    COST_CONE_CAPPED,
    COST_SHAPES
};

enum cost_work {
    COST_HITS_71,
    COST_HITS_5,
    COST_MISSES,
    COST_GRID,
    COST_WORKS
};

const char *cost_shape_name(enum cost_shape shape);
const char *cost_work_name(enum cost_work work);

/* Writes n questions and the number of hits among them.  Returns 0 if built
 * without GSL, which has the sequence. */
int cost_questions(enum cost_shape shape, enum cost_work work,
                   struct question *q, int n, int *hits);

#endif
