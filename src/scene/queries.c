/*
 * queries.c - exact answers about a line and many shapes, of which few are tested
 *
 * A hierarchy over pieces of shapes (bvh.h) rejects shapes that the line
 * certainly does not hit, or hits behind the nearest hit so far (traverse.h).
 * Of the others local coordinates in doubles reject nearly all that the line does
 * not hit; cylint_intersect() tests the rest.
 */
#include <math.h>
#include <stddef.h>

#include "../numbers/bits.h"
#include "../intersect.h"
#include "number_heap.h"
#include "number_set.h"
#include "scene.h"

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

/* Whether the line hits the shape: 0, 1, or CYLINT_UNDECIDED. */
static int is_hit_in_doubles(const search *q, size_t number)
{
    const cylint_records *r = &q->scene->records;
    const cylint_record *at = &r->record[number];
    const unsigned tag = r->tag[number];
    return tag & CYLINT_TAG_PLAIN
               ? cylint_occluded_in_doubles(
                     (int)(tag & CYLINT_TAG_KIND),
                     (int)(tag / CYLINT_TAG_ENDS % 8), at->p0, at->r0, at->p1,
                     at->r1, &q->line)
               : CYLINT_UNDECIDED;
}

static int is_hit(const search *q, size_t number)
{
    cylint_shape shape;
    const int is = is_hit_in_doubles(q, number);
    if (is != CYLINT_UNDECIDED)
        return is;
    cylint_record_shape(&q->scene->records, number, &shape);
    return cylint_occluded(&shape, &q->line);
}

/* As cylint_intersect(). */
static int intersect(const search *q, size_t number, unsigned want,
                     cylint_answer *answer)
{
    cylint_shape shape;
    if (is_hit_in_doubles(q, number) == 0)
        return 0;
    cylint_record_shape(&q->scene->records, number, &shape);
    return cylint_intersect(&shape, &q->line, want, answer);
}

/* Tests a shape and stores its hit if it is the nearest so far. */
static int test_nearest(search *q, size_t number)
{
    cylint_answer answer;
    if (number == q->except ||
        !intersect(q, number, KEPT_MEMBERS | CYLINT_WANT_NEAREST, &answer))
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
           is_hit(q, number) && count_number(q, number);
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
    return intersect(q, leaf->number[lane],
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
    if (was_tested(q, number) || !is_hit(q, number))
        return 0;
    cylint_set_add(&q->counted, slot, number);
    return count_number(q, number);
}

/* Begins to load the lanes' shapes.  Always inlined: GCC removes calls of a function
 * which only prefetches. */
CYLINT_INLINE void prefetch_shapes(const search *q, const cylint_leaf *leaf,
                                   unsigned lanes)
{
#ifdef __GNUC__
    const cylint_records *r = &q->scene->records;
    for (; lanes; lanes &= lanes - 1) {
        const uint32_t number = leaf->number[cylint_lowest(lanes)];
        __builtin_prefetch(&r->record[number]);
        __builtin_prefetch(&r->tag[number]);
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

/* t, part and side are known. */
static void write_hit(const search *q, const cylint_line *line, unsigned want,
                      cylint_hit *hit)
{
    cylint_shape shape;
    if (want & ~(unsigned)KEPT_MEMBERS) {
        cylint_record_shape(&q->scene->records, q->best, &shape);
        cylint_write_hit(&shape, line, &q->hit, want, hit);
    } else {
        cylint_copy_hit(hit, &q->hit, want);
    }
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
        write_hit(&q, line, want, hit);
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
