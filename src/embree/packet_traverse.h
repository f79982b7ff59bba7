/*
 * packet_traverse.h - which pieces of shapes rays may meet that go together
 */
#ifndef CYLINT_EMBREE_PACKET_TRAVERSE_H
#define CYLINT_EMBREE_PACKET_TRAVERSE_H

#include "../bvh/traverse.h"

enum { CYLINT_PACKET = 16 };

/* Of the rays (bits), in a block: the lanes (bits) that each may meet, and as
 * for cylint_meet_ray. */
typedef struct cylint_met {
    const cylint_block *block;
    unsigned rays;
    unsigned lanes[CYLINT_PACKET];
    float least[CYLINT_PACKET][CYLINT_BLOCK];
} cylint_met;

/* Told of it; may make tfar of these rays less.  Returns those (bits) for which
 * that is enough. */
typedef unsigned cylint_meet_packet(void *self, const cylint_met *met);

/*
 * n rays, 1 to CYLINT_PACKET of them, all of which go into the same octant (d <
 * 0 or not, for each component).  certain: those that certainly meet some shape
 * are not to be asked but returned (bits); else 0 is.  The group is not empty.
 */
typedef unsigned cylint_walk_packet(const cylint_group *group,
                                    const cylint_float_ray *const ray[], int n,
                                    int certain, cylint_meet_packet *meet,
                                    void *self);

/* That for this processor. */
cylint_walk_packet *cylint_packet_used(void);

/* The builds. */
extern cylint_walk_packet cylint_packet_plain, cylint_packet_avx2;

#endif
