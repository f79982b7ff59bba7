# at_root() (src/filter/members.h) of a local coordinate, p + (t + r) v, in units of the
# sum of the sizes of the terms of p and of t v, as member_place.g.  p.lo and v.lo are
# sums of eleven low parts: f is p.lo, b is t v.lo.
# modes: ne
# bound: CYLINT_MEMBER_STEP
# each: CYLINT_NEAREST_ROUNDING
Low = ((f + (a * (1 + d1) + (b * (1 + d2) + e) * (1 + d3)) * (1 + d4)) * (1 + d5) + s) * (1 + d6);
True = f + a + b + c + e + s;
{ RANGES(6) /\ |a| <= 0x1.01p-52 /\ |b| <= 0xb.1p-53 /\ |c| <= 0xb.1p-105 /\
  |e| <= 0x1.01p-53 /\ |f| <= 0xb.1p-53 /\ |s| <= 0x1.01p-53
  -> |Low - True| <= BOUND }
Low - True -> f * ((1 + d5) * (1 + d6) - 1) +
              a * ((1 + d1) * (1 + d4) * (1 + d5) * (1 + d6) - 1) +
              b * ((1 + d2) * (1 + d3) * (1 + d4) * (1 + d5) * (1 + d6) - 1) +
              e * ((1 + d3) * (1 + d4) * (1 + d5) * (1 + d6) - 1) + s * d6 - c;
