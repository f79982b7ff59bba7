/*
 * reach.c - how far a section reaches along a coordinate, in pairs
 */
#include "measure.h"

static pair squares(pair x, pair y)
{
    return pair_add(pair_mul(x, x), pair_mul(y, y));
}

/* sqrt(x^2 + y^2) 2^*e, whatever the exponents of x and y; not both are 0. */
static pair hypotenuse(pair x, pair y, int *e)
{
    const int k = cylint_any_exponent(cylint_larger(fabs(x.hi), fabs(y.hi)));
    *e += k;
    return pair_sqrt(
        squares(cylint_scaled_pair(x, -k), cylint_scaled_pair(y, -k)));
}

pair cylint_unit_reach(const cylint_shape *s, const pair axis[3], int j, int *e,
                       int *is_exact)
{
    *is_exact = 1;
    *e = 0;
    if (cylint_is_elliptic(s->kind)) {
        if (cylint_sign(cylint_a(s)[j]) == 0)
            return cylint_mantissa(cylint_b(s)[j], e);
        if (cylint_sign(cylint_b(s)[j]) == 0)
            return cylint_mantissa(cylint_a(s)[j], e);
        *is_exact = 0;
        return hypotenuse((pair){cylint_a(s)[j], 0}, (pair){cylint_b(s)[j], 0},
                          e);
    }
    const pair x = axis[j];
    const pair y = axis[(j + 1) % 3], z = axis[(j + 2) % 3];
    if (cylint_sign(y.hi) == 0 && cylint_sign(z.hi) == 0)
        return (pair){0, 0};
    if (!cylint_has_tangent(s->kind) && cylint_sign(x.hi) == 0)
        return (pair){1, 0};
    *is_exact = 0;
    const pair across = hypotenuse(y, z, e);
    if (cylint_has_tangent(s->kind))
        return across;
    const int ex = cylint_exponent(x.hi), most = ex > *e ? ex : *e;
    int length_e = 0;
    const pair length = hypotenuse(cylint_scaled_pair(across, *e - most),
                                   cylint_scaled_pair(x, -most), &length_e);
    *e -= most + length_e;
    return pair_div(across, length);
}
