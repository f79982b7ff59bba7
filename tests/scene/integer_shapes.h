/*
 * integer_shapes.h - shapes and lines of small integers
 *
 * Such shapes touch, share faces, lie in each other and are the same, and lines run
 * along rulings, caps and through apexes.
 */
#ifndef CYLINT_INTEGER_SHAPES_H
#define CYLINT_INTEGER_SHAPES_H

#include "cylint.h"
#include "random.h"

static uint64_t rng;

static inline int integer(int most)
{
    return random_int(&rng, 2 * most + 1) - most;
}

static inline int choice(int n)
{
    return random_int(&rng, n);
}

static inline void point_of_integers(double p[3], int most)
{
    for (int i = 0; i < 3; i++)
        p[i] = integer(most);
}

/* Any kind, with any ends. */
static inline cylint_status any_shape(cylint_shape *s)
{
    double p[3], q[3], a[3], b[3];
    const cylint_ends ends =
        choice(2) ? CYLINT_ENDS_CAPPED : (cylint_ends)choice(6);
    point_of_integers(p, 6);
    point_of_integers(a, 2);
    point_of_integers(b, 2);
    for (int i = 0; i < 3; i++)
        q[i] = p[i] + integer(4);
    switch (choice(9)) {
    case 0:
        return cylint_cone(s, p, choice(3), q, choice(3), ends);
    case 1:
        return cylint_capsule(s, p, q, 1 + choice(2), CYLINT_ENDS_CAPPED);
    case 2:
        return cylint_sphere(s, p, 1 + choice(4), CYLINT_ENDS_CAPPED);
    case 3:
        return cylint_tangent_cone(s, p, a, 1, ends);
    case 4:
        return cylint_elliptic_cone(s, p, a, b, q, choice(3), ends);
    case 5:
        return cylint_round_cone(s, p, choice(3), q, choice(3), ends);
    case 6:
        return cylint_halfspace(s, p, a);
    default:
        return cylint_cylinder(s, p, q, 1 + choice(2), ends);
    }
}

static inline cylint_status any_line(cylint_line *line)
{
    double o[3], d[3];
    point_of_integers(o, 6);
    point_of_integers(d, 2);
    switch (choice(4)) {
    case 0:
        return cylint_ray(line, o, d);
    case 1:
        return cylint_span(line, o, d, -choice(3), choice(4));
    case 2:
        return cylint_segment(line, o, d);
    default:
        return cylint_whole_line(line, o, d);
    }
}

#endif
