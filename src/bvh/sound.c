/*
 * sound.c - whether a hierarchy from a file can be traversed
 */
#include "bvh.h"

#include <float.h>
#include <math.h>

static int are_finite(const float x[3])
{
    int finite = 1;
    for (int i = 0; i < 3; i++)
        finite &= fabsf(x[i]) <= FLT_MAX;
    return finite;
}

static int leaf_is_sound(const cylint_leaf *leaf, size_t n)
{
    const int used = cylint_leaf_used(leaf);
    const float steps = cylint_leaf_steps(leaf);
    int sound = used >= 1 && used <= CYLINT_LEAF_SIZE &&
                are_finite(leaf->center) && steps > 0 && steps <= FLT_MAX;
    for (int i = 0; i < CYLINT_LEAF_SIZE && sound; i++) {
        const cylint_slice slice = cylint_leaf_slice(leaf, i);
        sound &=
            i >= used || (leaf->number[i] < n && slice.index < slice.count);
    }
    return sound;
}

/* The next node and leaf that are not in the tree yet. */
typedef struct {
    const cylint_bvh *bvh;
    size_t node, leaf, n;
} sound_tree;

/* The build numbers nodes and leaves in the order of this recursion. */
static int add_node(sound_tree *t, int depth)
{
    if (t->node >= t->bvh->n_nodes || depth > CYLINT_BVH_DEPTH)
        return 0;
    const cylint_node *node = &t->bvh->nodes[t->node++];
    const unsigned bits = node->children;
    if (bits == 0 || (bits & (bits + 1)) != 0 || !are_finite(node->corner) ||
        !are_finite(node->step))
        return 0;
    for (unsigned i = 0; i < CYLINT_CHILDREN && bits >> i; i++) {
        const uint32_t child = node->child[i];
        if (node->leaves >> i & 1) {
            if (t->leaf >= t->bvh->n_leaves ||
                child != (CYLINT_LEAF_FLAG | t->leaf) ||
                !leaf_is_sound(&t->bvh->leaves[t->leaf++], t->n))
                return 0;
        } else if (child != t->node || !add_node(t, depth + 1)) {
            return 0;
        }
    }
    return 1;
}

int cylint_bvh_is_sound(const cylint_bvh *bvh, size_t n)
{
    sound_tree tree = {bvh, 0, 0, n};
    return (bvh->n_nodes == 0 || add_node(&tree, 1)) &&
           tree.node == bvh->n_nodes && tree.leaf == bvh->n_leaves;
}
