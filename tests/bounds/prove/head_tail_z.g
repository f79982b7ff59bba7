# head_tail.h, head_tail_load(): the tail of z = D.unit, relative to S = 1.  D = h +
# r + dl, h a multiple of the snap, r = D.hi - h exactly; the unit vector is un +
# ul.  All sums of h un are exact, and e is what the head of z leaves of them.
# modes: ne
# bound: CYLINT_HEAD_TAIL_Z
@rn = float<ieee_64, MODE>;
lx rn= rx + dx; ly rn= ry + dy; lz rn= rz + dz;
tx rn= lx * ux + Dx * vx;
ty rn= ly * uy + (Dy * vy + tx);
tz rn= lz * uz + (Dz * vz + ty);
low rn= e + tz;
Tx = (rx + dx) * ux + Dx * vx;
Ty = (ry + dy) * uy + (Dy * vy + Tx);
Tz = (rz + dz) * uz + (Dz * vz + Ty);
Low = e + Tz;
Rest = dx * vx + dy * vy + dz * vz;
{ |rx| <= 1b-26 /\ |ry| <= 1b-26 /\ |rz| <= 1b-26 /\
  |dx| <= 1b-53 /\ |dy| <= 1b-53 /\ |dz| <= 1b-53 /\
  |ux| <= 1 /\ |uy| <= 1 /\ |uz| <= 1 /\ |Dx| <= 1 /\ |Dy| <= 1 /\ |Dz| <= 1 /\
  |vx| <= 1b-26 /\ |vy| <= 1b-26 /\ |vz| <= 1b-26 /\ |e| <= 2b-26
  -> |(low - Low) - Rest| <= BOUND }
