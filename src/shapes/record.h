/*
 * record.h - the arguments of a constructor
 *
 * Scenes and geometries of Embree keep these in place of shapes.
 */
#ifndef CYLINT_RECORD_H
#define CYLINT_RECORD_H

#include <string.h>

#include "shape_facts.h"

/*
 * What the members are, by the kind:
 *
 *                 p0     r0       p1      r1
 *   two points    p0     r0       p1      r1
 *   sphere        c      r        c       r
 *   acone         v      0        u       the tangent
 *   halfspace     p      0        n       0
 *   elliptic      c      1        h       k
 */
typedef struct cylint_record {
    double p0[3], r0, p1[3], r1;
} cylint_record;

/* A tag: a cylint_kind and, times CYLINT_TAG_ENDS, a cylint_ends. */
enum { CYLINT_TAG_KIND = 15, CYLINT_TAG_ENDS = 16 };

/* The semi-axes of an elliptic shape. */
typedef struct cylint_semi_axes {
    double a[3], b[3];
} cylint_semi_axes;

/* The kind whose constructor made the shape.  A round cone whose one ball holds the
 * other is a sphere, but RCONE made it. */
static inline int cylint_made_kind(const cylint_shape *s)
{
    return s->kind == CYLINT_KIND_SPHERE &&
                   cylint_surface(s) != CYLINT_PART_LATERAL
               ? CYLINT_KIND_RCONE
               : s->kind;
}

static inline void cylint_set_record(cylint_record *to, const cylint_shape *s)
{
    const int reversed = cylint_is_reversed(s);
    const double *base = cylint_base(s);
    const double *end =
        cylint_has_end_points(s->kind) ? cylint_top(s) : cylint_axis(s);
    memcpy(to->p0, reversed ? end : base, sizeof to->p0);
    memcpy(to->p1, reversed ? base : end, sizeof to->p1);
    to->r0 = cylint_end_factor(s, reversed);
    to->r1 = cylint_end_factor(s, !reversed);
}

static inline void cylint_set_semi_axes(cylint_semi_axes *to,
                                        const cylint_shape *s)
{
    memcpy(to->a, cylint_a(s), sizeof to->a);
    memcpy(to->b, cylint_b(s), sizeof to->b);
}

#endif
