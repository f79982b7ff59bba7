/*
 * exact_sum.h - the sum of doubles, exactly: an integer times 2^-1074
 *
 * Integers, so that neither the rounding mode nor flushed subnormals matter
 * [Kulisch, Computer Arithmetic and Validity, 2008].
 */
#ifndef CYLINT_EXACT_SUM_H
#define CYLINT_EXACT_SUM_H

#include "exact.h"

/* Of 2098 bits and the carries of 2^32 doubles and more. */
enum { CYLINT_SUM_LIMBS = 34 };

/* In two's complement. */
typedef struct cylint_exact_sum {
    uint64_t limb[CYLINT_SUM_LIMBS];
} cylint_exact_sum;

/* Adds a finite double. */
static inline void cylint_sum_add(cylint_exact_sum *sum, double x)
{
    const uint64_t bits = cylint_bits(x), below = (UINT64_C(1) << 52) - 1;
    const uint64_t sign = -(bits >> 63); /* all bits of a negative number */
    const unsigned e = (unsigned)(bits >> 52 & 2047);
    const uint64_t m = e > 0 ? (bits & below) | (below + 1) : bits & below;
    const unsigned at = e > 0 ? e - 1 : 0, shift = at % 64;
    uint64_t part[2] = {m << shift, shift > 0 ? m >> (64 - shift) : 0};
    uint64_t carry = sign & 1;
    for (unsigned i = at / 64, j = 0; i < CYLINT_SUM_LIMBS; i++, j++) {
        const uint64_t addend = (j < 2 ? part[j] : 0) ^ sign;
        const uint64_t half = sum->limb[i] + carry;
        sum->limb[i] = half + addend;
        carry = (uint64_t)(half < carry) + (uint64_t)(sum->limb[i] < addend);
        if (j >= 1 && carry == (sign & 1))
            return; /* the limbs above do not change */
    }
}

/* The double nearest to a sum that is not negative; ties to even. */
static inline double cylint_sum_rounded(const cylint_exact_sum *sum)
{
    int first = 0, end = CYLINT_SUM_LIMBS;
    while (end > 0 && sum->limb[end - 1] == 0)
        end--;
    while (first < end && sum->limb[first] == 0)
        first++;
    const exact all = {sum->limb + first, first, (short)(end - first), end > 0};
    return cylint_exact_nearest(all, -1074);
}

#endif
