/*
 * shader.c - a capped cylinder by the formula that shaders use
 *
 * Dot products with the unnormalised axis, and the nearer lateral root; if
 * that lies beyond a cap, the cap's root.  It writes the first hit of the
 * whole line or none: no relation and no second hit.  A line exactly parallel
 * to the axis gives NaN (0/0).
 */
#include <math.h>

#include "contestants.h"
#include "vectors.h"
#include "../../src/shapes/layout.h"

int shader_answers_for(const cylint_shape *shape)
{
    return shape->kind == CYLINT_KIND_CYLINDER &&
           shape->ends == CYLINT_ENDS_CAPPED;
}

/* Writes t and returns 1, or returns 0.  The lateral surface is the equation
 * k2 t^2 + 2 k1 t + k0 = 0. */
static inline int first_hit(const struct subject *s, const cylint_line *line,
                            double *t)
{
    const double *base = cylint_base(&s->shape), *ba = cylint_axis(&s->shape);
    const double oc[3] = {line->o[0] - base[0], line->o[1] - base[1],
                          line->o[2] - base[2]};
    const double baba = s->axis_axis;
    const double bard = dot3(ba, line->d), baoc = dot3(ba, oc);
    const double k2 = baba * dot3(line->d, line->d) - bard * bard;
    const double k1 = baba * dot3(oc, line->d) - baoc * bard;
    const double k0 = baba * dot3(oc, oc) - baoc * baoc - s->radius;
    const double h = k1 * k1 - k2 * k0;
    if (h < 0)
        return 0;
    const double root = sqrt(h);
    *t = (-k1 - root) / k2;
    const double y = baoc + *t * bard;
    if (y > 0 && y < baba)
        return 1;
    *t = ((y < 0 ? 0 : baba) - baoc) / bard;
    return fabs(k1 + k2 * *t) < root;
}

cylint_status shader_cylinder(const cylint_shape *shape,
                              const cylint_line *line, unsigned want,
                              cylint_answer *answer)
{
    const struct subject *s = (const struct subject *)(const void *)shape;
    double t;

    answer->relation = CYLINT_RELATION_MISS;
    answer->n = 0;
    answer->flags = 0;
    if (!first_hit(s, line, &t) || t < line->tmin || t > line->tmax)
        return CYLINT_OK;
    answer->relation = CYLINT_RELATION_CROSS;
    answer->n = 1;
    if (want & CYLINT_WANT_T)
        answer->hit[0].t = t;
    return CYLINT_OK;
}
