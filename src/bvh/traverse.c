/*
 * traverse.c - from the first node to the lanes of blocks
 */
#include "traverse.h"

#include "ray.h"

#ifndef CYLINT_TRAVERSAL
#define CYLINT_TRAVERSAL cylint_traversal_plain
#endif

/* What is still to be visited, the next one last: where it is entered (a key,
 * in the upper half), and which child it is.  As one number, for it cannot be
 * foreseen which is nearer, and what cannot must not be a branch. */
typedef struct {
    uint64_t stop[CYLINT_BVH_DEPTH * (CYLINT_CHILDREN - 1) + 1];
    int n;
} stack;

/* Keeps those met for later, nearer ones above, but the nearest one, which it
 * returns. */
CYLINT_INLINE uint32_t nearest_of(stack *s, const cylint_bvh *group,
                                  const cylint_node *node, unsigned met,
                                  const uint32_t enter[CYLINT_CHILDREN])
{
    const int first = cylint_lowest(met);
    uint64_t *const from = s->stop + s->n, *to = from;
    uint64_t next = stop_at(enter[first], node->child[first]);
    fetch(group, (uint32_t)next);
    while ((met &= met - 1)) {
        const int i = cylint_lowest(met);
        const uint64_t other = stop_at(enter[i], node->child[i]);
        fetch(group, (uint32_t)other);
        uint64_t later = other > next ? other : next, *at = to++;
        next = other > next ? next : other;
        for (; at > from && at[-1] < later; at--)
            at[0] = at[-1];
        *at = later;
    }
    s->n += (int)(to - from);
    return (uint32_t)next;
}

/* Bits of the children that the line may meet, and where it enters them. */
CYLINT_INLINE unsigned children_met(const cylint_node *node, const way *w,
                                    uint32_t enter[CYLINT_CHILDREN])
{
    unsigned met = 0;
    for (int i = 0; i < CYLINT_CHILDREN; i += WIDTH) {
        vf in[3], out[3], from;
        faces_of(node, i, w->entry, in, out);
        met |= m_bits(boxes_met(in, out, w, &from)) << i;
        f_store_keys(enter + i, from);
    }
    return met & node->children;
}

/* The next block, or NULL.  Whoever asks for one before he looks at the last
 * finds that in the cache. */
CYLINT_INLINE const cylint_leaf *next_block(stack *s, const cylint_bvh *group,
                                            const way *w)
{
    while (s->n > 0) {
        const uint64_t next = s->stop[--s->n];
        if (next >> 32 > key_of(w->last))
            continue;
        uint32_t child = (uint32_t)next;
        for (;;) {
            if (child & CYLINT_LEAF_FLAG) {
                cylint_visited(blocks, 1);
                return &group->blocks[child & ~CYLINT_LEAF_FLAG];
            }
            const cylint_node *node = &group->nodes[child];
            uint32_t enter[CYLINT_CHILDREN];
            const unsigned met = children_met(node, w, enter);
            cylint_visited(nodes, 1);
            if (!met)
                break;
            child = nearest_of(s, group, node, met, enter);
        }
    }
    return NULL;
}

static inline void set_out(stack *s, const way *w, uint32_t child)
{
    s->stop[0] = stop_at(key_of(w->first), child);
    s->n = 1;
}

/* From a child on.  A shape that holds a point of a line which ends outside is
 * met behind that point; `certain`: that is enough. */
CYLINT_INLINE int walk_rays(const cylint_bvh *group, uint32_t child, way *w,
                            const cylint_float_ray *ray,
                            cylint_ray_leaf_callback *meet, void *self,
                            int certain)
{
    const float E = size_of(ray);
    const cylint_leaf *block, *next;
    float least[CYLINT_LEAF_SIZE];
    stack s;
    set_out(&s, w, child);
    for (next = next_block(&s, group, w); (block = next);) {
        unsigned sure = 0;
        next = next_block(&s, group, w);
        const unsigned lanes =
            test_ray(block, ray, E, least, certain ? &sure : NULL);
        if (!lanes)
            continue;
        if (sure && block->used & CYLINT_LEAF_SOLID)
            return 1;
        if (meet(self, block, lanes, least))
            return 0;
        w->last = above(w, ray->tfar);
    }
    return 0;
}

static void walk_ray(const cylint_bvh *group, const cylint_float_ray *ray,
                     cylint_ray_leaf_callback *meet, void *self)
{
    way w;
    begin_ray(&w, group, ray);
    walk_rays(group, 0, &w, ray, meet, self, 0);
}

static int walk_shadow(const cylint_bvh *group, const cylint_float_ray *ray,
                       cylint_ray_leaf_callback *meet, void *self)
{
    way w;
    begin_ray(&w, group, ray);
    return walk_rays(group, 0, &w, ray, meet, self, leaves(group, ray));
}

static int walk_below(const cylint_bvh *group, uint32_t child, way *w,
                      const cylint_float_ray *ray,
                      cylint_ray_leaf_callback *meet, void *self, int certain)
{
    return walk_rays(group, child, w, ray, meet, self, certain);
}

static void walk_line(const cylint_bvh *group, const double o[3],
                      const double d[3], double tmin, const double *tmax,
                      cylint_line_leaf_callback *meet, void *self)
{
    const cylint_leaf *block, *next;
    double least[CYLINT_LEAF_SIZE];
    way w;
    stack s;
    begin(&w, group, o, d, tmin, *tmax);
    set_out(&s, &w, 0);
    for (next = next_block(&s, group, &w); (block = next);) {
        next = next_block(&s, group, &w);
        const unsigned lanes = test_line(block, o, d, tmin, *tmax, least);
        if (!lanes)
            continue;
        if (meet(self, block, lanes, least))
            return;
        w.last = above(&w, *tmax);
    }
}

const cylint_traversal CYLINT_TRAVERSAL = {walk_ray, walk_shadow, walk_below,
                                           walk_line};
