/*
 * progress.h - clocks, processors, and the progress of the work
 *
 * The progress goes to standard error.  On a terminal it appears when the work has lasted a second.  With --progress
 * it is also written elsewhere, one line a second.
 */
#ifndef CYLINT_PROGRESS_H
#define CYLINT_PROGRESS_H

#include <time.h>

/* Seconds of a clock. */
double seconds_of(clockid_t clock);

/* The number of processors that this process may use; at least 1. */
int processors(void);

struct progress {
    const char *unit;    /* what is counted, in the plural */
    int in_bytes;        /* `done` and `total` are bytes */
    int shown, terminal; /* shown: whether anything is written */
    double start, last;  /* seconds */
    int dirty;           /* the terminal has a progress line */
    unsigned long long count;
};

void progress_start(struct progress *p, int wanted, const char *unit,
                    int in_bytes);

/* Adds `count` to the number done.  The work is at `done` of `total`; 0: the
 * total is unknown. */
void progress_add(struct progress *p, unsigned long long count, double done,
                  double total);

/* Clears the terminal's line, or prints the last figure. */
void progress_end(struct progress *p);

#endif
