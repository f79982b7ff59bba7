/*
 * sphere_question.h - one line and one sphere, in scalar doubles
 *
 * With the origin x from the centre, the forms of a sphere and bounds on their
 * errors, from the largest components X of x and D of the direction d.  Roots
 * are rounded in two lanes, entry and exit.
 */
#ifndef CYLINT_SPHERE_QUESTION_H
#define CYLINT_SPHERE_QUESTION_H

#include "filter.h"
#include "lanes.h"

typedef struct {
    double x[3], X, D, r2, uu, B, G, G_error;
} sphere_line;

INLINE double dot_of(const double x[3], const double y[3])
{
    return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

INLINE double error_of(double size)
{
    return CYLINT_FILTER_BOUND * size + CYLINT_UNDERFLOW;
}

INLINE sphere_line load_sphere(const cylint_shape *shape,
                               const cylint_line *line)
{
    sphere_line l;
    const double *d = line->d;
    EACH(i, 3)
        l.x[i] = line->o[i] - shape->base[i];
    const double M[3] = {l.x[1] * d[2] - l.x[2] * d[1],
                         l.x[2] * d[0] - l.x[0] * d[2],
                         l.x[0] * d[1] - l.x[1] * d[0]};
    l.X =
        cylint_larger(cylint_larger(fabs(l.x[0]), fabs(l.x[1])), fabs(l.x[2]));
    l.D = line->size;
    l.r2 = shape->r0 * shape->r0;
    l.uu = dot_of(d, d);
    l.B = dot_of(l.x, d);
    l.G = l.r2 * l.uu - dot_of(M, M);
    l.G_error = error_of(l.D * l.D * (12 * (l.X * l.X) + 3 * l.r2));
    return l;
}

/* Whether the point nearest to the centre is certainly ahead of the origin. */
INLINE int is_sphere_ahead(const sphere_line *l)
{
    return l->B < -error_of(3 * l->X * l->D);
}

/* Where the point at t lies on a line that crosses the sphere. */
typedef enum {
    SPHERE_BEFORE,
    SPHERE_INSIDE,
    SPHERE_AFTER,
    SPHERE_UNCERTAIN
} sphere_place;

INLINE sphere_place place_in_sphere(const sphere_line *l,
                                    const cylint_line *line, double t)
{
    if (t > DBL_MAX)
        return SPHERE_AFTER;
    if (t < -DBL_MAX)
        return SPHERE_BEFORE;
    const double S = l->X + fabs(t) * l->D;
    double P[3];
    EACH(i, 3)
        P[i] = l->x[i] + t * line->d[i];
    const double C = dot_of(P, P) - l->r2, B = dot_of(P, line->d);
    const double eC = error_of(3 * (S * S) + l->r2);
    if (C < -eC)
        return SPHERE_INSIDE;
    if (!(C > eC) || !(fabs(B) > error_of(3 * S * l->D)))
        return SPHERE_UNCERTAIN;
    return B < 0 ? SPHERE_BEFORE : SPHERE_AFTER;
}

/* The stops in the domain, bit 0 the entry, by signs; or CYLINT_UNDECIDED. */
INLINE int sphere_stops(const sphere_line *l, const cylint_line *line)
{
    const sphere_place from = place_in_sphere(l, line, line->tmin);
    const sphere_place to = place_in_sphere(l, line, line->tmax);
    if (from == SPHERE_UNCERTAIN || to == SPHERE_UNCERTAIN)
        return CYLINT_UNDECIDED;
    return (from == SPHERE_BEFORE && to != SPHERE_BEFORE) |
           (from != SPHERE_AFTER && to == SPHERE_AFTER) << 1;
}

/* Both roots, rounded. */
INLINE lanes_root sphere_roots(const sphere_line *l, const cylint_shape *shape,
                               const cylint_line *line)
{
    const double R = sqrt(l->G), inverse = 1 / l->uu;
    const double R_error = R * (l->G_error / l->G + CYLINT_RADICAL_ROUNDING);
    const vd exits = v_two(-1, 1), roots = exits * v_set(R);
    const vd t = (roots - v_set(l->B)) * v_set(inverse), size_t_ = v_abs(t);
    const double num_error =
        (error_of(3 * l->X * l->D) + R_error) * CYLINT_LANES_SLACK;
    const double uu_error = error_of(3 * l->D * l->D);
    const vd t_error = (v_set(num_error) + size_t_ * v_set(uu_error)) *
                           v_set(inverse * CYLINT_LANES_SLACK) +
                       size_t_ * v_set(CYLINT_QUOTIENT_ROUNDING);
    vpair sum = v_two_prod(v_set(shape->r0), v_set(-shape->r0));
    vd S = v_set(0.5 * shape->r0);
    EACH(i, 3) {
        vpair step = v_two_prod(t, v_set(line->d[i]));
        step.lo = step.lo + t * v_set(line->d_lo[i]);
        const vpair P = vpair_add(
            v_two_sum(v_set(line->o[i]), v_set(-shape->base[i])), step);
        const vpair x = v_fast_two_sum(P.hi, P.lo);
        sum = vpair_add(sum, vpair_mul(x, x));
        S = v_max(S, v_abs(x.hi));
    }
    /* S is at least r / 2, so r^2 / S is at most 2 r */
    const vd r = v_set(shape->r0), reach = v_set(l->X) + size_t_ * v_set(l->D);
    const vd lost =
        v_set(CYLINT_LAZY_BOUND) * (v_set(3) * S * S + r * r) +
        v_set(CYLINT_MOVED_BOUND) * reach * (v_set(3) * S + v_set(2) * r) +
        v_set(CYLINT_UNDERFLOW);
    return newton_root(sum.hi + sum.lo, lost, roots + roots, v_set(2 * R_error),
                       v_set(l->uu), (bounded_value){t, t_error});
}

#endif
