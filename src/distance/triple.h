/*
 * triple.h - sums of three doubles
 *
 * A triple stands for a + b + c.  Where nothing has cancelled, |b| is at most
 * 2^-53 |a| and |c| at most 2^-104 |a|, or nearly.  The error of an operation is
 * then below CYLINT_TRIPLE_ROUNDING (error_bounds.h) of |x| + |y| or of |x y|, in
 * rounding to nearest.  Where terms have cancelled, it is below that of their
 * sizes: tests/bounds/test_local_residuals.c.
 *
 * After the triple-word arithmetic of [Hida, Li, Bailey 2001].
 */
#ifndef CYLINT_TRIPLE_H
#define CYLINT_TRIPLE_H

#include "../numbers/double_double.h"
#include "error_bounds.h"

typedef struct {
    double a, b, c;
} triple;

static inline triple triple_of(double x)
{
    return (triple){x, 0, 0};
}

static inline triple triple_of_pair(pair x)
{
    return (triple){x.hi, x.lo, 0};
}

static inline triple triple_sum(double a, double b, double c)
{
    const pair head = fast_two_sum(a, b), tail = fast_two_sum(head.lo, c);
    return (triple){head.hi, tail.hi, tail.lo};
}

static inline triple triple_add(triple x, triple y)
{
    const pair s = two_sum(x.a, y.a), t = two_sum(x.b, y.b);
    const pair u = two_sum(t.hi, s.lo);
    return triple_sum(s.hi, u.hi, (x.c + y.c) + (t.lo + u.lo));
}

static inline triple triple_sub(triple x, triple y)
{
    return triple_add(x, (triple){-y.a, -y.b, -y.c});
}

static inline triple triple_mul(triple x, triple y)
{
    const pair p = two_prod(x.a, y.a);
    const pair q = two_prod(x.a, y.b), r = two_prod(x.b, y.a);
    const pair s = two_sum(q.hi, r.hi), t = two_sum(s.hi, p.lo);
    const double low = (x.a * y.c + x.c * y.a) + x.b * y.b;
    return triple_sum(p.hi, t.hi, low + ((q.lo + r.lo) + (s.lo + t.lo)));
}

#endif
