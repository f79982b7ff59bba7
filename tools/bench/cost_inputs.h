/*
 * cost_inputs.h - the questions whose price is asked: ordinary work
 *
 * Two kinds of work.  Ordinary lines past ordinary shapes, by a Sobol
 * sequence, with a given share of hits; and what a drawing on an integer
 * grid asks: 20 % of the lines exactly parallel to the axis, 2 % exactly
 * tangent, the rest between grid points.
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

/* Fills n questions and tells how many of them are hits; 0 where the
 * sequences are missing (built without GSL). */
int cost_questions(enum cost_shape shape, enum cost_work work,
                   struct question *q, int n, int *hits);

#endif
