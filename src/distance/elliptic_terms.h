/*
 * elliptic_terms.h - a point and an elliptic shape in scaled triples
 *
 * Q is the point minus the base c, k1 = k - 1, u = a cos + b sin, u' = b cos -
 * a sin.  The ruling of an angle is c + u + z v, v = h + k1 u.
 *
 * Lengths are divided by the power of two of the longest of a, b, h, k a and
 * k b.  If Q is longer than 2^MOST_RATIO of them, it is shortened to that: the
 * nearest point of a bounded shape depends on its direction only, and of an
 * unbounded one it is proportional to it.  v is multiplied by `stretch`, a power
 * of two, so that its length is about 1, and z is divided by it.
 */
#ifndef CYLINT_ELLIPTIC_TERMS_H
#define CYLINT_ELLIPTIC_TERMS_H

#include "../shapes/shape_facts.h"
#include "critical.h"

typedef struct {
    const cylint_shape *shape;
    const double *point;
    int e;   /* the lengths of the shape are divided by 2^e */
    int far; /* the length of Q by 2^far more */
    triple Q[3], a[3], b[3], h[3];
    double stretch;
    triple g[3], k1; /* h and k - 1 times stretch */
    triple aa, ab, bb, ag, bg, gg, Qa, Qb, Qg;
} elliptic_terms;

void cylint_load_elliptic(elliptic_terms *p, const cylint_shape *shape,
                          const double point[3]);

/* Q minus the centre of an end. */
void cylint_from_end(const elliptic_terms *p, int end, triple to[3]);

/* The angles at which the distance from a ruling, and from a rim of the given
 * factor, is stationary.  from: cylint_from_end(). */
void cylint_lateral_form(const elliptic_terms *p, stationary *f);
void cylint_rim_form(const elliptic_terms *p, const triple from[3],
                     triple factor, stationary *f);

/* u and v of a ruling. */
void cylint_load_ruling(const elliptic_terms *p, const direction *at,
                        triple u[3], triple v[3]);

/* (Q - u).v, where terms that are exactly 0 stay 0. */
triple cylint_along_ruling(const elliptic_terms *p, const direction *at);

#endif
