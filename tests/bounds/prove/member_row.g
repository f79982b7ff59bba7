# row_in_pairs() and transformed() (src/filter/wide_frame.h and narrow_frame.h): a row of the matrix times a
# vector, of which the sum of the sizes of the products is at most 1.  Of product j: e is
# the error of its high part, a and b are those by low parts, c is left out; s and t are
# the low parts of the sums of high parts.  Each operation is rounded; fused, fewer are.
# No product is larger than the sum of all sizes.
# modes: ne
# bound: CYLINT_MEMBER_ROW
# each: CYLINT_NEAREST_ROUNDING
Lo0 = (b0 * (1 + d1) + (a0 * (1 + d2) + e0) * (1 + d3)) * (1 + d4);
Lo1 = (b1 * (1 + d5) + (a1 * (1 + d6) + e1) * (1 + d7)) * (1 + d8);
Lo2 = (b2 * (1 + d9) + (a2 * (1 + d10) + e2) * (1 + d11)) * (1 + d12);
Low = (((Lo0 + Lo1) * (1 + d13) + Lo2) * (1 + d14) + (s + t) * (1 + d15)) * (1 + d16);
True = b0 + a0 + e0 + c0 + b1 + a1 + e1 + c1 + b2 + a2 + e2 + c2 + s + t;
{ RANGES(16) /\
  |a0| <= 1b-53 /\ |b0| <= 1b-53 /\ |e0| <= 1b-53 /\ |c0| <= 1b-106 /\
  |a1| <= 1b-53 /\ |b1| <= 1b-53 /\ |e1| <= 1b-53 /\ |c1| <= 1b-106 /\
  |a2| <= 1b-53 /\ |b2| <= 1b-53 /\ |e2| <= 1b-53 /\ |c2| <= 1b-106 /\
  |s| <= 0x1.01p-53 /\ |t| <= 0x1.01p-53
  -> |Low - True| <= BOUND }
Low - True ->
  b0 * ((1 + d1) * (1 + d4) * (1 + d13) * (1 + d14) * (1 + d16) - 1) +
  a0 * ((1 + d2) * (1 + d3) * (1 + d4) * (1 + d13) * (1 + d14) * (1 + d16) - 1) +
  e0 * ((1 + d3) * (1 + d4) * (1 + d13) * (1 + d14) * (1 + d16) - 1) - c0 +
  b1 * ((1 + d5) * (1 + d8) * (1 + d13) * (1 + d14) * (1 + d16) - 1) +
  a1 * ((1 + d6) * (1 + d7) * (1 + d8) * (1 + d13) * (1 + d14) * (1 + d16) - 1) +
  e1 * ((1 + d7) * (1 + d8) * (1 + d13) * (1 + d14) * (1 + d16) - 1) - c1 +
  b2 * ((1 + d9) * (1 + d12) * (1 + d14) * (1 + d16) - 1) +
  a2 * ((1 + d10) * (1 + d11) * (1 + d12) * (1 + d14) * (1 + d16) - 1) +
  e2 * ((1 + d11) * (1 + d12) * (1 + d14) * (1 + d16) - 1) - c2 +
  (s + t) * ((1 + d15) * (1 + d16) - 1);
