# load_moved_pairs() (src/filter/narrow_frame.h): a coordinate of o + (t + r) d from the
# base, in units of |o - base| + |t d|: f is the low part of o - base, e the error of
# t d.hi; a and b are r d.hi and t d.lo, c is r d.lo, which is left out; s is the low
# part of the sum.  |r| is at most 2^-52 |t|.  Each operation is rounded; fused, fewer
# are.
# modes: ne
# bound: CYLINT_MEMBER_MOVED_ROUNDING
# each: CYLINT_NEAREST_ROUNDING
Low = ((f + (a * (1 + d1) + (b * (1 + d2) + e) * (1 + d3)) * (1 + d4)) * (1 + d5) + s) * (1 + d6);
True = f + a + b + c + e + s;
{ RANGES(6) /\ |a| <= 1b-52 /\ |b| <= 1b-53 /\ |c| <= 1b-105 /\ |e| <= 1b-53 /\
  |f| <= 1b-53 /\ |s| <= 0x1.01p-53
  -> |Low - True| <= BOUND }
Low - True -> f * ((1 + d5) * (1 + d6) - 1) +
              a * ((1 + d1) * (1 + d4) * (1 + d5) * (1 + d6) - 1) +
              b * ((1 + d2) * (1 + d3) * (1 + d4) * (1 + d5) * (1 + d6) - 1) +
              e * ((1 + d3) * (1 + d4) * (1 + d5) * (1 + d6) - 1) + s * d6 - c;
