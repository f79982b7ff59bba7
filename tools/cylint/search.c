/*
 * search.c - finds the shapes of a scene that a line hits, or that are near a
 * point
 */
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "cylint_scene.h"
#include "main.h"
#include "report.h"
#include "search.h"

const char *const accel_words[] = {"auto", "none", "tree", "embree", NULL};

/*
 * The rule for `auto`.  With PAYS_FROM shapes or more a hierarchy is faster than
 * batches.  Building it takes about as long as PAYS_AFTER lines take by
 * batches: 0.5 to 2.6 microseconds a shape against 0.8 to 1.6 ns a shape and
 * line, 550 to 1600 lines (make bench-scene).  Batches for the first lines and
 * the hierarchy for the others take at most about twice the time of the better
 * one, for every number of lines.
 */
enum { PAYS_FROM = 64, PAYS_AFTER = 1024 };

/* A point takes about as long as this number of lines, because its shapes are
 * tested one by one. */
enum { LINES_PER_POINT = 32 };

/* The hierarchy.  A thread may still be building it. */
struct hierarchy {
    cylint_scene *scene; /* NULL: not built, or building failed */
    size_t lines;        /* lines before it was built; a point counts as many */
};

static int make_pack(struct search *s)
{
    s->memory = malloc(cylint_pack_bytes(s->count));
    if (!s->memory) {
        return out_of_memory();
    }
    cylint_pack_shapes(&s->pack, s->memory, s->shapes, s->count);
    return 0;
}

static cylint_scene_status make_scene(const struct search *s)
{
    cylint_scene_status status;
    cylint_scene *scene =
        cylint_scene_new(s->shapes, s->count, s->threads, &status);
    __atomic_store_n(&s->hierarchy->scene, scene, __ATOMIC_RELEASE);
    return status;
}

/* Builds the hierarchy.  Returns 0 or an exit status. */
static int require_scene(const struct search *s)
{
    const cylint_scene_status status = make_scene(s);
    if (status == CYLINT_SCENE_OK) {
        return 0;
    }
    complain("--accel=tree", cylint_scene_strerror((int)status));
    return status == CYLINT_SCENE_EMEMORY ? EXIT_MEMORY : EXIT_USAGE;
}

int search_make(struct search *s, const cylint_shape *shapes, size_t count,
                enum accel accel, int threads)
{
    memset(s, 0, sizeof *s);
    s->shapes = shapes;
    s->count = count;
    s->threads = threads;
    if (accel == ACCEL_TREE || (accel == ACCEL_AUTO && count >= PAYS_FROM)) {
        s->hierarchy = calloc(1, sizeof *s->hierarchy);
        if (!s->hierarchy) {
            return out_of_memory();
        }
    }
    return accel == ACCEL_TREE ? require_scene(s) : make_pack(s);
}

void search_free(struct search *s)
{
    if (s->hierarchy) {
        cylint_scene_free(s->hierarchy->scene);
    }
    free(s->hierarchy);
    free(s->memory);
    memset(s, 0, sizeof *s);
}

/* Returns the hierarchy, or NULL if it is not built. */
static const cylint_scene *scene_of(const struct search *s)
{
    return s->hierarchy
               ? __atomic_load_n(&s->hierarchy->scene, __ATOMIC_ACQUIRE)
               : NULL;
}

/* The same, and counts lines.  The thread with line number PAYS_AFTER builds the
 * hierarchy; the others continue with batches. */
static const cylint_scene *scene_for(const struct search *s, size_t lines)
{
    const cylint_scene *scene = scene_of(s);
    if (s->hierarchy && !scene) {
        const size_t before =
            __atomic_fetch_add(&s->hierarchy->lines, lines, __ATOMIC_RELAXED);
        if (before < PAYS_AFTER && before + lines >= PAYS_AFTER) {
            make_scene(s); /* if that fails, batches are used */
            scene = scene_of(s);
        }
    }
    return scene;
}

size_t search_nearest(const struct search *s, const cylint_line *line,
                      unsigned want, cylint_hit *hit)
{
    const cylint_scene *scene = scene_for(s, 1);
    return scene ? cylint_scene_nearest(scene, line, want, hit)
                 : cylint_nearest(&s->pack, line, want, hit);
}

size_t search_count(const struct search *s, const cylint_line *line,
                    size_t enough)
{
    const cylint_scene *scene = scene_for(s, 1);
    return scene ? cylint_scene_count(scene, line, enough)
                 : cylint_count(&s->pack, line, enough);
}

/* Most lines miss most shapes, so eight are tested at a time. */
static size_t next_hit(const signed char *n, size_t from, size_t count)
{
    uint64_t eight = 0;
    while (count - from >= sizeof eight) {
        memcpy(&eight, n + from, sizeof eight);
        if (eight != 0) {
            break;
        }
        from += sizeof eight;
    }
    while (from < count && n[from] == 0) {
        from++;
    }
    return from;
}

size_t search_hits(const struct search *s, const cylint_line *line,
                   signed char *hits, size_t first, size_t *numbers,
                   size_t capacity)
{
    size_t found = 0;
    const cylint_scene *scene = first == 0 ? scene_for(s, 1) : scene_of(s);
    if (scene) {
        return cylint_scene_all(scene, line, first, numbers, capacity);
    }
    if (first == 0) {
        cylint_columns columns = {0};
        columns.n = hits;
        cylint_intersect_shapes(&s->pack, line, &columns);
    }
    for (size_t i = next_hit(hits, first, s->count);
         i < s->count && found < capacity;
         i = next_hit(hits, i + 1, s->count)) {
        numbers[found++] = i;
    }
    return found;
}

/* ------------------------------------------------------------- points -- */

double search_distance(const struct search *s, size_t shape,
                       const double point[3])
{
    cylint_closest closest;
    closest.part = 0; /* written only if there is no surface */
    const double distance =
        fabs(cylint_distance(&s->shapes[shape], point, 0, &closest));
    return closest.part >= 0 ? distance : NAN;
}

size_t search_closest(const struct search *s, const double point[3],
                      double radius, unsigned want, cylint_closest *closest)
{
    const cylint_scene *scene = scene_for(s, LINES_PER_POINT);
    return scene ? cylint_scene_closest(scene, point, radius, want, closest)
                 : cylint_closest_shape(s->shapes, s->count, point, radius,
                                        want, closest);
}

size_t search_within(const struct search *s, const double point[3],
                     double radius, size_t first, size_t *numbers,
                     double *distances, size_t capacity)
{
    const cylint_scene *scene =
        first == 0 ? scene_for(s, LINES_PER_POINT) : scene_of(s);
    size_t found = 0;
    if (scene) {
        return cylint_scene_within(scene, point, radius, first, numbers,
                                   distances, capacity);
    }
    for (size_t i = first; i < s->count && found < capacity; i++) {
        const double distance = search_distance(s, i, point);
        if (distance <= radius) {
            numbers[found] = i;
            distances[found++] = distance;
        }
    }
    return found;
}

size_t search_within_count(const struct search *s, const double point[3],
                           double radius, size_t enough)
{
    const cylint_scene *scene = scene_for(s, LINES_PER_POINT);
    size_t number, count = 0;
    double distance;
    if (scene) {
        return cylint_scene_within_count(scene, point, radius, enough);
    }
    for (size_t first = 0;
         (enough == 0 || count < enough) &&
         search_within(s, point, radius, first, &number, &distance, 1) == 1;
         first = number + 1) {
        count++;
    }
    return count;
}
