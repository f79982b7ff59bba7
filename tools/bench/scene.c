/*
 * scene.c - time and memory of cylint_scene, beside batches of all shapes
 *
 *     scene [-j THREADS] KIND N | NAME COMMAND
 *
 * KIND is a number of tests/support/scenes.h; COMMAND prints a scene.  The
 * environment variable KERNELS chooses the kernels.  The rays are those of a
 * camera, pixel by pixel, and random ones.  Times are processor time of this
 * thread or, with -j, elapsed time of THREADS threads that share the rays.
 * Queries of all rays in one call have elapsed times.
 */
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "cylint_scene.h"
#include "scenes.h"

enum {
    SIDE = 128,
    RAYS = SIDE * SIDE,
    TURNS = 3,
    BRUTE_RAYS = 40,
    THREADS = 64
};

static double clock_now(clockid_t clock)
{
    struct timespec t;
    clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

typedef enum { NEAREST, ANY, COUNT, ALL, QUESTIONS } question;

static const char *const question_name[] = {"nearest", "any", "count", "all"};

/* The query, its target and the lines of one thread. */
struct turn {
    const cylint_scene *scene;
    const cylint_pack *pack; /* NULL: query the scene */
    const cylint_line *lines;
    size_t n;
    question what;
    size_t sum;
    pthread_t thread;
};

static size_t query_scene(const struct turn *t, const cylint_line *line)
{
    cylint_hit hit;
    size_t numbers[64];
    switch (t->what) {
    case NEAREST:
        return cylint_scene_nearest(t->scene, line,
                                    CYLINT_WANT_T | CYLINT_WANT_PART, &hit);
    case ANY:
        return cylint_scene_count(t->scene, line, 1);
    case COUNT:
        return cylint_scene_count(t->scene, line, 0);
    default:
        return cylint_scene_all(t->scene, line, 0, numbers, 64);
    }
}

static size_t query_pack(const struct turn *t, const cylint_line *line)
{
    cylint_hit hit;
    return t->what == NEAREST
               ? cylint_nearest(t->pack, line, CYLINT_WANT_T | CYLINT_WANT_PART,
                                &hit)
               : cylint_count(t->pack, line, t->what == ANY);
}

static void *take_turn(void *argument)
{
    struct turn *t = argument;
    for (size_t i = 0; i < t->n; i++)
        t->sum += t->pack ? query_pack(t, &t->lines[i])
                          : query_scene(t, &t->lines[i]);
    return NULL;
}

/* Seconds a ray, the least of several turns. */
static double time_of(const struct turn *of, int threads, int turns,
                      size_t *sum)
{
    double least = HUGE_VAL;
    for (int turn = 0; turn < turns; turn++) {
        struct turn part[THREADS];
        const clockid_t clock =
            threads == 1 ? CLOCK_THREAD_CPUTIME_ID : CLOCK_MONOTONIC;
        const double start = clock_now(clock);
        *sum = 0;
        for (int i = 0; i < threads; i++) {
            const size_t from = of->n * (size_t)i / (size_t)threads;
            part[i] = *of;
            part[i].lines += from;
            part[i].n = of->n * (size_t)(i + 1) / (size_t)threads - from;
            if (threads == 1)
                take_turn(&part[0]);
            else if (pthread_create(&part[i].thread, NULL, take_turn,
                                    &part[i]) != 0)
                abort();
        }
        for (int i = 0; i < threads; i++) {
            if (threads > 1)
                pthread_join(part[i].thread, NULL);
            *sum += part[i].sum;
        }
        least = fmin(least, clock_now(clock) - start);
    }
    return least / (double)of->n;
}

/* The rays in columns, and their answers. */
static double column[6][RAYS], t_of[RAYS];
static size_t number_of[RAYS];
static signed char part_of[RAYS];

static void query_in_one_call(const cylint_scene *scene, question what,
                              int threads)
{
    const cylint_lines lines = {RAYS,
                                {column[0], column[1], column[2]},
                                {column[3], column[4], column[5]},
                                NULL,
                                NULL};
    const cylint_hit_columns hits = {.t = t_of, .part = part_of};
    if (what == NEAREST)
        cylint_scene_nearest_lines(scene, &lines, NULL, threads, number_of,
                                   &hits);
    else if (what == ANY)
        cylint_scene_any_lines(scene, &lines, NULL, threads, part_of);
    else
        cylint_scene_count_lines(scene, &lines, 0, threads, number_of);
}

/* Prints the time of a ray among all rays in one call, of one thread and of two. */
static void measure_one_call(const struct turn *of, question what)
{
    for (int i = 0; i < RAYS; i++)
        for (int j = 0; j < 3; j++) {
            column[j][i] = of->lines[i].o[j];
            column[3 + j][i] = of->lines[i].d[j];
        }
    for (int threads = 1; threads <= 2; threads++) {
        double least = HUGE_VAL;
        for (int turn = 0; turn < TURNS; turn++) {
            const double start = clock_now(CLOCK_MONOTONIC);
            query_in_one_call(of->scene, what, threads);
            least = fmin(least, clock_now(CLOCK_MONOTONIC) - start);
        }
        printf("%s %.0f", threads == 1 ? "  in one call" : " ns, 2 threads",
               1e9 * least / RAYS);
    }
    printf(" ns");
}

/* The rays of a camera that shows the whole scene from a corner. */
static void camera(const struct scene_shapes *s, cylint_line *lines)
{
    double size = 0, eye[3], d[3];
    const double side[3] = {0.6, -0.8, 0}, up[3] = {-0.32, -0.24, 0.917};
    for (int j = 0; j < 3; j++)
        size = fmax(size, s->hi[j] - s->lo[j]);
    for (int i = 0; i < RAYS; i++) {
        const double x = (double)(i % SIDE) / SIDE - 0.5;
        const double y = (double)(i / SIDE) / SIDE - 0.5;
        const double forward[3] = {0.73, 0.55, 0.4};
        for (int j = 0; j < 3; j++) {
            eye[j] = (s->lo[j] + s->hi[j]) / 2 - 1.5 * size * forward[j];
            d[j] = forward[j] + 0.8 * (x * side[j] + y * up[j]);
        }
        cylint_ray(&lines[i], eye, d);
    }
}

static void measure(const struct turn *of, const char *rays, int threads,
                    int brute)
{
    for (int what = 0; what < QUESTIONS; what++) {
        struct turn t = *of;
        size_t sum, sum_by_brute_force;
        t.what = (question)what;
        const cylint_pack *const pack = t.pack;
        t.pack = NULL;
        const double by_scene = time_of(&t, threads, TURNS, &sum);
        printf("%-8s %-8s %10.0f ns  %8.3f Mray/s", rays, question_name[what],
               1e9 * by_scene, 1e-6 / by_scene);
        if (what != ALL)
            measure_one_call(&t, t.what);
        t.pack = pack;
        t.n = BRUTE_RAYS;
        t.lines += RAYS / 2;
        if (brute && what != ALL)
            printf("  batch of all shapes %10.0f ns",
                   1e9 * time_of(&t, 1, 1, &sum_by_brute_force));
        printf("  (sum %zu)\n", sum);
    }
}

/* Prints the time to move shapes [first, first + n), beside that to build. */
static void measure_refit(cylint_scene *scene, const struct scene_shapes *of,
                          size_t first, size_t n, double build)
{
    double least = HUGE_VAL;
    for (int turn = 0; turn < TURNS; turn++) {
        const double start = clock_now(CLOCK_PROCESS_CPUTIME_ID);
        if (cylint_scene_refit(scene, first, n, of->shapes + first) !=
            CYLINT_SCENE_OK)
            abort();
        least = fmin(least, clock_now(CLOCK_PROCESS_CPUTIME_ID) - start);
    }
    printf("refit of %zu shapes: %.1f ns a shape of the scene, %.3f of the "
           "build's "
           "processor time\n",
           n, 1e9 * least / (double)of->n, least / build);
}

int main(int argc, char **argv)
{
    struct scene_shapes of;
    int threads = 1;
    if (argc > 3 && strcmp(argv[1], "-j") == 0) {
        threads = atoi(argv[2]);
        argv += 2;
    }
    const char *kernels = getenv("KERNELS");
    if (argc < 3 || threads < 1 || threads > THREADS ||
        (kernels && !cylint_use_kernels(kernels)))
        return 2;
    char *end;
    const long kind = strtol(argv[1], &end, 10);
    if (!(*end ? scene_from(argv[1], argv[2], &of)
               : scene_generate((int)kind, strtoul(argv[2], NULL, 10), 1, &of)))
        return 1;
    cylint_pack pack;
    void *memory = malloc(cylint_pack_bytes(of.n));
    cylint_line *lines = malloc(RAYS * sizeof *lines);
    if (!memory || !lines)
        return 4;
    cylint_pack_shapes(&pack, memory, of.shapes, of.n);
    const double wall = clock_now(CLOCK_MONOTONIC);
    const double cpu = clock_now(CLOCK_PROCESS_CPUTIME_ID);
    cylint_scene *scene = cylint_scene_new(of.shapes, of.n, threads, NULL);
    if (!scene)
        return 3;
    const double build = clock_now(CLOCK_PROCESS_CPUTIME_ID) - cpu;
    printf("%s: %zu shapes, built in %.3f s (%.3f s of processor time), %.1f "
           "bytes a shape; ns: lower is better, Mray/s: higher is better\n",
           of.name, of.n, clock_now(CLOCK_MONOTONIC) - wall, build,
           (double)cylint_scene_bytes(scene) / (double)of.n);
    struct turn turn = {
        .scene = scene, .pack = &pack, .lines = lines, .n = RAYS};
    camera(&of, lines);
    measure(&turn, "camera", threads, threads == 1);
    for (size_t i = 0; i < RAYS; i++)
        scene_line(&of, LINES_RANDOM, 1, i, &lines[i]);
    measure(&turn, "random", threads, 0);
    measure_refit(scene, &of, of.n / 2, of.n / 100, build);
    measure_refit(scene, &of, 0, of.n, build);
    cylint_scene_free(scene);
    free(memory);
    free(lines);
    scene_release(&of);
    return 0;
}
