/*
 * oracle.h - the exact answer, by whole numbers alone
 *
 * It shares no formula with the library: every input is a whole number times
 * a power of two, so the line's quadratic, the planes of the ends and all
 * their comparisons are worked out in whole numbers (GMP) and in the field
 * of the discriminant's square root.  Only points, normals, z and phi pass
 * through MPFR, at 400 bits, for their last rounding.
 */
#ifndef CYLINT_ORACLE_H
#define CYLINT_ORACLE_H

#include "cylint.h"

/* What cylint_intersect must answer.  relation, n and of each hit t, part
 * and side are always written, the rest as far as `want` names it; NEAREST
 * keeps the first hit only.  -0 and 0 are not told apart.  Of point, normal, z
 * and phi what is not 0 is not given as 0, but as 2^-1074 or more in size. */
void oracle_intersect(const cylint_shape *shape, const cylint_line *line,
                      unsigned want, cylint_answer *expected);

/* What cylint_contains must answer. */
int oracle_contains(const cylint_shape *shape, const double point[3]);

/* The sign of x[0] + ... + x[n-1], exactly. */
int oracle_sum_sign(const double *x, int n);

#endif
