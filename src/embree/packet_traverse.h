/*
 * packet_traverse.h - traverses the hierarchy with several rays at once
 */
#ifndef CYLINT_EMBREE_PACKET_TRAVERSE_H
#define CYLINT_EMBREE_PACKET_TRAVERSE_H

#include "../bvh/traverse.h"

enum { CYLINT_PACKET_MOST = 16 };

/* A leaf and the rays (bits) that may hit it; for each of them the lanes (bits)
 * and least[] as in cylint_ray_leaf_callback. */
typedef struct cylint_packet_leaf {
    const cylint_leaf *leaf;
    unsigned rays;
    unsigned lanes[CYLINT_PACKET_MOST];
    float least[CYLINT_PACKET_MOST][CYLINT_LEAF_SIZE];
} cylint_packet_leaf;

/* Gets a leaf; may reduce tfar of its rays.  Returns the rays (bits) that stop
 * here. */
typedef unsigned cylint_packet_leaf_callback(void *self,
                                             const cylint_packet_leaf *hit);

/*
 * Traverses a hierarchy that is not empty with n rays, 1 to CYLINT_PACKET_MOST,
 * that go into the same octant: their d have the same components below 0.
 * certain: returns the rays (bits) that certainly hit some shape; the callback
 * need not get all that these may hit.  Otherwise returns 0.
 */
typedef unsigned cylint_traverse_packet(const cylint_bvh *bvh,
                                        const cylint_float_ray *const ray[],
                                        int n, int certain,
                                        cylint_packet_leaf_callback *callback,
                                        void *self);

/* The build in use. */
cylint_traverse_packet *cylint_traverse_packet_used(void);

/* All builds. */
extern cylint_traverse_packet cylint_traverse_packet_plain,
    cylint_traverse_packet_avx2;

#endif
