/*
 * oracle.h - the oracle: exact answers by real numbers with bounds (real.h)
 *
 * It shares no formula with the library.  Signs and comparisons are exact, and so
 * is the choice of the nearest double of each t, coordinate and z.  Normals and
 * phi are rounded from at least 120 bits.
 */
#ifndef CYLINT_ORACLE_H
#define CYLINT_ORACLE_H

#include "cylint.h"
#include "real.h"

/* Writes the answer that cylint_intersect() must give.  relation, n, and t,
 * part and side of each hit are always written, other members if `want` is
 * CYLINT_WANT_ALL.  t, each component of point and normal, z and phi are the
 * nearest doubles: ties to even, 0 is never -0, a phi that would round to 1 is the
 * double below 1. */
void oracle_intersect(const cylint_shape *shape, const cylint_line *line,
                      unsigned want, cylint_answer *expected);

/* normal and phi of hit i of the last answer that had all members.  Where the real
 * number is nearer than 2^-90 of itself to the middle of two doubles, they hold the
 * double that the answer does not hold: both are right. */
const cylint_hit *oracle_other(int i);

/* The members of a hit, not rounded.  A sphere has no z and no phi. */
typedef struct {
    real t, z, phi;
    vector point, normal;
} oracle_hit;

/* Those of hit i of the last answer that had all members.  They last until the next
 * answer. */
const oracle_hit *oracle_real_hit(int i);

/* The answer that cylint_contains() must give. */
int oracle_contains(const cylint_shape *shape, const double point[3]);

/* Of an elliptic kind: whether the last point that oracle_contains() was given
 * is on the lateral surface, beyond its ends or not; in the apex's plane; in the
 * planes of base and top. */
struct oracle_place {
    int lateral, apex, base, top;
};

struct oracle_place oracle_place(void);

/* The range of the exponents of a shape's numbers and a point. */
static inline long range_of_question(const cylint_shape *shape,
                                     const double point[3])
{
    double x[CYLINT_ARGUMENTS_MOST] = {0};
    exponents all = no_exponents;
    cylint_arguments(shape, x);
    widen(&all, x, CYLINT_ARGUMENTS_MOST);
    widen(&all, point, 3);
    return range_of(all);
}

/* Whether the shape has the cap at this end. */
static inline int has_cap(const cylint_shape *shape, int end)
{
    return shape->ends == CYLINT_ENDS_CAPPED ||
           shape->ends == (end ? CYLINT_ENDS_CAP1 : CYLINT_ENDS_CAP0);
}

#endif
