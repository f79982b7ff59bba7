/*
 * pieces.c - the time of the pieces of a line, beside what a caller does without them
 *
 *     pieces [N...]
 *     pieces --sums [N...]
 *
 * Cylinders in random directions fill a cube; rays begin in it.  The contestants take
 * turns in one run, pinned; the least time of each counts, in ns a hit and beside the
 * recipe: numbers of all shapes, both roots of each, sorted, merged; and beside Embree
 * where it is installed (embree_chords.h).  --sums: the seconds that the sums of a
 * million rays take with two threads.
 */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "cylint_scene.h"
#include "embree_chords.h"
#include "random.h"
#include "timing.h"

enum {
    RAYS = 2000,
    ROUNDS = 5,
    MOST = 1 << 16,
    WORK = 1 << 23,
    LINES = 1000000
};

/* Length in mean distances of neighbours, radius in lengths. */
static const struct stick {
    const char *name;
    double length, radius;
} sticks[] = {{"thin", 4, 0.02}, {"fat", 1.36, 0.2}};

static struct {
    cylint_shape *shapes;
    struct prepared_cylinder *cylinders;
    cylint_scene *scene;
    struct embree_chords *embree;
    cylint_line rays[RAYS];
    size_t numbers[MOST];
    cylint_piece pieces[MOST];
    char work[WORK];
    double end[2 * MOST][2]; /* t, and 1 or -1 */
    double sum;              /* of lengths, so that nothing is left out */
} bench;

static void direction(uint64_t *random, double d[3])
{
    double dd;
    do {
        for (int j = 0; j < 3; j++)
            d[j] = 2 * random_unit(random) - 1;
        dd = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    } while (dd > 1 || dd < 0.01);
    for (int j = 0; j < 3; j++)
        d[j] /= sqrt(dd);
}

static void make_scene(size_t n, const struct stick *of)
{
    uint64_t random = 1;
    const double length = of->length / cbrt((double)n);
    bench.shapes = malloc(n * sizeof *bench.shapes);
    bench.cylinders = malloc(n * sizeof *bench.cylinders);
    if (!bench.shapes || !bench.cylinders)
        exit(4);
    for (size_t i = 0; i < n; i++) {
        struct prepared_cylinder *c = &bench.cylinders[i];
        double q[3];
        direction(&random, c->axis);
        c->length = length;
        c->r = of->radius * length;
        for (int j = 0; j < 3; j++) {
            c->p[j] = random_unit(&random);
            q[j] = c->p[j] + length * c->axis[j];
        }
        cylint_cylinder(&bench.shapes[i], c->p, q, c->r, CYLINT_ENDS_CAPPED);
    }
    bench.scene = cylint_scene_new(bench.shapes, n, 0, NULL);
    if (!bench.scene)
        exit(4);
    for (int i = 0; i < RAYS; i++) {
        double o[3], d[3];
        direction(&random, d);
        for (int j = 0; j < 3; j++)
            o[j] = random_unit(&random);
        cylint_ray(&bench.rays[i], o, d);
    }
}

static void free_scene(void)
{
    cylint_scene_free(bench.scene);
    free(bench.shapes);
    free(bench.cylinders);
}

/* ---------------------------------------------------------- contestants -- */

static size_t find_nearest(const cylint_line *ray)
{
    cylint_hit hit;
    return cylint_scene_nearest(bench.scene, ray, CYLINT_WANT_T, &hit) <
           cylint_scene_size(bench.scene);
}

static size_t count_hits(const cylint_line *ray)
{
    return cylint_scene_count(bench.scene, ray, 0);
}

static int compare_ends(const void *x, const void *y)
{
    const double a = *(const double *)x, b = *(const double *)y;
    return (a > b) - (a < b);
}

/* What a careful caller writes: the union of the lengths. */
static size_t use_recipe(const cylint_line *ray)
{
    const size_t n = cylint_scene_all(bench.scene, ray, 0, bench.numbers, MOST);
    size_t ends = 0;
    for (size_t i = 0; i < n; i++) {
        cylint_answer a;
        const int hits = cylint_intersect(&bench.shapes[bench.numbers[i]], ray,
                                          CYLINT_WANT_T, &a);
        for (int j = 0; j < 2; j++) {
            bench.end[ends][0] =
                j + hits < 2 ? ray->tmin : a.hit[j + hits - 2].t;
            bench.end[ends++][1] = j == 0 ? 1 : -1;
        }
    }
    qsort(bench.end, ends, sizeof *bench.end, compare_ends);
    double depth = 0, begin = 0;
    size_t pieces = 0;
    for (size_t i = 0; i < ends; i++) {
        if (depth == 0)
            begin = bench.end[i][0];
        depth += bench.end[i][1];
        if (depth == 0) {
            bench.sum += bench.end[i][0] - begin;
            pieces++;
        }
    }
    return pieces;
}

static size_t find_pieces(const cylint_line *ray, cylint_piece_mode mode,
                          size_t most)
{
    const cylint_piece_rule rule = {.mode = mode};
    cylint_workspace work = {bench.work, sizeof bench.work, 0};
    const size_t n =
        cylint_scene_pieces(bench.scene, ray, &rule, bench.pieces, most, &work);
    for (size_t i = 0; i < n; i++)
        bench.sum += bench.pieces[i].t1 - bench.pieces[i].t0;
    return n;
}

static size_t find_union(const cylint_line *ray)
{
    return find_pieces(ray, CYLINT_PIECES_UNION, MOST);
}

static size_t find_owners(const cylint_line *ray)
{
    return find_pieces(ray, CYLINT_PIECES_OWNER, MOST);
}

static size_t find_chords(const cylint_line *ray)
{
    return find_pieces(ray, CYLINT_PIECES_CHORDS, MOST);
}

static size_t find_first(const cylint_line *ray)
{
    return find_pieces(ray, CYLINT_PIECES_UNION, 1);
}

static size_t find_four(const cylint_line *ray)
{
    return find_pieces(ray, CYLINT_PIECES_UNION, 4);
}

#ifdef CYLINT_EMBREE
static size_t use_embree(const cylint_line *ray)
{
    return embree_chords_union(bench.embree, ray, &bench.sum);
}
#endif

enum { NEAREST, COUNT, RECIPE, EMBREE };
static const struct {
    const char *name;
    size_t (*answer)(const cylint_line *ray);
} contestants[] = {
    {"nearest", find_nearest}, {"count", count_hits},  {"recipe", use_recipe},
#ifdef CYLINT_EMBREE
    {"Embree", use_embree},
#endif
    {"union", find_union},     {"owner", find_owners}, {"chords", find_chords},
    {"first", find_first},     {"first 4", find_four}};
enum { CONTESTANTS = sizeof contestants / sizeof *contestants };

/* The sums of many lines, two threads, in seconds of the clock. */
static void time_sums(size_t n, const struct stick *of)
{
    const cylint_piece_rule owners = {.mode = CYLINT_PIECES_OWNER};
    double *column[6], *sums = malloc(LINES * sizeof *sums);
    uint64_t random = 2;
    make_scene(n, of);
    for (int k = 0; k < 6; k++) {
        column[k] = malloc(LINES * sizeof **column);
        if (!column[k] || !sums)
            exit(4);
    }
    for (size_t i = 0; i < LINES; i++) {
        double d[3];
        direction(&random, d);
        for (int j = 0; j < 3; j++) {
            column[j][i] = random_unit(&random);
            column[j + 3][i] = d[j];
        }
    }
    const cylint_lines lines = {.n = LINES,
                                .o = {column[0], column[1], column[2]},
                                .d = {column[3], column[4], column[5]}};
    struct timespec begin, end;
    clock_gettime(CLOCK_MONOTONIC, &begin);
    if (cylint_scene_sums(bench.scene, &lines, &owners, NULL, 1, 1, 2, sums) !=
        CYLINT_SCENE_OK)
        exit(4);
    clock_gettime(CLOCK_MONOTONIC, &end);
    printf("%zu %s: sums of %d lines, 2 threads: %.2f s\n", n, of->name,
           (int)LINES,
           (double)(end.tv_sec - begin.tv_sec) +
               1e-9 * (double)(end.tv_nsec - begin.tv_nsec));
    bench.sum += sums[0];
    for (int k = 0; k < 6; k++)
        free(column[k]);
    free(sums);
    free_scene();
}

static void race_pieces(size_t n, const struct stick *of)
{
    struct timing least[CONTESTANTS];
    size_t found[CONTESTANTS];
    make_scene(n, of);
#ifdef CYLINT_EMBREE
    bench.embree = embree_chords_new(bench.cylinders, n);
#endif
    for (int round = 0; round < ROUNDS; round++)
        for (int c = 0; c < CONTESTANTS; c++) {
            const struct timing start = timing_now();
            found[c] = 0;
            for (int i = 0; i < RAYS; i++)
                found[c] += contestants[c].answer(&bench.rays[i]);
            const struct timing sample = timing_since(start);
            if (round == 0)
                least[c] = sample;
            timing_keep_least(&least[c], sample);
        }
    printf("%zu %s: %.1f hits a ray, nearest %.0f ns\n", n, of->name,
           (double)found[COUNT] / RAYS, least[NEAREST].ns / RAYS);
    for (int c = 1; c < CONTESTANTS; c++) {
        printf("  %-8s %7.0f ns a ray, %5.0f a hit, %5.2f of the recipe, "
               "%5.2f of nearest",
               contestants[c].name, least[c].ns / RAYS,
               least[c].ns / (double)found[COUNT],
               least[c].ns / least[RECIPE].ns, least[c].ns / least[NEAREST].ns);
#ifdef CYLINT_EMBREE
        printf(", %5.2f of Embree", least[c].ns / least[EMBREE].ns);
#endif
        printf("; %.2f pieces a ray\n", (double)found[c] / RAYS);
    }
    fflush(stdout);
#ifdef CYLINT_EMBREE
    embree_chords_free(bench.embree);
#endif
    free_scene();
}

int main(int argc, char **argv)
{
    static const char *const usual[] = {"10000", "200000", "1000000"};
    const int sums = argc > 1 && strcmp(argv[1], "--sums") == 0;
    const int given = argc - 1 - sums, n = given > 0 ? given : 3;
    if (!sums)
        timing_begin();
    for (int i = 0; i < n; i++)
        for (size_t j = 0; j < sizeof sticks / sizeof *sticks; j++)
            (sums ? time_sums : race_pieces)(
                strtoull(given > 0 ? argv[1 + sums + i] : usual[i], NULL, 10),
                &sticks[j]);
    return !(bench.sum > 0);
}
