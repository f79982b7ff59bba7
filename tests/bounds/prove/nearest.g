# bits.h, cylint_is_rounded(): t lies within `off` of hi + lo, and hi + s rounds to
# hi for s = rn(lo + error).  Only the rounding of s can let t past the middle
# between hi and its neighbour; with hi in [1, 2] that middle is 2^-53 away.
# An error that exceeds `off` by the bound is therefore safe.
# modes: ne
# bound: CYLINT_NEAREST_MARGIN
@rn = float<ieee_64, MODE>;
s rn= lo + error;
{ |s| <= 1b-53 -> |s - (lo + error)| <= BOUND }
