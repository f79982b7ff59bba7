/*
 * elliptic_feature.h - which feature of an elliptic shape is nearest, in doubles
 *
 * Where the errors of doubles leave it uncertain, it is CYLINT_NO_FEATURE.  Bounded
 * shapes are convex.  Of a point outside, the nearest point of the solid is on the
 * lateral surface, if the foot of the perpendicular on it is between the ends; else
 * on the end beyond which the point is: on the cap, if the foot on its plane is in
 * the ellipse, else on the rim.  In its plane the rim is the section of a right
 * cylinder (project_on_end()).  Of a point inside, no plane of a cap and no
 * tangent plane is nearer than the surface, so it does not matter whether a foot is
 * within the ends.
 */
#ifndef CYLINT_ELLIPTIC_FEATURE_H
#define CYLINT_ELLIPTIC_FEATURE_H

#include "elliptic_certainty.h"
#include "nearest.h"

/* The height over the tangent plane, on either side, and its error. */
static inline double lateral_height(const elliptic_question *q)
{
    return fabs(q->plane.n) / q->plane.size;
}

static inline double lateral_error(const elliptic_question *q)
{
    const double turned = normal_error(&q->plane, &q->at);
    return q->at.error / q->plane.size + 2 * turned * lateral_height(q);
}

/* The same of the plane of an end. */
static inline double end_height(const elliptic_place *p, int end)
{
    return fabs(end ? p->z - 1 : p->z) / p->z_norm;
}

static inline double end_error(const elliptic_place *p, double height)
{
    return p->z_error / p->z_norm + 4 * p->relative * height;
}

/* 1: the point is certainly within the section at its z, -1: outside, 0:
 * uncertain. */
static inline int side_of_section(const elliptic_place *p)
{
    const double r = sqrt(p->x * p->x + p->y * p->y);
    return r > p->rho + p->error ? -1 : r < p->rho - p->error;
}

/* The error of l. */
static inline double slope_error(const elliptic_question *q)
{
    const double ratio = q->at.norm / q->plane.size;
    return 4 * (1 + ratio) *
           (q->at.error + normal_error(&q->plane, &q->at) * fabs(q->plane.n));
}

/* Where a number from 0 at the base to 1 at the top is: -1: below the base, 0:
 * between the ends, 1: above the top. */
static inline int zone_of(double z, double error)
{
    return z < -error                   ? -1
           : z > 1 + error              ? 1
           : z > error && z < 1 - error ? 0
                                        : CYLINT_SIGN_UNDECIDED;
}

static inline int zone_of_point(const elliptic_place *p)
{
    return zone_of(p->z, p->z_error);
}

/* Of the nearest point of the lateral surface. */
static inline int zone_of_foot(const elliptic_question *q)
{
    const elliptic_place *p = &q->at;
    return zone_of(q->foot.z,
                   q->foot.z_error + 4 * (p->z_error + p->z_norm * q->by.away));
}

/* lint: the analyzer takes three rounds of EACH for one */
/* The nearest point of the lateral surface without its ends. */
static inline int find_on_lateral(elliptic_question *q)
{
    const tangent_plane *t = &q->plane;
    if (!find_lateral_angle(&q->e, &q->plane, &q->at, q->rough))
        return 0;
    load_foot(q);
    q->by = uncertainty_of(q, fabs(t->slope_of_n - t->n * t->half_q / t->q) +
                                  slope_error(q));
    return is_foot_nearest(q);
}

/* The apex is at h times this from the base. */
static inline double apex_share(const elliptic_place *p)
{
    return -1 / p->slope;
}

/* Whether the foot of the perpendicular on each ruling is beyond the section at
 * h times `share` from the base, whose factor is f: above it if is_top, else below.
 * With v = h + (k - 1) u and F from the centre of the section that is
 * (F - f u).v > 0 or < 0.  F.u and u.h are at most the lengths of (F.a, F.b) and
 * (a.h, b.h); u.u is from 0 to a.a + b.b.  The apex is a section of factor 0: it is
 * nearest of its nappe without ends if the feet are beyond it. */
static inline int are_feet_beyond(const elliptic_question *q, double share,
                                  double f, int is_top)
{
    const double *a = cylint_a(q->shape), *b = cylint_b(q->shape),
                 *h = cylint_axis(q->shape);
    const double k1 = cylint_r1(q->shape) - 1;
    double F[3];
    load_from_axis(F, &q->at, q->shape, share);
    const double of_a = k1 * cylint_dot(F, a) - f * cylint_dot(a, h),
                 of_b = k1 * cylint_dot(F, b) - f * cylint_dot(b, h);
    const double up = (is_top ? 1 : -1) * cylint_dot(F, h);
    const double of_u = (is_top ? k1 : -k1) * f;
    const double sizes = sum_of_sizes(a) + sum_of_sizes(b);
    const double error =
        CYLINT_ELLIPTIC_SAFETY_ERROR *
        (sum_of_sizes(q->at.D) + fabs(share) * sum_of_sizes(h) + f * sizes) *
        (sum_of_sizes(h) + fabs(k1) * sizes);
    return up - sqrt(of_a * of_a + of_b * of_b) -
               (of_u > 0 ? of_u * (cylint_dot(a, a) + cylint_dot(b, b)) : 0) >
           error;
}

/* Whether the rim of an end without a cap, from within its right cylinder, is
 * nearest: on every ruling, and nearer than the plane of another cap. */
static inline int is_open_rim_nearest(const elliptic_question *q, int end)
{
    const elliptic_place *p = &q->at;
    const double across = lateral_height(q), along = end_height(p, end),
                 other = end_height(p, !end);
    return are_feet_beyond(q, end, p->rho, end) &&
           (cylint_caps_present(q->shape->ends) == 0 ||
            other - sqrt(across * across + along * along) >
                lateral_error(q) + end_error(p, other + along));
}

/* The nearest point of the end beyond which the lateral surface has its nearest
 * point: on the cap or the rim. */
static inline int feature_of_end(elliptic_question *q, int end)
{
    const double above = end ? q->at.z - 1 : -q->at.z;
    int feature = CYLINT_NO_FEATURE;
    project_on_end(&q->at, q->shape, end);
    q->side = side_of_section(&q->at);
    const int is_over = q->side > 0;
    /* untaken 1 of 6: no known point is over an end and not above it */
    if (q->side == 0 || (is_over && !(above > q->at.z_error)))
        return CYLINT_NO_FEATURE;
    if (is_over && cylint_caps_present(q->shape->ends) >> end & 1)
        feature = CYLINT_FEATURE_CAP0 + end;
    else if (find_on_lateral(q) && (!is_over || is_open_rim_nearest(q, end)))
        feature = CYLINT_FEATURE_RIM0 + end;
    q->side = -1;
    return feature;
}

/* Inside, and beside the lateral surface: that or the nearer of the caps that are
 * present.  A cap that is nearer than the lateral surface without ends has the foot
 * of the perpendicular on its plane; the foot on a lateral surface that is nearer
 * than both planes is between them. */
static inline int feature_inside(elliptic_question *q)
{
    const elliptic_place *p = &q->at;
    const unsigned caps = cylint_caps_present(q->shape->ends);
    const double lateral = lateral_height(q);
    const double low = caps & 1 ? p->z / p->z_norm : HUGE_VAL,
                 high = caps & 2 ? (1 - p->z) / p->z_norm : HUGE_VAL;
    const int end = high < low;
    const double cap = end ? high : low;
    const double error =
        q->by.distance + lateral_error(q) + 2 * end_error(p, 1 / p->z_norm);
    if (lateral < cap - error)
        return caps == 3 || zone_of_foot(q) == 0 ? CYLINT_FEATURE_LATERAL
                                                 : CYLINT_NO_FEATURE;
    if (q->side == 0 || !(cap < lateral - error) || !(fabs(high - low) > error))
        return CYLINT_NO_FEATURE;
    return CYLINT_FEATURE_CAP0 + end;
}

/* Beside the plane of a cap, on either side, and twice as far from the lateral
 * surface: no tangent plane is nearer than room / norm. */
static inline int feature_beside_cap(elliptic_question *q)
{
    const elliptic_place *p = &q->at;
    const int end = p->z > 0.5;
    const double off = fabs(end ? p->z - 1 : p->z) + p->z_error;
    const double room = p->rho - p->error - sqrt(p->x * p->x + p->y * p->y);
    return cylint_caps_present(q->shape->ends) >> end & 1 && off < 0x1p-10 &&
                   p->relative < 0x1p-10 && 2 * off * p->norm < room * p->z_norm
               ? CYLINT_FEATURE_CAP0 + end
               : CYLINT_NO_FEATURE;
}

/* Inside, or within the lateral surface beyond an end, or beside that surface. */
static inline int feature_within(elliptic_question *q)
{
    const int bounded = cylint_is_bounded(q->shape);
    const int zone = zone_of_point(&q->at);
    if (bounded && q->side && (zone == -1 || zone == 1))
        return feature_of_end(q, zone > 0);
    if (bounded && zone != 0)
        return feature_beside_cap(q);
    if (!find_on_lateral(q))
        return CYLINT_NO_FEATURE;
    return bounded ? feature_inside(q) : CYLINT_FEATURE_LATERAL;
}

/* Turns the point about the apex of a double cone: the distance from the other
 * nappe is then that from the nappe of the base. */
static inline void turn_place(elliptic_question *q)
{
    q->is_turned = !q->is_turned;
    q->at.x = -q->at.x;
    q->at.y = -q->at.y;
    q->at.rho = -q->at.rho;
}

static inline int feature_outside(elliptic_question *q)
{
    const cylint_shape *s = q->shape;
    const int bounded = cylint_is_bounded(s);
    const double k1 = q->at.slope;
    if (s->ends != CYLINT_ENDS_INFINITE && k1 != 0 &&
        are_feet_beyond(q, apex_share(&q->at), 0, k1 < 0)) {
        if (!bounded || cylint_sign(cylint_r1(s)) == 0)
            return CYLINT_FEATURE_APEX;
        return feature_of_end(q, k1 < 0);
    }
    /* The other nappe of an oblique double cone can be nearer. */
    int found = find_on_lateral(q);
    if (!found && !is_convex(q)) {
        turn_place(q);
        found = find_on_lateral(q);
    }
    if (!found)
        return CYLINT_NO_FEATURE;
    if (!bounded)
        return CYLINT_FEATURE_LATERAL;
    const int zone = zone_of_foot(q);
    return zone == 0                       ? CYLINT_FEATURE_LATERAL
           : zone == CYLINT_SIGN_UNDECIDED ? CYLINT_NO_FEATURE
                                           : feature_of_end(q, zone > 0);
}

/* Whether no product of lengths overflows; of NaN, not. */
static inline int is_ordinary_question(const cylint_shape *s,
                                       const double point[3])
{
    double size[3];
    EACH(i, 3)
        size[i] = (fabs(point[i] - cylint_base(s)[i]) + fabs(cylint_a(s)[i])) +
                  (fabs(cylint_b(s)[i]) + fabs(cylint_axis(s)[i]));
    return (size[0] + size[1]) + (size[2] + fabs(cylint_r1(s))) <=
           CYLINT_ELLIPTIC_MOST;
}

/* Writes the members but those of a feature.  Returns 0 if products of lengths can
 * overflow. */
static inline int locate_question(elliptic_question *q, const cylint_shape *s,
                                  const double point[3], int rough)
{
    elliptic_place *p = &q->at;
    if (!is_ordinary_question(s, point))
        return 0;
    q->shape = s;
    q->rough = rough;
    locate(p, s, point,
           rough ? CYLINT_ELLIPTIC_SAFETY_ERROR : CYLINT_ELLIPTIC_ERROR);
    q->is_turned = 0;
    if (s->ends == CYLINT_ENDS_INFINITE && p->rho < 0)
        turn_place(q);
    q->side = side_of_section(p);
    if (q->side > 0 && cylint_is_bounded(s))
        q->side = zone_of_point(p) != CYLINT_SIGN_UNDECIDED;
    return 1;
}

static inline int find_elliptic_feature(elliptic_question *q)
{
    return q->feature = q->side < 0                ? feature_outside(q)
                        : q->side > 0 || !q->rough ? feature_within(q)
                                                   : CYLINT_NO_FEATURE;
}

#endif
