/*
 * progress.h - how far the work is, on standard error
 *
 * By itself on a terminal once the work has lasted a second; with --progress
 * also elsewhere, a line a second.
 */
#ifndef CYLINT_PROGRESS_H
#define CYLINT_PROGRESS_H

struct progress {
    int shown, terminal; /* shown: at all */
    double start, last;  /* seconds */
    int dirty;           /* a line stands on the terminal */
    unsigned long long records;
};

void progress_start(struct progress *p, int wanted);

/* Some more records were answered; `bytes` of `total` (0: not known) were
 * read so far. */
void progress_add(struct progress *p, unsigned long long records,
                  double bytes, double total);

/* Clears the terminal's line, or prints the last figure. */
void progress_end(struct progress *p);

#endif
