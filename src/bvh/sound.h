/*
 * sound.h - whether a hierarchy from a file can be traversed
 */
#ifndef CYLINT_BVH_SOUND_H
#define CYLINT_BVH_SOUND_H

#include "bvh.h"

/*
 * Whether the nodes and leaves form a tree as cylint_bvh_build() makes it: each is
 * in it once, in this order, no path is longer than CYLINT_BVH_DEPTH, all numbers
 * of shapes are less than n, and all floats are finite.  Then a traversal ends, and
 * reads nothing outside.  The boxes are not compared with the shapes.
 */
int cylint_bvh_is_sound(const cylint_bvh *bvh, size_t n);

#endif
