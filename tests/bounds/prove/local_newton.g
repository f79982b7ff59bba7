# newton_template.h for slopes known to one quarter.  The true slope is sqrt(g)
# times the computed one, and slope_error is at least |g - 1|.  The error of the
# step is, as newton.g says, the sum of
#
#   e / |slope|,   |delta| |1 - sqrt(g)|,   |A| (t0 - t)^2 / |slope|
#
# over sqrt(g), where |1 - sqrt(g)| = |g - 1| / (1 + sqrt(g)) <= |g - 1|.
# The error is computed with 12 roundings at most on any path.
# modes: ne
# bound: CYLINT_LOCAL_NEWTON
{ g in [0.75, 1.25] -> 1 / (sqrt(g) * SHRINK(12)) <= BOUND }
