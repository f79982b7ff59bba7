/*
 * embree_race.h - scenes that take turns in tracing the same rays
 */
#ifndef BENCH_EMBREE_RACE_H
#define BENCH_EMBREE_RACE_H

#include "embree_rivals.h"
#include "timing.h"

struct contestant {
    const char *name;
    struct rival rival;
    struct timing least;
    long hits;
    double t; /* sum of all hits */
};

/* Traces all rays, one by one. */
typedef void query(struct contestant *c, const struct rays *rays);
query query_nearest, query_any;

/* Runs rounds for `seconds`, at least three; in a round each rival has a
 * turn. */
void compete(struct contestant *c, int n, query *trace, const struct rays *rays,
             double seconds);

#endif
