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

#include "certified_point.h"
#include "half_plane.h"
#include "near_surface.h"

#ifndef CYLINT_CERTIFIED
#define CYLINT_CERTIFIED cylint_certified_plain
#endif

#if LANES == 2

#define ARGUMENTS                                                \
    const cylint_shape *s, const double point[3], unsigned want, \
        cylint_closest *answer

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
INLINE void load_profile(profile *p, const cylint_shape *s)
{
    p->height = cylint_number_pair(s, CYLINT_AT_HEIGHT);
    p->z[0] = plain(0);
    p->z[1] = p->height;
    p->r[0] = cylint_r0(s);
    p->r[1] = cylint_r1(s);
    p->rho[0] = plain(cylint_r0(s));
    p->rho[1] = plain(cylint_r1(s));
    p->cosine = cylint_number_pair(s, CYLINT_AT_COSINE);
    p->sine = cylint_number_pair(s, CYLINT_AT_SINE);
    p->offset = lazy_mul(p->cosine, p->rho[0]);
}

/* That of the convex hull of two balls: the lateral line touches them. */
static void load_hull_profile(profile *p, const cylint_shape *s)
{
    p->height = cylint_number_pair(s, CYLINT_AT_HEIGHT);
    p->cosine = cylint_number_pair(s, CYLINT_AT_COSINE);
    p->sine = cylint_number_pair(s, CYLINT_AT_SINE);
    p->r[0] = cylint_r0(s);
    p->r[1] = cylint_r1(s);
    p->offset = plain(cylint_r0(s));
    EACH(i, 2) {
        const pair z = i ? p->height : plain(0);
        p->z[i] = lazy_sub(z, lazy_mul(p->sine, plain(p->r[i])));
        p->rho[i] = lazy_mul(p->cosine, plain(p->r[i]));
    }
}

/* --------------------------------------------------- pairs: distances -- */

INLINE pair from_line(const half_plane *m, const profile *p)
{
    const pair across = lazy_mul(p->cosine, m->rho);
    const pair along = lazy_mul(p->sine, m->z);
    return lazy_sub(lazy_sub(across, along), p->offset);
}

INLINE pair from_end(const half_plane *m, const profile *p, int end)
{
    return length_of(lazy_sub(m->rho, p->rho[end]), lazy_sub(m->z, p->z[end]));
}

INLINE pair square_of(const pair D[3])
{
    const pair a = lazy_square(D[0]), b = lazy_square(D[1]),
               c = lazy_square(D[2]);
    const pair s = two_sum(a.hi, b.hi), t = two_sum(s.hi, c.hi);
    return normalized((pair){t.hi, (s.lo + t.lo) + (a.lo + b.lo + c.lo)});
}

INLINE pair from_ball(const double point[3], const double center[3], double r,
                      double *error)
{
    pair D[3];
    double half;
    point_from(point, center, D);
    const pair d = root_of(square_of(D), &half);
    *error = CYLINT_HALF_PLANE_ERROR * (d.hi + r);
    return lazy_sub(d, plain(r));
}

/* The double near a pair whose low part is up to CYLINT_ROOT_STEP of the high one:
 * a root near the axis. */
INLINE double whole(pair a)
{
    return a.hi + a.lo;
}

/* From the plane of a cap, positive outside. */
INLINE pair from_level(const half_plane *m, pair height, int top)
{
    const pair level = {top ? height.hi : 0, top ? height.lo : 0};
    const pair d = lazy_sub(m->z, level);
    const double sign = top ? 1 : -1;
    return (pair){sign * d.hi, sign * d.lo};
}

INLINE pair from_plane(const half_plane *m, const profile *p, int top)
{
    return from_level(m, p->height, top);
}

INLINE pair from_feature(const half_plane *m, const profile *p, int feature)
{
    if (feature == CYLINT_FEATURE_LATERAL)
        return from_line(m, p);
    if (feature >= CYLINT_FEATURE_RIM0)
        return from_end(m, p, feature == CYLINT_FEATURE_RIM1);
    return from_plane(m, p, feature == CYLINT_FEATURE_CAP1);
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
                          int hull)
{
    const double r0 = hull ? 0 : p->r[0], r1 = hull ? 0 : p->r[1];
    const double C = p->cosine.hi, S = p->sine.hi;
    at->z = m->z.hi;
    at->rho = m->rho.hi + m->rho.lo;
    at->above = at->z - p->height.hi;
    at->outside = C * at->rho - S * at->z - p->offset.hi;
    at->before = C * at->z + S * (at->rho - r0);
    at->after = C * at->above + S * (at->rho - r1);
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

/* Of an unbounded shape.  Beyond the apex the nearest nappe of a double cone is
 * the other one: *p becomes its profile, and *flipped 1. */
static int unbounded_feature(const position *at, profile *p,
                             const cylint_shape *s, int *flipped)
{
    const double M = at->margin, C = p->cosine.hi, S = p->sine.hi;
    const double c = p->offset.hi + S * at->z; /* radius times cosine */
    if (!cylint_is_tapered(s->kind))
        return CYLINT_FEATURE_LATERAL;
    if (s->ends == CYLINT_ENDS_NAPPE)
        return C * c + S * S * at->rho > M ? CYLINT_FEATURE_LATERAL : UNDECIDED;
    if (c < -M) {
        p->sine = pair_neg(p->sine);
        p->offset = pair_neg(p->offset);
        *flipped = 1;
    }
    return fabs(c) > M ? CYLINT_FEATURE_LATERAL : UNDECIDED;
}

/* ------------------------------------------------------------ answers -- */

INLINE void write_part(const cylint_shape *s, int feature, unsigned want,
                       cylint_closest *answer)
{
    if (!(want & CYLINT_WANT_PART))
        return;
    answer->feature =
        cylint_feature_is_apex(s, feature) ? CYLINT_FEATURE_APEX : feature;
    answer->part = cylint_feature_part(answer->feature);
}

/* Computes the distance in triples, if it is small; whether it is certain then.
 * center: of the ball that the feature is a part of, or NULL. */
ASIDE int is_certain_in_triples(const half_plane *m, int feature,
                                const double *center, double r, pair *d,
                                const cylint_shape *s, const double point[3])
{
    const double size = m->size + cylint_reach(s);
    if (!(fabs(d->hi) <= CYLINT_CLOSE * size) || !(size <= CYLINT_CLOSE_MOST) ||
        feature >= CYLINT_FEATURE_RIM0 || cylint_has_tangent(s->kind) ||
        (!center && !is_off_axis(m)))
        return 0;
    const close_distance to =
        center ? close_to_ball(point, center, r)
        : feature == CYLINT_FEATURE_LATERAL
            ? close_to_line(s, point, normalized(m->rho), m->error, size)
            : close_to_plane(s, point, feature == CYLINT_FEATURE_CAP1, size);
    *d = normalized(to.d);
    return is_certain(*d, to.error);
}

/* Writes the answer; whether all of it is certain. */
INLINE int finish(const half_plane *m, pair d, int feature, int is_signed,
                  ARGUMENTS)
{
    d = normalized(d);
    write_part(s, feature, want, answer);
    if (!is_certain(d, m->error) &&
        !is_certain_in_triples(m, feature, NULL, 0, &d, s, point))
        return 0;
    answer->distance = is_signed ? d.hi : fabs(d.hi);
    return !(want & (CYLINT_WANT_POINT | CYLINT_WANT_NORMAL)) ||
           describe(s, point, m, feature, d, want, answer);
}

/* Writes the answer for a point near a rim of a capped cylinder or cone, whose
 * distances from the lateral line and from the plane of the end are A and B,
 * nearly; whether all of it is certain. */
ASIDE int finish_at_corner(const half_plane *m, double A, double B, int top,
                           ARGUMENTS)
{
    corner k;
    close_distance to = {{0, 0}, HUGE_VAL};
    const double size = m->size + cylint_reach(s);
    if (!(fabs(A) + fabs(B) <= CYLINT_CLOSE * size) ||
        !(size <= CYLINT_CLOSE_MOST) || !is_off_axis(m) ||
        !load_corner(&k, s, point, m, top))
        return 0;
    const int feature = corner_feature(&k, top, &to);
    const pair d = normalized(to.d);
    if (feature == UNDECIDED || !is_certain(d, to.error))
        return 0;
    write_part(s, feature, want, answer);
    answer->distance = d.hi;
    return !(want & (CYLINT_WANT_POINT | CYLINT_WANT_NORMAL)) ||
           describe(s, point, m, feature, d, want, answer);
}

/* finish() for a ball; d is normal. */
INLINE int finish_on_ball(pair d, double error, const double center[3],
                          double r, int is_signed, ARGUMENTS)
{
    const half_plane m = {.size = fabs(d.hi) + 2 * r, .error = error};
    if (!is_certain(d, error) &&
        !is_certain_in_triples(&m, CYLINT_FEATURE_CAP0, center, r, &d, s,
                               point))
        return 0;
    answer->distance = is_signed ? d.hi : fabs(d.hi);
    return !(want & (CYLINT_WANT_POINT | CYLINT_WANT_NORMAL)) ||
           describe_ball(point, center, r, want, answer);
}

INLINE int finish_ball(const double center[3], double r, int is_signed,
                       ARGUMENTS)
{
    double error;
    const pair d = normalized(from_ball(point, center, r, &error));
    return finish_on_ball(d, error, center, r, is_signed, s, point, want,
                          answer);
}

/* The feature of a cap or a rim. */
INLINE int at_end(int feature0, int top)
{
    return feature0 + top;
}

/*
 * A capped cylinder.  The point lies at the distance A from the lateral surface
 * and B from the plane of the nearer cap, both positive outside.  If both are
 * positive the rim is nearest, else the larger one counts.
 */
INLINE int cylinder_distance(ARGUMENTS)
{
    half_plane m;
    load_half_plane(&m, s, point);
    const double M =
        CYLINT_FEATURE_MARGIN * (m.size + cylint_reach(s)) + m.error;
    const double t = m.z.hi + (m.z.hi - cylint_height(s));
    const int top = t > 0;
    const pair A = lazy_sub(m.rho, plain(cylint_r0(s))),
               B = from_level(&m, cylint_number_pair(s, CYLINT_AT_HEIGHT), top);
    const double a = whole(A), b = whole(B);
    const int cap = a < b, rim = (a > 0) & (b > 0);
    const int inside = (a < 0) & (b < 0);
    const int tie = (fabs(a - b) <= M) | (cap & (fabs(t) <= M));
    const int on_lateral = (fabs(a) <= M) & (b < -2 * M);
    const int on_cap = (fabs(b) <= M) & (a < -2 * M) & (fabs(t) > M);
    if (on_lateral | on_cap)
        return finish(&m, on_cap ? B : A,
                      on_cap ? at_end(CYLINT_FEATURE_CAP0, top)
                             : CYLINT_FEATURE_LATERAL,
                      1, s, point, want, answer);
    if (!((fabs(a) > M) & (fabs(b) > M)) || (inside & tie))
        return finish_at_corner(&m, a, b, top, s, point, want, answer);
    return finish(&m,
                  rim   ? length_of(A, B)
                  : cap ? B
                        : A,
                  rim   ? at_end(CYLINT_FEATURE_RIM0, top)
                  : cap ? at_end(CYLINT_FEATURE_CAP0, top)
                        : CYLINT_FEATURE_LATERAL,
                  1, s, point, want, answer) ||
           finish_at_corner(&m, a, b, top, s, point, want, answer);
}

/* Whether the point lies beyond the cap; or undecided. */
INLINE int is_beyond_cap(const position *at, const profile *p, int cap)
{
    const double M = at->margin, r = p->r[cap];
    const double beyond = cap ? at->above : -at->z;
    if ((beyond > M) & (at->rho < r - M))
        return 1;
    return ((beyond < -M) | (at->rho > r + M)) ? 0 : UNDECIDED;
}

/* The feature of a capped cone.  A and B as for a cylinder. */
INLINE int cone_feature(const position *at, const profile *p, double A,
                        double B)
{
    const double M = at->margin, t = at->z + at->above;
    const int top = t > 0, cap = A < B;
    if ((fabs(A) <= 2 * M) & (B < -4 * M))
        return CYLINT_FEATURE_LATERAL;
    if ((fabs(B) <= M) & (A < -4 * M) & (fabs(t) > M))
        return at_end(CYLINT_FEATURE_CAP0, top);
    if ((A < -M) & (B < -M)) {
        if ((fabs(A - B) <= M) | (cap & (fabs(t) <= M)))
            return UNDECIDED;
        return cap ? at_end(CYLINT_FEATURE_CAP0, top) : CYLINT_FEATURE_LATERAL;
    }
    const int beyond = is_beyond_cap(at, p, top);
    if (!((A > 2 * M) | (B > M)) || beyond == UNDECIDED ||
        is_beyond_cap(at, p, !top) == UNDECIDED)
        return UNDECIDED;
    return beyond ? at_end(CYLINT_FEATURE_CAP0, top) : lateral_feature(at);
}

INLINE int cone_distance(ARGUMENTS)
{
    half_plane m;
    profile p;
    position at;
    load_half_plane(&m, s, point);
    load_profile(&p, s);
    load_position(&at, &m, &p, 0);
    const pair A = from_line(&m, &p);
    const int top = at.z + at.above > 0;
    const pair B = from_plane(&m, &p, top);
    const int feature = cone_feature(&at, &p, whole(A), whole(B));
    const pair d = feature == CYLINT_FEATURE_LATERAL ? A
                   : feature < CYLINT_FEATURE_RIM0
                       ? B
                       : from_end(&m, &p, feature == CYLINT_FEATURE_RIM1);
    return (feature != UNDECIDED &&
            finish(&m, d, feature, 1, s, point, want, answer)) ||
           finish_at_corner(&m, whole(A), whole(B), top, s, point, want,
                            answer);
}

/* Whether describe() has the numbers of a feature: radius and centre of the top of
 * an acone are not doubles. */
static int has_description(const cylint_shape *s, int feature)
{
    return !cylint_has_tangent(s->kind) || feature == CYLINT_FEATURE_LATERAL ||
           feature == CYLINT_FEATURE_RIM0;
}

/* A nappe whose radius falls as z grows, for describe(). */
ASIDE void turn(cylint_shape *to, const cylint_shape *s)
{
    const pair sine = cylint_number_pair(s, CYLINT_AT_SINE);
    *to = *s;
    to->library.number[CYLINT_AT_SINE] = -sine.hi;
    to->library.number[CYLINT_AT_SINE + CYLINT_LOW] = -sine.lo;
}

ASIDE int profile_distance(const half_plane *m, profile *p, ARGUMENTS)
{
    int flipped = 0;
    const int bounded = cylint_ends_are_planes(s->ends);
    const int closed = !bounded || s->ends == CYLINT_ENDS_CAPPED;
    const int cap = s->ends == CYLINT_ENDS_CAP0   ? 0
                    : s->ends == CYLINT_ENDS_CAP1 ? 1
                                                  : -1;
    position at;
    load_position(&at, m, p, 0);
    const int feature =
        !bounded ? unbounded_feature(&at, p, s, &flipped)
        : closed ? cone_feature(&at, p, whole(from_line(m, p)),
                                whole(from_plane(m, p, at.z + at.above > 0)))
                 : open_feature(&at, p, cap);
    const int described = want & (CYLINT_WANT_POINT | CYLINT_WANT_NORMAL);
    cylint_shape other;
    if (feature == UNDECIDED || (described && !has_description(s, feature)))
        return 0;
    if (described && flipped) {
        turn(&other, s);
        s = &other;
    }
    return finish(m, from_feature(m, p, feature), feature, closed, s, point,
                  want, answer);
}

/* One copy for the less frequent shapes. */
ASIDE void load_aside(half_plane *m, const cylint_shape *s,
                      const double point[3], const pair *length, double reach)
{
    pair w[3];
    if (length)
        EACH(i, 3)
            w[i] = plain(cylint_axis(s)[i]);
    else
        load_row(w, s);
    load_along(m, s, point, w, length, reach);
}

ASIDE int other_distance(ARGUMENTS)
{
    half_plane m;
    profile p;
    load_aside(&m, s, point, NULL, cylint_reach(s));
    load_profile(&p, s);
    return profile_distance(&m, &p, s, point, want, answer);
}

/* The direction of the axis, for describe(). */
ASIDE void load_unit_axis(cylint_shape *to, const cylint_shape *s, pair length)
{
    *to = *s;
    EACH(i, 3) {
        const pair w = pair_div(plain(cylint_axis(s)[i]), length);
        double *z = to->library.number + CYLINT_AT_COLUMNS + 3 * i + 2;
        z[0] = w.hi;
        z[CYLINT_LOW] = w.lo;
    }
}

/* An acone in world lengths: its local coordinates count axis lengths. */
ASIDE int tangent_distance(ARGUMENTS)
{
    half_plane m;
    profile p;
    pair w[3];
    double half;
    cylint_shape upright;
    EACH(i, 3)
        w[i] = plain(cylint_axis(s)[i]);
    load_profile(&p, s);
    p.height = normalized(root_of(square_of(w), &half));
    p.z[1] = p.height;
    p.rho[1] = normalized(lazy_mul(p.height, plain(cylint_r1(s))));
    p.r[1] = p.rho[1].hi;
    load_aside(&m, s, point, &p.height, p.height.hi + p.r[1]);
    if (want & (CYLINT_WANT_POINT | CYLINT_WANT_NORMAL)) {
        load_unit_axis(&upright, s, p.height);
        s = &upright;
    }
    return profile_distance(&m, &p, s, point, want, answer);
}

static int hull_distance(ARGUMENTS)
{
    half_plane m;
    profile p;
    position at;
    if (!(cylint_height(s) > 0))
        return 0;
    load_half_plane(&m, s, point);
    load_hull_profile(&p, s);
    load_position(&at, &m, &p, 1);
    const int closed = s->ends == CYLINT_ENDS_CAPPED;
    const int feature = lateral_feature(&at);
    if (feature == UNDECIDED)
        return 0;
    const int end = feature == CYLINT_FEATURE_RIM1;
    const int ball = at_end(CYLINT_FEATURE_CAP0, end);
    if (feature == CYLINT_FEATURE_LATERAL ||
        !cylint_part_is_present(s->ends, ball) || cylint_sign(p.r[end]) == 0)
        return finish(&m, from_feature(&m, &p, feature), feature, closed, s,
                      point, want, answer);
    write_part(s, ball, want, answer);
    return finish_ball(end ? cylint_top(s) : cylint_base(s), p.r[end], closed,
                       s, point, want, answer);
}

/* A capped capsule: z decides which of the segment's points is nearest, and its
 * distance is the root of a difference. */
INLINE int capsule_distance(ARGUMENTS)
{
    const pair h = cylint_number_pair(s, CYLINT_AT_HEIGHT);
    pair D[3], w[3], z, dd;
    double half;
    load_row(w, s);
    point_from(point, cylint_base(s), D);
    load_sums(&z, &dd, D, w);
    const double size = size_along(D), above = z.hi - h.hi;
    const double M = CYLINT_FEATURE_MARGIN * (size + cylint_reach(s));
    if (!((fabs(z.hi) > M) & (fabs(above) > M)))
        return 0;
    const int low = z.hi<0, high = above> 0;
    const pair beyond = lazy_sub(z, h); /* h (2 z - h) = h (z + (z - h)) */
    const pair t = low    ? plain(0)
                   : high ? lazy_mul(h, lazy_add(z, beyond))
                          : lazy_square(z);
    const pair root = root_of_difference(dd, normalized(t), &half);
    const half_plane m = {z, root, size,
                          error_of_root(size, half, cylint_reach(s))};
    const pair d = normalized(lazy_sub(root, plain(cylint_r0(s))));
    const int feature = low    ? CYLINT_FEATURE_CAP0
                        : high ? CYLINT_FEATURE_CAP1
                               : CYLINT_FEATURE_LATERAL;
    if (feature == CYLINT_FEATURE_LATERAL)
        return finish(&m, d, feature, 1, s, point, want, answer);
    write_part(s, feature, want, answer);
    return finish_on_ball(d, m.error, high ? cylint_top(s) : cylint_base(s),
                          cylint_r0(s), 1, s, point, want, answer);
}

static int sphere_distance(ARGUMENTS)
{
    if (!cylint_part_is_present(s->ends, cylint_surface(s)))
        return 0;
    if (want & CYLINT_WANT_PART)
        answer->part = answer->feature = cylint_surface(s);
    return finish_ball(cylint_base(s), cylint_r0(s),
                       s->ends == CYLINT_ENDS_CAPPED, s, point, want, answer);
}

int CYLINT_CERTIFIED(const cylint_shape *s, const double point[3],
                     unsigned want, cylint_closest *answer)
{
    if (!cylint_rounds_to_nearest())
        return 0;
    if (s->kind == CYLINT_KIND_CYLINDER && s->ends == CYLINT_ENDS_CAPPED)
        return cylinder_distance(s, point, want, answer);
    if (s->kind == CYLINT_KIND_CONE && s->ends == CYLINT_ENDS_CAPPED)
        return cone_distance(s, point, want, answer);
    if (s->kind == CYLINT_KIND_CAPSULE && s->ends == CYLINT_ENDS_CAPPED)
        return cylint_height(s) > 0 && capsule_distance(s, point, want, answer);
    switch (s->kind) {
    case CYLINT_KIND_CYLINDER:
    case CYLINT_KIND_CONE:
        return other_distance(s, point, want, answer);
    case CYLINT_KIND_ACONE:
        return tangent_distance(s, point, want, answer);
    case CYLINT_KIND_SPHERE:
        return sphere_distance(s, point, want, answer);
    case CYLINT_KIND_CAPSULE:
    case CYLINT_KIND_RCONE:
        return hull_distance(s, point, want, answer);
    default:
        return 0;
    }
}

#else

/* Without vectors of two lanes. */
int CYLINT_CERTIFIED(const cylint_shape *shape, const double point[3],
                     unsigned want, cylint_closest *answer)
{
    (void)shape;
    (void)point;
    (void)want;
    (void)answer;
    return 0;
}

#endif
