/*
 * batch_parts.h - the rows of many_questions.c, and those parts with files of their own
 */
#ifndef BENCH_BATCH_PARTS_H
#define BENCH_BATCH_PARTS_H

#include <math.h>

#include "batch_turns.h"

/* hits, reached, undecided: per cent of the tests; reached: whose line meets
 * the lateral surface, were it infinite; undecided: those that the kernels
 * leave to cylint_intersect().  ns a test: of the batch, of the plain
 * quadratic and of cylint_intersect(), one by one.  NaN: not measured. */
struct row {
    const char *part, *kernels, *shapes, *arrangement, *asked;
    size_t n;
    double hits, reached, undecided, ns, plain, single;
};

extern const struct row no_row;
void print_row(const struct row *r);

/* batch_cases.c: seconds each. */
void measure_families(double seconds);
void measure_drawings(double seconds);

#endif
