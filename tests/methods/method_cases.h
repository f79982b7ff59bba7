/*
 * method_cases.h - shared by the tests of the published methods
 */
#ifndef CYLINT_METHOD_CASES_H
#define CYLINT_METHOD_CASES_H

#include <math.h>
#include <string.h>

#include "cylint_methods.h"

/* Whether the method is published for the kind and ends. */
static inline int answers_for(const char *name, int kind, int ends)
{
    const int unbounded =
        ends == CYLINT_ENDS_INFINITE || ends == CYLINT_ENDS_NAPPE;

    if (!strcmp(name, "quadratic"))
        return 1;
    if (!strcmp(name, "shene-cylinder"))
        return kind == CYLINT_KIND_CYLINDER && unbounded;
    if (!strcmp(name, "shene-cone"))
        return (kind == CYLINT_KIND_ACONE || kind == CYLINT_KIND_CONE) &&
               ends == CYLINT_ENDS_INFINITE;
    if (!strcmp(name, "gullotti"))
        return kind == CYLINT_KIND_CYLINDER || kind == CYLINT_KIND_ECYLINDER;
    return kind == CYLINT_KIND_CYLINDER;
}

/* Whether the answers are the same and their numbers within `error`.  phi jumps
 * from 1 to 0.  Writes the largest difference of t to *worst if it is larger. */
static inline int agrees(const cylint_answer *got, const cylint_answer *want,
                         double error, double *worst)
{
    int good =
        got->relation == want->relation && got->n == want->n && !got->flags;
    for (int i = 0; i < want->n && good; i++) {
        const cylint_hit *g = &got->hit[i], *w = &want->hit[i];
        const double turned = fabs(g->phi - w->phi);
        good = g->part == w->part && g->side == w->side &&
               fabs(g->t - w->t) <= error && fabs(g->z - w->z) <= error &&
               (turned <= error || 1 - turned <= error) && g->phi >= 0 &&
               g->phi < 1;
        for (int j = 0; j < 3; j++)
            good = good && fabs(g->point[j] - w->point[j]) <= error &&
                   fabs(g->normal[j] - w->normal[j]) <= error;
        *worst = fmax(*worst, fabs(g->t - w->t));
    }
    return good;
}

#endif
