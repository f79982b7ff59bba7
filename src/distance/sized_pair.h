/*
 * sized_pair.h - pairs with the sum of the sizes of their terms
 *
 * The error of a sum of products of numbers without an error is at most
 * CYLINT_SIZED_ERROR times the sum of the sizes of its terms: where all terms are
 * 0, so is the error.
 */
#ifndef CYLINT_SIZED_PAIR_H
#define CYLINT_SIZED_PAIR_H

#include "pair_lanes.h"

typedef struct {
    vpair v;
    vd size;
} sized;

INLINE sized sized_product(sized x, sized y)
{
    return (sized){vpair_product(x.v, y.v), x.size * y.size};
}

INLINE sized sized_sum(sized x, sized y)
{
    return (sized){vpair_add(x.v, y.v), x.size + y.size};
}

INLINE sized sized_difference(sized x, sized y)
{
    return (sized){vpair_sub(x.v, y.v), x.size + y.size};
}

/* Where terms have cancelled, the low part can be as large as the high one. */
INLINE sized sized_trimmed(sized x)
{
    return (sized){pairs_trimmed(x.v), x.size};
}

INLINE sized sized_of(vpair v)
{
    return (sized){v, v_abs(v.hi)};
}

INLINE sized sized_double(double x)
{
    return sized_of((vpair){v_set(x), v_set(0)});
}

INLINE sized sized_opposite(sized x)
{
    return (sized){opposite(x.v), x.size};
}

INLINE sized sized_dot(const sized x[3], const sized y[3])
{
    sized p[3];
    EACH(i, 3)
        p[i] = sized_product(x[i], y[i]);
    const vpair v[3] = {p[0].v, p[1].v, p[2].v};
    return (sized){pairs_sum3(v), p[0].size + p[1].size + p[2].size};
}

INLINE void sized_cross(sized to[3], const double u[3], const double v[3])
{
    EACH(i, 3) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const vpair p = v_two_prod(v_set(u[j]), v_set(v[k])),
                    q = v_two_prod(v_set(u[k]), v_set(v[j]));
        to[i] = (sized){vpair_sub(p, q), v_abs(p.hi) + v_abs(q.hi)};
    }
}

/* x p + y q */
INLINE sized sized_sum2(sized x, sized p, sized y, sized q)
{
    return sized_sum(sized_product(x, p), sized_product(y, q));
}

#endif
