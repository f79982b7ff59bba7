/*
 * refit.h - adapts a bounding volume hierarchy to shapes that have moved
 */
#ifndef CYLINT_BVH_REFIT_H
#define CYLINT_BVH_REFIT_H

#include <stdint.h>

#include "bvh.h"

/*
 * Shapes [first, first + n) have moved, within the box of the hierarchy.  Their
 * pieces stay in their lanes; leaves that contain one, and the nodes above these,
 * are bounded again.  No box is larger than a new build over the same leaves would
 * make it, but for one step of a node's faces.
 *
 * extents: memory for cylint_bvh_extents(bvh).
 */
void cylint_bvh_refit(cylint_bvh *bvh, const cylint_view *view, uint32_t first,
                      uint32_t n, cylint_extent *extents);

/* The number of leaves and nodes. */
size_t cylint_bvh_extents(const cylint_bvh *bvh);

/* The mean number of boxes that a random line through the hierarchy's box hits:
 * the sum of their areas divided by that of their box [Goldsmith, Salmon 1987]. */
double cylint_bvh_cost(const cylint_bvh *bvh);

#endif
