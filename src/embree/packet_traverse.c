/*
 * packet_traverse.c - rays that go together from the first node to the lanes of blocks
 *
 * As traverse.c leads one ray, with the bits of those that may meet a child beside
 * it on the stack.  Boxes and lanes are made of their bytes once for all rays,
 * and what rays wait for they wait for together.  A ray that is left alone in
 * a node goes on by itself.
 */
#include "packet_traverse.h"

#include "../bvh/ray.h"

#ifndef CYLINT_TRAVERSE_PACKET
#define CYLINT_TRAVERSE_PACKET cylint_traverse_packet_plain
#define CYLINT_TRAVERSAL cylint_traversal_plain
#endif

typedef struct {
    uint64_t at;   /* as in traverse.c, of the first of the rays */
    unsigned rays; /* that may meet the child */
} stop;

typedef struct {
    stop stop[CYLINT_BVH_DEPTH * (CYLINT_CHILDREN - 1) + 1];
    int n;
    unsigned active;  /* rays for which it is not enough yet */
    unsigned certain; /* that certainly meet something */
    unsigned fit;     /* see is_fit() */
    unsigned outside; /* that end there, if it is of use: see leaves() */
    way w[CYLINT_PACKET_MOST];
    float o[3][CYLINT_PACKET_MOST], d[3][CYLINT_PACKET_MOST];
    float tnear[CYLINT_PACKET_MOST], tfar[CYLINT_PACKET_MOST],
        E[CYLINT_PACKET_MOST];
    const cylint_bvh *group;
    const cylint_float_ray *const *ray;
    cylint_packet_leaf_callback *meet;
    void *self;
} packet;

#define EACH_RAY(k, rays)                                    \
    for (unsigned k##_of = (rays), k;                        \
         k##_of && (k = (unsigned)cylint_lowest(k##_of), 1); \
         k##_of &= k##_of - 1)

static void finish(packet *p, const cylint_packet_leaf *met)
{
    p->active &= ~p->meet(p->self, met);
    EACH_RAY(k, met->rays)
    {
        p->tfar[k] = p->ray[k]->tfar;
        p->w[k].last = above(&p->w[k], p->tfar[k]);
    }
}

static void be_certain(packet *p, unsigned k)
{
    p->certain |= 1u << k;
    p->active &= ~(1u << k);
}

/* ----------------------------------------------------------------- alone -- */

typedef struct {
    packet *p;
    cylint_packet_leaf met;
    unsigned ray;
} loner;

static int meet_alone(void *self, const cylint_leaf *block, unsigned lanes,
                      const float least[CYLINT_LEAF_SIZE])
{
    loner *l = self;
    l->met.block = block;
    l->met.rays = 1u << l->ray;
    l->met.lanes[l->ray] = lanes;
    memcpy(l->met.least[l->ray], least, sizeof l->met.least[l->ray]);
    finish(l->p, &l->met);
    return !(l->p->active >> l->ray & 1);
}

static void go_alone(packet *p, unsigned k, uint32_t child)
{
    loner l;
    l.p = p;
    l.ray = k;
    if (CYLINT_TRAVERSAL.below(p->group, child, &p->w[k], p->ray[k], meet_alone,
                               &l, p->outside >> k & 1))
        be_certain(p, k);
}

/* ----------------------------------------------------------------- nodes -- */

/* Bits of the children that some ray may meet; for each bits of those rays,
 * and where the first one enters it. */
CYLINT_INLINE unsigned children_met(const cylint_node *node, const packet *p,
                                    unsigned rays,
                                    uint32_t enter[CYLINT_CHILDREN],
                                    uint32_t by[CYLINT_CHILDREN])
{
    const int *entry = p->w[0].entry;
    unsigned met = 0;
    for (int i = 0; i < CYLINT_CHILDREN; i += WIDTH) {
        vf in[3], out[3], first = f_set(HUGE_VALF);
        vi who = i_set(0);
        faces_of(node, i, entry, in, out);
        EACH_RAY(k, rays)
        {
            vf from;
            const vm is = boxes_met(in, out, &p->w[k], &from);
            first = m_select(is, f_lower(from, first), first);
            who = i_or_where(who, is, i_set(1u << k));
            met |= m_bits(is) << i;
        }
        f_store_keys(enter + i, first);
        i_store(by + i, who);
    }
    return met & node->children;
}

/* Keeps those met for later, nearer ones above, but the nearest one, which it
 * returns. */
CYLINT_INLINE stop nearest_of(packet *p, const cylint_node *node, unsigned met,
                              const uint32_t enter[CYLINT_CHILDREN],
                              const uint32_t by[CYLINT_CHILDREN])
{
    const int first = cylint_lowest(met);
    stop *const from = p->stop + p->n, *to = from;
    stop next = {stop_at(enter[first], node->child[first]), by[first]};
    fetch(p->group, (uint32_t)next.at);
    while ((met &= met - 1)) {
        const int i = cylint_lowest(met);
        const stop other = {stop_at(enter[i], node->child[i]), by[i]};
        fetch(p->group, (uint32_t)other.at);
        const stop later = other.at > next.at ? other : next;
        stop *at = to++;
        next = other.at > next.at ? next : other;
        for (; at > from && at[-1].at < later.at; at--)
            at[0] = at[-1];
        *at = later;
    }
    p->n += (int)(to - from);
    return next;
}

/* Those of the rays that are still going when the first one gets there. */
static inline unsigned going(const packet *p, const stop *s)
{
    unsigned rays = 0;
    EACH_RAY(k, s->rays & p->active)
    rays |= (unsigned)(s->at >> 32 <= key_of(p->w[k].last)) << k;
    return rays;
}

static inline int is_one(unsigned rays)
{
    return !(rays & (rays - 1));
}

/* The next block that several rays may meet, and these; or NULL. */
CYLINT_INLINE const cylint_leaf *next_block(packet *p, unsigned *rays)
{
    while (p->n > 0) {
        stop next = p->stop[--p->n];
        next.rays = going(p, &next);
        while (next.rays) {
            const uint32_t child = (uint32_t)next.at;
            if (child & CYLINT_LEAF_FLAG) {
                cylint_visited(blocks, 1);
                *rays = next.rays;
                return &p->group->blocks[child & ~CYLINT_LEAF_FLAG];
            }
            if (is_one(next.rays)) {
                go_alone(p, (unsigned)cylint_lowest(next.rays), child);
                break;
            }
            const cylint_node *node = &p->group->nodes[child];
            uint32_t enter[CYLINT_CHILDREN], by[CYLINT_CHILDREN];
            const unsigned met = children_met(node, p, next.rays, enter, by);
            cylint_visited(nodes, 1);
            if (!met)
                break;
            next = nearest_of(p, node, met, enter, by);
        }
    }
    return NULL;
}

/* ---------------------------------------------------------------- blocks -- */

/* As aim() has it of each ray. */
typedef struct {
    float q[3][CYLINT_PACKET_MOST], k[CYLINT_PACKET_MOST];
    float first[CYLINT_PACKET_MOST], last[CYLINT_PACKET_MOST];
    float t_per_s;
} lines;

/* Returns bits of those for which it is of use. */
CYLINT_INLINE unsigned aim_all(const packet *p, const cylint_leaf *block,
                               unsigned rays, lines *to)
{
    unsigned near = 0;
    to->t_per_s = 1 / cylint_leaf_steps(block);
    for (int i = 0; i < CYLINT_PACKET_MOST; i += WIDTH) {
        ray_lanes r;
        lane_line l;
        if (!(rays >> i & ((1u << WIDTH) - 1)))
            continue;
        EACH(j, 3) {
            r.o[j] = f_load(p->o[j] + i);
            r.d[j] = f_load(p->d[j] + i);
        }
        r.tnear = f_load(p->tnear + i);
        r.tfar = f_load(p->tfar + i);
        r.E = f_load(p->E + i);
        near |= greater(f_set(FAR_LIMIT), aim(block, &r, &l)) << i;
        EACH(j, 3)
            f_store(to->q[j] + i, l.q[j]);
        f_store(to->k + i, l.k);
        f_store(to->first + i, l.first);
        f_store(to->last + i, l.last);
    }
    return near & p->fit;
}

CYLINT_INLINE lane_line line_of(const packet *p, const lines *all, unsigned k)
{
    lane_line l;
    EACH(j, 3) {
        l.q[j] = f_set(all->q[j][k]);
        l.e[j] = f_set(p->d[j][k]);
    }
    l.E = f_set(p->E[k]);
    l.k = f_set(all->k[k]);
    l.first = f_set(all->first[k]);
    l.last = f_set(all->last[k]);
    l.t_per_s = f_set(all->t_per_s);
    return l;
}

/* Which lanes the rays may meet.  Those that are certain of one are done. */
CYLINT_INLINE void look_at(packet *p, const cylint_leaf *block, unsigned rays,
                           cylint_packet_leaf *met)
{
    const int solid = block->used & CYLINT_LEAF_SOLID;
    pieces all[CYLINT_LEAF_SIZE / WIDTH];
    lines lines;
    const unsigned good = aim_all(p, block, rays, &lines);
    for (int i = 0; i < CYLINT_LEAF_SIZE; i += WIDTH)
        all[i / WIDTH] = pieces_of(block, i);
    met->block = block;
    met->rays = 0;
    EACH_RAY(k, rays & good)
    {
        const lane_line l = line_of(p, &lines, k);
        unsigned sure = 0;
        met->lanes[k] = test_near_ray(block, all, &l, met->least[k], NULL);
        if (solid && met->lanes[k] && p->outside >> k & 1)
            test_near_ray(block, all, &l, met->least[k], &sure);
        if (sure)
            be_certain(p, k);
        else
            met->rays |= (unsigned)(met->lanes[k] != 0) << k;
    }
    EACH_RAY(k, rays & ~good)
    {
        met->lanes[k] = test_far_ray(block, p->ray[k], met->least[k]);
        met->rays |= (unsigned)(met->lanes[k] != 0) << k;
    }
}

static void walk_together(packet *p)
{
    const cylint_leaf *block;
    unsigned some;
    p->stop[0] = (stop){stop_at(0, 0), p->active};
    p->n = 1;
    while ((block = next_block(p, &some))) {
        cylint_packet_leaf met;
        look_at(p, block, some, &met);
        if (met.rays)
            finish(p, &met);
    }
}

unsigned CYLINT_TRAVERSE_PACKET(const cylint_bvh *group,
                                const cylint_float_ray *const ray[], int n,
                                int certain, cylint_packet_leaf_callback *meet,
                                void *self)
{
    packet p;
    p.group = group;
    p.ray = ray;
    p.meet = meet;
    p.self = self;
    p.active = (1u << n) - 1;
    p.certain = p.outside = p.fit = 0;
    for (int k = 0; k < n; k++) {
        EACH(j, 3) {
            p.o[j][k] = ray[k]->o[j];
            p.d[j][k] = ray[k]->d[j];
        }
        p.tnear[k] = ray[k]->tnear;
        p.tfar[k] = ray[k]->tfar;
        p.E[k] = size_of(ray[k]);
        p.fit |= (unsigned)is_fit(p.E[k]) << k;
        begin_ray(&p.w[k], group, ray[k]);
        if (certain)
            p.outside |= (unsigned)leaves(group, ray[k]) << k;
    }
    walk_together(&p);
    return p.certain;
}
