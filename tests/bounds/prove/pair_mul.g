# pair_mul, relative to |a.hi b.hi| >= 1: both scaled to [1, 2], so that
# |lo| <= ulp(hi)/2 <= 2^-53; the low part of the product is exact and at
# most ulp(4-)/2.  a.lo b.lo is left out and part of the error.
# modes: ne
# bound: CYLINT_PAIR_MUL
@rn = float<ieee_64, MODE>;
cross rn= rn(ahi * blo) + rn(alo * bhi);
w rn= plo + cross;
{ |ahi| in [1, 2] /\ |bhi| in [1, 2] /\ |alo| <= 1b-53 /\ |blo| <= 1b-53 /\
  |plo| <= 2b-53
  -> |w - (plo + (ahi * blo + alo * bhi)) - alo * blo| <= BOUND }
