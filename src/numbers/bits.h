/*
 * bits.h - exponent, sign and order of doubles from their bits, scaling by powers
 * of two, exact differences; quotients of bounded pairs, what is certain of them
 *
 * All are right in every floating-point environment, except cylint_largest(),
 * cylint_dot() and those of bounded pairs.
 */
#ifndef CYLINT_BITS_H
#define CYLINT_BITS_H

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "compiler.h"
#include "double_double.h"
#include "error_bounds.h"

/* The double with these bits. */
static inline double cylint_from_bits(uint64_t bits)
{
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* 2^e for -1022 <= e <= 1023. */
static inline double cylint_power_of_two(int e)
{
    return cylint_from_bits((uint64_t)(e + 1023) << 52);
}

/*
 * The bits of x.  The asm hides from the compiler that they come from x:
 * clang 19 compiles "no bit but the sign is set" into the comparison
 * x == 0.0, which is true for subnormal x if the processor reads subnormals as
 * zero.
 */
static inline uint64_t cylint_bits(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
#ifdef __GNUC__
    __asm__("" : "+r"(bits));
#endif
    return bits;
}

/* The e of 2^e <= |x| < 2^(e+1) for normal x; below -1022 for 0 and subnormal x,
 * 1024 for infinite x. */
static inline int cylint_exponent(double x)
{
    return (int)(cylint_bits(x) >> 52 & 0x7ff) - 1023;
}

/* The double nearest to x 2^e. */
double cylint_scaled(double x, int e);

/* The same as cylint_exponent(), also for subnormal x. */
static inline int cylint_any_exponent(double x)
{
    const int e = cylint_exponent(x);
    return e >= -1022 ? e : cylint_exponent(cylint_scaled(x, 60)) - 60;
}

/* -1, 0 or 1.  Right for subnormals even if the processor reads them as zero. */
static inline int cylint_sign(double x)
{
    const uint64_t bits = cylint_bits(x);
    return bits << 1 == 0 ? 0 : bits >> 63 ? -1 : 1;
}

/* x, and 0 for -0.  x + 0 would be -0 in rounding downward. */
static inline double cylint_positive_zero(double x)
{
    return cylint_sign(x) == 0 ? 0 : x;
}

/* Whether 0 < |x| < 2^-e. */
static inline int cylint_is_small(double x, int e)
{
    const uint64_t least = (uint64_t)(1023 - e) << 53; /* without the sign */
    return (cylint_bits(x) << 1) - 1 < least - 1;      /* a zero wraps round */
}

/* Whether a two_sum with x can have a subnormal low part, which the processor may
 * flush. */
static inline int cylint_too_small(double x)
{
    return cylint_is_small(x, CYLINT_SUM_EXPONENT);
}

/* An integer that grows with x.  Both zeros give 0. */
static inline int64_t cylint_rank(double x)
{
    const uint64_t bits = cylint_bits(x);
    const int64_t size = (int64_t)(bits << 1 >> 1);
    return bits >> 63 ? -size : size;
}

/* The double of a rank. */
static inline double cylint_from_rank(int64_t rank)
{
    return cylint_from_bits(rank < 0 ? (uint64_t)-rank | (uint64_t)1 << 63
                                     : (uint64_t)rank);
}

/* x < y, computed from the bits.  Neither is NaN. */
static inline int cylint_less(double x, double y)
{
    return cylint_rank(x) < cylint_rank(y);
}

/* The least double above x, computed from the bits; infinity for infinity. */
static inline double cylint_next_above(double x)
{
    if (x > DBL_MAX)
        return x;
    return cylint_from_rank(cylint_rank(x) + 1);
}

/* The next double above or below x. */
static inline double cylint_next(double x, int up)
{
    return up ? cylint_next_above(x) : -cylint_next_above(-x);
}

/* Whether two points are equal, computed from the bits; both zeros are. */
static inline int cylint_are_equal(const double x[3], const double y[3])
{
    return cylint_rank(x[0]) == cylint_rank(y[0]) &&
           cylint_rank(x[1]) == cylint_rank(y[1]) &&
           cylint_rank(x[2]) == cylint_rank(y[2]);
}

/* Whether no component of v but i is other than 0. */
static inline int cylint_runs_along(const double v[3], int i)
{
    return cylint_sign(v[(i + 1) % 3]) == 0 && cylint_sign(v[(i + 2) % 3]) == 0;
}

static inline double cylint_largest(const double x[3])
{
    return cylint_larger(cylint_larger(fabs(x[0]), fabs(x[1])), fabs(x[2]));
}

/* The same of numbers that the processor may read as 0. */
double cylint_largest_by_bits(const double x[3]);

/* lint: the analyzer takes three rounds of EACH for one */
CYLINT_INLINE double cylint_dot(const double x[3], const double y[3])
{
    return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

/* An infinite or NaN coordinate fails the comparison. */
static inline int cylint_is_finite(const double x[3])
{
    return fabs(x[0]) <= DBL_MAX && fabs(x[1]) <= DBL_MAX &&
           fabs(x[2]) <= DBL_MAX;
}

static inline int cylint_is_zero(const double x[3])
{
    return !cylint_sign(x[0]) && !cylint_sign(x[1]) && !cylint_sign(x[2]);
}

/* x - y as a pair, exactly, in every floating-point environment.  hi is never -0.
 * If x - y overflows, lo is 0. */
pair cylint_difference_by_bits(double x, double y);
static inline pair cylint_difference(double x, double y)
{
    const pair d = two_diff(x, y); /* beside DBL_MAX, lo can be NaN */
    const int is_exact = !cylint_too_small(x) && !cylint_too_small(y) &&
                         fabs(d.lo) <= DBL_MAX && cylint_rounds_to_nearest();
    return is_exact ? (pair){d.hi + 0.0, d.lo}
                    : cylint_difference_by_bits(x, y);
}

/* ---------------------------- bounded pairs, in rounding to nearest -- */

static inline int cylint_is_exact_zero(bounded_pair x)
{
    return x.v.hi == 0 && x.error == 0;
}

/* x / y.  Its error: that of x over y, those of y and of the division, relative to
 * the quotient, and terms of second order (CYLINT_ROOT_SLACK).  Infinite where that
 * of y is not below CYLINT_FIRST_ORDER of it. */
static inline bounded_pair cylint_quotient(bounded_pair x, bounded_pair y)
{
    const pair q = pair_div(x.v, y.v);
    const double inverse = fabs(1 / y.v.hi), of_y = y.error * inverse;
    const double error =
        x.error * inverse + fabs(q.hi) * (of_y + CYLINT_PAIR_DIV);
    return (bounded_pair){
        q, of_y < CYLINT_FIRST_ORDER ? CYLINT_ROOT_SLACK * error : HUGE_VAL};
}

/* Far from 0 and from the largest double. */
static inline int cylint_is_moderate(bounded_pair x)
{
    return fabs(x.v.hi) > CYLINT_ROOT_LEAST &&
           fabs(x.v.hi) < 1 / CYLINT_ROOT_LEAST;
}

/* Whether x is moderate, and all numbers within its error round to x.v.hi. */
static inline int cylint_is_rounded(bounded_pair x)
{
    return cylint_is_moderate(x) && x.v.hi + (x.v.lo + x.error) == x.v.hi &&
           x.v.hi + (x.v.lo - x.error) == x.v.hi;
}

/* The sign of x - y, or CYLINT_SIGN_UNDECIDED. */
enum { CYLINT_SIGN_UNDECIDED = 2 };
CYLINT_INLINE int cylint_side_of_number(bounded_pair x, double y)
{
    const double beyond = (x.v.hi - y) + x.v.lo; /* rounded twice */
    if (cylint_is_exact_zero(x))
        return -cylint_sign(y);
    return !cylint_is_moderate(x)  ? CYLINT_SIGN_UNDECIDED
           : beyond > 2 * x.error  ? 1
           : beyond < -2 * x.error ? -1
                                   : CYLINT_SIGN_UNDECIDED;
}

#endif
