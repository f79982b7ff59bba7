# The same where every rounding may err by an ulp: the low parts of two_sum
# and of the final fast_two_sum are off by x and y, at most 2^-104 |s| each.
# modes: zr up dn
# bound: CYLINT_PAIR_ADD_DIRECTED
@rn = float<ieee_64, MODE>;
v rn= alo + blo;
t = slo + x;
w rn= t + v;
{ |alo + blo| <= 2b-52 /\ |t| <= 2b-52 /\ |x| <= 2b-104 /\ |y| <= 2b-104
  -> |w - (t + (alo + blo)) + x + y| <= BOUND }
