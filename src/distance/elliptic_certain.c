/*
 * elliptic_certain.c - the distance and the safety of elliptic kinds, where doubles
 * and pairs make them certain
 *
 * Doubles find the angle (elliptic_angle.h) and decide which feature is nearest
 * (elliptic_feature.h), where their errors leave no doubt; elliptic_pairs.h
 * computes the answer.
 *
 * Compiled once as it is and again for processors with a fused multiply-add: an
 * answer that is certain is the same in both.
 */
#define CYLINT_ONE_LANE
#include "one_distance.h"
#include "elliptic_pairs.h"

#ifndef CYLINT_ELLIPTIC_KERNELS
#define CYLINT_ELLIPTIC_KERNELS cylint_elliptic_kernels_plain
#endif

static int rounds_to(const bounded_pairs from[3], double to[3])
{
    int certain = 1;
    EACH(i, 3)
        certain &= m_any(rounds(from[i], &to[i]));
    return certain;
}

/* Whether a product of components other than 0 can underflow. */
static int has_tiny(const cylint_shape *s, const double point[3])
{
    int tiny = 0;
    EACH(i, 3) {
        const double x[4] = {point[i] - cylint_base(s)[i], cylint_a(s)[i],
                             cylint_b(s)[i], cylint_axis(s)[i]};
        EACH(k, 4)
            tiny |=
                fabs(x[k]) < CYLINT_ELLIPTIC_LEAST && cylint_sign(x[k]) != 0;
    }
    return tiny;
}

/* The effort of answer_in_pairs() to begin with: point and normal need the angle in
 * pairs (1), a distance near the surface needs triples (2). */
static int first_effort(const elliptic_question *q, unsigned want)
{
    if (q->side == 0 || (q->feature == CYLINT_FEATURE_LATERAL &&
                         fabs(q->plane.n) < CYLINT_NEEDS_TRIPLES * q->at.rho))
        return 2;
    return (want & CYLINT_WANT_GEOMETRY) != 0;
}

static unsigned elliptic_in_pairs(const cylint_shape *shape,
                                  const double point[3], unsigned want,
                                  cylint_closest *answer)
{
    elliptic_question q;
    elliptic_answer a;
    double d;
    int effort, certain;
    const unsigned all = want | CYLINT_ON_SURFACE;
    if ((want & CYLINT_WANT_GEOMETRY && has_tiny(shape, point)) ||
        !locate_question(&q, shape, point, 0) ||
        find_elliptic_feature(&q) == CYLINT_NO_FEATURE)
        return all;
    effort = first_effort(&q, want);
    do {
        answer_in_pairs(&a, &q, point, effort, want);
        certain = m_any(rounds(a.distance, &d));
    } while (!certain && effort++ < 2);
    if (want & CYLINT_WANT_NORMAL && !rounds_to(a.normal, answer->normal))
        return all;
    if (want & CYLINT_WANT_PART)
        cylint_write_feature(shape, q.feature, answer);
    /* untaken 1 of 6: every known certain distance has the sign of the side */
    if (!certain || d * q.side > 0 || !(fabs(d) >= CYLINT_DISTANCE_LEAST))
        return all & ~(unsigned)(CYLINT_WANT_PART | CYLINT_WANT_NORMAL);
    if (want & CYLINT_WANT_POINT && !rounds_to(a.point, answer->point))
        return all;
    answer->distance = cylint_surface_is_whole(shape->ends) ? d : fabs(d);
    return 0;
}

/* --------------------------------------------------------------- safety -- */

/* The distance from the lateral surface in doubles, less its error: outside a
 * convex one, no tangent plane is farther. */
static double lateral_distance_less(const elliptic_question *q)
{
    const int is_lower = q->plane.n > 0 && is_convex(q);
    return lateral_height(q) - lateral_error(q) -
           (is_lower ? 0 : q->by.distance);
}

/* The distance in doubles, less its error.  lint: the members that are read were
 * written when this feature was found. */
static double distance_less(const elliptic_question *q)
{
    const elliptic_place *p = &q->at;
    const double u = CYLINT_ELLIPTIC_SAFETY_ERROR;
    const double height = end_height(p, cylint_feature_end(q->feature)),
                 along = height - end_error(p, height);
    double F[3], out, up;
    switch (q->feature) {
    case CYLINT_FEATURE_LATERAL:
        return lateral_distance_less(q);
    case CYLINT_FEATURE_CAP0:
    case CYLINT_FEATURE_CAP1:
        return along;
    case CYLINT_FEATURE_APEX:
        load_from_axis(F, p, q->shape, apex_share(p));
        return sqrt(cylint_dot(F, F)) -
               u * (sum_of_sizes(p->D) +
                    fabs(apex_share(p)) * sum_of_sizes(cylint_axis(q->shape)));
    default:
        out = cylint_larger(lateral_distance_less(q), 0);
        up = cylint_larger(along, 0);
        return sqrt(out * out + up * up) * (1 - u);
    }
}

static double elliptic_safety(const cylint_shape *shape, const double point[3])
{
    elliptic_question q;
    return locate_question(&q, shape, point, 1) &&
                   find_elliptic_feature(&q) != CYLINT_NO_FEATURE
               ? distance_less(&q)
               : 0;
}

const cylint_elliptic_kernels CYLINT_ELLIPTIC_KERNELS = {elliptic_in_pairs,
                                                         elliptic_safety};
