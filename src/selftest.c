/*
 * selftest.c - tests the arithmetic of this build, on this processor, in the
 * floating-point environment of the calling thread
 *
 * Every operand is read from a volatile, so that the compiler does not compute
 * the result itself.  The expressions are plain C, so that the compiler
 * translates them like the rest of the library.
 */
#include "numbers/bits.h"

#include "cylint.h"

/* Returns x; the compiler cannot compute with its value. */
static double unfolded(double x)
{
    volatile double v = x;
    return v;
}

/* Tests for IEEE 754 binary64 in the byte order of uint64_t. */
/* untaken: in broken builds only, which tests/numbers/test_guards.sh makes */
static int format_differs(void)
{
    return sizeof(double) != sizeof(uint64_t) ||
           cylint_bits(unfolded(-0x1.23456789abcdep-1)) !=
               UINT64_C(0xbfe23456789abcde) ||
           cylint_bits(unfolded(0x1p-1074)) != 1;
}

/* (1 + e)^2 = 1 + 2 e + e^2.  One unit in its last place is 4 e^2, so the
 * rounded product differs from 1 + 2 e by 0 or by at least 4 e^2.  A
 * difference of e^2 shows that the product was not rounded.  Each product has one
 * use: clang contracts no others. */
/* untaken: in broken builds only, which tests/numbers/test_guards.sh makes */
static int contracts(void)
{
    const double e = 0x1p-27, f = 1 + e, c = 1 + 2 * e;
    const double added = unfolded(f) * unfolded(f) + unfolded(-c);
    const double subtracted = unfolded(f) * unfolded(f) - unfolded(c);
    const double reversed = unfolded(c) - unfolded(f) * unfolded(f);
    return added == e * e || subtracted == e * e || reversed == -e * e;
}

/* 1 + 2^-60 is not a double.  The difference to 1 is 2^-60 only with excess
 * precision, or if the compiler cancels the ones. */
/* untaken: in broken builds only, which tests/numbers/test_guards.sh makes */
static int keeps_too_much(void)
{
    const double one = unfolded(1), tiny = unfolded(0x1p-60);
    return (one + tiny) - one == tiny || one + (tiny - one) == tiny;
}

/* 1 + 2^-60 and 1 - 2^-60 round to 1, and ties round to even. */
/* untaken: in broken builds only, which tests/numbers/test_guards.sh makes */
static int rounds_to_nearest(void)
{
    const double one = unfolded(1), tiny = unfolded(0x1p-60);
    const double half = unfolded(0x1p-53), odd = unfolded(1 + 0x1p-52);
    return one + tiny == one && one - tiny == one && one + half == one &&
           odd + half == 1 + 0x1p-51;
}

/* Called in rounding to nearest.  Reciprocal estimates fail this test, and products
 * of one reciprocal in place of quotients with one divisor. */
/* untaken: in broken builds only, which tests/numbers/test_guards.sh makes */
static int quotients_are_off(void)
{
    const double three = unfolded(3);
    const double third = unfolded(1) / three, thirds = unfolded(5) / three,
                 more = unfolded(7) / three;
    return third != 0x1.5555555555555p-2 || thirds != 0x1.aaaaaaaaaaaabp+0 ||
           more != 0x1.2aaaaaaaaaaabp+1 ||
           unfolded(5) / unfolded(7) != 0x1.6db6db6db6db7p-1 ||
           sqrt(unfolded(2)) != 0x1.6a09e667f3bcdp+0 ||
           sqrt(unfolded(3)) != 0x1.bb67ae8584caap+0;
}

static int flushes_results(void)
{
    return cylint_bits(unfolded(0x1p-1022) * unfolded(0.5)) != UINT64_C(1)
                                                                   << 51;
}

static int takes_operands_for_zero(void)
{
    return cylint_bits(unfolded(0x1p-1030) * unfolded(0x1p100)) !=
           cylint_bits(unfolded(0x1p-930));
}

/* untaken: in broken builds only, which tests/numbers/test_guards.sh makes */
int cylint_selftest(void)
{
    int found = 0;
    if (format_differs())
        found |= CYLINT_SELFTEST_FORMAT;
    if (contracts())
        found |= CYLINT_SELFTEST_CONTRACTED;
    if (keeps_too_much())
        found |= CYLINT_SELFTEST_UNROUNDED;
    else if (!rounds_to_nearest())
        found |= CYLINT_SELFTEST_DIRECTED;
    else if (quotients_are_off())
        found |= CYLINT_SELFTEST_UNROUNDED;
    if (flushes_results())
        found |= CYLINT_SELFTEST_FLUSHED;
    if (takes_operands_for_zero())
        found |= CYLINT_SELFTEST_ZEROED;
    return found;
}
