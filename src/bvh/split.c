/*
 * split.c - splits shapes into pieces with tight boxes
 */
#include "split.h"

#include <string.h>

#include "threads.h"

static double box_area(const cylint_extent *b)
{
    const double x = (double)b->upper[0] - (double)b->lower[0];
    const double y = (double)b->upper[1] - (double)b->lower[1];
    const double z = (double)b->upper[2] - (double)b->lower[2];
    return 2 * (x * y + y * z + z * x);
}

/* About the area of the cylinder around the swept disc. */
static double surface_area(const cylint_swept_disc *t)
{
    const double pi = 3.14159265358979323846;
    const double k = fmax(t->k[0], t->k[1]), r = k * t->across;
    return 2 * pi * r * (r + t->length + k * t->along);
}

/*
 * The chance that a ray through the box hits the shape is the ratio of their
 * areas.  m pieces have m boxes of 1/m^2 the area each, 1/m of it together.  The
 * gain balances the cost of m boxes where m is the square root of the ratio.
 * More than FEW pieces pay for needles only; for fibres 10 by 0.02 the time is the
 * same with 4 to 8, and a piece takes 20 bytes, 41 while a scene is built.
 */
enum { FEW = 4, MANY = 8, NEEDLE = 64 };

static const cylint_shape_piece whole = {0, 1};

static int piece_count(const cylint_swept_disc *t, const cylint_extent *box)
{
    const double balance = sqrt(box_area(box) / surface_area(t));
    const double most = balance > NEEDLE ? MANY : FEW;
    return !(balance > 1) ? 1 : (int)fmin(balance + 0.5, most);
}

static uint32_t given_number(const cylint_bvh_input *input, size_t i)
{
    return input->numbers ? input->numbers[i] : (uint32_t)i;
}

/* The pieces of a shape. */
typedef struct {
    cylint_swept_disc disc;
    double reach[3];
    int count;
} cut_shape;

/* Returns 0 if the shape is unbounded or its box is invalid. */
static int cut(cut_shape *to, const cylint_view *view, uint32_t number)
{
    cylint_shape spare;
    const cylint_shape *shape = cylint_view_shape(view, number, &spare);
    if (!cylint_is_bounded(shape))
        return 0;
    cylint_swept_disc_of(&to->disc, view, shape);
    cylint_swept_disc_reach(&to->disc, to->reach);
    const cylint_extent box = cylint_piece_box(&to->disc, to->reach, whole);
    to->count = piece_count(&to->disc, &box);
    return cylint_extent_is_valid(&box);
}

static void write_pieces(cylint_boxed_piece *to, const cut_shape *from,
                         uint32_t number, cylint_extent *all)
{
    for (int i = 0; i < from->count; i++) {
        const cylint_shape_piece piece = {i, from->count};
        const cylint_extent b =
            cylint_piece_box(&from->disc, from->reach, piece);
        to[i] = cylint_boxed(&b, number, piece);
        cylint_extent_include(all, &b);
    }
}

/* Of the shapes of one thread, the pieces, which begin at `first`, and the box of
 * these. */
typedef struct {
    size_t first, pieces;
    cylint_extent all;
    cylint_bvh_status status;
    size_t refused;
} portion;

typedef struct {
    const cylint_bvh_input *input;
    cylint_boxed_piece *box; /* NULL: the pieces are only counted */
    portion portion[CYLINT_THREADS_MOST];
} split_job;

static cylint_bvh_status split_portion(const split_job *job, size_t k,
                                       portion *s)
{
    const cylint_bvh_input *input = job->input;
    const size_t threads = (size_t)input->threads, each = input->n / threads,
                 to = k + 1 < threads ? each * (k + 1) : input->n;
    cut_shape shape;
    s->pieces = 0;
    s->all = cylint_extent_empty();
    for (size_t i = each * k; i < to; i++) {
        if (!cylint_watch_item(input->watch, i))
            return CYLINT_BVH_ESTOPPED;
        s->refused = given_number(input, i);
        if (s->refused >= UINT32_MAX ||
            !cut(&shape, input->view, (uint32_t)s->refused))
            return CYLINT_BVH_ESHAPE;
        if (job->box)
            write_pieces(job->box + s->first + s->pieces, &shape,
                         (uint32_t)s->refused, &s->all);
        s->pieces += (size_t)shape.count;
    }
    return CYLINT_BVH_OK;
}

/* Splits portions [from, to). */
static void split_portions(void *self, size_t from, size_t to)
{
    split_job *job = self;
    for (; from < to; from++)
        job->portion[from].status =
            split_portion(job, from, &job->portion[from]);
}

/* Counts or writes the pieces of all portions. */
static cylint_bvh_status split_all(split_job *job, size_t *refused)
{
    const cylint_bvh_input *input = job->input;
    const size_t threads = (size_t)input->threads;
    cylint_watch_step(input->watch,
                      job->box ? CYLINT_STEP_SPLIT : CYLINT_STEP_COUNT,
                      input->n);
    cylint_threads_run(input->threads, threads, split_portions, job);
    for (size_t i = 0; i < threads; i++)
        if (job->portion[i].status != CYLINT_BVH_OK) {
            *refused = job->portion[i].refused;
            return job->portion[i].status;
        }
    return CYLINT_BVH_OK;
}

cylint_bvh_status cylint_split_shapes(cylint_split *split,
                                      const cylint_bvh_input *input,
                                      size_t *refused)
{
    split_job job = {.input = input};
    *split = (cylint_split){.all = cylint_extent_empty()};
    cylint_bvh_status status = split_all(&job, refused);
    if (status != CYLINT_BVH_OK)
        return status;
    for (int i = 0; i < input->threads; i++) {
        job.portion[i].first = split->n;
        split->n += job.portion[i].pieces;
    }
    if (split->n > SIZE_MAX / sizeof *split->box - CYLINT_LEAF_SIZE ||
        !cylint_memory_allocate(&split->memory, input->source,
                                (split->n + CYLINT_LEAF_SIZE) *
                                    sizeof *split->box))
        return CYLINT_BVH_EMEMORY;
    split->box = job.box = split->memory.data;
    status = split_all(&job, refused);
    for (int i = 0; i < input->threads; i++)
        cylint_extent_include(&split->all, &job.portion[i].all);
    return status;
}
