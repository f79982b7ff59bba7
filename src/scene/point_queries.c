/*
 * point_queries.c - the distances of a point from the shapes of a scene
 */
#include <math.h>

#include "../numbers/bits.h"
#include "number_heap.h"
#include "visit.h"

/* ---------------------------------------------------- the closest_so_far one --- */

typedef struct {
    size_t number;         /* of the closest_so_far shape so far; n: none */
    cylint_closest answer; /* of it: distance and flags */
    size_t n;
} closest_so_far;

static double keep_closest(void *context, size_t number, double distance,
                           int flags)
{
    closest_so_far *q = context;
    const double size = fabs(distance);
    const double least = q->number < q->n ? fabs(q->answer.distance) : HUGE_VAL;
    if (q->number == q->n || cylint_less(size, least) ||
        (!cylint_less(least, size) && number < q->number)) {
        q->number = number;
        q->answer.distance = distance;
        q->answer.flags = flags;
        return size;
    }
    return least;
}

/* The members that the visit does not compute. */
#define WANTED (CYLINT_WANT_PART | CYLINT_WANT_POINT | CYLINT_WANT_NORMAL)

size_t cylint_scene_closest(const cylint_scene *scene, const double point[3],
                            double radius, unsigned want,
                            cylint_closest *answer)
{
    closest_so_far q = {.number = scene->n, .n = scene->n};
    cylint_shape shape;
    cylint_visit_point(scene, point, radius, 1, keep_closest, &q);
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
                                 size_t enough)
{
    near_counter q = {radius, 0, enough};
    cylint_visit_point(scene, point, radius, enough == 1, count_near, &q);
    return q.count;
}

typedef struct {
    double radius;
    cylint_number_heap heap;
} collection;

static double collect_near(void *context, size_t number, double distance,
                           int flags)
{
    collection *q = context;
    (void)flags;
    if (cylint_heap_accepts(&q->heap, number))
        cylint_heap_add(&q->heap, number, fabs(distance));
    return q->radius;
}

size_t cylint_scene_within(const cylint_scene *scene, const double point[3],
                           double radius, size_t first, size_t *numbers,
                           double *distances, size_t capacity)
{
    collection q = {radius,
                    {.numbers = numbers,
                     .values = distances,
                     .capacity = capacity,
                     .first = first}};
    if (capacity == 0)
        return 0;
    cylint_scene_visit_point(scene, point, radius, collect_near, &q);
    cylint_heap_sort(&q.heap);
    return q.heap.n;
}
