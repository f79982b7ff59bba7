/*
 * stages.c - the time of each stage of the work
 */
#include <stdio.h>

#include "main.h"
#include "progress.h"
#include "stages.h"

void stages_start(struct stages *stages, int reported)
{
    stages->reported = reported;
    stages->last = seconds_of(CLOCK_MONOTONIC);
    stages->last_cpu = seconds_of(CLOCK_PROCESS_CPUTIME_ID);
}

void stages_end(struct stages *stages, const char *what,
                unsigned long long count, const char *unit)
{
    if (stages->reported) {
        const double now = seconds_of(CLOCK_MONOTONIC);
        const double now_cpu = seconds_of(CLOCK_PROCESS_CPUTIME_ID);
        fprintf(stderr, "%s: %s %llu %s: %.2f s, %.2f s of CPU\n", program,
                what, count, unit, now - stages->last,
                now_cpu - stages->last_cpu);
        stages->last = now;
        stages->last_cpu = now_cpu;
    }
}
