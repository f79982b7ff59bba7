/*
 * chord.c - clips the chord of a line and an unbounded solid by the ends
 *
 * The hits of a bounded shape are the ends of the intersection of two
 * intervals: the one between the lateral roots and the one in which
 * 0 <= z <= 1.  An intersection of intervals always has two ends.  Testing
 * candidate points one by one can instead give one hit or three at a rim.
 */
#include "methods.h"

cylint_affine cylint_axial(const cylint_shape *shape, const cylint_line *line)
{
    const double scale = dot(cylint_axis(shape), cylint_axis(shape));
    double D[3];

    minus(line->o, cylint_base(shape), D);
    return (cylint_affine){dot(D, cylint_axis(shape)) / scale,
                           dot(line->d, cylint_axis(shape)) / scale};
}

/*
 * Where the plane and a lateral root have the same t the hit is on the rim
 * and counts as lateral.  A chord in the plane has the relation along.  A
 * chord clipped to one point touches the rim.
 */
void cylint_chord_clip(cylint_method_chord *chord, cylint_affine f, int part)
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

/* A pointed end has no cap, so its plane does not clip. */
void cylint_chord_ends(cylint_method_chord *chord, const cylint_shape *shape,
                       cylint_affine z)
{
    if (!cylint_is_bounded(shape))
        return;
    if (cylint_r0(shape) != 0)
        cylint_chord_clip(chord, z, CYLINT_PART_CAP0);
    if (cylint_r1(shape) != 0)
        cylint_chord_clip(chord, (cylint_affine){1 - z.at, -z.slope},
                          CYLINT_PART_CAP1);
}

/*
 * rho, the signed radius, is positive on one nappe and negative on the other.
 *
 *   gap        the chord has two pieces on opposite nappes: one of them stays
 *   along      the line is a ruling: the part beyond the apex, rho = 0, stays
 *   unbounded  parallel to a ruling: rho at the infinite end decides
 *   bounded    the chord lies on one nappe: rho at its middle decides
 */
void cylint_chord_nappe(cylint_method_chord *chord, cylint_affine rho)
{
    if (chord->relation == CYLINT_RELATION_MISS)
        return;
    const int ahead = rho.slope > 0; /* the nappe is at t = +inf */

    if (chord->gap) {
        chord->gap = 0;
        chord->t[ahead ? 0 : 1] = chord->t[ahead ? 1 : 0];
        chord->t[ahead ? 1 : 0] = ahead ? INFINITY : -INFINITY;
    } else if (chord->relation == CYLINT_RELATION_ALONG) {
        /* untaken 1 of 2: a ruling is not perpendicular to the axis */
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
