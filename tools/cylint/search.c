/*
 * search.c - finds the shapes of a scene that a line hits, or that are near a
 * point
 */
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "main.h"
#include "report.h"
#include "search.h"

const char *const accel_words[] = {"auto", "none", "tree", "embree", NULL};

/* ------------------------------------------------------------- making -- */

static int make_pack(struct search *s)
{
    s->shapes = s->count < SIZE_MAX / sizeof *s->shapes
                    ? malloc((s->count + 1) * sizeof *s->shapes)
                    : NULL;
    s->memory = malloc(cylint_pack_bytes(s->count));
    if (!s->shapes || !s->memory)
        return out_of_memory();
    for (size_t i = 0; i < s->count; i++)
        cylint_scene_shape(s->scene, i, &s->shapes[i]);
    cylint_pack_shapes(&s->pack, s->memory, s->shapes, s->count);
    return 0;
}

int search_build(cylint_scene *scene, int threads)
{
    const cylint_scene_status status =
        cylint_scene_finish(scene, threads, NULL, NULL);
    if (status == CYLINT_SCENE_OK || status == CYLINT_SCENE_EFINISHED)
        return 0;
    if (status == CYLINT_SCENE_EMEMORY)
        return out_of_memory();
    complain("-s", cylint_scene_strerror((int)status));
    return EXIT_USAGE;
}

int search_make(struct search *s, cylint_scene *scene, enum accel accel,
                int threads)
{
    memset(s, 0, sizeof *s);
    s->scene = scene;
    s->count = cylint_scene_size(scene);
    return accel == ACCEL_NONE ? make_pack(s) : search_build(scene, threads);
}

void search_free(struct search *s)
{
    free(s->shapes);
    free(s->memory);
    memset(s, 0, sizeof *s);
}

size_t search_bytes(const struct search *s)
{
    return s->shapes ? s->count : 0;
}

/* -------------------------------------------------------------- lines -- */

static void find_hits(const struct search *s, const cylint_line *line,
                      signed char *hits)
{
    cylint_columns columns = {0};
    columns.n = hits;
    cylint_intersect_shapes(&s->pack, line, &columns);
}

/* The next shape that is hit, or `count`.  Most lines miss most shapes, so eight
 * are tested at a time. */
static size_t next_hit(const signed char *n, size_t from, size_t count)
{
    uint64_t eight = 0;
    while (count - from >= sizeof eight) {
        memcpy(&eight, n + from, sizeof eight);
        if (eight != 0)
            break;
        from += sizeof eight;
    }
    while (from < count && n[from] == 0)
        from++;
    return from;
}

void search_visit(const struct search *s, const cylint_line *line,
                  unsigned want, signed char *hits, cylint_scene_hit *callback,
                  void *context)
{
    if (!s->shapes) {
        cylint_scene_visit(s->scene, line, want, callback, context);
        return;
    }
    find_hits(s, line, hits);
    for (size_t i = next_hit(hits, 0, s->count); i < s->count;
         i = next_hit(hits, i + 1, s->count)) {
        cylint_answer answer;
        cylint_intersect(&s->shapes[i], line, want | CYLINT_WANT_NEAREST,
                         &answer);
        if (isnan(callback(context, i, &answer.hit[0])))
            return;
    }
}

size_t search_hits(const struct search *s, const cylint_line *line,
                   signed char *hits, size_t first, size_t *numbers,
                   size_t capacity)
{
    size_t found = 0;
    if (!s->shapes)
        return cylint_scene_all(s->scene, line, first, numbers, capacity);
    if (first == 0)
        find_hits(s, line, hits);
    for (size_t i = next_hit(hits, first, s->count);
         i < s->count && found < capacity; i = next_hit(hits, i + 1, s->count))
        numbers[found++] = i;
    return found;
}

/* ------------------------------------------------------------- points -- */

/* The next shape from `from` that is near, or `count`. */
static size_t next_near(const struct search *s, const double point[3],
                        double radius, unsigned want, size_t from,
                        cylint_closest *closest)
{
    for (; from < s->count; from++) {
        closest->part = 0; /* written only if there is no surface */
        cylint_distance(&s->shapes[from], point, want, closest);
        if (closest->part >= 0 &&
            search_compared(want, closest->distance) <= radius)
            break;
    }
    return from;
}

void search_visit_point(const struct search *s, const double point[3],
                        double radius, unsigned want,
                        cylint_scene_near *callback, void *context)
{
    cylint_closest closest;
    if (!s->shapes) {
        cylint_scene_visit_point(s->scene, point, radius, want, callback,
                                 context);
        return;
    }
    for (size_t i = next_near(s, point, radius, want, 0, &closest);
         i < s->count; i = next_near(s, point, radius, want, i + 1, &closest))
        if (isnan(callback(context, i, closest.distance, closest.flags)))
            return;
}

size_t search_within(const struct search *s, const double point[3],
                     double radius, unsigned want, size_t first,
                     size_t *numbers, double *distances, size_t capacity)
{
    size_t found = 0;
    cylint_closest closest;
    if (!s->shapes) {
        return cylint_scene_within(s->scene, point, radius, want, first,
                                   numbers, distances, capacity);
    }
    for (size_t i = next_near(s, point, radius, want, first, &closest);
         i < s->count && found < capacity;
         i = next_near(s, point, radius, want, i + 1, &closest)) {
        numbers[found] = i;
        distances[found++] = search_compared(want, closest.distance);
    }
    return found;
}
