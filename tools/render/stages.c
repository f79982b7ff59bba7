/*
 * stages.c - what took how long
 */
#include <stdio.h>
#include <time.h>

#include "main.h"
#include "stages.h"

static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

void stages_start(struct stages *stages, int told)
{
    stages->told = told;
    stages->last = told ? seconds() : 0;
}

void stages_end(struct stages *stages, const char *what,
                unsigned long long count, const char *unit)
{
    if (stages->told) {
        const double now = seconds();
        fprintf(stderr, "%s: %s %llu %s: %.2f s\n", program, what, count,
                unit, now - stages->last);
        stages->last = now;
    }
}
