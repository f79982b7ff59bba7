/*
 * bvh.c - builds and frees a bounding volume hierarchy
 */
#include "bvh.h"

#include <string.h>

#include "threads.h"

/* The number of discs that are copied together before leaves are filled.  They
 * lie at random addresses, and the processor waits for several at once.
 * (Prefetching them had no effect where every address needs a translation.) */
enum { TOGETHER = 4 * CYLINT_LEAF_SIZE };

/* Pieces to be stored in leaves. */
typedef struct {
    const cylint_split *split;
    cylint_leaf *leaves;
    double line_error;
    cylint_watch *watch;
} leaf_job;

/* Fills the leaves of groups [from, to) of TOGETHER pieces. */
static void fill_leaves(void *self, size_t from, size_t to)
{
    const leaf_job *job = self;
    const cylint_split *split = job->split;
    cylint_packed_disc disc[TOGETHER];
    for (size_t first = from * TOGETHER; from < to; from++, first += TOGETHER) {
        if (!cylint_watch_item(job->watch, first))
            return;
        const size_t left = split->n - first;
        const int n = left < TOGETHER ? (int)left : TOGETHER;
        const cylint_boxed_piece *box = split->box + first;
        for (int i = 0; i < n; i++)
            disc[i] = split->disc[box[i].disc];
        for (int i = 0; i < n; i += CYLINT_LEAF_SIZE)
            cylint_leaf_fill(
                job->leaves + (first + (size_t)i) / CYLINT_LEAF_SIZE, disc + i,
                box + i, n - i < CYLINT_LEAF_SIZE ? n - i : CYLINT_LEAF_SIZE,
                job->line_error);
    }
}

/* Pieces, and nodes above them with gaps. */
typedef struct {
    cylint_split split;
    cylint_memory memory; /* of the nodes */
    cylint_node *nodes;
    size_t n_nodes;
} draft;

static size_t leaves_for(size_t boxes)
{
    return (boxes + CYLINT_LEAF_SIZE - 1) / CYLINT_LEAF_SIZE;
}

/* Sets what ray.h uses: its S is the longest side of the box. */
static void set_box(cylint_bvh *bvh, const cylint_extent *box,
                    double line_error)
{
    double longest = 0;
    for (int j = 0; j < 3; j++) {
        const double lower = box->lower[j], upper = box->upper[j];
        longest = fmax(longest, upper - lower);
        bvh->center[j] = (float)((lower + upper) / 2);
    }
    bvh->box = *box;
    bvh->pad = cylint_float_above(longest * 0x1p-20 + line_error);
    bvh->near_distance = cylint_float_above(longest * 256);
}

static void free_draft(draft *d)
{
    cylint_split_free(&d->split);
    cylint_memory_free(&d->memory);
}

/* The status of a step that does not fail otherwise. */
static cylint_bvh_status result(cylint_watch *watch)
{
    return cylint_watch_add(watch, 0) ? CYLINT_BVH_OK : CYLINT_BVH_ESTOPPED;
}

static cylint_bvh_status make_draft(draft *d, cylint_bvh *bvh,
                                    const cylint_bvh_input *input,
                                    size_t *refused)
{
    cylint_watch_step(input->watch, CYLINT_STEP_SPLIT, input->n);
    const cylint_bvh_status status =
        cylint_split_shapes(&d->split, input, refused);
    if (status != CYLINT_BVH_OK)
        return status;
    const size_t leaves = leaves_for(d->split.n);
    if (leaves >= CYLINT_LEAF_FLAG ||
        !cylint_memory_allocate(&d->memory, input->source,
                                cylint_build_most_nodes(leaves) *
                                    sizeof *d->nodes))
        return CYLINT_BVH_EMEMORY;
    cylint_watch_step(input->watch, CYLINT_STEP_NODES, d->split.n);
    d->nodes = d->memory.data;
    set_box(bvh, &d->split.all, input->view->line_error);
    d->n_nodes = cylint_build_nodes(d->nodes, d->split.box, d->split.n,
                                    bvh->center, input->threads, input->watch);
    return result(input->watch);
}

/* Writes nodes and leaves into memory of exactly their size. */
static cylint_bvh_status finish(cylint_bvh *bvh, const draft *d,
                                const cylint_bvh_input *input)
{
    bvh->n_leaves = leaves_for(d->split.n);
    if (!cylint_memory_allocate(&bvh->memory, input->source,
                                d->n_nodes * sizeof *d->nodes +
                                    bvh->n_leaves * sizeof(cylint_leaf)))
        return CYLINT_BVH_EMEMORY;
    cylint_node *nodes = bvh->memory.data;
    cylint_leaf *leaves = (cylint_leaf *)(void *)(nodes + d->n_nodes);
    leaf_job job = {&d->split, leaves, input->view->line_error, input->watch};
    cylint_watch_step(input->watch, CYLINT_STEP_LEAVES, d->split.n);
    cylint_build_compact(nodes, d->nodes);
    cylint_threads_run(input->threads, (d->split.n + TOGETHER - 1) / TOGETHER,
                       fill_leaves, &job);
    bvh->nodes = nodes;
    bvh->leaves = leaves;
    return result(input->watch);
}

cylint_bvh_status cylint_bvh_build(cylint_bvh *bvh,
                                   const cylint_bvh_input *input,
                                   size_t *refused)
{
    cylint_bvh_input in = *input;
    draft d = {0};
    memset(bvh, 0, sizeof *bvh);
    bvh->box = cylint_extent_empty();
    if (in.n == 0)
        return CYLINT_BVH_OK;
    in.threads = cylint_threads_for(in.n, in.threads);
    cylint_bvh_status status = make_draft(&d, bvh, &in, refused);
    if (status == CYLINT_BVH_OK)
        status = finish(bvh, &d, &in);
    free_draft(&d);
    if (status != CYLINT_BVH_OK)
        cylint_memory_free(&bvh->memory);
    return status;
}

void cylint_bvh_free(cylint_bvh *bvh)
{
    cylint_memory_free(&bvh->memory);
    memset(bvh, 0, sizeof *bvh);
}
