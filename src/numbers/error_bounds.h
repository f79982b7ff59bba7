/*
 * error_bounds.h - the only constants that decide anything, with their reasons
 *
 * `make prove` proves what is called proved here, and that no proved
 * constant could be 1 % smaller by the same reasoning.
 *
 * A form is a straight-line program of sums and products.  Let `size` be the
 * same program run on absolute values with every difference a sum.  If one
 * operation errs by at most eps |x y| or eps (|x| + |y|), and no path from a
 * datum to the result meets more than K of them (those of both factors
 * counted at a product), then, by induction over the program,
 *
 *     |computed - true| <= ((1 + eps)^K - 1) size.
 *
 * A datum known only as the high part of a difference counts as one
 * operation.  Eps is twice what rounding to nearest needs, so that a
 * caller's rounding mode does not matter to a verdict.
 */
#ifndef CYLINT_BOUNDS_H
#define CYLINT_BOUNDS_H

/*
 * K: the deepest form is G of a cone.  tests/test_form_depth.c runs forms_template.h over
 * an arithmetic of path lengths and wants exactly this.
 */
#define CYLINT_DEPTH 25

/* One operation on doubles, in any rounding mode. */
#define CYLINT_ROUNDING 0x1p-52

/* Covers the powers of eps beyond the first; the roundings of `size` and of
 * the bound's own product and sum; and, of a pair, the size taken from its
 * high part alone.  Proved. */
#define CYLINT_SLACK (1 + 0x1p-40)

#define CYLINT_FILTER_BOUND (CYLINT_DEPTH * CYLINT_ROUNDING * CYLINT_SLACK)

/*
 * One operation on pairs (double_double.h), in rounding to nearest: of a sum relative
 * to |a| + |b|, of a product to |a b|, else of the result.  Proved, for pairs
 * with |lo| <= ulp(hi)/2.
 */
#define CYLINT_PAIR_ADD 0x3p-106
#define CYLINT_PAIR_MUL 0x9p-106
#define CYLINT_PAIR_DIV 0x1.1001p-102
#define CYLINT_PAIR_SQRT 0x1.752p-104

/*
 * The same in the directed modes, where |lo| <= ulp(hi) and the low parts of
 * two_sum and fast_two_sum are themselves rounded.  Proved for low parts off
 * by at most 2^-104 |s| each, and products exact, as by fused multiply-add
 * (Dekker's splitting is for rounding to nearest); and a round number above
 * both.
 */
#define CYLINT_PAIR_ADD_DIRECTED 0x7p-104
#define CYLINT_PAIR_MUL_DIRECTED 0xdp-104
#define CYLINT_PAIR_ROUNDING 0x1p-100

/*
 * An exact number as a pair (exact.h), and what surd.c makes of such: X, f1,
 * S, G and what stands beside the sum are rounded; then come a root, a
 * product by S and one by f1, the sum, in which sizes are added, and the
 * quotient.  (S G under the root makes half of S's error and of a product's.)
 * That is the sum of ten relative errors; the rest covers their products.
 */
#define CYLINT_EXACT_ROUNDING 0x1p-104
#define CYLINT_SURD_ERROR 0x1p-97

/*
 * What a hit has beside t is computed from t and the root's rest as a multiple
 * of 2^-12 units in the last place of t (root.c): few enough bits that the
 * errors of most roots, 2^-20 units or less, leave no doubt about the multiple;
 * enough that a point 2^9 times nearer to the origin than |t d| has its digits.
 * Where |t d| is 2^7 sizes of the shape or more, a better root is taken at
 * once.  These choices are about speed: other values change last digits, not
 * the bound on them.  A rest that is nearer to the middle between two multiples
 * than the margin is computed in every digit; there its error is below 2^-52 of
 * a rest of 2^11 multiples at most, which is less than the margin.  t is such
 * that its rest and products with it are normal.
 */
#define CYLINT_REST_BITS 12
#define CYLINT_REST_FAR 0x1p7
#define CYLINT_REST_MARGIN 0x1p-20
#define CYLINT_REST_LEAST 0x1p-300
#define CYLINT_REST_MOST 0x1p300

/* A relative error that leaves all but a few digits of a pair.  Where Newton's
 * step leaves a larger one, the root is computed in every digit. */
#define CYLINT_POLISHED 0x1p-90

/*
 * Errors in pairs are summed up operation by operation (sign.h, wide), in
 * doubles and in units of CYLINT_PAIR_ROUNDING; a path of K operations meets
 * at most 5 K roundings of that sum and of high parts.  Proved.
 */
#define CYLINT_PAIR_UNIT (CYLINT_PAIR_ROUNDING * CYLINT_SLACK)

/*
 * The filters run only where every datum is at most CYLINT_WINDOW in size.
 * An operation that underflows, flushing to zero included, errs by at most
 * 2^-1022, and what multiplies that error later is bounded by the window:
 * tests/test_form_depth.c adds up what arrives at the worst form.
 */
#define CYLINT_WINDOW 0x1p60
#define CYLINT_UNDERFLOW 0x1p-586

/*
 * What root.c multiplies first-order errors by: the terms of second order
 * and the roundings of the error itself, where the slope is known to 2^-10.
 * Proved for the smaller.
 */
#define CYLINT_NEWTON_SLACK 0x1.0041p0
#define CYLINT_ROOT_SLACK 1.01

/*
 * And whether hi + (lo + error) rounds to hi is itself asked in doubles: that
 * decides rightly where the error exceeds the true one by this much of |hi|.
 * Proved; an error made of CYLINT_PAIR_ROUNDING exceeds what it stands for,
 * in rounding to nearest, by half.
 */
#define CYLINT_NEAREST_MARGIN 0x1p-106

/*
 * An independent check of the counting: G of a cylinder whose data are at
 * most 1 in size, evaluated in doubles with every difference rounded, is off
 * by at most this; its size is then at most 48.  Proved, by intervals.
 */
#define CYLINT_CYLINDER_G_ERROR 0x19p-48
#define CYLINT_CYLINDER_G_SIZE 48

/*
 * C and alpha in the unnormalised pairs of simd.h, in which roots are rounded
 * in lanes, to nearest only: tests/test_form_depth.c runs forms_template.h over what lo and
 * the error can come to, in units of 2^-53 and 2^-106 of the sizes.
 */
#define CYLINT_LAZY_BOUND (512 * 0x1p-106)

/* What the fast mode promises of t (lanes.h, take_root). */
#define CYLINT_FAST_BOUND 0x1p-34

#endif
