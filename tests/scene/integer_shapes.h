/*
 * integer_shapes.h - shapes and lines of small integers
 *
 * Such shapes touch, share faces, lie in each other and are the same, and lines run
 * along rulings, caps and through apexes.
 */
#ifndef CYLINT_INTEGER_SHAPES_H
#define CYLINT_INTEGER_SHAPES_H

#include "cylint.h"
#include "draw.h"

/* Any kind, with any ends. */
static inline cylint_status any_shape(cylint_shape *s)
{
    double p[3], q[3], a[3], b[3];
    const cylint_ends ends =
        one_of(2) ? CYLINT_ENDS_CAPPED : (cylint_ends)one_of(6);
    whole_point(p, 6);
    whole_point(a, 2);
    whole_point(b, 2);
    for (int i = 0; i < 3; i++)
        q[i] = p[i] + whole_between(-4, 4);
    switch (one_of(9)) {
    case 0:
        return cylint_cone(s, p, one_of(3), q, one_of(3), ends);
    case 1:
        return cylint_capsule(s, p, q, 1 + one_of(2), CYLINT_ENDS_CAPPED);
    case 2:
        return cylint_sphere(s, p, 1 + one_of(4), CYLINT_ENDS_CAPPED);
    case 3:
        return cylint_tangent_cone(s, p, a, 1, ends);
    case 4:
        return cylint_elliptic_cone(s, p, a, b, q, one_of(3), ends);
    case 5:
        return cylint_round_cone(s, p, one_of(3), q, one_of(3), ends);
    case 6:
        return cylint_halfspace(s, p, a);
    default:
        return cylint_cylinder(s, p, q, 1 + one_of(2), ends);
    }
}

static inline cylint_status any_line(cylint_line *line)
{
    double o[3], d[3];
    whole_point(o, 6);
    whole_point(d, 2);
    switch (one_of(4)) {
    case 0:
        return cylint_ray(line, o, d);
    case 1:
        return cylint_span(line, o, d, -one_of(3), one_of(4));
    case 2:
        return cylint_segment(line, o, d);
    default:
        return cylint_whole_line(line, o, d);
    }
}

#endif
