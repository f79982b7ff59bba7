/*
 * compiler.h - unrolled loops, inlining, prefetching, the larger of two doubles,
 * square roots, the bits of a mask
 */
#ifndef CYLINT_COMPILER_H
#define CYLINT_COMPILER_H

#include <math.h>
#include <stdint.h>

/* A loop that GCC unrolls before it allocates registers.  Otherwise it keeps
 * small arrays in memory.  CYLINT_LOOPS: files in which this does not pay. */
#if defined(__GNUC__) && !defined(__clang__) && !defined(CYLINT_LOOPS)
#define EACH(i, n) _Pragma("GCC unroll 4") for (int i = 0; i < (n); i++)
#else
#define EACH(i, n) for (int i = 0; i < (n); i++)
#endif

/* A function that is rarely called.  It is not inlined, so that its callers
 * save fewer registers. */
#ifdef __GNUC__
#define ASIDE static __attribute__((noinline))
#else
#define ASIDE static
#endif

/* A variable of the library that no other library reads.  The compiler then
 * reads it without a table of addresses. */
#if defined(__GNUC__) && defined(__ELF__)
#define CYLINT_HIDDEN __attribute__((visibility("hidden")))
#else
#define CYLINT_HIDDEN
#endif

/* Loads the cache line of an address before it is needed.  A macro: GCC
 * removes calls of a function that only prefetches, as if it had no effect. */
#ifdef __GNUC__
#define CYLINT_PREFETCH(address) __builtin_prefetch(address)
#else
#define CYLINT_PREFETCH(address) ((void)(address))
#endif

/* The larger of two, neither of them NaN.  fmax() would be a function call. */
static inline double cylint_larger(double x, double y)
{
    return x > y ? x : y;
}

static inline double cylint_smaller(double x, double y)
{
    return x < y ? x : y;
}

/* NaN of a negative number and of NaN, for which sqrt() of some C libraries sets
 * errno. */
static inline double cylint_sqrt(double x)
{
    return x >= 0 ? sqrt(x) : NAN;
}

/* The number of the lowest bit that is 1.  bits is not 0. */
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

/* For the number k, below 31, of each bit of the mask that is 1. */
#define EACH_BIT(k, mask)                                    \
    for (int k##_of = (int)(mask), k;                        \
         k##_of && (k = cylint_lowest((unsigned)k##_of), 1); \
         k##_of &= k##_of - 1)

/* A function that is always inlined, so that the compiler specialises it for
 * constant arguments.  Without optimisation it is compiled once, so that
 * `make coverage` counts it. */
#if defined(__GNUC__) && defined(__OPTIMIZE__)
#define CYLINT_INLINE static inline __attribute__((always_inline))
#else
#define CYLINT_INLINE static inline
#endif

#endif
