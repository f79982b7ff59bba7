/*
 * elliptic_solids.h - elliptic shapes and points near them, by families
 *
 * Tests of distances from elliptic kinds draw from them.
 */
#ifndef CYLINT_ELLIPTIC_SOLIDS_H
#define CYLINT_ELLIPTIC_SOLIDS_H

#include <math.h>

#include "check.h"
#include "cylint.h"
#include "draw.h"

enum form { OBLIQUE, UPRIGHT, THIN, NEEDLE, FORMS };
enum where { NEAR, INSIDE, FAR, BESIDE, PLACES };

static const char *const form_names[] = {"oblique", "upright", "thin",
                                         "needle"};
static const char *const place_names[] = {"near", "inside", "up to 1e6 away",
                                          "1e-9 from the surface"};

struct solid {
    double c[3], a[3], b[3], h[3], k;
};

static inline int make_solid(cylint_shape *s, const struct solid *e,
                             cylint_ends ends)
{
    return cylint_elliptic_cone(s, e->c, e->a, e->b, e->h, e->k, ends) ==
           CYLINT_OK;
}

static inline void report_solid(const struct solid *e, cylint_ends ends,
                                const double p[3])
{
    REPORT("econe %a %a %a  %a %a %a  %a %a %a  %a %a %a  %a ends %d, point "
           "%a %a %a",
           e->c[0], e->c[1], e->c[2], e->a[0], e->a[1], e->a[2], e->b[0],
           e->b[1], e->b[2], e->h[0], e->h[1], e->h[2], e->k, (int)ends, p[0],
           p[1], p[2]);
}

/* Point x a + y b + z h from the base. */
static inline void place_in_solid(const struct solid *e, double x, double y,
                                  double z, double p[3])
{
    for (int i = 0; i < 3; i++)
        p[i] = e->c[i] + x * e->a[i] + y * e->b[i] + z * e->h[i];
}

/* Any vectors; or perpendicular ones, of which b is up to 3 times, 1000 times
 * (thin) or 1e6 times (needle) shorter than a. */
static inline void draw_solid(struct solid *e, enum form form, int is_cone)
{
    random_vector(e->c, 1);
    random_vector(e->a, 1);
    random_vector(e->b, 1);
    random_vector(e->h, 1);
    e->k = is_cone ? between(0, 1.5) : 1;
    if (form == OBLIQUE)
        return;
    const double least = form == UPRIGHT ? -0.5 : form == THIN ? -3 : -6;
    const double thin = power(least, 0), tall = power(-1, 1);
    scale3(e->a, 1 / length3(e->a));
    cross3(e->h, e->a, e->b);
    scale3(e->h, 1 / length3(e->h));
    cross3(e->b, e->h, e->a);
    scale3(e->b, thin);
    scale3(e->h, tall);
}

static inline void draw_place(const struct solid *e, enum where where,
                              double p[3])
{
    double z = between(0, 1), x, y;
    if (where == NEAR || where == FAR) {
        const double by = where == FAR ? power(0, 6) : 1;
        x = by * between(-3, 3);
        y = by * between(-3, 3);
        z = by * between(-1, 2);
    } else {
        const double turn = between(0, 6.283185307179586);
        const double rho = 1 + (e->k - 1) * z;
        const double share = where == INSIDE ? 0.9 * sqrt(between(0, 1))
                                             : 1 + 1e-9 * between(-1, 1);
        x = rho * share * cos(turn);
        y = rho * share * sin(turn);
    }
    place_in_solid(e, x, y, z, p);
}

#endif
