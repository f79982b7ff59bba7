/*
 * oracle.h - the oracle: exact answers by integer arithmetic
 *
 * It shares no formula with the library.  Every input is an integer times a
 * power of two.  The line's quadratic, the planes of the ends and all
 * comparisons are computed with integers (GMP) and in the field of the
 * discriminant's square root.  MPFR at 400 bits only rounds points, normals, z
 * and phi.
 */
#ifndef CYLINT_ORACLE_H
#define CYLINT_ORACLE_H

#include "cylint.h"

/* Writes the answer that cylint_intersect() must give.  relation, n, and t,
 * part and side of each hit are always written, other members if `want` names
 * them; NEAREST keeps the first hit only.  Zeros have no sign.  A component of
 * point, normal, z or phi that is not exactly 0 is at least 2^-1074 in size. */
void oracle_intersect(const cylint_shape *shape, const cylint_line *line,
                      unsigned want, cylint_answer *expected);

/* The answer that cylint_contains() must give. */
int oracle_contains(const cylint_shape *shape, const double point[3]);

/* Of an elliptic kind: whether the last point that oracle_contains() was given
 * is on the lateral surface, beyond its ends or not; in the apex's plane; in the
 * planes of base and top. */
struct oracle_place {
    int lateral, apex, base, top;
};

struct oracle_place oracle_place(void);

/* The sign of x[0] + ... + x[n-1], exactly. */
int oracle_sum_sign(const double *x, int n);

#endif
