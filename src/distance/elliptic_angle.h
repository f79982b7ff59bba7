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
 * cone nearly that, if the gradients X and Y of x and y are perpendicular to that
 * of rho, Z (make_upright()).  A rim is the ellipse of a right cylinder
 * (project_on_end()).  The point Q is the nearest point plus t N.  If X and Y are
 * perpendicular, too, this is
 *     cos = x / (rho + t (X.X + Z.Z)), sin = y / (rho + t (Y.Y + Z.Z)).
 * The root t of cos^2 + sin^2 = 1 for which both divisors are positive is that of
 * the nearest point of all.  It is computed as that of sqrt(cos^2 + sin^2) = 1,
 * whose inverse is nearly a straight line, by Newton's iteration from the left.
 * [Eberly 2013, "Distance from a point to an ellipse".]
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

/* Newton's iteration ends after a step below this, or below the other where a rough
 * angle is enough: the error is about its square. */
#define CYLINT_ANGLE_STEP 0x1p-20
#define CYLINT_ROUGH_STEP 0x1p-6

enum { CYLINT_SECULAR_STEPS = 40, CYLINT_VELOCITY_STEPS = 12 };

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

/* ------------------------------------------------- the lateral surface -- */

/* What the height over a tangent plane and its derivatives by the angle are made
 * of: n, N = U + G, where G is the part that does not depend on the angle. */
typedef struct {
    double n, slope_of_n;    /* n' */
    double U[3], V[3], N[3]; /* U' = V */
    double q, half_q, size;  /* N.N, N.V, |N| */
    /* No eigenvalue of S (elliptic_certainty.h) is above `most` or below -down. */
    double most, down;
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

/* ------------------------------------------------------------ the angle -- */

/* The products of X, Y and Z, where Z is perpendicular to X and Y, and x, y and rho
 * of the point.  A hyperbolic rotation of those of the shape leads to them and
 * leaves x^2 + y^2 - rho^2 as it is.  (bx, by): its velocity; f, k: its factors. */
typedef struct {
    double xx, xy, yy, zz, x, y, rho, bx, by, f, k;
} upright;

/* The velocity is (xx + s, xy, yy + s)^-1 (xz, yz) for the s that zz becomes.  This
 * is zz - (bx, by).(xz, yz): Newton's iteration leads down to it, and ends where it
 * is nearer than the square of `last`.  Here b is d / det. */
static inline void make_upright(upright *u, const elliptic_place *p,
                                double last)
{
    const double xx = cylint_dot(p->X, p->X), xy = cylint_dot(p->X, p->Y),
                 yy = cylint_dot(p->Y, p->Y),
                 xz = p->slope * cylint_dot(p->X, p->Z),
                 yz = p->slope * cylint_dot(p->Y, p->Z),
                 zz = p->slope * p->slope * cylint_dot(p->Z, p->Z);
    double s = zz, det, dx, dy, d_d;
    *u = (upright){xx, xy, yy, zz, p->x, p->y, p->rho, 0, 0, 1, 0};
    for (int i = 0;; i++) {
        det = (xx + s) * (yy + s) - xy * xy;
        dx = (yy + s) * xz - xy * yz;
        dy = (xx + s) * yz - xy * xz;
        d_d = dx * dx + dy * dy;
        const double over = (s - zz) * det + dx * xz + dy * yz;
        if (i >= CYLINT_VELOCITY_STEPS || !(over > last * last * zz * det))
            break;
        s -= over * det / (det * det - d_d);
    }
    if (!(d_d > 0 && d_d < det * det))
        return;
    const double bx = dx / det, by = dy / det,
                 f = fabs(det) / sqrt(det * det - d_d), k = f * f / (1 + f),
                 hx = bx * xx + by * xy, hy = bx * xy + by * yy,
                 bh = bx * hx + by * hy, bz = bx * xz + by * yz;
    /* X + bx V and Y + by V with V = k (bx X + by Y) - f Z */
    const double xv = k * hx - f * xz, yv = k * hy - f * yz,
                 vv = k * (k * bh - 2 * f * bz) + f * f * zz,
                 along = bx * p->x + by * p->y, v = k * along - f * p->rho;
    *u = (upright){xx + bx * (2 * xv + bx * vv),
                   xy + bx * yv + by * xv + bx * by * vv,
                   yy + by * (2 * yv + by * vv),
                   f * f * (zz - 2 * bz + bh),
                   p->x + bx * v,
                   p->y + by * v,
                   f * (p->rho - along),
                   bx,
                   by,
                   f,
                   k};
}

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

/* cos and sin for H_y / H_x times x, y, and H_y / H_x - 1 times rho.  H_x < H_y are
 * the factors of t; s is rho + t H_y.  The iteration ends after a relative step of
 * `last`.  NaN between two nearest points on an axis: sqrt() of a NaN would set
 * errno under Windows. */
static inline angle secular_angle(double along, double across, double excess,
                                  double last)
{
    const double u = fabs(along), v = fabs(across),
                 least = cylint_smaller(excess, 0);
    /* mutant '>' -> '>=': no effect */
    double s = v > u - excess ? v : u - excess, by;
    angle to;
    if (!(s + least > 0))
        return (angle){NAN, NAN};
    for (int i = 0; i < CYLINT_SECULAR_STEPS; i++) {
        const double to_u = 1 / (s + excess), to_v = 1 / s;
        const double a = u * to_u * (u * to_u), b = v * to_v * (v * to_v);
        by = (sqrt(a + b) - 1) * (a + b) / (a * to_u + b * to_v);
        s += by > 0 ? by : 0;
        if (!(by > last * (s + least)))
            break;
    }
    to.cos = copysign(u / (s + excess), along);
    to.sin = copysign(v / s, across);
    return to;
}

/* Writes the angle, and its tangent plane.  Returns 0 if there is none. */
ASIDE int find_lateral_angle(angle *at, tangent_plane *t,
                             const elliptic_place *p, int rough)
{
    const double last = rough ? CYLINT_ROUGH_STEP : CYLINT_ANGLE_STEP;
    upright u;
    make_upright(&u, p, last);
    const principal_axes H = axes_of(u.xx + u.zz, u.xy, u.yy + u.zz);
    const angle e =
        secular_angle(H.most / H.least * (H.c * u.y - H.s * u.x),
                      H.c * u.x + H.s * u.y, H.gap / H.least * u.rho, last);
    if (isnan(e.cos))
        return 0;
    const double x = H.c * e.sin - H.s * e.cos, y = H.s * e.sin + H.c * e.cos,
                 xy = u.k * u.bx * u.by,
                 c = (1 + u.k * u.bx * u.bx) * x + (xy * y + u.f * u.bx),
                 s = (1 + u.k * u.by * u.by) * y + (xy * x + u.f * u.by),
                 scale = 1 / sqrt(c * c + s * s);
    /* f errs by f^2 roundings; ten times what is needed */
    const double size = u.f * u.f * p->norm,
                 error = 64 * p->relative * size * size;
    t->most = H.most - u.zz + error;
    t->down = u.zz + error;
    *at = (angle){c * scale, s * scale};
    load_tangent_plane(t, p, *at);
    return 1;
}

#endif
