# limbs.h, load_upright(): the low part of D.D, relative to S^2 = 1, with the
# letters of limb_z.g: D^2 - h^2 = (r + dl) (D + h).
# modes: ne
# bound: CYLINT_LIMB_SQUARE
@rn = float<ieee_64, MODE>;
lx rn= rx + dx; ly rn= ry + dy; lz rn= rz + dz;
tx rn= lx * (Dx + hx);
ty rn= ly * (Dy + hy);
tz rn= lz * (Dz + hz);
low rn= (tx + ty) + tz;
Tx = (rx + dx) * (Dx + hx);
Ty = (ry + dy) * (Dy + hy);
Tz = (rz + dz) * (Dz + hz);
Low = (Tx + Ty) + Tz;
Rest = (rx + dx) * dx + (ry + dy) * dy + (rz + dz) * dz;
{ |rx| <= 1b-26 /\ |ry| <= 1b-26 /\ |rz| <= 1b-26 /\
  |dx| <= 1b-53 /\ |dy| <= 1b-53 /\ |dz| <= 1b-53 /\
  |Dx| <= 1 /\ |Dy| <= 1 /\ |Dz| <= 1 /\ |hx| <= 1 /\ |hy| <= 1 /\ |hz| <= 1
  -> |(low - Low) - Rest| <= BOUND }
