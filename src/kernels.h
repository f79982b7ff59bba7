/*
 * kernels.h - what each build of kernel.c offers, and which one is used
 */
#ifndef CYLINT_KERNELS_H
#define CYLINT_KERNELS_H

#include "cylint.h"

/* What a kernel decided: relation miss or cross, and the n hits that count,
 * roots as pairs with a bound on their error. */
typedef struct {
    int relation, n, part[2], side[2];
    double t[2], more[2], error[2];
} cylint_kernel_answer;

typedef struct {
    const char *name;
    /* One line, one shape: 1 if decided, 0 to ask query.c. */
    int (*one)(const cylint_shape *shape, const cylint_line *line,
               unsigned want, cylint_kernel_answer *answer);
} cylint_kernels;

extern const cylint_kernels cylint_kernels_plain, cylint_kernels_fma;

/* The best that this processor can run. */
const cylint_kernels *cylint_best_kernels(void);

#endif
