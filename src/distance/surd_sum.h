/*
 * surd_sum.h - a + b sqrt(c) of exact numbers: its sign and its value
 */
#ifndef CYLINT_SURD_SUM_H
#define CYLINT_SURD_SUM_H

#include "floating.h"

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
