# pair_sqrt, relative to s = rn(sqrt(a.hi)) >= 1.  For a.hi in [1, 2]:
# r = a.hi - s^2 is computed exactly, |s - sqrt(a.hi)| <= 2^-53, and
# root = sqrt(a) = s + X / (s + root), X = r + a.lo.  For a.hi in [2, 4],
# capital letters, |a.lo| <= 2^-52.
# modes: ne
# bound: CYLINT_PAIR_SQRT
@rn = float<ieee_64, MODE>;
rest rn= r + alo;
d rn= rest / (2 * s);
X = r + alo;
e = d - X / (s + root);

Rest rn= R + Alo;
D rn= Rest / (2 * S);
Y = R + Alo;
E = D - Y / (S + Root);
{ s in [1, 0x1.6a2p0] /\ |r| <= 0x1.6a2p-52 /\ |alo| <= 1b-53 /\
  |root - s| <= 2b-53 /\
  S in [0x1.6ap0, 2] /\ |R| <= 2b-52 /\ |Alo| <= 2b-53 /\ |Root - S| <= 2b-53
  -> |e| <= BOUND /\ |E / 0x1.6ap0| <= BOUND }
e -> (d - rest / (2 * s)) + (rest - X) / (2 * s) +
     X * (root - s) / (2 * s * (s + root)) { s <> 0, s + root <> 0 };
s + root -> 2 * s + (root - s);
E -> (D - Rest / (2 * S)) + (Rest - Y) / (2 * S) +
     Y * (Root - S) / (2 * S * (S + Root)) { S <> 0, S + Root <> 0 };
S + Root -> 2 * S + (Root - S);
