/*
 * certified_distance.c - the distance of a point from pairs of doubles
 *
 * In the half plane through the axis and the point, with the coordinates z along
 * the axis and rho across it, the lateral surface is a line with the direction
 * (cosine, sine).  It is at the distance cosine rho - sine z = offset from the
 * base.  The coordinates are computed in pairs.  Doubles decide which feature
 * is nearest, unless the point is near a boundary between two features; then
 * the answer is "undecided".  Pairs give the distance.
 *
 * Compiled once as it is and again for processors with a fused multiply-add:
 * a distance that is certain is the same in both.
 */
#define CYLINT_NARROW
#include "certified_distance.h"

#include "half_plane.h"

#ifndef CYLINT_CERTIFIED
#define CYLINT_CERTIFIED cylint_certified_plain
#endif

#if LANES == 2

/* The features cap0 and cap1 have the numbers of the parts. */
enum { UNDECIDED = -1 };

/* The lateral line. */
typedef struct {
    pair z[2], rho[2]; /* its ends */
    pair cosine, sine, offset;
    pair height;
    double r[2];
} profile;

static pair plain(double x)
{
    return (pair){x, 0};
}

/* The profile of a cylinder or a cone. */
INLINE void load_profile(profile *p, const cylint_shape *s, int tapered)
{
    const cylint_local *f = &s->local;
    p->height = (pair){f->height, f->height_lo};
    p->z[0] = plain(0);
    p->z[1] = p->height;
    p->r[0] = s->r0;
    p->r[1] = s->r1;
    p->rho[0] = plain(s->r0);
    p->rho[1] = plain(s->r1);
    p->cosine = tapered ? (pair){f->cosine, f->cosine_lo} : plain(1);
    p->sine = tapered ? (pair){f->sine, f->sine_lo} : plain(0);
    p->offset = tapered ? lazy_mul(p->cosine, p->rho[0]) : p->rho[0];
}

/* That of the convex hull of two balls: the lateral line touches them. */
static void load_hull_profile(profile *p, const cylint_shape *s)
{
    const cylint_local *f = &s->local;
    p->height = (pair){f->height, f->height_lo};
    p->cosine = (pair){f->cosine, f->cosine_lo};
    p->sine = (pair){f->sine, f->sine_lo};
    p->r[0] = s->r0;
    p->r[1] = s->r1;
    p->offset = plain(s->r0);
    EACH(i, 2) {
        const pair z = i ? p->height : plain(0);
        p->z[i] = lazy_sub(z, lazy_mul(p->sine, plain(p->r[i])));
        p->rho[i] = lazy_mul(p->cosine, plain(p->r[i]));
    }
}

/* --------------------------------------------------- pairs: distances -- */

INLINE pair from_line(const half_plane *m, const profile *p, int tapered)
{
    if (!tapered)
        return lazy_sub(m->rho, p->rho[0]);
    const pair across = lazy_mul(p->cosine, m->rho);
    const pair along = lazy_mul(p->sine, m->z);
    return lazy_sub(lazy_sub(across, along), p->offset);
}

INLINE pair from_end(const half_plane *m, const profile *p, int end)
{
    return length_of(lazy_sub(m->rho, p->rho[end]), lazy_sub(m->z, p->z[end]));
}

INLINE pair from_ball(const double point[3], const double center[3], double r,
                      double *error)
{
    pair D[3], d;
    double half;
    point_from(point, center, D);
    const pair a = lazy_square(D[0]), b = lazy_square(D[1]),
               c = lazy_square(D[2]);
    const pair s = two_sum(a.hi, b.hi), t = two_sum(s.hi, c.hi);
    d = root_of(normal((pair){t.hi, (s.lo + t.lo) + (a.lo + b.lo + c.lo)}),
                &half);
    *error = CYLINT_HALF_PLANE_ERROR * (d.hi + r);
    return lazy_sub(d, plain(r));
}

INLINE pair from_feature(const half_plane *m, const profile *p, int feature,
                         int tapered)
{
    switch (feature) {
    case CYLINT_FEATURE_LATERAL:
        return from_line(m, p, tapered);
    case CYLINT_FEATURE_CAP0:
        return (pair){-m->z.hi, -m->z.lo};
    case CYLINT_FEATURE_CAP1:
        return lazy_sub(m->z, p->height);
    default:
        return from_end(m, p, feature == CYLINT_FEATURE_RIM1);
    }
}

/* ------------------------------------------------- doubles: features --- */

/* The high parts, and a bound on the errors of their combinations. */
typedef struct {
    double z, rho, above; /* above: z - height */
    double outside;       /* the lateral line, if positive */
    double before, after; /* the foot on it from its ends */
    double margin;
} position;

INLINE void load_position(position *at, const half_plane *m, const profile *p,
                          int tapered, int hull)
{
    const double r0 = hull ? 0 : p->r[0], r1 = hull ? 0 : p->r[1];
    const double C = p->cosine.hi, S = p->sine.hi;
    at->z = m->z.hi;
    at->rho = m->rho.hi + m->rho.lo;
    at->above = at->z - p->height.hi;
    at->outside =
        tapered ? C * at->rho - S * at->z - p->offset.hi : at->rho - p->r[0];
    at->before = tapered ? C * at->z + S * (at->rho - r0) : at->z;
    at->after = tapered ? C * at->above + S * (at->rho - r1) : at->above;
    at->margin =
        CYLINT_FEATURE_MARGIN * (m->size + p->height.hi + p->r[0] + p->r[1]) +
        m->error;
}

/* The lateral line or one of its ends. */
INLINE int lateral_feature(const position *at)
{
    const double M = at->margin;
    if ((at->before > M) & (at->after < -M))
        return CYLINT_FEATURE_LATERAL;
    return at->before < -M ? CYLINT_FEATURE_RIM0
           : at->after > M ? CYLINT_FEATURE_RIM1
                           : UNDECIDED;
}

INLINE int closed_feature(const position *at, const profile *p)
{
    const double M = at->margin, rho = at->rho;
    const double depth = cylint_smaller(at->z, -at->above);
    if ((at->outside < -M) & (depth > M)) {
        if (-at->outside < depth - M)
            return CYLINT_FEATURE_LATERAL;
        if ((-at->outside < depth + M) | (fabs(at->z + at->above) < M))
            return UNDECIDED;
        return at->z < -at->above ? CYLINT_FEATURE_CAP0 : CYLINT_FEATURE_CAP1;
    }
    if ((at->outside < 2 * M) & (depth > -M))
        return UNDECIDED;
    if ((at->z < -M) & (rho < p->r[0] - M))
        return CYLINT_FEATURE_CAP0;
    if ((at->above > M) & (rho < p->r[1] - M))
        return CYLINT_FEATURE_CAP1;
    if (((at->z < M) & (rho < p->r[0] + M)) |
        ((at->above > -M) & (rho < p->r[1] + M)))
        return UNDECIDED;
    return lateral_feature(at);
}

/* How far a point is, in doubles, from a part that it is not inside of. */
static double rough_distance(const position *at, const profile *p, int feature)
{
    const int end = feature == CYLINT_FEATURE_RIM1;
    const double x = at->rho - p->r[end], y = end ? at->above : at->z;
    return feature == CYLINT_FEATURE_LATERAL ? fabs(at->outside)
                                             : double_root(x * x + y * y);
}

/* Lateral surface and at most one cap. */
static int open_feature(const position *at, const profile *p, int cap)
{
    const double M = at->margin;
    const int feature = lateral_feature(at);
    if (cap < 0 || feature == UNDECIDED || at->rho > p->r[cap] + M)
        return feature;
    const double height = fabs(cap ? at->above : at->z);
    const double more = rough_distance(at, p, feature) - height;
    if (!(fabs(more) > M) || !(at->rho < p->r[cap] - M))
        return UNDECIDED;
    return more < 0 ? feature : cap ? CYLINT_FEATURE_CAP1 : CYLINT_FEATURE_CAP0;
}

/* Of an unbounded shape.  The nappe of a double cone on the other side of the
 * apex is left undecided. */
static int unbounded_feature(const position *at, const profile *p,
                             const cylint_shape *s)
{
    const double M = at->margin, C = p->cosine.hi, S = p->sine.hi;
    if (!cylint_is_tapered(s->kind))
        return CYLINT_FEATURE_LATERAL;
    const double c = p->offset.hi + S * at->z; /* radius times cosine */
    if (s->ends == CYLINT_ENDS_INFINITE)
        return c > M ? CYLINT_FEATURE_LATERAL : UNDECIDED;
    return C * c + S * S * at->rho > M ? CYLINT_FEATURE_LATERAL : UNDECIDED;
}

/* ------------------------------------------------------------ answers -- */

/* Writes what is nearest.  An end of the lateral line with the radius 0 is an
 * apex. */
INLINE void write_nearest(nearest *n, int feature, const cylint_shape *s)
{
    n->end =
        (feature == CYLINT_FEATURE_CAP1) | (feature == CYLINT_FEATURE_RIM1);
    const int rim = feature >= CYLINT_FEATURE_RIM0;
    const int apex = feature != CYLINT_FEATURE_LATERAL &&
                     !(cylint_end_factor(s, n->end) > 0);
    n->feature = apex ? CYLINT_FEATURE_APEX : feature;
    n->part = rim | apex ? CYLINT_PART_LATERAL : feature;
}

INLINE int finish(pair d, double error, int is_signed, double *distance)
{
    d = normal(d);
    *distance = is_signed ? d.hi : fabs(d.hi);
    return is_certain(d, error);
}

INLINE void load_row(pair w[3], const cylint_shape *s)
{
    EACH(i, 3)
        w[i] = (pair){s->local.xyz[i][2], s->local.xyz_lo[i][2]};
}

/* The frequent ends. */
INLINE int closed_distance(const cylint_shape *s, const double point[3],
                           nearest *n, double *distance, int tapered)
{
    half_plane m;
    profile p;
    position at;
    pair w[3];
    load_row(w, s);
    load_half_plane(&m, s, point, w);
    load_profile(&p, s, tapered);
    load_position(&at, &m, &p, tapered, 0);
    const int feature = closed_feature(&at, &p);
    if (feature == UNDECIDED)
        return 0;
    write_nearest(n, feature, s);
    return finish(from_feature(&m, &p, feature, tapered), m.error, 1, distance);
}

static int cylinder_distance(const cylint_shape *s, const double point[3],
                             nearest *n, double *distance)
{
    return closed_distance(s, point, n, distance, 0);
}

static int cone_distance(const cylint_shape *s, const double point[3],
                         nearest *n, double *distance)
{
    return closed_distance(s, point, n, distance, 1);
}

/* The other ends. */
static int other_distance(const cylint_shape *s, const double point[3],
                          nearest *n, double *distance)
{
    const int bounded = cylint_ends_are_planes(s->ends);
    half_plane m;
    profile p;
    position at;
    pair w[3];
    load_row(w, s);
    load_half_plane(&m, s, point, w);
    load_profile(&p, s, 1);
    load_position(&at, &m, &p, 1, 0);
    const int cap = s->ends == CYLINT_ENDS_CAP0   ? 0
                    : s->ends == CYLINT_ENDS_CAP1 ? 1
                                                  : -1;
    const int feature =
        bounded ? open_feature(&at, &p, cap) : unbounded_feature(&at, &p, s);
    if (feature == UNDECIDED)
        return 0;
    write_nearest(n, feature, s);
    return finish(from_feature(&m, &p, feature, 1), m.error, !bounded,
                  distance);
}

static int hull_distance(const cylint_shape *s, const double point[3],
                         nearest *n, double *distance)
{
    half_plane m;
    profile p;
    position at;
    pair w[3];
    load_row(w, s);
    load_half_plane(&m, s, point, w);
    load_hull_profile(&p, s);
    load_position(&at, &m, &p, 1, 1);
    const int closed = s->ends == CYLINT_ENDS_CAPPED;
    int feature = lateral_feature(&at);
    if (feature == UNDECIDED)
        return 0;
    const int end = feature == CYLINT_FEATURE_RIM1;
    const int ball = end ? CYLINT_FEATURE_CAP1 : CYLINT_FEATURE_CAP0;
    if (feature == CYLINT_FEATURE_LATERAL ||
        !cylint_part_is_present(s->ends, ball)) {
        write_nearest(n, feature, s);
        return finish(from_feature(&m, &p, feature, 1), m.error, closed,
                      distance);
    }
    double error;
    const pair d = from_ball(point, end ? s->top : s->base, p.r[end], &error);
    write_nearest(n, ball, s);
    return finish(d, error, closed, distance);
}

static int sphere_distance(const cylint_shape *s, const double point[3],
                           nearest *n, double *distance)
{
    double error;
    const pair d = from_ball(point, s->base, s->r0, &error);
    if (!cylint_part_is_present(s->ends, s->surface))
        return 0;
    n->end = 0;
    n->part = n->feature = s->surface;
    return finish(d, error, s->ends == CYLINT_ENDS_CAPPED, distance);
}

int CYLINT_CERTIFIED(const cylint_shape *s, const double point[3], nearest *n,
                     double *distance)
{
    if (!cylint_rounds_to_nearest())
        return 0;
    switch (s->kind) {
    case CYLINT_KIND_CYLINDER:
        return s->ends == CYLINT_ENDS_CAPPED
                   ? cylinder_distance(s, point, n, distance)
                   : other_distance(s, point, n, distance);
    case CYLINT_KIND_CONE:
        return s->ends == CYLINT_ENDS_CAPPED
                   ? cone_distance(s, point, n, distance)
                   : other_distance(s, point, n, distance);
    case CYLINT_KIND_SPHERE:
        return sphere_distance(s, point, n, distance);
    case CYLINT_KIND_CAPSULE:
    case CYLINT_KIND_RCONE:
        return s->local.height > 0 && hull_distance(s, point, n, distance);
    default:
        return 0;
    }
}

#else

/* Without vectors of two lanes. */
int CYLINT_CERTIFIED(const cylint_shape *shape, const double point[3],
                     nearest *n, double *distance)
{
    (void)shape;
    (void)point;
    (void)n;
    (void)distance;
    return 0;
}

#endif
