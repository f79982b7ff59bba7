# filter/surfaces.h: the distance of t from a root of
# Q = A t^2 + 2 B t + C, in multiples of |Q(t)| / (2 s).  s is the computed root
# of G.  The true G is g s^2, and A t + B is s a, both up to one sign, that of
# the intended root.  With r the root, Q(t) = (t - r) s (sqrt(g) + a).
# estimate_end(): G is known to one quarter, and so is A t + B.  A second step:
# |A| |t - r| is at most 1/16 s, so that a exceeds sqrt(g) - 1/16.  From an origin
# beside the hit (describe.h): with the slope s h there, s computed, the residual is
# (t - r) s (h + c).
# modes: ne
# bound: CYLINT_LOCAL_DISTANCE
{ g in [0.75, 1.25] /\ a in [0.75, 1.25] /\ b in [-0.0625, 0.0625] /\
  h in [0.9375, 1.0625] /\ c in [-0.125, 0.125]
  -> 2 / ((sqrt(g) + a) * SHRINK(6)) <= BOUND /\
     2 / ((sqrt(g) + (sqrt(g) + b)) * SHRINK(6)) <= BOUND /\
     1 / ((h + c) * SHRINK(6)) <= BOUND }
