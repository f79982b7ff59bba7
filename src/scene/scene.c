/*
 * scene.c - exact answers about many shapes, of which few are tested
 *
 * A hierarchy over pieces of shapes (bvh.h) rejects shapes that the line
 * certainly does not hit, or hits behind the nearest hit so far (traverse.h).
 * cylint_intersect() tests the others.
 */
#include <float.h>
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "../numbers/bits.h"
#include "../bvh/threads.h"
#include "../intersect.h"
#include "number_heap.h"
#include "number_set.h"
#include "scene.h"

enum { MOST_SHAPES = 1 << 28 };

const char *cylint_scene_strerror(int status)
{
    switch (status) {
    case CYLINT_SCENE_OK:
        return "no error";
    case CYLINT_SCENE_EMEMORY:
        return "out of memory";
    case CYLINT_SCENE_ESIZE:
        return "too many shapes for one scene";
    case CYLINT_SCENE_ESTOPPED:
        return "stopped by the progress function";
    default:
        return "unknown status";
    }
}

/* ------------------------------------------------------------ building -- */

/* Whether a frame can contain the shape; if so, writes its box.  Each number has
 * at most 6 roundings and errors of its data.  Squares of lengths may underflow
 * later; multiplied by a larger factor, the lost part would matter. */
static int has_box(const cylint_shape *s, double lo[3], double hi[3])
{
    const int has_factors = cylint_has_factors(s->kind);
    if (!cylint_is_bounded(s) ||
        (has_factors && cylint_r1(s) > CYLINT_FRAME_MOST))
        return 0;
    for (int j = 0; j < 3; j++) {
        const double bottom = cylint_rough_reach(s, 0, j),
                     top = cylint_rough_reach(s, 1, j);
        const double base = cylint_base(s)[j], end = base + cylint_axis(s)[j];
        const double more =
            DBL_MIN +
            0x1p-50 * (fabs(base) + fabs(cylint_axis(s)[j]) + bottom + top);
        lo[j] = fmin(base - bottom, end - top) - more;
        hi[j] = fmax(base + bottom, end + top) + more;
        if (!(lo[j] >= -CYLINT_FRAME_MOST && hi[j] <= CYLINT_FRAME_MOST))
            return 0;
    }
    return 1;
}

static void *allocate(cylint_scene *s, size_t count, size_t size)
{
    s->own_bytes += count * size;
    return malloc(count > 0 ? count * size : 1);
}

/* Totals over all shapes. */
typedef struct {
    const cylint_shape *shapes;
    cylint_watch *watch;
    cylint_mutex mutex;    /* protects the members below */
    double lo[3], hi[3];   /* the box of all bounded shapes */
    size_t bounded, valid; /* the numbers of bounded and of valid shapes */
} totals;

static void extend(double lo[3], double hi[3], const double from[3],
                   const double to[3])
{
    for (int j = 0; j < 3; j++) {
        lo[j] = fmin(lo[j], from[j]);
        hi[j] = fmax(hi[j], to[j]);
    }
}

/* Adds shapes [from, to).  The order of threads does not matter. */
static void count_shapes(void *self, size_t from, size_t to)
{
    totals *sum = self;
    double lo[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL};
    double hi[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    size_t bounded = 0, valid = 0;
    for (size_t i = from; i < to && cylint_watch_item(sum->watch, i); i++) {
        double least[3], most[3];
        valid += sum->shapes[i].kind != CYLINT_KIND_NONE;
        if (!has_box(&sum->shapes[i], least, most))
            continue;
        bounded++;
        extend(lo, hi, least, most);
    }
    cylint_mutex_lock(&sum->mutex);
    extend(sum->lo, sum->hi, lo, hi);
    sum->bounded += bounded;
    sum->valid += valid;
    cylint_mutex_unlock(&sum->mutex);
}

/* Makes the frame of all bounded shapes.  If it cannot be made, no shape is in
 * the hierarchy. */
static void choose_frame(cylint_scene *s, int threads, cylint_watch *watch)
{
    totals sum = {.shapes = s->shapes,
                  .watch = watch,
                  .mutex = CYLINT_MUTEX_INITIALIZER,
                  .lo = {HUGE_VAL, HUGE_VAL, HUGE_VAL},
                  .hi = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};
    cylint_watch_step(watch, CYLINT_STEP_BOXES, s->n);
    cylint_threads_run(cylint_threads_for(s->n, threads), s->n, count_shapes,
                       &sum);
    cylint_mutex_destroy(&sum.mutex);
    if (sum.bounded > 0 && cylint_frame_make(&s->frame, sum.lo, sum.hi))
        s->n_bounded = sum.bounded;
    s->n_others = sum.valid - s->n_bounded;
}

static void sort_into_lists(cylint_scene *s, cylint_watch *watch)
{
    double lo[3], hi[3];
    size_t bounded = 0, others = 0;
    for (size_t i = 0; i < s->n && cylint_watch_item(watch, i); i++) {
        if (s->n_bounded > 0 && has_box(&s->shapes[i], lo, hi)) {
            s->bounded[bounded++] = (uint32_t)i;
        } else if (s->shapes[i].kind != CYLINT_KIND_NONE) {
            s->others[others] = (uint32_t)i;
            s->copies[others++] = s->shapes[i];
        }
    }
}

/* Lists the numbers of bounded shapes, unless all are bounded, and packs the
 * others.  A refused shape is in neither list: no line hits it. */
static cylint_scene_status sort_shapes(cylint_scene *s, cylint_watch *watch)
{
    const int mixed = s->n_bounded < s->n;
    s->others = allocate(s, s->n_others, sizeof *s->others);
    s->copies = allocate(s, s->n_others, sizeof *s->copies);
    s->pack_memory = allocate(s, cylint_pack_bytes(s->n_others), 1);
    if (mixed)
        s->bounded = allocate(s, s->n_bounded, sizeof *s->bounded);
    if (!s->others || !s->copies || !s->pack_memory || (mixed && !s->bounded))
        return CYLINT_SCENE_EMEMORY;
    if (mixed)
        sort_into_lists(s, watch);
    if (!cylint_watch_add(watch, 0))
        return CYLINT_SCENE_ESTOPPED;
    cylint_pack_shapes(&s->pack, s->pack_memory, s->copies, s->n_others);
    return CYLINT_SCENE_OK;
}

static cylint_scene_status build_hierarchy(cylint_scene *s, int threads,
                                           cylint_watch *watch)
{
    size_t refused; /* not used: all shapes are bounded */
    s->traverse = cylint_traversal_used()->line;
    s->traverse_point = cylint_traverse_point_used();
    s->view = (cylint_view){
        s->shapes,
        {s->frame.center[0], s->frame.center[1], s->frame.center[2]},
        s->frame.scale,
        CYLINT_FRAME_ERROR};
    const cylint_bvh_input members = {.view = &s->view,
                                      .numbers = s->bounded,
                                      .n = s->n_bounded,
                                      .threads = threads,
                                      .watch = watch};
    switch (cylint_bvh_build(&s->bvh, &members, &refused)) {
    case CYLINT_BVH_OK:
        return CYLINT_SCENE_OK;
    case CYLINT_BVH_ESTOPPED:
        return CYLINT_SCENE_ESTOPPED;
    default:
        return CYLINT_SCENE_EMEMORY;
    }
}

static cylint_scene_status build(cylint_scene *s, int threads,
                                 cylint_watch *watch)
{
    if (s->n > MOST_SHAPES)
        return CYLINT_SCENE_ESIZE;
    choose_frame(s, threads, watch);
    const cylint_scene_status status = sort_shapes(s, watch);
    return status == CYLINT_SCENE_OK && s->n_bounded > 0
               ? build_hierarchy(s, threads, watch)
               : status;
}

static cylint_scene *make_scene(const cylint_shape *shapes, size_t n,
                                int threads, cylint_watch *watch,
                                cylint_scene_status *status)
{
    cylint_scene *s = calloc(1, sizeof *s);
    cylint_scene_status result = CYLINT_SCENE_EMEMORY;
    if (s) {
        s->shapes = shapes;
        s->n = n;
        s->own_bytes = sizeof *s;
        result = build(s, threads, watch);
    }
    if (status)
        *status = result;
    if (result == CYLINT_SCENE_OK)
        return s;
    cylint_scene_free(s);
    return NULL;
}

cylint_scene *cylint_scene_new(const cylint_shape *shapes, size_t n,
                               int threads, cylint_scene_status *status)
{
    return make_scene(shapes, n, threads, NULL, status);
}

cylint_scene *cylint_scene_new_with_progress(const cylint_shape *shapes,
                                             size_t n, int threads,
                                             cylint_scene_progress *progress,
                                             void *context,
                                             cylint_scene_status *status)
{
    cylint_watch watch = {.progress = progress,
                          .context = context,
                          .caller = cylint_thread_self(),
                          .mutex = CYLINT_MUTEX_INITIALIZER};
    cylint_scene *s = make_scene(shapes, n, threads, &watch, status);
    cylint_mutex_destroy(&watch.mutex);
    return s;
}

void cylint_scene_free(cylint_scene *scene)
{
    if (!scene)
        return;
    cylint_bvh_free(&scene->bvh);
    free(scene->bounded);
    free(scene->others);
    free(scene->copies);
    free(scene->pack_memory);
    free(scene);
}

size_t cylint_scene_bytes(const cylint_scene *scene)
{
    return scene->own_bytes + scene->bvh.memory.bytes;
}

/* ------------------------------------------------------------- queries -- */

/* A shape of several pieces is found several times.  A direct-mapped cache of
 * recently tested shapes, and a set of counted shapes, save repeated tests. */
enum { RECENT = 16 };

/* Of the nearest hit so far. */
enum { KEPT_MEMBERS = CYLINT_WANT_T | CYLINT_WANT_PART };

/* The state of one query. */
typedef struct {
    const cylint_scene *scene;
    cylint_line line;     /* tmax decreases to the nearest hit so far */
    cylint_frame_ray ray; /* its length does too */
    size_t best;          /* nearest: the shape's number, and its hit */
    cylint_hit hit;
    size_t count, enough;    /* count */
    cylint_number_heap heap; /* all; else its `numbers` is NULL */
    uint32_t recent[RECENT];
    cylint_number_set counted;
    size_t except; /* the number of a shape that is not tested */
} search;

/* Stores the nearest hit so far.  A root that rounds to t is less than the double
 * above t, so that bounds the domain for nearer hits and for hits at the same t
 * with a lower number. */
static void keep_nearest(search *q, size_t number, const cylint_hit *hit)
{
    q->best = number;
    q->hit = *hit;
    if (cylint_less(hit->t, q->line.tmax))
        q->line.tmax = cylint_next_above(hit->t);
}

/* Tests a shape and stores its hit if it is the nearest so far. */
static int test_nearest(search *q, size_t number)
{
    cylint_answer answer;
    if (number == q->except ||
        !cylint_intersect(&q->scene->shapes[number], &q->line,
                          KEPT_MEMBERS | CYLINT_WANT_NEAREST, &answer))
        return 0;
    const cylint_hit *hit = &answer.hit[0];
    if (q->best < q->scene->n &&
        (cylint_less(q->hit.t, hit->t) ||
         (!cylint_less(hit->t, q->hit.t) && number > q->best)))
        return 0;
    keep_nearest(q, number, hit);
    return 1;
}

/* Counts a shape that is hit.  Returns whether there are enough now. */
static int count_number(search *q, size_t number)
{
    if (q->heap.numbers)
        cylint_heap_add(&q->heap, number, 0);
    else
        q->count++;
    return q->enough != 0 && q->count == q->enough;
}

static int is_candidate(const search *q, size_t number)
{
    return number != q->except &&
           (!q->heap.numbers || cylint_heap_accepts(&q->heap, number));
}

/* Tests a shape and counts it if it is hit.  Returns whether there are enough
 * now. */
static int test_count(search *q, size_t number)
{
    return is_candidate(q, number) &&
           cylint_occluded(&q->scene->shapes[number], &q->line) &&
           count_number(q, number);
}

/* Whether the lane's shape has other pieces. */
static int is_split(const cylint_leaf *leaf, int lane)
{
    return cylint_leaf_piece(leaf, lane).count > 1;
}

static int was_tested(search *q, uint32_t number)
{
    uint32_t *recent = &q->recent[number % RECENT];
    const int was = *recent == number;
    *recent = number;
    return was;
}

/* Whether the lane's piece contains the shape's first hit.  The traversal finds
 * that piece, and no other piece contains the hit. */
static int owns_first_hit(const search *q, const cylint_leaf *leaf, int lane)
{
    cylint_answer answer;
    return cylint_intersect(&q->scene->shapes[leaf->number[lane]], &q->line,
                            CYLINT_WANT_NEAREST | CYLINT_WANT_Z, &answer) &&
           cylint_leaf_owns(leaf, lane, answer.hit[0].z);
}

/* As test_count() for a shape of several pieces. */
static int test_piece(search *q, const cylint_leaf *leaf, int lane)
{
    const uint32_t number = leaf->number[lane];
    uint32_t *slot = cylint_set_slot(&q->counted, number);
    if (*slot == number || !is_candidate(q, number))
        return 0;
    if (cylint_set_is_full(&q->counted))
        return owns_first_hit(q, leaf, lane) && count_number(q, number);
    if (was_tested(q, number) ||
        !cylint_occluded(&q->scene->shapes[number], &q->line))
        return 0;
    cylint_set_add(&q->counted, slot, number);
    return count_number(q, number);
}

/* Begins to load what a query reads of the lanes' shapes.  Always inlined: GCC
 * removes calls of a function which only prefetches. */
CYLINT_INLINE void prefetch_shapes(const search *q, const cylint_leaf *leaf,
                                   unsigned lanes)
{
#ifdef __GNUC__
    for (; lanes; lanes &= lanes - 1) {
        const char *shape =
            (const char *)&q->scene->shapes[leaf->number[cylint_lowest(lanes)]];
        for (size_t i = 0;
             i < offsetof(cylint_shape, library.number[CYLINT_AT_ERROR]);
             i += 64)
            __builtin_prefetch(shape + i);
    }
#else
    (void)q;
    (void)leaf;
    (void)lanes;
#endif
}

/* The lane with the least t. */
static int nearest_lane(unsigned lanes, const double least[CYLINT_LEAF_SIZE])
{
    int first = -1;
    for (int lane = 0; lane < CYLINT_LEAF_SIZE; lane++)
        if (lanes >> lane & 1 && (first < 0 || least[lane] < least[first]))
            first = lane;
    return first;
}

static int test_leaf_nearest(void *self, const cylint_leaf *leaf,
                             unsigned lanes,
                             const double least[CYLINT_LEAF_SIZE])
{
    search *q = self;
    while (lanes) {
        const int lane = nearest_lane(lanes, least);
        if (least[lane] > q->ray.length)
            break;
        lanes &= ~(1u << lane);
        if ((is_split(leaf, lane) && was_tested(q, leaf->number[lane])) ||
            !test_nearest(q, leaf->number[lane]))
            continue;
        q->ray.length =
            fmin(q->ray.length, cylint_frame_reach(&q->ray, q->hit.t));
    }
    return 0;
}

static int test_leaf_count(void *self, const cylint_leaf *leaf, unsigned lanes,
                           const double least[CYLINT_LEAF_SIZE])
{
    search *q = self;
    (void)least;
    if (q->enough != 1) /* else the first shape often ends the search */
        prefetch_shapes(q, leaf, lanes);
    for (; lanes; lanes &= lanes - 1) {
        const int lane = cylint_lowest(lanes);
        if (is_split(leaf, lane) ? test_piece(q, leaf, lane)
                                 : test_count(q, leaf->number[lane]))
            return 1;
    }
    return 0;
}

/* Traverses the hierarchy or, where the frame cannot hold the line, tests every
 * shape in it. */
static void traverse(search *q, int nearest)
{
    const cylint_scene *s = q->scene;
    if (s->n_bounded == 0)
        return;
    const cylint_frame_status status =
        cylint_frame_line(&s->frame, &q->line, &q->ray);
    if (status == CYLINT_FRAME_UNUSABLE) {
        for (size_t i = 0; i < s->n_bounded; i++) {
            const size_t number = s->bounded ? s->bounded[i] : i;
            if (nearest)
                test_nearest(q, number);
            else if (test_count(q, number))
                return;
        }
    } else if (status == CYLINT_FRAME_ENTERED) {
        if (!nearest)
            cylint_set_clear(&q->counted);
        s->traverse(&s->bvh, q->ray.o, q->ray.d, 0, &q->ray.length,
                    nearest ? test_leaf_nearest : test_leaf_count, q);
    }
}

static void start_search(search *q, const cylint_scene *scene,
                         const cylint_line *line)
{
    q->scene = scene;
    q->line = *line;
    q->best = q->except = scene->n;
    q->count = q->enough = 0;
    q->heap.numbers = NULL;
    memset(q->recent, 0xff, sizeof q->recent); /* CYLINT_NO_SHAPE */
}

/* Tests the nearest of the shapes beside the hierarchy, or all of them if that
 * is left out. */
static void test_others_nearest(search *q)
{
    const cylint_scene *s = q->scene;
    cylint_hit hit;
    const size_t first = cylint_nearest(&s->pack, &q->line, KEPT_MEMBERS, &hit);
    if (first == s->n_others)
        return;
    if (s->others[first] != q->except) {
        keep_nearest(q, s->others[first], &hit);
        return;
    }
    for (size_t i = 0; i < s->n_others; i++)
        test_nearest(q, s->others[i]);
}

size_t cylint_scene_nearest_other(const cylint_scene *scene,
                                  const cylint_line *line, size_t except,
                                  unsigned want, cylint_hit *hit)
{
    search q;
    start_search(&q, scene, line);
    q.except = except;
    test_others_nearest(&q);
    traverse(&q, 1);
    if (q.best < scene->n)
        cylint_write_hit(&scene->shapes[q.best], line, &q.hit, want, hit);
    return q.best;
}

size_t cylint_scene_nearest(const cylint_scene *scene, const cylint_line *line,
                            unsigned want, cylint_hit *hit)
{
    return cylint_scene_nearest_other(scene, line, scene->n, want, hit);
}

size_t cylint_scene_count(const cylint_scene *scene, const cylint_line *line,
                          size_t enough)
{
    search q;
    start_search(&q, scene, line);
    q.enough = enough;
    q.count = cylint_count(&scene->pack, line, enough);
    if (enough == 0 || q.count < enough)
        traverse(&q, 0);
    return q.count;
}

int cylint_scene_occluded(const cylint_scene *scene, const cylint_line *line,
                          size_t except)
{
    search q;
    start_search(&q, scene, line);
    q.enough = 1;
    q.except = except;
    for (size_t i = 0; i < scene->n_others; i++)
        if (test_count(&q, scene->others[i]))
            return 1;
    traverse(&q, 0);
    return q.count > 0;
}

size_t cylint_scene_all(const cylint_scene *scene, const cylint_line *line,
                        size_t first, size_t *numbers, size_t capacity)
{
    search q;
    if (capacity == 0)
        return 0;
    start_search(&q, scene, line);
    q.heap = (cylint_number_heap){
        .numbers = numbers, .capacity = capacity, .first = first};
    for (size_t i = 0; i < scene->n_others; i++)
        test_count(&q, scene->others[i]);
    traverse(&q, 0);
    cylint_heap_sort(&q.heap);
    return q.heap.n;
}
