/*
 * keyed_entry.h - the entries of traverse_template.h, for one ray or point
 */
#ifndef CYLINT_BVH_KEYED_ENTRY_H
#define CYLINT_BVH_KEYED_ENTRY_H

#include "ray.h"

/* A node or leaf that is not visited yet: keyed_child() of where it is entered,
 * or of its lower bound. */
typedef struct {
    uint64_t key;
} entry;

typedef struct {
    uint32_t enter[CYLINT_CHILDREN];
} child_hits;

CYLINT_INLINE entry keyed_entry(const child_hits *hits, const cylint_node *node,
                                int i)
{
    return (entry){keyed_child(hits->enter[i], node->child[i])};
}

#endif
