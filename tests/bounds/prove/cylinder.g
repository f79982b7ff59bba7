# G of a cylinder, evaluated as forms_template.h does: u, w and D are rounded
# differences, all data at most 1 in size.
# modes: zr up dn
# bound: CYLINT_CYLINDER_G_ERROR
@rn = float<ieee_64, MODE>;
ux = rn(Ux); uy = rn(Uy); uz = rn(Uz);
wx = rn(Wx); wy = rn(Wy); wz = rn(Wz);
dx = rn(Dx); dy = rn(Dy); dz = rn(Dz);

nx rn= uy * wz - uz * wy;
ny rn= uz * wx - ux * wz;
nz rn= ux * wy - uy * wx;
mx rn= dy * uz - dz * uy;
my rn= dz * ux - dx * uz;
mz rn= dx * uy - dy * ux;
h rn= wx * mx + wy * my + wz * mz;
nn rn= nx * nx + ny * ny + nz * nz;
g rn= r * r * nn - h * h;

Nx = Uy * Wz - Uz * Wy;
Ny = Uz * Wx - Ux * Wz;
Nz = Ux * Wy - Uy * Wx;
Mx = Dy * Uz - Dz * Uy;
My = Dz * Ux - Dx * Uz;
Mz = Dx * Uy - Dy * Ux;
H = Wx * Mx + Wy * My + Wz * Mz;
G = r * r * (Nx * Nx + Ny * Ny + Nz * Nz) - H * H;

{ |r| <= 1 /\ @FLT(r, 53) /\
  |Ux| <= 1 /\ |Uy| <= 1 /\ |Uz| <= 1 /\
  |Wx| <= 1 /\ |Wy| <= 1 /\ |Wz| <= 1 /\
  |Dx| <= 1 /\ |Dy| <= 1 /\ |Dz| <= 1
  -> |g - G| <= BOUND }
