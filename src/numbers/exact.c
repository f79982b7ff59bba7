/*
 * exact.c - schoolbook integers with a limb exponent
 *
 * Typical numbers have 1 to 6 limbs.  For these the simplest algorithms are
 * the fastest.  Exponents count whole limbs, so a double is shifted once, when
 * it is converted; sums need no shift.
 */
#include "exact.h"

#include <string.h>

#include "bits.h"
#include "diagnostics.h"
#include "error_bounds.h"

static uint64_t *take(cylint_arena *arena, int n)
{
    cylint_contradiction(arena->used + n > CYLINT_ARENA_LIMBS);
    uint64_t *limb = arena->limb + arena->used;
    arena->used += n;
    if (arena->used > arena->most)
        arena->most = arena->used;
    return limb;
}

/* Drops zero limbs at both ends and returns the unused limbs to the arena. */
static exact trimmed(cylint_arena *arena, uint64_t *limb, int n, int exponent,
                     int sign)
{
    while (n > 0 && limb[n - 1] == 0)
        n--;
    arena->used = (int)(limb - arena->limb) + n;
    if (n == 0)
        return (exact){limb, 0, 0, 0};
    while (*limb == 0) {
        limb++;
        n--;
        exponent++;
    }
    return (exact){limb, exponent, (short)n, (short)sign};
}

exact cylint_exact_of_integer(cylint_arena *arena, uint64_t m, int e)
{
    const int shift = e & 63;
    uint64_t *limb = take(arena, 2);
    limb[0] = m << shift;
    limb[1] = shift > 0 ? m >> (64 - shift) : 0;
    return trimmed(arena, limb, 2, (e - shift) / 64, 1);
}

exact cylint_exact_from(cylint_arena *arena, double x)
{
    const uint64_t bits = cylint_bits(x);
    const int biased = (int)(bits >> 52 & 0x7ff);
    const uint64_t leading = (uint64_t)(biased != 0) << 52,
                   mantissa = (bits & 0xfffffffffffffu) | leading;
    const exact size =
        cylint_exact_of_integer(arena, mantissa, (biased ? biased : 1) - 1075);
    return bits >> 63 ? cylint_exact_neg(size) : size;
}

static uint64_t limb_at(exact x, int position)
{
    const int i = position - x.exponent;
    return i >= 0 && i < x.n ? x.limb[i] : 0;
}

/* |x| + |y|; or, where the signs differ, |x| - |y| in two's complement. */
exact cylint_exact_add(cylint_arena *arena, exact x, exact y)
{
    if (x.sign == 0)
        return y;
    if (y.sign == 0)
        return x;
    /* mutant '<' -> '<=': of two equal ones either is right */
    const int low = x.exponent < y.exponent ? x.exponent : y.exponent;
    const int top = cylint_top_of(x) > cylint_top_of(y) ? cylint_top_of(x)
                                                        : cylint_top_of(y);
    const int n = top - low;
    const uint64_t flip = x.sign == y.sign ? 0 : UINT64_MAX;
    uint64_t *limb = take(arena, n + 1), carry = flip & 1;
    for (int i = 0; i <= n; i++) {
        const uint64_t addend = limb_at(y, low + i) ^ flip;
        const uint64_t half = limb_at(x, low + i) + carry;
        limb[i] = half + addend;
        carry = (uint64_t)(half < carry) + (uint64_t)(limb[i] < addend);
    }
    const int is_negative = limb[n] == UINT64_MAX; /* |x| < |y| */
    carry = 1;
    for (int i = 0; i <= n && is_negative; i++) {
        limb[i] = ~limb[i] + carry;
        carry &= limb[i] == 0;
    }
    return trimmed(arena, limb, n + 1, low, is_negative ? y.sign : x.sign);
}

/* a b + *carry + c, of which *carry becomes the higher half. */
static uint64_t multiply_add(uint64_t a, uint64_t b, uint64_t c,
                             uint64_t *carry)
{
#ifdef __SIZEOF_INT128__
    __extension__ typedef unsigned __int128 product;
    const product sum = (product)a * b + c + *carry;
    *carry = (uint64_t)(sum >> 64);
    return (uint64_t)sum;
#else
    const uint64_t a0 = (uint32_t)a, a1 = a >> 32, b0 = (uint32_t)b,
                   b1 = b >> 32;
    const uint64_t low = a0 * b0 + (uint32_t)c + (uint32_t)*carry;
    const uint64_t cross = a1 * b0 + (c >> 32) + (low >> 32);
    const uint64_t other = a0 * b1 + (*carry >> 32) + (uint32_t)cross;
    *carry = a1 * b1 + (cross >> 32) + (other >> 32);
    return other << 32 | (uint32_t)low;
#endif
}

exact cylint_exact_mul(cylint_arena *arena, exact x, exact y)
{
    if (x.sign == 0 || y.sign == 0)
        return cylint_exact_zero(arena);
    const int n = x.n + y.n;
    uint64_t *limb = take(arena, n);
    memset(limb, 0, (size_t)n * sizeof *limb);
    for (int i = 0; i < x.n; i++) {
        const uint64_t digit = x.limb[i];
        uint64_t carry = 0;
        if (digit == 0) /* most limbs of a sum of distant sizes */
            continue;
        for (int j = 0; j < y.n; j++)
            limb[i + j] = multiply_add(digit, y.limb[j], limb[i + j], &carry);
        limb[i + y.n] = carry;
    }
    return trimmed(arena, limb, n, x.exponent + y.exponent, x.sign * y.sign);
}

exact cylint_exact_keep(cylint_arena *arena, int used, exact x)
{
    /* mutant '&&' -> '||': a number below stays there; its copy takes room only */
    if (x.n > 0 && x.limb >= arena->limb + used) {
        memmove(arena->limb + used, x.limb, (size_t)x.n * sizeof *x.limb);
        x.limb = arena->limb + used;
        used += x.n;
    }
    arena->used = used;
    return x;
}

/* Whether |x| has a bit below its leading ones. */
static int has_lower_bits(exact x, int shift)
{
    uint64_t lower = x.n > 1 ? x.limb[x.n - 2] << shift : 0;
    for (int i = 0; i < x.n - 2; i++)
        lower |= x.limb[i];
    return lower != 0;
}

double cylint_exact_nearest(exact x, int e)
{
    int shift;
    if (x.sign == 0)
        return 0;
    const uint64_t leading = cylint_leading_bits(x, &shift);
    const int exponent = 64 * cylint_top_of(x) - 1 - shift + e;
    uint64_t bits = (uint64_t)0x7ff << 52; /* infinite */
    if (exponent < -1075) {
        bits = 0; /* below half of the least double */
    } else if (exponent <= 1023) {
        const int digits = exponent < -1022 ? exponent + 1075 : 53;
        const uint64_t below = leading << digits;
        bits = digits > 0 ? leading >> (64 - digits) : 0;
        if (below >> 63 && (bits & 1 || below << 1 || has_lower_bits(x, shift)))
            bits++;
        if (digits == 53) /* the leading bit adds one more */
            bits += (uint64_t)(exponent + 1022) << 52;
    }
    return cylint_from_bits(x.sign < 0 ? bits | (uint64_t)1 << 63 : bits);
}

double cylint_nearest_product(double x, double y)
{
    cylint_arena arena;
    cylint_arena_open(&arena);
    return cylint_exact_nearest(cylint_exact_mul(&arena,
                                                 cylint_exact_from(&arena, x),
                                                 cylint_exact_from(&arena, y)),
                                0);
}

pair cylint_exact_round(cylint_arena *arena, exact x)
{
    const int used = arena->used;
    pair sum = {cylint_exact_nearest(x, 0), 0};
    if (fabs(sum.hi) <= DBL_MAX)
        sum.lo = cylint_exact_nearest(
            cylint_exact_sub(arena, x, cylint_exact_from(arena, sum.hi)), 0);
    arena->used = used;
    return sum;
}

exact cylint_exact_difference(cylint_arena *arena, double x, double y)
{
    const int used = arena->used;
    const exact ex = cylint_exact_from(arena, x);
    const exact ey = cylint_exact_from(arena, y);
    return cylint_exact_keep(arena, used, cylint_exact_sub(arena, ex, ey));
}
