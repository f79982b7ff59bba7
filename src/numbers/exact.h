/*
 * exact.h - exact sums and products of doubles, of any size
 *
 * A number is sign * (limb[0] + limb[1] 2^64 + ...) * 2^(64 exponent).  Its
 * limbs are in an arena on the caller's stack.  Doubles are converted from
 * their bits, so subnormals are exact even if the processor flushes them.
 */
#ifndef CYLINT_EXACT_H
#define CYLINT_EXACT_H

#include <stdint.h>

#include "bits.h"
#include "cylint.h"

typedef struct {
    const uint64_t *limb; /* least first; neither first nor last is 0 */
    int exponent;
    short n;    /* 0 for zero */
    short sign; /* -1, 0, +1 */
} exact;

/*
 * The capacity of the arena.  The bits of a double have weights from 2^-1074 to
 * 2^1023: an input takes at most 34 limbs, a product of d inputs 34 d.  A form
 * keeps only its result (BEGIN, RETURN).  Proved: tests/bounds/test_arena.c runs
 * the library with numbers of full length and measures at most 7756 limbs.  The
 * capacity is the next power of two.
 */
enum { CYLINT_ARENA_LIMBS = 8192 };

typedef struct {
    int used, most;
    uint64_t limb[CYLINT_ARENA_LIMBS];
} cylint_arena;

static inline void cylint_arena_open(cylint_arena *arena)
{
    arena->used = arena->most = 0;
}

/* The position above the highest limb. */
static inline int cylint_top_of(exact x)
{
    return x.exponent + x.n;
}

exact cylint_exact_from(cylint_arena *arena, double x);
/* m 2^e. */
exact cylint_exact_of_integer(cylint_arena *arena, uint64_t m, int e);
exact cylint_exact_add(cylint_arena *arena, exact x, exact y);
exact cylint_exact_mul(cylint_arena *arena, exact x, exact y);

static inline exact cylint_exact_zero(const cylint_arena *arena)
{
    /* mutant '0' -> '1': a number without limbs or without sign is 0 */
    return (exact){arena->limb, 0, 0, 0};
}

/* x with this sign. */
static inline exact cylint_exact_signed(exact x, int sign)
{
    x.sign = (short)sign;
    return x;
}

static inline exact cylint_exact_neg(exact x)
{
    return cylint_exact_signed(x, -x.sign);
}

static inline exact cylint_exact_sub(cylint_arena *arena, exact x, exact y)
{
    return cylint_exact_add(arena, x, cylint_exact_neg(y));
}

/* x - y. */
exact cylint_exact_difference(cylint_arena *arena, double x, double y);

/* Frees all limbs from `used` on, except those of x, and returns x. */
exact cylint_exact_keep(cylint_arena *arena, int used, exact x);

/* Frees all of them, and returns the sign that was computed with them. */
static inline int cylint_only_sign(cylint_arena *arena, int used, int sign)
{
    arena->used = used;
    return sign;
}

/* The 64 bits of |x| from the highest that is 1, bit 63 - shift of the highest
 * limb.  x is not 0. */
static inline uint64_t cylint_leading_bits(exact x, int *shift)
{
    const uint64_t high = x.limb[x.n - 1], low = x.n > 1 ? x.limb[x.n - 2] : 0;
    int k = 0;
    for (int step = 32; step > 0; step /= 2)
        k += high << k >> (64 - step) == 0 ? step : 0;
    *shift = k;
    return k > 0 ? high << k | low >> (64 - k) : high;
}

/* The double of a rank of 0 or more (bits.h), and 2^1024 for infinity. */
static inline exact cylint_exact_of_rank(cylint_arena *arena, int64_t rank)
{
    const double x = cylint_from_bits((uint64_t)rank);
    if (x <= DBL_MAX)
        return cylint_exact_from(arena, x);
    const exact most = cylint_exact_from(arena, 0x1p1023);
    return cylint_exact_add(arena, most, most);
}

/* The double nearest to x 2^e: ties to even, infinite on overflow.  The same in
 * every floating-point environment.  Exported for libcylint-scene. */
CYLINT_API double cylint_exact_nearest(exact x, int e);

static inline exact cylint_exact_of_sum(cylint_arena *arena, double x, double y)
{
    return cylint_exact_add(arena, cylint_exact_from(arena, x),
                            cylint_exact_from(arena, y));
}

/* The same of (hi + lo) 2^e. */
static inline double cylint_nearest_of_pair(cylint_arena *arena, pair x, int e)
{
    return cylint_exact_nearest(cylint_exact_of_sum(arena, x.hi, x.lo), e);
}

/* The double nearest to x y, in every floating-point environment; exported, too. */
CYLINT_API double cylint_nearest_product(double x, double y);

/* The double nearest to x, and the double nearest to x minus that; 0 beside an
 * infinite one.  Where nothing is subnormal, the relative error is below
 * CYLINT_EXACT_ROUNDING (error_bounds.h). */
pair cylint_exact_round(cylint_arena *arena, exact x);

#endif
