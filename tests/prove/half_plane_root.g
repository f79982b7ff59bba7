# half_plane.h, root_of_difference() and length_of(): sqrt(s^2 + rest) from two
# terms of its series.  With x = rest / s^2 the root is s sqrt(1 + x), and the
# steps are s x/2 (1 + a) and s x^2/8 (1 + b) with the roundings of half = 1 / (2 s)
# (c and d), of the products and of the difference.  Let R = sqrt(1 + x) and
# T = 1 + x/2 - x^2/8.  T^2 = 1 + x - x^3/8 + x^4/64, so
#
#   T - R = (-x^3/8 + x^4/64) / (T + R).
#
# The error is this and that of the steps, relative to |rest| / s = s |x|.
# modes: ne
# bound: CYLINT_HALF_PLANE_ROOT
# each: CYLINT_NEAREST_ROUNDING
R = sqrt(1 + x);
T = 1 + 0.5 * x - 0.125 * (x * x);
series = (-0.125 * (x * x) + 0.015625 * (x * (x * x))) / (T + R);
first = FACTORS(2) - 1;
second = FACTORS(2) * FACTORS(2) * FACTORS(3) - 1;
steps = (0.5 * first - 0.125 * x * second) * (1 + d4)
        + (0.5 - 0.125 * x) * d4;
{ RANGES(4) /\ |x| <= 1b-21 -> |series + steps| <= BOUND }
