/*
 * environment.h - assumptions of the proofs: compiler, processor and thread
 *
 * Include it before any arithmetic: clang's pragmas apply to what follows.
 */
#ifndef CYLINT_ENVIRONMENT_H
#define CYLINT_ENVIRONMENT_H

#include <float.h>
#include <stdint.h>

/* cylint_selftest() detects at run time what no macro states. */
#if defined(__FAST_MATH__) ||                                        \
    (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__) ||       \
    defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__) || \
    defined(__NO_SIGNED_ZEROS__) || defined(_M_FP_FAST)
#error "libcylint is exact arithmetic: do not compile it with -ffast-math"
#endif
#if FLT_RADIX != 2 || DBL_MANT_DIG != 53 || DBL_MAX_EXP != 1024 || \
    DBL_MIN_EXP != -1021
#error "libcylint needs doubles of IEEE 754, binary64"
#endif
/* 1 and 16 widen only float and _Float16.  2 means x87 registers. */
#if FLT_EVAL_METHOD != 0 && FLT_EVAL_METHOD != 1 && FLT_EVAL_METHOD != 16
#error "libcylint needs doubles without excess precision (-msse2 -mfpmath=sse)"
#endif
#ifndef UINT64_MAX
#error "libcylint needs uint64_t"
#endif
#ifdef __clang__ /* for all that follows; gcc has only -ffp-contract=off */
#pragma STDC FP_CONTRACT OFF
#pragma clang fp reassociate(off)
#endif

/* Whether this thread rounds to nearest now.  Otherwise the sums of
 * double_double.h have errors, and no rounding can be certified.  Only in rounding
 * to nearest are 1 plus and 1 minus a tiny number both 1. */
static inline int cylint_rounds_to_nearest(void)
{
    static volatile const double tiny = 0x1p-60; /* read at run time */
    const double x = tiny;
    return !(1 + x > 1 - x);
}

/* Whether this thread reads subnormal numbers as 0, or writes 0 for them. */
static inline int cylint_flushes_subnormals(void)
{
    static volatile const double least = DBL_MIN;
    return least * 0.5 * 2 == 0;
}

#endif
