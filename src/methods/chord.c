/*
 * chord.c - clips the chord of a line and an unbounded solid by the ends
 *
 * The hits of a bounded shape are the ends of the intersection of two
 * intervals: the one between the lateral roots and the one in which
 * 0 <= z <= 1.  An intersection of intervals always has two ends.  Testing
 * candidate points one by one can instead give one hit or three at a rim.
 */
#include "methods.h"

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
