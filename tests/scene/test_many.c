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

static void fill_lines(const struct scene_shapes *of)
{
    for (size_t i = 0; i < MOST; i++) {
        cylint_line line;
        memset(&line, 0, sizeof line);
        /* wild lines test every shape: few of them, in two blocks */
        const size_t kinds = i < 300 ? LINES_KINDS : LINES_WILD;
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

/* -------------------------------------------------------------- queries -- */

/* The scene and the arguments of the queries. */
static struct {
    const cylint_scene *scene;
    int domain; /* the lines have one */
    const size_t *except;
    const double *radii;
    size_t enough;
} given;

/* Of one line or point, into element i of `expected`; of the first n, into the
 * arrays of `mask`, all of which are `arrays`. */
typedef struct {
    void (*of_one)(size_t i);
    void (*of_many)(size_t n, int threads, unsigned mask);
    unsigned arrays;
} query;

static cylint_line line_now(size_t i)
{
    cylint_line line;
    const double o[3] = {input[0][i], input[1][i], input[2][i]};
    const double d[3] = {input[3][i], input[4][i], input[5][i]};
    cylint_span(&line, o, d, given.domain ? input[6][i] : 0,
                given.domain ? input[7][i] : HUGE_VAL);
    return line;
}

static cylint_lines lines_now(size_t n)
{
    return lines_of(array, n, given.domain ? 3 : 0);
}

static void expect(size_t i, size_t number, int part, int other,
                   const double *value)
{
    const int is = number < cylint_scene_size(given.scene);
    expected.number[i] = number;
    expected.small[0][i] = (signed char)(is ? part : -1);
    expected.small[1][i] = (signed char)(is ? other : -1);
    for (int k = 0; k < NUMBERS; k++)
        expected.value[k][i] = is ? value[k] : (double)NAN;
}

static void nearest_of_one(size_t i)
{
    const cylint_line line = line_now(i);
    cylint_hit h;
    const size_t number =
        given.except
            ? cylint_scene_nearest_other(given.scene, &line, given.except[i],
                                         CYLINT_WANT_ALL, &h)
            : cylint_scene_nearest(given.scene, &line, CYLINT_WANT_ALL, &h);
    const double value[NUMBERS] = {h.t,         h.point[0],  h.point[1],
                                   h.point[2],  h.normal[0], h.normal[1],
                                   h.normal[2], h.z,         h.phi};
    expect(i, number, h.part, h.side, value);
}

static cylint_hit_columns columns_now(unsigned mask)
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

static void nearest_of_many(size_t n, int threads, unsigned mask)
{
    const cylint_lines lines = lines_now(n);
    const cylint_hit_columns hits = columns_now(mask);
    cylint_scene_nearest_lines(given.scene, &lines, given.except, threads,
                               mask & 1 ? found.number : NULL,
                               mask == 1 ? NULL : &hits);
}

static void count_of_one(size_t i)
{
    const cylint_line line = line_now(i);
    expected.number[i] = cylint_scene_count(given.scene, &line, given.enough);
    expected.small[0][i] = (signed char)cylint_scene_occluded(
        given.scene, &line, given.except ? given.except[i] : SIZE_MAX);
}

static void count_of_many(size_t n, int threads, unsigned mask)
{
    const cylint_lines lines = lines_now(n);
    cylint_scene_count_lines(given.scene, &lines, given.enough, threads,
                             mask & 1 ? found.number : NULL);
    cylint_scene_any_lines(given.scene, &lines, given.except, threads,
                           mask & 2 ? found.small[0] : NULL);
}

static void closest_of_one(size_t i)
{
    const double point[3] = {input[0][i], input[1][i], input[2][i]};
    cylint_closest c;
    const size_t number = cylint_scene_closest(
        given.scene, point, given.radii ? given.radii[i] : HUGE_VAL,
        CYLINT_WANT_ALL, &c);
    const double value[NUMBERS] = {c.distance, c.point[0],  c.point[1],
                                   c.point[2], c.normal[0], c.normal[1],
                                   c.normal[2]};
    expect(i, number, c.part, c.feature, value);
}

static void closest_of_many(size_t n, int threads, unsigned mask)
{
    const cylint_points points = {n, {input[0], input[1], input[2]}};
    const cylint_hit_columns to = columns_now(mask);
    const cylint_closest_columns columns = {
        .distance = to.t,
        .part = to.part,
        .feature = to.side,
        .point = {to.point[0], to.point[1], to.point[2]},
        .normal = {to.normal[0], to.normal[1], to.normal[2]}};
    cylint_scene_closest_points(given.scene, &points, given.radii, threads,
                                mask & 1 ? found.number : NULL,
                                mask == 1 ? NULL : &columns);
}

static const query nearest = {nearest_of_one, nearest_of_many,
                              (1u << ARRAYS) - 1},
                   count = {count_of_one, count_of_many, 3},
                   closest = {closest_of_one, closest_of_many,
                              (1u << (ARRAYS - 2)) - 1}; /* no z and no phi */

/* ---------------------------------------------------------------- tests -- */

static void check_call(const query *q, size_t n, int threads, unsigned mask)
{
    memset(&found, 77, sizeof found);
    q->of_many(n, threads, mask);
    if (!CHECK(are_as_expected(n, mask)))
        REPORT("%zu lines or points, %d threads, arrays %x", n, threads, mask);
}

/* With each number of lines and threads, and each array alone or left out. */
static void check_query(const query *q)
{
    static const size_t sizes[] = {0, 1, 255, 256, 257, MOST};
    static const int threads[] = {1, 2, 5};
    for (size_t i = 0; i < MOST; i++)
        q->of_one(i);
    for (size_t k = 0; k < 18; k++)
        check_call(q, sizes[k / 3], threads[k % 3], q->arrays);
    for (int k = 0; k < ARRAYS; k++)
        if (q->arrays >> k & 1) {
            check_call(q, 300, 2, 1u << k);
            check_call(q, 300, 2, q->arrays & ~(1u << k));
        }
    check_call(q, 300, 2, 0);
}

/* The shapes that the lines hit first, as of rays that leave them. */
static void leave_out_nearest(void)
{
    for (size_t i = 0; i < MOST; i++)
        except[i] = i % 7 == 0 ? SIZE_MAX : expected.number[i];
}

/* Without exceptions and radii, then with them; of lines or points in the box of a
 * scene of this kind, which are also those of an empty scene. */
static void check_scene(enum scene_kind kind, const query *q)
{
    OWN_SHAPES of = scene_generate((int)kind, SHAPES, 3);
    OWN_SCENE *scene = cylint_scene_new(of.shapes, of.n, 1, NULL);
    OWN_SCENE *empty = cylint_scene_new(NULL, 0, 1, NULL);
    (q == &closest ? fill_points : fill_lines)(&of);
    memset(&given, 0, sizeof given);
    given.scene = empty;
    check_query(q);
    given.scene = scene;
    check_query(q);
    size_t hits = 0;
    given.domain = 1;
    for (size_t i = 0; i < MOST && q != &closest; i++)
        nearest_of_one(i);
    for (size_t i = 0; i < MOST; i++)
        hits += expected.number[i] < SHAPES;
    CHECK(hits > MOST / 10 && hits < MOST);
    leave_out_nearest();
    given.except = except;
    given.radii = radii;
    given.enough = 3;
    check_query(q);
}

TEST(nearest_hits_are_those_of_single_lines)
{
    check_scene(SCENE_MIXED, &nearest);
    check_scene(SCENE_UNBOUNDED, &nearest);
    check_scene(SCENE_STRANDS, &nearest);
}

TEST(any_and_count_are_those_of_single_lines)
{
    check_scene(SCENE_UNBOUNDED, &count);
}

TEST(closest_shapes_are_those_of_single_points)
{
    check_scene(SCENE_ROUND, &closest);
    check_scene(SCENE_UNBOUNDED, &closest);
}
