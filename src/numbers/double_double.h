/*
 * double_double.h - pairs of doubles
 *
 * A pair (hi, lo), |lo| <= ulp(hi)/2, stands for hi + lo.
 *
 * [Joldes, Muller, Popescu 2017].
 */
#ifndef CYLINT_DOUBLE_DOUBLE_H
#define CYLINT_DOUBLE_DOUBLE_H

#include "compiler.h"
#include "environment.h"

typedef struct {
    double hi, lo;
} pair;

/* A number and a bound on its error. */
typedef struct {
    pair v;
    double error;
} bounded_pair;

#define REAL double
#define PAIR pair
#define EFT(name) name
#define BROADCAST(x) (x)
#define INLINE static inline
#ifdef __FMA__
#define FUSED(a, b, c) __builtin_fma(a, b, c)
#endif
#include "error_free_template.h"
#undef REAL
#undef PAIR
#undef EFT
#undef BROADCAST
#undef FUSED
#undef INLINE

static inline pair two_diff(double a, double b)
{
    return two_sum(a, -b);
}

/* Error at most CYLINT_PAIR_ADD (|a| + |b|), error_bounds.h. */
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
    const double remainder = ((a.hi - p.hi) - p.lo) + (a.lo - q * b.lo);
    return fast_two_sum(q, remainder / b.hi);
}

/* a > 0.  Relative error at most CYLINT_PAIR_SQRT.  NaN where a is negative because
 * a number underflowed. */
static inline pair pair_sqrt(pair a)
{
    const double s = cylint_sqrt(a.hi);
    const pair p = two_prod(s, s);
    return fast_two_sum(s, (((a.hi - p.hi) - p.lo) + a.lo) / (2 * s));
}

#endif
