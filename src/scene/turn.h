/*
 * turn.h - angles in turns
 */
#ifndef CYLINT_SCENE_TURN_H
#define CYLINT_SCENE_TURN_H

#include <float.h>
#include <math.h>

/* One below 1 as a float below 1. */
static inline float cylint_turn(double phi)
{
    const float v = (float)phi;
    return v < 1 ? v : 1 - FLT_EPSILON / 2;
}

/*
 * atan2(y, x) over 2 pi, in [0, 1], within CYLINT_TURN_ERROR; *per_far is 1
 * over the hypotenuse or, by up to a twelfth of it, less.
 *
 * What is left of the angle when signs and the order of x and y are known
 * differs from pi / 8 by at most that, and has a tangent t of at most 0.4142136
 * from there.  The series of atan(t) alternates, so what is left out of it is
 * less than the first term that is, 0.4142136^29 / (58 pi) turns.  With all
 * roundings, proved: tests/prove/turn.g.
 */
#define CYLINT_TURN_ERROR 0x1.8bp-45

static inline double cylint_turns(double y, double x, double *per_far)
{
    static const double tan_eighth = 0.41421356237309504880;
#define TERM(n) (0.15915494309189533577 / (n)) /* of 1 / (2 pi) */
    static const double c[14] = {
        TERM(1), -TERM(3), TERM(5), -TERM(7), TERM(9), -TERM(11), TERM(13),
        -TERM(15), TERM(17), -TERM(19), TERM(21), -TERM(23), TERM(25),
        -TERM(27)};
#undef TERM
    const double ax = fabs(x), ay = fabs(y), wider = ax - ay;
    const double most = ax > ay ? ax : ay, least = ax > ay ? ay : ax;
    *per_far = 1 / (most + least * tan_eighth);
    const double t = (least - most * tan_eighth) * *per_far;
    const double z = t * t, z2 = z * z, z4 = z2 * z2, z8 = z4 * z4;
    const double low = (c[0] + c[1] * z) + z2 * (c[2] + c[3] * z) +
                       z4 * ((c[4] + c[5] * z) + z2 * (c[6] + c[7] * z));
    const double high = (c[8] + c[9] * z) + z2 * (c[10] + c[11] * z) +
                        z4 * (c[12] + c[13] * z);
    /* mirrored where x and y change places, and at both axes */
    const double octant = 0.125 - copysign(0.0625, wider);
    const double quadrant = 0.25 - copysign(0.25 - octant, x);
    const double half = 0.5 - copysign(0.5 - quadrant, y);
    const double sign = copysign(1, wider) * copysign(1, x) * copysign(1, y);
    return half + sign * t * (low + z8 * high);
}

#endif
