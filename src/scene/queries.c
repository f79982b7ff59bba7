/*
 * queries.c - what cylint_nearest() and cylint_count() return for all shapes of a
 * scene
 */
#include <math.h>

#include "../numbers/bits.h"
#include "../intersect.h"
#include "number_heap.h"
#include "visit.h"

/* -------------------------------------------------------- the nearest --- */

/* Members of hits that are no longer the nearest later; the others are computed
 * at the end. */
enum { EARLY_MEMBERS = CYLINT_WANT_T | CYLINT_WANT_PART };

typedef struct {
    size_t number; /* of the nearest shape so far; n: none */
    cylint_hit hit;
    size_t n;
} nearest;

static double keep_nearest_hit(void *context, size_t number,
                               const cylint_hit *hit)
{
    nearest *q = context;
    if (q->number == q->n || cylint_less(hit->t, q->hit.t) ||
        (!cylint_less(q->hit.t, hit->t) && number < q->number)) {
        q->number = number;
        q->hit = *hit;
    }
    return q->hit.t;
}

/* Stores the nearest of the shapes beside the hierarchy.  Returns whether it is
 * not left out; if it is, each of them is tested later. */
static int keep_nearest_other(nearest *q, const cylint_scene *scene,
                              const cylint_line *line, size_t except)
{
    cylint_hit hit;
    const size_t first =
        cylint_nearest(&scene->pack, line, EARLY_MEMBERS, &hit);
    if (first == scene->n_others)
        return 1;
    if (scene->others[first] == except)
        return 0;
    keep_nearest_hit(q, scene->others[first], &hit);
    return 1;
}

size_t cylint_scene_nearest_other(const cylint_scene *scene,
                                  const cylint_line *line, size_t except,
                                  unsigned want, cylint_hit *hit)
{
    nearest q = {.number = scene->n, .n = scene->n};
    cylint_shape shape;
    const cylint_visit_options options = {
        .except = except,
        .want = EARLY_MEMBERS,
        .often = 1,
        .first_other =
            keep_nearest_other(&q, scene, line, except) ? scene->n_others : 0};
    cylint_visit_line(scene, line, &options,
                      q.number < q.n ? q.hit.t : HUGE_VAL, keep_nearest_hit,
                      &q);
    if (q.number == q.n)
        return q.n;
    cylint_copy_hit(hit, &q.hit, want & EARLY_MEMBERS);
    if (want & ~(unsigned)EARLY_MEMBERS) {
        cylint_record_shape(&scene->records, q.number, &shape);
        cylint_write_hit(&shape, line, &q.hit, want, hit);
    }
    return q.number;
}

size_t cylint_scene_nearest(const cylint_scene *scene, const cylint_line *line,
                            unsigned want, cylint_hit *hit)
{
    return cylint_scene_nearest_other(scene, line, scene->n, want, hit);
}

/* --------------------------------------------------------- all that hit -- */

typedef struct {
    size_t count, enough;
} hit_counter;

static double count_hit(void *context, size_t number, const cylint_hit *hit)
{
    hit_counter *q = context;
    (void)number;
    (void)hit;
    return ++q->count == q->enough ? (double)NAN : HUGE_VAL;
}

size_t cylint_scene_count(const cylint_scene *scene, const cylint_line *line,
                          size_t enough)
{
    const cylint_visit_options options = {.except = scene->n,
                                          .often = enough == 1,
                                          .in_no_order = enough == 0,
                                          .first_other = scene->n_others};
    const size_t others =
        scene->n_others > 0 ? cylint_count(&scene->pack, line, enough) : 0;
    hit_counter q = {others, enough};
    if (enough == 0 || q.count < enough)
        cylint_visit_line(scene, line, &options, HUGE_VAL, count_hit, &q);
    return q.count;
}

int cylint_scene_occluded(const cylint_scene *scene, const cylint_line *line,
                          size_t except)
{
    const cylint_visit_options options = {.except = except, .often = 1};
    hit_counter q = {0, 1};
    if (except >= scene->n)
        return cylint_scene_count(scene, line, 1) > 0;
    cylint_visit_line(scene, line, &options, HUGE_VAL, count_hit, &q);
    return q.count > 0;
}

static double collect_hit(void *context, size_t number, const cylint_hit *hit)
{
    cylint_number_heap *heap = context;
    (void)hit;
    if (cylint_heap_accepts(heap, number))
        cylint_heap_add(heap, number, 0);
    return HUGE_VAL;
}

size_t cylint_scene_all(const cylint_scene *scene, const cylint_line *line,
                        size_t first, size_t *numbers, size_t capacity)
{
    cylint_number_heap heap = {
        .numbers = numbers, .capacity = capacity, .first = first};
    if (capacity == 0)
        return 0;
    const cylint_visit_options options = {.except = scene->n, .in_no_order = 1};
    cylint_visit_line(scene, line, &options, HUGE_VAL, collect_hit, &heap);
    cylint_heap_sort(&heap);
    return heap.n;
}
