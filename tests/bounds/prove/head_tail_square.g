# head_tail.h, head_tail_load(): the tail of D.D, relative to S^2 = 1, with the
# letters of head_tail_z.g: D^2 - h^2 = (r + dl) (D + h).
# modes: ne
# bound: CYLINT_HEAD_TAIL_SQUARE
@rn = float<ieee_64, MODE>;
lx rn= rx + dx; ly rn= ry + dy; lz rn= rz + dz;
tx rn= lx * (Dx + hx);
ty rn= ly * (Dy + hy) + tx;
low rn= lz * (Dz + hz) + ty;
Tx = (rx + dx) * (Dx + hx);
Ty = (ry + dy) * (Dy + hy) + Tx;
Low = (rz + dz) * (Dz + hz) + Ty;
Rest = (rx + dx) * dx + (ry + dy) * dy + (rz + dz) * dz;
{ |rx| <= 1b-26 /\ |ry| <= 1b-26 /\ |rz| <= 1b-26 /\
  |dx| <= 1b-53 /\ |dy| <= 1b-53 /\ |dz| <= 1b-53 /\
  |Dx| <= 1 /\ |Dy| <= 1 /\ |Dz| <= 1 /\ |hx| <= 1 /\ |hy| <= 1 /\ |hz| <= 1
  -> |(low - Low) - Rest| <= BOUND }
