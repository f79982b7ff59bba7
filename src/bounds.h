/*
 * bounds.h - the only constants that decide anything, with their reasons
 *
 * A form is a straight-line program of sums and products.  Let `size` be the
 * same program run on absolute values with every difference a sum.  If no
 * path from a datum to the result meets more than K roundings (those of both
 * factors counted at a product), each at most eps relative, then
 *
 *     |computed - true| <= ((1 + eps)^K - 1) size.
 *
 * CYLINT_DEPTH bounds K over all forms: the deepest, G of a cone and of an
 * econe, has 25, a datum known as the high part of a pair counting 1, and Q
 * at a given parameter has 24; tests/test_depth.c counts them by running
 * forms.h over an arithmetic of path lengths.
 *
 * Eps is doubled against rounding to nearest, so that a caller's rounding
 * mode does not matter; the slack covers the roundings of `size` itself.
 */
#ifndef CYLINT_BOUNDS_H
#define CYLINT_BOUNDS_H

#define CYLINT_DEPTH 30

/* One double rounding is at most 2^-53 (2^-52 in directed modes). */
#define CYLINT_FILTER_BOUND (CYLINT_DEPTH * 0x1p-52 * (1 + 0x1p-40))

/* One operation on pairs is off by at most 2^-103 times the sizes (eft.h;
 * directed modes: 2^-101). */
#define CYLINT_PAIR_ROUNDING 0x1p-101
#define CYLINT_PAIR_BOUND (CYLINT_DEPTH * CYLINT_PAIR_ROUNDING * (1 + 0x1p-40))

/*
 * The filters run only where every datum is at most CYLINT_WINDOW in size.
 * An operation that underflows, flushing to zero included, errs by at most
 * 2^-1022, and what multiplies that error later is below 2^(7 * 60 + 9): so
 * the forms, of at most 8 factors, err by less than 2^-590 in all.
 */
#define CYLINT_WINDOW 0x1p60
#define CYLINT_UNDERFLOW 0x1p-590

#endif
