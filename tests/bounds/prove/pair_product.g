# simd.h, vpair_product(), relative to the size 1 of both factors: the low part
# of z has up to 13 2^-53.  The product of the low parts is left out and part of the
# error.
# modes: ne
# bound: CYLINT_PAIR_PRODUCT
@rn = float<ieee_64, MODE>;
inner rn= al * b + p;
low rn= a * bl + inner;
{ |a| <= 1 /\ |al| <= 13b-53 /\ |b| <= 1 /\ |bl| <= 13b-53 /\ |p| <= 1b-53
  -> |(low - (a * bl + (al * b + p))) - al * bl| <= BOUND }
