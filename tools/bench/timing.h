/*
 * timing.h - how long something takes
 *
 * The process's own time (the kernel's account of this thread), on one core.
 * Contestants take turns within one run, so that whatever slows the machine
 * slows them all; of each the least time counts.
 */
#ifndef BENCH_TIMING_H
#define BENCH_TIMING_H

/* Keeps this thread on one core, the last it may use, and opens a counter
 * of cycles if there is one. */
void timing_begin(void);

/* "cycles" where the processor counts them for us, "ticks" where there is
 * only a clock of constant rate, "none". */
const char *timing_cycle_kind(void);

struct timing {
    double ns, cycles;
};

/* The time between the two; cycles is 0 where nothing counts them. */
struct timing timing_now(void);
struct timing timing_since(struct timing start);

/* The lesser of each. */
void timing_keep_least(struct timing *least, struct timing sample);

#endif
