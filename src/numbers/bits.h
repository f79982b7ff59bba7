/*
 * bits.h - doubles by their bits: exponent, sign, order, exact scaling and
 * differences, right in whatever floating-point environment
 */
#ifndef CYLINT_BITS_H
#define CYLINT_BITS_H

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "compiler.h"
#include "double_double.h"

/* 2^e for -1022 <= e <= 1023. */
static inline double cylint_power_of_two(int e)
{
    const uint64_t bits = (uint64_t)(e + 1023) << 52;
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* The e of 2^e <= |x| < 2^(e+1) for normal x; below -1022 otherwise. */
static inline int cylint_exponent(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return (int)(bits >> 52 & 0x7ff) - 1023;
}

/* By the bits: right for subnormals even where they are taken for zero. */
static inline int cylint_sign(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits << 1 == 0 ? 0 : bits >> 63 ? -1 : 1;
}

/* Sums with such a number may have a part that a processor flushes. */
static inline int cylint_too_small(double x)
{
    const uint64_t least = (uint64_t)(1023 - 900) << 53; /* without the sign */
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return (bits << 1) - 1 < least - 1; /* a zero wraps round */
}

/* x < y by the bits, likewise; neither is a NaN. */
static inline int cylint_less(double x, double y)
{
    int64_t a, b;
    memcpy(&a, &x, sizeof a);
    memcpy(&b, &y, sizeof b);
    a = a < 0 ? INT64_MIN - a : a; /* ascending with x, both zeros 0 */
    b = b < 0 ? INT64_MIN - b : b;
    return a < b;
}

static inline double cylint_largest(const double x[3])
{
    return cylint_larger(cylint_larger(fabs(x[0]), fabs(x[1])), fabs(x[2]));
}

/* x - y as a pair, exactly unless it overflows (then lo = 0), in whatever
 * floating-point environment. */
pair cylint_wild_difference(double x, double y);
static inline pair cylint_difference(double x, double y)
{
    const pair d = two_diff(x, y);
    const int tame = !cylint_too_small(x) && !cylint_too_small(y) &&
                     fabs(d.hi) <= DBL_MAX && cylint_rounds_to_nearest();
    return tame ? d : cylint_wild_difference(x, y);
}

/* x 2^e, rounded at most once. */
double cylint_scaled(double x, int e);

/* to - from, scaled by 2^e, as pairs; e brings both below overflow. */
void cylint_scaled_difference(double hi[3], double lo[3], const double to[3],
                              const double from[3], int e);

#endif
