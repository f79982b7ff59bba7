/*
 * scene.c - the shapes that every line is intersected with
 *
 * The library visits those that a line hits.  A published method intersects them
 * one by one.  Both choose the lower number at equal t.
 */
#include <math.h>

#include "left_out.h"
#include "main.h"
#include "report.h"
#include "scene.h"

int scene_add(struct scene *scene, const struct record *record)
{
    const int status = scene->also ? scene->also(scene, record) : 0;
    if (status != 0)
        return status;
    if (!scene->shapes)
        scene->shapes = cylint_scene_begin(0);
    const cylint_scene_status added =
        scene->shapes ? cylint_scene_add(scene->shapes, &record->shape, 1)
                      : CYLINT_SCENE_EMEMORY;
    if (added == CYLINT_SCENE_EMEMORY)
        return out_of_memory();
    if (added != CYLINT_SCENE_OK) {
        complain("-s", cylint_scene_strerror((int)added));
        return EXIT_USAGE;
    }
    scene->count++;
    return 0;
}

void scene_shape(const struct scene *scene, size_t i, cylint_shape *shape)
{
    cylint_scene_shape(scene->shapes, i, shape);
}

int scene_prepare(struct scene *scene, enum accel accel, int threads)
{
    if (!scene->shapes && !(scene->shapes = cylint_scene_begin(0)))
        return out_of_memory();
    int status = search_make(&scene->search, scene->shapes, accel, threads);
    if (status == 0 && scene->solids.count > 0) {
        status = search_build(scene->shapes, threads);
        status =
            status == 0 ? solids_give(&scene->solids, scene->shapes) : status;
    }
    return status;
}

void scene_free(struct scene *scene)
{
    search_free(&scene->search);
    solids_free(&scene->solids);
    cylint_scene_free(scene->shapes);
    scene->shapes = NULL;
}

int solve(solver method, const cylint_shape *shape, const cylint_line *line,
          unsigned want, cylint_answer *answer)
{
    if (method)
        return method(shape, line, want, answer) == CYLINT_OK;
    cylint_intersect(shape, line, want, answer);
    return 1;
}

/* ------------------------------------------------------ by the library -- */

/* The nearest of the shapes that are not left out. */
struct nearest {
    const struct left_out *left_out;
    size_t shape; /* from 1; 0: none */
    double t;
};

static double keep_nearest(void *context, size_t number, const cylint_hit *hit)
{
    struct nearest *n = context;
    const size_t shape = number + 1;
    if (!left_out_has(n->left_out, number) &&
        (n->shape == 0 || hit->t < n->t ||
         (!(hit->t > n->t) && shape < n->shape))) {
        n->shape = shape;
        n->t = hit->t;
    }
    return n->shape > 0 ? n->t : HUGE_VAL;
}

struct counter {
    const struct left_out *left_out;
    unsigned long long count, most;
};

static double count_hit(void *context, size_t number, const cylint_hit *hit)
{
    struct counter *c = context;
    (void)hit;
    c->count += !left_out_has(c->left_out, number);
    return c->count == c->most ? (double)NAN : HUGE_VAL;
}

static size_t nearest_by_search(const struct scene *scene,
                                const struct scene_query *q)
{
    struct nearest n = {.left_out = q->left_out};
    search_visit(&scene->search, q->line, CYLINT_WANT_T, q->hits, keep_nearest,
                 &n);
    return n.shape;
}

static unsigned long long count_by_search(const struct scene *scene,
                                          const struct scene_query *q,
                                          unsigned long long most)
{
    struct counter c = {.left_out = q->left_out, .most = most};
    if (!scene->search.shapes && q->left_out->count == 0) {
        return cylint_scene_count(scene->search.scene, q->line,
                                  most == ~0ULL ? 0 : (size_t)most);
    }
    search_visit(&scene->search, q->line, 0, q->hits, count_hit, &c);
    return c.count;
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
        cylint_shape shape;
        cylint_answer answer;
        if (left_out_has(q->left_out, i))
            continue;
        scene_shape(scene, i, &shape);
        if (!solve(q->method, &shape, q->line, first, &answer))
            return i + 1;
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
        cylint_shape shape;
        cylint_answer answer;
        if (left_out_has(q->left_out, i))
            continue;
        scene_shape(scene, i, &shape);
        if (!solve(q->method, &shape, q->line, CYLINT_WANT_COUNT, &answer))
            return i + 1;
        row->count += answer.n > 0;
    }
    return 0;
}

/* The columns of the nearest hit are computed for its shape only. */
size_t scene_nearest(const struct scene *scene, const struct scene_query *q,
                     const struct fields *fields, cylint_answer *answer,
                     struct row *row)
{
    cylint_shape shape;
    size_t refused = 0;
    row->answer = NULL;
    if (q->method)
        refused = nearest_by_method(scene, q, row);
    else
        row->shape = nearest_by_search(scene, q);
    if (refused == 0 && row->shape > 0) {
        scene_shape(scene, row->shape - 1, &shape);
        solve(q->method, &shape, q->line, fields->want | CYLINT_WANT_NEAREST,
              answer);
        row->answer = answer;
    }
    return refused;
}

size_t scene_count(const struct scene *scene, const struct scene_query *q,
                   unsigned long long most, struct row *row)
{
    if (q->method)
        return count_by_method(scene, q, most, row);
    row->count = count_by_search(scene, q, most);
    return 0;
}
