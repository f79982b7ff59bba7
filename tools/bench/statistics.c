/*
 * statistics.c - totals of errors and wrong verdicts
 */
#include "statistics.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#ifdef HAVE_GSL
#include <gsl/gsl_sort.h>
#include <gsl/gsl_statistics_double.h>
#endif

void sample_add(struct sample *s, double value)
{
    if (s->n == s->capacity) {
        s->capacity = s->capacity ? 2 * s->capacity : 1024;
        s->values = realloc(s->values, (size_t)s->capacity * sizeof *s->values);
        if (!s->values) {
            fputs("bench: out of memory\n", stderr);
            exit(4);
        }
    }
    s->values[s->n++] = value;
}

void sample_clear(struct sample *s)
{
    s->n = 0;
}

void sample_free(struct sample *s)
{
    free(s->values);
    *s = (struct sample){NULL, 0, 0};
}

struct quantiles sample_quantiles(struct sample *s)
{
    struct quantiles q = {NAN, NAN, NAN};
#ifdef HAVE_GSL
    const size_t n = (size_t)s->n;
    if (n == 0)
        return q;
    gsl_sort(s->values, 1, n);
    q.median = gsl_stats_median_from_sorted_data(s->values, 1, n);
    q.most99 = gsl_stats_quantile_from_sorted_data(s->values, 1, n, 0.99);
    q.max = s->values[n - 1];
#else
    (void)s;
#endif
    return q;
}

void record_answer(struct record *r, const struct truth *truth, unsigned want,
                   int only_hit, const cylint_answer *answer)
{
    const enum verdict v = verdict_of(truth, want, only_hit, answer);
    r->answers++;
    r->verdicts[v]++;
    if (v != VERDICT_RIGHT || !(want & CYLINT_WANT_T))
        return;
    for (int i = 0; i < answer->n; i++) {
        double radii, ulps;
        error_of(truth, i, answer->hit[i].t, &radii, &ulps);
        sample_add(&r->radii, radii);
        sample_add(&r->ulps, ulps);
    }
}

double record_percent(const struct record *r, enum verdict verdict)
{
    return r->answers
               ? 100.0 * (double)r->verdicts[verdict] / (double)r->answers
               : NAN;
}

double record_percent_wrong(const struct record *r)
{
    return r->answers
               ? 100.0 * (double)(r->answers - r->verdicts[VERDICT_RIGHT]) /
                     (double)r->answers
               : NAN;
}

void record_clear(struct record *r)
{
    r->answers = 0;
    for (int i = 0; i < VERDICTS; i++)
        r->verdicts[i] = 0;
    sample_clear(&r->radii);
    sample_clear(&r->ulps);
}
