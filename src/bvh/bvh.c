/*
 * bvh.c - pieces that lie together in blocks, nodes above these
 */
#include "bvh.h"

#include <string.h>

#include "threads.h"

/* The stems of so many boxes are brought together at a time: they lie here and
 * there, and the processor then waits for many at once.  (Prefetching them
 * showed no effect where every one needs an address translated.) */
enum { TOGETHER = 4 * CYLINT_LEAF_SIZE };

/* Pieces that are to become blocks. */
typedef struct {
    const cylint_split *cut;
    cylint_leaf *blocks;
    double blur;
} filling;

/* Of so many together, numbers [from, to). */
static void fill_blocks(void *self, size_t from, size_t to)
{
    const filling *f = self;
    const cylint_split *cut = f->cut;
    cylint_packed_disc stem[TOGETHER];
    for (size_t first = from * TOGETHER; from < to; from++, first += TOGETHER) {
        const size_t left = cut->n - first;
        const int n = left < TOGETHER ? (int)left : TOGETHER;
        const cylint_boxed_piece *box = cut->box + first;
        for (int i = 0; i < n; i++)
            stem[i] = cut->stem[box[i].stem];
        for (int i = 0; i < n; i += CYLINT_LEAF_SIZE)
            cylint_leaf_fill(
                f->blocks + (first + (size_t)i) / CYLINT_LEAF_SIZE, stem + i,
                box + i, n - i < CYLINT_LEAF_SIZE ? n - i : CYLINT_LEAF_SIZE,
                f->blur);
    }
}

/* Boxes, and nodes above them. */
typedef struct {
    cylint_split cut;
    cylint_memory memory; /* of the nodes */
    cylint_node *nodes;
    size_t n_nodes;
} plan;

static size_t blocks_of(size_t boxes)
{
    return (boxes + CYLINT_LEAF_SIZE - 1) / CYLINT_LEAF_SIZE;
}

/* S being the longest side of the box of all: pad and near_by as in traverse.c. */
static void measure(cylint_bvh *group, const cylint_extent *box, double blur)
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
    cylint_split_free(&p->cut);
    cylint_memory_free(&p->memory);
}

static cylint_bvh_status make_plan(plan *p, cylint_bvh *group,
                                   const cylint_bvh_input *m, size_t *refused)
{
    const cylint_bvh_status cuts = cylint_split_shapes(&p->cut, m, refused);
    if (cuts != CYLINT_BVH_OK)
        return cuts;
    const size_t blocks = blocks_of(p->cut.n);
    if (blocks >= CYLINT_LEAF_FLAG ||
        !cylint_memory_allocate(&p->memory, m->source,
                                cylint_build_most_nodes(blocks) *
                                    sizeof *p->nodes))
        return CYLINT_BVH_EMEMORY;
    p->nodes = p->memory.data;
    measure(group, &p->cut.all, m->view->blur);
    p->n_nodes = cylint_build_nodes(p->nodes, p->cut.box, p->cut.n,
                                    group->center, m->threads);
    return CYLINT_BVH_OK;
}

/* What was planned, in no more room than it takes. */
static cylint_bvh_status carry_out(cylint_bvh *group, const plan *p,
                                   const cylint_bvh_input *m)
{
    group->n = blocks_of(p->cut.n);
    if (!cylint_memory_allocate(&group->memory, m->source,
                                p->n_nodes * sizeof *p->nodes +
                                    group->n * sizeof(cylint_leaf)))
        return CYLINT_BVH_EMEMORY;
    cylint_node *nodes = group->memory.data;
    cylint_leaf *blocks = (cylint_leaf *)(void *)(nodes + p->n_nodes);
    filling all = {&p->cut, blocks, m->view->blur};
    cylint_build_compact(nodes, p->nodes);
    cylint_threads_run(m->threads, (p->cut.n + TOGETHER - 1) / TOGETHER,
                       fill_blocks, &all);
    group->nodes = nodes;
    group->blocks = blocks;
    return CYLINT_BVH_OK;
}

cylint_bvh_status cylint_bvh_build(cylint_bvh *group,
                                   const cylint_bvh_input *members,
                                   size_t *refused)
{
    cylint_bvh_input m = *members;
    plan p = {0};
    memset(group, 0, sizeof *group);
    group->box = cylint_extent_empty();
    if (m.n == 0)
        return CYLINT_BVH_OK;
    m.threads = cylint_threads_for(m.n, m.threads);
    cylint_bvh_status status = make_plan(&p, group, &m, refused);
    if (status == CYLINT_BVH_OK)
        status = carry_out(group, &p, &m);
    give_plan(&p);
    return status;
}

void cylint_bvh_free(cylint_bvh *group)
{
    cylint_memory_free(&group->memory);
    memset(group, 0, sizeof *group);
}
