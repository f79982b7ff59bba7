/*
 * scale.c - exact scaling by powers of two, and exact differences
 */
#include "bits.h"
#include "exact.h"

double cylint_scaled(double x, int e)
{
    if (cylint_sign(x) == 0 || !(fabs(x) <= DBL_MAX))
        return x;
    /* the processor may read a subnormal number as 0 */
    if (cylint_exponent(x) < -1022) {
        x = cylint_sign(x) * (double)(cylint_bits(x) << 12 >> 12);
        e -= 1074;
    }
    const int k = cylint_exponent(x), sum = k + e;
    if (sum >= -1022 && sum <= 1023)
        return cylint_from_bits(cylint_bits(x) + ((uint64_t)e << 52));
    const double m = cylint_from_bits(cylint_bits(x) - ((uint64_t)k << 52));
    if (sum > 1023)
        return m * 0x1p1000 * 0x1p100; /* overflows */
    /* The bits of a subnormal count least doubles.  The sum rounds that number, so
     * that no processor flushes the result.
     * mutant '>' -> '>=': at -1200 both are -126 */
    const double steps =
        m * cylint_power_of_two(sum > -1200 ? sum + 1074 : -126);
    const double rounded = x < 0 ? steps - 0x1p52 : steps + 0x1p52;
    return cylint_from_bits(cylint_bits(rounded) - cylint_bits(0x1p52));
}

pair cylint_difference_by_bits(double x, double y)
{
    cylint_arena arena;
    cylint_arena_open(&arena);
    return cylint_exact_round(&arena, cylint_exact_difference(&arena, x, y));
}
