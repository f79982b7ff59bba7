/*
 * bvh.c - builds and frees a bounding volume hierarchy; the build of its traversal
 *
 * Shapes are split into slices with tight boxes, build.c makes nodes over these,
 * and the slices are stored in leaves.
 */
#include "bvh.h"

#include <string.h>

#include "../dispatch.h"
#include "threads.h"
#include "traverse.h"

/* -------------------------------------------------------------- slices -- */

/* About half the area of the cylinder around the swept disc, of the larger k, which
 * boxes of floats make thicker by some units in the last place of their sides. */
static double half_surface(const cylint_swept_disc *t, double k)
{
    const double pi = 3.14159265358979323846;
    const double r = k * t->across + 0x1p-22 * cylint_largest(t->base);
    return pi * r * (r + t->length + k * t->along);
}

/*
 * A random line hits boxes in proportion to their areas.  The sides of the box of
 * one of m slices are x / m + y, where the box of the axis has the sides x, and
 * that of a section y.  So half the area of all m is X / m + Z + m Y, where X and
 * Y are half the areas of boxes with the sides x and y, and Z does not depend on m.
 * With m S for tests of m slices, S half the area of the shape, that is least where
 * m is sqrt(X / (Y + S)).  A shape is cut if this is more than 1: shapes nearly as
 * wide as long are not.  Then the next greater m is best where shapes overlap.
 * More than FEW slices pay for needles only; for fibres 10 by 0.02 the time is the
 * same with 4 to 8, and a slice takes 20 bytes, 41 while a scene is built.
 */
enum { FEW = 4, MANY = 8, NEEDLE = 64 };

static uint16_t slice_count(const cylint_swept_disc *t, const double reach[3])
{
    const double k = fmax(t->k[0], t->k[1]);
    double axis[3], section[3];
    EACH(j, 3) {
        axis[j] = fabs(t->axis[j]);
        section[j] = 2 * k * reach[j];
    }
    const double balance =
        sqrt(cylint_half_area(axis) /
             (cylint_half_area(section) + half_surface(t, k)));
    const double most = balance > (double)NEEDLE ? MANY : FEW;
    return balance > 1 ? (uint16_t)fmin(balance + 1, most) : 1;
}

/* The slices of a shape. */
typedef struct {
    cylint_swept_disc disc;
    double reach[3];
    uint16_t count;
} cut_shape;

/* Returns 0 if the shape is unbounded or its box is invalid. */
static int cut(cut_shape *to, const cylint_view *view, uint32_t number)
{
    cylint_shape spare;
    const cylint_shape *shape = view->shape_at(view->owner, number, &spare);
    if (!cylint_is_bounded(shape))
        return 0;
    cylint_swept_disc_of(&to->disc, view, shape);
    cylint_swept_disc_reach(&to->disc, to->reach);
    const cylint_extent box =
        cylint_slice_box(&to->disc, to->reach, (cylint_slice){0, 1});
    to->count = slice_count(&to->disc, to->reach);
    return cylint_extent_is_valid(&box);
}

static void write_slices(cylint_boxed_slice *to, const cut_shape *from,
                         uint32_t number, cylint_extent *all)
{
    for (uint16_t i = 0; i < from->count; i++) {
        const cylint_slice slice = {i, from->count};
        const cylint_extent b =
            cylint_slice_box(&from->disc, from->reach, slice);
        to[i] = (cylint_boxed_slice){b, number, slice};
        cylint_extent_include(all, &b);
    }
}

/* The slices of a block of shapes: `first` is the first of them. */
typedef struct {
    size_t first, slices;
    cylint_extent all;
    cylint_bvh_status status;
    size_t refused;
} portion;

typedef struct {
    const cylint_bvh_input *input;
    cylint_boxed_slice *box; /* NULL: the slices are only counted */
    size_t block;            /* shapes */
    portion portion[CYLINT_THREADS_MOST];
} split_job;

/* Splits shapes [from, to), a block. */
static void split_block(void *self, size_t from, size_t to)
{
    split_job *job = self;
    const cylint_bvh_input *input = job->input;
    portion *s = &job->portion[from / job->block];
    cut_shape shape;
    s->slices = 0;
    s->all = cylint_extent_empty();
    for (size_t i = from; i < to && s->status == CYLINT_BVH_OK; i++) {
        s->refused = input->numbers ? input->numbers[i] : i;
        if (!cylint_watch_item(input->watch, i)) {
            s->status = CYLINT_BVH_ESTOPPED;
        } else if (s->refused >= UINT32_MAX ||
                   !cut(&shape, input->view, (uint32_t)s->refused)) {
            s->status = CYLINT_BVH_ESHAPE;
        } else {
            if (job->box)
                write_slices(job->box + s->first + s->slices, &shape,
                             (uint32_t)s->refused, &s->all);
            s->slices += shape.count;
        }
    }
}

/* Counts or writes the slices of all blocks. */
static cylint_bvh_status split_all(split_job *job, size_t *refused)
{
    const cylint_bvh_input *input = job->input;
    cylint_watch_step(input->watch,
                      job->box ? CYLINT_STEP_SPLIT : CYLINT_STEP_COUNT,
                      input->n);
    cylint_threads_share(input->threads, input->n, job->block, 1, split_block,
                         job);
    for (size_t i = 0; i * job->block < input->n; i++)
        if (job->portion[i].status != CYLINT_BVH_OK) {
            *refused = job->portion[i].refused;
            return job->portion[i].status;
        }
    return CYLINT_BVH_OK;
}

/* Writes the box of every slice, in the order of shapes, to bvh->leaf_memory, which
 * has room for the leaves of these slices too; and the box of all, and how many. */
static cylint_bvh_status split_shapes(cylint_bvh *bvh,
                                      const cylint_bvh_input *input, size_t *n,
                                      size_t *refused)
{
    split_job job = {.input = input,
                     .block = (input->n - 1) / (size_t)input->threads + 1};
    cylint_bvh_status status = split_all(&job, refused);
    if (status != CYLINT_BVH_OK)
        return status;
    *n = 0;
    for (size_t i = 0; i * job.block < input->n; i++) {
        job.portion[i].first = *n;
        *n += job.portion[i].slices;
    }
    if (*n > SIZE_MAX / sizeof *job.box - CYLINT_LEAF_SIZE ||
        !cylint_memory_allocate(&bvh->leaf_memory, input->source,
                                (*n + CYLINT_LEAF_SIZE) * sizeof *job.box))
        return CYLINT_BVH_EMEMORY;
    job.box = bvh->leaf_memory.data;
    status = split_all(&job, refused);
    for (size_t i = 0; i * job.block < input->n; i++)
        cylint_extent_include(&bvh->box, &job.portion[i].all);
    return status;
}

/* --------------------------------------------------------------- nodes -- */

/* Steps are at least 2^-30 of the longest side. */
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
    bvh->pad = cylint_float_above(longest * 0x1p-19 + line_error);
    bvh->longest = cylint_float_above(longest);
    bvh->least_step = cylint_float_above(fmax(longest * 0x1p-30, 0x1p-100));
}

static cylint_bvh_status store_nodes(cylint_bvh *bvh,
                                     const cylint_bvh_input *input,
                                     size_t slices)
{
    bvh->n_leaves = cylint_leaves_for(slices);
    if (bvh->n_leaves >= CYLINT_LEAF_FLAG ||
        !cylint_memory_allocate(&bvh->node_memory, input->source,
                                cylint_build_most_nodes(bvh->n_leaves) *
                                    sizeof *bvh->nodes))
        return CYLINT_BVH_EMEMORY;
    cylint_watch_step(input->watch, CYLINT_STEP_NODES, slices);
    cylint_bvh_set_box(bvh, &bvh->box, input->view->line_error);
    bvh->n_nodes = cylint_build_nodes(
        bvh->node_memory.data, bvh->leaf_memory.data, slices, bvh->center,
        bvh->least_step, input->threads, input->watch);
    if (bvh->n_nodes == 0)
        return CYLINT_BVH_ESTOPPED;
    if (!cylint_memory_resize(&bvh->node_memory, input->source,
                              bvh->n_nodes * sizeof *bvh->nodes))
        return CYLINT_BVH_EMEMORY;
    bvh->nodes = bvh->node_memory.data;
    return CYLINT_BVH_OK;
}

/* -------------------------------------------------------------- leaves -- */

/* The number of shapes that are read together before leaves are filled.  They
 * lie at random addresses, and the processor waits for several at once.
 * (Prefetching them had no effect where every address needs a translation.) */
enum { TOGETHER = 4 * CYLINT_LEAF_SIZE };

/* Slices to be stored in leaves, in the same memory. */
typedef struct {
    const cylint_bvh_input *input;
    cylint_boxed_slice *box;
    size_t n;
} leaf_job;

/* The leaf of the slices from `first` on, over their boxes. */
static cylint_leaf *leaf_over(const leaf_job *job, size_t first)
{
    return (cylint_leaf *)(void *)(job->box + first);
}

static void fill_group(const leaf_job *job, size_t first)
{
    cylint_swept_disc disc[TOGETHER];
    cylint_boxed_slice box[TOGETHER];
    const size_t ahead = job->n - first;
    const int n = ahead < TOGETHER ? (int)ahead : TOGETHER;
    memcpy(box, job->box + first, (size_t)n * sizeof *box);
    for (int i = 0; i < n; i++)
        cylint_swept_disc_at(&disc[i], job->input->view, box[i].number);
    for (int i = 0; i < n; i += CYLINT_LEAF_SIZE)
        cylint_leaf_fill(leaf_over(job, first + (size_t)i), disc + i, box + i,
                         n - i < CYLINT_LEAF_SIZE ? n - i : CYLINT_LEAF_SIZE,
                         job->input->view->line_error);
}

/* Fills the leaves of slices [from, to). */
static void fill_leaves(void *self, size_t from, size_t to)
{
    const leaf_job *job = self;
    for (; from < to && cylint_watch_item(job->input->watch, from);
         from += TOGETHER)
        fill_group(job, from);
}

/* Stores the leaves over the boxes of their slices, joins them, and returns the
 * memory that they do not need. */
static cylint_bvh_status store_leaves(cylint_bvh *bvh,
                                      const cylint_bvh_input *input,
                                      size_t slices)
{
    cylint_leaf *leaves = bvh->leaf_memory.data;
    leaf_job job = {input, bvh->leaf_memory.data, slices};
    cylint_watch_step(input->watch, CYLINT_STEP_LEAVES, 2 * slices);
    cylint_threads_share(input->threads, slices, CYLINT_WATCHED, 1, fill_leaves,
                         &job);
    for (size_t i = 0; i < slices && cylint_watch_item(input->watch, i);
         i += CYLINT_LEAF_SIZE)
        memmove(leaves++, leaf_over(&job, i), sizeof *leaves);
    if (!cylint_watch_add(input->watch, 0))
        return CYLINT_BVH_ESTOPPED;
    if (!cylint_memory_resize(&bvh->leaf_memory, input->source,
                              bvh->n_leaves * sizeof *bvh->leaves))
        return CYLINT_BVH_EMEMORY;
    bvh->leaves = bvh->leaf_memory.data;
    return CYLINT_BVH_OK;
}

cylint_bvh_status cylint_bvh_build(cylint_bvh *bvh,
                                   const cylint_bvh_input *input,
                                   size_t *refused)
{
    cylint_bvh_input in = *input;
    size_t slices;
    *bvh = (cylint_bvh){.box = cylint_extent_empty()};
    if (in.n == 0)
        return CYLINT_BVH_OK;
    in.threads =
        cylint_threads_for(in.n, CYLINT_THREADS_LEAST_SHAPES, in.threads);
    cylint_bvh_status status = split_shapes(bvh, &in, &slices, refused);
    if (status == CYLINT_BVH_OK)
        status = store_nodes(bvh, &in, slices);
    if (status == CYLINT_BVH_OK)
        status = store_leaves(bvh, &in, slices);
    if (status != CYLINT_BVH_OK)
        cylint_bvh_free(bvh);
    return status;
}

size_t cylint_bvh_rank(cylint_bvh *bvh, size_t n, uint32_t *number,
                       uint32_t *rank)
{
    cylint_leaf *const leaves = bvh->leaf_memory.data;
    uint32_t next = 0;
    memset(rank, 0xff, n * sizeof *rank); /* UINT32_MAX: none yet */
    for (size_t i = 0; i < bvh->n_leaves; i++)
        for (int lane = 0; lane < cylint_leaf_used(&leaves[i]); lane++) {
            uint32_t *const at = &leaves[i].number[lane];
            if (rank[*at] == UINT32_MAX) {
                number[next] = *at;
                rank[*at] = next++;
            }
            *at = rank[*at];
        }
    const size_t in_leaves = next;
    for (uint32_t i = 0; next < n; i++)
        if (rank[i] == UINT32_MAX) {
            number[next] = i;
            rank[i] = next++;
        }
    return in_leaves;
}

void cylint_bvh_free(cylint_bvh *bvh)
{
    cylint_memory_free(&bvh->node_memory);
    cylint_memory_free(&bvh->leaf_memory);
}

const cylint_traversal *cylint_traversal_used(void)
{
    return CYLINT_OF_KERNELS(&cylint_traversal_plain, &cylint_traversal_avx2,
                             &cylint_traversal_avx512);
}
