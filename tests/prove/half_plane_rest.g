# half_plane.h, root_of_difference(): what the square of the first root lacks,
# relative to S^2 = 1.  d.hi + d.lo = dd.hi - t.hi and p.hi + p.lo = s^2 exactly,
# and r = d.hi - p.hi is exact, because s is the double nearest to sqrt(d.hi).
# modes: ne
# bound: CYLINT_HALF_PLANE_REST
@rn = float<ieee_64, MODE>;
rest rn= r - (p - (d + (ddl - tl)));
{ |ddl| <= 13b-53 /\ |tl| <= 27b-53 /\ |d| <= 1b-53 /\ |p| <= 1b-53 /\
  |r| <= 2b-53
  -> |rest - (r - (p - (d + (ddl - tl))))| <= BOUND }
