/*
 * test_memory.c - refused allocations leave no memory behind, and refused
 * threads do not change answers
 *
 * A scene allocates with malloc(), calloc() and realloc(), which the linker
 * replaces by the functions of heap.h.  Each allocation is refused in turn.  Where
 * memory that is not needed cannot be returned, the scene keeps it.
 */
#include <stdlib.h>
#include <string.h>

#ifndef WRAPPED
#define CHECK_OWN_MAIN
#endif
#include "answers.h"
#include "check.h"
#include "cylint_scene.h"
#include "scene_file.h"
#include "scenes.h"

#ifndef WRAPPED

int main(void)
{
    return check_skip(
        "this linker wraps no functions, so malloc() is not refused");
}

#else

#include "heap.h"
#include "started_threads.h"

enum { SHAPES = 300, ENOUGH = 1000, LINES = 6000 };

static void watch_heap(int refuse)
{
    heap.requested = heap.held = heap.most = heap.bytes = heap.kept = 0;
    heap.refuse = refuse;
    heap.unwatched = 0;
}

/* A call that allocates, and then frees what it returned. */
typedef cylint_scene_status allocating_call(void *self);

/* Refuses each allocation of a call in turn, until it has no more of them; it then
 * succeeds.  Returns how many it has. */
static int refuse_each(allocating_call *call, void *self)
{
    int refused = 0;
    for (;; refused++) {
        watch_heap(refused + 1);
        const cylint_scene_status status = call(self);
        heap.unwatched = 1;
        const int is_refused = heap.requested > refused;
        CHECK(status == CYLINT_SCENE_EMEMORY
                  ? is_refused
                  : status == CYLINT_SCENE_OK && (!is_refused || heap.kept));
        CHECK(heap.held == 0);
        if (!is_refused || !CHECK(refused < ENOUGH))
            return refused;
    }
}

static cylint_scene_status make_scene(void *self)
{
    const struct scene_shapes *of = self;
    cylint_scene_status status = CYLINT_SCENE_OK;
    cylint_scene_free(cylint_scene_new(of->shapes, of->n, 1, &status));
    CHECK(status == CYLINT_SCENE_OK || !heap.kept);
    return status;
}

/* Unbounded shapes are beside the hierarchy, long ones are split. */
TEST(a_scene_frees_all_memory)
{
    static const int kinds[] = {SCENE_FIBRES, SCENE_UNBOUNDED};
    for (int i = 0; i < 2; i++) {
        OWN_SHAPES of = scene_generate(kinds[i], SHAPES, 5);
        CHECK(refuse_each(make_scene, &of) > 5);
    }
}

/* A refused shape is not added; those before stay, and it can be added then. */
static cylint_scene_status add_one_by_one(void *self)
{
    const struct scene_shapes *of = self;
    cylint_scene_status status = CYLINT_SCENE_OK;
    cylint_scene *scene = cylint_scene_begin(0);
    if (!scene)
        return CYLINT_SCENE_EMEMORY;
    for (size_t i = 0; i < of->n;) {
        if (cylint_scene_add(scene, &of->shapes[i], 1) == CYLINT_SCENE_OK)
            i++;
        else
            status = CYLINT_SCENE_EMEMORY;
        CHECK(cylint_scene_size(scene) == i);
    }
    for (size_t i = 0; i < of->n; i++) {
        cylint_shape stored;
        cylint_scene_shape(scene, i, &stored);
        CHECK(stored.kind == of->shapes[i].kind);
    }
    cylint_scene_free(scene);
    return status;
}

TEST(a_scene_that_grows_frees_all_memory)
{
    OWN_SHAPES of = scene_generate(SCENE_MIXED, SHAPES, 5);
    CHECK(refuse_each(add_one_by_one, &of) > 10);
}

static int stop_at_last(void *context, double part)
{
    int *calls = context;
    (void)part;
    return --*calls > 0;
}

TEST(a_scene_that_is_stopped_frees_all_memory)
{
    OWN_SHAPES of = scene_generate(SCENE_UNBOUNDED, 20 * SHAPES, 5);
    for (int call = 1; call < ENOUGH; call++) {
        int calls = call;
        cylint_scene_status status;
        watch_heap(0);
        cylint_scene *scene = cylint_scene_new_with_progress(
            of.shapes, of.n, 1, stop_at_last, &calls, &status);
        CHECK(scene || status == CYLINT_SCENE_ESTOPPED);
        cylint_scene_free(scene);
        heap.unwatched = 1;
        CHECK(heap.held == 0);
        if (scene) {
            CHECK(call > 5);
            break;
        }
    }
}

static cylint_scene_status open_unaligned(void *self)
{
    const struct bytes *file = self;
    cylint_scene_status status = CYLINT_SCENE_OK;
    cylint_scene_free(
        cylint_scene_open_memory(file->data + 1, file->n, 0, &status));
    return status;
}

/* Returns how many allocations opening the scene's file has.  Unaligned bytes are
 * copied. */
static int refuse_opening(const cylint_scene *scene)
{
    OWN_BYTES file = {NULL, NULL, 0};
    scene_file_write(scene, &file);
    memmove(file.data + 1, file.data, file.n);
    return refuse_each(open_unaligned, &file);
}

TEST(an_opened_scene_frees_all_memory)
{
    OWN_SHAPES of = scene_generate(SCENE_UNBOUNDED, SHAPES, 5);
    OWN_SCENE *scene = cylint_scene_new(of.shapes, of.n, 1, NULL);
    CHECK(refuse_opening(scene) >= 4);
}

TEST(a_refit_allocates_nothing)
{
    const int threads = threads_started;
    static cylint_shape shapes[SHAPES];
    cylint_line line;
    cylint_hit hit;
    for (size_t i = 0; i < SHAPES; i++)
        cylint_sphere(&shapes[i], (double[]){(double)i, 0, 0}, 0.25,
                      CYLINT_ENDS_CAPPED);
    OWN_SCENE *scene = cylint_scene_new(shapes, SHAPES, 1, NULL);
    for (size_t i = 0; i < SHAPES; i++)
        cylint_sphere(&shapes[i], (double[]){(double)i, 0, 1}, 0.25,
                      CYLINT_ENDS_CAPPED);
    cylint_whole_line(&line, (double[]){3, 3, 0}, (double[]){0, 1, 0});
    watch_heap(1);
    CHECK(cylint_scene_refit(scene, 0, SHAPES, shapes) == CYLINT_SCENE_OK);
    heap.unwatched = 1;
    CHECK(heap.requested == 0);
    CHECK(cylint_scene_nearest(scene, &line, CYLINT_WANT_T, &hit) == SHAPES);
    CHECK(threads_started == threads);
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

struct solids_call {
    cylint_scene *scene;
    cylint_member members[SHAPES];
    size_t before; /* the bytes of the scene */
};

/* What a success leaves in the scene counts in heap.bytes, not in heap.held. */
static cylint_scene_status set_solids(void *self)
{
    struct solids_call *c = self;
    const cylint_scene_status status =
        cylint_scene_set_solids(c->scene, c->members, SHAPES);
    if (status == CYLINT_SCENE_OK)
        heap.held = 0;
    else
        CHECK(cylint_scene_members(c->scene) == 0 &&
              cylint_scene_bytes(c->scene) == c->before);
    return status;
}

/* The solids before are freed if the same ones take their place, else kept. */
static cylint_scene_status set_again(void *self)
{
    struct solids_call *c = self;
    const cylint_scene_status status =
        cylint_scene_set_solids(c->scene, c->members, SHAPES);
    CHECK(cylint_scene_members(c->scene) == SHAPES);
    return status;
}

/* cylint_scene_bytes() counts what stays; an array has a place that is not used. */
TEST(refused_solids_change_nothing)
{
    struct solids_call c;
    c.scene = scene_of_pipes(c.members);
    c.before = cylint_scene_bytes(c.scene);
    CHECK(refuse_each(set_solids, &c) >= 2);
    const size_t held = cylint_scene_bytes(c.scene) - c.before;
    const size_t bytes = (size_t)heap.bytes;
    CHECK(held <= bytes && held + 64 > bytes);
    CHECK(refuse_each(set_again, &c) >= 2);
    CHECK(refuse_opening(c.scene) >= 5);
    cylint_scene_free(c.scene);
}

static size_t bytes_with(cylint_shape *shapes, int distant, double distance)
{
    for (int i = 0; i < distant; i++)
        cylint_sphere(&shapes[i * 7], (double[]){0, distance, i}, 0.5,
                      CYLINT_ENDS_CAPPED);
    OWN_SCENE *scene = cylint_scene_new(shapes, SHAPES, 1, NULL);
    return cylint_scene_bytes(scene);
}

/* Where it takes more memory: one of 64 at most. */
TEST(a_few_distant_shapes_are_beside_the_hierarchy)
{
    cylint_shape shapes[SHAPES];
    for (int i = 0; i < SHAPES; i++)
        cylint_sphere(&shapes[i], (double[]){i % 10, i / 10, 0}, 0.5,
                      CYLINT_ENDS_CAPPED);
    const size_t bytes = bytes_with(shapes, 0, 0);
    CHECK(bytes_with(shapes, 4, 1e3) < bytes + 200);
    CHECK(bytes_with(shapes, 4, 1e4) > bytes + 4 * 400);
    CHECK(bytes_with(shapes, 4, -1e4) > bytes + 4 * 400);
    CHECK(bytes_with(shapes, 5, 1e9) < bytes + 200);
}

struct pieces_call {
    const cylint_scene *scene;
    cylint_lines lines;
    cylint_line line;
    int query;
    double found;
};

/* Rows, or sums; the last sum is that of a line through all pipes. */
static cylint_scene_status find_pieces(void *self)
{
    const cylint_piece_rule rule = {.mode = CYLINT_PIECES_OWNER};
    struct pieces_call *c = self;
    cylint_piece_rows rows;
    double sums[LINES];
    cylint_scene_status status;
    if (c->query == 0) {
        status =
            cylint_scene_pieces_lines(c->scene, &c->lines, &rule, 0, 1, &rows);
        if (status == CYLINT_SCENE_OK) {
            c->found = (double)rows.first[c->lines.n] / 8;
            cylint_piece_rows_free(&rows);
        }
    } else if (c->query == 1) {
        status =
            cylint_scene_sums(c->scene, &c->lines, &rule, NULL, 1, 0, 1, sums);
        c->found = sums[c->lines.n - 1];
    } else {
        status = cylint_scene_line_sums(c->scene, &c->line, &rule, NULL, 1, 0,
                                        &c->found);
    }
    return status;
}

TEST(refused_pieces_free_all_memory)
{
    enum { FEW = 200 };
    static const double expected[] = {PIPES * FEW / 4.0, PIPES / 4.0,
                                      PIPES / 4.0};
    double x[6][FEW];
    cylint_member members[SHAPES];
    OWN_SCENE *scene = scene_of_pipes(members);
    struct pieces_call c = {
        .scene = scene,
        .lines = {.n = FEW, .o = {x[0], x[1], x[2]}, .d = {x[3], x[4], x[5]}}};
    CHECK(cylint_scene_set_solids(scene, members, SHAPES) == CYLINT_SCENE_OK);
    for (int i = 0; i < FEW; i++)
        for (int j = 0; j < 6; j++)
            x[j][i] = j == 0 ? -1 : j == 2 ? 4 : j == 3;
    cylint_ray(&c.line, (double[]){-1, 0, 4}, (double[]){1, 0, 0});
    for (c.query = 0; c.query < 3; c.query++) {
        CHECK(refuse_each(find_pieces, &c) > 3);
        CHECK(c.found == expected[c.query]);
        /* of sums: all blocks, and the workspace and the pieces of one */
        CHECK(c.query == 0 || heap.most <= 3);
    }
}

TEST(queries_of_a_line_or_point_need_no_memory)
{
    static struct line_answers of_line;
    static struct point_answers of_point;
    static double memory[1 << 14];
    cylint_workspace work = {memory, sizeof memory, 0};
    OWN_SHAPES of = scene_generate(SCENE_UNBOUNDED, SHAPES, 5);
    OWN_SCENE *scene = cylint_scene_new(of.shapes, of.n, 1, NULL);
    for (uint64_t i = 0; i < 100; i++) {
        cylint_line line;
        cylint_hit hit;
        double point[3];
        size_t owner;
        scene_line(&of, (enum scene_lines)(i % LINES_KINDS), 6, i, &line);
        point_about(&of, point);
        watch_heap(0);
        line_in_scene(scene, &line, &of_line);
        point_in_scene(scene, point, 1, i % 2 ? CYLINT_SIGNED : 0, &of_point);
        cylint_scene_contains(scene, point, 0);
        cylint_scene_depth(scene, point, NULL, &owner, &work);
        cylint_scene_first_boundary(scene, &line, CYLINT_WANT_ALL, &hit, &work);
        heap.unwatched = 1;
        CHECK(heap.requested == 0);
    }
}

static int has_threads = 1; /* the library was built with them */

/* Many lines with at most `most` threads beside the caller's.  The library calls
 * none of these functions; a thread's stack is not counted. */
static void check_refused_threads(const cylint_scene *scene,
                                  const cylint_lines *lines, int most,
                                  const size_t *expected)
{
    static size_t numbers[LINES], counts[LINES];
    static signed char any[LINES];
    const cylint_points points = {lines->n,
                                  {lines->o[0], lines->o[1], lines->o[2]}};
    most_threads = most;
    threads_started = 0;
    watch_heap(0);
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
    heap.unwatched = 1;
    CHECK(heap.requested == 0 && heap.held == 0);
    most_threads = NO_LIMIT;
}

TEST(many_lines_need_no_memory_and_no_threads)
{
    static double x[6][LINES];
    static size_t expected[LINES], counts[LINES];
    const cylint_lines lines = {
        .n = LINES, .o = {x[0], x[1], x[2]}, .d = {x[3], x[4], x[5]}};
    OWN_SHAPES of = scene_generate(SCENE_UNBOUNDED, SHAPES, 5);
    OWN_SCENE *scene = cylint_scene_new(of.shapes, of.n, 1, NULL);
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
    CHECK(least_stack >=
          200 << 10); /* also if the system's threads have less */
    for (int most = 0; most < 5; most++)
        check_refused_threads(scene, &lines, most, expected);
}

/* Six calls for n lines or points of 0, of which the lines are invalid, and one
 * that makes a scene of n balls, in five steps that threads share.  Returns the
 * number of threads that work. */
enum { CALLS = 7, MOST_LINES = 66 * 1024, STEPS = 5 };

static size_t threads_of(int call, size_t n)
{
    static const double zero[MOST_LINES];
    static size_t numbers[MOST_LINES];
    static signed char any[MOST_LINES];
    static double sums[MOST_LINES];
    static cylint_shape balls[3 * 4096];
    const cylint_piece_rule rule = {.mode = CYLINT_PIECES_UNION};
    const cylint_lines lines = {
        .n = n, .o = {zero, zero, zero}, .d = {zero, zero, zero}};
    const cylint_points points = {n, {zero, zero, zero}};
    cylint_piece_rows rows;
    OWN_SCENE *empty = cylint_scene_new(NULL, 0, 1, NULL);
    for (size_t i = 0; call == 6 && i < n; i++)
        cylint_sphere(&balls[i], (double[3]){(double)i, 0, 0}, 1,
                      CYLINT_ENDS_CAPPED);
    threads_started = 0;
    if (call == 0)
        cylint_scene_nearest_lines(empty, &lines, NULL, 99, numbers, NULL);
    else if (call == 1)
        cylint_scene_any_lines(empty, &lines, NULL, 99, any);
    else if (call == 2)
        cylint_scene_count_lines(empty, &lines, 0, 99, numbers);
    else if (call == 3)
        cylint_scene_closest_points(empty, &points, NULL, 99, numbers, NULL);
    else if (call == 4)
        cylint_scene_sums(empty, &lines, &rule, NULL, 1, 0, 99, sums);
    else if (call == 5 && cylint_scene_pieces_lines(empty, &lines, &rule, 0, 99,
                                                    &rows) == CYLINT_SCENE_OK)
        cylint_piece_rows_free(&rows);
    else if (call == 6)
        cylint_scene_free(cylint_scene_new(balls, n, 99, NULL));
    return (size_t)threads_started / (call == 6 ? STEPS : 1) + 1;
}

/* As many as the manual permits. */
TEST(threads_have_at_least_so_many_lines_points_or_shapes)
{
    static const size_t least[CALLS] = {1024, 1024, 1024, 1024, 256, 256, 4096};
    static const size_t threads[] = {2, 3, 64, 65};
    for (int call = 0; call < CALLS && has_threads; call++)
        for (size_t k = 0; k < (call < 6 ? 4 : 2); k++) {
            const size_t most = threads[k], n = most * least[call];
            const size_t enough = threads_of(call, n),
                         less = threads_of(call, n - 1);
            if (!CHECK(enough == (most < 64 ? most : 64) && less == most - 1))
                REPORT("call %d: %zu threads for %zu, %zu for one less", call,
                       enough, n, less);
        }
}

#endif
