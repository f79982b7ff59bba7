/*
 * floating.h - pairs with a binary exponent of their own
 *
 * Such a value neither overflows nor underflows.
 */
#ifndef CYLINT_FLOATING_H
#define CYLINT_FLOATING_H

#include "../numbers/bits.h"
#include "../numbers/exact.h"

/* v 2^e, 1/4 < |v| < 4 or v = 0. */
typedef struct {
    pair v;
    int e;
} floating;

/* x, rounded to a pair. */
floating cylint_floating(exact x);

/* x > 0. */
floating cylint_floating_sqrt(floating x);

static inline floating floating_mul(floating x, floating y)
{
    return (floating){pair_mul(x.v, y.v), x.e + y.e};
}

static inline floating floating_div(floating x, floating y)
{
    return (floating){pair_div(x.v, y.v), x.e - y.e};
}

/* |x|. */
static inline floating floating_size(floating x)
{
    return x.v.hi < 0 ? (floating){pair_neg(x.v), x.e} : x;
}

/* x + y of x > 0 and y > 0. */
static inline floating floating_sum_of_sizes(floating x, floating y)
{
    const floating large = x.e < y.e ? y : x, small = x.e < y.e ? x : y;
    if (large.e - small.e > CYLINT_NEGLIGIBLE_EXPONENT)
        return large;
    const double w = cylint_power_of_two(small.e - large.e);
    return (floating){pair_add(large.v, (pair){small.v.hi * w, small.v.lo * w}),
                      large.e};
}

#endif
