# vpair_product() (src/numbers/simd.h) in units of a.hi b.hi: a.lo is x,
# |x| <= 2^-50; b is a cosine or sine in a pair, b.lo is y, and what the pair lacks
# is t; the error of the product of the high parts is w.  Each operation is
# rounded; fused, fewer are.
# modes: ne
# bound: CYLINT_TURN_PRODUCT
# each: CYLINT_NEAREST_ROUNDING
Low = (y * (1 + d1) + (x * (1 + d2) + w) * (1 + d3)) * (1 + d4);
True = w + x + y + t + x * y + x * t;
{ RANGES(4) /\ |x| <= 1b-50 /\ |y| <= 1b-53 /\ |w| <= 1b-53 /\ |t| <= 1b-106
  -> |Low - True| <= BOUND }
Low - True -> y * ((1 + d1) * (1 + d4) - 1) +
              x * ((1 + d2) * (1 + d3) * (1 + d4) - 1) +
              w * ((1 + d3) * (1 + d4) - 1) - t - x * y - x * t;
