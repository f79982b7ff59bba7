/*
 * bvh.c - pieces that lie together in blocks, nodes above these
 */
#include "bvh.h"

#include <string.h>

#include "threads.h"

/* The stems of so many boxes are brought together at a time: they lie here and
 * there, and the processor then waits for many at once.  (Prefetching them
 * showed no effect where every one needs an address translated.) */
enum { TOGETHER = 4 * CYLINT_BLOCK };

/* Pieces that are to become blocks. */
typedef struct {
    const cylint_cut *cut;
    cylint_block *blocks;
    double blur;
} filling;

/* Of so many together, numbers [from, to). */
static void fill_blocks(void *self, size_t from, size_t to)
{
    const filling *f = self;
    const cylint_cut *cut = f->cut;
    cylint_stem stem[TOGETHER];
    for (size_t first = from * TOGETHER; from < to; from++, first += TOGETHER) {
        const size_t left = cut->n - first;
        const int n = left < TOGETHER ? (int)left : TOGETHER;
        const cylint_box *box = cut->box + first;
        for (int i = 0; i < n; i++)
            stem[i] = cut->stem[box[i].stem];
        for (int i = 0; i < n; i += CYLINT_BLOCK)
            cylint_block_fill(
                f->blocks + (first + (size_t)i) / CYLINT_BLOCK, stem + i,
                box + i, n - i < CYLINT_BLOCK ? n - i : CYLINT_BLOCK, f->blur);
    }
}

/* Boxes, and nodes above them. */
typedef struct {
    cylint_cut cut;
    cylint_memory memory; /* of the nodes */
    cylint_node *nodes;
    size_t n_nodes;
} plan;

static size_t blocks_of(size_t boxes)
{
    return (boxes + CYLINT_BLOCK - 1) / CYLINT_BLOCK;
}

/* S being the longest side of the box of all: pad and near_by as in traverse.c. */
static void measure(cylint_group *group, const cylint_extent *box, double blur)
{
    double longest = 0;
    for (int j = 0; j < 3; j++) {
        const double lower = box->lower[j], upper = box->upper[j];
        longest = fmax(longest, upper - lower);
        group->center[j] = (float)((lower + upper) / 2);
    }
    group->box = *box;
    group->pad = cylint_float_above(longest * 0x1p-20 + blur);
    group->near_by = cylint_float_above(longest * 256);
}

static void give_plan(plan *p)
{
    cylint_cut_free(&p->cut);
    cylint_memory_give(&p->memory);
}

static cylint_cut_status make_plan(plan *p, cylint_group *group,
                                   const cylint_members *m, size_t *refused)
{
    const cylint_cut_status cuts = cylint_cut_shapes(&p->cut, m, refused);
    if (cuts != CYLINT_CUT_OK)
        return cuts;
    const size_t blocks = blocks_of(p->cut.n);
    if (blocks >= CYLINT_LEAF ||
        !cylint_memory_take(&p->memory, m->source,
                            cylint_tree_most_nodes(blocks) * sizeof *p->nodes))
        return CYLINT_CUT_EMEMORY;
    p->nodes = p->memory.data;
    measure(group, &p->cut.all, m->view->blur);
    p->n_nodes = cylint_tree_build(p->nodes, p->cut.box, p->cut.n,
                                   group->center, m->threads);
    return CYLINT_CUT_OK;
}

/* What was planned, in no more room than it takes. */
static cylint_cut_status carry_out(cylint_group *group, const plan *p,
                                   const cylint_members *m)
{
    group->n = blocks_of(p->cut.n);
    if (!cylint_memory_take(&group->memory, m->source,
                            p->n_nodes * sizeof *p->nodes +
                                group->n * sizeof(cylint_block)))
        return CYLINT_CUT_EMEMORY;
    cylint_node *nodes = group->memory.data;
    cylint_block *blocks = (cylint_block *)(void *)(nodes + p->n_nodes);
    filling all = {&p->cut, blocks, m->view->blur};
    cylint_tree_copy(nodes, p->nodes);
    cylint_crew_share(m->threads, (p->cut.n + TOGETHER - 1) / TOGETHER,
                      fill_blocks, &all);
    group->nodes = nodes;
    group->blocks = blocks;
    return CYLINT_CUT_OK;
}

cylint_cut_status cylint_group_make(cylint_group *group,
                                    const cylint_members *members,
                                    size_t *refused)
{
    cylint_members m = *members;
    plan p = {0};
    memset(group, 0, sizeof *group);
    group->box = cylint_no_box();
    if (m.n == 0)
        return CYLINT_CUT_OK;
    m.threads = cylint_crew_for(m.n, m.threads);
    cylint_cut_status status = make_plan(&p, group, &m, refused);
    if (status == CYLINT_CUT_OK)
        status = carry_out(group, &p, &m);
    give_plan(&p);
    return status;
}

void cylint_group_free(cylint_group *group)
{
    cylint_memory_give(&group->memory);
    memset(group, 0, sizeof *group);
}
