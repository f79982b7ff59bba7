/*
 * traverse_point.h - finds the pieces of shapes within a distance of a point,
 * nearest first
 *
 * The boxes are conservative: no point of a piece outside them is within the
 * distance.  So are the bounds of leaves.
 */
#ifndef CYLINT_BVH_TRAVERSE_POINT_H
#define CYLINT_BVH_TRAVERSE_POINT_H

#include "bvh.h"

/* Gets a leaf, of which the pieces of a lane are at least least[lane] away.  It
 * may reduce the distance.  Returns 1 to stop the traversal. */
typedef int cylint_point_leaf_callback(void *self, const cylint_leaf *leaf,
                                       const double least[CYLINT_LEAF_SIZE]);

/* Traverses a hierarchy that is not empty.  The coordinates of the point are at
 * most CYLINT_POINT_MOST in size, those of the box of all at most 1.  *distance
 * is at least 0 and may be infinite. */
typedef void cylint_traverse_point(const cylint_bvh *bvh, const double point[3],
                                   const double *distance,
                                   cylint_point_leaf_callback *callback,
                                   void *self);

#define CYLINT_POINT_MOST 0x1p60

/* The build in use. */
cylint_traverse_point *cylint_traverse_point_used(void);

/* All builds. */
cylint_traverse_point cylint_traverse_point_plain, cylint_traverse_point_avx2,
    cylint_traverse_point_avx512;

#endif
