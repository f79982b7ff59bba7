# at_root() (src/filter/members.h) of a point, o + (t + r) d, in units of |o| + |t d|:
# e is the error of t d.hi; a and b are r d.hi and t d.lo, c is r d.lo, which is left
# out; s is the low part of the sum.  |r| is at most 2^-52 |t|.  Each operation is
# rounded; fused, fewer are.
# modes: ne
# bound: CYLINT_MEMBER_PLACE_ROUNDING
# each: CYLINT_NEAREST_ROUNDING
Low = ((a * (1 + d1) + (b * (1 + d2) + e) * (1 + d3)) * (1 + d4) + s) * (1 + d5);
True = a + b + c + e + s;
{ RANGES(5) /\ |a| <= 1b-52 /\ |b| <= 1b-53 /\ |c| <= 1b-105 /\ |e| <= 1b-53 /\
  |s| <= 0x1.01p-53
  -> |Low - True| <= BOUND }
Low - True -> a * ((1 + d1) * (1 + d4) * (1 + d5) - 1) +
              b * ((1 + d2) * (1 + d3) * (1 + d4) * (1 + d5) - 1) +
              e * ((1 + d3) * (1 + d4) * (1 + d5) - 1) + s * d5 - c;
