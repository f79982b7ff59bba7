/*
 * test_memory.c - floor scene: refused allocations leave no memory behind,
 * and refused threads do not change answers
 *
 * A scene allocates with malloc(), calloc() and realloc(), which the linker
 * replaces by the functions below.  Each allocation is refused in turn.  Where
 * memory that is not needed cannot be returned, the scene keeps it.
 */
#include <errno.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "cylint_scene.h"
#include "scenes.h"

#ifndef WRAPPED

int main(void)
{
    return check_skip(
        "this linker wraps no functions, so malloc() is not refused");
}

#else

enum { SHAPES = 300, ENOUGH = 1000, LINES = 6000 };

static struct {
    int watched;
    int requested, refuse; /* allocations; the number of the one that fails */
    int kept;              /* realloc() of existing memory was refused */
    int held;              /* allocations not freed yet */
    size_t bytes;          /* of malloc() and calloc() */
} heap;

void *__real_malloc(size_t);
void *__real_calloc(size_t, size_t);
void *__real_realloc(void *, size_t);
void __real_free(void *);
void *__wrap_malloc(size_t);
void *__wrap_calloc(size_t, size_t);
void *__wrap_realloc(void *, size_t);
void __wrap_free(void *);

static int heap_refuses(void)
{
    return heap.watched && ++heap.requested == heap.refuse;
}

static void *heap_hold(void *p)
{
    heap.held += heap.watched && p != NULL;
    return p;
}

void *__wrap_malloc(size_t size)
{
    heap.bytes += size;
    return heap_refuses() ? NULL : heap_hold(__real_malloc(size));
}

void *__wrap_calloc(size_t n, size_t size)
{
    heap.bytes += n * size;
    return heap_refuses() ? NULL : heap_hold(__real_calloc(n, size));
}

void *__wrap_realloc(void *p, size_t size)
{
    if (heap_refuses()) {
        heap.kept = p != NULL;
        return NULL;
    }
    void *q = __real_realloc(p, size);
    return p ? q : heap_hold(q);
}

void __wrap_free(void *p)
{
    heap.held -= heap.watched && p != NULL;
    __real_free(p);
}

/* Threads are started until so many are; NO_LIMIT: all are. */
enum { NO_LIMIT = 1000 };
static int threads_started, most_threads = NO_LIMIT;

int __real_pthread_create(pthread_t *, const pthread_attr_t *,
                          void *(*)(void *), void *);
int __wrap_pthread_create(pthread_t *, const pthread_attr_t *,
                          void *(*)(void *), void *);

int __wrap_pthread_create(pthread_t *thread, const pthread_attr_t *attributes,
                          void *(*function)(void *), void *argument)
{
    if (threads_started == most_threads)
        return EAGAIN;
    threads_started++;
    return __real_pthread_create(thread, attributes, function, argument);
}

/* Whether the scene was made: it has fewer allocations than that number. */
static int is_made(const struct scene_shapes *of, int refuse)
{
    cylint_scene_status status = CYLINT_SCENE_OK;
    heap.requested = heap.held = heap.kept = 0;
    heap.refuse = refuse;
    heap.watched = 1;
    cylint_scene *scene = cylint_scene_new(of->shapes, of->n, 1, &status);
    const int made = heap.requested < refuse;
    CHECK(made || heap.kept ? scene && status == CYLINT_SCENE_OK
                            : !scene && status == CYLINT_SCENE_EMEMORY);
    cylint_scene_free(scene);
    heap.watched = 0;
    CHECK(heap.held == 0);
    return made;
}

/* Unbounded shapes are beside the hierarchy, long ones are split. */
static void a_scene_frees_all_memory(void)
{
    static const int kinds[] = {SCENE_FIBRES, SCENE_UNBOUNDED};
    for (int i = 0; i < 2; i++) {
        struct scene_shapes of;
        int refusals = 0;
        scene_generate(kinds[i], SHAPES, 5, &of);
        while (refusals < ENOUGH && !is_made(&of, refusals + 1))
            refusals++;
        CHECK(refusals > 5 && refusals < ENOUGH);
        scene_release(&of);
    }
}

static int stop_at_last(void *context, double part)
{
    int *calls = context;
    (void)part;
    return --*calls > 0;
}

static void a_scene_that_is_stopped_frees_all_memory(void)
{
    struct scene_shapes of;
    scene_generate(SCENE_UNBOUNDED, 20 * SHAPES, 5, &of);
    heap.refuse = 0;
    for (int call = 1; call < ENOUGH; call++) {
        int calls = call;
        cylint_scene_status status;
        heap.held = 0;
        heap.watched = 1;
        cylint_scene *scene = cylint_scene_new_with_progress(
            of.shapes, of.n, 1, stop_at_last, &calls, &status);
        CHECK(scene || status == CYLINT_SCENE_ESTOPPED);
        cylint_scene_free(scene);
        heap.watched = 0;
        CHECK(heap.held == 0);
        if (scene) {
            CHECK(call > 5);
            break;
        }
    }
    scene_release(&of);
}

/* Bytes in memory that grows. */
struct bytes {
    char *data;
    size_t n;
};

static int append_bytes(void *context, const void *data, size_t n)
{
    struct bytes *b = context;
    b->data = realloc(b->data, b->n + n);
    memcpy(b->data + b->n, data, n);
    b->n += n;
    return 1;
}

/* Unaligned bytes are copied. */
static void an_opened_scene_frees_all_memory(void)
{
    struct scene_shapes of;
    struct bytes file = {NULL, 0};
    int refusals = 0, opened = 0;
    scene_generate(SCENE_UNBOUNDED, SHAPES, 5, &of);
    cylint_scene *scene = cylint_scene_new(of.shapes, of.n, 1, NULL);
    CHECK(append_bytes(&file, "x", 1));
    CHECK(cylint_scene_write(scene, append_bytes, &file) == CYLINT_SCENE_OK);
    cylint_scene_free(scene);
    while (!opened && refusals < ENOUGH) {
        cylint_scene_status status;
        heap.requested = heap.held = 0;
        heap.refuse = refusals + 1;
        heap.watched = 1;
        scene = cylint_scene_open_memory(file.data + 1, file.n - 1, 0, &status);
        opened = scene != NULL;
        CHECK(opened || status == CYLINT_SCENE_EMEMORY);
        cylint_scene_free(scene);
        heap.watched = 0;
        CHECK(heap.held == 0);
        refusals += !opened;
    }
    CHECK(refusals >= 4 && refusals < ENOUGH);
    free(file.data);
    scene_release(&of);
}

/* The same failure again and again changes nothing; then the shapes move. */
static void a_refused_refit_changes_nothing(void)
{
    static cylint_shape shapes[SHAPES];
    cylint_line line;
    cylint_hit hit;
    for (size_t i = 0; i < SHAPES; i++)
        cylint_sphere(&shapes[i], (double[]){(double)i, 0, 0}, 0.25,
                      CYLINT_ENDS_CAPPED);
    cylint_scene *scene = cylint_scene_new(shapes, SHAPES, 1, NULL);
    for (size_t i = 0; i < SHAPES; i++)
        cylint_sphere(&shapes[i], (double[]){(double)i, 0, 1}, 0.25,
                      CYLINT_ENDS_CAPPED);
    cylint_whole_line(&line, (double[]){3, 3, 0}, (double[]){0, 1, 0});
    for (int k = 0; k < 4; k++) {
        heap.requested = heap.held = 0;
        heap.refuse = k < 3;
        heap.watched = 1;
        CHECK(cylint_scene_refit(scene, 0, SHAPES, shapes) ==
              (k < 3 ? CYLINT_SCENE_EMEMORY : CYLINT_SCENE_OK));
        heap.watched = 0;
        CHECK(heap.held == 0);
        CHECK(cylint_scene_nearest(scene, &line, CYLINT_WANT_T, &hit) ==
              (k < 3 ? 3 : SHAPES));
    }
    cylint_scene_free(scene);
}

/* -------------------------------------------------------------- solids -- */

enum { PIPES = SHAPES / 2 };

/* Pipes side by side. */
static cylint_scene *scene_of_pipes(cylint_member members[SHAPES])
{
    cylint_shape shapes[SHAPES];
    for (size_t i = 0; i < SHAPES; i++) {
        const double x = (double)(i / 2);
        cylint_cylinder(&shapes[i], (double[]){x, 0, 0}, (double[]){x, 0, 9},
                        i % 2 ? 0.25 : 0.375, CYLINT_ENDS_CAPPED);
        members[i] = (cylint_member){i, i / 2, i % 2 ? -2 : 1};
    }
    return cylint_scene_new(shapes, SHAPES, 1, NULL);
}

static void watch_heap(int refuse)
{
    heap.requested = heap.held = 0;
    heap.bytes = 0;
    heap.refuse = refuse;
    heap.watched = 1;
}

/* cylint_scene_bytes() counts what stays: `spare` bytes are freed before the call
 * returns, and an array has a place that is not used. */
static void refused_solids_change_nothing(void)
{
    cylint_member members[SHAPES];
    cylint_scene *scene = scene_of_pipes(members);
    const size_t before = cylint_scene_bytes(scene), spare = SHAPES * 12;
    cylint_scene_status status;
    int refusals = 0;
    do {
        watch_heap(refusals + 1);
        status = cylint_scene_set_solids(scene, members, SHAPES);
        heap.watched = 0;
        CHECK(status == CYLINT_SCENE_OK ||
              (status == CYLINT_SCENE_EMEMORY && heap.held == 0 &&
               cylint_scene_members(scene) == 0 &&
               cylint_scene_bytes(scene) == before));
    } while (status != CYLINT_SCENE_OK && ++refusals < ENOUGH);
    CHECK(refusals > 5 && refusals < ENOUGH);
    const size_t held = cylint_scene_bytes(scene) - before;
    CHECK(held <= heap.bytes && held + spare + 64 > heap.bytes);
    cylint_scene_free(scene);
}

/* Rows, or sums; the last sum is that of a line through all pipes. */
static cylint_scene_status ask_pieces(const cylint_scene *scene, int query,
                                      const cylint_lines *lines,
                                      const cylint_line *line, double *found)
{
    const cylint_piece_rule rule = {.mode = CYLINT_PIECES_OWNER};
    cylint_piece_rows rows;
    double sums[LINES];
    cylint_scene_status status;
    if (query == 0) {
        status = cylint_scene_pieces_lines(scene, lines, &rule, 0, 1, &rows);
        if (status == CYLINT_SCENE_OK) {
            *found = (double)rows.first[lines->n] / 8;
            cylint_piece_rows_free(&rows);
        }
    } else if (query == 1) {
        status = cylint_scene_sums(scene, lines, &rule, NULL, 1, 0, 1, sums);
        *found = sums[lines->n - 1];
    } else {
        status = cylint_scene_line_sums(scene, line, &rule, NULL, 1, 0, found);
    }
    return status;
}

static void refused_pieces_free_all_memory(void)
{
    enum { FEW = 200 };
    static const double expected[] = {PIPES * FEW / 4.0, PIPES / 4.0,
                                      PIPES / 4.0};
    double x[6][FEW];
    const cylint_lines lines = {
        .n = FEW, .o = {x[0], x[1], x[2]}, .d = {x[3], x[4], x[5]}};
    cylint_member members[SHAPES];
    cylint_scene *scene = scene_of_pipes(members);
    cylint_line line;
    CHECK(cylint_scene_set_solids(scene, members, SHAPES) == CYLINT_SCENE_OK);
    for (int i = 0; i < FEW; i++)
        for (int j = 0; j < 6; j++)
            x[j][i] = j == 0 ? -1 : j == 2 ? 4 : j == 3;
    cylint_ray(&line, (double[]){-1, 0, 4}, (double[]){1, 0, 0});
    for (int query = 0; query < 3; query++) {
        cylint_scene_status status;
        double found = 0;
        int refusals = 0;
        do {
            watch_heap(refusals + 1);
            status = ask_pieces(scene, query, &lines, &line, &found);
            heap.watched = 0;
            CHECK(heap.held == 0);
        } while (status == CYLINT_SCENE_EMEMORY && ++refusals < ENOUGH);
        CHECK(status == CYLINT_SCENE_OK && refusals > 3);
        CHECK(found == expected[query]);
    }
    cylint_scene_free(scene);
}

static int has_threads = 1; /* the library was built with them */

/* Many lines with at most `most` threads beside the caller's.  The library calls
 * none of the functions above; a thread's stack is not counted. */
static void check_refused_threads(const cylint_scene *scene,
                                  const cylint_lines *lines, int most,
                                  const size_t *expected)
{
    static size_t numbers[LINES], counts[LINES];
    static signed char any[LINES];
    const cylint_points points = {lines->n,
                                  {lines->o[0], lines->o[1], lines->o[2]}};
    most_threads = most;
    threads_started = heap.requested = heap.held = heap.refuse = 0;
    heap.watched = 1;
    cylint_scene_nearest_lines(scene, lines, NULL, 5, numbers, NULL);
    CHECK(threads_started == most || !has_threads);
    cylint_scene_any_lines(scene, lines, NULL, 5, any);
    cylint_scene_count_lines(scene, lines, 0, 5, counts);
    int wrong = 0;
    for (size_t i = 0; i < lines->n; i++) {
        const int hits = expected[i] < cylint_scene_size(scene);
        wrong += numbers[i] != expected[i] || any[i] != hits ||
                 (counts[i] > 0) != hits;
    }
    CHECK(wrong == 0);
    cylint_scene_closest_points(scene, &points, NULL, 5, numbers, NULL);
    heap.watched = 0;
    CHECK(heap.requested == 0 && heap.held == 0);
    most_threads = NO_LIMIT;
}

static void many_lines_need_no_memory_and_no_threads(void)
{
    static double x[6][LINES];
    static size_t expected[LINES], counts[LINES];
    const cylint_lines lines = {
        .n = LINES, .o = {x[0], x[1], x[2]}, .d = {x[3], x[4], x[5]}};
    struct scene_shapes of;
    scene_generate(SCENE_UNBOUNDED, SHAPES, 5, &of);
    cylint_scene *scene = cylint_scene_new(of.shapes, of.n, 1, NULL);
    for (uint64_t i = 0; i < LINES; i++) {
        cylint_line line;
        cylint_hit hit;
        scene_line(&of, LINES_RANDOM, 6, i, &line);
        for (int j = 0; j < 3; j++) {
            x[j][i] = line.o[j];
            x[3 + j][i] = line.d[j];
        }
        expected[i] = cylint_scene_nearest(scene, &line, 0, &hit);
    }
    cylint_scene_count_lines(scene, &lines, 0, 5, counts);
    has_threads = threads_started > 0;
    for (int most = 0; most < 5; most++)
        check_refused_threads(scene, &lines, most, expected);
    cylint_scene_free(scene);
    scene_release(&of);
}

int main(void)
{
    RUN(an_opened_scene_frees_all_memory);
    RUN(a_refused_refit_changes_nothing);
    RUN(refused_solids_change_nothing);
    RUN(refused_pieces_free_all_memory);
    RUN(many_lines_need_no_memory_and_no_threads);
    RUN(a_scene_frees_all_memory);
    RUN(a_scene_that_is_stopped_frees_all_memory);
    return check_end();
}

#endif
