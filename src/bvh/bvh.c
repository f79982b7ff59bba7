/*
 * bvh.c - builds and frees a bounding volume hierarchy; the build of its traversal
 */
#include "bvh.h"

#include <string.h>

#include "kernels_used.h"
#include "threads.h"
#include "traverse.h"

/* The number of shapes that are read together before leaves are filled.  They
 * lie at random addresses, and the processor waits for several at once.
 * (Prefetching them had no effect where every address needs a translation.) */
enum { TOGETHER = 4 * CYLINT_LEAF_SIZE };

/* Groups of TOGETHER pieces that one thread stores before others begin. */
enum { FIRST_GROUPS = 1024 };

/* Pieces to be stored in leaves, in the same memory. */
typedef struct {
    const cylint_boxed_piece *box;
    size_t n;
    cylint_leaf *leaves;
    const cylint_view *view;
    cylint_watch *watch;
    size_t first_group; /* of a round */
} leaf_job;

static void fill_group(const leaf_job *job, size_t first)
{
    cylint_swept_disc disc[TOGETHER];
    cylint_boxed_piece box[TOGETHER];
    const size_t left = job->n - first;
    const int n = left < TOGETHER ? (int)left : TOGETHER;
    memcpy(box, job->box + first, (size_t)n * sizeof *box);
    for (int i = 0; i < n; i++) {
        cylint_shape spare;
        cylint_swept_disc_of(
            &disc[i], job->view,
            cylint_view_shape(job->view, box[i].number, &spare));
    }
    for (int i = 0; i < n; i += CYLINT_LEAF_SIZE)
        cylint_leaf_fill(job->leaves + (first + (size_t)i) / CYLINT_LEAF_SIZE,
                         disc + i, box + i,
                         n - i < CYLINT_LEAF_SIZE ? n - i : CYLINT_LEAF_SIZE,
                         job->view->line_error);
}

/* Fills the leaves of groups [from, to), counted from the first of the round. */
static void fill_leaves(void *self, size_t from, size_t to)
{
    const leaf_job *job = self;
    for (; from < to; from++) {
        const size_t first = (job->first_group + from) * TOGETHER;
        if (!cylint_watch_item(job->watch, first))
            return;
        fill_group(job, first);
    }
}

/*
 * Stores the leaves over the boxes.  A leaf has the size of 4 boxes and is made of
 * 8, so those of groups [m, 2 m) are stored over the boxes of [m / 2, m), which
 * are not needed any more after the round before.
 */
static void fill_all_leaves(leaf_job *job, int threads)
{
    const size_t groups = (job->n + TOGETHER - 1) / TOGETHER;
    size_t from = 0, to = FIRST_GROUPS;
    if (threads == 1 || groups < to)
        to = groups;
    for (int using = 1; from < groups; using = threads) {
        job->first_group = from;
        cylint_threads_run(using, to - from, fill_leaves, job);
        from = to;
        to = groups - from < from ? groups : 2 * from;
    }
}

/* Nodes with gaps between them, and the pieces below them. */
typedef struct {
    cylint_split split;
    cylint_memory memory; /* of the nodes */
    size_t n_nodes;
} draft;

/* ray.h uses them: its S is the longest side of the box. */
void cylint_bvh_set_box(cylint_bvh *bvh, const cylint_extent *box,
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

/* The status of a step that does not fail otherwise. */
static cylint_bvh_status result(cylint_watch *watch)
{
    return cylint_watch_add(watch, 0) ? CYLINT_BVH_OK : CYLINT_BVH_ESTOPPED;
}

static cylint_bvh_status make_draft(draft *d, cylint_bvh *bvh,
                                    const cylint_bvh_input *input,
                                    size_t *refused)
{
    const cylint_bvh_status status =
        cylint_split_shapes(&d->split, input, refused);
    if (status != CYLINT_BVH_OK)
        return status;
    const size_t leaves = cylint_leaves_for(d->split.n);
    if (leaves >= CYLINT_LEAF_FLAG ||
        !cylint_memory_allocate(&d->memory, input->source,
                                cylint_build_most_nodes(leaves) *
                                    sizeof(cylint_node)))
        return CYLINT_BVH_EMEMORY;
    cylint_watch_step(input->watch, CYLINT_STEP_NODES, d->split.n);
    cylint_bvh_set_box(bvh, &d->split.all, input->view->line_error);
    d->n_nodes = cylint_build_nodes(d->memory.data, d->split.box, d->split.n,
                                    bvh->center, input->threads, input->watch);
    return result(input->watch);
}

/* Closes the gaps between nodes, stores the leaves, and returns the memory that
 * neither needs. */
static cylint_bvh_status finish(cylint_bvh *bvh, draft *d,
                                const cylint_bvh_input *input)
{
    leaf_job job = {.box = d->split.box,
                    .n = d->split.n,
                    .leaves = d->split.memory.data,
                    .view = input->view,
                    .watch = input->watch};
    bvh->n_leaves = cylint_leaves_for(d->split.n);
    bvh->n_nodes = d->n_nodes;
    cylint_watch_step(input->watch, CYLINT_STEP_LEAVES, d->split.n);
    cylint_build_compact(d->memory.data);
    if (!cylint_memory_reduce(&d->memory, input->source,
                              bvh->n_nodes * sizeof *bvh->nodes))
        return CYLINT_BVH_EMEMORY;
    fill_all_leaves(&job, input->threads);
    if (!cylint_memory_reduce(&d->split.memory, input->source,
                              bvh->n_leaves * sizeof *bvh->leaves))
        return CYLINT_BVH_EMEMORY;
    bvh->nodes = d->memory.data;
    bvh->leaves = d->split.memory.data;
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
    bvh->node_memory = d.memory;
    bvh->leaf_memory = d.split.memory;
    if (status != CYLINT_BVH_OK)
        cylint_bvh_free(bvh);
    return status;
}

void cylint_bvh_free(cylint_bvh *bvh)
{
    cylint_memory_free(&bvh->node_memory);
    cylint_memory_free(&bvh->leaf_memory);
    memset(bvh, 0, sizeof *bvh);
}

const cylint_traversal *cylint_traversal_used(void)
{
    return CYLINT_OF_KERNELS(&cylint_traversal_plain, &cylint_traversal_avx2,
                             &cylint_traversal_avx512);
}
