/*
 * race.h - contestants answer the same questions in turns
 *
 * The questions are shuffled before every turn; that is not timed.  A branch
 * predictor can memorise thousands of outcomes if their order repeats.
 */
#ifndef BENCH_RACE_H
#define BENCH_RACE_H

#include "timing.h"

/* Answers n questions in the given order, or in its own if it has only one. */
typedef void turn_fn(void *context, const int *order, int n);

struct runner {
    turn_fn *turn;
    void *context;
    struct timing least; /* per question */
};

/* Runs rounds until each runner had `rounds` turns or the race took `seconds`;
 * at least three rounds. */
void race(struct runner *runners, int n_runners, int n_questions, int rounds,
          double seconds);

#endif
