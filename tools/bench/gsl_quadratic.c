/*
 * gsl_quadratic.c - the plain quadratic's coefficients, solved by the GNU
 * Scientific Library
 *
 * gsl_poly_solve_quadratic avoids the cancellation in -B +- sqrt(...), but not
 * that in B^2 - 4AC.  It returns the number of roots, so it answers for
 * infinite shapes only.
 */
#include <gsl/gsl_poly.h>

#include "contestants.h"
#include "vectors.h"
#include "../../src/shapes/shape_facts.h"

static inline int solve(const struct subject *s, const cylint_line *line,
                        double *leading, double t[2])
{
    const double *d = line->d, *w = cylint_axis(&s->shape),
                 *base = cylint_base(&s->shape);
    const double D[3] = {line->o[0] - base[0], line->o[1] - base[1],
                         line->o[2] - base[2]};
    const double ww = s->axis_axis, wd = dot3(w, d), wD = dot3(w, D);
    double A = ww * dot3(d, d) - wd * wd;
    double B = 2 * (ww * dot3(d, D) - wd * wD);
    double C = ww * dot3(D, D) - wD * wD;
    if (s->shape.kind == CYLINT_KIND_CYLINDER) {
        C -= s->radius;
    } else {
        const double rho = s->radius + cylint_radius_growth(&s->shape).hi * wD;
        const double slope = cylint_radius_growth(&s->shape).hi * wd;
        A = ww * A - slope * slope;
        B = ww * B - 2 * rho * slope;
        C = ww * C - rho * rho;
    }
    *leading = A;
    return gsl_poly_solve_quadratic(A, B, C, &t[0], &t[1]);
}

cylint_status gsl_quadratic(const cylint_shape *shape, const cylint_line *line,
                            unsigned want, cylint_answer *answer)
{
    const struct subject *s = (const struct subject *)(const void *)shape;
    double t[2];

    answer->relation = CYLINT_RELATION_MISS;
    answer->n = 0;
    answer->flags = 0;
    if (shape->ends != CYLINT_ENDS_INFINITE || !plain_answers_for(shape)) {
        answer->flags = CYLINT_FLAG_INVALID;
        return CYLINT_EMETHOD;
    }
    double A;
    const int n = solve(s, line, &A, t);
    if (n == 0)
        return CYLINT_OK;
    const int one =
        n == 2 && t[0] == t[1]; /* A < 0: through a double cone's apex */
    answer->relation =
        one && A > 0 ? CYLINT_RELATION_TOUCH : CYLINT_RELATION_CROSS;
    for (int i = 0; i < (one ? 1 : n); i++) {
        if (t[i] < line->tmin || t[i] > line->tmax)
            continue;
        if (want & CYLINT_WANT_T)
            answer->hit[answer->n].t = t[i];
        answer->n++;
        if (want & CYLINT_WANT_NEAREST)
            break;
    }
    return CYLINT_OK;
}
