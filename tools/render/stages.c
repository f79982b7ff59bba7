/*
 * stages.c - the time of each stage of the work
 */
#include <stdio.h>
#include <time.h>

#include "main.h"
#include "stages.h"

static double seconds(clockid_t clock)
{
    struct timespec now;
    clock_gettime(clock, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

void stages_start(struct stages *stages, int reported)
{
    stages->reported = reported;
    stages->last = seconds(CLOCK_MONOTONIC);
    stages->last_cpu = seconds(CLOCK_PROCESS_CPUTIME_ID);
}

void stages_end(struct stages *stages, const char *what,
                unsigned long long count, const char *unit)
{
    if (stages->reported) {
        const double now = seconds(CLOCK_MONOTONIC);
        const double now_cpu = seconds(CLOCK_PROCESS_CPUTIME_ID);
        fprintf(stderr, "%s: %s %llu %s: %.2f s, %.2f s of CPU\n", program,
                what, count, unit, now - stages->last,
                now_cpu - stages->last_cpu);
        stages->last = now;
        stages->last_cpu = now_cpu;
    }
}
