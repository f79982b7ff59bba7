/*
 * distance.c - one point and one shape
 */
#include "../dispatch.h"
#include "../filter/plane.h"
#include "cylint_distance.h"
#include "exact_distance.h"
#include "one_distance.h"
#include "triple.h"

size_t cylint_sizeof_closest(void)
{
    return sizeof(cylint_closest);
}

/* There is no surface. */
static double nowhere(cylint_closest *answer)
{
    answer->part = -1;
    answer->feature = CYLINT_FEATURE_LATERAL;
    return answer->distance = HUGE_VAL;
}

/* The same as by_exact_numbers().  side: cylint_contains() of the point, if the
 * surface encloses the solid. */
ASIDE double by_meridian(const cylint_shape *shape, const double point[3],
                         unsigned want, int side, cylint_closest *answer)
{
    meridian m;
    cylint_load_meridian(&m, shape, point);
    const int feature = cylint_nearest_feature(&m);
    if (feature == CYLINT_NO_FEATURE)
        return nowhere(answer);
    if (want & CYLINT_WANT_PART)
        cylint_write_feature(shape, feature, answer);
    if (want & CYLINT_WANT_GEOMETRY)
        cylint_nearest_point(&m, feature, want, answer);
    if (want & CYLINT_WANT_DISTANCE) {
        const double size =
            side != 0 ? cylint_rounded_distance(&m, feature) : 0;
        answer->distance = side > 0 ? -size : size;
    }
    return answer->distance;
}

/* Writes the members `want`, with CYLINT_WANT_DISTANCE the distance.  The side is
 * computed before, so that one arena at a time is on the stack. */
static double by_exact_numbers(const cylint_shape *shape, const double point[3],
                               unsigned want, cylint_closest *answer)
{
    const int is_wanted = (want & CYLINT_WANT_DISTANCE) != 0;
    const int side = is_wanted && cylint_surface_is_whole(shape->ends)
                         ? cylint_contains(shape, point)
                         : -1;
    return by_meridian(shape, point, want, side, answer);
}

/* Whether the processor flushes subnormal numbers, and a sum with a radius or with
 * a coordinate of the point or of an end can have a subnormal low part. */
static int flushes_a_number(const cylint_shape *shape, const double point[3])
{
    int small =
        cylint_too_small(cylint_r0(shape)) | cylint_too_small(cylint_r1(shape));
    EACH(i, 3)
        small |= cylint_too_small(point[i]) |
                 cylint_too_small(cylint_base(shape)[i]) |
                 cylint_too_small(cylint_top(shape)[i]);
    return small && cylint_flushes_subnormals();
}

/* Writes the members `undecided` of a point for which cylint_contains() is 0.
 * Returns those that stay undecided: all where its part is missing. */
ASIDE unsigned answer_on_boundary(const cylint_shape *shape,
                                  const double point[3], unsigned want,
                                  unsigned undecided, cylint_closest *answer)
{
    if (!cylint_surface_is_whole(shape->ends) || undecided & CYLINT_WANT_PART) {
        const int feature = cylint_boundary_feature(shape, point);
        if (feature == CYLINT_NO_FEATURE)
            return want;
        if (want & CYLINT_WANT_PART)
            cylint_write_feature(shape, feature, answer);
    }
    answer->distance = 0;
    if (want & CYLINT_WANT_POINT)
        EACH(i, 3)
            answer->point[i] = cylint_positive_zero(point[i]);
    return undecided & CYLINT_WANT_NORMAL;
}

/* Writes what pairs and triples decide; returns the others. */
CYLINT_INLINE unsigned by_pairs(const cylint_shape *shape,
                                const double point[3], unsigned want,
                                cylint_closest *answer)
{
    if (!cylint_rounds_to_nearest() || flushes_a_number(shape, point))
        return want;
    cylint_in_pairs *const in_pairs =
        cylint_is_elliptic(shape->kind)
            ? CYLINT_OF_FMA(cylint_elliptic_kernels)->pairs
            : CYLINT_OF_FMA(cylint_one_distances)->pairs;
    const unsigned undecided = in_pairs(shape, point, want, answer);
    return undecided & CYLINT_ON_SURFACE && cylint_contains(shape, point) == 0
               ? answer_on_boundary(shape, point, want, undecided, answer)
               : undecided;
}

/* The same, with heads and tails first. */
static unsigned by_doubles(const cylint_shape *shape, const double point[3],
                           unsigned want, cylint_closest *answer)
{
    const cylint_one_distances *k = CYLINT_OF_FMA(cylint_one_distances);
    const unsigned with_part = want / CYLINT_WANT_PART & 1;
    if (!((unsigned)shape->ends | (want & CYLINT_WANT_GEOMETRY)) &&
        k->head_tail[shape->kind][with_part] &&
        k->head_tail[shape->kind][with_part](shape, point, answer))
        return 0;
    return by_pairs(shape, point, want, answer);
}

/* x.n in triples: cylint_along_normal() near the plane. */
static bounded_pair along_normal_in_triples(const pair x[3], const double n[3])
{
    triple D[3], N[3];
    double size = 0;
    EACH(i, 3) {
        D[i] = triple_of_pair(x[i]);
        N[i] = triple_of(n[i]);
        size += fabs(x[i].hi * n[i]);
    }
    return (bounded_pair){pair_of_triple(triple_dot_doubles(D, N)),
                          CYLINT_CLOSE_ERROR * size + 0x1p-900};
}

/* Of a half-space.  The nearest point is the hit of the line along the normal.
 * Returns 0 where pairs, and triples near the plane, are not certain. */
static int answer_for_plane(const cylint_shape *shape, const double point[3],
                            unsigned want, cylint_closest *answer)
{
    const unsigned geometry = want & CYLINT_WANT_GEOMETRY;
    const double *const normal = cylint_axis(shape);
    double *const distance = &answer->distance;
    pair from[3];
    cylint_line line;
    cylint_hit hit;
    if (!cylint_in_range(shape) || !cylint_rounds_to_nearest() ||
        !cylint_from_plane(shape, point, from) ||
        (!cylint_plane_distance(shape, from, cylint_along_normal(from, normal),
                                distance) &&
         !cylint_plane_distance(
             shape, from, along_normal_in_triples(from, normal), distance)))
        return 0;
    /* untaken 1 of 4: a normal in range is a direction */
    if (geometry &&
        (cylint_whole_line(&line, point, cylint_axis(shape)) != CYLINT_OK ||
         cylint_plane_members(shape, &line, geometry, &hit) != 0))
        return 0;
    if (want & CYLINT_WANT_PART)
        cylint_write_feature(shape, CYLINT_FEATURE_LATERAL, answer);
    if (want & CYLINT_WANT_POINT)
        memcpy(answer->point, hit.point, sizeof hit.point);
    if (want & CYLINT_WANT_NORMAL)
        memcpy(answer->normal, hit.normal, sizeof hit.normal);
    return 1;
}

/* All answers that pairs do not decide.  undecided: the members to compute; of an
 * elliptic kind all wanted ones are. */
ASIDE double answer_beyond_doubles(const cylint_shape *shape,
                                   const double point[3], unsigned want,
                                   unsigned undecided, cylint_closest *answer)
{
    if (shape->kind == CYLINT_KIND_NONE || !cylint_is_finite(point)) {
        answer->flags = CYLINT_FLAG_INVALID;
        return nowhere(answer);
    }
    answer->flags = 0;
    if (cylint_is_plane(shape->kind) &&
        answer_for_plane(shape, point, want, answer))
        return answer->distance;
    if (!(want & (CYLINT_WANT_PART | CYLINT_WANT_GEOMETRY)) &&
        cylint_surface_is_whole(shape->ends) &&
        cylint_contains(shape, point) == 0)
        return answer->distance = 0;
    if (cylint_is_elliptic(shape->kind))
        return cylint_elliptic_distance(shape, point, want, answer);
    return by_exact_numbers(shape, point, undecided, answer);
}

#if CYLINT_IS_PARANOID
/* Whether the answer differs from the exact one.  Of elliptic kinds, from that of
 * triples, in which a component far below its terms is 0 (elliptic.c). */
static int contradicts(const cylint_shape *shape, const double point[3],
                       unsigned want, const cylint_closest *answer)
{
    cylint_closest a;
    const int elliptic = cylint_is_elliptic(shape->kind);
    if (elliptic)
        cylint_elliptic_distance(shape, point, want, &a);
    else
        by_exact_numbers(shape, point, want | CYLINT_WANT_DISTANCE, &a);
    int wrong = a.distance != answer->distance;
    if (want & CYLINT_WANT_PART)
        /* mutant '!=' -> '==': an effect with PARANOID=1 only */
        wrong |= a.part != answer->part || a.feature != answer->feature;
    for (int i = 0; i < 3; i++) {
        /* mutant '&&' -> '||': an effect with PARANOID=1 only */
        wrong |= want & CYLINT_WANT_POINT && a.point[i] != answer->point[i] &&
                 !(elliptic && cylint_sign(a.point[i]) == 0);
        wrong |= want & CYLINT_WANT_NORMAL &&
                 a.normal[i] != answer->normal[i] &&
                 !(elliptic && cylint_sign(a.normal[i]) == 0);
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
    unsigned undecided = want | CYLINT_WANT_DISTANCE;
    if (cylint_prepared(shape))
        undecided = by_doubles(shape, point, undecided, answer);
    if (undecided)
        return answer_beyond_doubles(shape, point, want, undecided, answer);
    answer->flags = 0;
#if CYLINT_IS_PARANOID
    cylint_contradiction(contradicts(shape, point, want, answer));
#endif
    return answer->distance;
}

double cylint_distance_alone(const cylint_shape *shape, const double point[3],
                             cylint_closest *answer, int *proved)
{
    *proved = cylint_prepared(shape) &&
              by_pairs(shape, point, CYLINT_WANT_DISTANCE, answer) == 0;
    return *proved ? answer->distance
                   : answer_beyond_doubles(shape, point, 0,
                                           CYLINT_WANT_DISTANCE, answer);
}
