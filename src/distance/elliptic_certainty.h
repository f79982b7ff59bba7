/*
 * elliptic_certainty.h - how far the height or distance at an angle can be from
 * that of the nearest point of an elliptic shape
 *
 * Nothing here depends on how the angle was found.  From the base of a cylinder or
 * the apex of a cone the lateral surface is Y.SY = 1 or 0, where S = x x^T + y y^T
 * - (k - 1)^2 z z^T.  Let Y be the point of the ruling of the angle with the z of
 * the foot of the perpendicular from Q on the tangent plane, and h the height.  The
 * foot is Y + l u', where l = n' - n N.V / N.N (elliptic_angle.h) is 0 at the
 * nearest point.  As SY = rho N,
 *     Q = Y + m SY + l u', m = n / (rho N.N).
 * For any other point Z of the surface, on both nappes, since Z.SZ = Y.SY,
 *     |Z - Q|^2 - |Y - Q|^2 = (Z - Y).(1 + m S)(Z - Y) - 2 l (Z - Y).u'.
 * Let `least`, at most the least eigenvalue of 1 + m S, be positive.  Then no point
 * that is nearer than Y is farther from it than 2 l |u'| / least.  With Su' = V and
 * u'.V = 1, the square of no distance is less than h^2 + m l^2 - (m l)^2 V.V /
 * least.  Bounds on |m| and on the eigenvalues of S give `least`.  On a rim, Y.SY
 * is the square of its factor.  Outside a convex shape the first bound is right for
 * least = 1, because projections on it reduce distances, and no distance is below
 * h.
 *
 * A hyperbolic rotation (make_upright()) leaves S as it is.  So whatever its
 * velocity, no eigenvalue is above that of X X^T + Y Y^T or below -Z.Z afterwards.
 *
 * Inside, the distance is at most h.  Outside, let G be the point l^2 / (rho |N|)
 * below the foot, where (Y + l u').S(Y + l u') exceeds Y.SY by l^2.  With
 * s = (|N.V| + |(k - 1) z.N|) / N.N, G is in the solid if l (1 + s) <= rho / 4.
 *
 * The turn from the angle to that of Z has the sine V.(Z - Y) / rho at Z.  Here the
 * part of Z - Y along N is at most |Z - Y|^2 norm^2 / (2 rho |N|).  If the turn is
 * small beside `across` / norm and |N| / norm, where `across` is the part of V
 * across N, then N / |N| turns by about across / |N| times it, and by at most 2 (l
 * |u'| + |Z - Y|) / h.
 *
 * The bounds are twice what is needed.
 */
#ifndef CYLINT_ELLIPTIC_CERTAINTY_H
#define CYLINT_ELLIPTIC_CERTAINTY_H

#include "elliptic_angle.h"

/* The foot of the perpendicular on a tangent plane. */
typedef struct {
    double z, z_error;
    double rho; /* at least */
    double m;   /* |m|, at most; outside a convex shape 0 */
    double least;
} plane_foot;

/* Bounds on the errors of the distance and the nearest point of an angle. */
typedef struct {
    double distance, away;
} uncertainty;

/* A question in doubles. */
typedef struct {
    const cylint_shape *shape;
    elliptic_place at;
    int feature, is_turned;
    /* 1: within the lateral surface, -1: outside it, 0: uncertain: beside it or,
     * within it, beside the plane of an end */
    int side;
    int rough; /* a rough angle is enough */
    angle e;
    tangent_plane plane;
    plane_foot foot; /* on that plane */
    uncertainty by;  /* of the angle */
} elliptic_question;

/* The relative error of N, whose terms can cancel. */
static inline double normal_error(const tangent_plane *t,
                                  const elliptic_place *p)
{
    return 4 * p->relative * p->norm / t->size;
}

/* Whether the other nappe of a cone does not belong to the surface. */
static inline int is_convex(const elliptic_question *q)
{
    return q->shape->ends != CYLINT_ENDS_INFINITE || q->at.slope == 0;
}

static inline void load_foot(elliptic_question *q)
{
    const tangent_plane *t = &q->plane;
    const elliptic_place *p = &q->at;
    plane_foot *f = &q->foot;
    const double n = fabs(t->n) + p->error, turned = normal_error(t, p),
                 down = t->n / t->q * cylint_dot(t->N, p->Z);
    f->z = p->z - down;
    f->z_error =
        4 * p->z_norm * (p->error + n * (turned + p->relative)) / t->size;
    f->rho = p->rho - p->slope * down - p->error - fabs(p->slope) * f->z_error;
    f->m = t->n > p->error && is_convex(q)
               ? 0
               : n / (f->rho * t->q * (1 - 2 * turned));
    f->least = 1 - f->m * (t->n > p->error    ? t->down
                           : t->n < -p->error ? t->most
                                              : p->norm * p->norm);
}

/* Whether the nearest point is near Y for a small l. */
static inline int is_foot_nearest(const elliptic_question *q)
{
    return normal_error(&q->plane, &q->at) < 0x1p-10 && q->foot.rho > 0 &&
           q->foot.least > 0;
}

/* |u'| */
static inline double length_of_turn(const elliptic_question *q)
{
    double du[3];
    EACH(i, 3)
        du[i] =
            q->e.cos * cylint_b(q->shape)[i] - q->e.sin * cylint_a(q->shape)[i];
    return sqrt(cylint_dot(du, du));
}

/* |(k - 1) z.N| and |N.V|, over N.N, and its error. */
static inline double bend_of(const elliptic_question *q)
{
    const tangent_plane *t = &q->plane;
    const elliptic_place *p = &q->at;
    return (fabs(t->half_q) + fabs(p->slope * cylint_dot(p->Z, t->N))) / t->q +
           normal_error(t, p) * p->norm / t->size;
}

/* l: an upper bound of its size.  Infinite bounds where nothing is certain. */
static inline uncertainty uncertainty_of(const elliptic_question *q, double l)
{
    const tangent_plane *t = &q->plane;
    const plane_foot *f = &q->foot;
    if (!(is_foot_nearest(q) && 4 * l * (1 + bend_of(q)) <= f->rho))
        return (uncertainty){HUGE_VAL, HUGE_VAL};
    const double deeper = 2 * l * l / (f->rho * t->size),
                 away = 4 * l * length_of_turn(q) / f->least;
    /* the nearest point is not the apex */
    if (!q->rough && !(fabs(q->at.slope) * q->at.z_norm * away < f->rho))
        return (uncertainty){HUGE_VAL, HUGE_VAL};
    return (uncertainty){
        deeper * (1 + f->m * cylint_dot(t->V, t->V) / f->least), away};
}

/* A bound on the turn to the nearest point. */
static inline double turn_of(const elliptic_question *q)
{
    const tangent_plane *t = &q->plane;
    const double norm = q->at.norm, rho = q->foot.rho, away = q->by.away,
                 off = norm * away, vv = cylint_dot(t->V, t->V);
    const double square = cylint_larger(vv - t->half_q * t->half_q / t->q, 0),
                 error = 4 * normal_error(t, &q->at) * norm * norm,
                 across = sqrt(square + error);
    const double turn =
        2 * (across * away + off * off * norm / (rho * t->size)) / rho;
    const double n = fabs(t->n) - q->at.error;
    return n > 0 && 4 * error <= square &&
                   4 * turn * norm <= cylint_smaller(across, t->size)
               ? cylint_smaller(turn, 4 * away * t->q / (n * across))
               : turn;
}

#endif
