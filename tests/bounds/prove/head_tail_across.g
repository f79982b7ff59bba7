# head_tail.h, head_tail_minus_square(): the tail of a - x^2, relative to S^2 = 1: x^2 - h^2 =
# l (x + h), x = h + l.  First a = D.D and x = z, whose tails are at most what
# head_tail_square.g and head_tail_z.g add up; capital letters: then x is the root's double,
# which is split.
# modes: ne
# bound: CYLINT_HEAD_TAIL_ACROSS
@rn = float<ieee_64, MODE>;
x rn= h + l;
low rn= a - l * (x + h);
Low = a - l * ((h + l) + h);
X rn= H + L;
rest rn= A - L * (X + H);
Rest = A - L * ((H + L) + H);
{ |h| <= 1 /\ |l| <= 9b-26 /\ |a| <= 7b-26 /\
  |H| <= 1 /\ |L| <= 1b-26 /\ |A| <= 26b-26
  -> |low - Low| <= BOUND /\ |rest - Rest| <= BOUND }
