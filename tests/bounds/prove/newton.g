# newton_template.h, for the lateral quadric.  With s the true slope,
# s = s0 (1 + x), |x| <= 2^-10, the step from t0 has the error
#
#   Q / (2 s) - delta - A (t0 - t)^2 / (2 s),  delta = Q.hi / (2 s0) (1 + d),
#
# whose three terms are, with the error e of Q and |d| <= 2^-50 for the low
# part of Q and the roundings of delta and of t0 - delta, at most 1 / (1 + x) times
#
#   e / (2 s0),   |delta| (|x| + 2^-50),   |A| (t0 - t)^2 / (2 s0).
#
# The error is computed with 12 roundings at most on any path.
# modes: ne
# bound: CYLINT_NEWTON_SLACK
# each: CYLINT_ROUNDING
{ |x| <= 1b-10 /\ |d| <= 1b-50
  -> |1 / ((1 + x) * (1 + d) * SHRINK(12))| <= BOUND }
