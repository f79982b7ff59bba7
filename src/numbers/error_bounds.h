/*
 * error_bounds.h - the constants on which decisions depend, with their reasons
 *
 * Those of distances are in distance/error_bounds.h.  A few limits stand beside the
 * only comparison that reads them.
 *
 * `make prove` proves every constant that is called proved here, as [Melquiond,
 * Pion 2007].  It also shows that the proof fails for a constant 1 % smaller.
 *
 * A form is a straight-line program of sums and products.  Let `size` be the
 * same program run on absolute values, with every difference replaced by a sum.
 * Let the error of one operation be at most eps |x y| or eps (|x| + |y|).  Let
 * every path from an input to the result have at most K operations; at a
 * product the counts of both factors are added.  Then, by induction over the
 * program,
 *
 *     |computed - true| <= ((1 + eps)^K - 1) size.
 *
 * An input that is only the high part of a difference counts as one operation.
 * Eps is twice what rounding to nearest needs, so that verdicts are right in
 * every rounding mode.
 */
#ifndef CYLINT_NUMBERS_ERROR_BOUNDS_H
#define CYLINT_NUMBERS_ERROR_BOUNDS_H

/*
 * K: the deepest form is G of a cone.  tests/bounds/test_form_depth.c runs
 * forms_template.h over an arithmetic of path lengths and tests that the result
 * is exactly this.
 */
#define CYLINT_DEPTH 25

/* One operation on doubles, in any rounding mode. */
#define CYLINT_ROUNDING 0x1p-52

/* The same in rounding to nearest. */
#define CYLINT_NEAREST_ROUNDING 0x1p-53

/* Covers the higher powers of eps; the roundings of `size` and of the bound's
 * own product and sum; and that the size of a pair is computed from its high
 * part alone.  Proved. */
#define CYLINT_SLACK (1 + 0x1p-40)

#define CYLINT_FILTER_BOUND (CYLINT_DEPTH * CYLINT_ROUNDING * CYLINT_SLACK)

/*
 * The error of one operation on pairs (double_double.h), in rounding to nearest.
 * It is relative to |a| + |b| for a sum, to |a b| for a product, and to the
 * result for a quotient or root.  Proved, for pairs with |lo| <= ulp(hi)/2.
 */
#define CYLINT_PAIR_ADD 0x3p-106
#define CYLINT_PAIR_MUL 0x9p-106
#define CYLINT_PAIR_DIV 0x1.1001p-102
#define CYLINT_PAIR_SQRT 0x1.752p-104

/*
 * CYLINT_EXACT_ROUNDING: the error of an exact number rounded to a pair
 * (exact.h).
 *
 * CYLINT_INVERSE_ERROR: of 1 / sqrt(x) (surd.c).  A step of Newton's leaves 3/2
 * of the square of the error before.  That is 80 units of 2^-60: 24 of the step
 * before, 24 of the roundings in it and 32 of the last one.  1 / x and sqrt(x) have
 * the same error.  CYLINT_VALUE_ERROR: of f0 + f1 t, from that of R and of the
 * quotient; of a unit vector's component, to which the length adds that of a value
 * and its own.  Numbers cut to their leading digits add less than 2^-120 in all.
 */
#define CYLINT_EXACT_ROUNDING 0x1p-105
#define CYLINT_INVERSE_ERROR 0x1p-106
#define CYLINT_VALUE_ERROR 0x1p-103

/*
 * The errors of operations on pairs are summed (signs/forms.h) in doubles.  A path
 * of K operations has at most 5 K + 8 roundings of that sum, of its factors and of
 * high parts.  CYLINT_SLACK covers them.  Proved.
 *
 * If every datum is 0 or at least 2^-CYLINT_WHOLE_EXPONENT, it is a multiple of
 * that times 2^-52.  A number of degree k, its low part and its error
 * are multiples of the k-th power of this.  k is CYLINT_DEGREE at most
 * (tests/bounds/test_form_depth.c), and that power is a normal number, so
 * nothing underflows.
 */
#define CYLINT_DEGREE 8
#define CYLINT_WHOLE_EXPONENT 74

/*
 * The filters run only if every input is at most CYLINT_WINDOW in size.  The
 * error of an operation that underflows, flushed to zero or not, is at most
 * 2^-1022.  The window bounds the factors that multiply this error later:
 * tests/bounds/test_form_depth.c computes the total for the worst form.
 */
#define CYLINT_WINDOW 0x1p60
#define CYLINT_UNDERFLOW 0x1p-584

/*
 * The test whether hi + (lo + error) rounds to hi runs in doubles.  It is right
 * if the error exceeds the true one by this fraction of |hi|.  Proved.
 */
#define CYLINT_NEAREST_MARGIN 0x1p-106

/*
 * An independent check of the count K: the error of G of a cylinder, for inputs
 * of at most 1 in size, computed in doubles with every difference rounded.  The
 * size of G is then at most 48.  Proved by intervals.
 */
#define CYLINT_CYLINDER_G_ERROR 0x19p-48
#define CYLINT_CYLINDER_G_SIZE 48

/*
 * First-order errors of quotients (bits.h) and square roots (root.c) are added up
 * where each divisor and radicand has a relative error of at most
 * CYLINT_FIRST_ORDER.  The terms of second order are below 0.2 % of the sum, and
 * its own roundings below 2^-45: CYLINT_ROOT_SLACK covers both.
 */
#define CYLINT_FIRST_ORDER 0x1p-10
#define CYLINT_ROOT_SLACK 1.01

/*
 * Roundings of a quotient in doubles: three operations at most, in any rounding
 * mode; of a root as a sum, two products, a square root and a quotient in pairs:
 * seven at most, of which none errs by more than CYLINT_PAIR_DIV.
 */
#define CYLINT_QUOTIENT_ROUNDING 0x1p-50
#define CYLINT_PAIR_RADICAL_ROUNDING 0x1p-98

/* sqrt(S G) above this: S G has not underflowed. */
#define CYLINT_RADICAL_LEAST 0x1p-450

/* Roots that pairs decide, in lanes too, have at least this size and at most its
 * inverse.  Then no product of three underflows, and no low part of a sum is
 * subnormal. */
#define CYLINT_ROOT_LEAST 0x1p-300

/* A sum of two doubles of 2^-CYLINT_SUM_EXPONENT or more, or 0, has a low part
 * that is a multiple of 2^-952, so it is not subnormal; and the low part of such
 * a pair is at least 2^-1006. */
#define CYLINT_SUM_EXPONENT 900

/* Boxes (box.c): the error of a coordinate, relative to the sizes of its terms:
 * five sums, three products, a root and a quotient of pairs. */
#define CYLINT_BOX_ERROR 0x1p-98

/* Below this many degrees the angle in radians has the same nearest double as
 * its tangent, which is larger by less than 2^-130 of itself. */
#define CYLINT_TANGENT_LEAST 0x1p-60

/*
 * Local coordinates (shapes/local.h).  CYLINT_LOCAL_ERROR: the error of a row of
 * the matrix in pairs, summed over its entries, relative to the norm of the
 * matrix, where nothing cancels.  CYLINT_LOCAL_WORST: with larger errors the
 * coordinates are not used.  CYLINT_LOCAL_LEAST: nor with a shorter axis or
 * semi-axis; above it no low part of the matrix, or of a form in triples,
 * underflows.  Nor where a component of these is below 2^-CYLINT_LOCAL_TINY and not
 * 0: without such components an entry of the matrix that is computed as 0 is 0.
 */
#define CYLINT_LOCAL_ERROR 0x1p-96
#define CYLINT_LOCAL_WORST 0x1p-70
#define CYLINT_LOCAL_LEAST 0x1p-120
#define CYLINT_LOCAL_TINY 400

/*
 * No form in local coordinates overflows, in any rounding mode.  An overflow is
 * not always infinite: in the directed modes it can be the largest double.
 *
 *   |o|, |base|        CYLINT_FAR at most
 *   |d|                CYLINT_WINDOW at most
 *   M = k max(norm, 1)^2, k = 1 + |slope|
 *                      CYLINT_LOCAL_MOST at most
 *   a finite t where a sign is computed
 *                      CYLINT_LATE at most
 *
 * Lengths of the shape are at most CYLINT_WINDOW, so k Q D <= 2^(102 + 60) M and
 * k (t D + Q) <= 2^(170 + 60 + 1) M, with the names below; the largest forms are
 * 2^5 of the square of one of these: below 2^1000.  A line hits a bounded
 * shape only at |t| <= 2^(103 + 60), which is less than CYLINT_LATE.
 */
#define CYLINT_FAR 0x1p100
#define CYLINT_LATE 0x1p170
#define CYLINT_LOCAL_MOST 0x1p260

/* The local coordinates of a round cone are not used if the sine of its lateral
 * surface is larger: its cosine would have too few digits. */
#define CYLINT_LOCAL_STEEPEST 0.998

/* Nor are those of a cone with a smaller slope: low parts of it, and of its
 * products with coordinates, would underflow. */
#define CYLINT_LOCAL_LEAST_SLOPE 0x1p-600

/*
 * CYLINT_LOCAL_NORM: the sizes of a unit vector's components have at most this
 * sum, the root of 3.
 *
 * The errors of the forms of filter/local_forms_template.h.  u is
 * CYLINT_ROUNDING for doubles in any rounding mode, of a round cone
 * CYLINT_LOCAL_ROUND times that, and cylint_frame_error() for pairs in rounding to
 * nearest.  Where the matrix has no low parts (shapes/local_doubles.c), u is
 * CYLINT_LOCAL_DOUBLES times CYLINT_ROUNDING, of a round cone divided by the
 * square of its cosine.  No coordinate of the line's origin exceeds Q,
 * none of its direction exceeds D, no radius exceeds r <= Q; k = 1 + |slope|.
 *
 *   a coordinate of a point     CYLINT_LOCAL_POSITION u Q
 *   A                           CYLINT_LOCAL_A u (k D)^2
 *   B                           CYLINT_LOCAL_FORM u k^2 Q D
 *   N, T                        CYLINT_LOCAL_FORM u k Q D^2
 *   E, and G if slope = 0       CYLINT_LOCAL_FORM u Q D^2
 *                                   (r + CYLINT_LOCAL_SECOND u Q)
 *   g of a ball                 the same with CYLINT_LOCAL_BALL
 *   A and B of a ball           as for slope = 0
 *
 *   G of a tapered shape        2 f (|Y| + f), f = CYLINT_LOCAL_FORM / 2 u k Q D,
 *                                   G = |Y|^2 - (p x v)^2
 *   C at a point of the line    4 f (widest + f), f = CYLINT_LOCAL_POSITION u k Q
 *
 * E, G and C are differences of two squares, a^2 - b^2.  The computed value
 * grows with a and falls with b.  So its sign is right if the value exceeds the
 * error for a = b, which is proportional to r D or |Y| there.  Where G > 0, this
 * is the error of its value as well, because b < a.
 *
 * tests/bounds/test_local_bounds.c computes the errors by running the forms over
 * bounds: all constants are bounds with slack, at most four times too large.
 */
#define CYLINT_LOCAL_POSITION 16
#define CYLINT_LOCAL_A 64
#define CYLINT_LOCAL_FORM 128
#define CYLINT_LOCAL_BALL 256
#define CYLINT_LOCAL_ROUND 1.25
#define CYLINT_LOCAL_DOUBLES 16
#define CYLINT_LOCAL_NORM 0x1.bb67ae8584cabp0
#define CYLINT_LOCAL_SECOND 16

/*
 * The error of a residual in pairs, u = cylint_frame_error(), at t, where no
 * coordinate exceeds Q = |t| D + Q:
 *
 *   of a cap       f = CYLINT_LOCAL_RESIDUAL u Q
 *   lateral        k f (|x| + |y| + k f + CYLINT_LOCAL_UNTRIMMED k Q), and
 *                  |rho| beside |x| if the shape is tapered
 *
 * The last term is for the square of the low parts.
 * tests/bounds/test_local_bounds.c computes both.
 *
 * A slope 2 s has an error of at most a quarter: from G, since 4 G_error < G; from
 * A t + B, because |t| A_error + B_error <= s / 4.  For the root r next to t,
 * Q(t) = (t - r) (s' + A t + B), s' the true s.  Both terms have the sign of the
 * slope, so t is nearer to r than to the other root, and |t - r| is at most
 * CYLINT_LOCAL_DISTANCE |Q(t) / (2 s)|.  Proved.  CYLINT_LOCAL_SLACK covers the
 * terms of second order in the error of Newton's step.  CYLINT_LOCAL_NEWTON is
 * proved and is smaller.  A second step begins where the first ended.  It serves if
 * A times the distance from the root is at most CYLINT_LOCAL_NEAR of the slope:
 * then the error of A t + B is at most 1/16 s.
 */
#define CYLINT_LOCAL_RESIDUAL 16
#define CYLINT_LOCAL_UNTRIMMED 0x1p-50
#define CYLINT_LOCAL_SLACK 1.25
#define CYLINT_LOCAL_NEWTON 1.155
#define CYLINT_LOCAL_DISTANCE 1.25
#define CYLINT_LOCAL_NEAR 0x1p-5

/* The error of a residual in levels, in multiples of the square of
 * cylint_frame_error() and of the size of its terms
 * (tests/bounds/test_local_residuals.c computes it, a bound with slack); and,
 * relative to the residual, of its rounding and its division by the height, by
 * the square of the axis or by the square of height and cosine: fewer than
 * sixteen roundings to nearest. */
#define CYLINT_LOCAL_LEVELS 0x1p54
#define CYLINT_LOCAL_SCALING 0x1p-49

/*
 * Angles in turns, in lanes (turns_lanes.h).  a is the angle beyond the node,
 * q its tangent.  Of turns_of(), each proved:
 *
 *   INPUT     a point that is inexact: 1 / (2 pi) and the second order, where
 *             ex + ey is at most CYLINT_TURN_NEAR |(x, y)|
 *   CUBIC     the roundings of q^3 / 3, and the error of the series,
 *             CYLINT_TURN_SERIES (tests/numbers/test_turns.c computes it)
 *   RELATIVE  the roundings of the quotient, QUOTIENT, and those by 1 / (2 pi),
 *             TANGENT_ROUNDING
 *   NODE      the difference v cos - u sin, whose terms cancel, of products
 *             that err by PRODUCT
 */
#define CYLINT_TURN_INPUT 0.16
#define CYLINT_TURN_NEAR 0x1p-9
#define CYLINT_TURN_SERIES 0x1.1p-58
#define CYLINT_TURN_CUBIC 0x1.08p-52
#define CYLINT_TURN_PRODUCT 0x4.a1p-103
#define CYLINT_TURN_QUOTIENT 0x1.8cp-98
#define CYLINT_TURN_TANGENT_ROUNDING 0x1.9cp-100
#define CYLINT_TURN_RELATIVE 0x1p-96
#define CYLINT_TURN_NODE 0x1.52p-97

/* The relative error of an angle from exact numbers (roots/hit.c): of the pairs of
 * a node, of the inverse and of 1 / (2 pi). */
#define CYLINT_ANGLE_ERROR 0x1p-100

/*
 * Members of a hit (filter/members.h).  CYLINT_MEMBER_COORDINATE: the error of a
 * local coordinate of the hit, in multiples of cylint_frame_error() and of the
 * sizes of the hit's coordinates and CYLINT_MEMBER_FAR of those of their terms;
 * also that of a product or quotient of pairs, relative to it.
 * CYLINT_MEMBER_PLACE: of a coordinate of the point, relative to |o| + |t d|.  ROW,
 * STEP, PRODUCT, QUOTIENT and PLACE_ROUNDING are what roundings add to them; each
 * is proved.
 * CYLINT_MEMBER_UNIT: bounds are counted in it.
 * CYLINT_MEMBER_LEAST: no smaller number but 0 is certain.
 * CYLINT_MEMBER_TIE: components of the normal and phi that are nearer to the middle
 * of two doubles, relative to them, are not certain.
 * CYLINT_MEMBER_SCALE: sizes of terms are multiplied by it, so that they do not
 * underflow.
 * CYLINT_MEMBER_NEAR: no bound on the error of a root from its nearest double is
 * less: the products of less with subnormal numbers can be 0.
 * CYLINT_MEMBER_LIKELY: members are likely to be certain where the error of the hit
 * is at most this part of the radius; only time depends on it.
 */
#define CYLINT_MEMBER_COORDINATE 2
#define CYLINT_MEMBER_ROW 0xd.03p-104
#define CYLINT_MEMBER_STEP 0x1c.2bp-104
#define CYLINT_MEMBER_PRODUCT 0x2c.47p-104
#define CYLINT_MEMBER_QUOTIENT 0x9.83p-104
#define CYLINT_MEMBER_PLACE 0x1p-101
#define CYLINT_MEMBER_PLACE_ROUNDING 0x4.01p-104
#define CYLINT_MEMBER_UNIT 0x1p-392
#define CYLINT_MEMBER_FAR 0x1p-2
#define CYLINT_MEMBER_SCALE 0x1p300
#define CYLINT_MEMBER_LEAST 0x1p-300
#define CYLINT_MEMBER_TIE 0x1p-90
#define CYLINT_MEMBER_NEAR 0x1p-200
#define CYLINT_MEMBER_LIKELY 0x1p-64

/*
 * Half-spaces (filter/plane.h): the error of a scalar product of a vector of pairs
 * and one of doubles, relative to the sum of the sizes of its terms.
 * CYLINT_PLANE_ROUNDING is proved and is smaller.
 */
#define CYLINT_PLANE_ERROR 0x1p-101
#define CYLINT_PLANE_ROUNDING 0x1c.12p-106

#endif
