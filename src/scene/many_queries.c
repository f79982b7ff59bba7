/*
 * many_queries.c - the queries of many lines or points, by several threads
 */
#include <math.h>

#include "../bvh/threads.h"
#include "../distance/lanes.h"
#include "../intersect.h"
#include "../shapes/measure.h"
#include "scene.h"

/* BLOCK: how many a thread takes at a time; they last 0.1 ms or more, so that
 * taking them costs nothing.  LEAST: how many pay for starting a thread. */
enum { BLOCK = 256, LEAST = 1024 };

/* A query, and how it answers for line or point i. */
typedef struct many_query many_query;
typedef void answer_one(const many_query *q, size_t i);

struct many_query {
    const cylint_scene *scene;
    answer_one *answer;
    const cylint_lines *lines;
    const cylint_points *points;
    const size_t *except;
    const double *radii;
    size_t enough;
    size_t *numbers; /* of shapes, or how many */
    signed char *any;
    cylint_hit_columns hits;
    cylint_closest_columns closest;
    unsigned want; /* the members that the columns need */
};

static void answer_some(void *self, size_t from, size_t to)
{
    const many_query *q = self;
    for (size_t i = from; i < to; i++)
        q->answer(q, i);
}

static void run(many_query *q, size_t n, int threads)
{
    cylint_threads_share(threads, n, BLOCK, LEAST, answer_some, q);
}

/* -------------------------------------------------------------- lines --- */

static cylint_line line_at(const many_query *q, size_t i)
{
    cylint_line line;
    cylint_read_line(q->lines, i, &line);
    return line;
}

/* The shape that is left out for line i; n: none. */
static size_t left_out(const many_query *q, size_t i)
{
    return q->except ? q->except[i] : q->scene->n;
}

static unsigned wanted_of_hits(const cylint_hit_columns *to)
{
    return (to->t ? CYLINT_WANT_T : 0u) |
           (to->part || to->side ? CYLINT_WANT_PART : 0u) |
           (cylint_has_vector(to->point) ? CYLINT_WANT_POINT : 0u) |
           (cylint_has_vector(to->normal) ? CYLINT_WANT_NORMAL : 0u) |
           (to->z ? CYLINT_WANT_Z : 0u) | (to->phi ? CYLINT_WANT_PHI : 0u);
}

static void write_hit_row(const cylint_hit_columns *to, size_t i,
                          const cylint_hit *hit)
{
    if (to->t)
        to->t[i] = hit->t;
    if (to->part)
        to->part[i] = (signed char)hit->part;
    if (to->side)
        to->side[i] = (signed char)hit->side;
    cylint_write_vector(to->point, i, hit->point);
    cylint_write_vector(to->normal, i, hit->normal);
    if (to->z)
        to->z[i] = hit->z;
    if (to->phi)
        to->phi[i] = hit->phi;
}

static void find_nearest(const many_query *q, size_t i)
{
    const cylint_line line = line_at(q, i);
    cylint_hit hit = {.t = NAN,
                      .point = {NAN, NAN, NAN},
                      .normal = {NAN, NAN, NAN},
                      .z = NAN,
                      .phi = NAN,
                      .part = -1,
                      .side = -1};
    const size_t number = cylint_scene_nearest_other(
        q->scene, &line, left_out(q, i), q->want, &hit);
    if (q->numbers)
        q->numbers[i] = number;
    write_hit_row(&q->hits, i, &hit);
}

void cylint_scene_nearest_lines(const cylint_scene *scene,
                                const cylint_lines *lines, const size_t *except,
                                int threads, size_t *numbers,
                                const cylint_hit_columns *hits)
{
    many_query q = {scene, find_nearest, lines, .except = except,
                    .numbers = numbers};
    if (hits)
        q.hits = *hits;
    q.want = wanted_of_hits(&q.hits);
    run(&q, lines->n, threads);
}

static void find_any(const many_query *q, size_t i)
{
    const cylint_line line = line_at(q, i);
    q->any[i] =
        (signed char)cylint_scene_occluded(q->scene, &line, left_out(q, i));
}

void cylint_scene_any_lines(const cylint_scene *scene,
                            const cylint_lines *lines, const size_t *except,
                            int threads, signed char *any)
{
    many_query q = {scene, find_any, lines, .except = except, .any = any};
    if (any)
        run(&q, lines->n, threads);
}

static void count_hits(const many_query *q, size_t i)
{
    const cylint_line line = line_at(q, i);
    q->numbers[i] = cylint_scene_count(q->scene, &line, q->enough);
}

void cylint_scene_count_lines(const cylint_scene *scene,
                              const cylint_lines *lines, size_t enough,
                              int threads, size_t *counts)
{
    many_query q = {scene, count_hits, lines, .enough = enough,
                    .numbers = counts};
    if (counts)
        run(&q, lines->n, threads);
}

/* -------------------------------------------------------------- points -- */

static void find_closest(const many_query *q, size_t i)
{
    double point[3];
    cylint_closest answer = {.distance = NAN,
                             .point = {NAN, NAN, NAN},
                             .normal = {NAN, NAN, NAN},
                             .part = -1,
                             .feature = -1};
    cylint_read_point(q->points, i, point);
    const size_t number = cylint_scene_closest(
        q->scene, point, q->radii ? q->radii[i] : HUGE_VAL, q->want, &answer);
    if (q->numbers)
        q->numbers[i] = number;
    cylint_write_closest(&q->closest, i, &answer);
}

void cylint_scene_closest_points(const cylint_scene *scene,
                                 const cylint_points *points,
                                 const double *radii, int threads,
                                 size_t *numbers,
                                 const cylint_closest_columns *answers)
{
    many_query q = {scene, find_closest, .points = points, .radii = radii,
                    .numbers = numbers};
    if (answers)
        q.closest = *answers;
    q.want = cylint_wanted_of_closest(&q.closest);
    run(&q, points->n, threads);
}
