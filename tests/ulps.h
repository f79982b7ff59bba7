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

static const char *const measure_names[MEASURES] = {"t", "point", "normal", "z",
                                                    "phi"};

/* The unit in the last place of x. */
static inline double ulp(double x)
{
    int e;
    frexp(x, &e);
    return x == 0 || e - 53 < -1074 ? 0x1p-1074 : ldexp(1, e - 53);
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

static inline double ulps_vectors(const double got[3], const double want[3])
{
    double worst = 0;
    for (int i = 0; i < 3; i++)
        worst = fmax(worst, ulps_member(got[i], want[i]));
    return worst;
}

/* Angles in turns; an angle that rounds to one turn is given as 0. */
static inline double ulps_turns(double got, double want)
{
    if (got == 0 && !signbit(got) && want > 0.75)
        return ulps_apart(1, want, 0.75);
    return ulps_member(got, want);
}

/* The differences of all members of a hit. */
static inline void ulps_of_hit(const cylint_hit *got, const cylint_hit *want,
                               double off[MEASURES])
{
    off[ULPS_T] = ulps_apart(got->t, want->t, want->t);
    off[ULPS_POINT] = ulps_vectors(got->point, want->point);
    off[ULPS_NORMAL] = ulps_vectors(got->normal, want->normal);
    off[ULPS_Z] = ulps_member(got->z, want->z);
    off[ULPS_PHI] = ulps_turns(got->phi, want->phi);
}

#endif
