/*
 * statistics.h - totals of errors and wrong verdicts
 */
#ifndef BENCH_STATISTICS_H
#define BENCH_STATISTICS_H

#include "truth.h"

struct sample {
    double *values;
    int n, capacity;
};

void sample_add(struct sample *s, double value);
void sample_clear(struct sample *s); /* keeps its capacity */
void sample_free(struct sample *s);

struct quantiles {
    double median, most99, max; /* NaN if the sample is empty */
};

/* Sorts the sample. */
struct quantiles sample_quantiles(struct sample *s);

/* The verdicts and errors of one contestant's answers. */
struct record {
    long answers, verdicts[VERDICTS];
    struct sample radii, ulps;
};

void record_answer(struct record *r, const struct truth *truth, unsigned want,
                   int only_hit, const cylint_answer *answer);
double record_percent(const struct record *r, enum verdict verdict);
double record_percent_wrong(const struct record *r);
void record_clear(struct record *r);

#endif
