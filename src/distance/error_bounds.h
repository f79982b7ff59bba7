/*
 * error_bounds.h - the constants on which a decision about a distance depends,
 * with their reasons (see numbers/error_bounds.h)
 */
#ifndef CYLINT_DISTANCE_ERROR_BOUNDS_H
#define CYLINT_DISTANCE_ERROR_BOUNDS_H

#include "../numbers/error_bounds.h"

/* The error of the square of a distance, and of its root: exact numbers are
 * rounded to pairs, then follow a root, a product, a sum and two quotients.  In
 * directed rounding modes the low parts of pairs can be lost, so the error is far
 * more than the roundings of their high parts.  It affects only the speed:
 * candidates within it are compared exactly. */
#define CYLINT_SURD_ERROR 0x1p-97
#define CYLINT_DIRECTED_SURD_ERROR 0x1p-44

/*
 * Distances in pairs (distance/half_plane.h).  S is at least |D|, D the point
 * from the base, and at most 2 |D|.  thin = S / (2 rho) is at least 1/4.  Proved:
 *
 *   CYLINT_HALF_PLANE_SUM      of D.w relative to S, and of D.D to S^2
 *   CYLINT_HALF_PLANE_SQUARE   of z^2 relative to S^2
 *   CYLINT_HALF_PLANE_REST     of D.D - z^2 minus the square of the first root,
 *                              relative to S^2
 *   CYLINT_HALF_PLANE_ROOT     of the root's two steps, relative to that rest
 *                              divided by the root, if it is at most 2^-21 of the
 *                              square: for thin <= CYLINT_THINNEST it is
 *   CYLINT_HALF_PLANE_MUL      of a product with cosine or sine, relative to S
 *
 * With CYLINT_LOCAL_ERROR of the matrix, z errs by less than 2^-95 S, D.D - z^2
 * by less than 2^-93 S^2, and rho by less than 2^-91 S thin.  A distance is a sum
 * of both with factors of at most 1, of terms of the shape with a relative error
 * below 2^-94, and of roundings of lo.  CYLINT_HALF_PLANE_ERROR (S thin + reach)
 * is more than all of that (tests/prove/ratios.txt).
 *
 * Nearer to the axis thin is larger.  There rho is the length of (x, y), each a sum
 * of three products in pairs, whose errors are below 2^-95 S with that of the
 * matrix: rho errs by less than 2^-94 S.
 *
 * The distance from a rim is another root.  Its first step is of the size of the
 * low parts.  If it is at most CYLINT_ROOT_STEP of the root, the same two steps
 * do.
 *
 * A combination of the high parts in doubles has fewer than 8 roundings of terms
 * of at most S or a length of the shape; CYLINT_FEATURE_MARGIN is 2^3 times
 * more.  Distances below CYLINT_DISTANCE_LEAST are left to exact numbers: above
 * it no underflow is larger than the bound.
 */
#define CYLINT_HALF_PLANE_ERROR 0x1p-90
#define CYLINT_HALF_PLANE_SUM 0x1.28p-101
#define CYLINT_HALF_PLANE_SQUARE 0x1.acp-99
#define CYLINT_HALF_PLANE_REST 0x1p-99
#define CYLINT_HALF_PLANE_ROOT 0x1.04p-46
#define CYLINT_HALF_PLANE_MUL 0x1.418p-98
#define CYLINT_THINNEST 0x1p12
#define CYLINT_ROOT_STEP 0x1p-31
#define CYLINT_FEATURE_MARGIN 0x1p-46
#define CYLINT_DISTANCE_LEAST 0x1p-300

/* The error of one operation on triples (tests/test_local_residuals.c). */
#define CYLINT_TRIPLE_ROUNDING 0x1p-150

/*
 * Distances in triples (distance/near_surface.h): fewer than 2^5 operations with
 * an error of CYLINT_TRIPLE_ROUNDING of terms whose sizes are counted there.
 * Points within CYLINT_CLOSE of their size of the surface are served.  Up to
 * CYLINT_CLOSE_MOST no product of lengths in range overflows.  CYLINT_CLOSE_LOSS:
 * the relative error of a few operations on pairs; CYLINT_CLOSE_MARGIN: more than
 * that of a comparison of doubles.
 */
#define CYLINT_CLOSE_ERROR 0x1p-144
#define CYLINT_CLOSE_LOSS 0x1p-90
#define CYLINT_CLOSE_MARGIN 0x1p-40
#define CYLINT_CLOSE 0x1p-20
#define CYLINT_CLOSE_MOST 0x1p64

/*
 * Distances in limbs (distance/limbs.h).  S is a sum of sizes: at least the size
 * |D0| + |D1| + |D2| + height + radii of the question, so no coordinate and no
 * distance is larger.  x + K S - K S, K = CYLINT_LIMB_SNAP, is a multiple of a
 * power of two g > 2^-26 S, and the rest is at most v = 2^-26 S.  So sums of
 * products of two hi are multiples of g^2 below 2^53 g^2, and doubles compute
 * them without error.  The same holds for a hi and a component of a unit vector
 * that is a multiple of 2^-26 (CYLINT_UNIT_SNAP).
 *
 * Errors, in units of u v, u = 2^-53:
 *
 *   lo of D        1 in each coordinate
 *   lo of z        12: 9 of terms that sum up to 2.3 v, 3 of the last sum
 *   lo of D.D      10 size: 2 of D, 4 of products, 4 of sums
 *   D.D - z^2      its lo: the errors of both and 15 size of roundings: 50 size
 *   rest of rho    12 size more; with y^2 of a ball's distance 40 size more
 *   rho            half of that / rho: below 51 thin, thin = size / (2 rho)
 *
 * CYLINT_LIMB_Z, CYLINT_LIMB_SQUARE and CYLINT_LIMB_ACROSS are proved for the lo of
 * z, of D.D, and of D.D - z^2 and the rest of rho alone.  The proofs take each
 * coordinate to be as large as the size, so they are up to three times the above;
 * their sum is still below CYLINT_LIMB_ERROR (tests/prove/ratios.txt).
 *
 * 64 u v (1 + thin) = 2^-73 S (1 + thin) is more than that and the errors of the
 * sums and products that follow; CYLINT_LIMB_ERROR is 2^2 times that.  The root
 * in doubles begins with an error of 12 u size^2 of its square: the second term
 * of the series is below 2^-98 size thin^3, so thin <= CYLINT_LIMB_THINNEST.
 */
#define CYLINT_LIMB_ERROR 0x1p-71
#define CYLINT_LIMB_Z (32.6 * 0x1p-79)
#define CYLINT_LIMB_SQUARE (26.1 * 0x1p-79)
#define CYLINT_LIMB_ACROSS (59.0 * 0x1p-79)
#define CYLINT_LIMB_THINNEST 0x1p12

/*
 * The error of one operation on pairs whose lo can be some ulps of hi, relative
 * to the sizes of its terms, and that of the unit vector of an axis, of cosine
 * and of sine, relative to themselves (distance/certified_point.h).
 */
#define CYLINT_POINT_ROUNDING 0x1p-94
#define CYLINT_POINT_UNDERFLOW 0x1p-800

/*
 * The error of a distance in doubles (distance/safety.c) in rounding to nearest,
 * relative to a size: of a bounded shape the distance plus cylint_reach(),
 * which together are at least |D|; of an infinite one |z| + rho + reach.  Proved;
 * the terms are, in roundings,
 *
 *   z      5 |D|
 *   rho    5 sqrt(2) |D| of x and y, and 2 rho
 *   a cone's lateral line at that position: 3 times the distance from the base's
 *          rim, and 1 of the difference; the last difference
 *
 * The errors of z and rho are at right angles, and a distance from a solid
 * changes by at most that of the position.  In the other rounding modes no
 * rounding is more than twice as large, so twice the error is subtracted.
 *
 * Which feature is nearest follows from the sign of a foot, whose roundings are
 * at most 3 of its distance from the rim.  Where that sign is wrong the true foot
 * is as near to the rim.  The distance is then wrong by half the square of that
 * over the distance.
 *
 * The same of a sphere, relative to the distance plus the radius.  Proved.
 *
 * The squares of the differences of coordinates up to CYLINT_SAFETY_MOST do not
 * overflow.
 */
#define CYLINT_SAFETY_MOST 0x1p500
#define CYLINT_SAFETY_ERROR (15.4 * CYLINT_NEAREST_ROUNDING)
#define CYLINT_SPHERE_SAFETY_ERROR (5.501 * CYLINT_NEAREST_ROUNDING)

/*
 * The errors of distance/elliptic_safety.c in any rounding mode, in units of
 * CYLINT_ROUNDING; all are below 64.
 *
 *   a local coordinate, relative to the norm of the matrix and the sum of |D_i|:
 *       a difference, the entry, a product, two sums: 5; w.e - rho has
 *       three of them, one times the slope, and 4 more roundings
 *   an entry of the matrix A, relative to (norm (1 + |slope|))^2: an entry of B 9,
 *       of b 9 |slope|, of c 9 slope^2; e.Ae 26; the sums for A 10
 *   N, relative to norm (1 + |slope|): 8
 *   W, relative to |w|^2 / det: det 16, the numerator 56; counted twice
 *   a plane n that touches the solid, relative to the sums of |n_i| and of the
 *       sizes of the point and the shape: 16
 */
#define CYLINT_ELLIPTIC_SAFETY_ERROR (64 * CYLINT_ROUNDING)

#endif
