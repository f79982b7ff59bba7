/*
 * shene_cylinder.c - line and infinite circular cylinder, by geometry
 *
 * [Shene 1994].  Supports infinite circular cylinders; the ends `nappe`
 * mean the same here.  Does not support bounded cylinders.
 *
 * The line is l(A, u), the axis l(B, v); u and v have length one.  The common
 * perpendicular of the two has the direction w = (u x v)/|u x v| and the
 * length |d| with d = (B - A).w; P is its foot on l.  The hits are
 *
 *   |d| > r     none,
 *   |d| = r     the point P, where the line is tangent,
 *   |d| < r     the points P +- sqrt((r^2 - d^2) / (1 - (u.v)^2)) u,
 *
 * because the plane that holds l and w cuts the cylinder in an ellipse with
 * the semi-axes r and r / sin(u, v).
 *
 * Corrected:
 *   - The print has two intersections "if r < |d|"; it must be |d| < r.
 *   - The formula of P's parameter is cut off in print.  With D = B - A, the
 *     distance of A + t u from the axis is least where (D - t u) x v is
 *     perpendicular to u x v: t_P = (D x v).(u x v) / |u x v|^2.
 *   - In print a line parallel to the axis and inside "does not intersect".
 *     All of it is inside the solid: it crosses, without a hit.
 *
 * Kept as printed: 1 - (u.v)^2, which cancels where u is nearly parallel to
 * v.  Where it becomes negative, the hits are NaN and are left out.
 */
#include "methods.h"

static cylint_method_chord shene_cylinder_chord(const double D[3],
                                                const double u[3],
                                                const double v[3], double r)
{
    double uv[3], Dv[3];

    cross(u, v, uv);
    const double sine = length(uv);
    if (sine == 0)
        return parallel_lines(D, u, r); /* the distance of B from l */

    const double d = fabs(dot(D, uv) / sine);
    if (!(d <= r))
        return no_chord();
    cross(D, v, Dv);
    const double t_P = dot(Dv, uv) / (sine * sine);
    if (d == r)
        return chord_between(CYLINT_RELATION_TOUCH, t_P, t_P);
    const double cosine = dot(u, v);
    const double half = cylint_sqrt((r * r - d * d) / (1 - cosine * cosine));
    return chord_between(CYLINT_RELATION_CROSS, t_P - half, t_P + half);
}

cylint_status cylint_shene_cylinder(const cylint_shape *shape,
                                    const cylint_line *line, unsigned want,
                                    cylint_answer *answer)
{
    double u[3], v[3], D[3];

    if (shape->kind != CYLINT_KIND_CYLINDER || cylint_is_bounded(shape))
        return cylint_method_not_applicable(answer);
    const double speed = unit(line->d, u);
    unit(cylint_axis(shape), v);
    minus(cylint_base(shape), line->o, D);
    cylint_method_chord chord = shene_cylinder_chord(D, u, v, cylint_r0(shape));
    chord.t[0] /= speed; /* from distance along u to multiples of d */
    chord.t[1] /= speed;
    return cylint_method_report(shape, line, want, &chord, answer);
}
