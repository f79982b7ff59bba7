# turn_of_tangent() (src/numbers/turns_lanes.h): what is relative to a.hi = q.hi Ph of
# its error and does not have the factor q^2.  In units of q.hi: g is q.lo, where it is
# relative to q.hi, and h the error of q.hi Ph.  P = Ph + Pl + e is 1 / (2 pi).
# modes: ne
# bound: CYLINT_TURN_TANGENT_ROUNDING
# each: CYLINT_NEAREST_ROUNDING
Ph = 0x1.45f306dc9c883p-3;
Pl = -0x1.6b01ec5417056p-57;
E = g * Ph * ((FACTORS(4)) - 1) - g * (Pl + e) +
    Pl * ((1 + d5) * (1 + d6) * (1 + d3) * (1 + d4) - 1) +
    h * ((1 + d6) * (1 + d3) * (1 + d4) - 1) - e;
{ RANGES(6) /\ |g| <= 0x2.bp-50 /\ |h| <= 1b-56 /\ |e| <= 1b-110
  -> |E / Ph| <= BOUND }
