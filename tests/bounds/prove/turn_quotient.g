# vpair_quotient() (src/numbers/simd.h) of turns_of(): what is relative to q of its
# error.
# In units of q b.hi: r = a.hi - q b.hi, two roundings of a.hi; x = a.lo, where it is
# relative to a.hi, as it is of node 0 (turn_node.g has the others); y = b.lo, which
# is at most 1.25 * 2^-50 of two products (turn_product.g) and a rounding of their sum;
# e is its error, CYLINT_TURN_PRODUCT and two roundings of it.
# modes: ne
# bound: CYLINT_TURN_QUOTIENT
# each: CYLINT_NEAREST_ROUNDING
Low = (r * (1 + d6) + (x - y * (1 + d5)) * (1 + d4)) * (FACTORS(3));
True = (r + x - y - e) / (1 + y + e);
{ RANGES(6) /\ |r| <= 0x2.03p-53 /\ |x| <= 0x1.03p-50 /\ |y| <= 0x1.67p-50 /\
  |e| <= 0x7.8p-103
  -> |Low - True| <= BOUND }
Low - True -> r * ((1 + d6) * (FACTORS(3)) - 1 / (1 + y + e)) +
              x * ((1 + d4) * (FACTORS(3)) - 1 / (1 + y + e)) -
              y * ((1 + d5) * (1 + d4) * (FACTORS(3)) - 1 / (1 + y + e)) +
              e / (1 + y + e) { 1 + y + e <> 0 };
