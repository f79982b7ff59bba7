/*
 * packet_traverse.c - traverses the hierarchy with several rays at once
 *
 * An entry of the stack also has the bits of the rays that may hit the child.
 * Boxes and cylinders are unpacked once for all rays, and all rays wait for the
 * same memory.
 */
#include "packet_traverse.h"

#include "../bvh/ray.h"

#ifndef CYLINT_TRAVERSE_PACKET
#define CYLINT_TRAVERSE_PACKET cylint_traverse_packet_plain
#endif

typedef struct {
    uint64_t key;  /* of the ray that enters the child first */
    unsigned rays; /* that may hit the child */
} entry;

/* Where the first ray enters each child, and the rays that may hit it. */
typedef struct {
    uint32_t enter[CYLINT_CHILDREN], rays[CYLINT_CHILDREN];
} child_hits;

typedef struct {
    const cylint_bvh *bvh;
    entry stack[CYLINT_STACK_SIZE];
    int n;
    /* bits of rays: */
    unsigned active;  /* not stopped yet */
    unsigned certain; /* certainly hit some shape */
    unsigned outside; /* see ends_outside(); 0 unless certain hits are wanted */
    ray_state state[CYLINT_PACKET_MOST];
    float E[CYLINT_PACKET_MOST]; /* size_of() each ray */
    const struct RTCRayHit *ray;
    cylint_packet_leaf_callback *callback;
    void *self;
} traversal;

/* ----------------------------------------------------------------- nodes -- */

/* Keeps the active rays whose domain reaches the entry. */
CYLINT_INLINE int is_needed(const traversal *p, entry *e)
{
    unsigned rays = 0;
    EACH_RAY(k, e->rays & p->active) {
        const uint32_t last = order_key(p->state[k].last);
        rays |= (unsigned)(e->key >> 32 <= last) << k;
    }
    e->rays = rays;
    return rays != 0;
}

CYLINT_INLINE unsigned hit_children(const traversal *p, const entry *e,
                                    const cylint_node *node, child_hits *hits)
{
    const int *face = p->state[0].near_faces;
    unsigned hit = 0;
    for (int i = 0; i < CYLINT_CHILDREN; i += WIDTH) {
        vf enter[3], leave[3], first = f_set(HUGE_VALF);
        vi rays = i_set(0);
        child_faces(node, i, face, enter, leave);
        EACH_RAY(k, e->rays) {
            vf from;
            const vm is = hit_boxes(enter, leave, &p->state[k], &from);
            first = m_select(is, f_lower(from, first), first);
            rays = i_or_where(rays, is, i_set(1u << k));
            hit |= m_bits(is) << i;
        }
        f_store_keys(hits->enter + i, first);
        i_store(hits->rays + i, rays);
    }
    return hit & node->children;
}

CYLINT_INLINE entry entry_of(const child_hits *hits, const cylint_node *node,
                             int i)
{
    return (entry){keyed_child(hits->enter[i], node->child[i]), hits->rays[i]};
}

#include "../bvh/traverse_template.h"

/* ---------------------------------------------------------------- leaves -- */

/* Tests the rays against the leaf.  wanted: rays with a certain hit stop. */
CYLINT_INLINE void test_rays(traversal *p, const cylint_leaf *leaf,
                             unsigned rays, int wanted, cylint_packet_leaf *hit)
{
    cylinders all[CYLINT_LEAF_SIZE / WIDTH];
    for (int i = 0; i < CYLINT_LEAF_SIZE; i += WIDTH)
        all[i / WIDTH] = cylinders_of(leaf, i);
    hit->leaf = leaf;
    hit->rays = 0;
    EACH_RAY(k, rays) {
        unsigned certain = 0;
        hit->lanes[k] = test_ray(leaf, all, float_ray(&p->ray[k].ray), p->E[k],
                                 hit->least[k], wanted ? &certain : NULL);
        if (certain && p->outside >> k & 1)
            p->certain |= 1u << k;
        else
            hit->rays |= (unsigned)(hit->lanes[k] != 0) << k;
    }
}

static void traverse(traversal *p)
{
    const cylint_leaf *leaf;
    entry at;
    p->stack[0] = (entry){keyed_child(0, 0), p->active};
    p->n = 1;
    while ((leaf = next_leaf(p, &at))) {
        cylint_packet_leaf hit;
        if (p->outside && leaf->used & CYLINT_LEAF_SOLID)
            test_rays(p, leaf, at.rays, 1, &hit);
        else
            test_rays(p, leaf, at.rays, 0, &hit);
        p->active &= ~p->certain;
        if (!hit.rays)
            continue;
        p->active &= ~p->callback(p->self, &hit);
        EACH_RAY(k, hit.rays)
            shorten(&p->state[k], p->ray[k].ray.tfar);
    }
}

unsigned CYLINT_TRAVERSE_PACKET(const cylint_bvh *bvh,
                                const struct RTCRayHit ray[], int n,
                                int certain,
                                cylint_packet_leaf_callback *callback,
                                void *self)
{
    traversal p;
    p.bvh = bvh;
    p.ray = ray;
    p.callback = callback;
    p.self = self;
    p.active = (1u << n) - 1;
    p.certain = p.outside = 0;
    for (int k = 0; k < n; k++) {
        p.E[k] = size_of(float_ray(&ray[k].ray));
        start_ray(&p.state[k], bvh, float_ray(&ray[k].ray));
        if (certain)
            p.outside |= (unsigned)ends_outside(bvh, float_ray(&ray[k].ray))
                         << k;
    }
    traverse(&p);
    return p.certain;
}
