/*
 * one_distance.c - the kernels for one point and one shape: distance_template.h
 * at one lane
 *
 * Compiled once as it is and again for processors with a fused multiply-add: an
 * answer that is certain is the same in both.
 */
#define CYLINT_ONE_LANE
#include "describe_nearest.h"
#include "find_nearest.h"
#include "head_tail.h"
#include "near_surface.h"
#include "one_distance.h"

#ifndef CYLINT_ONE_DISTANCES
#define CYLINT_ONE_DISTANCES cylint_one_distances_plain
#endif

/* -------------------------------------------------------- heads and tails -- */

INLINE int head_tail_distance(const cylint_shape *shape, const double point[3],
                              int kind, int with_part, cylint_closest *answer)
{
    const cylint_shape *const at[1] = {shape};
    shape_lanes s;
    half_plane m;
    vnearest n;
    head_tail_load_shapes(&s, at);
    head_tail_load(&m, &s, point, kind != CYLINT_KIND_SPHERE);
    head_tail_nearest(&n, &m, &s, kind, with_part);
    if (!(n.d.high <= n.d.low) || !n.certain || !cylint_rounds_to_nearest())
        return 0;
    if (with_part)
        cylint_write_feature(shape, (int)n.feature, answer);
    answer->distance = n.d.low;
    /* mutant '1' -> '2': only whether it is 0 is used */
    return 1;
}

/* ------------------------------------------------------ pairs and triples -- */

/* Writes the members of `want` that are certain; returns the others. */
INLINE unsigned write_certain(vnearest *n, const half_plane *m,
                              const shape_lanes *s, const cylint_shape *shape,
                              const double point[3], int kind, unsigned want,
                              cylint_closest *answer)
{
    /* mutant '>' -> '>=': slower, where a distance of 0 has no error */
    if (!(fabs(rounded(n->d.value)) > n->d.error)) {
        want |= CYLINT_ON_SURFACE;
    } else if (!is_certain(&n->d)) {
        /* by copies: other questions keep m and n in registers */
        const vnearest nearest = *n;
        const half_plane copy = *m;
        n->d = distance_in_triples(&nearest, &copy, shape, point);
    }
    if (!(want & CYLINT_ON_SURFACE) && is_certain(&n->d)) {
        answer->distance =
            cylint_surface_is_whole(shape->ends) ? n->d.low : fabs(n->d.low);
        want &= ~(unsigned)CYLINT_WANT_DISTANCE;
    }
    if (!n->certain)
        return want;
    if (want & CYLINT_WANT_PART)
        cylint_write_feature(shape, (int)n->feature, answer);
    want &= ~(unsigned)CYLINT_WANT_PART;
    /* mutant '!' -> '': slower, the members are left to the next stage */
    if (!(want & CYLINT_WANT_GEOMETRY))
        return want;
    described_point to;
    describe_nearest(&to, n, m, s, point, kind);
    if (want & CYLINT_WANT_POINT && to.point_certain) {
        EACH(i, 3)
            answer->point[i] = to.point[i];
        want &= ~(unsigned)CYLINT_WANT_POINT;
    }
    if (want & CYLINT_WANT_NORMAL && to.normal_certain) {
        EACH(i, 3)
            answer->normal[i] = to.normal[i];
        want &= ~(unsigned)CYLINT_WANT_NORMAL;
    }
    return want;
}

/* Whether the nearest point or the normal depends on the direction from the axis,
 * and pairs have too few digits of it. */
INLINE int needs_direction(const vnearest *n, const half_plane *m, int kind)
{
    return n->certain && kind != CYLINT_KIND_SPHERE &&
           /* mutant '<' -> '<=', '&&' -> '||': slower, triples have all digits */
           !(m->rho_error < CYLINT_NEEDS_DIRECTION * m->rho.hi) &&
           /* mutant '&&' -> '||': slower */
           n->feature != CYLINT_FEATURE_CAP0 &&
           n->feature != CYLINT_FEATURE_CAP1;
}

/* kind: of the shape; a constant for spheres, which have no axis. */
INLINE unsigned answer_in_pairs(const cylint_shape *shape, int kind,
                                const double point[3], unsigned want,
                                cylint_closest *answer)
{
    const int tangent = cylint_has_tangent(kind);
    const int straight = tangent ? CYLINT_KIND_CONE : kind;
    shape_lanes s;
    half_plane m;
    vnearest n;
    find_nearest_in_pairs(&n, &m, &s, point, shape, straight, tangent);
    /* mutant '&&' -> '||': slower */
    if (want & CYLINT_WANT_GEOMETRY && needs_direction(&n, &m, kind)) {
        half_plane copy = m;
        find_direction(&copy, shape, point);
        m = copy;
    }
    return write_certain(&n, &m, &s, shape, point, straight, want, answer);
}

static unsigned in_pairs(const cylint_shape *shape, const double point[3],
                         unsigned want, cylint_closest *answer)
{
    if (shape->kind != CYLINT_KIND_SPHERE)
        return answer_in_pairs(shape, shape->kind, point, want, answer);
    return cylint_part_is_present(shape->ends, cylint_surface(shape))
               ? answer_in_pairs(shape, CYLINT_KIND_SPHERE, point, want, answer)
               : want; /* no surface */
}

/* ------------------------------------------------------------- kernels -- */

#define KERNEL(name, kind, with_part)                                     \
    static int name(const cylint_shape *shape, const double point[3],     \
                    cylint_closest *answer)                               \
    {                                                                     \
        return head_tail_distance(shape, point, kind, with_part, answer); \
    }
#define KERNELS(name, kind)       \
    KERNEL(name##_alone, kind, 0) \
    KERNEL(name##_with_part, kind, 1)
KERNELS(cylinder, CYLINT_KIND_CYLINDER)
KERNELS(cone, CYLINT_KIND_CONE)
KERNELS(sphere, CYLINT_KIND_SPHERE)
KERNELS(capsule, CYLINT_KIND_CAPSULE)
KERNELS(round_cone, CYLINT_KIND_RCONE)

const cylint_one_distances CYLINT_ONE_DISTANCES = {
    {[CYLINT_KIND_CYLINDER] = {cylinder_alone, cylinder_with_part},
     [CYLINT_KIND_CONE] = {cone_alone, cone_with_part},
     [CYLINT_KIND_SPHERE] = {sphere_alone, sphere_with_part},
     [CYLINT_KIND_CAPSULE] = {capsule_alone, capsule_with_part},
     [CYLINT_KIND_RCONE] = {round_cone_alone, round_cone_with_part}},
    in_pairs};
