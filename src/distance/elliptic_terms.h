/*
 * elliptic_terms.h - a point and an elliptic shape in scaled triples
 *
 * Q is the point minus the base c, k1 = k - 1, u = a cos + b sin, u' = b cos -
 * a sin.  The ruling of an angle is c + u + z v, v = h + k1 u.
 *
 * The lengths of the shape are divided by 2^e, about the longest of a, b, h, k
 * a and k b.  Those of the question, Q, z v and the residual, are divided by
 * 2^(e + far), so that they are at most 2^MOST_RATIO and their squares do not
 * overflow.  `near` is the shape's unit in that of the question.  v is
 * multiplied by `stretch`, a power of two, so that its length is about 1, and z
 * is divided by it.
 *
 * An unbounded cylinder is moved along its axis, so that Q is nearly
 * perpendicular to it: far along the axis the digits of Q that count are below
 * the last place of a triple.
 */
#ifndef CYLINT_ELLIPTIC_TERMS_H
#define CYLINT_ELLIPTIC_TERMS_H

#include "../shapes/shape_facts.h"
#include "critical.h"

typedef struct {
    const cylint_shape *shape;
    const double *point;
    int e, far;
    double near;  /* 2^-far, but at least 2^-MOST_FAR */
    triple moved; /* times g, taken from Q; in the unit 2^(e + whole) */
    int whole;
    double length; /* of Q's largest component before that, in that unit */
    triple Q[3], a[3], b[3], h[3];
    double stretch;
    triple g[3], k1; /* h and k - 1 times stretch */
    triple aa, ab, bb, ag, bg, gg, Qa, Qb, Qg;
} elliptic_terms;

/* The binary exponent of x, or NO_EXPONENT for 0. */
enum { NO_EXPONENT = -4000 };
static inline int exponent_or_none(double x)
{
    return cylint_sign(x) == 0 ? NO_EXPONENT : cylint_any_exponent(x);
}

void cylint_load_elliptic(elliptic_terms *p, const cylint_shape *shape,
                          const double point[3]);

/* Q minus the centre of an end, in the unit of Q. */
void cylint_from_end(const elliptic_terms *p, int end, triple to[3]);

/* The angles at which the distance from a ruling, and from a rim of the given
 * factor, is stationary.  from: cylint_from_end(). */
void cylint_lateral_form(const elliptic_terms *p, stationary *f);
void cylint_rim_form(const elliptic_terms *p, const triple from[3],
                     double factor, stationary *f);

/* u and v of a ruling. */
void cylint_load_ruling(const elliptic_terms *p, const direction *at,
                        triple u[3], triple v[3]);

/* (Q - near u).v, where terms that are exactly 0 stay 0. */
triple cylint_along_ruling(const elliptic_terms *p, const direction *at);

#endif
