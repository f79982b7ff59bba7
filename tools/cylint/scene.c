/*
 * scene.c - the shapes that every line is intersected with
 *
 * The library intersects them in batches or by a hierarchy.  A published method
 * intersects them one by one.  Both choose the lower number at equal t.
 */
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "left_out.h"
#include "main.h"
#include "report.h"
#include "scene.h"

static int add_shape(struct scene *scene, const cylint_shape *shape)
{
    if (scene->count == scene->capacity) {
        const size_t capacity = scene->capacity > 0 ? 2 * scene->capacity : 64;
        if (capacity > SIZE_MAX / sizeof *shape) {
            return out_of_memory();
        }
        cylint_shape *more = realloc(scene->shapes, capacity * sizeof *shape);
        if (!more) {
            return out_of_memory();
        }
        scene->shapes = more;
        scene->capacity = capacity;
    }
    scene->shapes[scene->count++] = *shape;
    return 0;
}

int scene_add(struct scene *scene, const struct record *record)
{
    const int status = scene->also ? scene->also(scene, record) : 0;
    return status != 0 ? status : add_shape(scene, &record->shape);
}

int scene_prepare(struct scene *scene, enum accel accel, int threads)
{
    return search_make(&scene->search, scene->shapes, scene->count, accel,
                       threads);
}

void scene_free(struct scene *scene)
{
    search_free(&scene->search);
    free(scene->shapes);
    scene->shapes = NULL;
}

int solve(solver method, const cylint_shape *shape, const cylint_line *line,
          unsigned want, cylint_answer *answer)
{
    if (method) {
        return method(shape, line, want, answer) == CYLINT_OK;
    }
    cylint_intersect(shape, line, want, answer);
    return 1;
}

static int solve_any(const struct scene_query *q, const cylint_shape *shape,
                     int *hit)
{
    cylint_answer answer;
    const int answered =
        solve(q->method, shape, q->line, CYLINT_WANT_COUNT, &answer);
    *hit = answered && answer.n > 0;
    return answered;
}

/* ------------------------------------------------------ by the library -- */

static double next_up(double t)
{
    return nextafter(t, HUGE_VAL);
}

/* Returns the nearest shape that is hit up to t = *end and not left out, or
 * `count`. */
static size_t nearest_until(const struct scene *scene,
                            const struct scene_query *q, double end)
{
    enum { CAPACITY = 256 };
    cylint_line line = *q->line;
    size_t number[CAPACITY], found, first = 0, nearest = scene->count;
    double t = 0;
    line.tmax = end < line.tmax ? end : line.tmax;
    do {
        found = search_hits(&scene->search, &line, q->hits, first, number,
                            CAPACITY);
        for (size_t i = 0; i < found; i++) {
            cylint_answer answer;
            if (!left_out_has(q->left_out, number[i])) {
                cylint_intersect(&scene->shapes[number[i]], &line,
                                 CYLINT_WANT_T | CYLINT_WANT_NEAREST, &answer);
                if (nearest == scene->count || answer.hit[0].t < t) {
                    nearest = number[i];
                    t = answer.hit[0].t;
                }
            }
        }
        first = found > 0 ? number[found - 1] + 1 : 0;
    } while (found == CAPACITY);
    return nearest;
}

/*
 * Returns the nearest of the shapes that are not left out.
 *
 * While the nearest of all shapes is left out, the search is repeated with tmin
 * = the double after its t.  The shape found in the end need not be the
 * nearest: another shape may be hit at the same t, or between that t and the
 * next double, where the line was cut.  But no farther shape is nearer.
 * Therefore all shapes that are hit up to that t are compared.
 */
static size_t nearest_by_search(const struct scene *scene,
                                const struct scene_query *q)
{
    cylint_line rest = *q->line;
    cylint_hit hit;
    size_t shape = search_nearest(&scene->search, &rest, CYLINT_WANT_T, &hit);
    if (shape == scene->count || !left_out_has(q->left_out, shape)) {
        return shape;
    }
    while (shape < scene->count && left_out_has(q->left_out, shape) &&
           next_up(hit.t) <= rest.tmax) {
        rest.tmin = next_up(hit.t);
        if (rest.tmin == HUGE_VAL) {
            break;
        }
        shape = search_nearest(&scene->search, &rest, CYLINT_WANT_T, &hit);
    }
    return nearest_until(scene, q, next_up(hit.t));
}

static unsigned long long count_by_search(const struct scene *scene,
                                          const struct scene_query *q,
                                          unsigned long long most)
{
    size_t left_out = 0;
    for (int i = 0; i < q->left_out->count; i++) {
        const size_t *shapes;
        const size_t count = left_out_shapes(q->left_out, i, &shapes);
        for (size_t k = 0; k < count; k++) {
            int hit;
            solve_any(q, &scene->shapes[shapes[k]], &hit);
            left_out += (size_t)hit;
        }
    }
    const size_t enough = most < SIZE_MAX ? (size_t)most + left_out : 0;
    return search_count(&scene->search, q->line, enough) - left_out;
}

/* --------------------------------------------------------- by a method -- */

/* Sets row->shape.  Returns 0, or the shape that the method does not support. */
static size_t nearest_by_method(const struct scene *scene,
                                const struct scene_query *q, struct row *row)
{
    const unsigned first = CYLINT_WANT_T | CYLINT_WANT_NEAREST;
    double t = 0;
    row->shape = 0;
    for (size_t i = 0; i < scene->count; i++) {
        cylint_answer answer;
        if (left_out_has(q->left_out, i)) {
            continue;
        }
        if (!solve(q->method, &scene->shapes[i], q->line, first, &answer)) {
            return i + 1;
        }
        if (answer.n > 0 && (row->shape == 0 || answer.hit[0].t < t)) {
            row->shape = i + 1;
            t = answer.hit[0].t;
        }
    }
    return 0;
}

static size_t count_by_method(const struct scene *scene,
                              const struct scene_query *q,
                              unsigned long long most, struct row *row)
{
    row->count = 0;
    for (size_t i = 0; i < scene->count && row->count < most; i++) {
        int hit = 0;
        if (!left_out_has(q->left_out, i) &&
            !solve_any(q, &scene->shapes[i], &hit)) {
            return i + 1;
        }
        row->count += (unsigned long long)hit;
    }
    return 0;
}

/* The columns of the nearest hit are computed for its shape only. */
size_t scene_nearest(const struct scene *scene, const struct scene_query *q,
                     const struct fields *fields, cylint_answer *answer,
                     struct row *row)
{
    const int by_search =
        !q->method && q->left_out->count == 0 && !fields->relation;
    row->answer = NULL;
    if (by_search) {
        const size_t i = search_nearest(&scene->search, q->line, fields->want,
                                        &answer->hit[0]);
        row->shape = i < scene->count ? i + 1 : 0;
        answer->n = 1;
    } else if (q->method) {
        const size_t refused = nearest_by_method(scene, q, row);
        if (refused > 0) {
            return refused;
        }
    } else {
        const size_t i = nearest_by_search(scene, q);
        row->shape = i < scene->count ? i + 1 : 0;
    }
    if (row->shape > 0) {
        row->answer = answer;
        if (!by_search) {
            solve(q->method, &scene->shapes[row->shape - 1], q->line,
                  fields->want | CYLINT_WANT_NEAREST, answer);
        }
    }
    return 0;
}

size_t scene_count(const struct scene *scene, const struct scene_query *q,
                   unsigned long long most, struct row *row)
{
    if (q->method) {
        return count_by_method(scene, q, most, row);
    }
    row->count = count_by_search(scene, q, most);
    return 0;
}
