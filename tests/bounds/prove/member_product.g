# vpair_mul() (src/numbers/simd.h) of a coordinate and a factor, in units of the sizes
# of the coordinate's terms times the factor: e is the error of the high parts'
# product; a and b are the products by low parts, the coordinate's up to 25 units.
# modes: ne
# bound: CYLINT_MEMBER_PRODUCT
# each: CYLINT_NEAREST_ROUNDING
Low = (a * (1 + d1) + (b * (1 + d2) + e) * (1 + d3)) * (1 + d4);
True = a + b + c + e;
{ RANGES(4) /\ |a| <= 0x19p-53 /\ |b| <= 0x19p-53 /\ |c| <= 0x19p-105 /\
  |e| <= 0x1.01p-53
  -> |Low - True| <= BOUND }
Low - True -> a * ((1 + d1) * (1 + d4) - 1) +
              b * ((1 + d2) * (1 + d3) * (1 + d4) - 1) +
              e * ((1 + d3) * (1 + d4) - 1) - c;
