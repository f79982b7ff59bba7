/*
 * distance_oracle_zeros.h - the real zeros of a polynomial of degree 4
 *
 * Only distance_oracle_elliptic.c includes it.  Here the sign of a number is that
 * of MPFR, whatever its error.
 */
#ifndef CYLINT_DISTANCE_ORACLE_ZEROS_H
#define CYLINT_DISTANCE_ORACLE_ZEROS_H

#include <stdlib.h>

#include "real.h"

enum { FIRST_BITS = 128, MOST_DEGREE = 4, MOST_ZEROS = 12, MOST_STEPS = 4000 };

typedef real polynomial[MOST_DEGREE + 1];

static int sgn(real x)
{
    return mpfr_sgn(x->x);
}

static int compare(real x, real y)
{
    return mpfr_cmp(x->x, y->x);
}

/* Writes the slope, too, if it is not NULL. */
static real value_of(const real *p, int degree, real at, real *slope)
{
    real value = p[degree];
    if (slope)
        *slope = real_of(0);
    for (int i = degree - 1; i >= 0; i--) {
        if (slope)
            *slope = plus(times(*slope, at), value);
        value = plus(times(value, at), p[i]);
    }
    return value;
}

/* A number between low and high: 0 if the signs differ; the one in the middle
 * of the exponents if those differ; or the arithmetic mean. */
static real middle(real low, real high)
{
    const long least = -20000;
    const int sign = sgn(low) + sgn(high) < 0 ? -1 : 1;
    const long l = sgn(low) == 0 ? least : mpfr_get_exp(low->x);
    const long h = sgn(high) == 0 ? least : mpfr_get_exp(high->x);
    if (sgn(low) * sgn(high) < 0)
        return real_of(0);
    if (labs(l - h) > 1)
        return times(real_of(sign),
                     power_of_two((l < h ? l : h) + labs(l - h) / 2 - 1));
    return times(real_of(0.5), plus(low, high));
}

/* |x| < 2^-digits |y| */
static int is_tiny(real x, real y, long digits)
{
    return mpfr_regular_p(x->x) && mpfr_regular_p(y->x) &&
           mpfr_get_exp(x->x) < mpfr_get_exp(y->x) - digits;
}

/* A number of its own with the value of x, which counts as exact. */
static void assign(real to, real x)
{
    mpfr_set_prec(to->x, mpfr_get_prec(x->x));
    mpfr_set(to->x, x->x, RND);
    to->off = EXACT;
}

static real copy(real x)
{
    real to = new_real();
    assign(to, x);
    return to;
}

/* Improves x, a zero between low and high, at which the signs differ (at high it is
 * `sign`), by Newton's iteration with bisection, until a step is 2^-digits of x.
 * The error of the zero is that of the last step. */
static real iterate(const real *p, int degree, real low, real high, int sign,
                    real x, long digits)
{
    real slope, step, next, last = minus(high, low);
    if (compare(x, low) <= 0 || compare(x, high) >= 0)
        x = middle(low, high);
    low = copy(low);
    high = copy(high);
    x = copy(x);
    const int mark = reals.used;
    for (int i = 0; i < MOST_STEPS + reals.bits; i++) {
        const real f = value_of(p, degree, x, &slope);
        if (sgn(f) == 0)
            break;
        assign(sgn(f) == sign ? high : low, x);
        step = over(f, slope);
        next = minus(x, step);
        if (is_tiny(step, x, digits))
            return next;
        if (mpfr_cmpabs(times(real_of(1.25), step)->x, last->x) > 0 ||
            compare(next, low) <= 0 || compare(next, high) >= 0)
            next = middle(low, high);
        step = minus(next, x);
        assign(x, next);
        assign(last, step);
        reals.used = mark;
        if (sgn(last) == 0 || is_tiny(last, x, reals.bits))
            break;
    }
    return x;
}

/* The zero between low and high: first with few bits, then with twice as many each
 * time, as Newton's iteration doubles the number of digits. */
static real zero_between(const real *p, int degree, real low, real high,
                         int sign)
{
    const int mark = reals.used;
    const long bits = reals.bits;
    real x = low;
    for (long now = FIRST_BITS; now < 2 * bits; now *= 2) {
        reals.bits = now < bits ? now : bits;
        x = iterate(p, degree, low, high, sign, x, reals.bits / 2);
    }
    reals.bits = bits;
    return real_keep(mark, x);
}

/* Writes the zeros of p from -bound to bound, given those of its derivative;
 * returns their number. */
static int zeros_within(const real *p, int degree, real bound, real *zero)
{
    real derivative[MOST_DEGREE], turn[MOST_ZEROS], low = negated(bound);
    int n = 0, before = sgn(value_of(p, degree, low, NULL));
    if (degree == 0)
        return 0;
    for (int i = 0; i < degree; i++)
        derivative[i] = times(real_of(i + 1), p[i + 1]);
    const int turns = zeros_within(derivative, degree - 1, bound, turn);
    for (int i = 0; i <= turns; i++) {
        const real high = i < turns ? turn[i] : bound;
        if (compare(high, low) <= 0)
            continue;
        const int after = sgn(value_of(p, degree, high, NULL));
        if (before == 0)
            zero[n++] = low;
        else if (before * after < 0)
            zero[n++] = zero_between(p, degree, low, high, after);
        low = high;
        before = after;
    }
    if (before == 0)
        zero[n++] = low;
    return n;
}

/* A number above the absolute values of the zeros.  Lowers *degree to that of p. */
static real bound_of_zeros(const real *p, int *degree)
{
    real bound = real_of(1);
    while (*degree > 0 && sgn(p[*degree]) == 0)
        --*degree;
    for (int i = 0; i < *degree; i++) {
        const real share = over(p[i], p[*degree]);
        bound = plus(bound, times(real_of(sgn(share)), share));
    }
    return bound;
}

/* All real zeros of p. */
static int real_zeros(const real *p, real *zero)
{
    int degree = MOST_DEGREE;
    const real bound = bound_of_zeros(p, &degree);
    return zeros_within(p, degree, bound, zero);
}

#endif
