/*
 * traverse.c - traverses the hierarchy with one ray or line
 */
#include "traverse.h"

#include "keyed_entry.h"

#ifndef CYLINT_TRAVERSAL
#define CYLINT_TRAVERSAL cylint_traversal_plain
#endif

typedef struct {
    const cylint_bvh *bvh;
    const ray_state *ray;
    entry stack[CYLINT_STACK_SIZE];
    int n;
} traversal;

static inline int is_needed(const traversal *t, const entry *e)
{
    return e->key >> 32 <= order_key(t->ray->last);
}

CYLINT_INLINE unsigned hit_children(const traversal *t, const entry *e,
                                    const cylint_node *node, child_hits *hits)
{
    unsigned hit = 0;
    (void)e;
    for (int i = 0; i < CYLINT_CHILDREN; i += WIDTH) {
        vf enter[3], leave[3], from;
        child_faces(node, i, t->ray->near_faces, enter, leave);
        hit |= m_bits(hit_boxes(enter, leave, t->ray, &from)) << i;
        f_store_keys(hits->enter + i, from);
    }
    return hit & node->children;
}

#define IS_DONE_ALONE(t, e) 0
#include "traverse_template.h"

static inline void push_start(traversal *t, const cylint_bvh *bvh,
                              const ray_state *ray, uint32_t child)
{
    t->bvh = bvh;
    t->ray = ray;
    t->stack[0] = (entry){keyed_child(order_key(ray->first), child)};
    t->n = 1;
}

/* Starts at `child`.  certain: return 1 at a certain hit.  If the line ends
 * outside the box of all and has a point inside a shape, it hits the shape behind
 * that point. */
CYLINT_INLINE int traverse_from(const cylint_bvh *bvh, uint32_t child,
                                ray_state *state, const cylint_float_ray *ray,
                                cylint_ray_leaf_callback *callback, void *self,
                                int certain)
{
    const float E = size_of(ray);
    const cylint_leaf *leaf, *next;
    float least[CYLINT_LEAF_SIZE];
    traversal t;
    entry at;
    push_start(&t, bvh, state, child);
    for (next = next_leaf(&t, &at); (leaf = next);) {
        unsigned certain_lanes = 0;
        next = next_leaf(&t, &at);
        const unsigned lanes =
            test_ray(leaf, ray, E, least, certain ? &certain_lanes : NULL);
        if (!lanes)
            continue;
        if (certain_lanes && leaf->used & CYLINT_LEAF_SOLID)
            return 1;
        if (callback(self, leaf, lanes, least))
            return 0;
        shorten(state, ray->tfar);
    }
    return 0;
}

static void traverse_ray(const cylint_bvh *bvh, const cylint_float_ray *ray,
                         cylint_ray_leaf_callback *callback, void *self)
{
    ray_state state;
    start_ray(&state, bvh, ray);
    traverse_from(bvh, 0, &state, ray, callback, self, 0);
}

static int traverse_occluded(const cylint_bvh *bvh, const cylint_float_ray *ray,
                             cylint_ray_leaf_callback *callback, void *self)
{
    ray_state state;
    start_ray(&state, bvh, ray);
    return traverse_from(bvh, 0, &state, ray, callback, self,
                         ends_outside(bvh, ray));
}

static int traverse_subtree(const cylint_bvh *bvh, uint32_t child,
                            ray_state *state, const cylint_float_ray *ray,
                            cylint_ray_leaf_callback *callback, void *self,
                            int certain)
{
    return traverse_from(bvh, child, state, ray, callback, self, certain);
}

static void traverse_line(const cylint_bvh *bvh, const double o[3],
                          const double d[3], double tmin, const double *tmax,
                          cylint_line_leaf_callback *callback, void *self)
{
    const cylint_leaf *leaf, *next;
    double least[CYLINT_LEAF_SIZE];
    ray_state state;
    traversal t;
    entry at;
    start_line(&state, bvh, o, d, tmin, *tmax);
    push_start(&t, bvh, &state, 0);
    for (next = next_leaf(&t, &at); (leaf = next);) {
        next = next_leaf(&t, &at);
        const unsigned lanes = test_line(leaf, o, d, tmin, *tmax, least);
        if (!lanes)
            continue;
        if (callback(self, leaf, lanes, least))
            return;
        state.last = local_above(&state, *tmax);
    }
}

/* Nodes that are visited together, leaves that are, and the most children of such
 * nodes. */
enum { AHEAD = 16, LEAVES = 32, MOST_PUSHED = AHEAD * CYLINT_CHILDREN };

/*
 * In no order, so that loads overlap: the last AHEAD nodes of the stack are visited
 * together, and leaves wait until there are LEAVES of them.
 *
 * The levels of nodes do not decrease from the bottom of the stack to its top: the
 * nodes of a batch are visited from its bottom, and their children are one level
 * deeper.  So when nodes of some level are pushed, the others of that level, which
 * lay above their parents, were taken with these: at most MOST_PUSHED nodes of each
 * level are on the stack.
 */
static void traverse_all(const cylint_bvh *bvh, const double o[3],
                         const double d[3], double tmin, const double *tmax,
                         cylint_line_leaf_callback *callback, void *self)
{
    uint32_t stack[MOST_PUSHED * CYLINT_BVH_DEPTH], batch[AHEAD];
    uint32_t leaves[LEAVES + MOST_PUSHED];
    double least[CYLINT_LEAF_SIZE];
    ray_state state;
    traversal t;
    int n = 1, n_leaves = 0;
    start_line(&state, bvh, o, d, tmin, *tmax);
    t.ray = &state;
    stack[0] = 0;
    while (n > 0) {
        const int taken = n < AHEAD ? n : AHEAD;
        n -= taken;
        memcpy(batch, stack + n, (size_t)taken * sizeof *stack);
        for (int i = 0; i < taken; i++) {
            const cylint_node *node = &bvh->nodes[batch[i]];
            child_hits hits;
            unsigned hit = hit_children(&t, NULL, node, &hits);
            for (; hit; hit &= hit - 1) {
                const uint32_t child = node->child[cylint_lowest(hit)];
                const int is_leaf = child >= CYLINT_LEAF_FLAG;
                prefetch_child(bvh, child);
                leaves[n_leaves] = child & ~CYLINT_LEAF_FLAG;
                stack[n] = child;
                n_leaves += is_leaf;
                n += !is_leaf;
            }
        }
        if (n > 0 && n_leaves < LEAVES)
            continue;
        for (int i = 0; i < n_leaves; i++) {
            const cylint_leaf *leaf = &bvh->leaves[leaves[i]];
            const unsigned lanes = test_line(leaf, o, d, tmin, *tmax, least);
            if (lanes && callback(self, leaf, lanes, least))
                return;
        }
        n_leaves = 0;
    }
}

const cylint_traversal CYLINT_TRAVERSAL = {traverse_ray, traverse_occluded,
                                           traverse_subtree, traverse_line,
                                           traverse_all};
