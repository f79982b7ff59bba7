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
 * MANY pieces pay for fibres only; twice as many make queries less than 10 %
 * faster and the build slower.
 */
enum { FEW = 4, MANY = 8 };

/* The first FIRST shapes predict the number of pieces of the others. */
enum { FIRST = 4096 };

static const cylint_piece whole = {0, 1};

static int piece_count(const cylint_swept_disc *t, const cylint_extent *box)
{
    const double balance = sqrt(box_area(box) / surface_area(t));
    const double most = balance > 2 * FEW ? MANY : FEW;
    return !(balance > 1) ? 1 : (int)fmin(balance + 0.5, most);
}

static uint32_t number_of(const cylint_bvh_input *input, size_t i)
{
    return input->numbers ? input->numbers[i] : (uint32_t)i;
}

/* A growing array of boxes. */
typedef struct {
    cylint_memory memory;
    cylint_boxed_piece *box;
    size_t n, capacity;
    cylint_extent all;
} piece_list;

static int grow(piece_list *p, const cylint_memory_source *source,
                size_t capacity)
{
    piece_list more = *p;
    more.capacity = capacity;
    if (capacity > SIZE_MAX / sizeof *p->box ||
        !cylint_memory_allocate(&more.memory, source,
                                capacity * sizeof *p->box))
        return 0;
    more.box = more.memory.data;
    if (p->n > 0)
        memcpy(more.box, p->box, p->n * sizeof *p->box);
    cylint_memory_free(&p->memory);
    *p = more;
    return 1;
}

/* The capacity for all pieces, if the remaining shapes have as many as the
 * first `done` ones, plus MANY for each of the next FIRST shapes. */
static size_t wanted_capacity(const piece_list *p, size_t done, size_t shapes)
{
    const size_t first = shapes < FIRST ? shapes : FIRST;
    const double each = done > 0 ? (double)p->n / (double)done : 0;
    return p->n + first * MANY +
           (size_t)(each * 1.0625 * (double)(shapes - done));
}

static void add_piece(piece_list *p, const cylint_extent *b, uint32_t disc,
                      cylint_piece piece)
{
    p->box[p->n++] =
        (cylint_boxed_piece){{b->lower[0], b->lower[1], b->lower[2]},
                             disc,
                             {b->upper[0], b->upper[1], b->upper[2]},
                             (uint16_t)piece.index,
                             (uint16_t)piece.count};
    cylint_extent_include(&p->all, b);
}

/* Adds the pieces of a shape and stores its packed disc in discs[disc].
 * Returns 0 if its box is invalid. */
static int split_shape(piece_list *p, const cylint_view *view, uint32_t number,
                       cylint_packed_disc *discs, uint32_t disc)
{
    cylint_swept_disc swept;
    double reach[3];
    cylint_swept_disc_of(&swept, view, number);
    cylint_swept_disc_reach(&swept, reach);
    const cylint_extent box = cylint_piece_box(&swept, reach, whole);
    if (!cylint_extent_is_valid(&box))
        return 0;
    discs[disc] = cylint_packed_disc_of(&swept, &view->shapes[number], number);
    const int count = piece_count(&swept, &box);
    if (count == 1)
        add_piece(p, &box, disc, whole);
    else
        for (int index = 0; index < count; index++) {
            const cylint_piece piece = {index, count};
            const cylint_extent b = cylint_piece_box(&swept, reach, piece);
            add_piece(p, &b, disc, piece);
        }
    return 1;
}

/* The shapes [from, to) of one thread, and their pieces. */
typedef struct {
    size_t from, to;
    piece_list pieces;
    cylint_bvh_status status;
    size_t refused;
} portion;

static cylint_bvh_status split_portion(portion *s,
                                       const cylint_bvh_input *input,
                                       cylint_packed_disc *discs)
{
    piece_list *p = &s->pieces;
    for (size_t i = s->from; i < s->to; i++) {
        if (!cylint_watch_item(input->watch, i))
            return CYLINT_BVH_ESTOPPED;
        if (p->capacity - p->n < MANY &&
            !grow(p, input->source,
                  wanted_capacity(p, i - s->from, s->to - s->from)))
            return CYLINT_BVH_EMEMORY;
        s->refused = number_of(input, i);
        if (s->refused >= UINT32_MAX ||
            !cylint_is_bounded(&input->view->shapes[s->refused]) ||
            !split_shape(p, input->view, (uint32_t)s->refused, discs,
                         (uint32_t)i))
            return CYLINT_BVH_ESHAPE;
    }
    return CYLINT_BVH_OK;
}

/* All portions, and the split that gets their pieces. */
typedef struct {
    const cylint_bvh_input *input;
    cylint_split *split;
    portion portion[CYLINT_THREADS_MOST];
} split_job;

/* Splits portions [from, to). */
static void split_portions(void *self, size_t from, size_t to)
{
    split_job *w = self;
    for (; from < to; from++) {
        portion *s = &w->portion[from];
        s->status = split_portion(s, w->input, w->split->disc);
    }
}

/* Copies the pieces of portions [from, to). */
static void copy_portions(void *self, size_t from, size_t to)
{
    split_job *w = self;
    size_t before = 0;
    for (size_t i = 0; i < to; i++) {
        const piece_list *p = &w->portion[i].pieces;
        if (i >= from)
            memcpy(w->split->box + before, p->box, p->n * sizeof *p->box);
        before += p->n;
    }
}

/* Joins the pieces of all portions; a single portion is not copied. */
static int join_portions(split_job *w)
{
    cylint_split *split = w->split;
    split->all = cylint_extent_empty();
    for (int i = 0; i < w->input->threads; i++) {
        split->n += w->portion[i].pieces.n;
        cylint_extent_include(&split->all, &w->portion[i].pieces.all);
    }
    if (w->input->threads == 1) {
        split->box_memory = w->portion[0].pieces.memory;
        w->portion[0].pieces.memory = (cylint_memory){0};
    } else if (!cylint_memory_allocate(&split->box_memory, w->input->source,
                                       split->n * sizeof *split->box)) {
        return 0;
    }
    split->box = split->box_memory.data;
    if (w->input->threads > 1)
        cylint_threads_run(w->input->threads, (size_t)w->input->threads,
                           copy_portions, w);
    return 1;
}

static cylint_bvh_status split_all(split_job *w, size_t *refused)
{
    const cylint_bvh_input *input = w->input;
    const size_t threads = (size_t)input->threads;
    for (size_t i = 0; i < threads; i++)
        w->portion[i] = (portion){
            .from = input->n / threads * i,
            .to = i + 1 < threads ? input->n / threads * (i + 1) : input->n,
            .pieces = {.all = cylint_extent_empty()}};
    cylint_threads_run(input->threads, threads, split_portions, w);
    for (size_t i = 0; i < threads; i++)
        if (w->portion[i].status != CYLINT_BVH_OK) {
            *refused = w->portion[i].refused;
            return w->portion[i].status;
        }
    return join_portions(w) ? CYLINT_BVH_OK : CYLINT_BVH_EMEMORY;
}

cylint_bvh_status cylint_split_shapes(cylint_split *split,
                                      const cylint_bvh_input *input,
                                      size_t *refused)
{
    split_job w = {.input = input, .split = split};
    *split = (cylint_split){0};
    if (input->n > SIZE_MAX / sizeof *split->disc ||
        !cylint_memory_allocate(&split->disc_memory, input->source,
                                input->n * sizeof *split->disc))
        return CYLINT_BVH_EMEMORY;
    split->disc = split->disc_memory.data;
    const cylint_bvh_status status = split_all(&w, refused);
    for (int i = 0; i < input->threads; i++)
        cylint_memory_free(&w.portion[i].pieces.memory);
    return status;
}

void cylint_split_free(cylint_split *split)
{
    cylint_memory_free(&split->disc_memory);
    cylint_memory_free(&split->box_memory);
    *split = (cylint_split){0};
}
