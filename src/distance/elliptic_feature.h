/*
 * elliptic_feature.h - which feature of an elliptic shape is nearest, in doubles
 *
 * Where the errors of doubles leave it uncertain, it is CYLINT_NO_FEATURE.  Bounded
 * shapes are convex.  Of a point outside, the nearest point of the solid is on the
 * lateral surface, if the foot of the perpendicular on it is between the ends; else
 * on the end beyond which the point is: on the cap, if the foot on its plane is in
 * the ellipse, else on the rim.  Of a point inside, no plane of a cap and no
 * tangent plane is nearer than the surface, so it does not matter whether a foot is
 * within the ends.
 */
#ifndef CYLINT_ELLIPTIC_FEATURE_H
#define CYLINT_ELLIPTIC_FEATURE_H

#include "elliptic_certainty.h"
#include "nearest.h"

/* A question in doubles. */
typedef struct {
    const cylint_shape *shape;
    elliptic_place at;
    int feature, is_turned;
    /* 1: within the lateral surface, -1: outside it, 0: uncertain: beside it or,
     * within it, beside the plane of an end */
    int side;
    double room; /* rho less the distance from the axis, at least */
    int rough;   /* a rough angle is enough */
    angle e;
    tangent_plane plane;
    rim_place rim;
    uncertainty by;   /* of the angle in doubles */
    double curvature; /* 0: outside, not near the lateral surface */
} elliptic_question;

/* n / |N|, less the errors of both. */
static inline double height_less(double n, double error, double size,
                                 double size_error)
{
    return (n - error) /
           (size * (1 + CYLINT_ELLIPTIC_SAFETY_ERROR) + size_error);
}

/* The same for a tangent plane. */
static inline double plane_less(const tangent_plane *t, double n,
                                const elliptic_place *p)
{
    return height_less(n, p->error, sqrt(t->q), 4 * p->relative * p->norm);
}

/* The error of R of the rim is at most CYLINT_ELLIPTIC_SAFETY_ERROR of this. */
static inline double size_of_rim(const elliptic_question *q)
{
    const rim_place *r = &q->rim;
    return sum_of_sizes(q->at.D) + sum_of_sizes(r->F) +
           r->f * (sum_of_sizes(r->u) + sum_of_sizes(r->v));
}

/* The error of l. */
static inline double slope_error(const elliptic_question *q)
{
    const double ratio = q->at.norm / sqrt(q->plane.q);
    return 4 * (1 + ratio) *
           (q->at.error + normal_error(&q->plane, &q->at) * fabs(q->plane.n));
}

/* z of the foot on the tangent plane is that of the point less `down`. */
typedef struct {
    double down, error;
} foot_on_plane;

static inline foot_on_plane drop_on_plane(const elliptic_question *q)
{
    const tangent_plane *t = &q->plane;
    const elliptic_place *p = &q->at;
    const double size = sqrt(t->q), h = fabs(t->n) / size;
    return (foot_on_plane){
        t->n / t->q * cylint_dot(t->N, p->Z),
        4 * p->z_norm *
            (p->error / size +
             h * (normal_error(&q->plane, &q->at) + p->relative))};
}

/* rho at the foot, at least. */
static inline double rho_at_foot(const elliptic_question *q)
{
    const foot_on_plane foot = drop_on_plane(q);
    return q->at.rho - q->at.slope * foot.down - q->at.error -
           fabs(q->at.slope) * foot.error;
}

/* The uncertainty for all l up to this one. */
ASIDE uncertainty uncertainty_of_plane(const elliptic_question *q, double l)
{
    return q->curvature > 0
               ? inside_lateral_surface(&q->plane, &q->at, l, q->curvature)
               : outside_lateral(&q->plane, &q->at, l, rho_at_foot(q));
}

/* Where the nearest point of the lateral surface is: below the base, between the
 * ends, beyond the top. */
typedef struct {
    int is_before, is_within, is_after;
} foot_place;

static inline foot_place place_of_foot(const elliptic_question *q)
{
    const elliptic_place *p = &q->at;
    const foot_on_plane foot = drop_on_plane(q);
    const double z = p->z - foot.down;
    const double error = foot.error + 4 * (p->z_error + p->z_norm * q->by.away);
    return (foot_place){z<-error, z> error && z<1 - error, z> 1 + error};
}

/* lint: the analyzer takes three rounds of EACH for one */
/* The nearest point of the lateral surface without its ends. */
static inline int find_on_lateral(elliptic_question *q)
{
    if (!find_lateral_angle(&q->e, &q->plane, &q->at, q->rough))
        return 0;
    const tangent_plane *t = &q->plane;
    const double l =
        fabs(t->slope_of_n - t->n * t->half_q / t->q) + slope_error(q);
    q->curvature = curvature_beside(t, &q->at, l);
    if (!(q->curvature > 0) && q->side > 0)
        q->curvature = inner_curvature(t, &q->at);
    q->by = uncertainty_of_plane(q, l);
    return normal_error(&q->plane, &q->at) < 0x1p-10 &&
           (q->curvature > 0 || (q->side < 0 && rho_at_foot(q) > 0));
}

static inline int find_on_rim(elliptic_question *q, int end)
{
    find_rim_angle(&q->e, &q->rim, q->shape, &q->at, end, q->rough);
    const rim_place *r = &q->rim;
    const double g = r->f * (fabs(cylint_dot(r->R, r->v)) +
                             CYLINT_ELLIPTIC_SAFETY_ERROR * size_of_rim(q) *
                                 sum_of_sizes(r->v));
    q->curvature = rim_curvature(r);
    if (!(q->curvature > 0))
        return CYLINT_NO_FEATURE;
    q->by = of_rim(r, g, q->curvature);
    return CYLINT_FEATURE_RIM0 + end;
}

/* Whether the foot of the perpendicular on the plane of an end is in the ellipse:
 * 1, 0, or -1 where it is not certain. */
static inline int is_over_end(const elliptic_question *q, int end)
{
    const elliptic_place *p = &q->at;
    const double up = (end ? p->z - 1 : p->z) / (p->z_norm * p->z_norm);
    const double x = p->x - up * cylint_dot(p->Z, p->X),
                 y = p->y - up * cylint_dot(p->Z, p->Y);
    const double f = cylint_end_factor(q->shape, end);
    const double error = 4 * (p->error + p->norm / p->z_norm * p->z_error) +
                         8 * p->relative * p->norm * p->z_norm * fabs(up);
    const double r = sqrt(x * x + y * y);
    return r < f - error ? 1 : r > f + error ? 0 : -1;
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
    const double k1 = q->at.slope;
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

/* The rim of an end without a cap, from within the lateral surface beyond it, if
 * it is nearest on every ruling and nearer than the plane of another cap. */
static inline int feature_of_open_end(elliptic_question *q, int end)
{
    const elliptic_place *p = &q->at;
    const int is_open = cylint_caps_present(q->shape->ends) == 0;
    const double f = cylint_end_factor(q->shape, end);
    /* untaken 1 of 4: no known point is over the apex */
    if (cylint_sign(f) == 0 || !are_feet_beyond(q, end, f, end))
        return CYLINT_NO_FEATURE;
    const int rim = find_on_rim(q, end);
    const double cap = height_less(end ? p->z : 1 - p->z, p->z_error, p->z_norm,
                                   4 * p->relative * p->z_norm);
    return rim == CYLINT_NO_FEATURE || is_open ||
                   cap > sqrt(cylint_dot(q->rim.R, q->rim.R)) +
                             CYLINT_ELLIPTIC_SAFETY_ERROR * size_of_rim(q)
               ? rim
               : CYLINT_NO_FEATURE;
}

/* The nearest point of the end beyond which the lateral surface has its nearest
 * point. */
static inline int feature_of_end(elliptic_question *q, int end)
{
    const double above = end ? q->at.z - 1 : -q->at.z;
    const unsigned caps = cylint_caps_present(q->shape->ends);
    const int over = is_over_end(q, end);
    q->side = -1;
    /* untaken 1 of 4: no known point is over an end and certainly below it */
    if (over && !(above < -q->at.z_error)) {
        /* untaken 1 of 4: nor next to its plane */
        if (over < 0 || !(above > q->at.z_error))
            return CYLINT_NO_FEATURE;
        if (!(caps >> end & 1))
            return feature_of_open_end(q, end);
        return CYLINT_FEATURE_CAP0 + end;
    }
    const int is_apex = cylint_sign(cylint_end_factor(q->shape, end)) == 0;
    /* untaken 1 of 2: an apex is found before */
    return is_apex ? CYLINT_NO_FEATURE : find_on_rim(q, end);
}

/* Inside, and beside the lateral surface: that or the nearer of the caps that are
 * present.  A cap that is nearer than the lateral surface without ends has the foot
 * of the perpendicular on its plane; the foot on a lateral surface that is nearer
 * than both planes is between them. */
static inline int feature_inside(elliptic_question *q)
{
    const elliptic_place *p = &q->at;
    const unsigned caps = cylint_caps_present(q->shape->ends);
    const double size = sqrt(q->plane.q), lateral = fabs(q->plane.n) / size;
    const double low = caps & 1 ? p->z / p->z_norm : HUGE_VAL,
                 high = caps & 2 ? (1 - p->z) / p->z_norm : HUGE_VAL;
    const int end = high < low;
    const double cap = end ? high : low;
    const double error = 4 * (p->z_error / p->z_norm + p->error / size) +
                         q->by.distance +
                         8 * p->relative * (1 / p->z_norm + lateral);
    if (lateral < cap - error)
        return caps == 3 || place_of_foot(q).is_within ? CYLINT_FEATURE_LATERAL
                                                       : CYLINT_NO_FEATURE;
    if (q->side == 0 || !(cap < lateral - error) || !(fabs(high - low) > error))
        return CYLINT_NO_FEATURE;
    return CYLINT_FEATURE_CAP0 + end;
}

static inline int is_between_ends(const elliptic_place *p)
{
    return p->z > p->z_error && p->z < 1 - p->z_error;
}

static inline int is_beyond_end(const elliptic_place *p, int end)
{
    return end ? p->z > 1 + p->z_error : p->z < -p->z_error;
}

/* Beside the plane of a cap, on either side, and twice as far from the lateral
 * surface: no tangent plane is nearer than room / norm. */
static inline int feature_beside_cap(elliptic_question *q)
{
    const elliptic_place *p = &q->at;
    const int end = p->z > 0.5;
    const double off = fabs(end ? p->z - 1 : p->z) + p->z_error;
    return cylint_caps_present(q->shape->ends) >> end & 1 && off < 0x1p-10 &&
                   p->relative < 0x1p-10 &&
                   2 * off * p->norm < q->room * p->z_norm
               ? CYLINT_FEATURE_CAP0 + end
               : CYLINT_NO_FEATURE;
}

/* Inside, or within the lateral surface beyond an end, or beside that surface. */
static inline int feature_within(elliptic_question *q)
{
    const int bounded = cylint_is_bounded(q->shape);
    const int above = is_beyond_end(&q->at, 1);
    if (bounded && q->side && (above || is_beyond_end(&q->at, 0)))
        return feature_of_end(q, above);
    if (bounded && !is_between_ends(&q->at))
        return feature_beside_cap(q);
    if (!find_on_lateral(q))
        return CYLINT_NO_FEATURE;
    return bounded ? feature_inside(q) : CYLINT_FEATURE_LATERAL;
}

/* Turns a point beside the other nappe of a double cone about the apex. */
static inline void turn_place(elliptic_place *p)
{
    p->x = -p->x;
    p->y = -p->y;
    p->rho = -p->rho;
}

/* Whether the other nappe of a double cone is farther: above one of its tangent
 * planes. */
static inline int is_nearer_nappe(const elliptic_question *q)
{
    const tangent_plane *t = &q->plane;
    const double relative =
        CYLINT_ELLIPTIC_SAFETY_ERROR + normal_error(t, &q->at);
    const double most =
        (t->n + q->at.error) / (sqrt(t->q) * (1 - relative)) + q->by.distance;
    elliptic_place turned = q->at;
    tangent_plane other;
    turn_place(&turned);
    load_tangent_plane(&other, &turned, (angle){-q->e.cos, -q->e.sin});
    return plane_less(&other, other.n, &turned) > most;
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
    if (!find_on_lateral(q))
        return CYLINT_NO_FEATURE;
    if (!bounded)
        return s->ends != CYLINT_ENDS_INFINITE || k1 == 0 || is_nearer_nappe(q)
                   ? CYLINT_FEATURE_LATERAL
                   : CYLINT_NO_FEATURE;
    const foot_place foot = place_of_foot(q);
    return foot.is_within   ? CYLINT_FEATURE_LATERAL
           : foot.is_before ? feature_of_end(q, 0)
           : foot.is_after  ? feature_of_end(q, 1)
                            : CYLINT_NO_FEATURE;
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
    q->is_turned = s->ends == CYLINT_ENDS_INFINITE && p->rho < 0;
    if (q->is_turned)
        turn_place(p);
    const double r = sqrt(p->x * p->x + p->y * p->y);
    q->room = p->rho - p->error - r;
    q->side = r > p->rho + p->error ? -1 : q->room > 0;
    if (q->side > 0 && cylint_is_bounded(s))
        q->side =
            is_between_ends(p) || is_beyond_end(p, 0) || is_beyond_end(p, 1);
    return 1;
}

static inline int find_elliptic_feature(elliptic_question *q)
{
    return q->feature = q->side < 0                ? feature_outside(q)
                        : q->side > 0 || !q->rough ? feature_within(q)
                                                   : CYLINT_NO_FEATURE;
}

#endif
