/*
 * safety.c - a lower bound of a distance, in doubles
 *
 * The distance is computed in local coordinates (shapes/local.h) with a bound on
 * its error, which is subtracted.  It is right in every rounding mode.  Where
 * local coordinates are not accurate enough, and for shapes without a cap, it is
 * the double below the distance.
 *
 * The local coordinates of an elliptic shape are stretched: the world's distance
 * is at least the local one divided by the norm of the matrix.
 */
#include "../numbers/bits.h"
#include "../shapes/shape_facts.h"
#include "cylint_distance.h"
#include "elliptic.h"

static double root(double x)
{
    return sqrt(x);
}

static double below_distance(const cylint_shape *shape, const double point[3])
{
    cylint_closest answer;
    answer.part = 0;
    const double size = fabs(cylint_distance(shape, point, 0, &answer));
    if (answer.part < 0 || cylint_sign(size) == 0)
        return size;
    const double below = -cylint_next_above(-size) + 0; /* no -0 */
    return cylint_is_elliptic(shape->kind)
               ? cylint_below_elliptic(shape, point, below)
               : below;
}

/* A point and a shape in the half plane through the axis and the point. */
typedef struct {
    double z, above, rho; /* above: z - height */
    double r[2], cosine, sine;
    double size; /* of all terms */
} position;

static double length(double x, double y)
{
    return root(x * x + y * y);
}

/* The distance from a ball, positive outside. */
static double from_ball(double z, double rho, double r)
{
    return length(z, rho) - r;
}

static double capsule_distance(const position *at)
{
    const double S = at->sine, C = at->cosine;
    if (C * at->z + S * at->rho < 0)
        return from_ball(at->z, at->rho, at->r[0]);
    if (C * at->above + S * at->rho > 0)
        return from_ball(at->above, at->rho, at->r[1]);
    return C * at->rho - S * at->z - at->r[0];
}

/* The solid between the planes. */
static double capped_distance(const position *at)
{
    const double S = at->sine, C = at->cosine;
    const double x0 = at->rho - at->r[0], x1 = at->rho - at->r[1];
    const double lateral = C * x0 - S * at->z;
    const double beyond = cylint_larger(-at->z, at->above);
    if (lateral <= 0 && beyond <= 0)
        return cylint_larger(lateral, beyond);
    if (at->z < 0 && x0 < 0)
        return -at->z;
    if (at->above > 0 && x1 < 0)
        return at->above;
    return C * at->z + S * x0 < 0       ? length(x0, at->z)
           : C * at->above + S * x1 > 0 ? length(x1, at->above)
                                        : lateral;
}

/* An unbounded straight shape, or a double cone. */
static double infinite_distance(const position *at)
{
    const double c = at->sine * at->z + at->cosine * at->r[0];
    return at->cosine * at->rho - fabs(c);
}

static double distance_at(const position *at, const cylint_shape *s)
{
    return cylint_is_round(s->kind)          ? capsule_distance(at)
           : s->ends == CYLINT_ENDS_INFINITE ? infinite_distance(at)
                                             : capped_distance(at);
}

/* Circular kinds: the rejection of the point from the axis has no larger error
 * than z. */
static void locate(position *at, const cylint_shape *s, const double point[3])
{
    const cylint_local *f = &s->local;
    const double X = point[0] - s->base[0], Y = point[1] - s->base[1],
                 Z = point[2] - s->base[2];
    const double a = f->xyz[0][2], b = f->xyz[1][2], c = f->xyz[2][2];
    const double z = X * a + Y * b + Z * c;
    const double x = X - z * a, y = Y - z * b, w = Z - z * c;
    at->z = z;
    at->rho = root(x * x + y * y + w * w);
    at->size = fabs(X) + fabs(Y) + fabs(Z);
    at->cosine = f->cosine;
    at->sine = f->sine;
}

static void locate_elliptic(position *at, const cylint_shape *s,
                            const double point[3])
{
    const cylint_local *f = &s->local;
    double x = 0, y = 0, z = 0, size = 0;
    for (int i = 0; i < 3; i++) {
        const double D = point[i] - s->base[i];
        x += D * f->xyz[i][0];
        y += D * f->xyz[i][1];
        z += D * f->xyz[i][2];
        size += fabs(D);
    }
    at->z = z;
    at->rho = length(x, y);
    at->size = size * f->norm;
    at->cosine = 1 / root(1 + f->slope * f->slope);
    at->sine = f->slope * at->cosine;
}

/* The largest factor by which local coordinates stretch a length: the
 * Frobenius norm of the matrix, of which no row is longer than `norm`. */
static double stretch(const cylint_shape *s)
{
    return cylint_is_elliptic(s->kind) ? 2 * s->local.norm : 1;
}

static int is_served(const cylint_shape *s)
{
    const int closed =
        s->ends == CYLINT_ENDS_CAPPED || s->ends == CYLINT_ENDS_INFINITE;
    return closed && s->prepared && !cylint_has_tangent(s->kind);
}

static double sphere_distance(const cylint_shape *s, const double point[3],
                              double *error)
{
    const double X = point[0] - s->base[0], Y = point[1] - s->base[1],
                 Z = point[2] - s->base[2];
    const double size = root(X * X + Y * Y + Z * Z);
    *error = CYLINT_SPHERE_SAFETY_ERROR * (size + s->r0);
    return size - s->r0;
}

static double local_distance(const cylint_shape *s, const double point[3],
                             double *error)
{
    position at;
    if (cylint_is_elliptic(s->kind))
        locate_elliptic(&at, s, point);
    else
        locate(&at, s, point);
    at.above = at.z - s->local.height;
    at.r[0] = s->r0;
    at.r[1] = s->r1;
    *error = CYLINT_SAFETY_ERROR * (at.size + s->local.reach + s->r0);
    return distance_at(&at, s);
}

double cylint_safety(const cylint_shape *shape, const double point[3])
{
    if (!is_served(shape))
        return below_distance(shape, point);
    double error;
    const double distance = shape->kind == CYLINT_KIND_SPHERE
                                ? sphere_distance(shape, point, &error)
                                : local_distance(shape, point, &error);
    const double bound = fabs(distance) - error;
    if (!(bound > 0 && bound <= DBL_MAX)) /* near the surface, or overflow */
        return below_distance(shape, point);
    return cylint_is_elliptic(shape->kind)
               ? bound / stretch(shape) * (1 - CYLINT_SAFETY_ERROR)
               : bound;
}
