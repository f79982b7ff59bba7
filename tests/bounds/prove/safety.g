# safety.c, circular and round kinds, in rounding to nearest.  Lengths are
# divided by the size d + R, so |D| <= 1 for the point D from the base.
#
# zeta, the error of a local coordinate: the difference of data, the entry of the
# matrix, the product and two sums round; sum |D_i M_ij| <= |D|.  rho has the errors
# of x and y and those of two squares, a sum and a root, and the position in the
# half plane has p.  A distance from a solid changes by at most p, because it
# changes no more than the point moves.
#
# Then follow the roundings of the formulas at that position and of the last
# difference.  w, t, q, h: other lengths, at most the size.
#   line  C x0 - S z, x0 = rho - r0, of a cone
#   hull  C rho - S z - r0, of a round cone; and C rho - |S z + C r0|
#   rim   sqrt(x^2 + z^2) with z - height
#   ball  sqrt(rho^2 + z^2) - r, the sum of squares without the root of rho^2
# The size itself has four roundings and errors of p.
# modes: ne
# bound: CYLINT_SAFETY_ERROR
# each: CYLINT_NEAREST_ROUNDING
zeta = FACTORS(5) - 1;
s2 = sqrt(FACTORS(2)) * (1 + d3);
s3 = sqrt(FACTORS(3)) * (1 + d4);
erho = sqrt(2 * (zeta * zeta)) * s2 + w * (s2 - 1);
p = sqrt(erho * erho + zeta * zeta);
p2 = sqrt(3 * (zeta * zeta));
last = (1 + d8) * (1 + d9);

line = (p + (FACTORS(3) - 1) * w) * last + t * (last - 1);
hull = ((p + (FACTORS(2) - 1) * w) * (1 + d7) + q * d7) * last + t * (last - 1);
rim = (p + t * d1 + h * d2) * s2 * (1 + d9) + t * (s2 * (1 + d9) - 1);
ball = ((p2 + q * d1 + h * d2) * s3 + q * (s3 - 1)) * last + t * (last - 1);
{ RANGES(9) /\ w in [0, 1] /\ t in [0, 1] /\
  q in [0, 1] /\ h in [0, 1]
  -> |line / (SHRINK(24))| <= BOUND /\ |hull / (SHRINK(24))| <= BOUND /\
     |rim / (SHRINK(24))| <= BOUND /\ |ball / (SHRINK(24))| <= BOUND }
