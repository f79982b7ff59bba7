/*
 * chord.c - cutting the overlap of line and unbounded solid down to the ends
 *
 * The hits of a bounded shape are the ends of [lateral roots] intersected
 * with [slab 0 <= z <= 1].  Done on intervals, it cannot give one hit or
 * three where two are due, which collecting candidates and testing each does
 * at the rims.
 */
#include "methods.h"

static cylint_affine affine(double at, double slope)
{
    const cylint_affine f = {at, slope};
    return f;
}

cylint_affine cylint_axial(const cylint_shape *shape, const cylint_line *line)
{
    const double scale = dot(shape->axis, shape->axis);
    double D[3];

    minus(line->o, shape->base, D);
    return affine(dot(D, shape->axis) / scale,
                  dot(line->d, shape->axis) / scale);
}

/*
 * A tie between plane and lateral root is a rim point and stays lateral.  A
 * chord that lies in the plane runs along the cap; one that is cut down to
 * a point touches the rim there.
 */
void cylint_chord_clip(cylint_chord *chord, cylint_affine f, int part)
{
    if (chord->relation == CYLINT_RELATION_MISS)
        return;
    if (f.slope == 0) {
        if (f.at == 0 && chord->relation == CYLINT_RELATION_CROSS)
            chord->relation = CYLINT_RELATION_ALONG;
        else if (!(f.at >= 0))
            chord->relation = CYLINT_RELATION_MISS;
        return;
    }

    const double t = -f.at / f.slope;
    const int end = f.slope > 0 ? 0 : 1;
    if (end == 0 ? t > chord->t[0] : t < chord->t[1]) {
        chord->t[end] = t;
        chord->part[end] = chord->relation == CYLINT_RELATION_ALONG
                               ? CYLINT_PART_LATERAL
                               : part;
    }
    if (!(chord->t[0] <= chord->t[1])) {
        chord->relation = CYLINT_RELATION_MISS;
    } else if (chord->t[0] == t && chord->t[1] == t) {
        chord->relation = CYLINT_RELATION_TOUCH;
        chord->part[0] = chord->part[1] = CYLINT_PART_LATERAL;
    }
}

/* A pointed end has no cap: there the lateral surface ends by itself. */
void cylint_chord_ends(cylint_chord *chord, const cylint_shape *shape,
                       cylint_affine z)
{
    if (!is_bounded(shape))
        return;
    if (shape->r0 != 0)
        cylint_chord_clip(chord, z, CYLINT_PART_CAP0);
    if (shape->r1 != 0)
        cylint_chord_clip(chord, affine(1 - z.at, -z.slope), CYLINT_PART_CAP1);
}

/*
 * rho, the signed radius, has one sign on either nappe.
 *
 *   gap        the two pieces lie on opposite nappes
 *   along      the line is a ruling: from the apex, where rho = 0, onwards
 *   unbounded  parallel to a ruling: rho at the far end decides
 *   bounded    on one nappe: rho anywhere on it decides
 */
void cylint_chord_nappe(cylint_chord *chord, cylint_affine rho)
{
    if (chord->relation == CYLINT_RELATION_MISS)
        return;
    const int ahead = rho.slope > 0; /* the nappe lies towards t = +inf */

    if (chord->gap) {
        chord->gap = 0;
        chord->t[ahead ? 0 : 1] = chord->t[ahead ? 1 : 0];
        chord->t[ahead ? 1 : 0] = ahead ? INFINITY : -INFINITY;
    } else if (chord->relation == CYLINT_RELATION_ALONG) {
        if (rho.slope != 0)
            chord->t[ahead ? 0 : 1] = -rho.at / rho.slope;
    } else if (isinf(chord->t[0]) || isinf(chord->t[1])) {
        if (isinf(chord->t[ahead ? 0 : 1]))
            chord->relation = CYLINT_RELATION_MISS;
    } else {
        const double middle = 0.5 * chord->t[0] + 0.5 * chord->t[1];
        if (!(rho.at + middle * rho.slope >= 0))
            chord->relation = CYLINT_RELATION_MISS;
    }
}
