# turns_of() (src/numbers/turns_lanes.h): the angle between p = (x, y) and P, within n |p|
# of p, n = CYLINT_TURN_NEAR and the roundings of its test, has the sine
# |p x (P - p)| / (|p| |P|), at most M / (|p|^2 (1 - n)), M = |x| ey + |y| ex.  That is below
# 2^-8, so the angle is larger by 2^-16 of it at most.  The inverse in *error is
# at least 1 / |p|, and there are ten roundings.
# modes: ne
# bound: CYLINT_TURN_INPUT
{ n in [0, 0x1.0001p-9]
  -> 0.15915494309189535 * (1 + 1b-16) / ((1 - n) * SHRINK(10)) <= BOUND }
