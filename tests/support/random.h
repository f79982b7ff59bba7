/*
 * random.h - random numbers for tests: SplitMix64 [Steele, Lea, Flood 2014]
 *
 * A stream is a uint64_t that starts at any seed.
 */
#ifndef CYLINT_TEST_RANDOM_H
#define CYLINT_TEST_RANDOM_H

#include <stdint.h>

/* 64 random bits. */
static inline uint64_t random_bits(uint64_t *stream)
{
    uint64_t x = *stream += UINT64_C(0x9e3779b97f4a7c15);
    x = (x ^ x >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
    x = (x ^ x >> 27) * UINT64_C(0x94d049bb133111eb);
    return x ^ x >> 31;
}

/* A whole number in [0, n) for n up to 2^53. */
static inline uint64_t random_below(uint64_t *stream, uint64_t n)
{
    return (random_bits(stream) >> 11) % n;
}

/* The same as an int, of other bits: both functions return other numbers. */
static inline int random_int(uint64_t *stream, int n)
{
    return (int)(random_bits(stream) >> 33) % n;
}

/* A double in [0, 1), a multiple of 2^-53. */
static inline double random_unit(uint64_t *stream)
{
    return (double)(random_bits(stream) >> 11) * 0x1p-53;
}

/* A double in [1, 2) with any mantissa. */
static inline double random_mantissa(uint64_t *stream)
{
    return 1 + (double)(random_bits(stream) >> 12) * 0x1p-52;
}

#endif
