/*
 * tangent.c - the tangent of an angle in degrees, to the nearest double
 *
 * By the series of sine and cosine in pairs of doubles: about 2^-96 off
 * before the last rounding, so that only an angle whose tangent lies within
 * 2^-43 ulp of a middle between doubles could be rounded the wrong way.  None
 * is known (observed: tests/shapes/test_errors.c against MPFR).  Of the
 * tangents of rational degrees only that of 45 is rational, so there are no ties.
 */
#include "measure.h"

#include "../numbers/bits.h"
#include "../numbers/error_bounds.h"
#include "../numbers/exact.h"

/* sum over i of (-1)^i x^(2i+first) / (2i+first)!, 0 < x <= pi/4, by Horner's rule:
 * then no division waits for another. */
static pair series(pair x, int first)
{
    const pair square = pair_neg(pair_mul(x, x)), one = {1, 0};
    pair sum = one;
    /* mutant '>' -> '>=': n - first is odd */
    for (int n = first + 33; n > first; n -= 2) {
        const pair ratio = pair_div(square, (pair){(double)n * (n + 1), 0});
        sum = pair_add(one, pair_mul(ratio, sum));
    }
    return first ? pair_mul(x, sum) : sum;
}

/* The double nearest to x 2^e, in whatever rounding mode. */
static double nearest_double(pair x, int e)
{
    cylint_arena arena;
    cylint_arena_open(&arena);
    return cylint_nearest_of_pair(&arena, x, e);
}

double cylint_tangent(double degrees)
{
    static const pair radian = {0x1.1df46a2529d39p-6, 0x1.5c1d8becdd291p-62};
    /* 90 - degrees is exact from 45 on [Sterbenz] */
    /* mutant '>' -> '>=': 45 = 90 - 45 */
    const int steep = degrees > 45;
    double angle = steep ? 90 - degrees : degrees;
    int e = 0;
    if (angle < CYLINT_TANGENT_LEAST) { /* no underflow; tan x = x there */
        e = -600;
        angle = cylint_scaled(angle, 600);
    }
    const pair x = pair_mul(radian, (pair){angle, 0});
    if (e != 0)
        return nearest_double(x, e);
    const pair sine = series(x, 1), cosine = series(x, 0);
    return nearest_double(
        steep ? pair_div(cosine, sine) : pair_div(sine, cosine), 0);
}
