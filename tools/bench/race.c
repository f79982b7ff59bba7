/*
 * race.c - timed turns of all contestants, round by round
 */
#include "race.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

enum { LEAST_ROUNDS = 3 };

/* xorshift64* [Marsaglia 2003; Vigna 2016]. */
static uint64_t next_random(void)
{
    static uint64_t x = UINT64_C(0x9e3779b97f4a7c15);
    x ^= x >> 12;
    x ^= x << 25;
    x ^= x >> 27;
    return x * UINT64_C(0x2545f4914f6cdd1d);
}

static void shuffle(int *order, int n)
{
    for (int i = n - 1; i > 0; i--) {
        const int j = (int)(next_random() >> 33) % (i + 1);
        const int kept = order[i];
        order[i] = order[j];
        order[j] = kept;
    }
}

static struct timing time_turn(const struct runner *r, const int *order, int n)
{
    const struct timing start = timing_now();
    r->turn(r->context, order, n);
    struct timing took = timing_since(start);
    took.ns /= n;
    took.cycles /= n;
    return took;
}

void race(struct runner *runners, int n_runners, int n_questions, int rounds,
          double seconds)
{
    int *order = malloc((size_t)n_questions * sizeof *order);
    if (!order) {
        fputs("bench: out of memory\n", stderr);
        exit(4);
    }
    for (int i = 0; i < n_questions; i++)
        order[i] = i;
    for (int i = 0; i < n_runners; i++)
        runners[i].least = (struct timing){HUGE_VAL, HUGE_VAL};
    const struct timing start = timing_now();
    for (int round = 0; round < rounds; round++) {
        if (round >= LEAST_ROUNDS && timing_since(start).ns > 1e9 * seconds)
            break;
        for (int i = 0; i < n_runners; i++) {
            shuffle(order, n_questions);
            timing_keep_least(&runners[i].least,
                              time_turn(&runners[i], order, n_questions));
        }
    }
    free(order);
}
