/*
 * angle.h - angles in turns, 1 being 2 pi
 */
#ifndef CYLINT_EMBREE_ANGLE_H
#define CYLINT_EMBREE_ANGLE_H

#include <float.h>
#include <math.h>

#include "../numbers/simd.h"

/*
 * atan2(y, x) / (2 pi), in [0, 1], with an error of at most
 * CYLINT_ATAN2_TURNS_ERROR.  *per_far is between 11/12 and 1 times
 * 1 / hypotenuse.
 *
 * The signs and the order of x and y reduce the angle to one between 0 and
 * pi / 4.  Its difference from pi / 8 has a tangent t of at most 0.4142136.  The
 * series of atan(t) alternates, so the truncation error is less than the first
 * omitted term, 0.4142136^29 / (58 pi) turns.  The bound with all roundings is
 * proved: tests/bounds/prove/turn.g.
 */
#define CYLINT_ATAN2_TURNS_ERROR 0x1.8bp-45

INLINE vd cylint_atan2_turns(vd y, vd x, vd *per_far)
{
#define TERM(n) v_set(0.15915494309189533577 / (n)) /* of 1 / (2 pi) */
    const vd c[14] = {TERM(1),   TERM(-3),  TERM(5),   TERM(-7), TERM(9),
                      TERM(-11), TERM(13),  TERM(-15), TERM(17), TERM(-19),
                      TERM(21),  TERM(-23), TERM(25),  TERM(-27)};
#undef TERM
    const vd tan_eighth = v_set(0.41421356237309504880);
    const vd ax = v_abs(x), ay = v_abs(y), wider = ax - ay;
    const vm lies = v_lt(ay, ax);
    const vd most = v_select(lies, ax, ay), least = v_select(lies, ay, ax);
    *per_far = v_set(1) / (most + least * tan_eighth);
    const vd t = (least - most * tan_eighth) * *per_far;
    const vd z = t * t, z2 = z * z, z4 = z2 * z2, z8 = z4 * z4;
    const vd low = (c[0] + c[1] * z) + z2 * (c[2] + c[3] * z) +
                   z4 * ((c[4] + c[5] * z) + z2 * (c[6] + c[7] * z));
    const vd high =
        (c[8] + c[9] * z) + z2 * (c[10] + c[11] * z) + z4 * (c[12] + c[13] * z);
    /* reflected if x and y were exchanged, and by both signs */
    const vd octant = v_set(0.125) - v_like(v_set(0.0625), wider);
    const vd quadrant = v_set(0.25) - v_like(v_set(0.25) - octant, x);
    const vd half = v_set(0.5) - v_like(v_set(0.5) - quadrant, y);
    const vd part = t * (low + z8 * high);
    const vd sign =
        v_like(v_set(1), wider) * v_like(v_set(1), x) * v_like(v_set(1), y);
    return half + sign * part;
}

#endif
