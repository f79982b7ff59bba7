# pair_lanes.h, pairs_sum3(): D.w, relative to S = |D_x| + |D_y| +
# |D_z|.  Scaled to S = 1, so no component and no product is larger, the sums are
# at most 2 and 3, and two_prod and two_sum are exact.  Fused, everything is
# rounded less often.  The entries of the matrix are taken as they are.
# modes: ne
# bound: CYLINT_PAIR_SUM
@rn = float<ieee_64, MODE>;
ix rn= Dxl * wx + px;
iy rn= Dyl * wy + py;
iz rn= Dzl * wz + pz;
lx rn= Dx * wxl + ix;
ly rn= Dy * wyl + iy;
lz rn= Dz * wzl + iz;
low rn= (s + t) + (lx + (ly + lz));
Lx = Dx * wxl + (Dxl * wx + px);
Ly = Dy * wyl + (Dyl * wy + py);
Lz = Dz * wzl + (Dzl * wz + pz);
Low = (s + t) + (Lx + (Ly + Lz));
Rest = Dxl * wxl + Dyl * wyl + Dzl * wzl;
{ |Dx| <= 1 /\ |Dy| <= 1 /\ |Dz| <= 1 /\ |wx| <= 1 /\ |wy| <= 1 /\ |wz| <= 1 /\
  |Dxl| <= 1b-53 /\ |Dyl| <= 1b-53 /\ |Dzl| <= 1b-53 /\
  |wxl| <= 1b-53 /\ |wyl| <= 1b-53 /\ |wzl| <= 1b-53 /\
  |px| <= 1b-53 /\ |py| <= 1b-53 /\ |pz| <= 1b-53 /\
  |s| <= 1b-53 /\ |t| <= 2b-53
  -> |(low - Low) - Rest| <= BOUND }
