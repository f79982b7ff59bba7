/*
 * processors.c - how many processors this process may use
 *
 * Linux tells which ones a process is bound to (taskset, cpusets); elsewhere,
 * or where they are more than its set holds, all that are on line count.
 */
#if defined(__linux__)
#define _GNU_SOURCE
#include <sched.h>
#endif
#include <unistd.h>

#include "processors.h"

static long bound(void)
{
#if defined(__linux__) && defined(CPU_COUNT)
    cpu_set_t set;
    if (sched_getaffinity(0, sizeof set, &set) == 0) {
        return CPU_COUNT(&set);
    }
#endif
    return 0;
}

int processors(void)
{
    long n = bound();
    if (n == 0) {
        n = sysconf(_SC_NPROCESSORS_ONLN);
    }
    return n > 1 ? (int)n : 1;
}
