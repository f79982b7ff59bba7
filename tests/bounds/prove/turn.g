# cylint_atan2_turns() (src/embree/float_filter_lanes.h): y <= x, their sizes sorted,
# x scaled to [1, 2]; T is the true tangent from pi / 8 and t what is computed.  The true
# angle of t, in turns, is its series less R, at most the first term left out,
# 0.4142136^29 / (58 pi); that of T differs from it by at most |T - t| / (2 pi).
# The sum shown rounds most.  Fused, everything is rounded less often.
# modes: ne
# bound: CYLINT_ATAN2_TURNS_ERROR
@rn = float<ieee_64, MODE>;
Tau = 0.414213562373095048801688724209698;
P = 0.159154943091895335768883763372514;
tau = rn(Tau);
p = rn(P);
ytau rn= y * tau;
den rn= x + ytau;
xtau rn= x * tau;
num rn= y - xtau;
per rn= 1 / den;
t rn= num * per;
Den = x + y * Tau;
Num = y - x * Tau;
T = Num / Den;

z rn= t * t;
z2 rn= z * z;
z4 rn= z2 * z2;
z8 rn= z4 * z4;
c1 = rn(-p / 3); c2 = rn(p / 5); c3 = rn(-p / 7);
c4 = rn(p / 9); c5 = rn(-p / 11); c6 = rn(p / 13);
c7 = rn(-p / 15); c8 = rn(p / 17); c9 = rn(-p / 19);
c10 = rn(p / 21); c11 = rn(-p / 23); c12 = rn(p / 25);
c13 = rn(-p / 27);
s0 rn= p + c1 * z;
s2 rn= c2 + c3 * z;
s4 rn= c4 + c5 * z;
s6 rn= c6 + c7 * z;
s8 rn= c8 + c9 * z;
s10 rn= c10 + c11 * z;
s12 rn= c12 + c13 * z;
low rn= s0 + z2 * s2 + z4 * (s4 + z2 * s6);
high rn= s8 + z2 * s10 + z4 * s12;
sum rn= low + z8 * high;
turn rn= 0.9375 + t * sum;

Z = t * t;
Z2 = Z * Z;
Z4 = Z2 * Z2;
Z8 = Z4 * Z4;
C1 = -P / 3; C2 = P / 5; C3 = -P / 7;
C4 = P / 9; C5 = -P / 11; C6 = P / 13;
C7 = -P / 15; C8 = P / 17; C9 = -P / 19;
C10 = P / 21; C11 = -P / 23; C12 = P / 25;
C13 = -P / 27;
S0 = P + C1 * Z; S2 = C2 + C3 * Z; S4 = C4 + C5 * Z;
S6 = C6 + C7 * Z; S8 = C8 + C9 * Z; S10 = C10 + C11 * Z;
S12 = C12 + C13 * Z;
Low = S0 + Z2 * S2 + Z4 * (S4 + Z2 * S6);
High = S8 + Z2 * S10 + Z4 * S12;
Sum = Low + Z8 * High;
True = 0.9375 + (t * Sum - R + L * (T - t));
{ x in [1, 2] /\ y in [0, 2] /\ |T| <= 0.41421357 /\
  |R| <= 4.35440082e-14 /\ L in [0, 0.15915495]
  -> |turn - True| <= BOUND }
t - T -> (t - num * per) + (num - Num) * per + T * Den * (per - 1 / den) +
         T * (Den - den) / den { den <> 0, Den <> 0 };
turn - True -> (turn - (0.9375 + t * sum)) + t * (sum - Sum) + R +
               L * (t - T);
p ~ P;
c1 ~ C1; c2 ~ C2; c3 ~ C3; c4 ~ C4; c5 ~ C5; c6 ~ C6; c7 ~ C7;
c8 ~ C8; c9 ~ C9; c10 ~ C10; c11 ~ C11; c12 ~ C12; c13 ~ C13;
z2 ~ Z2; z4 ~ Z4; z8 ~ Z8;
s0 ~ S0; s2 ~ S2; s4 ~ S4; s6 ~ S6; s8 ~ S8; s10 ~ S10; s12 ~ S12;
low ~ Low; high ~ High; sum ~ Sum;
