/*
 * packet_traverse.h - which pieces of shapes rays may meet that go together
 */
#ifndef CYLINT_EMBREE_PACKET_TRAVERSE_H
#define CYLINT_EMBREE_PACKET_TRAVERSE_H

#include "../bvh/traverse.h"

enum { CYLINT_PACKET_MOST = 16 };

/* Of the rays (bits), in a block: the lanes (bits) that each may meet, and as
 * for cylint_ray_leaf_callback. */
typedef struct cylint_packet_leaf {
    const cylint_leaf *block;
    unsigned rays;
    unsigned lanes[CYLINT_PACKET_MOST];
    float least[CYLINT_PACKET_MOST][CYLINT_LEAF_SIZE];
} cylint_packet_leaf;

/* Told of it; may make tfar of these rays less.  Returns those (bits) for which
 * that is enough. */
typedef unsigned cylint_packet_leaf_callback(void *self,
                                             const cylint_packet_leaf *met);

/*
 * n rays, 1 to CYLINT_PACKET_MOST of them, all of which go into the same octant (d <
 * 0 or not, for each component).  certain: those that certainly meet some shape
 * are not to be asked but returned (bits); else 0 is.  The group is not empty.
 */
typedef unsigned cylint_traverse_packet(const cylint_bvh *group,
                                        const cylint_float_ray *const ray[],
                                        int n, int certain,
                                        cylint_packet_leaf_callback *meet,
                                        void *self);

/* That for this processor. */
cylint_traverse_packet *cylint_traverse_packet_used(void);

/* The builds. */
extern cylint_traverse_packet cylint_traverse_packet_plain,
    cylint_traverse_packet_avx2;

#endif
