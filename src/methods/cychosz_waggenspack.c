/*
 * cychosz_waggenspack.c - line and circular cylinder, clipped by two planes
 *
 * [Cychosz & Waggenspack 1994]: their functions intcyl and clipobj.
 * Supports circular cylinders with any ends.  clipobj computes the part on
 * which each end of the chord lies; an end on an absent part is no hit.
 *
 * The ray's direction and the axis have length one, RC is the vector from the
 * base to the ray's origin, and n = direction x axis.  The shortest distance
 * of the two lines is d = |RC.n| / |n|, at t = -(RC x axis).n / |n|^2.
 * O is the unit vector along n x axis: it is perpendicular to the axis and in
 * the plane of the two directions.  Half the chord has the length
 * s = |sqrt(r^2 - d^2) / (direction.O)|.
 *
 * Corrected, all in clipobj and its use:
 *   - A ray parallel to the axis and inside enters at -1e21 and leaves at
 *     1e21, which stand for infinity but are written as hits of the unbounded
 *     cylinder.  They are infinite here.
 *   - Where a line passes through a rim, the plane of that end and the chord
 *     can have one common point, the chord's beginning.  The print then
 *     neither clips nor rejects, and the whole chord beyond the plane stays.
 *     Here the relation is touch.
 *   - "in < out" and, for lines parallel to a plane, "dw >= 0: miss" exclude
 *     the boundary, so that tangents and lines in a cap's plane miss.  Here
 *     solids are closed.
 */
#include "methods.h"

static cylint_method_chord intcyl(const double RC[3], const double raycos[3],
                                  const double axis[3], double radius)
{
    double n[3], O[3];

    cross(raycos, axis, n);
    if (dot(n, n) == 0)
        return parallel_lines(RC, axis, radius);
    const double ln = unit(n, n);
    const double d = fabs(dot(RC, n));
    if (!(d <= radius))
        return no_chord();

    cross(RC, axis, O);
    const double t = -dot(O, n) / ln;
    if (d == radius)
        return chord_between(CYLINT_RELATION_TOUCH, t, t);
    cross(n, axis, O);
    unit(O, O);
    const double s = fabs(sqrt(radius * radius - d * d) / dot(raycos, O));
    return chord_between(CYLINT_RELATION_CROSS, t - s, t + s);
}

/* Clips by the planes normal.p + distance = 0 with outward normals. */
static void clipobj(cylint_method_chord *chord, const cylint_line *line,
                    const double raycos[3], const double axis[3],
                    const cylint_shape *shape)
{
    const double low = -dot(axis, cylint_base(shape));
    const double high = -dot(axis, cylint_top(shape));
    const double climb = dot(axis, raycos), height = dot(axis, line->o);
    const cylint_affine above_low = {height + low, climb};
    const cylint_affine below_high = {-(height + high), -climb};

    cylint_chord_clip(chord, above_low, CYLINT_PART_CAP0);
    cylint_chord_clip(chord, below_high, CYLINT_PART_CAP1);
}

cylint_status cylint_cychosz_waggenspack(const cylint_shape *shape,
                                         const cylint_line *line, unsigned want,
                                         cylint_answer *answer)
{
    double raycos[3], axis[3], RC[3];

    if (shape->kind != CYLINT_KIND_CYLINDER)
        return cylint_method_not_applicable(answer);
    const double speed = unit(line->d, raycos);
    unit(cylint_axis(shape), axis);
    minus(line->o, cylint_base(shape), RC);
    cylint_method_chord chord = intcyl(RC, raycos, axis, cylint_r0(shape));
    if (cylint_is_bounded(shape))
        clipobj(&chord, line, raycos, axis, shape);
    chord.t[0] /= speed; /* from distance along the ray to multiples of d */
    chord.t[1] /= speed;
    return cylint_method_report(shape, line, want, &chord, answer);
}
