/*
 * distance.c - one point and one shape
 */
#include "../dispatch.h"
#include "../numbers/bits.h"
#include "cylint_distance.h"
#include "limb_distance.h"
#include "undecided_distance.h"

size_t cylint_sizeof_closest(void)
{
    return sizeof(cylint_closest);
}

/* The build that goes with that of the filter.  NULL: none is chosen yet;
 * cylint_undecided_distance() chooses it. */
static inline cylint_one_distance *const *kernels_of(int kind)
{
    const cylint_build build = CYLINT_LOAD(cylint_build_chosen);
    if (build == CYLINT_BUILDS)
        return NULL;
    return CYLINT_OF_BUILD(build, cylint_limb_plain, cylint_limb_fma,
                           cylint_limb_fma)[kind];
}

double cylint_distance(const cylint_shape *shape, const double point[3],
                       unsigned want, cylint_closest *answer)
{
    const unsigned geometry = want & (CYLINT_WANT_POINT | CYLINT_WANT_NORMAL);
    cylint_one_distance *const *kernels = kernels_of(shape->kind);
    if (!kernels || !cylint_prepared(shape) ||
        ((unsigned)shape->ends | geometry) != 0)
        return cylint_undecided_distance(shape, point, want, answer);
    const double distance =
        kernels[want / CYLINT_WANT_PART & 1](shape, point, want, answer);
#if CYLINT_IS_PARANOID
    cylint_closest other;
    cylint_contradiction(
        cylint_undecided_distance(shape, point, want, &other) != distance ||
        (want & CYLINT_WANT_PART && other.feature != answer->feature));
#endif
    return distance;
}

/* The exponent of the distance of |x| from the next larger double. */
static int exponent_of_last_place(double x)
{
    const int e = cylint_exponent(x) - 52;
    /* mutant '>' -> '>=': -1074 gives -1074, too */
    return e > -1074 ? e : -1074;
}

/* Whether x <= y 2^e, for positive finite x and y.  A subnormal product would
 * be rounded. */
static int is_at_most(double x, double y, int e)
{
    const int of_x = cylint_any_exponent(x), of_y = cylint_any_exponent(y);
    return of_x != of_y + e
               ? of_x < of_y + e
               : cylint_scaled(x, -of_x) <= cylint_scaled(y, -of_y);
}

int cylint_on_surface(const cylint_shape *shape, const double point[3],
                      double ulps)
{
    cylint_closest answer;
    /* mutant '0' -> '1': CYLINT_WANT_T has no effect here */
    const double size = fabs(cylint_distance(shape, point, 0, &answer));
    if (!(size <= DBL_MAX) || ulps != ulps || cylint_sign(ulps) < 0)
        return 0;
    if (cylint_sign(size) == 0 || ulps > DBL_MAX)
        return 1;
    return cylint_sign(ulps) != 0 &&
           is_at_most(size, ulps,
                      exponent_of_last_place(cylint_largest(point)));
}
