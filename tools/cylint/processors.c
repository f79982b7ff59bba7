/*
 * processors.c - how many processors this process may use
 *
 * On Linux this is the number of processors to which the process is bound
 * (taskset, cpusets).  On other systems, and if they are more than cpu_set_t
 * holds, it is the number of processors on line.
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
    if (sched_getaffinity(0, sizeof set, &set) == 0)
        return CPU_COUNT(&set);
#endif
    return 0;
}

int processors(void)
{
    long n = bound();
    if (n == 0)
        n = sysconf(_SC_NPROCESSORS_ONLN);
    return n > 1 ? (int)n : 1;
}
