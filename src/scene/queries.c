/*
 * queries.c - the nearest, the count and the lowest numbers of the shapes of a
 * scene that a line hits, or that are near a point
 */
#include <math.h>

#include "../numbers/bits.h"
#include "../intersect.h"
#include "visit.h"

/* ------------------------------------------------ results of a visit --- */

/* The shape of the least t or distance so far; of equal ones that of the lowest
 * number. */
typedef struct {
    size_t number; /* at first that of all shapes: none */
    double least;  /* at first infinite */
    cylint_hit hit;
    cylint_shape *shape; /* a copy of it is stored here, if not NULL */
    double distance;
} least_shape;

static double keep_least(void *context, const cylint_found *x)
{
    least_shape *q = context;
    if (!cylint_less(x->at, q->least) &&
        (cylint_less(q->least, x->at) || x->number > q->number))
        return q->least;
    q->number = x->number;
    q->least = x->at;
    if (x->hit)
        q->hit = *x->hit;
    if (q->shape)
        *q->shape = *x->shape;
    q->distance = x->distance;
    return q->least;
}

typedef struct {
    size_t count, enough;
} shape_counter;

static double count_one(void *context, const cylint_found *x)
{
    shape_counter *q = context;
    (void)x;
    return ++q->count == q->enough ? (double)NAN : HUGE_VAL;
}

/* A heap of the lowest numbers from `first` on, with the highest of them first.
 * values: NULL, or an array with a value for each number. */
typedef struct {
    size_t *numbers;
    double *values;
    size_t n, capacity, first;
} lowest_numbers;

static void put(lowest_numbers *heap, size_t at, size_t number, double value)
{
    heap->numbers[at] = number;
    if (heap->values)
        heap->values[at] = value;
}

static void move(lowest_numbers *heap, size_t to, size_t from)
{
    put(heap, to, heap->numbers[from], heap->values ? heap->values[from] : 0);
}

/* Stores the number in the heap of `n` numbers without its first. */
static void sift_down(lowest_numbers *heap, size_t n, size_t number,
                      double value)
{
    const size_t *numbers = heap->numbers;
    size_t at = 0, child;
    while ((child = 2 * at + 1) < n) {
        child += child + 1 < n && numbers[child + 1] > numbers[child];
        if (numbers[child] <= number)
            break;
        move(heap, at, child);
        at = child;
    }
    put(heap, at, number, value);
}

static void sift_up(lowest_numbers *heap, size_t at, size_t number,
                    double value)
{
    for (; at > 0 && heap->numbers[(at - 1) / 2] < number; at = (at - 1) / 2)
        move(heap, at, (at - 1) / 2);
    put(heap, at, number, value);
}

/* Adds the number if it is one of the lowest.  If the heap is full, it replaces the
 * highest. */
static double collect_number(void *context, const cylint_found *x)
{
    lowest_numbers *heap = context;
    if (x->number < heap->first)
        return HUGE_VAL;
    if (heap->n < heap->capacity)
        sift_up(heap, heap->n++, x->number, x->at);
    else if (x->number < heap->numbers[0])
        sift_down(heap, heap->capacity, x->number, x->at);
    return HUGE_VAL;
}

/* Sorts the numbers, ascending.  Then they are no heap.  Returns how many. */
static size_t sort_numbers(lowest_numbers *heap)
{
    for (size_t n = heap->n; n-- > 1;) {
        const size_t number = heap->numbers[n];
        const double value = heap->values ? heap->values[n] : 0;
        move(heap, n, 0);
        sift_down(heap, n, number, value);
    }
    return heap->n;
}

/* -------------------------------------------------------------- lines --- */

/* The members computed for each hit.  The others are computed once, for the nearest
 * hit. */
enum { COMPUTED = CYLINT_WANT_T | CYLINT_WANT_PART };

/* Stores the nearest of the shapes beside the hierarchy.  Returns 0 and stores
 * nothing if that shape is `except`: the visit then tests each of them. */
static int keep_nearest_other(least_shape *q, const cylint_scene *scene,
                              const cylint_line *line, size_t except)
{
    cylint_hit hit;
    const size_t first =
        scene->n_others > 0 ? cylint_nearest(&scene->pack, line, COMPUTED, &hit)
                            : 0;
    if (first == scene->n_others)
        return 1;
    if (scene->others[first] == except)
        return 0;
    keep_least(q, &(cylint_found){.number = scene->others[first],
                                  .at = hit.t,
                                  .hit = &hit,
                                  .shape = &scene->pack.shapes[first]});
    return 1;
}

size_t cylint_scene_nearest_other(const cylint_scene *scene,
                                  const cylint_line *line, size_t except,
                                  unsigned want, cylint_hit *hit)
{
    const unsigned more = want & ~(unsigned)COMPUTED;
    cylint_shape shape;
    least_shape q = {
        .number = scene->n, .least = HUGE_VAL, .shape = more ? &shape : NULL};
    const cylint_visit_options options = {
        .except = except,
        .want = COMPUTED,
        .may_repeat = 1,
        .first_other =
            keep_nearest_other(&q, scene, line, except) ? scene->n_others : 0};
    cylint_visit_line(scene, line, &options, q.least, keep_least, &q);
    const size_t number = q.number;
    if (number == scene->n)
        return number;
    cylint_copy_hit(hit, &q.hit, want & COMPUTED);
    if (more)
        cylint_write_hit(&shape, line, &q.hit, want, hit);
    return number;
}

size_t cylint_scene_nearest(const cylint_scene *scene, const cylint_line *line,
                            unsigned want, cylint_hit *hit)
{
    return cylint_scene_nearest_other(scene, line, scene->n, want, hit);
}

/* The shapes beside the hierarchy are counted together, unless one of them is left
 * out. */
static size_t count_except(const cylint_scene *scene, const cylint_line *line,
                           size_t except, size_t enough)
{
    const int together = !cylint_is_other(scene, except);
    const cylint_visit_options options = {.except = except,
                                          .may_repeat = enough == 1,
                                          .in_no_order = enough == 0,
                                          .first_other =
                                              together ? scene->n_others : 0};
    const size_t others = together && scene->n_others > 0
                              ? cylint_count(&scene->pack, line, enough)
                              : 0;
    shape_counter q = {others, enough};
    if (enough == 0 || q.count < enough)
        cylint_visit_line(scene, line, &options, HUGE_VAL, count_one, &q);
    return q.count;
}

size_t cylint_scene_count(const cylint_scene *scene, const cylint_line *line,
                          size_t enough)
{
    return count_except(scene, line, scene->n, enough);
}

int cylint_scene_occluded(const cylint_scene *scene, const cylint_line *line,
                          size_t except)
{
    return count_except(scene, line, except, 1) > 0;
}

size_t cylint_scene_all(const cylint_scene *scene, const cylint_line *line,
                        size_t first, size_t *numbers, size_t capacity)
{
    lowest_numbers heap = {numbers, NULL, 0, capacity, first};
    if (capacity == 0)
        return 0;
    const cylint_visit_options options = {.except = scene->n, .in_no_order = 1};
    cylint_visit_line(scene, line, &options, HUGE_VAL, collect_number, &heap);
    return sort_numbers(&heap);
}

/* ------------------------------------------------------------- points --- */

/* The members that the visit does not compute. */
#define UNCOMPUTED (CYLINT_WANT_PART | CYLINT_WANT_POINT | CYLINT_WANT_NORMAL)

size_t cylint_scene_closest(const cylint_scene *scene, const double point[3],
                            double radius, unsigned want,
                            cylint_closest *answer)
{
    const unsigned more = want & UNCOMPUTED;
    cylint_shape shape;
    least_shape q = {
        .number = scene->n, .least = HUGE_VAL, .shape = more ? &shape : NULL};
    cylint_visit_point(scene, point, radius, cylint_nearness_of(want), 1,
                       keep_least, &q);
    const size_t number = q.number;
    if (number == scene->n)
        return number;
    if (more) {
        cylint_distance(&shape, point, want, answer);
    } else {
        answer->distance = q.distance;
        answer->flags = 0; /* point and shape are valid */
    }
    return number;
}

static size_t count_about(const cylint_scene *scene, const double point[3],
                          double radius, cylint_nearness nearness,
                          size_t enough)
{
    shape_counter q = {0, enough};
    cylint_visit_point(scene, point, radius, nearness, enough == 1, count_one,
                       &q);
    return q.count;
}

size_t cylint_scene_within_count(const cylint_scene *scene,
                                 const double point[3], double radius,
                                 unsigned want, size_t enough)
{
    return count_about(scene, point, radius, cylint_nearness_of(want), enough);
}

size_t cylint_scene_contains(const cylint_scene *scene, const double point[3],
                             size_t enough)
{
    return count_about(scene, point, 0, CYLINT_HOLDING, enough);
}

size_t cylint_scene_within(const cylint_scene *scene, const double point[3],
                           double radius, unsigned want, size_t first,
                           size_t *numbers, double *distances, size_t capacity)
{
    lowest_numbers heap = {numbers, distances, 0, capacity, first};
    if (capacity == 0)
        return 0;
    cylint_visit_point(scene, point, radius, cylint_nearness_of(want), 0,
                       collect_number, &heap);
    return sort_numbers(&heap);
}

/* -------------------------------------------- callbacks of the caller --- */

typedef struct {
    cylint_scene_hit *hit; /* NULL: near */
    cylint_scene_near *near;
    void *context;
} caller;

static double call(void *self, const cylint_found *x)
{
    const caller *c = self;
    return c->hit ? c->hit(c->context, x->number, x->hit)
                  : c->near(c->context, x->number, x->distance, 0);
}

void cylint_scene_visit(const cylint_scene *scene, const cylint_line *line,
                        unsigned want, cylint_scene_hit *callback,
                        void *context)
{
    const cylint_visit_options options = {.except = scene->n,
                                          .want = want & CYLINT_WANT_ALL};
    caller c = {callback, NULL, context};
    cylint_visit_line(scene, line, &options, HUGE_VAL, call, &c);
}

void cylint_scene_visit_point(const cylint_scene *scene, const double point[3],
                              double radius, unsigned want,
                              cylint_scene_near *callback, void *context)
{
    caller c = {NULL, callback, context};
    cylint_visit_point(scene, point, radius, cylint_nearness_of(want), 0, call,
                       &c);
}
