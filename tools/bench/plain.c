/*
 * plain.c - the plain quadratic: the textbook's formula in few operations
 *
 * The library's time is compared with it: expanded dot products, B^2 - AC, a
 * square root, and the slab of the caps; w.w is prepared.  It writes hit or
 * miss and t, and is wrong where digits cancel.
 */
#include <math.h>

#include "contestants.h"
#include "vectors.h"
#include "../../src/shapes/shape_facts.h"

int plain_answers_for(const cylint_shape *shape)
{
    return (shape->kind == CYLINT_KIND_CYLINDER ||
            shape->kind == CYLINT_KIND_CONE) &&
           (shape->ends == CYLINT_ENDS_CAPPED ||
            shape->ends == CYLINT_ENDS_INFINITE);
}

/* Clips [t0, t1] to the planes z = 0 and z = 1; returns whether it is not
 * empty. */
static inline int clip_to_slab(double at, double slope, double height,
                               double *t0, double *t1)
{
    if (slope == 0)
        return at >= 0 && at <= height;
    const double a = -at / slope, b = (height - at) / slope;
    const double first = a < b ? a : b, last = a < b ? b : a;
    if (first > *t0)
        *t0 = first;
    if (last < *t1)
        *t1 = last;
    return *t0 <= *t1;
}

static inline int add_hit(const cylint_line *line, unsigned want, double t,
                          cylint_answer *answer)
{
    if (!(t >= line->tmin && t <= line->tmax && fabs(t) < HUGE_VAL))
        return 0;
    if (want & CYLINT_WANT_T)
        answer->hit[answer->n].t = t;
    answer->n++;
    return (want & CYLINT_WANT_NEAREST) != 0;
}

/* Inside: A t^2 + 2 B t + C <= 0. */
struct quadric {
    double A, B, C;
    double rho_slope;  /* slope of the cone's radius along the line */
    double z, z_slope; /* times w.w */
};

static inline struct quadric expand(const struct subject *s,
                                    const cylint_line *line)
{
    const double *d = line->d, *w = cylint_axis(&s->shape),
                 *base = cylint_base(&s->shape);
    const double D[3] = {line->o[0] - base[0], line->o[1] - base[1],
                         line->o[2] - base[2]};
    const double ww = s->axis_axis, wd = dot3(w, d), wD = dot3(w, D);
    struct quadric q = {ww * dot3(d, d) - wd * wd,
                        ww * dot3(d, D) - wd * wD,
                        ww * dot3(D, D) - wD * wD,
                        0,
                        wD,
                        wd};
    if (s->shape.kind == CYLINT_KIND_CYLINDER) {
        q.C -= s->radius;
    } else {
        const double rho = s->radius + cylint_radius_growth(&s->shape).hi * wD;
        q.rho_slope = cylint_radius_growth(&s->shape).hi * wd;
        q.A = ww * q.A - q.rho_slope * q.rho_slope;
        q.B = ww * q.B - rho * q.rho_slope;
        q.C = ww * q.C - rho * rho;
    }
    return q;
}

/* A = 0: the line is parallel to the axis or to a ruling of a cone. */
static int linear_roots(const struct quadric *q, double *t0, double *t1)
{
    *t0 = -HUGE_VAL;
    *t1 = HUGE_VAL;
    if (q->B == 0)
        return q->C <= 0;
    *(q->B > 0 ? t1 : t0) = -q->C / (2 * q->B);
    return 1;
}

static inline int roots(const struct quadric *q, double disc, double *t0,
                        double *t1)
{
    if (q->A == 0)
        return linear_roots(q, t0, t1);
    const double root = sqrt(disc), a = (-q->B - root) / q->A;
    const double b = (-q->B + root) / q->A;
    *t0 = a < b ? a : b;
    *t1 = a < b ? b : a;
    return 1;
}

/* A line steeper than the rulings is inside the double cone on both sides of
 * [t0, t1].  A bounded cone has only the side where rho > 0. */
static inline void other_side(double rho_slope, double *t0, double *t1)
{
    const double low = *t0;
    *t0 = rho_slope > 0 ? *t1 : -HUGE_VAL;
    *t1 = rho_slope > 0 ? HUGE_VAL : low;
}

cylint_status plain_quadratic(const cylint_shape *shape,
                              const cylint_line *line, unsigned want,
                              cylint_answer *answer)
{
    const struct subject *s = (const struct subject *)(const void *)shape;
    const struct quadric q = expand(s, line);
    const double disc = q.B * q.B - q.A * q.C;
    double t0, t1;

    answer->relation = CYLINT_RELATION_MISS;
    answer->n = 0;
    answer->flags = 0;
    if (!(disc >= 0))
        return CYLINT_OK;
    if (shape->ends == CYLINT_ENDS_INFINITE && !(want & CYLINT_WANT_T) &&
        q.A != 0 && line->tmin == -HUGE_VAL && line->tmax == HUGE_VAL) {
        answer->relation =
            disc > 0 || q.A < 0 ? CYLINT_RELATION_CROSS : CYLINT_RELATION_TOUCH;
        answer->n = want & CYLINT_WANT_NEAREST || disc == 0 ? 1 : 2;
        return CYLINT_OK;
    }
    if (!roots(&q, disc, &t0, &t1))
        return CYLINT_OK;
    if (shape->ends == CYLINT_ENDS_CAPPED) {
        if (q.A < 0)
            other_side(q.rho_slope, &t0, &t1);
        if (!clip_to_slab(q.z, q.z_slope, s->axis_axis, &t0, &t1))
            return CYLINT_OK;
    }
    answer->relation = q.A == 0 && q.B == 0 && q.C == 0 ? CYLINT_RELATION_ALONG
                       : t0 < t1 || q.A < 0             ? CYLINT_RELATION_CROSS
                                                        : CYLINT_RELATION_TOUCH;
    if (!add_hit(line, want, t0, answer) && t0 < t1)
        add_hit(line, want, t1, answer);
    return CYLINT_OK;
}
