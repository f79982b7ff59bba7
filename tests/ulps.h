/*
 * ulps.h - how far apart two answers are, in units in the last place
 *
 * The units: of t, its own; of a point, that of its largest coordinate; of
 * normals and angles, that of numbers just below 1; of z, that of z or, if
 * that is larger, of numbers just below 1.
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

/* |x - y| in units of the last place of `size`; infinite for NaN. */
static inline double ulps_apart(double x, double y, double size)
{
    if (x == y)
        return 0;
    const double half = size > 1 ? 0.5 : 1; /* neither over- nor underflow */
    const double off = fabs(half * x - half * y) / ulp(size) / half;
    return off == off ? off : HUGE_VAL;
}

static inline double ulps_largest(const double v[3])
{
    return fmax(fmax(fabs(v[0]), fabs(v[1])), fabs(v[2]));
}

static inline double ulps_vectors(const double x[3], const double y[3],
                                  double size)
{
    double worst = 0;
    for (int i = 0; i < 3; i++)
        worst = fmax(worst, ulps_apart(x[i], y[i], size));
    return worst;
}

/* Of the line's origin: where less than that is left of it, the point is at
 * the coordinates' origin but for the last of the digits computed. */
#define LEFT_OF_ORIGIN 0x1p-90

/* Of one hit, all members computed. */
static inline void ulps_of_hit(const double o[3], const cylint_hit *got,
                               const cylint_hit *want, double off[MEASURES])
{
    const double turn = fabs(got->phi - want->phi);
    off[ULPS_T] = ulps_apart(got->t, want->t, want->t);
    off[ULPS_POINT] = ulps_vectors(
        got->point, want->point,
        fmax(ulps_largest(want->point), ulps_largest(o) * LEFT_OF_ORIGIN));
    off[ULPS_NORMAL] = ulps_vectors(got->normal, want->normal, 0.75);
    off[ULPS_Z] = ulps_apart(got->z, want->z, fmax(fabs(want->z), 0.75));
    off[ULPS_PHI] = ulps_apart(turn > 0.5 ? 1 - turn : turn, 0, 0.75);
}

#endif
