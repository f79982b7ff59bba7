/*
 * ulps.h - the difference of two numbers in units in the last place (ulp)
 */
#ifndef CYLINT_ULPS_H
#define CYLINT_ULPS_H

#include <errno.h>
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

#endif
