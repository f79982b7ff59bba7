/*
 * traverse.c - traverses the hierarchy with one line
 */
#include "traverse.h"

#include "keyed_entry.h"

#ifndef CYLINT_TRAVERSAL
#define CYLINT_TRAVERSAL cylint_traversal_plain
#define CYLINT_TRAVERSE_POINT cylint_traverse_point_plain
#endif

typedef struct {
    const cylint_bvh *bvh;
    const ray_state *ray;
    entry stack[CYLINT_STACK_SIZE];
    int n;
} traversal;

static inline int line_reaches(const traversal *t, const entry *e)
{
    return e->key >> 32 <= t->ray->last_key;
}

CYLINT_INLINE unsigned children_on_line(const ray_state *ray,
                                        const cylint_node *node,
                                        child_hits *hits)
{
    unsigned hit = 0;
    for (int i = 0; i < CYLINT_CHILDREN; i += WIDTH) {
        vf enter[3], leave[3], from;
        child_faces(node, i, ray->near_face, enter, leave);
        hit |= f_bits(hit_boxes(enter, leave, ray, &from)) << i;
        f_store_keys(hits->enter + i, from);
    }
    return hit & node->children;
}

#define IS_NEEDED line_reaches
#define HIT_CHILDREN(t, e, node, hits) children_on_line((t)->ray, node, hits)
#define ENTRY_OF keyed_entry
#include "traverse_template.h"

/* certain: returns 1 at a certain hit.  If the line ends outside the box of all and
 * has a point inside a shape, it hits the shape behind that point. */
CYLINT_INLINE int traverse_as(const cylint_bvh *bvh,
                              const cylint_bvh_line *line,
                              cylint_leaf_callback *callback, void *self,
                              int certain)
{
    const float_direction along = float_direction_of(line);
    entry at, ahead = {0};
    float least[CYLINT_LEAF_SIZE];
    ray_state state;
    traversal t;
    start_line(&state, bvh, line);
    t.bvh = bvh;
    t.ray = &state;
    t.stack[0] = (entry){keyed_child(order_key(state.first), 0)};
    t.n = 1;
    while ((at = take_leaf(&t, &ahead)).key) {
        const cylint_leaf *leaf = leaf_of(&t, at);
        unsigned certain_lanes = 0;
        const unsigned lanes = test_line(leaf, NULL, line, &along, least,
                                         certain ? &certain_lanes : NULL);
        if (!lanes)
            continue;
        if (certain_lanes && leaf->used & CYLINT_LEAF_SOLID)
            return 1;
        if (callback(self, leaf, lanes, least))
            return 0;
        shorten(&state, line->tmax);
    }
    return 0;
}

static int traverse_line(const cylint_bvh *bvh, const cylint_bvh_line *line,
                         cylint_leaf_callback *callback, void *self, int any)
{
    return any && ends_outside(bvh, line)
               ? traverse_as(bvh, line, callback, self, 1)
               : traverse_as(bvh, line, callback, self, 0);
}

/* ----------------------------------------------------------- in no order -- */

/* The most nodes that are visited together, the least leaves that are tested
 * together, and the most children of those nodes. */
enum { AHEAD = 16, LEAVES = 32, MOST_PUSHED = AHEAD * CYLINT_CHILDREN };

/*
 * So that loads overlap, the last AHEAD nodes of the stack are visited together,
 * and leaves wait until there are LEAVES of them.
 *
 * The levels of nodes do not decrease from the bottom of the stack to its top: the
 * nodes of a batch are visited from its bottom, and their children are one level
 * deeper.  So when nodes of some level are pushed, the others of that level, which
 * lay above their parents, were taken with these: at most MOST_PUSHED nodes of each
 * level are on the stack.  i_keep() writes up to KEPT numbers beyond.
 */
enum { KEPT = CYLINT_CHILDREN + 2 };

typedef struct {
    const cylint_bvh *bvh;
    uint32_t stack[MOST_PUSHED * CYLINT_BVH_DEPTH + KEPT];
    uint32_t leaves[LEAVES + MOST_PUSHED + KEPT];
    int n, n_leaves;
} waiting;

/* Adds the children with these bits to those that wait, and returns how many they
 * are.  i_keep() writes two zeros after them, and node 0 and leaf 0 exist: so two
 * are prefetched without a branch. */
CYLINT_INLINE int keep_children(const cylint_bvh *bvh, uint32_t *to,
                                const cylint_node *node, unsigned bits,
                                uint32_t flag)
{
    const int n = i_keep(to, node->child, bits);
    EACH(k, 2)
        prefetch_child(bvh, to[k] | flag);
    for (int k = 2; k < n; k++)
        prefetch_child(bvh, to[k] | flag);
    return n;
}

/* Takes the last nodes and puts their children there.  Returns how many it took. */
static inline int visit_nodes(waiting *w, const ray_state *state)
{
    const int taken = w->n < AHEAD ? w->n : AHEAD;
    uint32_t batch[AHEAD];
    int n = w->n - taken, n_leaves = w->n_leaves; /* in registers */
    memcpy(batch, w->stack + n, (size_t)taken * sizeof *batch);
    for (int i = 0; i < taken; i++) {
        const cylint_node *node = &w->bvh->nodes[batch[i]];
        child_hits hits;
        const unsigned hit = children_on_line(state, node, &hits);
        const unsigned leaves = node->leaves & hit;
        n += keep_children(w->bvh, w->stack + n, node, hit & ~leaves, 0);
        n_leaves += keep_children(w->bvh, w->leaves + n_leaves, node, leaves,
                                  CYLINT_LEAF_FLAG);
    }
    w->n = n;
    w->n_leaves = n_leaves;
    return taken;
}

static size_t traverse_all(const cylint_bvh *bvh, const cylint_bvh_line *line,
                           cylint_leaf_callback *callback, void *self)
{
    const float_direction along = float_direction_of(line);
    size_t visited = 0;
    ray_state state;
    waiting w;
    start_line(&state, bvh, line);
    w.bvh = bvh;
    w.stack[0] = 0;
    w.n = 1;
    w.n_leaves = 0;
    while (w.n > 0) {
        visited += (size_t)visit_nodes(&w, &state);
        if (w.n > 0 && w.n_leaves < LEAVES)
            continue;
        visited += (size_t)w.n_leaves;
        for (int i = 0; callback && i < w.n_leaves; i++) {
            const cylint_leaf *leaf =
                &bvh->leaves[w.leaves[i] & ~CYLINT_LEAF_FLAG];
            const unsigned lanes =
                test_line(leaf, NULL, line, &along, NULL, NULL);
            if (lanes && callback(self, leaf, lanes, NULL))
                return visited;
        }
        w.n_leaves = 0;
    }
    return visited;
}

const cylint_traversal CYLINT_TRAVERSAL = {traverse_line, traverse_all,
                                           CYLINT_TRAVERSE_POINT};
