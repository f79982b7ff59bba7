# cylint_along_normal() (src/filter/plane.h), relative to the sum of the sizes of the
# products' high parts.  Of product j: a is that by the low part, e the error of the high
# part; s and t are the low parts of the sums of high parts.  Each operation is
# rounded; fused, fewer are.
# modes: ne
# bound: CYLINT_PLANE_ROUNDING
# each: CYLINT_NEAREST_ROUNDING
A = ((a0 * (1 + d1) + a1 * (1 + d2)) * (1 + d3) + a2 * (1 + d4)) * (1 + d5);
B = (((e0 + e1) * (1 + d6) + e2) * (1 + d7) + (s + t) * (1 + d8)) * (1 + d9);
Low = (A + B) * (1 + d10);
True = a0 + a1 + a2 + e0 + e1 + e2 + s + t;
{ RANGES(10) /\
  |e0| <= 1b-53 /\ |a0| <= 0x1.01p-53 /\ |a1| <= 0x1.01p-53 /\ |a2| <= 0x1.01p-53 /\
  |e1| <= 1b-53 /\ |e2| <= 1b-53 /\ |s| <= 0x1.01p-53 /\ |t| <= 0x1.01p-53
  -> |Low - True| <= BOUND }
Low - True ->
  a0 * ((1 + d1) * (1 + d3) * (1 + d5) * (1 + d10) - 1) +
  a1 * ((1 + d2) * (1 + d3) * (1 + d5) * (1 + d10) - 1) +
  a2 * ((1 + d4) * (1 + d5) * (1 + d10) - 1) +
  (e0 + e1) * ((1 + d6) * (1 + d7) * (1 + d9) * (1 + d10) - 1) +
  e2 * ((1 + d7) * (1 + d9) * (1 + d10) - 1) +
  (s + t) * ((1 + d8) * (1 + d9) * (1 + d10) - 1);
