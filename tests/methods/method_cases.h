/*
 * method_cases.h - shared by the tests of the published methods
 */
#ifndef CYLINT_METHOD_CASES_H
#define CYLINT_METHOD_CASES_H

#include <math.h>
#include <string.h>

#include "check.h"
#include "cylint_methods.h"
#include "shapes/layout.h"

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

static inline int put(char *text, const char *word, const double *x, int n)
{
    int used = sprintf(text, "%s", word);
    for (int i = 0; i < n; i++)
        used += sprintf(text + used, " %a", x[i]);
    return used;
}

static inline int put_line(char *text, const cylint_line *l)
{
    const int unbounded = l->tmax > 1e300;
    const char *word = !unbounded ? "span" : l->tmin == 0 ? "ray" : "line";
    int used = put(text, word, l->o, 3);

    used += put(text + used, "", l->d, 3);
    if (unbounded)
        return used;
    return used + sprintf(text + used, " %a %a", l->tmin, l->tmax);
}

static inline void put_shape(char *text, const cylint_shape *s)
{
    const double degrees = 57.29577951308232; /* 180 / pi */
    static const char *const kinds[] = {"none",  "cylinder",  "cone",
                                        "acone", "ecylinder", "econe"};
    static const char *const ends[] = {"capped", "open",     "cap0",
                                       "cap1",   "infinite", "nappe"};
    const int elliptic = s->kind >= CYLINT_KIND_ECYLINDER;
    const int has_top = s->kind <= CYLINT_KIND_CONE;
    int used = put(text, kinds[s->kind], cylint_base(s), 3);

    if (s->kind == CYLINT_KIND_CONE)
        used += put(text + used, "", cylint_radii(s), 1);
    if (elliptic) {
        used += put(text + used, "", cylint_a(s), 3);
        used += put(text + used, "", cylint_b(s), 3);
    }
    used += put(text + used, "", has_top ? cylint_top(s) : cylint_axis(s), 3);
    if (s->kind == CYLINT_KIND_ACONE)
        used += sprintf(text + used, " %.17g", atan(cylint_r1(s)) * degrees);
    else if (s->kind != CYLINT_KIND_ECYLINDER)
        used += put(text + used, "", cylint_radii(s) + 1, 1);
    sprintf(text + used, " ends=%s", ends[s->ends]);
}

/* Prints a case as a record of the command; a segment with its rounded
 * difference, as the methods read it. */
static inline void report_case(const char *method, const cylint_shape *s,
                               const cylint_line *l)
{
    char line[400], shape[700];

    put_line(line, l);
    put_shape(shape, s);
    REPORT("--method=%s: %s  %s", method, line, shape);
}

#endif
