/*
 * test_many.c - floor scene: queries of many lines or points return what the
 * queries of one line or point return, bit for bit, with any number of threads
 */
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "cylint_scene.h"
#include "random.h"
#include "scenes.h"

/* MOST is enough for five threads. */
enum { SHAPES = 200, MOST = 10000, HIT_NUMBERS = 9, CLOSEST_NUMBERS = 7 };

static const size_t sizes[] = {0, 1, 255, 256, 257, MOST};
enum { SIZES = sizeof sizes / sizeof *sizes };
static const int threads[] = {1, 2, 5};
enum { THREADS = sizeof threads / sizeof *threads };

/* The input: lines of all kinds, some of them invalid, and points. */
static double input[8][MOST];
static cylint_lines lines;
static cylint_points points;
static double radii[MOST];
static size_t except[MOST];

/* Arrays of answers, with one element more that is not written. */
struct answers {
    size_t number[MOST + 1];
    signed char small[2][MOST + 1];
    double value[HIT_NUMBERS][MOST + 1];
};

static struct answers expected, found;

static void fill_lines(const struct scene_shapes *of)
{
    for (size_t i = 0; i < MOST; i++) {
        cylint_line line;
        memset(&line, 0, sizeof line);
        /* wild lines test every shape: few of them */
        const size_t kinds = i < 1000 ? LINES_KINDS : LINES_WILD;
        scene_line(of, (enum scene_lines)(i % kinds), 1, i, &line);
        const double of_line[8] = {line.o[0], line.o[1], line.o[2], line.d[0],
                                   line.d[1], line.d[2], line.tmin, line.tmax};
        for (int k = 0; k < 8; k++)
            input[k][i] = of_line[k];
        switch (i % 100) {
        case 1:
            input[i / 100 % 8][i] = NAN;
            break;
        case 2:
            input[i / 100 % 6][i] = HUGE_VAL;
            break;
        case 3:
            input[3][i] = input[4][i] = input[5][i] = 0;
            break;
        case 4:
            input[6][i] = 2;
            input[7][i] = 1;
            break;
        default:
            break;
        }
    }
    lines = (cylint_lines){.o = {input[0], input[1], input[2]},
                           .d = {input[3], input[4], input[5]},
                           .tmin = input[6],
                           .tmax = input[7]};
}

/* Points in the box and around it, and some that are invalid. */
static void fill_points(const struct scene_shapes *of)
{
    uint64_t random = 2;
    for (size_t i = 0; i < MOST; i++) {
        for (int j = 0; j < 3; j++)
            input[j][i] = of->lo[j] + (of->hi[j] - of->lo[j]) *
                                          (2 * random_unit(&random) - 0.5);
        radii[i] = i % 10 == 0 ? HUGE_VAL : 3 * random_unit(&random) - 0.1;
        if (i % 100 == 1)
            radii[i] = NAN;
        if (i % 100 == 2)
            input[i / 100 % 3][i] = i % 200 == 2 ? (double)NAN : HUGE_VAL;
    }
    points = (cylint_points){.xyz = {input[0], input[1], input[2]}};
}

static void make_line(size_t i, cylint_line *line)
{
    const double o[3] = {lines.o[0][i], lines.o[1][i], lines.o[2][i]};
    const double d[3] = {lines.d[0][i], lines.d[1][i], lines.d[2][i]};
    cylint_span(line, o, d, lines.tmin ? lines.tmin[i] : 0,
                lines.tmax ? lines.tmax[i] : HUGE_VAL);
}

/* Whether the first n elements are those that are expected, and the next one was not
 * written.  numbers: of `value`. */
static int are_as_expected(size_t n, int numbers)
{
    int same =
        memcmp(found.number, expected.number, n * sizeof *found.number) == 0 &&
        found.number[n] == 77;
    for (int k = 0; k < 2; k++)
        same = same && memcmp(found.small[k], expected.small[k], n) == 0 &&
               found.small[k][n] == 77;
    for (int k = 0; k < numbers; k++)
        same = same &&
               memcmp(found.value[k], expected.value[k],
                      n * sizeof **found.value) == 0 &&
               fabs(found.value[k][n] - 77) <= 0;
    return same;
}

static void poison(void)
{
    for (size_t i = 0; i <= MOST; i++) {
        found.number[i] = 77;
        found.small[0][i] = found.small[1][i] = 77;
        for (int k = 0; k < HIT_NUMBERS; k++)
            found.value[k][i] = 77;
    }
}

/* ------------------------------------------------------------ nearest --- */

static const cylint_hit_columns all_hits = {
    .t = found.value[0],
    .part = found.small[0],
    .side = found.small[1],
    .point = {found.value[1], found.value[2], found.value[3]},
    .normal = {found.value[4], found.value[5], found.value[6]},
    .z = found.value[7],
    .phi = found.value[8]};

static void expect_hit(size_t i, size_t number, const cylint_hit *hit)
{
    const double value[HIT_NUMBERS] = {
        hit->t,         hit->point[0],  hit->point[1],
        hit->point[2],  hit->normal[0], hit->normal[1],
        hit->normal[2], hit->z,         hit->phi};
    expected.number[i] = number;
    expected.small[0][i] = (signed char)(number < SHAPES ? hit->part : -1);
    expected.small[1][i] = (signed char)(number < SHAPES ? hit->side : -1);
    for (int k = 0; k < HIT_NUMBERS; k++)
        expected.value[k][i] = number < SHAPES ? value[k] : (double)NAN;
}

/* Returns how many lines hit a shape. */
static int expect_hits(const cylint_scene *scene, const size_t *without)
{
    int hits = 0;
    for (size_t i = 0; i < MOST; i++) {
        cylint_line line;
        cylint_hit hit;
        memset(&hit, 0, sizeof hit);
        make_line(i, &line);
        const size_t number =
            without ? cylint_scene_nearest_other(scene, &line, without[i],
                                                 CYLINT_WANT_ALL, &hit)
                    : cylint_scene_nearest(scene, &line, CYLINT_WANT_ALL, &hit);
        expect_hit(i, number, &hit);
        hits += number < SHAPES;
    }
    return hits;
}

static void check_nearest(const cylint_scene *scene, const size_t *without)
{
    const int hits = expect_hits(scene, without);
    CHECK(hits > MOST / 10 && hits < MOST);
    for (int k = 0; k < THREADS * SIZES; k++) {
        lines.n = sizes[k % SIZES];
        poison();
        cylint_scene_nearest_lines(scene, &lines, without, threads[k / SIZES],
                                   found.number, &all_hits);
        if (!CHECK(are_as_expected(lines.n, HIT_NUMBERS)))
            REPORT("%zu lines, %d threads", lines.n, threads[k / SIZES]);
    }
}

/* The columns that are wanted: bits of `mask`, one for each array, and one for the
 * numbers.  Other arrays are not written. */
static void check_wanted_hits(const cylint_scene *scene, unsigned mask)
{
    cylint_hit_columns some = {0};
    double **const value[HIT_NUMBERS] = {
        &some.t,         &some.point[0],  &some.point[1],
        &some.point[2],  &some.normal[0], &some.normal[1],
        &some.normal[2], &some.z,         &some.phi};
    signed char **const small[2] = {&some.part, &some.side};
    for (int k = 0; k < HIT_NUMBERS; k++)
        if (mask >> k & 1)
            *value[k] = found.value[k];
    for (int k = 0; k < 2; k++)
        if (mask >> (HIT_NUMBERS + k) & 1)
            *small[k] = found.small[k];
    const int numbered = (int)(mask >> (HIT_NUMBERS + 2) & 1);
    poison();
    cylint_scene_nearest_lines(scene, &lines, NULL, 1,
                               numbered ? found.number : NULL, &some);
    for (size_t i = 0; i < lines.n; i++) {
        int wrong = found.number[i] != (numbered ? expected.number[i] : 77);
        for (int k = 0; k < HIT_NUMBERS; k++) {
            const double other = 77;
            wrong |= memcmp(&found.value[k][i],
                            mask >> k & 1 ? &expected.value[k][i] : &other,
                            sizeof other) != 0;
        }
        for (int k = 0; k < 2; k++)
            wrong |=
                found.small[k][i] !=
                (mask >> (HIT_NUMBERS + k) & 1 ? expected.small[k][i] : 77);
        if (!CHECK(!wrong))
            REPORT("columns %x, line %zu", mask, i);
    }
}

static void nearest_hits_are_those_of_single_lines(void)
{
    static const int kinds[] = {SCENE_MIXED, SCENE_UNBOUNDED, SCENE_STRANDS};
    for (int k = 0; k < 3; k++) {
        struct scene_shapes of;
        scene_generate(kinds[k], SHAPES, 3, &of);
        cylint_scene *scene = cylint_scene_new(of.shapes, of.n, 1, NULL);
        fill_lines(&of);
        check_nearest(scene, NULL);
        for (size_t i = 0; i < MOST; i++) /* as a ray that leaves it */
            except[i] = i % 7 == 0 ? SIZE_MAX : expected.number[i];
        check_nearest(scene, except);
        cylint_scene_free(scene);
        scene_release(&of);
    }
}

static void only_wanted_columns_are_written(void)
{
    struct scene_shapes of;
    const unsigned all = (1u << (HIT_NUMBERS + 3)) - 1;
    scene_generate(SCENE_MIXED, SHAPES, 4, &of);
    cylint_scene *scene = cylint_scene_new(of.shapes, of.n, 1, NULL);
    fill_lines(&of);
    expect_hits(scene, NULL);
    lines.n = 300;
    for (int k = 0; k < HIT_NUMBERS + 3; k++) {
        check_wanted_hits(scene, 1u << k);
        check_wanted_hits(scene, all & ~(1u << k));
    }
    check_wanted_hits(scene, 0);
    poison();
    cylint_scene_nearest_lines(scene, &lines, NULL, 1, found.number, NULL);
    CHECK(memcmp(found.number, expected.number,
                 lines.n * sizeof *found.number) == 0);
    cylint_scene_any_lines(scene, &lines, NULL, 2, NULL);
    cylint_scene_count_lines(scene, &lines, 0, 2, NULL);
    lines.tmin = lines.tmax = NULL;
    expect_hits(scene, NULL);
    check_wanted_hits(scene, all);
    cylint_scene_free(scene);
    scene_release(&of);
}

/* --------------------------------------------------------- any, count --- */

static void check_any(const cylint_scene *scene, const size_t *without)
{
    for (size_t i = 0; i < MOST; i++) {
        cylint_line line;
        make_line(i, &line);
        expected.small[0][i] = (signed char)cylint_scene_occluded(
            scene, &line, without ? without[i] : SHAPES);
    }
    for (int k = 0; k < THREADS * SIZES; k++) {
        lines.n = sizes[k % SIZES];
        memset(found.small, 77, sizeof found.small);
        cylint_scene_any_lines(scene, &lines, without, threads[k / SIZES],
                               found.small[0]);
        CHECK(memcmp(found.small[0], expected.small[0], lines.n) == 0);
        CHECK(found.small[0][lines.n] == 77);
    }
}

static void check_count(const cylint_scene *scene, size_t enough)
{
    for (size_t i = 0; i < MOST; i++) {
        cylint_line line;
        make_line(i, &line);
        expected.number[i] = cylint_scene_count(scene, &line, enough);
    }
    for (int k = 0; k < THREADS * SIZES; k++) {
        lines.n = sizes[k % SIZES];
        memset(found.number, 77, sizeof found.number);
        found.number[lines.n] = 77;
        cylint_scene_count_lines(scene, &lines, enough, threads[k / SIZES],
                                 found.number);
        CHECK(memcmp(found.number, expected.number,
                     lines.n * sizeof *found.number) == 0);
        CHECK(found.number[lines.n] == 77);
    }
}

static void any_and_count_are_those_of_single_lines(void)
{
    struct scene_shapes of;
    scene_generate(SCENE_UNBOUNDED, SHAPES, 5, &of);
    cylint_scene *scene = cylint_scene_new(of.shapes, of.n, 1, NULL);
    fill_lines(&of);
    expect_hits(scene, NULL);
    for (size_t i = 0; i < MOST; i++)
        except[i] = i % 7 == 0 ? SIZE_MAX : expected.number[i];
    check_any(scene, NULL);
    check_any(scene, except);
    check_count(scene, 0);
    check_count(scene, 3);
    cylint_scene_free(scene);
    scene_release(&of);
}

/* ------------------------------------------------------------ closest --- */

static void expect_closest(const cylint_scene *scene, const double *within)
{
    for (size_t i = 0; i < MOST; i++) {
        const double point[3] = {points.xyz[0][i], points.xyz[1][i],
                                 points.xyz[2][i]};
        cylint_closest near;
        memset(&near, 0, sizeof near);
        const size_t number =
            cylint_scene_closest(scene, point, within ? within[i] : HUGE_VAL,
                                 CYLINT_WANT_ALL, &near);
        const double value[CLOSEST_NUMBERS] = {
            near.distance,  near.point[0],  near.point[1], near.point[2],
            near.normal[0], near.normal[1], near.normal[2]};
        const int is = number < SHAPES;
        expected.number[i] = number;
        expected.small[0][i] = (signed char)(is ? near.part : -1);
        expected.small[1][i] = (signed char)(is ? near.feature : -1);
        for (int k = 0; k < CLOSEST_NUMBERS; k++)
            expected.value[k][i] = is ? value[k] : (double)NAN;
    }
}

static void check_closest(const cylint_scene *scene, const double *within)
{
    const cylint_closest_columns all = {
        .distance = found.value[0],
        .part = found.small[0],
        .feature = found.small[1],
        .point = {found.value[1], found.value[2], found.value[3]},
        .normal = {found.value[4], found.value[5], found.value[6]}};
    const cylint_closest_columns distance = {.distance = found.value[0]};
    expect_closest(scene, within);
    for (int k = 0; k < THREADS * SIZES; k++) {
        points.n = sizes[k % SIZES];
        poison();
        cylint_scene_closest_points(scene, &points, within, threads[k / SIZES],
                                    found.number, &all);
        CHECK(are_as_expected(points.n, CLOSEST_NUMBERS));
    }
    poison();
    cylint_scene_closest_points(scene, &points, within, 2, NULL, &distance);
    CHECK(memcmp(found.value[0], expected.value[0],
                 points.n * sizeof **found.value) == 0);
    CHECK(found.number[0] == 77 && found.small[0][0] == 77);
    cylint_scene_closest_points(scene, &points, within, 2, found.number, NULL);
    CHECK(memcmp(found.number, expected.number,
                 points.n * sizeof *found.number) == 0);
    cylint_scene_closest_points(scene, &points, within, 2, NULL, NULL);
}

static void closest_shapes_are_those_of_single_points(void)
{
    static const int kinds[] = {SCENE_ROUND, SCENE_UNBOUNDED};
    for (int k = 0; k < 2; k++) {
        struct scene_shapes of;
        scene_generate(kinds[k], SHAPES, 6, &of);
        cylint_scene *scene = cylint_scene_new(of.shapes, of.n, 1, NULL);
        fill_points(&of);
        check_closest(scene, radii);
        check_closest(scene, NULL);
        cylint_scene_free(scene);
        scene_release(&of);
    }
}

/* A scene without shapes. */
static void an_empty_scene_answers_none(void)
{
    cylint_scene *scene = cylint_scene_new(NULL, 0, 1, NULL);
    struct scene_shapes of;
    scene_generate(SCENE_THIN, SHAPES, 7, &of);
    fill_lines(&of);
    lines.n = MOST;
    poison();
    cylint_scene_nearest_lines(scene, &lines, NULL, 3, found.number, &all_hits);
    cylint_scene_any_lines(scene, &lines, except, 3, found.small[1]);
    for (size_t i = 0; i < MOST; i++)
        CHECK(found.number[i] == 0 && found.small[0][i] == -1 &&
              found.small[1][i] == 0 && isnan(found.value[8][i]));
    cylint_scene_free(scene);
    scene_release(&of);
}

int main(void)
{
    RUN(nearest_hits_are_those_of_single_lines);
    RUN(only_wanted_columns_are_written);
    RUN(any_and_count_are_those_of_single_lines);
    RUN(closest_shapes_are_those_of_single_points);
    RUN(an_empty_scene_answers_none);
    return check_end();
}
