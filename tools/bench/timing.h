/*
 * timing.h - time and cycles of this thread
 *
 * Processor time of this thread on one core.  Contestants take turns within
 * one run, so that a slow phase of the machine slows them all; the least time
 * of each counts.
 */
#ifndef BENCH_TIMING_H
#define BENCH_TIMING_H

/* Chooses the kernels that the environment variable KERNELS names, pins this
 * thread to the last core that it may use, and opens the cycle counter if there
 * is one. */
void timing_begin(void);

/* "cycles" if the cycle counter is readable, "ticks" if only a clock of
 * constant rate is, else "none". */
const char *timing_cycle_kind(void);

struct timing {
    double ns, cycles;
};

/* The time now, and the time since `start`; cycles is 0 if not counted. */
struct timing timing_now(void);
struct timing timing_since(struct timing start);

/* Keeps the lesser ns and the lesser cycles. */
void timing_keep_least(struct timing *least, struct timing sample);

#endif
