# pair_lanes.h, pairs_root(), relative to the root: s is the root of the high part, a =
# s^2 (1 + x), and x is the sum of r, a difference without a rounding, and of the low
# parts p of s^2 and l of a.  The first step is half of x, with the roundings of the
# inverse, of the half of it and of the product; the root is sqrt(1 + x).
# modes: ne
# bound: CYLINT_PAIR_ROOT
# each: CYLINT_NEAREST_ROUNDING
@rn = float<ieee_64, MODE>;
x = (r - p) + l;
rest rn= (r - p) + l;
R = sqrt(1 + x);
T = 1 + 0.5 * x;
series = 0.25 * (x * x) / (T + R);
step = 0.5 * (rest - x) * FACTORS(3) + 0.5 * x * (FACTORS(3) - 1);
{ RANGES(3) /\ |r| <= 1b-51 /\ |p| <= 1b-53 /\ |l| <= 1b-52
  -> |series + step| <= BOUND }
