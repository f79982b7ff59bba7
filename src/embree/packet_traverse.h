/*
 * packet_traverse.h - traverses the hierarchy with several rays at once
 */
#ifndef CYLINT_EMBREE_PACKET_TRAVERSE_H
#define CYLINT_EMBREE_PACKET_TRAVERSE_H

#include <stddef.h>

#include "../bvh/traverse.h"
#include "api.h"

enum { CYLINT_PACKET_MOST = 16 };

/* For each ray k of these bits. */
#define EACH_RAY(k, rays)                                    \
    for (int k##_of = (int)(rays), k;                        \
         k##_of && (k = cylint_lowest((unsigned)k##_of), 1); \
         k##_of &= k##_of - 1)

/* cylint_float_ray has the layout of the first members of RTCRay. */
#define SAME(ours, theirs) \
    (offsetof(cylint_float_ray, ours) == offsetof(struct RTCRay, theirs))
typedef char same_layout[SAME(o[0], org_x) && SAME(o[1], org_y) &&
                                 SAME(o[2], org_z) && SAME(tnear, tnear) &&
                                 SAME(d[0], dir_x) && SAME(d[1], dir_y) &&
                                 SAME(d[2], dir_z) && SAME(tfar, tfar)
                             ? 1
                             : -1];
#undef SAME

static inline const cylint_float_ray *float_ray(const struct RTCRay *ray)
{
    return (const cylint_float_ray *)ray;
}

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
 * that go into the same octant: their d have the same signs, of zeros too.
 * certain: returns the rays (bits) that certainly hit some shape; the callback
 * need not get all that these may hit.  Otherwise returns 0.
 */
typedef unsigned cylint_traverse_packet(const cylint_bvh *bvh,
                                        const struct RTCRayHit ray[], int n,
                                        int certain,
                                        cylint_packet_leaf_callback *callback,
                                        void *self);

/* All builds. */
extern cylint_traverse_packet cylint_traverse_packet_plain,
    cylint_traverse_packet_avx2;

#endif
