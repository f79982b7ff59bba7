# step_from() of filter/surfaces.h, for the lateral quadric.  With s the true slope,
# the step from t0 has the error
#
#   Q / (2 s) - delta - A (t0 - t)^2 / (2 s),  delta = Q.hi / (2 s0) (1 + d),
#
# with the error e of Q and |d| <= 2^-50 for the low part of Q and the roundings of
# delta and of t0 - delta.  The slope is known to one quarter: the true one is sqrt(g)
# times the computed one, and slope_error is at least |g - 1|.  So the error is the sum
# of
#
#   e / |slope|,   |delta| |1 - sqrt(g)|,   |A| (t0 - t)^2 / |slope|
#
# over sqrt(g), where |1 - sqrt(g)| = |g - 1| / (1 + sqrt(g)) <= |g - 1|.
# The error is computed with 12 roundings at most on any path.
# modes: ne
# bound: CYLINT_LOCAL_NEWTON
{ g in [0.75, 1.25] -> 1 / (sqrt(g) * SHRINK(12)) <= BOUND }
