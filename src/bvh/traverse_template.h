/*
 * traverse_template.h - one step of a traversal, for one ray or for a packet
 *
 * Included once by each file that traverses.  Before, that file defines
 *
 *   entry       a struct with the member `key`, see keyed_child(), for a
 *               node or leaf that is not visited yet
 *   child_hits  where the children of a node are entered, and by which rays
 *   traversal   a struct with the members `bvh`, `stack` (an array of entry
 *               with CYLINT_STACK_SIZE elements) and `n`, its length
 *
 * and the functions
 *
 *   int is_needed(traversal *, entry *)   whether the entry, just taken from
 *                                         the stack, may still hold the
 *                                         nearest hit
 *   unsigned hit_children(const traversal *, const entry *,
 *                         const cylint_node *, child_hits *)
 *                                         bits of the children that are hit
 *   entry entry_of(const child_hits *, const cylint_node *, int i)
 */

/* Returns the nearest of the children that are hit, and pushes the others, the
 * farthest first.  Their order is unpredictable, so the code has conditional
 * moves instead of branches. */
CYLINT_INLINE entry push_children(traversal *t, const cylint_node *node,
                                  unsigned hit, const child_hits *hits)
{
    entry *const from = t->stack + t->n, *to = from;
    entry next = entry_of(hits, node, cylint_lowest(hit));
    prefetch_child(t->bvh, (uint32_t)next.key);
    while ((hit &= hit - 1)) {
        const entry other = entry_of(hits, node, cylint_lowest(hit));
        prefetch_child(t->bvh, (uint32_t)other.key);
        const entry later = other.key > next.key ? other : next;
        entry *at = to++;
        next = other.key > next.key ? next : other;
        for (; at > from && at[-1].key < later.key; at--)
            at[0] = at[-1];
        *at = later;
    }
    t->n += (int)(to - from);
    return next;
}

/* The next leaf, with its entry in *at, or NULL. */
CYLINT_INLINE const cylint_leaf *next_leaf(traversal *t, entry *at)
{
    while (t->n > 0) {
        entry next = t->stack[--t->n];
        if (!is_needed(t, &next))
            continue;
        for (;;) {
            const uint32_t child = (uint32_t)next.key;
            if (child & CYLINT_LEAF_FLAG) {
                *at = next;
                return &t->bvh->leaves[child & ~CYLINT_LEAF_FLAG];
            }
            const cylint_node *node = &t->bvh->nodes[child];
            child_hits hits;
            const unsigned hit = hit_children(t, &next, node, &hits);
            if (!hit)
                break;
            next = push_children(t, node, hit, &hits);
        }
    }
    return NULL;
}

/* The leaf after the present one, of a hierarchy that is larger than the caches.
 * It is computed before the present one is tested: so its data arrive meanwhile.
 * By then it may no longer be needed. */
typedef struct {
    const cylint_leaf *leaf; /* or NULL */
    entry at;
} leaf_ahead;

/* The most leaves for which nothing is computed ahead. */
enum { CYLINT_CACHED_LEAVES = 2048 };

/* The next leaf, or NULL.  *ahead has no leaf before the first. */
CYLINT_INLINE const cylint_leaf *take_leaf(traversal *t, leaf_ahead *ahead)
{
    leaf_ahead next;
    do {
        leaf_ahead found = {NULL, {0}};
        found.leaf = next_leaf(t, &found.at);
        next = found;
        if (t->bvh->n_leaves > CYLINT_CACHED_LEAVES) {
            next = *ahead;
            *ahead = found;
        }
    } while (next.leaf ? !is_needed(t, &next.at) : ahead->leaf != NULL);
    return next.leaf;
}
