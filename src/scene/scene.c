/*
 * scene.c - exact answers about many shapes, most of which are not asked
 *
 * Shapes are cut into pieces, pieces that lie together are blocks of 8, with
 * nodes above them (bvh.h).  The walk from the first node leaves out what
 * the line certainly does not meet, or meets only behind the nearest hit so
 * far (traverse.h).  What is left is asked by cylint_intersect().
 */
#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "cylint_scene.h"
#include "../numbers/bits.h"
#include "../bvh/threads.h"
#include "frame.h"
#include "../bvh/traverse.h"

enum { MOST_SHAPES = 1 << 28 };

struct cylint_scene {
    const cylint_shape *shapes;
    size_t n;
    cylint_frame frame;
    cylint_view view; /* the shapes in the frame */
    cylint_bvh group; /* of the boxed ones */
    cylint_traverse_line *walk;
    uint32_t *boxed; /* the numbers of the shapes in the hierarchy, or
                              NULL: all */
    uint32_t *loose; /* and of those beside it, ascending */
    size_t n_boxed, n_loose;
    cylint_shape *copies; /* of the latter, for their pack */
    void *pack_memory;
    cylint_pack pack;
    size_t own_bytes; /* beside the group's */
};

const char *cylint_scene_strerror(int status)
{
    switch (status) {
    case CYLINT_SCENE_OK:
        return "no error";
    case CYLINT_SCENE_EMEMORY:
        return "out of memory";
    case CYLINT_SCENE_ESIZE:
        return "too many shapes for one scene";
    default:
        return "unknown status";
    }
}

/* ------------------------------------------------------------ building -- */

/* How far the section of a shape at z = 0 or 1 reaches from the axis along
 * coordinate j, or somewhat farther. */
static double rough_reach(const cylint_shape *s, int end, int j)
{
    const double r = end ? s->r1 : s->r0;
    if (s->kind >= CYLINT_KIND_ECYLINDER)
        return r * (fabs(s->a[j]) + fabs(s->b[j]));
    if (s->kind == CYLINT_KIND_ACONE) /* from the tangent */
        return r * (fabs(s->axis[0]) + fabs(s->axis[1]) + fabs(s->axis[2]));
    return r;
}

/* Whether a frame can hold the shape, and if so a box about it.  No number
 * comes of more than 6 roundings or errors of its data.  Squares of lengths may
 * underflow later on, which a larger factor would make count. */
static int has_box(const cylint_shape *s, double lo[3], double hi[3])
{
    const int has_factors = s->kind >= CYLINT_KIND_ACONE;
    if (!cylint_is_bounded(s) || (has_factors && s->r1 > CYLINT_FRAME_MOST))
        return 0;
    for (int j = 0; j < 3; j++) {
        const double bottom = rough_reach(s, 0, j), top = rough_reach(s, 1, j);
        const double base = s->base[j], end = base + s->axis[j];
        const double more =
            DBL_MIN + 0x1p-50 * (fabs(base) + fabs(s->axis[j]) + bottom + top);
        lo[j] = fmin(base - bottom, end - top) - more;
        hi[j] = fmax(base + bottom, end + top) + more;
        if (!(lo[j] >= -CYLINT_FRAME_MOST && hi[j] <= CYLINT_FRAME_MOST))
            return 0;
    }
    return 1;
}

static void *keep(cylint_scene *s, size_t count, size_t size)
{
    s->own_bytes += count * size;
    return malloc(count > 0 ? count * size : 1);
}

/* What is to be known of all shapes, and of whom. */
typedef struct {
    const cylint_shape *shapes;
    cylint_mutex lock;   /* of what is below */
    double lo[3], hi[3]; /* about those that have boxes */
    size_t boxed, valid;
} census;

static void extend(double lo[3], double hi[3], const double from[3],
                   const double to[3])
{
    for (int j = 0; j < 3; j++) {
        lo[j] = fmin(lo[j], from[j]);
        hi[j] = fmax(hi[j], to[j]);
    }
}

/* Adds shapes [from, to); nothing depends on who is first. */
static void count_shapes(void *self, size_t from, size_t to)
{
    census *all = self;
    double lo[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL};
    double hi[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    size_t boxed = 0, valid = 0;
    for (size_t i = from; i < to; i++) {
        double least[3], most[3];
        valid += all->shapes[i].kind != CYLINT_KIND_NONE;
        if (!has_box(&all->shapes[i], least, most))
            continue;
        boxed++;
        extend(lo, hi, least, most);
    }
    cylint_mutex_lock(&all->lock);
    extend(all->lo, all->hi, lo, hi);
    all->boxed += boxed;
    all->valid += valid;
    cylint_mutex_unlock(&all->lock);
}

/* The frame of all that have boxes, none if it cannot be made. */
static void make_frame(cylint_scene *s, int threads)
{
    census all = {.shapes = s->shapes,
                  .lock = CYLINT_MUTEX_INITIALIZER,
                  .lo = {HUGE_VAL, HUGE_VAL, HUGE_VAL},
                  .hi = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};
    cylint_threads_run(cylint_threads_for(s->n, threads), s->n, count_shapes,
                       &all);
    cylint_mutex_destroy(&all.lock);
    if (all.boxed > 0 && cylint_frame_make(&s->frame, all.lo, all.hi))
        s->n_boxed = all.boxed;
    s->n_loose = all.valid - s->n_boxed;
}

static void sort_out(cylint_scene *s)
{
    double lo[3], hi[3];
    size_t boxed = 0, loose = 0;
    for (size_t i = 0; i < s->n; i++) {
        if (s->n_boxed > 0 && has_box(&s->shapes[i], lo, hi)) {
            s->boxed[boxed++] = (uint32_t)i;
        } else if (s->shapes[i].kind != CYLINT_KIND_NONE) {
            s->loose[loose] = (uint32_t)i;
            s->copies[loose++] = s->shapes[i];
        }
    }
}

/* Numbers of boxed shapes, unless those are all, and a pack of the others.  A
 * refused shape is neither, for no line meets it. */
static int sort_shapes(cylint_scene *s)
{
    const int mixed = s->n_boxed < s->n;
    s->loose = keep(s, s->n_loose, sizeof *s->loose);
    s->copies = keep(s, s->n_loose, sizeof *s->copies);
    s->pack_memory = keep(s, cylint_pack_bytes(s->n_loose), 1);
    if (mixed)
        s->boxed = keep(s, s->n_boxed, sizeof *s->boxed);
    if (!s->loose || !s->copies || !s->pack_memory || (mixed && !s->boxed))
        return 0;
    if (mixed)
        sort_out(s);
    cylint_pack_shapes(&s->pack, s->pack_memory, s->copies, s->n_loose);
    return 1;
}

static cylint_scene_status build_hierarchy(cylint_scene *s, int threads)
{
    size_t refused; /* none: all have boxes */
    s->walk = cylint_traversal_used()->line;
    s->view = (cylint_view){
        s->shapes,
        {s->frame.center[0], s->frame.center[1], s->frame.center[2]},
        s->frame.scale,
        CYLINT_FRAME_ERROR};
    const cylint_bvh_input members = {.view = &s->view,
                                      .numbers = s->boxed,
                                      .n = s->n_boxed,
                                      .threads = threads};
    return cylint_bvh_build(&s->group, &members, &refused) == CYLINT_BVH_OK
               ? CYLINT_SCENE_OK
               : CYLINT_SCENE_EMEMORY;
}

static cylint_scene_status build(cylint_scene *s, int threads)
{
    if (s->n > MOST_SHAPES)
        return CYLINT_SCENE_ESIZE;
    make_frame(s, threads);
    if (!sort_shapes(s))
        return CYLINT_SCENE_EMEMORY;
    return s->n_boxed > 0 ? build_hierarchy(s, threads) : CYLINT_SCENE_OK;
}

cylint_scene *cylint_scene_new(const cylint_shape *shapes, size_t n,
                               int threads, cylint_scene_status *status)
{
    cylint_scene *s = calloc(1, sizeof *s);
    cylint_scene_status result = CYLINT_SCENE_EMEMORY;
    if (s) {
        s->shapes = shapes;
        s->n = n;
        s->own_bytes = sizeof *s;
        result = build(s, threads);
    }
    if (status)
        *status = result;
    if (result == CYLINT_SCENE_OK)
        return s;
    cylint_scene_free(s);
    return NULL;
}

void cylint_scene_free(cylint_scene *scene)
{
    if (!scene)
        return;
    cylint_bvh_free(&scene->group);
    free(scene->boxed);
    free(scene->loose);
    free(scene->copies);
    free(scene->pack_memory);
    free(scene);
}

size_t cylint_scene_bytes(const cylint_scene *scene)
{
    return scene->own_bytes + scene->group.memory.bytes;
}

/* ------------------------------------------------------------- queries -- */

/* What is remembered of shapes of several pieces, which are offered again:
 * some of those that need not be asked again, by the last digits of their
 * numbers, and all that are counted, as long as there is room. */
enum { ASKED = 16, COUNTED = 256, COUNTED_MOST = 192 };
#define NOBODY UINT32_MAX

/* One question on its way through the hierarchy. */
typedef struct {
    const cylint_scene *scene;
    cylint_line line;     /* tmax: what is beyond is of no interest */
    cylint_frame_ray ray; /* nor what is beyond its length */
    size_t best;          /* nearest: its number, and its hit */
    cylint_hit hit;
    size_t count, enough;  /* count */
    size_t *numbers, room; /* all: a heap of the lowest, the highest first */
    size_t first;          /* all: lower numbers are of no interest */
    uint32_t asked[ASKED];
    uint32_t counted[COUNTED]; /* a hash table */
    int n_counted;
    size_t except; /* the number of a shape that is not asked */
} question;

/* Takes the shape's hit if it is the first so far.  Roots that round to t
 * are no greater than the double above t, so that one bounds what may still
 * be nearest, or as near with a lower number. */
static int take_nearest(question *q, size_t number)
{
    cylint_answer answer;
    if (!cylint_intersect(
            &q->scene->shapes[number], &q->line,
            CYLINT_WANT_T | CYLINT_WANT_PART | CYLINT_WANT_NEAREST, &answer))
        return 0;
    const cylint_hit *hit = &answer.hit[0];
    if (q->best < q->scene->n &&
        (cylint_less(q->hit.t, hit->t) ||
         (!cylint_less(hit->t, q->hit.t) && number > q->best)))
        return 0;
    q->best = number;
    q->hit = *hit;
    if (cylint_less(hit->t, q->line.tmax))
        q->line.tmax = cylint_next_above(hit->t);
    return 1;
}

static void sift_down(size_t *heap, size_t n, size_t from)
{
    const size_t x = heap[from];
    size_t child;
    while ((child = 2 * from + 1) < n) {
        child += child + 1 < n && heap[child + 1] > heap[child];
        if (heap[child] <= x)
            break;
        heap[from] = heap[child];
        from = child;
    }
    heap[from] = x;
}

static void sift_up(size_t *heap, size_t at)
{
    const size_t x = heap[at];
    for (; at > 0 && heap[(at - 1) / 2] < x; at = (at - 1) / 2)
        heap[at] = heap[(at - 1) / 2];
    heap[at] = x;
}

static void sort_heap(size_t *heap, size_t n)
{
    while (n-- > 1) {
        const size_t highest = heap[0];
        heap[0] = heap[n];
        heap[n] = highest;
        sift_down(heap, n, 0);
    }
}

/* Whether the number could be one of the lowest. */
static int is_low(const question *q, size_t number)
{
    return number >= q->first && (q->count < q->room || number < q->numbers[0]);
}

static void keep_number(question *q, size_t number)
{
    if (q->count < q->room) {
        q->numbers[q->count] = number;
        sift_up(q->numbers, q->count++);
    } else {
        q->numbers[0] = number;
        sift_down(q->numbers, q->room, 0);
    }
}

/* Takes the number of a shape that is met.  Whether there are enough now. */
static int take_number(question *q, size_t number)
{
    if (q->numbers)
        keep_number(q, number);
    else
        q->count++;
    return q->enough != 0 && q->count == q->enough;
}

static int is_wanted(const question *q, size_t number)
{
    return number != q->except && (!q->numbers || is_low(q, number));
}

/* Whether there are enough now. */
static int take_count(question *q, size_t number)
{
    return is_wanted(q, number) &&
           cylint_occluded(&q->scene->shapes[number], &q->line) &&
           take_number(q, number);
}

/* Where the number is, or would be, among the counted ones. */
static uint32_t *place_of(question *q, uint32_t number)
{
    uint32_t at = number * UINT32_C(2654435769) >> 24;
    while (q->counted[at] != number && q->counted[at] != NOBODY)
        at = (at + 1) % COUNTED;
    return &q->counted[at];
}

/* Whether the lane's shape is in other lanes, too. */
static int in_pieces(const cylint_leaf *block, int lane)
{
    return cylint_leaf_piece(block, lane).count > 1;
}

static int was_asked(question *q, uint32_t number)
{
    uint32_t *asked = &q->asked[number % ASKED];
    const int was = *asked == number;
    *asked = number;
    return was;
}

/* Whether the shape's first hit lies in the lane's piece.  That piece is sure
 * to be offered, and no other says so. */
static int owns_first_hit(const question *q, const cylint_leaf *block, int lane)
{
    cylint_answer answer;
    return cylint_intersect(&q->scene->shapes[block->number[lane]], &q->line,
                            CYLINT_WANT_NEAREST | CYLINT_WANT_Z, &answer) &&
           cylint_leaf_owns(block, lane, answer.hit[0].z);
}

/* As take_count, of a piece among several. */
static int take_piece(question *q, const cylint_leaf *block, int lane)
{
    const uint32_t number = block->number[lane];
    uint32_t *place = place_of(q, number);
    if (*place == number || !is_wanted(q, number))
        return 0;
    if (q->n_counted == COUNTED_MOST)
        return owns_first_hit(q, block, lane) && take_number(q, number);
    if (was_asked(q, number) ||
        !cylint_occluded(&q->scene->shapes[number], &q->line))
        return 0;
    *place = number;
    q->n_counted++;
    return take_number(q, number);
}

/* The lane, of some, which is first met. */
static int first_lane(unsigned lanes, const double least[CYLINT_LEAF_SIZE])
{
    int first = -1;
    for (int lane = 0; lane < CYLINT_LEAF_SIZE; lane++)
        if (lanes >> lane & 1 && (first < 0 || least[lane] < least[first]))
            first = lane;
    return first;
}

static int ask_nearest(void *self, const cylint_leaf *block, unsigned lanes,
                       const double least[CYLINT_LEAF_SIZE])
{
    question *q = self;
    while (lanes) {
        const int lane = first_lane(lanes, least);
        if (least[lane] > q->ray.length)
            break;
        lanes &= ~(1u << lane);
        if ((in_pieces(block, lane) && was_asked(q, block->number[lane])) ||
            !take_nearest(q, block->number[lane]))
            continue;
        q->ray.length =
            fmin(q->ray.length, cylint_frame_reach(&q->ray, q->hit.t));
    }
    return 0;
}

static int ask_count(void *self, const cylint_leaf *block, unsigned lanes,
                     const double least[CYLINT_LEAF_SIZE])
{
    question *q = self;
    (void)least;
    for (; lanes; lanes &= lanes - 1) {
        const int lane = cylint_lowest(lanes);
        if (in_pieces(block, lane) ? take_piece(q, block, lane)
                                   : take_count(q, block->number[lane]))
            return 1;
    }
    return 0;
}

/* Walks the hierarchy, or, where no float ray will do, asks every shape in
 * it. */
static void walk(question *q, int nearest)
{
    const cylint_scene *s = q->scene;
    if (s->n_boxed == 0)
        return;
    const cylint_frame_status verdict =
        cylint_frame_line(&s->frame, &q->line, &q->ray);
    if (verdict == CYLINT_FRAME_UNUSABLE) {
        for (size_t i = 0; i < s->n_boxed; i++) {
            const size_t number = s->boxed ? s->boxed[i] : i;
            if (nearest)
                take_nearest(q, number);
            else if (take_count(q, number))
                return;
        }
    } else if (verdict == CYLINT_FRAME_ENTERED) {
        if (!nearest) {
            q->n_counted = 0;
            memset(q->counted, 0xff, sizeof q->counted); /* NOBODY */
        }
        s->walk(&s->group, q->ray.o, q->ray.d, 0, &q->ray.length,
                nearest ? ask_nearest : ask_count, q);
    }
}

static void open_question(question *q, const cylint_scene *scene,
                          const cylint_line *line)
{
    q->scene = scene;
    q->line = *line;
    q->best = q->except = scene->n;
    q->count = q->enough = 0;
    q->numbers = NULL;
    memset(q->asked, 0xff, sizeof q->asked); /* NOBODY */
}

size_t cylint_scene_nearest(const cylint_scene *scene, const cylint_line *line,
                            unsigned want, cylint_hit *hit)
{
    question q;
    open_question(&q, scene, line);
    const size_t loose = cylint_nearest(&scene->pack, line, 0, &q.hit);
    if (loose < scene->n_loose)
        take_nearest(&q, scene->loose[loose]);
    walk(&q, 1);
    if (q.best < scene->n && want) {
        cylint_answer answer;
        answer.hit[0] = *hit; /* what is not wanted is not written */
        cylint_intersect(&scene->shapes[q.best], line,
                         (want & ~(unsigned)CYLINT_WANT_FAST) |
                             CYLINT_WANT_NEAREST,
                         &answer);
        *hit = answer.hit[0];
    }
    return q.best;
}

size_t cylint_scene_count(const cylint_scene *scene, const cylint_line *line,
                          size_t enough)
{
    question q;
    open_question(&q, scene, line);
    q.enough = enough;
    q.count = cylint_count(&scene->pack, line, enough);
    if (enough == 0 || q.count < enough)
        walk(&q, 0);
    return q.count;
}

int cylint_scene_occluded(const cylint_scene *scene, const cylint_line *line,
                          size_t except)
{
    question q;
    open_question(&q, scene, line);
    q.enough = 1;
    q.except = except;
    for (size_t i = 0; i < scene->n_loose; i++)
        if (take_count(&q, scene->loose[i]))
            return 1;
    walk(&q, 0);
    return q.count > 0;
}

size_t cylint_scene_all(const cylint_scene *scene, const cylint_line *line,
                        size_t first, size_t *numbers, size_t room)
{
    question q;
    if (room == 0)
        return 0;
    open_question(&q, scene, line);
    q.numbers = numbers;
    q.room = room;
    q.first = first;
    for (size_t i = 0; i < scene->n_loose; i++)
        take_count(&q, scene->loose[i]);
    walk(&q, 0);
    sort_heap(numbers, q.count);
    return q.count;
}
