/*
 * timing.c - the thread's clock, its cycle counter and its core
 */
#define _GNU_SOURCE /* sched_setaffinity, syscall */

#include "timing.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "cylint.h"

#ifdef __linux__
#include <linux/perf_event.h>
#include <sched.h>
#include <sys/syscall.h>
#include <unistd.h>

static int counter = -1;

static void stay_on_one_core(void)
{
    cpu_set_t allowed, one;
    if (sched_getaffinity(0, sizeof allowed, &allowed) != 0)
        return;
    for (size_t i = CPU_SETSIZE; i-- > 0;) {
        if (CPU_ISSET(i, &allowed)) {
            CPU_ZERO(&one);
            CPU_SET(i, &one);
            sched_setaffinity(0, sizeof one, &one);
            return;
        }
    }
}

static void open_counter(void)
{
    struct perf_event_attr what;
    memset(&what, 0, sizeof what);
    what.size = sizeof what;
    what.type = PERF_TYPE_HARDWARE;
    what.config = PERF_COUNT_HW_CPU_CYCLES;
    what.exclude_kernel = 1;
    what.exclude_hv = 1;
    counter = (int)syscall(SYS_perf_event_open, &what, 0, -1, -1, 0);
}

static int read_counter(double *cycles)
{
    uint64_t n;
    if (counter < 0 || read(counter, &n, sizeof n) != (ssize_t)sizeof n)
        return 0;
    *cycles = (double)n;
    return 1;
}

#else

static void stay_on_one_core(void)
{
}

static void open_counter(void)
{
}

static int read_counter(double *cycles)
{
    (void)cycles;
    return 0;
}

#endif

#if defined(__x86_64__) && defined(__GNUC__)
#define HAS_TICKS 1
static double ticks(void)
{
    return (double)__builtin_ia32_rdtsc();
}
#else
#define HAS_TICKS 0
static double ticks(void)
{
    return 0;
}
#endif

void timing_begin(void)
{
    const char *kernels = getenv("KERNELS");
    if (kernels && !cylint_use_kernels(kernels)) {
        fprintf(stderr, "KERNELS=%s: this processor runs no such kernels\n",
                kernels);
        exit(2);
    }
    stay_on_one_core();
    open_counter();
}

const char *timing_cycle_kind(void)
{
    double n;
    return read_counter(&n) ? "cycles" : HAS_TICKS ? "ticks" : "none";
}

struct timing timing_now(void)
{
    struct timespec t;
    struct timing now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    now.ns = 1e9 * (double)t.tv_sec + (double)t.tv_nsec;
    if (!read_counter(&now.cycles))
        now.cycles = ticks();
    return now;
}

struct timing timing_since(struct timing start)
{
    const struct timing now = timing_now();
    return (struct timing){now.ns - start.ns, now.cycles - start.cycles};
}

void timing_keep_least(struct timing *least, struct timing sample)
{
    if (sample.ns < least->ns)
        least->ns = sample.ns;
    if (sample.cycles < least->cycles)
        least->cycles = sample.cycles;
}
