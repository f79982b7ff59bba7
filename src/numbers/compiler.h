/*
 * compiler.h - loops of few rounds: over small arrays, over the ones of a mask;
 * the larger of two; and what is, and what is not, to be in line
 */
#ifndef CYLINT_EACH_H
#define CYLINT_EACH_H

#include <stdint.h>

/* Written out by the compiler before it decides what is kept in registers:
 * GCC would leave the arrays in memory. */
#if defined(__GNUC__) && !defined(__clang__)
#define EACH(i, n) _Pragma("GCC unroll 4") for (int i = 0; i < (n); i++)
#else
#define EACH(i, n) for (int i = 0; i < (n); i++)
#endif

/* A function rarely called, whose registers its callers need not save. */
#ifdef __GNUC__
#define ASIDE static __attribute__((noinline))
#else
#define ASIDE static
#endif

/* A function of a header that is not to be copied into its callers. */
#ifdef __GNUC__
#define CYLINT_APART static __attribute__((noinline, unused))
#else
#define CYLINT_APART static inline
#endif

/* fmax() and fmin() without NaN: those are calls. */
static inline double cylint_larger(double x, double y)
{
    return x > y ? x : y;
}

static inline double cylint_smaller(double x, double y)
{
    return x < y ? x : y;
}

/* The number of the lowest 1, of which there is one. */
static inline int cylint_lowest(uint64_t bits)
{
#ifdef __GNUC__
    return __builtin_ctzll(bits);
#else
    int k = 0;
    while (!(bits >> k & 1))
        k++;
    return k;
#endif
}

/* Part of whatever calls it, however large that is: constant arguments are to
 * make a piece of code of their own; without optimisation, one for all, that
 * `make coverage` can count. */
#if defined(__GNUC__) && defined(__OPTIMIZE__)
#define CYLINT_INLINE static inline __attribute__((always_inline))
#else
#define CYLINT_INLINE static inline
#endif

#endif
