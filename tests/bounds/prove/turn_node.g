# turns_of() (src/numbers/turns_lanes.h) beyond node 0: the error that is not
# relative to q.  In units of u.hi sin: v cos is at most 1.65; lo1 and lo2 are the low parts of v cos
# and u sin, with the errors e1 and e2; k is that of the difference of their high parts.
# nl is the low part of the difference.  It is divided by the high part of
# u cos + v sin, whose low part is y of it, and multiplied by 1 - q^2 and by
# 1 / (2 pi).  u.hi sin / (u cos + v sin) is at most 1.001 sin, that is at most 1.001 * 2 pi nodes.
# modes: ne
# bound: CYLINT_TURN_NODE
# each: CYLINT_NEAREST_ROUNDING
l = lo1 - lo2;
nl = (k + l * (1 + d1)) * (1 + d2);
en = k * d2 + l * ((1 + d1) * (1 + d2) - 1) + e1 * 1.65 + e2;
E = en + nl * ((FACTORS(4)) - 1 / (1 + y)) + nl * ((1 + d3) * (1 + d4) * (1 + d5) * (1 + d6) - 1) +
    nl * z * ((FACTORS(6)) - 1);
{ RANGES(6) /\ |lo1| <= 0x2.11p-50 /\ |lo2| <= 0x1.41p-50 /\ |k| <= 0x0.a8p-53 /\
  |e1| <= 0x4.a1p-103 /\ |e2| <= 0x4.a1p-103 /\ |y| <= 0x1.67p-50 /\ z in [0, 0x1.05p-12]
  -> |1.001 * E| <= BOUND }
