/*
 * elliptic_angle.h - the angle of the nearest point of an elliptic shape, in
 * doubles
 *
 * An angle has the point u = a cos + b sin of the ellipse of the base, and the
 * ruling c + u + z (h + (k - 1) u).  With the rows x, y, z of the inverse of
 * (a b h), rho = 1 + (k - 1) z and the unit vector e = (cos, sin), the tangent
 * plane of the lateral surface along a ruling is (x, y).e = rho.  Its normal is
 *     N = cos x + sin y - (k - 1) z,
 * and the point is n / |N| above it, n = (x, y).e - rho.  The signed distance from
 * the lateral surface is the largest of these heights: outside by convexity, and
 * inside because every tangent plane is farther than the surface.
 *
 * Of a cylinder this is the distance of a point from an ellipse in a plane, of a
 * cone nearly that.  A rim is the ellipse of a right cylinder (project_on_end()).
 * With the principal axes A > B of the ellipse and the point (X, Y) of its plane,
 * the nearest point is (A cos, B sin) with
 *     cos = A X / (s + A^2), sin = B Y / (s + B^2), cos^2 + sin^2 = 1.
 * This has one root s > -B^2, that of the nearest point of all: it is computed as
 * that of sqrt(cos^2 + sin^2) = 1, whose inverse is nearly a straight line, by
 * Newton's iteration from the left.  [Eberly 2013, "Distance from a point to an
 * ellipse".]  Of a cone, Newton's iteration on the height follows.
 *
 * Whether it is the nearest of all does not depend on that iteration: see
 * elliptic_certainty.h.
 */
#ifndef CYLINT_ELLIPTIC_ANGLE_H
#define CYLINT_ELLIPTIC_ANGLE_H

#include "../shapes/shape_facts.h"
#include "error_bounds.h"

typedef struct {
    double cos, sin;
} angle;

/* Newton's iterations end after a step below this: the error is about its square.
 * After the most steps they end, too; then the angle is not used. */
#define CYLINT_ANGLE_STEP 0x1p-20
#define CYLINT_SECULAR_STEP 0x1p-10

/* A step of Newton's iteration is shorter than CYLINT_LONGEST_STEP.  Where it is
 * not, or leads down, as at skewed oblique cones, CYLINT_STEP_UP leads up. */
#define CYLINT_LONGEST_STEP 0.5
#define CYLINT_STEP_UP 0.4

/* Where a rough angle is enough. */
#define CYLINT_ROUGH_STEP 0x1p-6
#define CYLINT_ROUGH_ANGLE 0x1p-12

enum { CYLINT_SECULAR_STEPS = 40, CYLINT_ANGLE_STEPS = 12 };

/* A point in the coordinates x, y, z of a shape.  Beside the other nappe of a
 * double cone it is turned about the apex: x, y and rho have the other signs. */
typedef struct {
    double D[3], X[3], Y[3], Z[3]; /* from the base; the rows of the matrix */
    double x, y, z, rho, slope;    /* slope: k - 1 */
    double error, z_error;         /* of x, y and rho together; of z */
    double relative;               /* the error of the length of a row */
    double norm, z_norm; /* x, y and rho, and z change by no more along a unit
                            vector */
} elliptic_place;

/* lint: the analyzer takes three rounds of EACH for one */
CYLINT_INLINE double sum_of_sizes(const double v[3])
{
    return fabs(v[0]) + fabs(v[1]) + fabs(v[2]);
}

/* From the matrix of the shape, whose error u is relative to its norm. */
static inline void locate(elliptic_place *p, const cylint_shape *s,
                          const double point[3], double u)
{
    const double unit = 1 / cylint_height(s);
    EACH(i, 3) {
        p->D[i] = point[i] - cylint_base(s)[i];
        p->X[i] = cylint_column(s, i)[0];
        p->Y[i] = cylint_column(s, i)[1];
        p->Z[i] = cylint_column(s, i)[2] * unit;
    }
    p->slope = cylint_r1(s) - 1;
    p->x = cylint_dot(p->D, p->X);
    p->y = cylint_dot(p->D, p->Y);
    p->z = cylint_dot(p->D, p->Z);
    p->rho = 1 + p->slope * p->z;
    const double x = cylint_dot(p->X, p->X), y = cylint_dot(p->Y, p->Y);
    p->z_norm = sqrt(cylint_dot(p->Z, p->Z));
    p->norm = sqrt(x + y) + fabs(p->slope) * p->z_norm;
    const double least =
        cylint_smaller(sqrt(cylint_smaller(x, y)), p->z_norm / unit);
    p->relative = u + u * cylint_norm(s) / least;
    p->error =
        u * cylint_norm(s) * (1 + fabs(p->slope) * unit) * sum_of_sizes(p->D) +
        u * (1 + fabs(p->x) + fabs(p->y) + fabs(p->rho));
    p->z_error = u * cylint_norm(s) * unit * sum_of_sizes(p->D) + u;
}

/* Moves the point along the perpendicular into the plane of an end, and makes the
 * lateral surface that of the right cylinder over the rim: its nearest point is
 * then that of the rim.  z stays that of the point. */
static inline void project_on_end(elliptic_place *p, const cylint_shape *s,
                                  int end)
{
    const double xx = cylint_dot(p->X, p->X), yy = cylint_dot(p->Y, p->Y),
                 length = 1 / p->z_norm, up = (end ? p->z - 1 : p->z) * length,
                 xz = cylint_dot(p->X, p->Z) * length,
                 yz = cylint_dot(p->Y, p->Z) * length;
    p->error = 4 * (p->error + p->norm * length * p->z_error) +
               8 * p->relative * p->norm * fabs(up);
    EACH(i, 3) {
        p->X[i] -= xz * length * p->Z[i];
        p->Y[i] -= yz * length * p->Z[i];
    }
    p->x -= up * xz;
    p->y -= up * yz;
    p->rho = cylint_end_factor(s, end);
    p->slope = 0;
    const double x = cylint_dot(p->X, p->X), y = cylint_dot(p->Y, p->Y);
    p->norm = sqrt(x + y);
    p->relative *= 8 * sqrt(cylint_larger(xx * y, yy * x) / (x * y));
}

/* The vector from base + share h to the point. */
static inline void load_from_axis(double F[3], const elliptic_place *p,
                                  const cylint_shape *s, double share)
{
    EACH(i, 3)
        F[i] = p->D[i] - share * cylint_axis(s)[i];
}

/* ------------------------------------------------ a point and an ellipse -- */

/* A symmetric matrix, its eigenvalues, and the unit vector (c, s) that belongs to
 * the larger one. */
typedef struct {
    double most, least, gap, c, s;
} principal_axes;

static inline principal_axes axes_of(double xx, double xy, double yy)
{
    const double half = 0.5 * (xx - yy), rad = sqrt(half * half + xy * xy);
    const double most = 0.5 * (xx + yy) + rad;
    const double x = fabs(half) + rad, y = fabs(xy);
    const double scale = x > 0 ? 1 / sqrt(x * x + y * y) : 1;
    const double large = x > 0 ? x * scale : 1, small = y * scale;
    return (principal_axes){most, (xx * yy - xy * xy) / most, 2 * rad,
                            half < 0 ? small : large,
                            copysign(half < 0 ? large : small, xy)};
}

/* cos and sin for A X / B^2 and Y / B, and A^2 / B^2 - 1.  The iteration ends after
 * a relative step of `last`.  NaN for a point on the long axis with two nearest
 * points: sqrt() of a NaN would set errno under Windows. */
static inline angle secular_angle(double along, double across, double excess,
                                  double last)
{
    const double u = fabs(along), v = fabs(across);
    /* mutant '>' -> '>=': no effect */
    double s = v > u - excess ? v : u - excess, by;
    angle to;
    if (!(s > 0))
        return (angle){NAN, NAN};
    for (int i = 0; i < CYLINT_SECULAR_STEPS; i++) {
        const double to_u = 1 / (s + excess), to_v = 1 / s;
        const double a = u * to_u * (u * to_u), b = v * to_v * (v * to_v);
        by = (sqrt(a + b) - 1) * (a + b) / (a * to_u + b * to_v);
        s += by > 0 ? by : 0;
        if (!(by > last * s))
            break;
    }
    to.cos = copysign(u / (s + excess), along);
    to.sin = copysign(v / s, across);
    return to;
}

/* An angle in the axes of p, given along those of p.most and p.least, turned
 * back. */
CYLINT_INLINE angle turned_back(const principal_axes *p, double of_most,
                                double of_least)
{
    const double c = p->c * of_most - p->s * of_least,
                 s = p->s * of_most + p->c * of_least;
    const double scale = 1 / sqrt(c * c + s * s);
    return (angle){c * scale, s * scale};
}

/* ------------------------------------------------- the lateral surface -- */

/* What the height over a tangent plane and its derivatives by the angle are made
 * of: n, N = U + G, where G is the part that does not depend on the angle. */
typedef struct {
    double n, slope_of_n;    /* n' */
    double U[3], V[3], N[3]; /* U' = V */
    double q, half_q, size;  /* N.N, N.V, |N| */
} tangent_plane;

CYLINT_INLINE void load_tangent_plane(tangent_plane *t, const elliptic_place *p,
                                      angle at)
{
    EACH(i, 3) {
        t->U[i] = at.cos * p->X[i] + at.sin * p->Y[i];
        t->V[i] = at.cos * p->Y[i] - at.sin * p->X[i];
        t->N[i] = t->U[i] - p->slope * p->Z[i];
    }
    t->n = at.cos * p->x + at.sin * p->y - p->rho;
    t->slope_of_n = at.cos * p->y - at.sin * p->x;
    t->q = cylint_dot(t->N, t->N);
    t->half_q = cylint_dot(t->N, t->V);
    t->size = sqrt(t->q);
}

/* g = n' N.N - n N.V is 0 at the nearest point.  Its derivative. */
CYLINT_INLINE double slope_of_height(const tangent_plane *t,
                                     const elliptic_place *p)
{
    const double turned =
        cylint_dot(t->V, t->V) - cylint_dot(t->N, t->U); /* of N.V */
    return t->slope_of_n * t->half_q - t->n * turned - (t->n + p->rho) * t->q;
}

CYLINT_INLINE angle turned_by(angle at, double by)
{
    const double square = by * by;
    const double scale =
        fabs(by) <= CYLINT_ANGLE_STEP ? 1 - 0.5 * square : 1 / sqrt(1 + square);
    return (angle){(at.cos - at.sin * by) * scale,
                   (at.sin + at.cos * by) * scale};
}

/* The height over the tangent plane. */
CYLINT_INLINE double height_at(const elliptic_place *p, angle at)
{
    tangent_plane t;
    load_tangent_plane(&t, p, at);
    return t.n / t.size;
}

/* Of an angle in the axes and its mirror images the one with the largest height:
 * the section of an oblique cone is not perpendicular to its axis. */
static inline angle highest_of(const principal_axes *axes, angle e,
                               const elliptic_place *p)
{
    angle best = turned_back(axes, e.sin, e.cos);
    if (p->slope == 0 ||
        (cylint_dot(p->X, p->Z) == 0 && cylint_dot(p->Y, p->Z) == 0))
        return best;
    double height = height_at(p, best);
    for (int i = 1; i < 4; i++) {
        const angle other =
            turned_back(axes, i & 1 ? -e.sin : e.sin, i & 2 ? -e.cos : e.cos);
        const double h = height_at(p, other);
        if (h > height) {
            height = h;
            best = other;
        }
    }
    return best;
}

/* lint: the analyzer takes three rounds of EACH for one */
/* Writes the angle, and its tangent plane.  rough: an angle with an error of
 * about CYLINT_ROUGH_ANGLE is enough.  Returns 0 if the iteration did not come
 * to an end. */
ASIDE int find_lateral_angle(angle *at, tangent_plane *t,
                             const elliptic_place *p, int rough)
{
    const double axial = p->slope * p->slope * cylint_dot(p->Z, p->Z);
    const principal_axes axes =
        axes_of(cylint_dot(p->X, p->X) + axial, cylint_dot(p->X, p->Y),
                cylint_dot(p->Y, p->Y) + axial);
    const double short_way = axes.c * p->x + axes.s * p->y,
                 long_way = axes.c * p->y - axes.s * p->x;
    const double ratio = axes.most / axes.least;
    const double r = p->rho > p->error ? p->rho : p->error;
    const int is_cone = p->slope != 0;
    const double last = rough     ? CYLINT_ROUGH_STEP
                        : is_cone ? CYLINT_SECULAR_STEP
                                  : CYLINT_ANGLE_STEP;
    const angle e = secular_angle(ratio * long_way / r, short_way / r,
                                  axes.gap / axes.least, last);
    if (isnan(e.cos))
        return 0;
    *at = highest_of(&axes, e, p);
    double by = is_cone ? 1 : 0;
    for (int i = 0; i <= CYLINT_ANGLE_STEPS; i++) {
        load_tangent_plane(t, p, *at);
        if (fabs(by) <= CYLINT_ANGLE_STEP)
            return 1;
        const double g = t->slope_of_n * t->q - t->n * t->half_q,
                     slope = slope_of_height(t, p);
        by = -g / slope;
        if (!(slope < 0) || !(fabs(by) < CYLINT_LONGEST_STEP))
            by = copysign(CYLINT_STEP_UP, g);
        if (rough && fabs(by) <= CYLINT_ROUGH_ANGLE)
            return 1;
        *at = turned_by(*at, by);
    }
    return 0;
}

#endif
