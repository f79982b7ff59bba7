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

/* The next node and leaf that are not in the tree yet. */
typedef struct {
    const cylint_bvh *bvh;
    size_t node, leaf;
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
        if (child & CYLINT_LEAF_FLAG) {
            if ((child & ~CYLINT_LEAF_FLAG) != t->leaf++)
                return 0;
        } else if (child != t->node || !add_node(t, depth + 1)) {
            return 0;
        }
    }
    return 1;
}

static int leaf_is_sound(const cylint_leaf *leaf, size_t n)
{
    const int used = cylint_leaf_used(leaf);
    const float steps = cylint_leaf_steps(leaf);
    int sound = used >= 1 && used <= CYLINT_LEAF_SIZE &&
                are_finite(leaf->center) && steps > 0 && steps <= FLT_MAX;
    for (int i = 0; i < CYLINT_LEAF_SIZE && sound; i++) {
        const cylint_shape_piece piece = cylint_leaf_piece(leaf, i);
        sound &=
            i >= used || (leaf->number[i] < n && piece.index < piece.count);
    }
    return sound;
}

int cylint_bvh_is_sound(const cylint_bvh *bvh, size_t n)
{
    sound_tree tree = {bvh, 0, 0};
    if (bvh->n_nodes == 0)
        return bvh->n_leaves == 0;
    if (!add_node(&tree, 1) || tree.node != bvh->n_nodes ||
        tree.leaf != bvh->n_leaves)
        return 0;
    for (size_t i = 0; i < bvh->n_leaves; i++)
        if (!leaf_is_sound(&bvh->leaves[i], n))
            return 0;
    return 1;
}
