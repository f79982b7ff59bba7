/*
 * eft.h - sums and products without error, and pairs of doubles
 *
 * A pair (hi, lo), |lo| <= ulp(hi)/2, stands for hi + lo.  The order of
 * operations is the algorithm: do not let a compiler reassociate or contract
 * (internal.h refuses the flags that would).
 *
 * [Dekker 1971], [Knuth TAOCP 2, 4.2.2], [Joldes, Muller, Popescu 2017].
 */
#ifndef CYLINT_EFT_H
#define CYLINT_EFT_H

#include <math.h>

#include "environment.h"

typedef struct {
    double hi, lo;
} pair;

static inline pair two_sum(double a, double b)
{
    const double s = a + b, bb = s - a;
    return (pair){s, (a - (s - bb)) + (b - bb)};
}

static inline pair two_diff(double a, double b)
{
    return two_sum(a, -b);
}

/* |a| >= |b|, or a = 0. */
static inline pair fast_two_sum(double a, double b)
{
    const double s = a + b;
    return (pair){s, b - (s - a)};
}

/* The error of a product is a double, whichever way it is found, so both
 * ways give the same bits. */
static inline pair two_prod(double a, double b)
{
    const double p = a * b;
#ifdef __FMA__
    return (pair){p, __builtin_fma(a, b, -p)};
#else
    const double split = 0x1p27 + 1;
    const double ca = split * a, cb = split * b;
    const double ah = ca - (ca - a), al = a - ah;
    const double bh = cb - (cb - b), bl = b - bh;
    return (pair){p, ((ah * bh - p) + ah * bl + al * bh) + al * bl};
#endif
}

/* Error at most CYLINT_PAIR_ADD (|a| + |b|), bounds.h. */
static inline pair pair_add(pair a, pair b)
{
    const pair s = two_sum(a.hi, b.hi);
    return fast_two_sum(s.hi, s.lo + (a.lo + b.lo));
}

static inline pair pair_neg(pair a)
{
    return (pair){-a.hi, -a.lo};
}

static inline pair pair_sub(pair a, pair b)
{
    return pair_add(a, pair_neg(b));
}

/* Error at most CYLINT_PAIR_MUL |a b|. */
static inline pair pair_mul(pair a, pair b)
{
    const pair p = two_prod(a.hi, b.hi);
    return fast_two_sum(p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi));
}

/* Relative error at most CYLINT_PAIR_DIV. */
static inline pair pair_div(pair a, pair b)
{
    const double q = a.hi / b.hi;
    const pair p = two_prod(q, b.hi);
    const double rest = ((a.hi - p.hi) - p.lo) + (a.lo - q * b.lo);
    return fast_two_sum(q, rest / b.hi);
}

/* a > 0.  Relative error at most CYLINT_PAIR_SQRT. */
static inline pair pair_sqrt(pair a)
{
    const double s = sqrt(a.hi);
    const pair p = two_prod(s, s);
    return fast_two_sum(s, (((a.hi - p.hi) - p.lo) + a.lo) / (2 * s));
}

#endif
