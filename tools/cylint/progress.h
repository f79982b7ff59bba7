/*
 * progress.h - how far the work is, on standard error
 *
 * By itself on a terminal once the work has lasted a second; with --progress
 * also elsewhere, a line a second.
 */
#ifndef CYLINT_PROGRESS_H
#define CYLINT_PROGRESS_H

struct progress {
    const char *unit;    /* what is counted, in the plural */
    int in_bytes;        /* how far it is, is told in bytes */
    int shown, terminal; /* shown: at all */
    double start, last;  /* seconds */
    int dirty;           /* a line stands on the terminal */
    unsigned long long count;
};

void progress_start(struct progress *p, int wanted, const char *unit,
                    int in_bytes);

/* So many more are done, which takes the work to `done` of `total` (0: not
 * known). */
void progress_add(struct progress *p, unsigned long long count, double done,
                  double total);

/* Clears the terminal's line, or prints the last figure. */
void progress_end(struct progress *p);

#endif
