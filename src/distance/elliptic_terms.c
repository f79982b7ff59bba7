/*
 * elliptic_terms.c - a point and an elliptic shape in scaled triples
 */
#include "elliptic_terms.h"

enum { MOST_RATIO = 400, MOST_STRETCH = 900, NO_EXPONENT = -4000 };

static int larger(int x, int y)
{
    return x > y ? x : y;
}

/* The binary exponent of x; right if the processor reads subnormals as zero. */
static int exponent_of_component(double x)
{
    const int e = cylint_exponent(x);
    return !cylint_sign(x) ? NO_EXPONENT
           : e >= -1022    ? e
                           : cylint_exponent(cylint_scaled(x, 200)) - 200;
}

static int exponent_of(const double v[3])
{
    return larger(
        larger(exponent_of_component(v[0]), exponent_of_component(v[1])),
        exponent_of_component(v[2]));
}

static void load_scaled(triple to[3], const double v[3], int e)
{
    for (int i = 0; i < 3; i++)
        to[i] = triple_of(cylint_scaled(v[i], -e));
}

/* The exponent of the longest of a, b, h, k a and k b. */
static int exponent_of_shape(const cylint_shape *shape)
{
    const int section = larger(exponent_of(shape->a), exponent_of(shape->b));
    const int k =
        shape->r1 > 1 ? section + cylint_any_exponent(shape->r1) : section;
    return larger(k, exponent_of(shape->axis));
}

/* g and k1.  The largest component of v is then about 1. */
static void load_stretched(elliptic_terms *p)
{
    const triple k1 = triple_add(triple_of(p->shape->r1), triple_of(-1));
    const int section =
        larger(exponent_of(p->shape->a), exponent_of(p->shape->b)) - p->e;
    const int grown = exponent_of_component(k1.a) + section;
    const int e = larger(exponent_of(p->shape->axis) - p->e, grown);
    p->stretch = cylint_power_of_two(larger(-MOST_STRETCH, -e) < MOST_STRETCH
                                         ? larger(-MOST_STRETCH, -e)
                                         : MOST_STRETCH);
    p->k1 = triple_scale(k1, p->stretch);
    for (int i = 0; i < 3; i++)
        p->g[i] = triple_scale(p->h[i], p->stretch);
}

void cylint_load_elliptic(elliptic_terms *p, const cylint_shape *shape,
                          const double point[3])
{
    const int most = larger(exponent_of(point), exponent_of(shape->base));
    p->shape = shape;
    p->point = point;
    p->e = exponent_of_shape(shape);
    p->far = larger(0, most - p->e - MOST_RATIO);
    load_scaled(p->a, shape->a, p->e);
    load_scaled(p->b, shape->b, p->e);
    load_scaled(p->h, shape->axis, p->e);
    for (int i = 0; i < 3; i++) {
        const pair d = two_diff(cylint_scaled(point[i], -p->e - p->far),
                                cylint_scaled(shape->base[i], -p->e - p->far));
        p->Q[i] = (triple){d.hi, d.lo, 0};
    }
    load_stretched(p);
    p->aa = triple_dot_doubles(p->a, p->a);
    p->ab = triple_dot_doubles(p->a, p->b);
    p->bb = triple_dot_doubles(p->b, p->b);
    p->ag = triple_dot_doubles(p->a, p->g);
    p->bg = triple_dot_doubles(p->b, p->g);
    p->gg = triple_dot_doubles(p->g, p->g);
    p->Qa = triple_dot_doubles(p->Q, p->a);
    p->Qb = triple_dot_doubles(p->Q, p->b);
    p->Qg = triple_dot_doubles(p->Q, p->g);
}

/* Q minus the centre of an end. */
void cylint_from_end(const elliptic_terms *p, int end, triple to[3])
{
    for (int i = 0; i < 3; i++)
        to[i] = end ? triple_sub(p->Q[i], p->h[i]) : p->Q[i];
}

/* E.u' v.v - E.v v.u', E = Q - u, without the terms that cancel.  v occurs
 * twice in each term, so `stretch` does not change the zeros. */
void cylint_lateral_form(const elliptic_terms *p, stationary *f)
{
    const triple x =
        triple_mul(p->k1, triple_add(triple_mul(p->k1, p->Qa), p->ag));
    const triple y =
        triple_mul(p->k1, triple_add(triple_mul(p->k1, p->Qb), p->bg));
    const triple k = triple_add(p->gg, triple_mul(p->k1, p->Qg));
    const triple ab = triple_mul(p->Qa, p->bg), ba = triple_mul(p->Qb, p->ag);
    const triple turned = triple_det(p->ag, p->bg, k, p->ab);
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
                   triple_det(p->bg, p->bg, p->ag, p->ag)),
        triple_mul(k, triple_sub(p->bb, p->aa)));
}

/* E.u' for E = Q - f - e u. */
void cylint_rim_form(const elliptic_terms *p, const triple from[3],
                     triple factor, stationary *f)
{
    const triple ab = triple_mul(factor, p->ab);
    f->linear[0] = triple_dot(from, p->b);
    f->linear[1] = triple_neg(triple_dot(from, p->a));
    f->square[0] = triple_neg(ab);
    f->square[1] = triple_mul(factor, triple_sub(p->aa, p->bb));
    f->square[2] = ab;
}

/* The vectors of a ruling. */
void cylint_load_ruling(const elliptic_terms *p, const direction *at,
                        triple u[3], triple v[3])
{
    triple_combine(u, p->a, at->cos, p->b, at->sin);
    for (int i = 0; i < 3; i++)
        v[i] = triple_add(p->g[i], triple_mul(p->k1, u[i]));
}

/* E.v, where terms that are exactly 0 stay 0. */
triple cylint_along_ruling(const elliptic_terms *p, const direction *at)
{
    const triple Qu = triple_mul2(p->Qa, at->cos, p->Qb, at->sin);
    const triple uh = triple_mul2(p->ag, at->cos, p->bg, at->sin);
    const triple by_cos = triple_mul2(p->aa, at->cos, p->ab, at->sin);
    const triple by_sin = triple_mul2(p->ab, at->cos, p->bb, at->sin);
    const triple uu = triple_mul2(by_cos, at->cos, by_sin, at->sin);
    return triple_add(triple_sub(p->Qg, uh),
                      triple_mul(p->k1, triple_sub(Qu, uu)));
}
