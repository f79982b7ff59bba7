/*
 * test_many.c - arrays of answers for many lines or points hold what the
 * queries of one line or point return, bit for bit, with any number of threads
 */
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "check.h"
#include "columns.h"
#include "cylint_scene.h"
#include "draw.h"
#include "scenes.h"

/* MOST: blocks of 256, threads share blocks from 1024 on. */
enum { SHAPES = 300, MOST = 4 * 1024 + 7, NUMBERS = 9 };

static const size_t sizes[] = {0, 1, 255, 256, 257, MOST};
static const int threads[] = {1, 2, 5};
enum { CALLS = 18 }; /* with each size and number of threads */

/* The input: lines of all kinds, some of them invalid, and points. */
static double input[8][MOST], radii[MOST];
static double *const array[8] = {input[0], input[1], input[2], input[3],
                                 input[4], input[5], input[6], input[7]};
static size_t except[MOST];

/* Arrays of answers, with one element more that is not written: the numbers of
 * shapes, two small arrays, and numbers. */
enum { ARRAYS = 3 + NUMBERS };
static struct answers {
    size_t number[MOST + 1];
    signed char small[2][MOST + 1];
    double value[NUMBERS][MOST + 1];
} expected, found;

static void *array_of(struct answers *a, int k, size_t *size)
{
    *size = k == 0 ? sizeof(size_t) : k < 3 ? 1 : sizeof(double);
    return k == 0  ? (void *)a->number
           : k < 3 ? (void *)a->small[k - 1]
                   : (void *)a->value[k - 3];
}

/* Whether the first n elements of the arrays of `mask` are those that are
 * expected, and no others were written. */
static int are_as_expected(size_t n, unsigned mask)
{
    int same = 1;
    for (int k = 0; k < ARRAYS; k++) {
        size_t size, one;
        const char *got = array_of(&found, k, &size);
        const char *due = array_of(&expected, k, &one);
        const size_t written = mask >> k & 1 ? n : 0;
        same = same && same_bytes(got, due, written * size);
        for (size_t i = written * size; i < (n + 1) * size; i++)
            same = same && got[i] == 77;
    }
    return same;
}

static void poison(void)
{
    memset(&found, 77, sizeof found);
}

static void fill_lines(const struct scene_shapes *of)
{
    for (size_t i = 0; i < MOST; i++) {
        cylint_line line;
        memset(&line, 0, sizeof line);
        /* wild lines test every shape: few of them */
        const size_t kinds = i < 1000 ? LINES_KINDS : LINES_WILD;
        scene_line(of, (enum scene_lines)(i % kinds), 1, i, &line);
        set_columns(&line, array, i);
        if (i % 100 == 1)
            input[i / 100 % 8][i] = NAN;
        if (i % 100 == 2)
            input[i / 100 % 6][i] = HUGE_VAL;
        if (i % 100 == 3)
            input[3][i] = input[4][i] = input[5][i] = 0;
        if (i % 100 == 4) {
            input[6][i] = 2;
            input[7][i] = 1;
        }
    }
}

/* Points in the box and around it, and some that are invalid. */
static void fill_points(const struct scene_shapes *of)
{
    for (size_t i = 0; i < MOST; i++) {
        for (int j = 0; j < 3; j++)
            input[j][i] =
                of->lo[j] + (of->hi[j] - of->lo[j]) * between(-0.5, 1.5);
        radii[i] = i % 10 == 0    ? HUGE_VAL
                   : i % 100 == 1 ? (double)NAN
                                  : between(-0.1, 2.9);
        if (i % 100 == 2)
            input[i / 100 % 3][i] = i % 200 == 2 ? (double)NAN : HUGE_VAL;
    }
}

static cylint_line line_now(size_t i, int domain)
{
    cylint_line line;
    const double o[3] = {input[0][i], input[1][i], input[2][i]};
    const double d[3] = {input[3][i], input[4][i], input[5][i]};
    cylint_span(&line, o, d, domain ? input[6][i] : 0,
                domain ? input[7][i] : HUGE_VAL);
    return line;
}

/* ------------------------------------------------------------ nearest --- */

static void expect(size_t i, size_t number, int part, int other,
                   const double *value)
{
    const int is = number < SHAPES;
    expected.number[i] = number;
    expected.small[0][i] = (signed char)(is ? part : -1);
    expected.small[1][i] = (signed char)(is ? other : -1);
    for (int k = 0; k < NUMBERS; k++)
        expected.value[k][i] = is ? value[k] : (double)NAN;
}

static void expect_hits(const cylint_scene *scene, const size_t *without,
                        int domain)
{
    size_t hits = 0;
    for (size_t i = 0; i < MOST; i++) {
        const cylint_line line = line_now(i, domain);
        cylint_hit h;
        const size_t number =
            without ? cylint_scene_nearest_other(scene, &line, without[i],
                                                 CYLINT_WANT_ALL, &h)
                    : cylint_scene_nearest(scene, &line, CYLINT_WANT_ALL, &h);
        const double value[NUMBERS] = {h.t,         h.point[0],  h.point[1],
                                       h.point[2],  h.normal[0], h.normal[1],
                                       h.normal[2], h.z,         h.phi};
        expect(i, number, h.part, h.side, value);
        hits += number < SHAPES;
    }
    CHECK(hits > MOST / 10 && hits < MOST);
}

/* The arrays of `mask`. */
static cylint_hit_columns wanted_hits(unsigned mask)
{
    double *v[NUMBERS];
    for (int k = 0; k < NUMBERS; k++)
        v[k] = mask >> (3 + k) & 1 ? found.value[k] : NULL;
    return (cylint_hit_columns){.t = v[0],
                                .part = mask >> 1 & 1 ? found.small[0] : NULL,
                                .side = mask >> 2 & 1 ? found.small[1] : NULL,
                                .point = {v[1], v[2], v[3]},
                                .normal = {v[4], v[5], v[6]},
                                .z = v[7],
                                .phi = v[8]};
}

static const unsigned all = (1u << ARRAYS) - 1;

static void check_nearest(const cylint_scene *scene, const size_t *without,
                          size_t n, int workers, unsigned mask, int domain)
{
    const cylint_lines lines = lines_of(array, n, domain ? 3 : 0);
    const cylint_hit_columns hits = wanted_hits(mask);
    poison();
    cylint_scene_nearest_lines(scene, &lines, without, workers,
                               mask & 1 ? found.number : NULL,
                               mask == 1 ? NULL : &hits);
    if (!CHECK(are_as_expected(n, mask)))
        REPORT("%zu lines, %d threads, columns %x", n, workers, mask);
}

static void check_all_nearest(const cylint_scene *scene, const size_t *without)
{
    expect_hits(scene, without, 1);
    for (size_t k = 0; k < CALLS; k++)
        check_nearest(scene, without, sizes[k / 3], threads[k % 3], all, 1);
}

/* The shapes that the lines hit first, as of rays that leave them. */
static void leave_out_nearest(void)
{
    for (size_t i = 0; i < MOST; i++)
        except[i] = i % 7 == 0 ? SIZE_MAX : expected.number[i];
}

static cylint_scene *new_scene(enum scene_kind kind, uint64_t seed,
                               struct scene_shapes *of)
{
    *of = scene_generate((int)kind, SHAPES, seed);
    return cylint_scene_new(of->shapes, of->n, 1, NULL);
}

TEST(nearest_hits_are_those_of_single_lines)
{
    static const enum scene_kind kinds[] = {SCENE_MIXED, SCENE_UNBOUNDED,
                                            SCENE_STRANDS};
    for (int k = 0; k < 3; k++) {
        OWN_SHAPES of;
        OWN_SCENE *scene = new_scene(kinds[k], 3, &of);
        fill_lines(&of);
        check_all_nearest(scene, NULL);
        leave_out_nearest();
        check_all_nearest(scene, except);
    }
}

TEST(only_wanted_columns_are_written)
{
    OWN_SHAPES of;
    OWN_SCENE *scene = new_scene(SCENE_MIXED, 4, &of);
    const cylint_lines lines = lines_of(array, 300, 3);
    fill_lines(&of);
    expect_hits(scene, NULL, 1);
    for (int k = 0; k < ARRAYS; k++) {
        check_nearest(scene, NULL, 300, 1, 1u << k, 1);
        check_nearest(scene, NULL, 300, 1, all & ~(1u << k), 1);
    }
    check_nearest(scene, NULL, 300, 1, 0, 1);
    cylint_scene_any_lines(scene, &lines, NULL, 2, NULL);
    cylint_scene_count_lines(scene, &lines, 0, 2, NULL);
    expect_hits(scene, NULL, 0);
    check_nearest(scene, NULL, 300, 1, all, 0);
}

/* --------------------------------------------------------- any, count --- */

static void check_any_and_count(const cylint_scene *scene,
                                const size_t *without, size_t enough)
{
    for (size_t i = 0; i < MOST; i++) {
        const cylint_line line = line_now(i, 1);
        expected.small[0][i] = (signed char)cylint_scene_occluded(
            scene, &line, without ? without[i] : SHAPES);
        expected.number[i] = cylint_scene_count(scene, &line, enough);
    }
    for (size_t k = 0; k < CALLS; k++) {
        const cylint_lines lines = lines_of(array, sizes[k / 3], 3);
        poison();
        cylint_scene_any_lines(scene, &lines, without, threads[k % 3],
                               found.small[0]);
        cylint_scene_count_lines(scene, &lines, enough, threads[k % 3],
                                 found.number);
        CHECK(are_as_expected(lines.n, 3));
    }
}

TEST(any_and_count_are_those_of_single_lines)
{
    OWN_SHAPES of;
    OWN_SCENE *scene = new_scene(SCENE_UNBOUNDED, 5, &of);
    fill_lines(&of);
    expect_hits(scene, NULL, 1);
    leave_out_nearest();
    check_any_and_count(scene, NULL, 0);
    check_any_and_count(scene, except, 3);
}

/* ------------------------------------------------------------ closest --- */

static void expect_closest(const cylint_scene *scene, const double *within)
{
    for (size_t i = 0; i < MOST; i++) {
        const double point[3] = {input[0][i], input[1][i], input[2][i]};
        cylint_closest c;
        const size_t number = cylint_scene_closest(
            scene, point, within ? within[i] : HUGE_VAL, CYLINT_WANT_ALL, &c);
        const double value[NUMBERS] = {c.distance, c.point[0],  c.point[1],
                                       c.point[2], c.normal[0], c.normal[1],
                                       c.normal[2]};
        expect(i, number, c.part, c.feature, value);
    }
}

static void check_closest(const cylint_scene *scene, const double *within,
                          size_t n, int workers, unsigned mask)
{
    const cylint_points points = {n, {input[0], input[1], input[2]}};
    const cylint_hit_columns as_hits = wanted_hits(mask);
    const cylint_closest_columns columns = {
        .distance = as_hits.t,
        .part = as_hits.part,
        .feature = as_hits.side,
        .point = {as_hits.point[0], as_hits.point[1], as_hits.point[2]},
        .normal = {as_hits.normal[0], as_hits.normal[1], as_hits.normal[2]}};
    poison();
    cylint_scene_closest_points(scene, &points, within, workers,
                                mask & 1 ? found.number : NULL,
                                mask == 1 ? NULL : &columns);
    if (!CHECK(are_as_expected(n, mask)))
        REPORT("%zu points, %d threads, columns %x", n, workers, mask);
}

static void check_all_closest(const cylint_scene *scene, const double *within)
{
    const unsigned closest = all & ~(3u << 10); /* no z and no phi */
    expect_closest(scene, within);
    for (size_t k = 0; k < CALLS; k++)
        check_closest(scene, within, sizes[k / 3], threads[k % 3], closest);
    for (int k = -1; k < ARRAYS - 2; k++)
        check_closest(scene, within, 300, 2, k < 0 ? 0 : 1u << k);
}

TEST(closest_shapes_are_those_of_single_points)
{
    static const enum scene_kind kinds[] = {SCENE_ROUND, SCENE_UNBOUNDED};
    for (int k = 0; k < 2; k++) {
        OWN_SHAPES of;
        OWN_SCENE *scene = new_scene(kinds[k], 6, &of);
        fill_points(&of);
        check_all_closest(scene, radii);
        check_all_closest(scene, NULL);
    }
}

TEST(an_empty_scene_answers_none)
{
    OWN_SCENE *scene = cylint_scene_new(NULL, 0, 1, NULL);
    const cylint_lines lines = lines_of(array, MOST, 3);
    const cylint_hit_columns hits = wanted_hits(all);
    OWN_SHAPES of = scene_generate(SCENE_THIN, SHAPES, 7);
    fill_lines(&of);
    poison();
    cylint_scene_nearest_lines(scene, &lines, NULL, 3, found.number, &hits);
    cylint_scene_any_lines(scene, &lines, except, 3, found.small[1]);
    for (size_t i = 0; i < MOST; i++)
        CHECK(found.number[i] == 0 && found.small[0][i] == -1 &&
              found.small[1][i] == 0 && isnan(found.value[8][i]));
}
