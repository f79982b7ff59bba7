/*
 * known_distances.h - distances known by hand
 */
#ifndef TESTS_KNOWN_DISTANCES_H
#define TESTS_KNOWN_DISTANCES_H

#include <math.h>
#include <string.h>

#include "check.h"
#include "cylint_distance.h"
#include "ulps.h"

#define WANT (CYLINT_WANT_PART | CYLINT_WANT_POINT | CYLINT_WANT_NORMAL)

enum {
    LATERAL = CYLINT_FEATURE_LATERAL,
    CAP0 = CYLINT_FEATURE_CAP0,
    CAP1 = CYLINT_FEATURE_CAP1,
    RIM0 = CYLINT_FEATURE_RIM0,
    RIM1 = CYLINT_FEATURE_RIM1,
    APEX = CYLINT_FEATURE_APEX
};

struct known {
    double p[3], distance;
    int part, feature;
    double point[3], normal[3];
};

static inline cylint_closest answer_to(const cylint_shape *s, const double p[3],
                                       unsigned want)
{
    cylint_closest a;
    memset(&a, 0, sizeof a);
    cylint_distance(s, p, want, &a);
    return a;
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

/* 0 is not equal to -0. */
static inline int are_within(const double x[3], const double y[3], double ulps)
{
    for (int i = 0; i < 3; i++)
        if (!(fabs(x[i] - y[i]) <= ulps * ulp(y[i])) || is_negative_zero(x[i]))
            return 0;
    return 1;
}

/* The distance is within so many ulps, and so are components of point and
 * normal; with 0 all are equal.  A distance is 0 only if the known one is. */
static inline void check_known(const char *name, cylint_shape s,
                               const struct known *known, int n,
                               double distance_ulps, double point_ulps)
{
    for (int i = 0; i < n; i++) {
        const struct known *k = &known[i];
        const cylint_closest a = answer_to(&s, k->p, WANT);
        if (!CHECK(fabs(a.distance - k->distance) <=
                       distance_ulps * ulp(k->distance) &&
                   (a.distance == 0) == (k->distance == 0) && a.flags == 0 &&
                   a.part == k->part && a.feature == k->feature &&
                   are_within(a.point, k->point, point_ulps) &&
                   are_within(a.normal, k->normal, point_ulps)))
            REPORT("%s, row %d: %.17g part %d feature %d, point %.17g %.17g "
                   "%.17g, normal %.17g %.17g %.17g",
                   name, i, a.distance, a.part, a.feature, a.point[0],
                   a.point[1], a.point[2], a.normal[0], a.normal[1],
                   a.normal[2]);
        cylint_closest same;
        CHECK(cylint_distance(&s, k->p, WANT, &same) == a.distance);
    }
}

#endif
