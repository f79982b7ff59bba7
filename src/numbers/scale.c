/*
 * scale.c - scaling by powers of two, exact differences, the largest of three
 *
 * These functions are not in exact.c because tests/bounds/test_arena.c replaces
 * that file.
 */
#include "bits.h"
#include "exact.h"

double cylint_scaled(double x, int e)
{
    const int k = cylint_exponent(x), sum = k + e;
    cylint_arena arena;
    if (cylint_sign(x) == 0 || !(fabs(x) <= DBL_MAX))
        return x;
    if (k >= -1022 && sum >= -1022 && sum <= 1023)
        return cylint_from_bits(cylint_bits(x) + ((uint64_t)e << 52));
    cylint_arena_open(&arena);
    return cylint_exact_nearest(cylint_exact_from(&arena, x), e);
}

pair cylint_difference_by_bits(double x, double y)
{
    cylint_arena arena;
    cylint_arena_open(&arena);
    return cylint_exact_round(&arena, cylint_exact_difference(&arena, x, y));
}

double cylint_largest_by_bits(const double x[3])
{
    double most = 0;
    for (int i = 0; i < 3; i++)
        if (cylint_less(most, fabs(x[i])))
            most = fabs(x[i]);
    return most;
}
