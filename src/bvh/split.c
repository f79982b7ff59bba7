/*
 * split.c - shapes cut into pieces that their boxes are tight about
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

/* Of the cylinder about a trunk, nearly. */
static double trunk_area(const cylint_swept_disc *t)
{
    const double pi = 3.14159265358979323846;
    const double k = fmax(t->k[0], t->k[1]), r = k * t->across;
    return 2 * pi * r * (r + t->length + k * t->along);
}

/*
 * A ray that comes through the box meets the shape with the ratio of their
 * areas.  m pieces have m boxes of 1/m^2 the area, together 1/m of it, and m
 * times the boxes: the root of the ratio of areas is where one gains what the
 * other loses.  MANY pieces pay for fibres only, for which twice as many would
 * be faster by less than 10 % and slower to build.
 */
enum { FEW = 4, MANY = 8 };

/* So many shapes tell how many pieces the others may have. */
enum { FIRST = 4096 };

static const cylint_piece whole = {0, 1};

static int pieces_of(const cylint_swept_disc *t, const cylint_extent *box)
{
    const double m = sqrt(box_area(box) / trunk_area(t));
    const double most = m > 2 * FEW ? MANY : FEW;
    return !(m > 1) ? 1 : (int)fmin(m + 0.5, most);
}

static uint32_t member(const cylint_bvh_input *m, size_t i)
{
    return m->numbers ? m->numbers[i] : (uint32_t)i;
}

/* Boxes of pieces, as many as there is room for. */
typedef struct {
    cylint_memory memory;
    cylint_boxed_piece *box;
    size_t n, room;
    cylint_extent all;
} pieces;

static int make_room(pieces *p, const cylint_memory_source *source, size_t room)
{
    pieces more = *p;
    more.room = room;
    if (room > SIZE_MAX / sizeof *p->box ||
        !cylint_memory_allocate(&more.memory, source, room * sizeof *p->box))
        return 0;
    more.box = more.memory.data;
    if (p->n > 0)
        memcpy(more.box, p->box, p->n * sizeof *p->box);
    cylint_memory_free(&p->memory);
    *p = more;
    return 1;
}

/* Room for all pieces, if those to come are like those of the first `done`
 * shapes; and for the next ones in any case. */
static size_t room_for(const pieces *p, size_t done, size_t shapes)
{
    const size_t first = shapes < FIRST ? shapes : FIRST;
    const double each = done > 0 ? (double)p->n / (double)done : 0;
    return p->n + first * MANY +
           (size_t)(each * 1.0625 * (double)(shapes - done));
}

static void add_piece(pieces *p, const cylint_extent *b, uint32_t stem,
                      cylint_piece piece)
{
    p->box[p->n++] =
        (cylint_boxed_piece){{b->lower[0], b->lower[1], b->lower[2]},
                             stem,
                             {b->upper[0], b->upper[1], b->upper[2]},
                             (uint16_t)piece.index,
                             (uint16_t)piece.count};
    cylint_extent_include(&p->all, b);
}

/* The pieces of a shape that is the stem of the given index.  0: its box is
 * not one to be kept. */
static int cut_shape(pieces *p, const cylint_view *view, uint32_t number,
                     cylint_packed_disc *stems, uint32_t stem)
{
    cylint_swept_disc trunk;
    double reach[3];
    cylint_swept_disc_of(&trunk, view, number);
    cylint_swept_disc_reach(&trunk, reach);
    const cylint_extent box = cylint_piece_box(&trunk, reach, whole);
    if (!cylint_extent_is_valid(&box))
        return 0;
    stems[stem] = cylint_packed_disc_of(&trunk, &view->shapes[number], number);
    const int count = pieces_of(&trunk, &box);
    if (count == 1)
        add_piece(p, &box, stem, whole);
    else
        for (int index = 0; index < count; index++) {
            const cylint_piece piece = {index, count};
            const cylint_extent b = cylint_piece_box(&trunk, reach, piece);
            add_piece(p, &b, stem, piece);
        }
    return 1;
}

/* What one thread makes of its shapes, [from, to). */
typedef struct {
    size_t from, to;
    pieces pieces;
    cylint_bvh_status status;
    size_t refused;
} share;

static cylint_bvh_status cut_share(share *s, const cylint_bvh_input *m,
                                   cylint_packed_disc *stems)
{
    pieces *p = &s->pieces;
    for (size_t i = s->from; i < s->to; i++) {
        if (p->room - p->n < MANY &&
            !make_room(p, m->source, room_for(p, i - s->from, s->to - s->from)))
            return CYLINT_BVH_EMEMORY;
        s->refused = member(m, i);
        if (s->refused >= UINT32_MAX ||
            !cylint_is_bounded(&m->view->shapes[s->refused]) ||
            !cut_shape(p, m->view, (uint32_t)s->refused, stems, (uint32_t)i))
            return CYLINT_BVH_ESHAPE;
    }
    return CYLINT_BVH_OK;
}

/* All shares, and where their pieces come together. */
typedef struct {
    const cylint_bvh_input *m;
    cylint_split *cut;
    share share[CYLINT_THREADS_MOST];
} work;

/* Numbers [from, to) of the shares, and below. */
static void cut_some(void *self, size_t from, size_t to)
{
    work *w = self;
    for (; from < to; from++) {
        share *s = &w->share[from];
        s->status = cut_share(s, w->m, w->cut->stem);
    }
}

static void collect_some(void *self, size_t from, size_t to)
{
    work *w = self;
    size_t before = 0;
    for (size_t i = 0; i < to; i++) {
        const pieces *p = &w->share[i].pieces;
        if (i >= from)
            memcpy(w->cut->box + before, p->box, p->n * sizeof *p->box);
        before += p->n;
    }
}

/* A share that is all there is stays where it is. */
static int collect(work *w)
{
    cylint_split *cut = w->cut;
    cut->all = cylint_extent_empty();
    for (int i = 0; i < w->m->threads; i++) {
        cut->n += w->share[i].pieces.n;
        cylint_extent_include(&cut->all, &w->share[i].pieces.all);
    }
    if (w->m->threads == 1) {
        cut->box_memory = w->share[0].pieces.memory;
        w->share[0].pieces.memory = (cylint_memory){0};
    } else if (!cylint_memory_allocate(&cut->box_memory, w->m->source,
                                       cut->n * sizeof *cut->box)) {
        return 0;
    }
    cut->box = cut->box_memory.data;
    if (w->m->threads > 1)
        cylint_threads_run(w->m->threads, (size_t)w->m->threads, collect_some,
                           w);
    return 1;
}

static cylint_bvh_status cut_all(work *w, size_t *refused)
{
    const cylint_bvh_input *m = w->m;
    const size_t threads = (size_t)m->threads;
    for (size_t i = 0; i < threads; i++)
        w->share[i] =
            (share){.from = m->n / threads * i,
                    .to = i + 1 < threads ? m->n / threads * (i + 1) : m->n,
                    .pieces = {.all = cylint_extent_empty()}};
    cylint_threads_run(m->threads, threads, cut_some, w);
    for (size_t i = 0; i < threads; i++)
        if (w->share[i].status != CYLINT_BVH_OK) {
            *refused = w->share[i].refused;
            return w->share[i].status;
        }
    return collect(w) ? CYLINT_BVH_OK : CYLINT_BVH_EMEMORY;
}

cylint_bvh_status cylint_split_shapes(cylint_split *cut,
                                      const cylint_bvh_input *m,
                                      size_t *refused)
{
    work w = {.m = m, .cut = cut};
    *cut = (cylint_split){0};
    if (m->n > SIZE_MAX / sizeof *cut->stem ||
        !cylint_memory_allocate(&cut->stem_memory, m->source,
                                m->n * sizeof *cut->stem))
        return CYLINT_BVH_EMEMORY;
    cut->stem = cut->stem_memory.data;
    const cylint_bvh_status status = cut_all(&w, refused);
    for (int i = 0; i < m->threads; i++)
        cylint_memory_free(&w.share[i].pieces.memory);
    return status;
}

void cylint_split_free(cylint_split *cut)
{
    cylint_memory_free(&cut->stem_memory);
    cylint_memory_free(&cut->box_memory);
    *cut = (cylint_split){0};
}
