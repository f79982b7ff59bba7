/*
 * surd_sum.c - a + b sqrt(c) of exact numbers: its sign and its value
 *
 * If a and b have opposite signs, a + b sqrt(c) = N / (a - b sqrt(c)) with
 * N = a^2 - b^2 c, in whose denominator sizes are added.
 */
#include "exact_distance.h"

floating cylint_floating(exact x)
{
    /* mutant '0' -> '1': the value of a 0 is not read, only its sign */
    floating f = {{0, 0}, 0};
    if (x.sign != 0)
        f.v = cylint_exact_round(x, &f.e);
    return f;
}

floating cylint_floating_sqrt(floating x)
{
    const int odd = x.e & 1, twice = odd ? 2 : 1;
    const pair even = {x.v.hi * twice, x.v.lo * twice};
    return (floating){pair_sqrt(even), (x.e - odd) / 2};
}

static floating floating_mul(floating x, floating y)
{
    return (floating){pair_mul(x.v, y.v), x.e + y.e};
}

/* |x|. */
static floating floating_size(floating x)
{
    return x.v.hi < 0 ? (floating){pair_neg(x.v), x.e} : x;
}

/* x + y of x > 0 and y > 0. */
static floating floating_sum_of_sizes(floating x, floating y)
{
    const floating large = x.e < y.e ? y : x, small = x.e < y.e ? x : y;
    if (large.e - small.e > CYLINT_NEGLIGIBLE_EXPONENT)
        return large;
    const double w = cylint_power_of_two(small.e - large.e);
    return (floating){pair_add(large.v, (pair){small.v.hi * w, small.v.lo * w}),
                      large.e};
}

/* a^2 - b^2 c. */
static exact norm(cylint_arena *arena, const surd_sum *x)
{
    const int used = arena->used;
    const exact aa = cylint_exact_mul(arena, x->a, x->a);
    const int kept = arena->used;
    const exact bb = cylint_exact_mul(arena, x->b, x->b);
    const exact bbc =
        cylint_exact_keep(arena, kept, cylint_exact_mul(arena, bb, x->c));
    return cylint_exact_keep(arena, used, cylint_exact_sub(arena, aa, bbc));
}

int cylint_surd_sum_sign(cylint_arena *arena, const surd_sum *x)
{
    const int a = x->a.sign, b = x->b.sign * x->c.sign, used = arena->used;
    if (a * b >= 0)
        return a != 0 ? a : b;
    return cylint_only_sign(arena, used, norm(arena, x).sign * a);
}

floating cylint_surd_sum_value(cylint_arena *arena, const surd_sum *x)
{
    const int a = x->a.sign, b = x->b.sign * x->c.sign, used = arena->used;
    if (b == 0)
        return cylint_floating(x->a);
    const floating radical = floating_mul(
        cylint_floating(x->b), cylint_floating_sqrt(cylint_floating(x->c)));
    if (a == 0)
        return radical;
    const floating size = floating_sum_of_sizes(
        floating_size(cylint_floating(x->a)), floating_size(radical));
    /* mutant '<' -> '<=': a is -1 or 1 here */
    const floating sum = {a < 0 ? pair_neg(size.v) : size.v, size.e};
    if (a == b)
        return sum;
    const floating N = cylint_floating(norm(arena, x));
    arena->used = used;
    return N.v.hi == 0 ? N : floating_div(N, sum);
}

floating cylint_surd_quotient_value(cylint_arena *arena, const surd_quotient *x)
{
    const floating n = cylint_surd_sum_value(arena, &x->n);
    return n.v.hi == 0 ? n : floating_div(n, cylint_floating(x->d));
}
