/*
 * closest_points.c - line and circular cylinder, from their closest points
 *
 * [xissburg 2022].  Answers for circular cylinders, with any ends.
 *
 * The line is p0 + t d, the axis q0 + s e; nothing need be of length one.
 * With t_c the line's parameter where it comes closest to the axis and f the
 * distance there, the plane through the line and along its common
 * perpendicular with the axis cuts the cylinder in an ellipse of the semi-
 * axes r and r / sin(d, e), so the line meets it at t_c +- delta with
 *
 *   delta^2 = (e.e) (r^2 - f^2) / ((d.d)(e.e) - (d.e)^2).
 *
 * Corrected and added:
 *   - (d.d)(e.e) - (d.e)^2 cancels as the line nears the axis's direction:
 *     at an angle of 1e-8 no digit is left.  It is |d x e|^2 by Lagrange's
 *     identity, and that keeps its digits.
 *   - t_c itself is left out.  With D = q0 - p0 and n = d x e, p0 + t d and
 *     q0 + s e differ by a multiple of n where
 *         t_c = (D x e).n / |n|^2,    s_c = (D x d).n / |n|^2.
 *   - The parallel case is left out: the distance from the axis decides.
 *   - The ends are left out: added by cutting [t_c - delta, t_c + delta]
 *     down to the slab between the two planes.
 *
 * Kept: f is the distance of the two points, formed as points.
 */
#include "methods.h"

static cylint_chord when_parallel(const double D[3], const double d[3],
                                  double r)
{
    double apart[3];

    along(D, -dot(D, d) / dot(d, d), d, apart);
    return parallel_chord(dot(apart, apart) - r * r);
}

static cylint_chord chord_of(const cylint_shape *shape, const cylint_line *line)
{
    const double *d = line->d, *e = shape->axis;
    const double r2 = shape->r0 * shape->r0;
    double D[3], n[3], De[3], Dd[3], on_line[3], on_axis[3], between[3];

    minus(shape->base, line->o, D);
    cross(d, e, n);
    const double nn = dot(n, n);
    if (nn == 0)
        return when_parallel(D, d, shape->r0);

    cross(D, e, De);
    cross(D, d, Dd);
    const double t_c = dot(De, n) / nn;
    along(line->o, t_c, d, on_line);
    along(shape->base, dot(Dd, n) / nn, e, on_axis);
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
        return cylint_method_not_for_this(answer);
    if (!line->valid) {
        cylint_method_refuse(answer);
        return CYLINT_OK;
    }
    cylint_chord chord = chord_of(shape, line);
    if (is_bounded(shape))
        cylint_chord_ends(&chord, shape, cylint_axial(shape, line));
    return cylint_method_report(shape, line, want, &chord, answer);
}
