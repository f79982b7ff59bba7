/*
 * point_queries.c - the distances of a point from the shapes of a scene, and the
 * solids that hold it
 */
#include <math.h>

#include "../numbers/bits.h"
#include "number_heap.h"
#include "visit.h"

/* The distance that a query compares. */
static double compared(unsigned want, double distance)
{
    return want & CYLINT_SIGNED ? distance : fabs(distance);
}

/* ---------------------------------------------------- the closest one --- */

typedef struct {
    size_t number;         /* of the closest shape so far; n: none */
    double least;          /* its compared distance */
    cylint_closest answer; /* of it: distance and flags */
    size_t n;
    unsigned want;
} closest_so_far;

static double keep_closest(void *context, size_t number, double distance,
                           int flags)
{
    closest_so_far *q = context;
    const double size = compared(q->want, distance);
    if (q->number == q->n || cylint_less(size, q->least) ||
        (!cylint_less(q->least, size) && number < q->number)) {
        q->number = number;
        q->least = size;
        q->answer.distance = distance;
        q->answer.flags = flags;
    }
    return q->least;
}

/* The members that the visit does not compute. */
#define WANTED (CYLINT_WANT_PART | CYLINT_WANT_POINT | CYLINT_WANT_NORMAL)

size_t cylint_scene_closest(const cylint_scene *scene, const double point[3],
                            double radius, unsigned want,
                            cylint_closest *answer)
{
    closest_so_far q = {.number = scene->n, .n = scene->n, .want = want};
    cylint_shape shape;
    cylint_visit_point(scene, point, radius, cylint_nearness_of(want), 1,
                       keep_closest, &q);
    if (q.number == q.n)
        return q.n;
    if (want & WANTED) {
        cylint_record_shape(&scene->records, q.number, &shape);
        cylint_distance(&shape, point, want, answer);
    } else {
        answer->distance = q.answer.distance;
        answer->flags = q.answer.flags;
    }
    return q.number;
}

/* ------------------------------------------------- all within a radius -- */

typedef struct {
    double radius;
    size_t count, enough;
} near_counter;

static double count_near(void *context, size_t number, double distance,
                         int flags)
{
    near_counter *q = context;
    (void)number;
    (void)distance;
    (void)flags;
    return ++q->count == q->enough ? (double)NAN : q->radius;
}

size_t cylint_scene_within_count(const cylint_scene *scene,
                                 const double point[3], double radius,
                                 unsigned want, size_t enough)
{
    near_counter q = {radius, 0, enough};
    cylint_visit_point(scene, point, radius, cylint_nearness_of(want),
                       enough == 1, count_near, &q);
    return q.count;
}

size_t cylint_scene_contains(const cylint_scene *scene, const double point[3],
                             size_t enough)
{
    near_counter q = {0, 0, enough};
    cylint_visit_point(scene, point, 0, CYLINT_HOLDING, enough == 1, count_near,
                       &q);
    return q.count;
}

typedef struct {
    double radius;
    unsigned want;
    cylint_number_heap heap;
} collection;

static double collect_near(void *context, size_t number, double distance,
                           int flags)
{
    collection *q = context;
    (void)flags;
    if (cylint_heap_accepts(&q->heap, number))
        cylint_heap_add(&q->heap, number, compared(q->want, distance));
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
    cylint_heap_sort(&q.heap);
    return q.heap.n;
}
