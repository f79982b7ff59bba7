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
 * and, as macros, the functions that are called
 *
 *   IS_NEEDED(t, e)           whether the entry *e, just taken from the stack, may
 *                             still hold the nearest hit
 *   HIT_CHILDREN(t, e, node, hits)
 *                             bits of the children that are hit; writes *hits
 *   ENTRY_OF(hits, node, i)   the entry of child i
 */

/* Returns the nearest of the children that are hit, and pushes the others, the
 * farthest first.  Their order is unpredictable, so the code has conditional
 * moves instead of branches. */
CYLINT_INLINE entry push_children(traversal *t, const cylint_node *node,
                                  unsigned hit, const child_hits *hits)
{
    entry *const from = t->stack + t->n, *to = from;
    entry next = ENTRY_OF(hits, node, cylint_lowest(hit));
    prefetch_child(t->bvh, (uint32_t)next.key);
    while ((hit &= hit - 1)) {
        const entry other = ENTRY_OF(hits, node, cylint_lowest(hit));
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

/* The entry of the next leaf, or one without key. */
CYLINT_INLINE entry next_leaf(traversal *t)
{
    while (t->n > 0) {
        entry next = t->stack[--t->n];
        if (!IS_NEEDED(t, &next))
            continue;
        for (;;) {
            if ((uint32_t)next.key & CYLINT_LEAF_FLAG)
                return next;
            const cylint_node *node = &t->bvh->nodes[(uint32_t)next.key];
            child_hits hits;
            const unsigned hit = HIT_CHILDREN(t, &next, node, &hits);
            if (!hit)
                break;
            next = push_children(t, node, hit, &hits);
        }
    }
    return (entry){0};
}

/* The leaf of such an entry. */
CYLINT_INLINE const cylint_leaf *leaf_of(const traversal *t, entry e)
{
    return &t->bvh->leaves[(uint32_t)e.key & ~CYLINT_LEAF_FLAG];
}

/* The most leaves for which nothing is computed ahead. */
enum { CYLINT_CACHED_LEAVES = 2048 };

/* As next_leaf(), with one leaf ahead if the hierarchy is larger than the caches:
 * its data arrive while the present leaf is tested.  By then it may no longer be
 * needed.  *ahead is its entry, without key before the first. */
CYLINT_INLINE entry take_leaf(traversal *t, entry *ahead)
{
    entry next;
    do {
        next = next_leaf(t);
        if (t->bvh->n_leaves > CYLINT_CACHED_LEAVES) {
            const entry found = next;
            next = *ahead;
            *ahead = found;
        }
    } while (next.key ? !IS_NEEDED(t, &next) : ahead->key != 0);
    return next;
}

#undef IS_NEEDED
#undef HIT_CHILDREN
#undef ENTRY_OF
