# half_plane.h, lazy_mul() of the cosine or sine and rho or z, relative to the size
# 1: the low part of rho has up to 2^-46.  The product of the low parts is left out
# and part of the error.
# modes: ne
# bound: CYLINT_HALF_PLANE_MUL
@rn = float<ieee_64, MODE>;
inner rn= al * b + p;
low rn= a * bl + inner;
{ |a| <= 1 /\ |al| <= 1b-53 /\ |b| <= 1 /\ |bl| <= 1b-46 /\ |p| <= 1b-53
  -> |(low - (a * bl + (al * b + p))) - al * bl| <= BOUND }
