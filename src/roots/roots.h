/*
 * roots.h - roots in the domain, correctly rounded; the overlap from exact signs;
 * roots as surds; point, normal, z and angle of a hit
 */
#ifndef CYLINT_ROOTS_H
#define CYLINT_ROOTS_H

#include "../signs/sign.h"

/* Places on the line where something begins or ends. */
typedef enum {
    ROOT_ENTRY,  /* of the lateral quadric, Q falling */
    ROOT_EXIT,   /* ... rising */
    ROOT_DOUBLE, /* both at once: G = 0 */
    ROOT_APEX,   /* rho = 0 */
    ROOT_CAP0,   /* the planes */
    ROOT_CAP1
} cylint_root;

/* Whether tmin <= root <= tmax, exactly.  If t is wanted, *t becomes the
 * double nearest to such a root. */
int cylint_root_within(cylint_query *q, cylint_root root, int wanted,
                       double *t);

/* ------------------------------------------------------ the overlap ---- */

/* An end of the overlap.  apex: it is the apex of a cone. */
typedef struct {
    cylint_root root;
    int part, side, apex;
} cylint_stop;

/* The relation, and the ends that the overlap has, ascending. */
typedef struct {
    int relation, n;
    cylint_stop at[2];
} cylint_overlap;

cylint_overlap cylint_overlap_of(cylint_query *q);

/* Where the origin of the line lies: 1 inside a round kind, 0 on its boundary, -1
 * outside. */
int cylint_round_contains(cylint_query *q);

/* ------------------------------------------------- leading digits ------ */

/* The highest limbs of x: x (1 - e), 0 <= e < 2^-128.  The last limb
 * that stays can be 0. */
exact cylint_leading(exact x);

/* Leading digits, in every floating-point environment with relative errors below
 * CYLINT_INVERSE_ERROR: 1 / sqrt(x) and sqrt(x) for x > 0, 1 / x for x other
 * than 0. */
exact cylint_inverse_root(cylint_arena *arena, exact x);
exact cylint_square_root(cylint_arena *arena, exact x);
exact cylint_inverse(cylint_arena *arena, exact x);

/* The angle of (x, y), not both 0, in turns, counted from the x axis towards the y
 * axis, in [0, 1], with an error below CYLINT_ANGLE_ERROR, relative (turns.h). */
exact cylint_angle(cylint_arena *arena, exact x, exact y);

/* A root with exact coefficients: t = (-B + s R) / A with R^2 = B^2 - A C, or
 * the limit of that for A = 0. */
typedef struct {
    exact A, B, C;
    int s;    /* 1 at the exit, -1 at the entry, else 0 */
    exact R;  /* leading digits, 0 where s is */
    int mark; /* arena.used before numbers of this root alone */
} surd;

/* The caller frees the numbers of the root by setting arena.used to its mark.
 * Until then no sign that needs the moment about the top may be computed for the
 * first time. */
surd cylint_surd(cylint_query *q, cylint_root root);

/* sqrt(x / y), x >= 0 and y > 0. */
surd cylint_root_of_quotient(cylint_query *q, exact x, exact y);

/* What cylint_nearest_at() rounds. */
typedef enum {
    ROUNDED_QUOTIENT, /* (f0 + f1 t) / unit */
    ROUNDED_ROOT,     /* sqrt((f0 + f1 t) / unit) */
    ROUNDED_COSINE    /* (f0 + f1 t) / sqrt(unit) */
} cylint_rounded;

/* f0 + f1 t: its sign, exactly; leading digits of its value, with an error below
 * CYLINT_VALUE_ERROR, relative; and the double nearest to a number made of it: ties
 * to even, infinite on overflow, never -0. */
int cylint_sign_at(cylint_query *q, const surd *t, exact f0, exact f1);
exact cylint_value_at(cylint_query *q, const surd *t, exact f0, exact f1);
double cylint_nearest_at(cylint_query *q, cylint_rounded of, const surd *t,
                         exact f0, exact f1, exact unit);

/* Writes the wanted members of a hit but t, part and side, from the line, the
 * shape and the root only: each component is the nearest double, in every
 * floating-point environment.  Of normal and phi the real number can be nearer
 * than CYLINT_VALUE_ERROR or CYLINT_ANGLE_ERROR to the middle of two doubles: then
 * it is one of these. */
void cylint_describe_hit(cylint_query *q, const cylint_stop *at, unsigned want,
                         cylint_hit *hit);

#endif
