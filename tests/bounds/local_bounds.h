/*
 * local_bounds.h - for tests that compute the least constants of
 * error_bounds.h that would do for the filter's local coordinates
 */
#ifndef TESTS_LOCAL_BOUNDS_H
#define TESTS_LOCAL_BOUNDS_H

#include <math.h>

#include "check.h"

/* Slopes, and the quotient of a cell's ends.  Beyond the last slope its greatest
 * powers decide.  A larger quotient proves as much: it needs larger constants. */
#define FIRST_SLOPE 0x1p-20
#define LAST_SLOPE 0x1p30
#define STEP 1.1

static inline double square(double x)
{
    return x * x;
}

/* A constant, and the least value that would do. */
typedef struct {
    const char *name;
    double value, needed;
} constant;

/* The least value of the present constant. */
static double needed;

/* `error` is the greatest of a cell, `unit` the least product without the
 * constant. */
static inline void need(double error, double unit)
{
    needed = fmax(needed, error / unit);
}

static inline void judge_in(constant *c, const char *of, const char *arithmetic)
{
    printf("note: %-15s %-14s %-7s %.3g of %.4g\n", c->name, of, arithmetic,
           needed, c->value);
    if (!CHECK(needed <= c->value))
        REPORT("%s must be %g", c->name, needed);
    c->needed = fmax(c->needed, needed);
    needed = 0;
}

static inline void check_slack(const constant *c)
{
    if (!CHECK(4 * c->needed > c->value))
        REPORT("%s: %g would do", c->name, c->needed);
}

#endif
