/*
 * local.h - the local coordinates of a shape
 *
 * In local coordinates (x, y, z) every shape is upright: its axis is the z
 * axis, its base lies at z = 0, its top at z = height, and its section at z
 * is the circle x^2 + y^2 = (r + slope z)^2.  A point P has the coordinates
 *
 *   (x, y, z) = M (P - base),
 *
 * where the rows of M are
 *
 *   cylinder, cone   unit vectors: two across the axis and one along it
 *   acone            the same divided by |axis|: height = 1
 *   elliptic kinds   the rows of the inverse of (a b h): x and y count
 *                    semi-axes.  The row of z is multiplied by a power of two,
 *                    the height, that makes it about as large as the others.
 *
 * and r is cylint_r0() for all kinds but the round ones.
 *
 * A capsule or round cone has the matrix of a cone.  The cone that touches
 * both balls makes an angle with the axis whose sine is (r1 - r0) / height.  It
 * touches ball i on a circle of radius cosine r_i in the plane that lies sine r_i
 * below the ball's centre.  Its slope is sine / cosine.  So the part between the
 * planes is a cone, z counted from the plane of circle 0.
 *
 * A sphere has the matrix 1.
 */
#ifndef CYLINT_LOCAL_H
#define CYLINT_LOCAL_H

#include "../numbers/bits.h"
#include "../numbers/error_bounds.h"
#include "record.h"

/* A vector is so long that no low part underflows, and no product of its
 * components with those of others does: an entry computed as 0 is 0. */
static inline int cylint_is_long_enough(const double x[3])
{
    return cylint_largest(x) >= CYLINT_LOCAL_LEAST &&
           !cylint_is_small(x[0], CYLINT_LOCAL_TINY) &&
           !cylint_is_small(x[1], CYLINT_LOCAL_TINY) &&
           !cylint_is_small(x[2], CYLINT_LOCAL_TINY);
}

/* Writes the local coordinates (layout.h) and whether they are accurate.  Where
 * they are not, they mean nothing.  _fma: for processors with AVX2 and a fused
 * multiply-add. */
void cylint_measure_local_plain(cylint_shape *shape);
void cylint_measure_local_fma(cylint_shape *shape);

/*
 * Writes a shape for the kernels that decide by signs (filter.h), and for nothing
 * else: without low parts and without the members that hits take.  The kind is
 * cylinder, cone, capsule or round cone.  A constructor has made this shape of
 * the record, and its local coordinates were accurate.
 */
void cylint_local_in_doubles(cylint_shape *shape, int kind, int ends,
                             const cylint_record *from);

#endif
