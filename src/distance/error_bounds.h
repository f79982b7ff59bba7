/*
 * error_bounds.h - the constants on which a decision about a distance depends,
 * with their reasons (see numbers/error_bounds.h)
 */
#ifndef CYLINT_DISTANCE_ERROR_BOUNDS_H
#define CYLINT_DISTANCE_ERROR_BOUNDS_H

#include "../numbers/error_bounds.h"

/*
 * Distances in pairs (distance/pair_lanes.h).  S is |D0| + |D1| + |D2|, D the
 * point from the base.
 *
 *   CYLINT_PAIR_SUM       of D.w relative to S.  Proved
 *   CYLINT_PAIR_PRODUCT   of a product, relative to the sizes of its factors,
 *                         whose low parts can be some ulps.  Proved
 *   CYLINT_PAIR_ROOT      of a root, relative to it.  Proved
 *   CYLINT_POINT_ROUNDING more than that of the unit vector of an axis, of
 *                         cosine, sine, height and the top radius of an angle
 *                         cone, relative to themselves, and of z to S
 *   CYLINT_PAIR_DISTANCE  what a distance has besides the errors of z and rho,
 *                         relative to S and the reach of the shape
 *   CYLINT_PAIR_QUOTIENT  of a component of a direction, relative to it
 *   CYLINT_PAIR_PLACE     of a coordinate of the point, from that of its origin
 *
 * The sums are in tests/bounds/prove/ratios.txt;
 * tests/bounds/test_distance_bounds.c compares z, rho and rims with exact numbers.
 *
 * A combination of the high parts in doubles has fewer than 8 roundings of
 * terms of at most S or a length of the shape; CYLINT_FEATURE_MARGIN is 2^3
 * times more.  Distances below CYLINT_DISTANCE_LEAST are left to exact
 * numbers: above it no underflow is larger than the bound.
 */
#define CYLINT_PAIR_SUM 0x1.28p-101
#define CYLINT_PAIR_PRODUCT 0x1.a22p-99
#define CYLINT_PAIR_ROOT 0x1.4a1p-102
#define CYLINT_POINT_ROUNDING 0x1p-94
#define CYLINT_PAIR_DISTANCE 0x1p-92
#define CYLINT_PAIR_QUOTIENT 0x1p-97
#define CYLINT_PAIR_PLACE 0x1p-104
#define CYLINT_FEATURE_MARGIN 0x1p-46
#define CYLINT_DISTANCE_LEAST 0x1p-300

/* The error of one operation on triples (tests/bounds/test_local_residuals.c). */
#define CYLINT_TRIPLE_ROUNDING 0x1p-150

/*
 * Distances in triples (near_surface.h, elliptic_pairs.h): CYLINT_CLOSE_ERROR times
 * the sizes of terms that are counted there, with these factors
 * (tests/bounds/test_local_residuals.c).
 * Points within CYLINT_CLOSE of their size of the surface are served.  Up to
 * CYLINT_CLOSE_MOST no product of lengths in range overflows.  CYLINT_CLOSE_LOSS:
 * the relative error of a few operations on pairs.  CYLINT_NEEDS_DIRECTION: the
 * relative error of rho for which triples compute the direction from the axis; it
 * affects only the speed.
 */
#define CYLINT_CLOSE_ERROR 0x1p-144
#define CYLINT_CLOSE_LOSS 0x1p-90
#define CYLINT_CLOSE 0x1p-20
#define CYLINT_CLOSE_MOST 0x1p64
#define CYLINT_NEEDS_DIRECTION 0x1p-60
enum { CYLINT_CLOSE_SQUARES = 4, CYLINT_CLOSE_DIRECTION = 4 };

/*
 * Distances with heads and tails (distance/head_tail.h).  S is a sum of sizes:
 * at least the size |D0| + |D1| + |D2| + height + radii of the question, so no
 * coordinate and no distance is larger.  x + K S - K S, K = CYLINT_SNAP, is a
 * multiple of a power of two g > 2^-26 S, and the tail is at most v = 2^-26 S.
 * So sums of products of two heads are multiples of g^2 below 2^53 g^2, and
 * doubles compute them without error.  The same holds for a head and a
 * component of a unit vector that is a multiple of 2^-26 (CYLINT_UNIT_SNAP).
 *
 * Errors, in units of u v, u = 2^-53:
 *
 *   lo of D        1 in each coordinate
 *   lo of z        14: 10 of terms that sum up to 2.3 v, 4 of their sums
 *   lo of D.D      10 size: 2 of D, 4 of products, 4 of sums
 *   D.D - z^2      its lo: the errors of both and 15 size of roundings: 50 size
 *   residual       of the root rho: 12 size more; with y^2 of a ball's distance
 *                  40 size more
 *   rho            half of that / rho: below 51 thin, thin = size / (2 rho)
 *
 * CYLINT_HEAD_TAIL_Z, CYLINT_HEAD_TAIL_SQUARE and CYLINT_HEAD_TAIL_ACROSS are
 * proved for the lo of z, of D.D, and of D.D - z^2 and the residual alone.
 * The proofs take each coordinate to be as large as the size, so they are up
 * to three times the above; their sum is still below CYLINT_HEAD_TAIL_ERROR
 * (tests/bounds/prove/ratios.txt).
 *
 * 64 u v (1 + thin) = 2^-73 S (1 + thin) is more than that and the errors of the
 * sums and products that follow; CYLINT_HEAD_TAIL_ERROR is 2^2 times that.  The
 * root in doubles begins with an error of 17 u size^2 of its square: the second
 * term of the series is below 2^-97 size thin^3, so thin <=
 * CYLINT_HEAD_TAIL_THINNEST. Where thin is larger, rho is below 2^-13 S and its
 * error counts as infinite.  Of a round cone only a ball whose foot is more than
 * CYLINT_AXIS_MARGIN S from its circle is then certain.
 */
#define CYLINT_SNAP 0x1p27
#define CYLINT_UNIT_SNAP 0x1.8p26
#define CYLINT_HEAD_TAIL_ERROR 0x1p-71
#define CYLINT_HEAD_TAIL_Z (34.51 * 0x1p-79)
#define CYLINT_HEAD_TAIL_SQUARE (26.1 * 0x1p-79)
#define CYLINT_HEAD_TAIL_ACROSS (59.0 * 0x1p-79)
#define CYLINT_HEAD_TAIL_THINNEST 0x1p12
#define CYLINT_AXIS_MARGIN 0x1p-10

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
 * changes by at most that of the position.
 *
 * Which feature is nearest follows from the sign of a foot, whose roundings are
 * at most 3 of its distance from the rim.  Where that sign is wrong the true foot
 * is as near to the rim.  The distance is then wrong by half the square of that
 * over the distance.
 *
 * CYLINT_SPHERE_SAFETY_ERROR: the same of a sphere, relative to the distance plus
 * the radius.  Proved.
 */
#define CYLINT_SAFETY_ERROR (15.4 * CYLINT_NEAREST_ROUNDING)
#define CYLINT_SPHERE_SAFETY_ERROR (5.501 * CYLINT_NEAREST_ROUNDING)

/*
 * Elliptic kinds.
 *
 *   CYLINT_SIZED_ERROR      of a sum of products in pairs (elliptic_pairs.h),
 *                           relative to the sizes of its terms: a term passes at
 *                           most 10 products, with CYLINT_PAIR_PRODUCT each, and
 *                           sums, whose errors are smaller
 *   CYLINT_NEEDS_TRIPLES    n / rho of the lateral surface for which pairs do not
 *                           suffice: it affects only the speed
 *   CYLINT_ELLIPTIC_SAFETY_ERROR
 *                           in any rounding mode: of a local coordinate from the
 *                           matrix in doubles, relative to the norm of the matrix
 *                           and the sum of |D_i|, with a difference, the entry, a
 *                           product and two sums: 5 roundings; (x, y).e - rho has
 *                           three of them, one times the slope, and 4 more; N and a
 *                           root 8
 *   CYLINT_ELLIPTIC_ERROR   the same in rounding to nearest: each rounding is half
 *                           as large
 *
 * No length is above CYLINT_ELLIPTIC_MOST, and where points and normals are wanted
 * components are 0 or at least CYLINT_ELLIPTIC_LEAST: no term over- or underflows.
 */
#define CYLINT_ELLIPTIC_SAFETY_ERROR (64 * CYLINT_ROUNDING)
#define CYLINT_ELLIPTIC_ERROR (16 * CYLINT_NEAREST_ROUNDING)
#define CYLINT_SIZED_ERROR 0x1p-94
#define CYLINT_NEEDS_TRIPLES 0x1p-36
#define CYLINT_ELLIPTIC_LEAST 0x1p-100
#define CYLINT_ELLIPTIC_MOST 0x1p100

#endif
