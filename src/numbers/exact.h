/*
 * exact.h - exact sums and products of doubles, of any size
 *
 * A number is sign * (limb[0] + limb[1] 2^32 + ...) * 2^(32 exponent), in an
 * arena on the caller's stack.  Doubles are placed by their bits, so neither
 * subnormals nor a processor told to flush them make a difference.
 */
#ifndef CYLINT_EXACT_H
#define CYLINT_EXACT_H

#include <stdint.h>

#include "double_double.h"

typedef struct {
    const uint32_t *limb; /* least first; neither first nor last is 0 */
    int n;                /* 0 for zero */
    int exponent;
    int sign; /* -1, 0, +1 */
} exact;

/*
 * How much room a question may need.  A double's lowest bit is 2^-1074 at
 * least and its highest below 2^1024: a datum takes at most 67 limbs, a product
 * of d data 67 d, and forms keep nothing but their result (BEGIN, RETURN).
 * Proved: tests/test_arena.c runs the library over numbers that have every limb
 * they might have, and uses 14221 at most; the next power of two.
 */
enum { CYLINT_ARENA_LIMBS = 16384 };

typedef struct {
    int used, most;
    uint32_t limb[CYLINT_ARENA_LIMBS];
} cylint_arena;

static inline void cylint_arena_open(cylint_arena *arena)
{
    arena->used = arena->most = 0;
}

exact cylint_exact_from(cylint_arena *arena, double x);
exact cylint_exact_add(cylint_arena *arena, exact x, exact y);
exact cylint_exact_mul(cylint_arena *arena, exact x, exact y);

static inline exact cylint_exact_neg(exact x)
{
    x.sign = -x.sign;
    return x;
}

/* x - y. */
exact cylint_exact_difference(cylint_arena *arena, double x, double y);

/* Lets go of all that was made since `used`, but for x. */
exact cylint_exact_keep(cylint_arena *arena, int used, exact x);

/* The double nearest to x 2^e, ties to even, beyond the largest infinite, in
 * whatever floating-point environment. */
double cylint_exact_nearest(exact x, int e);

/* x = (hi + lo) 2^e with 1 <= |hi| < 2, lo nearly the nearest: the relative
 * error is below CYLINT_EXACT_ROUNDING (error_bounds.h).  x is not zero. */
pair cylint_exact_round(exact x, int *e);

#endif
