/*
 * distance.c - one point and one shape
 */
#include "../dispatch.h"
#include "../filter/plane.h"
#include "cylint_distance.h"
#include "boundary.h"
#include "elliptic.h"
#include "exact_distance.h"
#include "one_distance.h"

size_t cylint_sizeof_closest(void)
{
    return sizeof(cylint_closest);
}

static const cylint_one_distances *kernels(void)
{
    return CYLINT_OF_BUILD(cylint_build_used(), &cylint_one_distances_plain,
                           &cylint_one_distances_fma,
                           &cylint_one_distances_fma);
}

/* There is no surface. */
static double nowhere(cylint_closest *answer)
{
    answer->part = -1;
    answer->feature = CYLINT_FEATURE_LATERAL;
    return answer->distance = HUGE_VAL;
}

ASIDE double by_exact_numbers(const cylint_shape *shape, const double point[3],
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
    if (want & CYLINT_WANT_GEOMETRY)
        cylint_nearest_point(&m, &n, want, answer);
    const double size = n.sign != 0 ? cylint_rounded_distance(&m, &n) : 0;
    return answer->distance = n.sign < 0 ? -size : size;
}

/* Whether the processor flushes subnormal numbers, and a coordinate of the point or
 * of an end can be one. */
static int flushes_a_coordinate(const cylint_shape *shape,
                                const double point[3])
{
    int small = 0;
    EACH(i, 3)
        small |= cylint_too_small(point[i]) |
                 cylint_too_small(cylint_base(shape)[i]) |
                 cylint_too_small(cylint_top(shape)[i]);
    return small && cylint_flushes_subnormals();
}

#define OF_BUILD(name) \
    CYLINT_OF_BUILD(cylint_build_used(), name##_plain, name##_fma, name##_fma)

/* A point for which cylint_contains() is 0.  Returns the members that are left:
 * all where its part is missing. */
ASIDE unsigned answer_on_boundary(const cylint_shape *shape,
                                  const double point[3], unsigned want,
                                  cylint_closest *answer)
{
    const int feature = cylint_boundary_feature(shape, point);
    const int elliptic = cylint_is_elliptic(shape->kind);
    if (feature == CYLINT_NO_FEATURE)
        return want;
    answer->distance = 0;
    if (want & CYLINT_WANT_PART) {
        answer->part = cylint_feature_part(feature);
        answer->feature = feature;
    }
    if (want & CYLINT_WANT_POINT)
        EACH(i, 3)
            answer->point[i] = cylint_positive_zero(point[i]);
    if (!(want & CYLINT_WANT_NORMAL))
        return 0;
    const int known =
        (elliptic ? OF_BUILD(cylint_elliptic_normal)
                  : kernels()->normal)(shape, point, feature, answer->normal);
    return known ? 0 : CYLINT_WANT_NORMAL;
}

static unsigned elliptic_in_pairs(const cylint_shape *shape,
                                  const double point[3], unsigned want,
                                  cylint_closest *answer)
{
    if (!cylint_rounds_to_nearest())
        return want;
    const unsigned left =
        OF_BUILD(cylint_elliptic_in_pairs)(shape, point, want, answer);
    return left & CYLINT_WANT_DISTANCE && cylint_contains(shape, point) == 0
               ? answer_on_boundary(shape, point, want, answer)
               : left;
}

/* Whether cylint_boundary_feature() serves the shape, and not the template. */
static int has_boundary(const cylint_shape *shape)
{
    return shape->kind == CYLINT_KIND_CYLINDER ||
           shape->kind == CYLINT_KIND_CONE;
}

/* The members of `want` that heads and tails, pairs and triples leave. */
static unsigned left_by_doubles(const cylint_shape *shape,
                                const double point[3], unsigned want,
                                cylint_closest *answer)
{
    const cylint_one_distances *k = kernels();
    const unsigned parted = want / CYLINT_WANT_PART & 1;
    if (!((unsigned)shape->ends | (want & CYLINT_WANT_GEOMETRY)) &&
        k->head_tail[shape->kind][parted] &&
        k->head_tail[shape->kind][parted](shape, point, answer))
        return 0;
    if (want & CYLINT_WANT_GEOMETRY && flushes_a_coordinate(shape, point))
        return want;
    if (cylint_is_elliptic(shape->kind))
        return elliptic_in_pairs(shape, point, want, answer);
    const unsigned left = k->pairs(shape, point, want, answer);
    if (!(left & CYLINT_ON_SURFACE) || cylint_contains(shape, point) != 0)
        return left;
    /* The point is on the boundary of the solid. */
    if (has_boundary(shape) &&
        (!cylint_surface_is_whole(shape->ends) || left & CYLINT_WANT_PART))
        return answer_on_boundary(shape, point, want, answer);
    if (!cylint_surface_is_whole(shape->ends) || left & CYLINT_WANT_PART)
        return left;
    answer->distance = 0;
    if (want & CYLINT_WANT_POINT)
        EACH(i, 3)
            answer->point[i] = cylint_positive_zero(point[i]);
    return left & CYLINT_WANT_NORMAL;
}

/* All answers that doubles leave. */
ASIDE double answer_beyond_doubles(const cylint_shape *shape,
                                   const double point[3], unsigned want,
                                   cylint_closest *answer)
{
    if (shape->kind == CYLINT_KIND_NONE || !cylint_is_finite(point)) {
        answer->flags = CYLINT_FLAG_INVALID;
        return nowhere(answer);
    }
    answer->flags = 0;
    if (cylint_is_plane(shape->kind) && want == 0 && cylint_in_range(shape) &&
        cylint_rounds_to_nearest() &&
        cylint_plane_distance(shape, point, &answer->distance))
        return answer->distance;
    if (!(want & (CYLINT_WANT_PART | CYLINT_WANT_GEOMETRY)) &&
        cylint_surface_is_whole(shape->ends) &&
        cylint_contains(shape, point) == 0)
        return answer->distance = 0;
    if (cylint_is_elliptic(shape->kind))
        return cylint_elliptic_distance(shape, point, want, answer);
    return by_exact_numbers(shape, point, want, answer);
}

#if CYLINT_IS_PARANOID
/* The answer is not the exact one; of elliptic kinds, not that of triples. */
static int contradicts(const cylint_shape *shape, const double point[3],
                       unsigned want, const cylint_closest *known)
{
    cylint_closest a;
    if (cylint_is_elliptic(shape->kind))
        cylint_elliptic_distance(shape, point, want, &a);
    else
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

/* From the closed solid.  Only the member `ends` differs from that of the shape. */
ASIDE double from_closed_solid(const cylint_shape *shape, const double point[3],
                               unsigned want, cylint_closest *answer)
{
    cylint_shape closed = *shape;
    closed.ends = cylint_closed_ends(shape->ends);
    return cylint_distance(&closed, point, want & ~(unsigned)CYLINT_SIGNED,
                           answer);
}

double cylint_distance(const cylint_shape *shape, const double point[3],
                       unsigned want, cylint_closest *answer)
{
    if (want & CYLINT_SIGNED && !cylint_surface_is_whole(shape->ends))
        return from_closed_solid(shape, point, want, answer);
    want &= CYLINT_WANT_PART | CYLINT_WANT_GEOMETRY;
    if (!cylint_prepared(shape) ||
        left_by_doubles(shape, point, want | CYLINT_WANT_DISTANCE, answer) != 0)
        return answer_beyond_doubles(shape, point, want, answer);
    answer->flags = 0;
#if CYLINT_IS_PARANOID
    cylint_contradiction(contradicts(shape, point, want, answer));
#endif
    return answer->distance;
}
