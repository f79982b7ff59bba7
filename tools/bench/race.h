/*
 * race.h - contestants answer the same questions in turns
 *
 * Before every turn the questions are shuffled, outside the time taken: a
 * processor of today learns the outcomes of thousands of branches by heart
 * when it meets them twice in one order.
 */
#ifndef BENCH_RACE_H
#define BENCH_RACE_H

#include "contestants.h"
#include "timing.h"

struct runner {
    const struct contestant *contestant;
    struct timing least; /* per question */
};

/* Rounds until each runner had `rounds` turns or the whole race took
 * `seconds`, but at least three. */
void race(struct runner *runners, int n_runners,
          const struct question *questions, int n_questions, int rounds,
          double seconds);

#endif
