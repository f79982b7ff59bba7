/*
 * closest.h - answers about points, for the tests of distances
 */
#ifndef TESTS_CLOSEST_H
#define TESTS_CLOSEST_H

#include <math.h>
#include <string.h>

#include "check.h"
#include "cylint_distance.h"
#include "ulps.h"

#define WANT (CYLINT_WANT_PART | CYLINT_WANT_POINT | CYLINT_WANT_NORMAL)

static inline cylint_closest answer_to(const cylint_shape *s, const double p[3],
                                       unsigned want)
{
    cylint_closest a;
    memset(&a, 0, sizeof a);
    cylint_distance(s, p, want, &a);
    return a;
}

/* All bits.  Members that were not written are equal because both answers were
 * cleared before. */
static inline int same(const cylint_closest *x, const cylint_closest *y)
{
    return memcmp(&x->distance, &y->distance, sizeof x->distance) == 0 &&
           x->part == y->part && x->feature == y->feature &&
           x->flags == y->flags &&
           memcmp(x->point, y->point, sizeof x->point) == 0 &&
           memcmp(x->normal, y->normal, sizeof x->normal) == 0;
}

static inline int is_negative_zero(double x)
{
    return x == 0 && signbit(x);
}

static inline int has_negative_zero(const cylint_closest *a)
{
    int found = is_negative_zero(a->distance);
    for (int i = 0; i < 3; i++)
        found |=
            is_negative_zero(a->point[i]) || is_negative_zero(a->normal[i]);
    return found;
}

/* Within some units in the last place; 0 is not equal to -0. */
static inline int are_within(const double x[3], const double y[3], double ulps)
{
    for (int i = 0; i < 3; i++)
        if (!(fabs(x[i] - y[i]) <= ulps * ulp(y[i])) || is_negative_zero(x[i]))
            return 0;
    return 1;
}

#endif
