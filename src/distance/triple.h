/*
 * triple.h - sums of three doubles; vectors, quotients and norms of them; rulings
 *
 * A triple stands for a + b + c.  Where nothing has cancelled, |b| is at most
 * 2^-53 |a| and |c| at most 2^-104 |a|, or nearly.  The error of an operation is
 * then below CYLINT_TRIPLE_ROUNDING (error_bounds.h) of |x| + |y| or of |x y|, in
 * rounding to nearest.  Where terms have cancelled, it is below that of their
 * sizes: tests/bounds/test_local_residuals.c.
 *
 * After the triple-word arithmetic of [Hida, Li, Bailey 2001].
 */
#ifndef CYLINT_TRIPLE_H
#define CYLINT_TRIPLE_H

#include "../numbers/bits.h"
#include "../numbers/double_double.h"
#include "error_bounds.h"

typedef struct {
    double a, b, c;
} triple;

static inline triple triple_of(double x)
{
    return (triple){x, 0, 0};
}

static inline triple triple_of_pair(pair x)
{
    return (triple){x.hi, x.lo, 0};
}

static inline triple triple_sum(double a, double b, double c)
{
    const pair head = fast_two_sum(a, b), tail = fast_two_sum(head.lo, c);
    return (triple){head.hi, tail.hi, tail.lo};
}

static inline triple triple_add(triple x, triple y)
{
    const pair s = two_sum(x.a, y.a), t = two_sum(x.b, y.b);
    const pair u = two_sum(t.hi, s.lo);
    return triple_sum(s.hi, u.hi, (x.c + y.c) + (t.lo + u.lo));
}

static inline triple triple_sub(triple x, triple y)
{
    return triple_add(x, (triple){-y.a, -y.b, -y.c});
}

static inline triple triple_mul(triple x, triple y)
{
    const pair p = two_prod(x.a, y.a);
    const pair q = two_prod(x.a, y.b), r = two_prod(x.b, y.a);
    const pair s = two_sum(q.hi, r.hi), t = two_sum(s.hi, p.lo);
    const double low = (x.a * y.c + x.c * y.a) + x.b * y.b;
    return triple_sum(p.hi, t.hi, low + ((q.lo + r.lo) + (s.lo + t.lo)));
}

static inline triple triple_neg(triple x)
{
    return (triple){-x.a, -x.b, -x.c};
}

/* x f, f 0, 1, -1 or a power of two */
static inline triple triple_scale(triple x, double f)
{
    return (triple){x.a * f, x.b * f, x.c * f};
}

/* x 2^e, whatever the exponents. */
static inline triple triple_scaled(triple x, int e)
{
    return (triple){cylint_scaled(x.a, e), cylint_scaled(x.b, e),
                    cylint_scaled(x.c, e)};
}

/* x f for any f: triple_mul() without what is 0. */
static inline triple triple_times(triple x, double f)
{
    const pair p = two_prod(x.a, f), r = two_prod(x.b, f);
    const pair t = two_sum(r.hi, p.lo);
    return triple_sum(p.hi, t.hi, x.c * f + (r.lo + t.lo));
}

/* x y + z t */
static inline triple triple_mul2(triple x, triple y, triple z, triple t)
{
    return triple_add(triple_mul(x, y), triple_mul(z, t));
}

/* x y - z t */
static inline triple triple_det(triple x, triple y, triple z, triple t)
{
    return triple_sub(triple_mul(x, y), triple_mul(z, t));
}

/* x / y: each quotient of doubles yields a double's digits. */
static inline triple triple_div(triple x, triple y)
{
    const double a = x.a / y.a;
    const triple remainder = triple_sub(x, triple_times(y, a));
    const double b = remainder.a / y.a;
    const triple last = triple_sub(remainder, triple_times(y, b));
    return triple_sum(a, b, last.a / y.a);
}

/* The double nearest to x, or its neighbour.  Where terms have cancelled, x.a
 * can be 0 though x is not. */
static inline double triple_value(triple x)
{
    return x.a + (x.b + x.c);
}

static inline pair pair_of_triple(triple x)
{
    return fast_two_sum(x.a, x.b + x.c);
}

/* D = point - from */
static inline void load_difference(triple D[3], const double point[3],
                                   const double from[3])
{
    for (int i = 0; i < 3; i++)
        D[i] = triple_of_pair(two_diff(point[i], from[i]));
}

static inline triple triple_dot(const triple u[3], const triple v[3])
{
    return triple_add(triple_mul2(u[0], v[0], u[1], v[1]),
                      triple_mul(u[2], v[2]));
}

/* u.v for a vector v of doubles */
static inline triple triple_dot_doubles(const triple u[3], const triple v[3])
{
    return triple_add(
        triple_add(triple_times(u[0], v[0].a), triple_times(u[1], v[1].a)),
        triple_times(u[2], v[2].a));
}

/* to = u x v; `to` is neither of them. */
static inline void triple_cross(triple to[3], const triple u[3],
                                const triple v[3])
{
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        to[i] = triple_det(u[j], v[k], u[k], v[j]);
    }
}

static inline double triple_largest(const triple v[3])
{
    const double x[3] = {v[0].a, v[1].a, v[2].a};
    return cylint_largest(x);
}

/* 2^-e for the exponent e of a size, within 2^-1000 and 2^1000; 1 for 0. */
static inline double normalizer(double size)
{
    const int e = size == 0 ? 0 : cylint_any_exponent(size);
    return cylint_power_of_two(e > 1000 ? -1000 : e < -1000 ? 1000 : -e);
}

/* v times a power of two, which it returns, so that its length is about 1. */
static inline double triple_unit(triple unit[3], const triple v[3])
{
    const double scale = normalizer(triple_largest(v));
    for (int i = 0; i < 3; i++)
        unit[i] = triple_scale(v[i], scale);
    return scale;
}

/* |v| of such a vector. */
static inline pair triple_length(const triple v[3])
{
    const triple square = triple_dot(v, v);
    return square.a > 0 ? pair_sqrt(fast_two_sum(square.a, square.b))
                        : (pair){0, 0};
}

/* ------------------------------------------ rulings of elliptic shapes -- */

/* cos and sin of an angle; the sum of their squares is 1 to the last place. */
typedef struct {
    triple cos, sin;
} direction;

/* Divides by the length, which is nearly 1. */
static inline void normalize(direction *d)
{
    const triple square = triple_mul2(d->cos, d->cos, d->sin, d->sin);
    const triple half = triple_scale(triple_sub(square, triple_of(1)), 0.5);
    d->cos = triple_sub(d->cos, triple_mul(d->cos, half));
    d->sin = triple_sub(d->sin, triple_mul(d->sin, half));
}

/* With u = a cos + b sin: u' = b cos - a sin and v = h + k1 u. */
typedef struct {
    triple u[3], du[3], v[3]; /* du: u' */
} ruling;

/* a, b and h: of doubles. */
static inline void load_ruling(ruling *r, const triple a[3], const triple b[3],
                               const triple h[3], triple k1,
                               const direction *at)
{
    for (int i = 0; i < 3; i++) {
        r->u[i] = triple_add(triple_times(at->cos, a[i].a),
                             triple_times(at->sin, b[i].a));
        r->du[i] = triple_sub(triple_times(at->cos, b[i].a),
                              triple_times(at->sin, a[i].a));
        r->v[i] = triple_add(h[i], triple_mul(k1, r->u[i]));
    }
}

#endif
