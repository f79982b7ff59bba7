/*
 * vectors.h - vectors of doubles, and lines, for tests and benchmarks
 */
#ifndef CYLINT_TEST_VECTORS_H
#define CYLINT_TEST_VECTORS_H

#include <math.h>

#include "cylint.h"

static inline double dot3(const double u[3], const double v[3])
{
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

/* to = u x v; `to` is neither of them. */
static inline void cross3(double to[3], const double u[3], const double v[3])
{
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        to[i] = u[j] * v[k] - u[k] * v[j];
    }
}

static inline double length3(const double v[3])
{
    return sqrt(dot3(v, v));
}

static inline void set3(double to[3], double x, double y, double z)
{
    to[0] = x;
    to[1] = y;
    to[2] = z;
}

static inline void copy3(double to[3], const double from[3])
{
    set3(to, from[0], from[1], from[2]);
}

/* to += by v */
static inline void add3(double to[3], double by, const double v[3])
{
    for (int i = 0; i < 3; i++)
        to[i] += by * v[i];
}

/* to = o + t d */
static inline void along3(double to[3], const double o[3], double t,
                          const double d[3])
{
    set3(to, o[0] + t * d[0], o[1] + t * d[1], o[2] + t * d[2]);
}

static inline void scale3(double v[3], double by)
{
    set3(v, v[0] * by, v[1] * by, v[2] * by);
}

/* to = u - v */
static inline void minus3(double to[3], const double u[3], const double v[3])
{
    set3(to, u[0] - v[0], u[1] - v[1], u[2] - v[2]);
}

/* to = v / |v| */
static inline void unit3(double to[3], const double v[3])
{
    const double length = length3(v);
    set3(to, v[0] / length, v[1] / length, v[2] / length);
}

static inline int is_finite3(const double v[3])
{
    return isfinite(v[0]) && isfinite(v[1]) && isfinite(v[2]);
}

/* The line without its domain. */
static inline cylint_line whole_of(cylint_line line)
{
    line.tmin = -HUGE_VAL;
    line.tmax = HUGE_VAL;
    return line;
}

#endif
