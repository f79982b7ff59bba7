/*
 * environment.h - sets a thread's rounding mode and treatment of subnormals, and
 * the build of the kernels
 */
#ifndef CYLINT_TEST_ENVIRONMENT_H
#define CYLINT_TEST_ENVIRONMENT_H

#include <errno.h>
#include <fenv.h>
#include <stdint.h>

#include "check.h"
#include "cylint.h"
#ifdef __SSE2__
#include <xmmintrin.h>
#endif

enum { FLUSH = 1, ZERO = 2 };

struct environment {
    int rounding; /* fesetround's */
    int tiny;     /* subnormals: FLUSH results, ZERO operands, or both */
    int number;   /* of environment_of() */
    int bad;      /* failed checks before a loop reached it */
};

#if defined(__SSE2__)
enum { MXCSR_ZERO = 1 << 6, MXCSR_FLUSH = 1 << 15 };

static inline void treat_subnormals(int how)
{
    unsigned control = _mm_getcsr() & ~(unsigned)(MXCSR_ZERO | MXCSR_FLUSH);
    if (how & FLUSH)
        control |= MXCSR_FLUSH;
    if (how & ZERO)
        control |= MXCSR_ZERO;
    _mm_setcsr(control);
}

static inline int can_treat_subnormals(int how)
{
    (void)how;
    return 1;
}
#elif defined(__aarch64__)
/* One bit governs operands and results. */
static inline void treat_subnormals(int how)
{
    uint64_t control;
    __asm__ volatile("mrs %0, fpcr" : "=r"(control));
    control = how ? control | 1 << 24 : control & ~(uint64_t)(1 << 24);
    __asm__ volatile("msr fpcr, %0" : : "r"(control));
}

static inline int can_treat_subnormals(int how)
{
    return how == (FLUSH | ZERO);
}
#else
static inline void treat_subnormals(int how)
{
    (void)how;
}

static inline int can_treat_subnormals(int how)
{
    return how == 0;
}
#endif

/* Uses build i of the kernels.  Returns 0 if there is none; the usual one is then
 * in use again. */
static inline int use_kernels(int i)
{
    const char *name = cylint_kernels_name(i);
    CHECK(cylint_use_kernels(name));
    return name != NULL;
}

/* Uses one of the builds. */
static inline void use_some_kernels(uint64_t number)
{
    int n = 0;
    while (cylint_kernels_name(n))
        n++;
    use_kernels((int)(number % (uint64_t)n));
}

/* A loop over all builds of the kernels. */
#define EACH_KERNELS(i) for (int i = 0; use_kernels(i); i++)

enum { ROUNDINGS = 4, ENVIRONMENTS = ROUNDINGS * 4 };

static const int roundings[ROUNDINGS] = {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD,
                                         FE_TOWARDZERO};

/* Number 0 is the default one. */
static inline struct environment environment_of(int number)
{
    return (struct environment){roundings[number / 4 % ROUNDINGS], number % 4,
                                number, 0};
}

/* The rounding mode, and the treatment of subnormals by the self-test. */
static struct {
    int rounding, found;
} environment_as_set;

static inline void environment_set(struct environment e)
{
    fesetround(e.rounding);
    treat_subnormals(e.tiny);
    environment_as_set.rounding = e.rounding;
    environment_as_set.found = cylint_selftest();
    errno = 0;
}

/* Sets the default one.  What was called since environment_set() must not have
 * changed it, nor errno. */
static inline void environment_reset(void)
{
    CHECK(fegetround() == environment_as_set.rounding &&
          cylint_selftest() == environment_as_set.found && errno == 0);
    environment_set(environment_of(0));
}

/* Reports the environment, if a check failed in it, and goes on to the next one
 * that this processor has.  Returns 0 after the last. */
static inline int next_environment(struct environment *e)
{
    if (e->number >= 0 && check_bad > e->bad)
        REPORT("rounding %d, flushes %d, takes for zero %d", e->number / 4,
               (e->tiny & FLUSH) != 0, (e->tiny & ZERO) != 0);
    do
        *e = environment_of(e->number + 1);
    while (!can_treat_subnormals(e->tiny));
    e->bad = check_bad;
    return e->number < ENVIRONMENTS;
}

/* A loop over all environments that this processor has; `there` is one of them. */
#define EACH_ENVIRONMENT(there) \
    for (struct environment there = {.number = -1}; next_environment(&there);)

#endif
