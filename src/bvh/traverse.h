/*
 * traverse.h - finds the slices of shapes that a line may hit, or that are within a
 * distance of a point, nearest first
 *
 * From the root down to the leaves by boxes, then by the lanes of leaves.  All
 * tests are conservative: the line certainly does not hit a rejected slice
 * within its domain, wherever the line begins, and no point of a rejected slice
 * is within the distance.
 */
#ifndef CYLINT_BVH_TRAVERSE_H
#define CYLINT_BVH_TRAVERSE_H

#include "bvh.h"

/* The line o + t d, tmin <= t <= tmax.  d has an error of up to 2^-52 of its length
 * (the high parts of a segment's).  Its components are floats, or the largest is
 * about 1. */
typedef struct cylint_bvh_line {
    double o[3], d[3], tmin, tmax;
} cylint_bvh_line;

/*
 * A leaf callback gets the lanes (bits) of a leaf that may be hit; the t of any
 * hit on a lane is at least least[lane].  It may reduce tmax of the line.  It
 * returns 1 to stop the traversal.
 */
typedef int cylint_leaf_callback(void *self, const cylint_leaf *leaf,
                                 unsigned lanes,
                                 const float least[CYLINT_LEAF_SIZE]);

/* The lane with the least bound. */
static inline int cylint_nearest_lane(unsigned lanes,
                                      const float least[CYLINT_LEAF_SIZE])
{
    int lane = cylint_lowest(lanes);
    EACH_BIT(other, lanes & (lanes - 1))
        lane = least[other] < least[lane] ? other : lane;
    return lane;
}

/* Traverses a hierarchy that is not empty with a line.  any: may return 1 if the
 * line certainly hits some shape.  If it returns 0, and the callback did not stop
 * it, the callback got all slices that the line may hit. */
typedef int cylint_traverse_line(const cylint_bvh *bvh,
                                 const cylint_bvh_line *line,
                                 cylint_leaf_callback *callback, void *self,
                                 int any);

/* The same in no order: the callback gets no least[], and boxes beyond a lesser
 * tmax are visited, too.  Returns the number of nodes and leaves that were visited;
 * without a callback (NULL) it only counts these. */
typedef size_t cylint_traverse_all(const cylint_bvh *bvh,
                                   const cylint_bvh_line *line,
                                   cylint_leaf_callback *callback, void *self);

/* Traverses it with a point: the callback gets the lanes that may be within
 * *distance of it; they are at least least[lane] away.  It may reduce the
 * distance, which is at least 0 and may be infinite.  The coordinates of the point
 * are at most CYLINT_POINT_MOST in size, those of the box of all at most 1. */
typedef void cylint_traverse_point(const cylint_bvh *bvh, const double point[3],
                                   const double *distance,
                                   cylint_leaf_callback *callback, void *self);

#define CYLINT_POINT_MOST 0x1p60

typedef struct cylint_traversal {
    cylint_traverse_line *line;
    cylint_traverse_all *all;
    cylint_traverse_point *point;
} cylint_traversal;

/* The build in use. */
const cylint_traversal *cylint_traversal_used(void);

/* All builds, and their functions for points (traverse_point.c): that of AVX-512 is
 * that of AVX2. */
extern const cylint_traversal cylint_traversal_plain, cylint_traversal_avx2,
    cylint_traversal_avx512;
cylint_traverse_point cylint_traverse_point_plain, cylint_traverse_point_avx2;

#endif
