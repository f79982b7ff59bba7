# pair_add, relative to A + B = |a.hi| + |b.hi|, scaled to [1, 2]:
# two_sum is exact, |lo| <= 2^-53 |hi|, |s.lo| <= ulp(2-)/2
# modes: ne
# bound: CYLINT_PAIR_ADD
@rn = float<ieee_64, MODE>;
v rn= alo + blo;
w rn= slo + v;
{ |alo + blo| <= 2b-53 /\ |slo| <= 1b-53
  -> |w - (slo + (alo + blo))| <= BOUND }
