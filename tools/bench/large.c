/*
 * large.c - makes, saves, opens and queries a scene of very many cylinders
 *
 *     large N FILE [fat | thin | fibres [THREADS]]
 *
 * The cylinders fill a cube in random directions and are added in blocks.  Prints
 * the seconds and the greatest memory of each step; "lines" are LINES random
 * segments.
 */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <time.h>

#include "cylint_scene.h"
#include "random.h"

enum { BLOCK = 4096, LINES = 1000 };

/* Length and radius in mean distances of neighbours. */
static const struct stick {
    const char *name;
    double length, radius;
} sticks[] = {{"thin", 3, 0.15}, {"fat", 1.2, 0.4}, {"fibres", 10, 0.02}};

static double seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Prints what a step took since the last one. */
static void print_step(const char *step, size_t n)
{
    static double last;
    struct rusage usage;
    const double now = seconds();
    getrusage(RUSAGE_SELF, &usage);
    if (step)
        printf("%-24s %10.4f s, most memory so far %6.0f MB, %5.1f bytes a "
               "shape\n",
               step, now - last, (double)usage.ru_maxrss / 1000 * 1.024,
               (double)usage.ru_maxrss * 1024 / (double)n);
    fflush(stdout);
    last = seconds();
}

static void point_in_cube(uint64_t *random, double side, double p[3])
{
    for (int j = 0; j < 3; j++)
        p[j] = side * random_unit(random);
}

static void make_stick(const struct stick *of, uint64_t *random, double side,
                       cylint_shape *shape)
{
    double p0[3], p1[3], d[3], square = 0;
    point_in_cube(random, side, p0);
    do {
        square = 0;
        for (int j = 0; j < 3; j++) {
            d[j] = 2 * random_unit(random) - 1;
            square += d[j] * d[j];
        }
    } while (square > 1 || square < 1e-6);
    for (int j = 0; j < 3; j++)
        p1[j] = p0[j] + of->length / sqrt(square) * d[j];
    cylint_cylinder(shape, p0, p1, of->radius, CYLINT_ENDS_CAPPED);
}

static cylint_scene *make(const struct stick *of, size_t n, int threads)
{
    static cylint_shape block[BLOCK];
    uint64_t random = 1;
    const double side = cbrt((double)n);
    cylint_scene *scene = cylint_scene_begin(n);
    for (size_t i = 0; scene && i < n; i += BLOCK) {
        const size_t count = n - i < BLOCK ? n - i : BLOCK;
        for (size_t k = 0; k < count; k++)
            make_stick(of, &random, side, &block[k]);
        if (cylint_scene_add(scene, block, count) != CYLINT_SCENE_OK)
            return NULL;
    }
    print_step("generate and add", n);
    if (!scene ||
        cylint_scene_finish(scene, threads, NULL, NULL) != CYLINT_SCENE_OK)
        return NULL;
    print_step("build", n);
    return scene;
}

/* The sum of the numbers of first hits. */
static size_t query(const cylint_scene *scene, int lines)
{
    uint64_t random = 2;
    size_t sum = 0;
    const double side = cbrt((double)cylint_scene_size(scene));
    for (int i = 0; i < lines; i++) {
        double from[3], to[3];
        cylint_line line;
        cylint_hit hit;
        point_in_cube(&random, side, from);
        point_in_cube(&random, side, to);
        if (cylint_segment(&line, from, to) == CYLINT_OK)
            sum += cylint_scene_nearest(scene, &line, CYLINT_WANT_T, &hit);
    }
    return sum;
}

static void open_and_query(const char *path, unsigned flags, const char *step,
                           size_t n, size_t expected)
{
    cylint_scene_status status;
    cylint_scene *scene = cylint_scene_open(path, flags, &status);
    print_step(step, n);
    if (!scene) {
        printf("%s\n", cylint_scene_strerror(status));
        exit(1);
    }
    query(scene, 1);
    print_step("first line", n);
    const size_t sum = query(scene, LINES);
    print_step("lines", n);
    if (sum != expected)
        puts("the answers differ from those of the scene that was saved");
    cylint_scene_free(scene);
}

int main(int argc, char **argv)
{
    if (argc < 3)
        return 2;
    const size_t n = (size_t)atof(argv[1]);
    const int threads = argc > 4 ? atoi(argv[4]) : 1;
    const struct stick *of = sticks;
    for (int i = 1; i < 3 && argc > 3; i++)
        of = strcmp(argv[3], sticks[i].name) == 0 ? &sticks[i] : of;
    print_step(NULL, n);
    cylint_scene *scene = make(of, n, threads);
    if (!scene) {
        puts("there is not enough memory");
        return 1;
    }
    printf("%zu cylinders, %s, %.1f bytes a shape\n", n, of->name,
           (double)cylint_scene_bytes(scene) / (double)n);
    const size_t sum = query(scene, LINES);
    print_step("lines", n);
    if (cylint_scene_save(scene, argv[2]) != CYLINT_SCENE_OK) {
        perror(argv[2]);
        return 1;
    }
    print_step("save", n);
    cylint_scene_free(scene);
    print_step("free", n);
    open_and_query(argv[2], CYLINT_SCENE_TRUSTED, "open, trusted", n, sum);
    open_and_query(argv[2], 0, "open, checked", n, sum);
    return 0;
}
