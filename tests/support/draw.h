/*
 * draw.h - random numbers and vectors from the one stream of a program
 *
 * No two arguments, operands or initialisers of one expression draw: C leaves their
 * order to the compiler, and all compilers must draw the same cases.
 */
#ifndef CYLINT_TEST_DRAW_H
#define CYLINT_TEST_DRAW_H

#include <math.h>

#include "random.h"
#include "vectors.h"

static uint64_t stream = 1;

static inline double between(double low, double high)
{
    return low + (high - low) * random_unit(&stream);
}

/* 0 to n - 1 */
static inline int one_of(int n)
{
    return random_int(&stream, n);
}

/* The same for n up to 2^53. */
static inline uint64_t below(uint64_t n)
{
    return random_below(&stream, n);
}

static inline int chance(double p)
{
    return random_unit(&stream) < p;
}

static inline int whole_between(int low, int high)
{
    return low + one_of(high - low + 1);
}

/* 10^x with x uniform in [low, high] */
static inline double power(double low, double high)
{
    return pow(10, between(low, high));
}

/* a small number of either sign, or 0 */
static inline double small(double low, double high)
{
    if (chance(0.1))
        return 0;
    const double sign = chance(0.5) ? 1 : -1;
    return sign * power(low, high);
}

/* Each component from -most to most. */
static inline void whole_point(double v[3], int most)
{
    for (int i = 0; i < 3; i++)
        v[i] = whole_between(-most, most);
}

/* In a cube. */
static inline void random_vector(double v[3], double size)
{
    for (int i = 0; i < 3; i++)
        v[i] = between(-size, size);
}

/* A unit vector. */
static inline void random_direction(double d[3])
{
    do {
        random_vector(d, 1);
    } while (!(length3(d) < 1 && length3(d) > 0.1));
    scale3(d, 1 / length3(d));
}

/* Writes x to any of three components. */
static inline void set_any(double v[3], double x)
{
    v[one_of(3)] = x;
}

#endif
