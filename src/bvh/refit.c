/*
 * refit.c - adapts a bounding volume hierarchy to shapes that have moved
 */
#include "traverse.h"

#include <math.h>

/* The hierarchy, and which shapes have moved. */
typedef struct {
    const cylint_bvh *bvh;
    const cylint_view *view;
    uint32_t first, n;
    /* a box that contains their slices as they were; NULL: all space */
    const cylint_extent *before;
} moved_shapes;

/* Boxes of leaves and nodes that have not moved are empty. */
static int has_moved(const cylint_extent *box)
{
    return box->lower[0] <= box->upper[0];
}

/* ---------------------------------------------------------------- leaves -- */

/* The swept discs and boxes of the slices in a leaf. */
typedef struct {
    cylint_swept_disc disc[CYLINT_LEAF_SIZE];
    cylint_boxed_slice slice[CYLINT_LEAF_SIZE];
    cylint_extent box; /* of all slices */
} leaf_slices;

static void read_slices(leaf_slices *to, const cylint_leaf *leaf,
                        const cylint_view *view)
{
    const int used = cylint_leaf_used(leaf);
    to->box = cylint_extent_empty();
    for (int i = 0; i < used; i++)
        cylint_swept_disc_at(&to->disc[i], view, leaf->number[i]);
    for (int i = 0; i < used; i++) {
        const cylint_slice slice = cylint_leaf_slice(leaf, i);
        double reach[3];
        cylint_swept_disc_reach(&to->disc[i], reach);
        const cylint_extent b = cylint_slice_box(&to->disc[i], reach, slice);
        cylint_extent_include(&to->box, &b);
        to->slice[i] = (cylint_boxed_slice){b, leaf->number[i], slice};
    }
}

static int contains_one(const cylint_leaf *leaf, uint32_t first, uint32_t n)
{
    int contains = 0;
    for (int i = 0; i < CYLINT_LEAF_SIZE; i++)
        contains |= leaf->number[i] - first < n;
    return contains;
}

/* Bounds a leaf again, if a shape in it has moved.  Returns the box of its slices,
 * or the empty box. */
static cylint_extent refit_leaf(const moved_shapes *m, cylint_leaf *leaf)
{
    leaf_slices slices;
    if (!contains_one(leaf, m->first, m->n))
        return cylint_extent_empty();
    read_slices(&slices, leaf, m->view);
    cylint_leaf_fill(leaf, slices.disc, slices.slice, cylint_leaf_used(leaf),
                     m->view->line_error);
    return slices.box;
}

/* ----------------------------------------------------------------- nodes -- */

/* The box of a child, as the node has it.  The sum has errors of 2^-53 of its
 * parts. */
static cylint_extent child_box(const cylint_bvh *bvh, const cylint_node *node,
                               int child)
{
    double side[2][3];
    for (int j = 0; j < 3; j++) {
        const double corner = (double)node->corner[j] + (double)bvh->center[j];
        const double step = (double)node->step[j];
        const double error = (fabs((double)node->corner[j]) +
                              fabs((double)bvh->center[j]) + 255 * step) *
                             0x1p-50;
        side[0][j] = corner + step * node->face[0][j][child] - error;
        side[1][j] = corner + step * node->face[1][j][child] + error;
    }
    return cylint_float_box(side[0], side[1]);
}

/* The box of an unmoved leaf or node from its own slices or children. */
static cylint_extent unmoved_box(const cylint_bvh *bvh, const cylint_view *view,
                                 uint32_t child)
{
    if (child & CYLINT_LEAF_FLAG) {
        leaf_slices slices;
        read_slices(&slices, &bvh->leaves[child & ~CYLINT_LEAF_FLAG], view);
        return slices.box;
    }
    const cylint_node *node = &bvh->nodes[child];
    cylint_extent all = cylint_extent_empty();
    for (int k = 0; k < CYLINT_CHILDREN && node->children >> k; k++) {
        const cylint_extent box = child_box(bvh, node, k);
        cylint_extent_include(&all, &box);
    }
    return all;
}

/* Whether the corner and the steps serve the children that have moved, whose box is
 * `moved`: their faces, as cylint_node_place_child() rounds them, are at most 255
 * steps from the corner, and no step is more than twice as long as the box of all
 * children needs. */
static int serves(const cylint_bvh *bvh, const cylint_node *node,
                  const cylint_extent *moved, const cylint_extent *all)
{
    int serves = 1;
    for (int j = 0; j < 3; j++) {
        const double corner = (double)node->corner[j] + (double)bvh->center[j];
        const double to = (double)moved->upper[j] - corner;
        const double side = (double)all->upper[j] - (double)all->lower[j];
        const double most = 255 * (double)node->step[j];
        serves &= (double)moved->lower[j] >= corner &&
                  to * (1 + 0x1p-48) <= most &&
                  (node->step[j] <= bvh->least_step || 2 * side >= most);
    }
    return serves;
}

/* The children that have not moved keep their faces, if the corner and the steps
 * serve the others: so refitting again and again adds nothing to them.  Returns 0
 * if they do not serve; otherwise writes the box of all. */
static int keep_faces(const cylint_bvh *bvh, cylint_node *node,
                      const cylint_extent *box, int n, cylint_extent *all)
{
    cylint_extent moved = cylint_extent_empty();
    *all = moved;
    for (int i = 0; i < n; i++) {
        const cylint_extent b =
            has_moved(&box[i]) ? box[i] : child_box(bvh, node, i);
        cylint_extent_include(&moved, &box[i]);
        cylint_extent_include(all, &b);
    }
    if (!serves(bvh, node, &moved, all))
        return 0;
    for (int i = 0; i < n; i++)
        if (has_moved(&box[i]))
            cylint_node_place_child(node, i, &box[i], bvh->center);
    return 1;
}

/* Bounds a node again, if a child has moved.  Returns the box of its children, or
 * the empty box. */
static cylint_extent refit_node(const cylint_bvh *bvh, const cylint_view *view,
                                cylint_node *node,
                                cylint_extent box[CYLINT_CHILDREN])
{
    int n = 0, moved = 0;
    cylint_extent all = cylint_extent_empty();
    for (; n < CYLINT_CHILDREN && node->children >> n; n++)
        moved += has_moved(&box[n]);
    if (moved == 0)
        return all;
    if (moved < n && keep_faces(bvh, node, box, n, &all))
        return all;
    all = cylint_extent_empty();
    for (int i = 0; i < n; i++) {
        if (!has_moved(&box[i]))
            box[i] = unmoved_box(bvh, view, node->child[i]);
        cylint_extent_include(&all, &box[i]);
    }
    cylint_node_place(node, box, n, bvh->center, bvh->least_step);
    return all;
}

/* Whether a shape that has moved may have been in this child.  The numbers in a
 * leaf are read in less time than its box is computed. */
static int may_contain_one(const moved_shapes *m, const cylint_node *node,
                           int child)
{
    if (!m->before || node->leaves >> child & 1)
        return 1;
    const cylint_extent box = child_box(m->bvh, node, child);
    int meets = 1;
    for (int j = 0; j < 3; j++)
        meets &= box.lower[j] <= m->before->upper[j] &&
                 m->before->lower[j] <= box.upper[j];
    return meets;
}

/* Bounds a leaf, or a node and those below it, again.  Returns as refit_node(). */
static cylint_extent refit_below(const moved_shapes *m, uint32_t number)
{
    cylint_extent box[CYLINT_CHILDREN];
    if (number & CYLINT_LEAF_FLAG) {
        cylint_leaf *leaves = m->bvh->leaf_memory.data;
        return refit_leaf(m, &leaves[number & ~CYLINT_LEAF_FLAG]);
    }
    cylint_node *node = (cylint_node *)m->bvh->node_memory.data + number;
    for (int k = 0; k < CYLINT_CHILDREN && node->children >> k; k++)
        box[k] = may_contain_one(m, node, k) ? refit_below(m, node->child[k])
                                             : cylint_extent_empty();
    return refit_node(m->bvh, m->view, node, box);
}

cylint_extent cylint_bvh_refit(cylint_bvh *bvh, const cylint_view *view,
                               uint32_t first, uint32_t n,
                               const cylint_extent *before)
{
    const moved_shapes moved = {bvh, view, first, n, before};
    return refit_below(&moved, 0);
}

/* ------------------------------------------------------------------ cost -- */

/* Line number n goes through the centre of a box of some node.  Nodes and
 * directions are points of a sequence that fills a cube evenly [Roberts 2018]. */
static cylint_bvh_line probe_at(const cylint_bvh *bvh, int n)
{
    static const double step[4] = {0.8566748838545029, 0.7338918566271260,
                                   0.6287067210378087, 0.5385972572236101};
    double at[4];
    cylint_bvh_line line = {.tmin = -HUGE_VAL, .tmax = HUGE_VAL};
    for (int j = 0; j < 4; j++)
        at[j] = n * step[j] - floor(n * step[j]);
    const cylint_extent box =
        child_box(bvh, &bvh->nodes[(size_t)(at[3] * (double)bvh->n_nodes)], 0);
    for (int j = 0; j < 3; j++) {
        line.o[j] = ((double)box.lower[j] + (double)box.upper[j]) / 2;
        line.d[j] = at[j] - 0.5;
    }
    return line;
}

/* Where lines hit most boxes, a few lines suffice. */
double cylint_bvh_cost(const cylint_bvh *bvh)
{
    enum { LINES = 256, BOXES = 1 << 20 };
    size_t sum = 0;
    int n = 0;
    while (bvh->n_nodes > 0 && n < LINES && sum < BOXES) {
        const cylint_bvh_line line = probe_at(bvh, n++);
        sum += cylint_traversal_used()->all(bvh, &line, NULL, NULL);
    }
    return n > 0 ? (double)sum / n : 0;
}
