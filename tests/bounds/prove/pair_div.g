# pair_div, relative to q = rn(a.hi / b.hi), b.hi scaled to [1, 2] and q to
# [1/2, 1] or [1, 2]: r = a.hi - q b.hi is computed exactly, and at most
# ulp(q)/2 b.hi.
# modes: ne
# bound: CYLINT_PAIR_DIV
@rn = float<ieee_64, MODE>;
qblo rn= q * blo;
low rn= alo - qblo;
rest rn= r + low;
d rn= rest / bhi;
X = r + (alo - q * blo);
e = d - X / (bhi + blo);

Qblo rn= Q * blo;
Low rn= alo - Qblo;
Rest rn= R + Low;
D rn= Rest / bhi;
Y = R + (alo - Q * blo);
E = D - Y / (bhi + blo);
{ bhi in [1, 2] /\ |alo| <= 1b-53 /\ |blo| <= 1b-53 /\
  q in [0.5, 1] /\ |r| <= 1b-53 /\
  Q in [1, 2] /\ |R| <= 2b-53
  -> |2 * e| <= BOUND /\ |E| <= BOUND }
rest - X -> (rest - (r + low)) + (low - (alo - qblo)) - (qblo - q * blo);
e -> (d - rest / bhi) + (rest - X) / bhi + X * blo / (bhi * (bhi + blo))
     { bhi <> 0, bhi + blo <> 0 };
Rest - Y -> (Rest - (R + Low)) + (Low - (alo - Qblo)) - (Qblo - Q * blo);
E -> (D - Rest / bhi) + (Rest - Y) / bhi + Y * blo / (bhi * (bhi + blo))
     { bhi <> 0, bhi + blo <> 0 };
