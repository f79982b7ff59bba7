/*
 * float_filter.h - a hit in doubles, where doubles are certain of it
 *
 * For circular shapes with two ends, the great majority of questions: what
 * cylint_intersect() would say, as far as floats show it, or that it has to
 * be asked.
 */
#ifndef CYLINT_EMBREE_FLOAT_FILTER_H
#define CYLINT_EMBREE_FLOAT_FILTER_H

#include "cylint.h"

/* A line with its domain, as yet unchecked; o, d and near hold
 * floats.  near: some t near the shape, if that is known; else not finite. */
typedef struct cylint_float_filter_ray {
    double o[3], d[3], tmin, near, tmax;
} cylint_float_filter_ray;

/* What is asked of a circular shape, on a cache line.  r0 of others is -1:
 * every question about them is UNSURE. */
typedef struct cylint_float_filter_shape {
    double base[3], axis[3], r0, dr;
} cylint_float_filter_shape;

void cylint_float_filter_shape_of(cylint_float_filter_shape *to,
                                  const cylint_shape *shape);

/* The same in half the room, where base, top and radii are floats, none of
 * them subnormal. */
typedef struct cylint_float_filter_small {
    float base[3], r0, top[3], r1;
} cylint_float_filter_small;

/* 0 where it is not so. */
int cylint_float_filter_small_of(cylint_float_filter_small *to,
                                 const cylint_shape *shape);

/* One or the other of shapes side by side. */
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

/* Whom to ask: the same shape twice, `whole` being read only where doubles of
 * the axis do not tell which of its components is least; and its ends. */
typedef struct cylint_float_filter_target {
    const void
        *shape; /* cylint_float_filter_small, if it is small, else _shape */
    int small;
    const cylint_shape *whole;
    int ends;
} cylint_float_filter_target;

typedef enum {
    CYLINT_FLOAT_FILTER_UNSURE = -1, /* ask cylint_intersect() */
    CYLINT_FLOAT_FILTER_MISS,
    CYLINT_FLOAT_FILTER_HIT
} cylint_float_filter_result;

/*
 * What is known of a question, in numbers R and truths M: the axis w, its
 * length and radii; t = from + s, where the line is D + s u from the base;
 * alpha = D.w, beta = u.w, n = u x w, m = D x w; s[], where it crosses the
 * lateral surface's Q, if it does, of which a is what s^2 is multiplied by and
 * root^2 a quarter of the discriminant; sizes U of u and Dn of D; which caps
 * there are; and whether the chord has no end where s[i] were.
 */
#define CYLINT_FLOAT_FILTER_MEMBERS(R, M)                               \
    R w[3], W, ww, per_ww, r0, dr, from, tmin, alpha, beta, n[3], m[3]; \
    R s[2], a, root, per_root, U, Dn;                                   \
    M cap[2], crosses, endless[2];

typedef struct cylint_float_filter_state {
    CYLINT_FLOAT_FILTER_MEMBERS(double, int)
    const cylint_shape *whole;
} cylint_float_filter_state;

/* A hit at t and z, within the errors; s: t from near the shape, c = P x w
 * there, k: the radius; on a cap, that of the top. */
#define CYLINT_FLOAT_FILTER_HIT_MEMBERS(R, M)                \
    R t, t_error, z, z_error, s, s_error, c[3], e_c, k, e_k; \
    M capped, top;

typedef struct cylint_float_filter_hit {
    CYLINT_FLOAT_FILTER_HIT_MEMBERS(double, int)
} cylint_float_filter_hit;

/* Whether shapes of these ends have a cap at the base (0) or the top (1). */
static inline int cylint_float_filter_has_cap(int ends, int top)
{
    return ends == CYLINT_ENDS_CAPPED ||
           ends == (top ? CYLINT_ENDS_CAP1 : CYLINT_ENDS_CAP0);
}

/* What floats show of a hit, rounded as the library's doubles would be. */
typedef struct cylint_hit_floats {
    float z, phi, normal[3];
} cylint_hit_floats;

/*
 * enter     whether the line hits the shape where it enters it: on a part
 *           that is present, at tmin or later;
 * leave     if it does not, or that is not the hit that is sought: whether it
 *           does where it leaves it.  Not to be asked after UNSURE;
 * describe  a hit; 0 where that is not certain.
 */
typedef struct cylint_float_filter {
    cylint_float_filter_result (*enter)(
        cylint_float_filter_state *q, const cylint_float_filter_target *subject,
        const cylint_float_filter_ray *line, cylint_float_filter_hit *hit);
    cylint_float_filter_result (*leave)(const cylint_float_filter_state *q,
                                        cylint_float_filter_hit *hit);
    int (*describe)(const cylint_float_filter_state *q,
                    const cylint_float_filter_hit *hit,
                    cylint_hit_floats *floats);
} cylint_float_filter;

/* That for this processor. */
const cylint_float_filter *cylint_float_filter_used(void);

/* The builds. */
extern const cylint_float_filter cylint_float_filter_plain,
    cylint_float_filter_fma;

#endif
