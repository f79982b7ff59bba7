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
    double near;   /* 2^-far, but at least 2^-MOST_FAR */
    triple moved;  /* this times g was subtracted from Q */
    double length; /* of Q's largest component before that */
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

enum { MOST_RATIO = 400, MOST_FAR = 900 };

static int larger(int x, int y)
{
    return x > y ? x : y;
}

static int exponent_of(const double v[3])
{
    return larger(larger(exponent_or_none(v[0]), exponent_or_none(v[1])),
                  exponent_or_none(v[2]));
}

static void load_scaled(triple to[3], const double v[3], int e)
{
    for (int i = 0; i < 3; i++)
        to[i] = triple_of(cylint_scaled(v[i], -e));
}

/* The exponent of the longest of a, b, h, k a and k b. */
static int exponent_of_shape(const cylint_shape *shape)
{
    const int section =
        larger(exponent_of(cylint_a(shape)), exponent_of(cylint_b(shape)));
    const double k = cylint_larger(1, cylint_r1(shape));
    return larger(section + cylint_exponent(k),
                  exponent_of(cylint_axis(shape)));
}

/* Moves an unbounded cylinder along its axis. */
static void move_along(elliptic_terms *p)
{
    for (int digits = 0; digits < 3; digits++) {
        const double z = triple_value(triple_dot_doubles(p->Q, p->g)) / p->gg.a;
        p->moved = triple_add(p->moved, triple_of(z));
        for (int i = 0; i < 3; i++)
            p->Q[i] =
                triple_sub(p->Q[i], triple_times(triple_of(z), p->g[i].a));
    }
}

static void load_point(elliptic_terms *p)
{
    const double *x = p->point, *base = cylint_base(p->shape);
    /* a difference of large numbers can overflow */
    const int unit =
        cylint_larger(cylint_largest(x), cylint_largest(base)) > 0x1p1000;
    triple D[3]; /* the difference over 2^unit */
    int most = NO_EXPONENT;
    for (int i = 0; i < 3; i++) {
        D[i] = triple_of_pair(cylint_difference(cylint_scaled(x[i], -unit),
                                                cylint_scaled(base[i], -unit)));
        most = larger(most, exponent_or_none(D[i].a) + unit);
    }
    p->far = larger(0, most - p->e - MOST_RATIO);
    p->near = cylint_power_of_two(larger(-MOST_FAR, -p->far));
    for (int i = 0; i < 3; i++)
        p->Q[i] = triple_scaled(D[i], unit - p->e - p->far);
    p->moved = triple_of(0);
    p->length = triple_largest(p->Q);
    if (!cylint_is_bounded(p->shape) && p->k1.a == 0)
        move_along(p);
}

static void load_elliptic(elliptic_terms *p, const cylint_shape *shape,
                          const double point[3])
{
    p->shape = shape;
    p->point = point;
    p->e = exponent_of_shape(shape);
    load_scaled(p->a, cylint_a(shape), p->e);
    load_scaled(p->b, cylint_b(shape), p->e);
    load_scaled(p->h, cylint_axis(shape), p->e);
    const triple k1 = triple_add(triple_of(cylint_r1(shape)), triple_of(-1));
    const double section =
        cylint_larger(triple_largest(p->a), triple_largest(p->b));
    p->stretch =
        normalizer(cylint_larger(triple_largest(p->h), fabs(k1.a) * section));
    p->k1 = triple_scale(k1, p->stretch);
    for (int i = 0; i < 3; i++)
        p->g[i] = triple_scale(p->h[i], p->stretch);
    p->gg = triple_dot_doubles(p->g, p->g);
    load_point(p);
    p->aa = triple_dot_doubles(p->a, p->a);
    p->ab = triple_dot_doubles(p->a, p->b);
    p->bb = triple_dot_doubles(p->b, p->b);
    p->ag = triple_dot_doubles(p->a, p->g);
    p->bg = triple_dot_doubles(p->b, p->g);
    p->Qa = triple_dot_doubles(p->Q, p->a);
    p->Qb = triple_dot_doubles(p->Q, p->b);
    p->Qg = triple_dot_doubles(p->Q, p->g);
}

/* Q minus the centre of an end, in the unit of Q. */
static void from_end(const elliptic_terms *p, int end, triple to[3])
{
    for (int i = 0; i < 3; i++)
        to[i] =
            end ? triple_sub(p->Q[i], triple_scale(p->h[i], p->near)) : p->Q[i];
}

/* The sum of the sizes of the terms of u.v. */
static double dot_sizes(const triple u[3], const triple v[3])
{
    return fabs(u[0].a * v[0].a) + fabs(u[1].a * v[1].a) +
           fabs(u[2].a * v[2].a);
}

/* The same of the coefficients of squares where square[2] is -square[0]: of
 * cylinders and rims. */
static double square_sizes(const stationary *f)
{
    return fabs(f->square[0].a) + fabs(f->square[1].a);
}

/* The angles at which the distance from a ruling is stationary:
 * E.u' v.v - E.v v.u', E = Q - near u, without the terms that cancel.  */
static void lateral_form(const elliptic_terms *p, stationary *f)
{
    const triple ag = triple_scale(p->ag, p->near),
                 bg = triple_scale(p->bg, p->near);
    const triple x =
        triple_mul(p->k1, triple_add(triple_mul(p->k1, p->Qa), ag));
    const triple y =
        triple_mul(p->k1, triple_add(triple_mul(p->k1, p->Qb), bg));
    const triple k =
        triple_add(triple_scale(p->gg, p->near), triple_mul(p->k1, p->Qg));
    const triple ab = triple_mul(p->Qa, p->bg), ba = triple_mul(p->Qb, p->ag);
    const triple turned = triple_det(ag, p->bg, k, p->ab);
    f->linear[0] = triple_add(triple_det(p->aa, y, p->ab, x),
                              triple_det(p->gg, p->Qb, p->Qg, p->bg));
    f->linear[1] = triple_sub(triple_det(p->ab, y, p->bb, x),
                              triple_det(p->gg, p->Qa, p->Qg, p->ag));
    f->square[0] = triple_add(
        triple_mul(p->k1, triple_sub(triple_scale(ba, 2), ab)), turned);
    f->square[2] = triple_sub(
        triple_mul(p->k1, triple_sub(ba, triple_scale(ab, 2))), turned);
    f->square[1] = triple_sub(
        triple_add(triple_mul(p->k1, triple_det(p->Qb, p->bg, p->Qa, p->ag)),
                   triple_det(bg, p->bg, ag, p->ag)),
        triple_mul(k, triple_sub(p->bb, p->aa)));
    f->terms = p->gg.a * (dot_sizes(p->Q, p->a) + dot_sizes(p->Q, p->b)) +
               dot_sizes(p->Q, p->g) *
                   (dot_sizes(p->a, p->g) + dot_sizes(p->b, p->g)) +
               square_sizes(f);
}

/* The same of a rim with the centre f and the factor e: E.u' for
 * E = Q - near (f + e u). */
static void rim_form(const elliptic_terms *p, int end, stationary *f)
{
    const double factor = cylint_end_factor(p->shape, end);
    const triple e = triple_scale(triple_of(factor), p->near);
    triple from[3];
    from_end(p, end, from);
    const triple ab = triple_mul(e, p->ab);
    f->linear[0] = triple_dot(from, p->b);
    f->linear[1] = triple_neg(triple_dot(from, p->a));
    f->square[0] = triple_neg(ab);
    f->square[1] = triple_mul(e, triple_sub(p->aa, p->bb));
    f->square[2] = ab;
    f->terms = dot_sizes(from, p->a) + dot_sizes(from, p->b) + square_sizes(f);
}

#endif
