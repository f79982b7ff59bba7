/*
 * error_free_template.h - sums and products without error, for doubles and for
 * lanes
 *
 * The including file defines the type REAL, the struct PAIR of hi and lo, the
 * names EFT(name) of the functions, INLINE for their declarations, and
 * BROADCAST(x) for a constant.  It defines FUSED(a, b, c) if the processor
 * computes a b + c with one rounding.  The compiler must not reorder or
 * contract the operations: environment.h stops with an error for flags that a
 * macro shows, and cylint_selftest() detects the others.
 *
 * [Dekker 1971], [Knuth TAOCP 2, 4.2.2].
 */

INLINE PAIR EFT(two_sum)(REAL a, REAL b)
{
    const REAL s = a + b, bb = s - a;
    return (PAIR){s, (a - (s - bb)) + (b - bb)};
}

/* |a| >= |b|, or a = 0. */
INLINE PAIR EFT(fast_two_sum)(REAL a, REAL b)
{
    const REAL s = a + b;
    return (PAIR){s, b - (s - a)};
}

#ifndef FUSED
/* The error of the product p = a b.  The code is long: compilers that optimise for
 * size call it. */
static inline REAL EFT(product_error)(REAL a, REAL b, REAL p)
{
    const REAL split = BROADCAST(0x1p27 + 1);
    const REAL ca = split * a, cb = split * b;
    const REAL ah = ca - (ca - a), al = a - ah;
    const REAL bh = cb - (cb - b), bl = b - bh;
    return ((ah * bh - p) + ah * bl + al * bh) + al * bl;
}
#endif

/* The error of a product is a double.  Both computations return exactly that
 * error, so both return the same bits. */
INLINE PAIR EFT(two_prod)(REAL a, REAL b)
{
    const REAL p = a * b;
#ifdef FUSED
    /* mutant '-' -> '': mutants are built without fused multiply-add, which
     * `make check` uses where the processor has it */
    return (PAIR){p, FUSED(a, b, -p)};
#else
    return (PAIR){p, EFT(product_error)(a, b, p)};
#endif
}
