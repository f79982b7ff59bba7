/*
 * queries.c - the nearest, the count and the lowest numbers of the shapes of a
 * scene that a line hits, or that are near a point
 */
#include <math.h>

#include "../numbers/bits.h"
#include "../intersect.h"
#include "visit.h"

/* ----------------------------------------------------- what they keep --- */

/* The shape of the least t or distance so far; of equal ones that of the lowest
 * number. */
typedef struct {
    size_t number, n; /* n: the number of all shapes; number = n: none yet */
    double least;
} least_shape;

/* Keeps the shape if it is before all others.  Returns whether it is. */
static int keep_least(least_shape *q, size_t number, double x)
{
    if (q->number < q->n && !cylint_less(x, q->least) &&
        (cylint_less(q->least, x) || number > q->number))
        return 0;
    q->number = number;
    q->least = x;
    return 1;
}

typedef struct {
    size_t count, enough;
    double wanted; /* what the callback returns until there are enough */
} shape_counter;

static double count_one(shape_counter *q)
{
    return ++q->count == q->enough ? (double)NAN : q->wanted;
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
static void collect_number(lowest_numbers *heap, size_t number, double value)
{
    if (number < heap->first)
        return;
    if (heap->n < heap->capacity)
        sift_up(heap, heap->n++, number, value);
    else if (number < heap->numbers[0])
        sift_down(heap, heap->capacity, number, value);
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

/* Members of hits that are no longer the nearest later; the others are computed
 * at the end. */
enum { EARLY_MEMBERS = CYLINT_WANT_T | CYLINT_WANT_PART };

typedef struct {
    least_shape first;
    cylint_hit hit;
} nearest;

static double keep_nearest_hit(void *context, size_t number,
                               const cylint_hit *hit)
{
    nearest *q = context;
    if (keep_least(&q->first, number, hit->t))
        q->hit = *hit;
    return q->first.least;
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
    nearest q = {
        .first = {.number = scene->n, .n = scene->n, .least = HUGE_VAL}};
    cylint_shape shape;
    const cylint_visit_options options = {
        .except = except,
        .want = EARLY_MEMBERS,
        .often = 1,
        .first_other =
            keep_nearest_other(&q, scene, line, except) ? scene->n_others : 0};
    cylint_visit_line(scene, line, &options, q.first.least, keep_nearest_hit,
                      &q);
    const size_t number = q.first.number;
    if (number == scene->n)
        return number;
    cylint_copy_hit(hit, &q.hit, want & EARLY_MEMBERS);
    if (want & ~(unsigned)EARLY_MEMBERS) {
        cylint_record_shape(&scene->records, number, &shape);
        cylint_write_hit(&shape, line, &q.hit, want, hit);
    }
    return number;
}

size_t cylint_scene_nearest(const cylint_scene *scene, const cylint_line *line,
                            unsigned want, cylint_hit *hit)
{
    return cylint_scene_nearest_other(scene, line, scene->n, want, hit);
}

static double count_hit(void *context, size_t number, const cylint_hit *hit)
{
    (void)number;
    (void)hit;
    return count_one(context);
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
    shape_counter q = {others, enough, HUGE_VAL};
    if (enough == 0 || q.count < enough)
        cylint_visit_line(scene, line, &options, HUGE_VAL, count_hit, &q);
    return q.count;
}

int cylint_scene_occluded(const cylint_scene *scene, const cylint_line *line,
                          size_t except)
{
    const cylint_visit_options options = {.except = except, .often = 1};
    shape_counter q = {0, 1, HUGE_VAL};
    if (except >= scene->n)
        return cylint_scene_count(scene, line, 1) > 0;
    cylint_visit_line(scene, line, &options, HUGE_VAL, count_hit, &q);
    return q.count > 0;
}

static double collect_hit(void *context, size_t number, const cylint_hit *hit)
{
    (void)hit;
    collect_number(context, number, 0);
    return HUGE_VAL;
}

size_t cylint_scene_all(const cylint_scene *scene, const cylint_line *line,
                        size_t first, size_t *numbers, size_t capacity)
{
    lowest_numbers heap = {
        .numbers = numbers, .capacity = capacity, .first = first};
    if (capacity == 0)
        return 0;
    const cylint_visit_options options = {.except = scene->n, .in_no_order = 1};
    cylint_visit_line(scene, line, &options, HUGE_VAL, collect_hit, &heap);
    return sort_numbers(&heap);
}

/* ------------------------------------------------------------- points --- */

/* The distance that a query compares. */
static double compared(unsigned want, double distance)
{
    return want & CYLINT_SIGNED ? distance : fabs(distance);
}

typedef struct {
    least_shape first;
    double distance;
    int flags;
    unsigned want;
} closest;

static double keep_closest(void *context, size_t number, double distance,
                           int flags)
{
    closest *q = context;
    if (keep_least(&q->first, number, compared(q->want, distance))) {
        q->distance = distance;
        q->flags = flags;
    }
    return q->first.least;
}

/* The members that the visit does not compute. */
#define WANTED (CYLINT_WANT_PART | CYLINT_WANT_POINT | CYLINT_WANT_NORMAL)

size_t cylint_scene_closest(const cylint_scene *scene, const double point[3],
                            double radius, unsigned want,
                            cylint_closest *answer)
{
    closest q = {.first = {.number = scene->n, .n = scene->n}, .want = want};
    cylint_shape shape;
    cylint_visit_point(scene, point, radius, cylint_nearness_of(want), 1,
                       keep_closest, &q);
    const size_t number = q.first.number;
    if (number == scene->n)
        return number;
    if (want & WANTED) {
        cylint_record_shape(&scene->records, number, &shape);
        cylint_distance(&shape, point, want, answer);
    } else {
        answer->distance = q.distance;
        answer->flags = q.flags;
    }
    return number;
}

static double count_near(void *context, size_t number, double distance,
                         int flags)
{
    (void)number;
    (void)distance;
    (void)flags;
    return count_one(context);
}

static size_t count_about(const cylint_scene *scene, const double point[3],
                          double radius, cylint_nearness nearness,
                          size_t enough)
{
    shape_counter q = {0, enough, radius};
    cylint_visit_point(scene, point, radius, nearness, enough == 1, count_near,
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

typedef struct {
    double radius;
    unsigned want;
    lowest_numbers heap;
} collection;

static double collect_near(void *context, size_t number, double distance,
                           int flags)
{
    collection *q = context;
    (void)flags;
    collect_number(&q->heap, number, compared(q->want, distance));
    return q->radius;
}

size_t cylint_scene_within(const cylint_scene *scene, const double point[3],
                           double radius, unsigned want, size_t first,
                           size_t *numbers, double *distances, size_t capacity)
{
    collection q = {radius,
                    want,
                    {.numbers = numbers,
                     .values = distances,
                     .capacity = capacity,
                     .first = first}};
    if (capacity == 0)
        return 0;
    cylint_scene_visit_point(scene, point, radius, want, collect_near, &q);
    return sort_numbers(&q.heap);
}
