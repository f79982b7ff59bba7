# safety.c, circular and round kinds, in rounding to nearest.  Lengths are
# divided by the size d + R, so |D| <= 1 for the point D from the base.
#
# zeta, the error of z: the difference of data, the axis's component, the product
# and two sums round; sum |D_i a_i| <= |D|.  A component of the rejection has the
# roundings of D_i and of the difference, the error of z, and z times those of the
# axis and the product.  2 |z| + rho <= m |D|, m <= sqrt(5).  So the rejection has
# the error e, rho has e and those of three sums and products and a root, and the
# position in the half plane has p.  A distance from a solid changes by at most
# p, because it changes no more than the point moves.
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
e = (d1 + zeta * FACTORS(2) + m * d1 * (1 + d2)) * (1 + d3);
s2 = sqrt(FACTORS(2)) * (1 + d3);
s3 = sqrt(FACTORS(3)) * (1 + d4);
s4 = sqrt(FACTORS(4)) * (1 + d5);
erho = e * s3 + w * (s3 - 1);
p = sqrt(erho * erho + zeta * zeta);
p2 = sqrt(e * e + zeta * zeta);
last = (1 + d8) * (1 + d9);

line = (p + (FACTORS(3) - 1) * w) * last + t * (last - 1);
hull = ((p + (FACTORS(2) - 1) * w) * (1 + d7) + q * d7) * last + t * (last - 1);
rim = (p + t * d1 + h * d2) * s2 * (1 + d9) + t * (s2 * (1 + d9) - 1);
ball = ((p2 + q * d1 + h * d2) * s4 + q * (s4 - 1)) * last + t * (last - 1);
{ RANGES(9) /\ m in [0, 2.2360680] /\ w in [0, 1] /\ t in [0, 1] /\
  q in [0, 1] /\ h in [0, 1]
  -> |line / (SHRINK(24))| <= BOUND /\ |hull / (SHRINK(24))| <= BOUND /\
     |rim / (SHRINK(24))| <= BOUND /\ |ball / (SHRINK(24))| <= BOUND }
