/*
 * elliptic_certainty.h - how far the height or distance at an angle can be from
 * that of the nearest point of an elliptic shape
 *
 * Nothing here depends on how the angle was found.  Let l = n' - n N.V / N.N
 * (elliptic_angle.h), which is 0 at the nearest point.
 *
 * Outside the lateral surface the height h is a lower bound of the distance.  The
 * foot on the tangent plane has (x, y).e = rho and l across e.  At d = l^2 / (rho
 * |N|) below it, (x, y).e is less by d |N|, which is twice what is needed for
 * (x, y)^2 <= rho^2, if l is so small that the other changes are small: at most 1/8
 * of rho and of l.  That point is in the solid.  So the distance is at most h + d,
 * and the nearest point, below the tangent plane and in the ball of that radius, is
 * within sqrt(2 h d) + 2 d of the foot.
 *
 * Inside, h^2 < n^2 / N.N for all other angles is wanted.  With h of this angle,
 * and t the tangent of half the turn from it,
 *     (n^2 - h^2 N.N) (1 + t^2)^2
 * is a polynomial 4 g t (1 + t^2) + t^2 (K2 + K3 t + K4 t^2), where g is n l.
 * Where K2 + K3 t + K4 t^2 >= k (1 + t^2) with k > 0, the square of the
 * distance is less than that at this angle by at most 4 g^2 / k, and the nearest
 * angle has t <= 4 g / k.  The lesser h changes K2 to K4 by less than k / 2 where
 * 8 l h |norm| <= k.
 *
 * R from a point of the rim, in whose plane the height is h, has the component w =
 * |R.u'| / |u'| = |l u'| along the rim.  So the distance is less than |R| by at
 * most w^2 / |R| and twice the bound for the height.
 *
 * Beside the lateral surface, on either side, let c = norm / |N| and 16 c (l +
 * 2 |n| c) <= rho.  A turn changes n by n' sin - 2 (n + rho) s^2, where s is
 * the sine of half the turn, and N by at most 2 norm |s|.  So a plane that is
 * as high as that of this angle has |s| <= (l + 2 |n| c) / (n + rho) <= 1 / (15
 * c).  The length of its normal is at least 13/15 |N|, and exceeds its
 * component along N by at most 2.4 c norm s^2.  Its n - h |N| is then at most
 *     2 l |s| - 2 s^2 (n + rho - |n| c - 1.2 |n| c^2) <= 2 l |s| - 1.8 rho s^2.
 * So the highest plane is higher by less than l^2 / (rho |N|), and the turn to
 * it is below 4 l / rho: the bounds of inside for k = 4 |n| rho.  The plane rho
 * = 0 through the apex is farther, so the foot on the highest plane is a point
 * of this nappe, the nearest one, and the other nappe is farther.
 */
#ifndef CYLINT_ELLIPTIC_CERTAINTY_H
#define CYLINT_ELLIPTIC_CERTAINTY_H

#include "elliptic_angle.h"

/* The numbers of the angle in doubles stay in use after a step in pairs.  It is at
 * most 1/16 of |N| / norm, so that N changes by 1/16 of it, and at most
 * CYLINT_PAIR_TURN.  K2 is at least CYLINT_CURVATURE_ERROR of the sizes of the
 * terms, or k is not positive, and K3^2 is below 4 K2 K4, so that K2 changes by a
 * part of about 2 sqrt(K4 / K2) of the step: 2^-3.  The bounds are twice what is
 * needed. */
#define CYLINT_PAIR_TURN 0x1p-24

/* Bounds on the errors of the distance and the nearest point of an angle, and of
 * the angle itself. */
typedef struct {
    double distance, away, turn;
} uncertainty;

static const uncertainty uncertain_angle = {HUGE_VAL, HUGE_VAL, HUGE_VAL};

/* k from the coefficients of 1 - cos, sin^2, sin (1 - cos) and (1 - cos)^2 of the
 * turn, less their error. */
static inline double least_curvature(double p1, double p2, double p3, double p4,
                                     double error)
{
    const double K2 = 2 * p1 + 4 * p2, half = 2 * p3, K4 = 2 * p1 + 4 * p4;
    const double middle = 0.5 * (K2 - K4);
    return 0.5 * (K2 + K4) - sqrt(middle * middle + half * half) - error;
}

/* The relative error of N, whose terms can cancel. */
static inline double normal_error(const tangent_plane *t,
                                  const elliptic_place *p)
{
    return 4 * p->relative * p->norm / t->size;
}

/* k for tangent planes and a point on the inner side of all. */
static inline double inner_curvature(const tangent_plane *t,
                                     const elliptic_place *p)
{
    const double a = t->n + p->rho, b = t->slope_of_n;
    const double hh = t->n * t->n / t->q;
    const double size = fabs(p->x) + fabs(p->y) + fabs(p->rho);
    const double of_N = hh * p->norm * p->norm;
    const double error = CYLINT_CURVATURE_ERROR * (size * size + of_N) +
                         16 * normal_error(t, p) * of_N +
                         64 * p->error * (size + of_N / fabs(t->n));
    return least_curvature(2 * (hh * cylint_dot(t->N, t->U) - t->n * a),
                           b * b - hh * cylint_dot(t->V, t->V),
                           2 * (hh * cylint_dot(t->U, t->V) - a * b),
                           a * a - hh * cylint_dot(t->U, t->U), error);
}

/* k beside the surface, on either side; 0 elsewhere.  CYLINT_CLOSE affects only the
 * speed. */
static inline double curvature_beside(const tangent_plane *t,
                                      const elliptic_place *p, double l)
{
    const double n = fabs(t->n) + p->error;
    return n <= CYLINT_CLOSE * p->rho &&
                   16 * p->norm * (l * t->size + 2 * n * p->norm) <=
                       p->rho * t->q
               ? 4 * n * p->rho
               : 0;
}

/* |N x V|: what the length of N times the turn of its direction gains by the
 * angle. */
static inline double turn_of_normal(const tangent_plane *t)
{
    double x[3];
    EACH(i, 3) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        x[i] = t->N[j] * t->V[k] - t->N[k] * t->V[j];
    }
    return sqrt(cylint_dot(x, x));
}

/* l: an upper bound.  rho: at the foot.  The normals of the nearest point and
 * of the angle differ by 2 away / h at most. */
static inline uncertainty outside_lateral(const tangent_plane *t,
                                          const elliptic_place *p, double l,
                                          double rho)
{
    if (!(8 * l <= rho))
        return uncertain_angle;
    const double size = t->size, h = (fabs(t->n) + p->error) / size;
    const double deeper = l * l / (rho * size);
    const double away = 2 * (l * sqrt(h / (rho * size)) + deeper);
    /* what V and the gradient of rho gain along N, at most */
    const double beside =
        (fabs(t->half_q) + fabs(p->slope * cylint_dot(p->Z, t->N))) / size +
        4 * p->relative * p->norm;
    if (!(8 * l * beside <= rho * size))
        return uncertain_angle;
    return (uncertainty){deeper, away,
                         4 * away * t->q / (h * turn_of_normal(t))};
}

static inline uncertainty inside_lateral_surface(const tangent_plane *t,
                                                 const elliptic_place *p,
                                                 double l, double k)
{
    const double n = fabs(t->n) + p->error, size = t->size, h = n / size;
    const double distance = 4 * h * l * l / k, turn = 16 * n * l / k;
    if (!(8 * l * h * p->norm <= k))
        return uncertain_angle;
    return (uncertainty){distance, distance + h * p->norm / size * turn, turn};
}

#endif
