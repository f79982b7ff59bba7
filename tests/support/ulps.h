/*
 * ulps.h - units in the last place (ulp), and operations that must not round
 */
#ifndef CYLINT_ULPS_H
#define CYLINT_ULPS_H

#include <errno.h>
#include <float.h>
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
    const int kept = errno; /* nextafter() sets it beside 0 */
    for (; ulps > 0; ulps--)
        x = nextafter(x, HUGE_VAL);
    for (; ulps < 0; ulps++)
        x = nextafter(x, -HUGE_VAL);
    errno = kept;
    return x;
}

/* Adds y; returns whether that is exact. */
static inline int add_exactly(double *x, double y)
{
    const double sum = *x + y;
    const int exact = fabs(sum) <= DBL_MAX && sum - *x == y && sum - y == *x;
    *x = sum;
    return exact;
}

/* Multiplies by 2^e; returns whether that is exact. */
static inline int scale_exactly(double *x, int n, int e)
{
    int exact = 1;
    for (int i = 0; i < n; i++) {
        const double y = ldexp(x[i], e);
        exact = exact && fabs(y) <= DBL_MAX && ldexp(y, -e) == x[i];
        x[i] = y;
    }
    return exact;
}

#endif
