/*
 * method_cases.h - shared by the tests of the published methods
 */
#ifndef CYLINT_METHOD_CASES_H
#define CYLINT_METHOD_CASES_H

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

#endif
