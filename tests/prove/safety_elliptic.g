# safety.c, elliptic kinds, in rounding to nearest.  Lengths are divided by the
# size N + reach + r0, N the sum of |D_i| times the norm of the matrix, so each
# local coordinate is at most 1.  zeta, its error: a difference, the entry, which
# is known to o relative to the norm, a product and two sums.  rho has two of
# these, and p is the error of the position.
#
# The cosine 1 / sqrt(1 + slope^2) and the sine slope cosine have errors too.
# (x0, z) is at most w = sqrt(3).
# modes: ne
# bound: CYLINT_ELLIPTIC_SAFETY_ERROR
# each: CYLINT_NEAREST_ROUNDING
zeta = FACTORS(5) - 1 + o;
s2 = sqrt(FACTORS(2)) * (1 + d3);
erho = sqrt(2 * (zeta * zeta)) * s2 + r * (s2 - 1);
p = sqrt(erho * erho + zeta * zeta);
cosine = FACTORS(2) / sqrt((1 + d10) * (1 + d11) * (1 + d12) * (1 + d13));
sine = (1 + d14) * (1 + d15) * cosine;
last = (1 + d8) * (1 + d9);
line = (p + w * (sine * (1 + d6) - 1)) * last + w * (last - 1);
double = ((p + w * (sine * (1 + d6) - 1)) * (1 + d7) + w * d7) * last
         + w * (last - 1);
{ RANGES(15) /\ |o| <= 1b-70 /\ r in [0, 1.4142136] /\ w in [0, 1.7320509]
  -> |line / (SHRINK(24))| <= BOUND /\ |double / (SHRINK(24))| <= BOUND }
