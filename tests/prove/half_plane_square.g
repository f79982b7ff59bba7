# half_plane.h, lazy_square() of z, relative to S^2 = 1: |z.lo| is at most the sum
# of all that dots() adds up.  z.lo^2 is left out and part of the error.
# modes: ne
# bound: CYLINT_HALF_PLANE_SQUARE
@rn = float<ieee_64, MODE>;
low rn= 2 * z * zl + p;
{ |z| <= 1 /\ |zl| <= 13b-53 /\ |p| <= 1b-53
  -> |(low - (2 * z * zl + p)) - zl * zl| <= BOUND }
