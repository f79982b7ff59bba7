/*
 * gullotti.c - line and elliptic cylinder, by an affine map
 *
 * [Gullotti].  Supports circular and elliptic cylinders with any ends.
 *
 * M maps the cylinder of radius 1 and height 1 on the z axis to the given
 * cylinder.  The inverse of M maps the line to local coordinates, where a
 * quadratic gives its intersection with the unit cylinder.  t is the same in
 * both spaces.
 *
 * Corrected:
 *   - M is published as T R S, translation, rotation and scaling.  R, made
 *     from the directions of a, b and c, is a rotation only if these are
 *     orthogonal.  M = [a b c C] does not require that, and so it serves
 *     oblique elliptic cylinders too.
 *   - The leading coefficient v'.v' - (v'.h)^2 adds the axial component and
 *     subtracts it again, so it cancels.  It is v'x^2 + v'y^2; the other two
 *     coefficients are changed likewise.
 *   - "The discriminant is 0 and the line is parallel, so it lies on the
 *     surface": for every parallel line the first two coefficients vanish,
 *     so the discriminant is 0 at any distance.  The constant term decides:
 *     negative inside, zero on the surface, positive outside.
 *   - The axial test uses points in world space with the local unit vector
 *     h.  It must use local points: 0 <= z' <= 1.
 *   - For a line parallel to the axis the print returns before it tests the
 *     caps.  Here the caps clip it.
 *
 * Kept as printed: the inverse of M contains the translation, so the method
 * loses digits in a scene far from the origin.
 *
 * A cylint_shape has no place for the inverse, so it is computed for every
 * line; most of the method's time goes into that.
 */
#include "methods.h"

/* The chord of the line p + t v in the unit cylinder x^2 + y^2 <= 1. */
static cylint_method_chord gullotti_chord(const double p[3], const double v[3])
{
    const double a = v[0] * v[0] + v[1] * v[1];
    const double b = 2 * (v[0] * p[0] + v[1] * p[1]);
    const double c = p[0] * p[0] + p[1] * p[1] - 1;

    return a == 0 ? parallel_chord(c) : quadratic_chord(a, b, c);
}

cylint_status cylint_gullotti(const cylint_shape *shape,
                              const cylint_line *line, unsigned want,
                              cylint_answer *answer)
{
    double row[3][3], p[3], v[3];

    if (shape->kind != CYLINT_KIND_CYLINDER &&
        shape->kind != CYLINT_KIND_ECYLINDER)
        return cylint_method_not_applicable(answer);
    cylint_method_rows(shape, cylint_r0(shape), row);
    for (int i = 0; i < 3; i++) {
        p[i] = dot(row[i], line->o) - dot(row[i], cylint_base(shape));
        v[i] = dot(row[i], line->d);
    }
    cylint_method_chord chord = gullotti_chord(p, v);
    cylint_chord_ends(&chord, shape, (cylint_affine){p[2], v[2]});
    return cylint_method_report(shape, line, want, &chord, answer);
}
