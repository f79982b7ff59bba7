/*
 * packet_traverse.c - traverses the hierarchy with several rays at once
 *
 * An entry of the stack also has the bits of the rays that may hit the child.
 * Boxes and cylinders are unpacked once for all rays, and all rays wait for the
 * same memory.
 */
#include "geometry.h"

#include "../bvh/ray.h"

#ifndef CYLINT_PACKET_TRACE
#define CYLINT_PACKET_TRACE cylint_packet_trace_plain
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
    unsigned outside; /* see ends_outside(); 0 unless certain hits are wanted */
    ray_state state[CYLINT_PACKET_MOST];
    float_direction along[CYLINT_PACKET_MOST];
    cylint_ray_test *packet;
} traversal;

/* ----------------------------------------------------------------- nodes -- */

/* Keeps the active rays whose domain reaches the entry. */
CYLINT_INLINE int reach_entry(const traversal *p, entry *e)
{
    unsigned rays = 0;
    EACH_BIT(k, e->rays & p->active) {
        const uint32_t last = p->state[k].last_key;
        rays |= (unsigned)(e->key >> 32 <= last) << k;
    }
    e->rays = rays;
    return rays != 0;
}

CYLINT_INLINE unsigned children_on_rays(const traversal *p, const entry *e,
                                        const cylint_node *node,
                                        child_hits *hits)
{
    const int *near_face = p->state[cylint_lowest(e->rays)].near_face;
    unsigned hit = 0;
    for (int i = 0; i < CYLINT_CHILDREN; i += WIDTH) {
        vf enter[3], leave[3], first = f_set(HUGE_VALF);
        vi rays = i_set(0);
        child_faces(node, i, near_face, enter, leave);
        EACH_BIT(k, e->rays) {
            vf from;
            const vm is = hit_boxes(enter, leave, &p->state[k], &from);
            first = m_select(is, f_lower(from, first), first);
            rays = i_or_where(rays, is, i_set(1u << k));
            hit |= f_bits(is) << i;
        }
        f_store_keys(hits->enter + i, first);
        i_store(hits->rays + i, rays);
    }
    return hit & node->children;
}

CYLINT_INLINE entry packet_entry(const child_hits *hits,
                                 const cylint_node *node, int i)
{
    return (entry){keyed_child(hits->enter[i], node->child[i]), hits->rays[i]};
}

#define IS_NEEDED reach_entry
#define HIT_CHILDREN children_on_rays
#define ENTRY_OF packet_entry
#include "../bvh/traverse_template.h"

/* ---------------------------------------------------------------- leaves -- */

/* Tests rays against a leaf.  Returns those that may hit it.  certain: rays with a
 * certain hit stop. */
CYLINT_INLINE unsigned test_rays(traversal *t, const cylint_leaf *leaf,
                                 unsigned rays, int certain)
{
    cylinders all[CYLINT_LEAF_SIZE / WIDTH];
    unsigned hit = 0, stopped = 0;
    for (int i = 0; i < CYLINT_LEAF_SIZE; i += WIDTH)
        all[i / WIDTH] = cylinders_of(leaf, i);
    EACH_BIT(k, rays) {
        cylint_ray_test *const r = &t->packet[k];
        unsigned sure = 0;
        r->lanes = test_line(leaf, all, &r->q.line, &t->along[k], r->least,
                             certain ? &sure : NULL);
        if (sure && t->outside >> k & 1)
            stopped |= 1u << k;
        else
            hit |= (unsigned)(r->lanes != 0) << k;
    }
    EACH_BIT(k, stopped)
        cylint_record_any(&t->packet[k]);
    t->active &= ~stopped;
    return hit;
}

void CYLINT_PACKET_TRACE(cylint_ray_test *packet, unsigned rays, int certain)
{
    const cylint_bvh *bvh = &packet[cylint_lowest(rays)].data->bvh;
    entry at;
    traversal t;
    t.bvh = bvh;
    t.packet = packet;
    t.stack[0] = (entry){keyed_child(0, 0), rays};
    t.n = 1;
    t.active = rays;
    t.outside = 0;
    EACH_BIT(k, rays) {
        const cylint_bvh_line *line = &packet[k].q.line;
        t.along[k] = float_direction_of(line);
        start_line(&t.state[k], bvh, line);
        if (certain)
            t.outside |= (unsigned)ends_outside(bvh, line) << k;
    }
    while ((at = next_leaf(&t)).key) {
        const cylint_leaf *leaf = leaf_of(&t, at);
        const unsigned hit = t.outside && leaf->used & CYLINT_LEAF_SOLID
                                 ? test_rays(&t, leaf, at.rays, 1)
                                 : test_rays(&t, leaf, at.rays, 0);
        if (!hit)
            continue;
        t.active &= ~cylint_packet_test(packet, leaf, hit);
        EACH_BIT(k, hit)
            shorten(&t.state[k], packet[k].q.line.tmax);
    }
}
