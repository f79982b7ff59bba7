/*
 * batch_parts.h - a row of batch.c's output, and the parts in other files
 */
#ifndef BENCH_BATCH_PARTS_H
#define BENCH_BATCH_PARTS_H

#include <math.h>

#include "batch_turns.h"

/*
 * hits, reached and undecided are percentages of the tests.  reached: the line
 * meets the shape's bounding ball.  undecided: the kernels leave the test to
 * cylint_intersect().  ns, plain and single are ns a test: of the batch, of
 * the plain quadratic one by one, and of cylint_intersect() one by one.  NaN:
 * not measured.
 */
struct row {
    const char *part, *kernels, *shapes, *arrangement, *query;
    size_t n;
    double hits, reached, undecided, ns, plain, single;
};

extern const struct row no_row;
void print_row(const struct row *r);

/* batch_cases.c; `seconds` is the time of each race. */
void measure_families(double seconds);
void measure_drawings(double seconds);

#endif
