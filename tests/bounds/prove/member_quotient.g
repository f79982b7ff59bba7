# vpair_quotient() (src/numbers/simd.h) of the members of a hit, in units of
# x.hi / y.hi: q is the quotient of doubles, r = 1 - q the rest of x.hi, x and y are the
# low parts; d1 is the rounding of the inverse.  Where |x.lo| is larger than a unit of
# x.hi, x has cancelled: its bound covers what is relative to x.lo.  Fused, there are
# fewer roundings.
# modes: ne
# bound: CYLINT_MEMBER_QUOTIENT
# each: CYLINT_NEAREST_ROUNDING
Low = (r * (1 + d3) + (x - (1 - r) * y * (1 + d4)) * (1 + d5)) * (1 + d6) * (1 + d1) * (1 + d2);
True = r + (x - y) / (1 + y);
{ RANGES(6) /\ |r| <= 0x2.01p-53 /\ |x| <= 1b-52 /\ |y| <= 1b-52
  -> |Low - True| <= BOUND }
Low - True ->
  r * ((1 + d3) * (1 + d6) * (1 + d1) * (1 + d2) - 1) +
  x * ((1 + d5) * (1 + d6) * (1 + d1) * (1 + d2) - 1 / (1 + y)) -
  y * ((1 - r) * (1 + d4) * (1 + d5) * (1 + d6) * (1 + d1) * (1 + d2) - 1 / (1 + y))
  { 1 + y <> 0 };
