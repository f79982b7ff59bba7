/*
 * undecided_distance.c - distances that two limbs do not decide: by pairs, or by
 * exact numbers
 */
#include "../numbers/bits.h"
#include "../dispatch.h"
#include "certified_distance.h"
#include "cylint_distance.h"
#include "elliptic.h"
#include "exact_distance.h"
#include "undecided_distance.h"

/* There is no surface. */
static double nowhere(cylint_closest *answer)
{
    answer->part = -1;
    answer->feature = CYLINT_FEATURE_LATERAL;
    return answer->distance = HUGE_VAL;
}

static double by_exact_numbers(const cylint_shape *shape, const double point[3],
                               unsigned want, cylint_closest *answer)
{
    meridian m;
    cylint_load_meridian(&m, shape, point);
    const nearest n = cylint_nearest_feature(&m);
    if (n.part < 0)
        return nowhere(answer);
    if (want & CYLINT_WANT_PART) {
        answer->part = n.part;
        answer->feature = n.feature;
    }
    if (want & (CYLINT_WANT_POINT | CYLINT_WANT_NORMAL))
        cylint_nearest_point(&m, &n, want, answer);
    const double size = n.sign != 0 ? cylint_rounded_distance(&m, &n) : 0;
    return answer->distance = n.sign < 0 ? -size : size;
}

/* The build of the kernel that goes with those of the filter. */
static inline int is_certified(const cylint_shape *shape, const double point[3],
                               unsigned want, cylint_closest *answer)
{
    return CYLINT_OF_BUILD(cylint_build_used(), cylint_certified_plain,
                           cylint_certified_fma,
                           cylint_certified_fma)(shape, point, want, answer);
}

/* The distance alone of a point that lies on the surface, no part of which is
 * missing. */
static int is_zero(const cylint_shape *shape, const double point[3],
                   unsigned want)
{
    const int whole = cylint_caps_present(shape->ends) == 3 ||
                      !cylint_ends_are_planes(shape->ends);
    return whole &&
           !(want &
             (CYLINT_WANT_PART | CYLINT_WANT_POINT | CYLINT_WANT_NORMAL)) &&
           cylint_contains(shape, point) == 0;
}

/* All answers that the certified ones leave. */
ASIDE double answer_rest(const cylint_shape *shape, const double point[3],
                         unsigned want, cylint_closest *answer)
{
    if (shape->kind == CYLINT_KIND_NONE || !cylint_is_finite(point)) {
        answer->flags = CYLINT_FLAG_INVALID;
        return nowhere(answer);
    }
    if (is_zero(shape, point, want))
        return answer->distance = 0;
    if (cylint_is_elliptic(shape->kind))
        return cylint_elliptic_distance(shape, point, want, answer);
    return by_exact_numbers(shape, point, want, answer);
}

#if CYLINT_IS_PARANOID
/* The certified answer is not the exact one. */
static int contradicts(const cylint_shape *shape, const double point[3],
                       unsigned want, const cylint_closest *known)
{
    cylint_closest a;
    by_exact_numbers(shape, point, want, &a);
    int wrong = a.distance != known->distance;
    if (want & CYLINT_WANT_PART)
        wrong |= a.part != known->part || a.feature != known->feature;
    for (int i = 0; i < 3; i++) {
        wrong |= want & CYLINT_WANT_POINT && a.point[i] != known->point[i];
        wrong |= want & CYLINT_WANT_NORMAL && a.normal[i] != known->normal[i];
    }
    return wrong;
}
#endif

double cylint_undecided_distance(const cylint_shape *shape,
                                 const double point[3], unsigned want,
                                 cylint_closest *answer)
{
    answer->flags = 0;
    if (cylint_prepared(shape) && is_certified(shape, point, want, answer)) {
#if CYLINT_IS_PARANOID
        cylint_contradiction(contradicts(shape, point, want, answer));
#endif
        return answer->distance;
    }
    return answer_rest(shape, point, want, answer);
}
