/*
 * surd_sum.h - a + b sqrt(c) of exact numbers: its sign and its value
 */
#ifndef CYLINT_SURD_SUM_H
#define CYLINT_SURD_SUM_H

#include "../numbers/exact.h"

/* v 2^e, 1/4 < |v| < 4 or v = 0.  It neither overflows nor underflows. */
typedef struct {
    pair v;
    int e;
} floating;

/* x, rounded to a pair. */
floating cylint_floating(exact x);

/* x > 0. */
floating cylint_floating_sqrt(floating x);

static inline floating floating_div(floating x, floating y)
{
    return (floating){pair_div(x.v, y.v), x.e - y.e};
}

/* a + b sqrt(c), c >= 0. */
typedef struct {
    exact a, b, c;
} surd_sum;

/* n / d */
typedef struct {
    surd_sum n;
    exact d;
} surd_quotient;

/* The sign, exactly. */
int cylint_surd_sum_sign(cylint_arena *arena, const surd_sum *x);

/* The value to CYLINT_SURD_ERROR, relative.  0 exactly for 0. */
floating cylint_surd_sum_value(cylint_arena *arena, const surd_sum *x);
floating cylint_surd_quotient_value(cylint_arena *arena,
                                    const surd_quotient *x);

#endif
