# safety.c, spheres, in rounding to nearest; lengths are divided by d + r.  A
# coordinate is rounded once, and that counts twice in its square; then follow
# the square, two sums and the root, the difference from r and the last one.
# t: the distance from the centre, q: from the surface.
# modes: ne
# bound: CYLINT_SPHERE_SAFETY_ERROR
# each: CYLINT_NEAREST_ROUNDING
s5 = sqrt(FACTORS(5)) * (1 + d6);
last = (1 + d8) * (1 + d9);
{ RANGES(9) /\ t in [0, 1] /\ q in [0, 1]
  -> |(t * (s5 - 1) * last + q * (last - 1)) / (SHRINK(12))| <= BOUND }
