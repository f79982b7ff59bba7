/*
 * float_filter.h - hits of float rays, computed in doubles with error bounds
 *
 * For circular and round shapes with two ends, most questions by far.  A result
 * is what cylint_intersect() returns, as far as floats show it, or UNCERTAIN.
 */
#ifndef CYLINT_EMBREE_FLOAT_FILTER_H
#define CYLINT_EMBREE_FLOAT_FILTER_H

#include "cylint.h"

/* A ray whose o, d and near are floats; not checked yet.  near: a t near the
 * shape, or not finite if none is known. */
typedef struct cylint_float_filter_ray {
    double o[3], d[3], tmin, near, tmax;
} cylint_float_filter_ray;

/* A circular shape, in one cache line.  Round kinds have both radii negated, and
 * a sphere no axis.  Of other shapes the sum of the radii is 0, and every result
 * for them is UNCERTAIN. */
typedef struct cylint_float_filter_shape {
    double base[3], axis[3], r0, dr;
} cylint_float_filter_shape;

void cylint_float_filter_shape_of(cylint_float_filter_shape *to,
                                  const cylint_shape *shape);

/* The same in half the memory, if base, top and radii are floats and none of
 * them is subnormal. */
typedef struct cylint_float_filter_small {
    float base[3], r0, top[3], r1;
} cylint_float_filter_small;

/* Returns 0 if the shape does not fit. */
int cylint_float_filter_small_of(cylint_float_filter_small *to,
                                 const cylint_shape *shape);

/* An array of shapes, either small or not. */
typedef struct cylint_float_filter_shapes {
    const void *data;
    int small;
} cylint_float_filter_shapes;

static inline const void *cylint_float_filter_at(
    const cylint_float_filter_shapes *s, unsigned number)
{
    return s->small
               ? (const void *)((const cylint_float_filter_small *)s->data +
                                number)
               : (const cylint_float_filter_shape *)s->data + number;
}

/* The shape to test, and its ends.  `whole` is the same shape, read only if the
 * doubles of the axis do not decide which of its components is least. */
typedef struct cylint_float_filter_target {
    const void
        *shape; /* cylint_float_filter_small, if it is small, else _shape */
    int small;
    const cylint_shape *whole;
    int ends;
} cylint_float_filter_target;

/* Whether the record is that of a round kind. */
static inline int cylint_float_filter_is_round(
    const cylint_float_filter_target *t)
{
    const cylint_float_filter_shape *large = t->shape;
    const cylint_float_filter_small *small = t->shape;
    return t->small ? small->r0 + small->r1 < 0
                    : large->r0 + (large->r0 + large->dr) < 0;
}

typedef enum {
    CYLINT_FLOAT_FILTER_UNCERTAIN = -1, /* cylint_intersect() must decide */
    CYLINT_FLOAT_FILTER_MISS,
    CYLINT_FLOAT_FILTER_HIT
} cylint_float_filter_result;

/*
 * The state of a question, in numbers R and truth values M: the axis w, its
 * length W and the radii; t = from + s, where the line is D + s u from the base;
 * alpha = D.w, beta = u.w, n = u x w, m = D x w; s[], the roots of the lateral
 * surface's Q if the line crosses it, a, the coefficient of s^2 in Q, root^2, a
 * quarter of the discriminant; sizes U of u and Dn of D; which caps are present;
 * endless[i]: the chord has no end at s[i].
 */
#define CYLINT_FLOAT_FILTER_MEMBERS(R, M)                               \
    R w[3], W, ww, per_ww, r0, dr, from, tmin, alpha, beta, n[3], m[3]; \
    R s[2], a, root, per_root, U, Dn;                                   \
    M cap[2], crosses, endless[2];

/* A hit at t and z, with error bounds.  s = t - from, c = P x w at the hit, k is
 * the radius there.  capped: the hit is on a cap; top: on the top one. */
#define CYLINT_FLOAT_FILTER_HIT_MEMBERS(R, M)                \
    R t, t_error, z, z_error, s, s_error, c[3], e_c, k, e_k; \
    M capped, top;

/* A vector N with errors e[].  Its length is 1 / per_length, with a relative
 * error of e_length. */
#define CYLINT_BOUNDED_VECTOR_MEMBERS(R) R N[3], e[3], per_length, e_length;

typedef struct cylint_bounded_vector {
    CYLINT_BOUNDED_VECTOR_MEMBERS(double)
} cylint_bounded_vector;

/* round: 0 for shapes with discs as ends, 1 for capsules and rounded cones, 2 for
 * spheres.  Only round kinds have `normal`. */
typedef struct cylint_float_filter_hit {
    CYLINT_FLOAT_FILTER_HIT_MEMBERS(double, int)
    int round;
    cylint_bounded_vector normal;
} cylint_float_filter_hit;

/* exit: of a round kind, what test_exit returns, and the hit. */
typedef struct cylint_float_filter_state {
    CYLINT_FLOAT_FILTER_MEMBERS(double, int)
    const cylint_shape *whole;
    int round, exit;
    cylint_float_filter_hit exit_hit;
} cylint_float_filter_state;

/* The floats of a hit, equal to the library's doubles rounded to floats. */
typedef struct cylint_hit_floats {
    float z, phi, normal[3];
} cylint_hit_floats;

/* What a question about a piece of a shape depends on beside the line: the
 * piece, and the ray's tfar.  describes: the hit's floats are wanted. */
typedef struct cylint_float_filter_limits {
    float tfar;
    int index, count, describes;
} cylint_float_filter_limits;

/* A hit: t rounded up to a float, whether the line leaves the shape there, and
 * its floats if wanted. */
typedef struct cylint_float_filter_nearest {
    float t;
    int leaves;
    cylint_hit_floats floats;
} cylint_float_filter_nearest;

/*
 * nearest     HIT: the first hit on the piece at t >= tmin, t as a float being
 *             less than tfar; MISS: there is none; UNCERTAIN: test_entry and
 *             test_exit decide;
 * test_entry  whether the line hits the shape where it enters it: on a part
 *             that is present, at t >= tmin;
 * test_exit   the same where it leaves the shape; not to be called after
 *             test_entry returned UNCERTAIN;
 * describe    writes the floats of a hit; returns 0 if they are uncertain.
 */
typedef struct cylint_float_filter {
    cylint_float_filter_result (*nearest)(
        const cylint_float_filter_target *target,
        const cylint_float_filter_ray *line,
        const cylint_float_filter_limits *limits,
        cylint_float_filter_nearest *to);
    cylint_float_filter_result (*test_entry)(
        cylint_float_filter_state *q, const cylint_float_filter_target *target,
        const cylint_float_filter_ray *line, cylint_float_filter_hit *hit);
    cylint_float_filter_result (*test_exit)(const cylint_float_filter_state *q,
                                            cylint_float_filter_hit *hit);
    int (*describe)(const cylint_float_filter_state *q,
                    const cylint_float_filter_hit *hit,
                    cylint_hit_floats *floats);
} cylint_float_filter;

/* The build for this processor. */
const cylint_float_filter *cylint_float_filter_used(void);

/* All builds. */
extern const cylint_float_filter cylint_float_filter_plain,
    cylint_float_filter_fma;

#endif
