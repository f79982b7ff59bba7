/*
 * roots.h - roots in the domain, correctly rounded; roots as surds; point,
 * normal, z and angle of a hit
 */
#ifndef CYLINT_ROOTS_H
#define CYLINT_ROOTS_H

#include "../signs/sign.h"
#include "floating.h"

/* Places on the line where something begins or ends. */
typedef enum {
    ROOT_ENTRY,  /* of the lateral quadric, Q falling */
    ROOT_EXIT,   /* ... rising */
    ROOT_DOUBLE, /* both at once: G = 0 */
    ROOT_APEX,   /* rho = 0 */
    ROOT_CAP0,   /* the planes */
    ROOT_CAP1
} cylint_root;

/* Moves the line's origin along the line by t, in the terms of one cap, and
 * keeps the old origin.  Returns whether the new one lies in the window of
 * error_bounds.h. */
int cylint_move_origin(cylint_terms_pair *L, int cap, bounded_pair t,
                       bounded_pair kept[3]);
void cylint_restore_origin(cylint_terms_pair *L, int cap,
                           const bounded_pair kept[3]);

/* Whether tmin <= root <= tmax, exactly.  If t is wanted, *t becomes the
 * double nearest to such a root, and *more approximates root - *t. */
int cylint_root_within(cylint_query *q, cylint_root root, int wanted, double *t,
                       double *more);

/*
 * The canonical pair of a root: t, the double nearest to it, and its rest, the
 * nearest multiple of 2^-CYLINT_REST_BITS units in the last place of t.  Both
 * are functions of the root alone.  The caller has |root - (t + more)| <= error.
 * CYLINT_REST_LEAST < |t| < CYLINT_REST_MOST, or
 * t = 0; the data are not scaled, and rounding is to nearest.
 */
bounded_pair cylint_canonical_root(cylint_query *q, cylint_root root, double t,
                                   double more, double error);

/* Refines a canonical pair to nearly all digits of a pair; this too is a function
 * of the root alone.  Returns 0 for t = 0. */
int cylint_polish_root(cylint_query *q, cylint_root root, bounded_pair *t);

/* A root with exact coefficients: t = (-B + s R) / A with R^2 = B^2 - A C, or
 * the limit of that for A = 0. */
typedef struct {
    exact A, B, C;
    int s;      /* 1 at the exit, -1 at the entry, else 0 */
    floating R; /* 0: not found yet */
} surd;

/* Computes all numbers of the root that must stay in the arena.  The caller can
 * free later ones by setting arena.used to the result.  Until then no sign that
 * needs the moment about the top may be computed for the first time. */
int cylint_exact_mark(cylint_query *q, cylint_root root);

surd cylint_surd(cylint_query *q, cylint_root root);

/* f0 + f1 t: its sign, exactly; its value to CYLINT_SURD_ERROR, relative. */
int cylint_sign_at(cylint_query *q, const surd *t, exact f0, exact f1);
floating cylint_value_at(cylint_query *q, surd *t, exact f0, exact f1);

/* The wanted members of a hit but t, part and side.  t is the double nearest
 * to the root, t + more the root, but for `error` at most: neither changes a
 * bit of the answer.  apex: whether the hit is the apex of a cone. */
void cylint_describe_hit(cylint_query *q, cylint_root root, double t,
                         double more, double error, int part, int apex,
                         unsigned want, cylint_hit *hit);

#endif
