/*
 * ulps.h - the difference of two numbers in units in the last place (ulp)
 */
#ifndef CYLINT_ULPS_H
#define CYLINT_ULPS_H

#include <math.h>

/* The unit in the last place of x. */
static inline double ulp(double x)
{
    int e;
    frexp(x, &e);
    return x == 0 || e - 53 < -1074 ? 0x1p-1074 : ldexp(1, e - 53);
}

/* x moved by the given number of ulp, at most to the largest double. */
static inline double stepped(double x, int ulps)
{
    for (; ulps > 0; ulps--)
        x = nextafter(x, HUGE_VAL);
    for (; ulps < 0; ulps++)
        x = nextafter(x, -HUGE_VAL);
    return x;
}

/* |x - y| in ulp of `size`; infinite for NaN. */
static inline double ulps_apart(double x, double y, double size)
{
    if (x == y)
        return 0;
    const double half = size > 1 ? 0.5 : 1; /* avoids overflow and underflow */
    const double off = fabs(half * x - half * y) / ulp(size) / half;
    return off == off ? off : HUGE_VAL;
}

/* The difference of a member of a hit; infinite if only one of them is 0. */
static inline double ulps_member(double got, double want)
{
    if (got == 0 && signbit(got))
        return HUGE_VAL;
    return want == 0 && got != 0 ? HUGE_VAL : ulps_apart(got, want, want);
}

#endif
