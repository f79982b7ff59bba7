/*
 * many_queries.c - the queries of many lines or points, by several threads
 */
#include <math.h>

#include "../bvh/threads.h"
#include "../distance/columns.h"
#include "../intersect.h"
#include "../shapes/measure.h"
#include "scene.h"

/* BLOCK: what a thread takes at a time; it lasts some 0.1 ms, so that taking it
 * costs nothing.  LEAST: what pays for starting a thread. */
enum { BLOCK = 256, LEAST = 1024 };

/* -------------------------------------------------------------- lines --- */

/* A query, and how it answers for line i. */
typedef struct lines_query lines_query;
typedef void answer_line(const lines_query *q, size_t i,
                         const cylint_line *line);

struct lines_query {
    const cylint_scene *scene;
    const cylint_lines *lines;
    answer_line *answer;
    const size_t *except;
    size_t enough;
    size_t *numbers; /* of shapes, or how many */
    signed char *any;
    cylint_hit_columns hits;
    unsigned want; /* the members that the columns need */
};

static void answer_lines(void *self, size_t from, size_t to)
{
    const lines_query *q = self;
    for (size_t i = from; i < to; i++) {
        cylint_line line;
        cylint_read_line(q->lines, i, &line);
        q->answer(q, i, &line);
    }
}

static void run_lines(lines_query *q, int threads)
{
    cylint_threads_share(threads, q->lines->n, BLOCK, LEAST, answer_lines, q);
}

/* The shape that is left out for line i; n: none. */
static size_t left_out(const lines_query *q, size_t i)
{
    return q->except ? q->except[i] : q->scene->n;
}

static int has_vector(double *const column[3])
{
    return column[0] || column[1] || column[2];
}

static void write_vector(double *const column[3], size_t i, const double x[3])
{
    for (int j = 0; j < 3; j++)
        if (column[j])
            column[j][i] = x[j];
}

static unsigned wanted_of_hits(const cylint_hit_columns *to)
{
    return (to->t ? CYLINT_WANT_T : 0u) |
           (to->part || to->side ? CYLINT_WANT_PART : 0u) |
           (has_vector(to->point) ? CYLINT_WANT_POINT : 0u) |
           (has_vector(to->normal) ? CYLINT_WANT_NORMAL : 0u) |
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
    write_vector(to->point, i, hit->point);
    write_vector(to->normal, i, hit->normal);
    if (to->z)
        to->z[i] = hit->z;
    if (to->phi)
        to->phi[i] = hit->phi;
}

static void find_nearest(const lines_query *q, size_t i,
                         const cylint_line *line)
{
    cylint_hit hit = {.t = NAN,
                      .point = {NAN, NAN, NAN},
                      .normal = {NAN, NAN, NAN},
                      .z = NAN,
                      .phi = NAN,
                      .part = -1,
                      .side = -1};
    const size_t number = cylint_scene_nearest_other(
        q->scene, line, left_out(q, i), q->want, &hit);
    if (q->numbers)
        q->numbers[i] = number;
    write_hit_row(&q->hits, i, &hit);
}

void cylint_scene_nearest_lines(const cylint_scene *scene,
                                const cylint_lines *lines, const size_t *except,
                                int threads, size_t *numbers,
                                const cylint_hit_columns *hits)
{
    lines_query q = {scene, lines, find_nearest, .except = except,
                     .numbers = numbers};
    if (hits)
        q.hits = *hits;
    q.want = wanted_of_hits(&q.hits);
    run_lines(&q, threads);
}

static void find_any(const lines_query *q, size_t i, const cylint_line *line)
{
    q->any[i] =
        (signed char)cylint_scene_occluded(q->scene, line, left_out(q, i));
}

void cylint_scene_any_lines(const cylint_scene *scene,
                            const cylint_lines *lines, const size_t *except,
                            int threads, signed char *any)
{
    lines_query q = {scene, lines, find_any, .except = except, .any = any};
    if (any)
        run_lines(&q, threads);
}

static void count_hits(const lines_query *q, size_t i, const cylint_line *line)
{
    q->numbers[i] = cylint_scene_count(q->scene, line, q->enough);
}

void cylint_scene_count_lines(const cylint_scene *scene,
                              const cylint_lines *lines, size_t enough,
                              int threads, size_t *counts)
{
    lines_query q = {scene, lines, count_hits, .enough = enough,
                     .numbers = counts};
    if (counts)
        run_lines(&q, threads);
}

/* -------------------------------------------------------------- points -- */

typedef struct {
    const cylint_scene *scene;
    const cylint_points *points;
    const double *radii;
    size_t *numbers;
    cylint_closest_columns answers;
    unsigned want;
} closest_query;

static void find_closest(void *self, size_t from, size_t to)
{
    static const cylint_closest none = {.distance = NAN,
                                        .point = {NAN, NAN, NAN},
                                        .normal = {NAN, NAN, NAN},
                                        .part = -1,
                                        .feature = -1};
    const closest_query *q = self;
    for (size_t i = from; i < to; i++) {
        double point[3];
        cylint_closest answer = none;
        cylint_read_point(q->points, i, point);
        const size_t number = cylint_scene_closest(
            q->scene, point, q->radii ? q->radii[i] : HUGE_VAL, q->want,
            &answer);
        if (q->numbers)
            q->numbers[i] = number;
        cylint_write_closest(&q->answers, i, &answer);
    }
}

void cylint_scene_closest_points(const cylint_scene *scene,
                                 const cylint_points *points,
                                 const double *radii, int threads,
                                 size_t *numbers,
                                 const cylint_closest_columns *answers)
{
    closest_query q = {
        .scene = scene, .points = points, .radii = radii, .numbers = numbers};
    if (answers)
        q.answers = *answers;
    q.want = cylint_wanted_of_closest(&q.answers);
    cylint_threads_share(threads, points->n, BLOCK, LEAST, find_closest, &q);
}
