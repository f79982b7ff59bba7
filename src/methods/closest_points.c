/*
 * closest_points.c - line and circular cylinder, from their closest points
 *
 * [xissburg 2022].  Supports circular cylinders with any ends.
 *
 * The line is p0 + t d and the axis q0 + s e; d and e may have any length.
 * The line is closest to the axis at the parameter t_c, at the distance f.
 * The plane that holds the line and the common perpendicular of line and
 * axis cuts the cylinder in an ellipse with the semi-axes r and
 * r / sin(d, e).  So the line meets the cylinder at t_c +- delta with
 *
 *   delta^2 = (e.e) (r^2 - f^2) / ((d.d)(e.e) - (d.e)^2).
 *
 * Corrected and added:
 *   - (d.d)(e.e) - (d.e)^2 cancels where d is nearly parallel to e: at an
 *     angle of 1e-8 it has no correct digit.  By Lagrange's identity it is
 *     |d x e|^2, which does not cancel.
 *   - The print does not give t_c.  With D = q0 - p0 and n = d x e, the
 *     difference of p0 + t d and q0 + s e is a multiple of n at
 *         t_c = (D x e).n / |n|^2,    s_c = (D x d).n / |n|^2.
 *   - The print leaves out the parallel case.  The distance of the line from
 *     the axis decides it.
 *   - The print leaves out the ends.  The interval [t_c - delta, t_c + delta]
 *     is clipped by the planes of the two ends.
 *
 * Kept as printed: f is the distance of the two closest points, which are
 * computed as points.
 */
#include "methods.h"

/* The axial coordinate z along the line, by dot products. */
static cylint_affine axial(const cylint_shape *shape, const cylint_line *line)
{
    const double scale = dot(cylint_axis(shape), cylint_axis(shape));
    double D[3];

    minus(line->o, cylint_base(shape), D);
    return (cylint_affine){dot(D, cylint_axis(shape)) / scale,
                           dot(line->d, cylint_axis(shape)) / scale};
}

static cylint_method_chord closest_points_chord(const cylint_shape *shape,
                                                const cylint_line *line)
{
    const double *d = line->d, *e = cylint_axis(shape);
    const double r2 = cylint_r0(shape) * cylint_r0(shape);
    double D[3], n[3], De[3], Dd[3], on_line[3], on_axis[3], between[3];

    minus(cylint_base(shape), line->o, D);
    cross(d, e, n);
    const double nn = dot(n, n);
    if (nn == 0)
        return parallel_lines(D, d, cylint_r0(shape));

    cross(D, e, De);
    cross(D, d, Dd);
    const double t_c = dot(De, n) / nn;
    along(line->o, t_c, d, on_line);
    along(cylint_base(shape), dot(Dd, n) / nn, e, on_axis);
    minus(on_line, on_axis, between);
    const double f2 = dot(between, between);
    if (!(f2 <= r2))
        return no_chord();
    if (f2 == r2)
        return chord_between(CYLINT_RELATION_TOUCH, t_c, t_c);
    const double delta = sqrt(dot(e, e) * (r2 - f2) / nn);
    return chord_between(CYLINT_RELATION_CROSS, t_c - delta, t_c + delta);
}

cylint_status cylint_closest_points(const cylint_shape *shape,
                                    const cylint_line *line, unsigned want,
                                    cylint_answer *answer)
{
    if (shape->kind != CYLINT_KIND_CYLINDER)
        return cylint_method_not_applicable(answer);
    cylint_method_chord chord = closest_points_chord(shape, line);
    if (cylint_is_bounded(shape))
        cylint_chord_ends(&chord, shape, axial(shape, line));
    return cylint_method_report(shape, line, want, &chord, answer);
}
