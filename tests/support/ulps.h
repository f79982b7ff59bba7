/*
 * ulps.h - the difference of two answers in units in the last place (ulp)
 *
 * The unit is that of each number itself: of t, of each component of point and
 * normal, of z and of phi.  An exact 0 must be 0, not -0.
 */
#ifndef CYLINT_ULPS_H
#define CYLINT_ULPS_H

#include <math.h>

#include "cylint.h"

enum measure { ULPS_T, ULPS_POINT, ULPS_NORMAL, ULPS_Z, ULPS_PHI, MEASURES };

enum { COMPONENTS = 9 }; /* of a hit: t, point, normal, z, phi */

static const enum measure measure_of[COMPONENTS] = {
    ULPS_T,      ULPS_POINT,  ULPS_POINT, ULPS_POINT, ULPS_NORMAL,
    ULPS_NORMAL, ULPS_NORMAL, ULPS_Z,     ULPS_PHI};

static const char *const measure_names[MEASURES] = {"t", "point", "normal", "z",
                                                    "phi"};

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

/* The difference from the nearer of two right answers. */
static inline double ulps_either(double got, double want, double other)
{
    return fmin(ulps_member(got, want), ulps_member(got, other));
}

/* The differences of the components of a hit from those of the oracle.  `other`
 * is oracle_other(). */
static inline void ulps_of_components(const cylint_hit *got,
                                      const cylint_hit *want,
                                      const cylint_hit *other,
                                      double off[COMPONENTS])
{
    off[0] = ulps_member(got->t, want->t);
    for (int i = 0; i < 3; i++) {
        off[1 + i] = ulps_member(got->point[i], want->point[i]);
        off[4 + i] =
            ulps_either(got->normal[i], want->normal[i], other->normal[i]);
    }
    off[7] = ulps_member(got->z, want->z);
    off[8] = ulps_either(got->phi, want->phi, other->phi);
}

/* The same of its members, that of the worst component. */
static inline void ulps_of_hit(const cylint_hit *got, const cylint_hit *want,
                               const cylint_hit *other, double off[MEASURES])
{
    double of[COMPONENTS];
    ulps_of_components(got, want, other, of);
    for (int i = 0; i < MEASURES; i++)
        off[i] = 0;
    for (int i = 0; i < COMPONENTS; i++)
        off[measure_of[i]] = fmax(off[measure_of[i]], of[i]);
}

#endif
