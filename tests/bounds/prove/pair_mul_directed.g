# The same where every rounding may err by an ulp: the low part of the final
# fast_two_sum is off by y, at most 2^-104 of a sum below 4.
# modes: zr up dn
# bound: CYLINT_PAIR_MUL_DIRECTED
@rn = float<ieee_64, MODE>;
cross rn= rn(ahi * blo) + rn(alo * bhi);
w rn= plo + cross;
{ |ahi| in [1, 2] /\ |bhi| in [1, 2] /\ |alo| <= 1b-52 /\ |blo| <= 1b-52 /\
  |plo| <= 2b-52 /\ |y| <= 4b-104
  -> |w - (plo + (ahi * blo + alo * bhi)) - alo * blo + y| <= BOUND }
