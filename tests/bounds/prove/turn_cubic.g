# turn_of_tangent() (src/numbers/turns_lanes.h): what has the factor q^2 of its error
# relative to a.hi = q.hi Ph.  Z = q.hi^2, z is its rounding, and
# F = (atan(q) / q - 1) / (2 pi q^2) is the series less R.  g is q.lo / q.hi, where q.lo is
# relative to q.hi; m is the product of the rest of q.lo (turn_node.g), at most
# 3.5 * 2^-50 sin, and q.hi: its share of atan' is z^2 q.lo and less.  g * g bounds the
# term of atan''.
# modes: ne
# bound: CYLINT_TURN_CUBIC
# each: CYLINT_NEAREST_ROUNDING
@rn = float<ieee_64, MODE>;
Ph = 0x1.45f306dc9c883p-3;
c3 = 0x1.219d7dd2f8fe4p-6;
c2 = -0x1.7483745cd7891p-6;
c1 = 0x1.04c26be3ae7c6p-5;
c0 = -0x1.b2995e7b7b603p-5;
s rn= ((c3 * z + c2) * z + c1) * z + c0;
S = ((c3 * z + c2) * z + c1) * z + c0;
E = s * ((FACTORS(4)) - 1) + (s - S) + D + R -
    g * Ph * ((1 + d1) * (1 + d5) * (1 + d6) * (1 + d7) * (1 + d3) * (1 + d4) - 1) -
    Ph * (g * Z + m) - g * g * Ph * w;
{ RANGES(7) /\ z in [0, 0x1.05p-12] /\ Z in [0, 0x1.05p-12] /\
  |R| <= 0x1.1p-58 /\ |D| <= 0x1.2p-70 /\ |g| <= 0x2.bp-50 /\ |m| <= 0x2.8p-56 /\ |w| <= 1
  -> |E / Ph| <= BOUND }
