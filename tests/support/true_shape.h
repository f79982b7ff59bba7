/*
 * true_shape.h - the local coordinates of a shape (shapes/local.h) by real.h, for
 * tests of the library's errors
 */
#ifndef CYLINT_TRUE_SHAPE_H
#define CYLINT_TRUE_SHAPE_H

#include "real.h"
#include "shapes/shape_facts.h"

typedef struct {
    vector row[3];
    real height, slope, sine, cosine;
} true_shape;

/* Unit vectors, two across the axis; of an acone divided by |axis|. */
static void set_upright_rows(true_shape *to, const cylint_shape *s, vector axis)
{
    to->height = norm(axis);
    perpendicular(to->row[0], axis);
    divide(to->row[0], to->row[0], negated(norm(to->row[0])));
    divide(to->row[2], axis, to->height);
    cross(to->row[1], to->row[2], to->row[0]);
    if (cylint_has_tangent(s->kind)) {
        for (int i = 0; i < 3; i++)
            divide(to->row[i], to->row[i], to->height);
        to->height = real_of(1);
    }
}

/* The inverse of (a b h), the row of z times the height, a power of two. */
static void set_inverse_rows(true_shape *to, const cylint_shape *s, vector axis)
{
    vector a, b;
    set(a, cylint_a(s));
    set(b, cylint_b(s));
    cross(to->row[0], b, axis);
    cross(to->row[1], axis, a);
    cross(to->row[2], a, b);
    const real det = dot(a, to->row[0]);
    for (int i = 0; i < 3; i++)
        divide(to->row[i], to->row[i], det);
    to->height = real_of(cylint_height(s));
    scale(to->row[2], to->height, to->row[2]);
}

/* Of a round cone the sine is (r1 - r0) / height, of others the slope is. */
static void set_angle(true_shape *to, const cylint_shape *s)
{
    const real one = real_of(1);
    real growth = real_of(0);
    if (cylint_is_tapered(s->kind))
        growth = over(minus(real_of(cylint_r1(s)), real_of(cylint_r0(s))),
                      to->height);
    if (s->kind == CYLINT_KIND_RCONE) {
        to->sine = growth;
        to->cosine = root_of(minus(one, square_of(growth)));
        to->slope = over(growth, to->cosine);
    } else {
        to->slope = growth;
        to->cosine = over(one, root_of(plus(one, square_of(growth))));
        to->sine = times(growth, to->cosine);
    }
}

/* A sphere has the matrix 1 and no height. */
static inline void set_true_shape(true_shape *to, const cylint_shape *s)
{
    vector axis;
    if (cylint_has_end_points(s->kind))
        set_difference(axis, cylint_top(s), cylint_base(s));
    else
        set(axis, cylint_axis(s));
    if (s->kind == CYLINT_KIND_SPHERE) {
        for (int i = 0; i < 9; i++)
            to->row[i / 3][i % 3] = real_of(i % 4 == 0);
        to->height = real_of(0);
    } else if (cylint_is_elliptic(s->kind)) {
        set_inverse_rows(to, s, axis);
    } else {
        set_upright_rows(to, s, axis);
    }
    set_angle(to, s);
}

/* |x - (hi + lo)| */
static inline double off_by(real x, double hi, double lo)
{
    return fabs(
        mpfr_get_d(minus(minus(x, real_of(hi)), real_of(lo))->x, MPFR_RNDA));
}

#endif
