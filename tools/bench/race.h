/*
 * race.h - contestants answer the same questions in turns
 *
 * Before every turn the questions are shuffled, outside the time taken: a
 * processor of today learns the outcomes of thousands of branches by heart
 * when it meets them twice in one order.
 */
#ifndef BENCH_RACE_H
#define BENCH_RACE_H

#include "timing.h"

/* Answers n questions, in the order given or, where the runner has only one
 * way to go through them, in its own. */
typedef void turn_fn(void *context, const int *order, int n);

struct runner {
    turn_fn *turn;
    void *context;
    struct timing least; /* per question */
};

/* Rounds until each runner had `rounds` turns or the whole race took
 * `seconds`, but at least three. */
void race(struct runner *runners, int n_runners, int n_questions, int rounds,
          double seconds);

#endif
