/*
 * test_scene_closest.c - the shapes near a point, beside a loop over all shapes
 *
 *     test_scene_closest [POINTS]
 *
 * POINTS of each family a scene, 2 by default.
 */
#include <float.h>
#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "cylint_distance.h"
#include "cylint_scene.h"
#include "environment.h"
#include "random.h"
#include "scenes.h"
#include "shapes/shape_facts.h"

enum { SHAPES = 400, THREADS = 4 };

static size_t points_of_a_family = 2;
static size_t n_points, n_near;

/* ---------------------------------------------------------- brute force -- */

/* Absolute distances of all shapes; NaN if there is no surface. */
static void all_distances(const struct scene_shapes *of, const double point[3],
                          double *distance)
{
    for (size_t i = 0; i < of->n; i++) {
        cylint_closest a;
        a.part = 0;
        distance[i] = fabs(cylint_distance(&of->shapes[i], point, 0, &a));
        if (a.part < 0)
            distance[i] = NAN;
    }
}

static size_t nearest_of(const double *distance, size_t n, double radius)
{
    size_t nearest = n;
    for (size_t i = 0; i < n; i++)
        if (distance[i] <= radius &&
            (nearest == n || distance[i] < distance[nearest]))
            nearest = i;
    return nearest;
}

/* ----------------------------------------------------------- comparison -- */

struct question {
    const struct scene_shapes *of;
    const cylint_scene *scene;
    const double *point;
    double *distance; /* of all shapes */
    double *found;    /* places for cylint_scene_within() */
    size_t *numbers;
};

static void show(const struct question *q, double radius, const char *what)
{
    REPORT("point %a %a %a  # scene %s, radius %a: %s", q->point[0],
           q->point[1], q->point[2], q->of->name, radius, what);
}

static void check_closest(const struct question *q, double radius)
{
    const unsigned want = CYLINT_WANT_PART | CYLINT_WANT_POINT;
    const size_t n = q->of->n;
    const size_t nearest = nearest_of(q->distance, n, radius);
    cylint_closest a, b, c;
    memset(&a, 0x55, sizeof a);
    b = c = a;
    if (nearest < n)
        cylint_distance(&q->of->shapes[nearest], q->point, want, &a);
    const int same =
        cylint_scene_closest(q->scene, q->point, radius, want, &b) == nearest &&
        memcmp(&a, &b, sizeof a) == 0;
    if (!CHECK(same))
        show(q, radius, "the nearest shape of the scene");
    if (!CHECK(cylint_closest_shape(q->of->shapes, n, q->point, radius, want,
                                    &c) == nearest &&
               memcmp(&a, &c, sizeof a) == 0))
        show(q, radius, "the nearest shape of the array");
    n_near += nearest < n;
}

/* All shapes within the radius, `capacity` at a time. */
static size_t list_within(const struct question *q, double radius,
                          size_t capacity)
{
    size_t n = 0, found, first = 0;
    do {
        found = cylint_scene_within(q->scene, q->point, radius, first,
                                    q->numbers + n, q->found + n, capacity);
        n += found;
        first = found > 0 ? q->numbers[n - 1] + 1 : 0;
    } while (found == capacity);
    return n;
}

static void check_within(const struct question *q, double radius,
                         size_t capacity)
{
    size_t count = 0;
    int same = 1;
    const size_t n = list_within(q, radius, capacity);
    for (size_t i = 0; i < q->of->n; i++)
        if (q->distance[i] <= radius) {
            same =
                same && count < n && q->numbers[count] == i &&
                memcmp(&q->found[count], &q->distance[i], sizeof(double)) == 0;
            count++;
        }
    if (!CHECK(same && n == count))
        show(q, radius, "all within the radius");
    if (!CHECK(cylint_scene_within_count(q->scene, q->point, radius, 0) ==
               count))
        show(q, radius, "the count");
    if (!CHECK(cylint_scene_within_count(q->scene, q->point, radius, 3) ==
               (count < 3 ? count : 3)))
        show(q, radius, "the count up to 3");
}

/* Radii about the least distance and about those of a few other shapes, where a
 * step of the doubles decides. */
static void check_point(struct question *q, uint64_t *random)
{
    double radii[8] = {HUGE_VAL, 0};
    int n = 2;
    all_distances(q->of, q->point, q->distance);
    const size_t nearest = nearest_of(q->distance, q->of->n, HUGE_VAL);
    const size_t other = (size_t)random_below(random, q->of->n);
    if (nearest < q->of->n) {
        const double least = q->distance[nearest];
        radii[n++] = least;
        radii[n++] = nextafter(least, 0);
        radii[n++] = 3 * least;
    }
    if (q->distance[other] <= DBL_MAX) {
        radii[n++] = q->distance[other];
        radii[n++] = nextafter(q->distance[other], 0);
    }
    for (int i = 0; i < n; i++) {
        check_closest(q, radii[i]);
        check_within(q, radii[i], i % 2 ? 3 : q->of->n + 1);
    }
    n_points++;
}

/* --------------------------------------------------------------- points -- */

enum family { IN_BOX, ON_SHAPE, AT_CENTER, LATTICE, FAR, WILD, FAMILIES };

static double unit_of(const struct scene_shapes *of)
{
    double size = 0;
    for (int j = 0; j < 3; j++)
        size = fmax(size, of->hi[j] - of->lo[j]);
    return size;
}

/* On the surface of a shape but for roundings, or on its axis. */
static void point_on(const struct scene_shapes *of, uint64_t *random,
                     int on_axis, double point[3])
{
    const cylint_shape *s = &of->shapes[random_below(random, of->n)];
    const double z =
        on_axis ? 0.5 * (double)random_below(random, 3) : random_unit(random);
    cylint_closest a;
    for (int j = 0; j < 3; j++)
        point[j] = cylint_base(s)[j] + z * cylint_axis(s)[j];
    if (on_axis)
        return;
    a.part = 0;
    for (int j = 0; j < 3; j++)
        point[j] += cylint_axis_size(s) * (random_unit(random) - 0.5);
    cylint_distance(s, point, CYLINT_WANT_POINT, &a);
    if (a.part >= 0)
        memcpy(point, a.point, sizeof a.point);
}

static double wild_number(uint64_t *random)
{
    static const double numbers[] = {0,        -0.0,    5e-324, DBL_MIN,
                                     DBL_MAX,  1e300,   -1e200, 1e-200,
                                     HUGE_VAL, -1e-310, NAN,    0x1p60};
    return numbers[random_below(random, sizeof numbers / sizeof *numbers)];
}

static void point_of(const struct scene_shapes *of, enum family family,
                     uint64_t *random, double point[3])
{
    if (family == ON_SHAPE || family == AT_CENTER) {
        point_on(of, random, family == AT_CENTER, point);
        return;
    }
    const double far = pow(10, 3 + 17 * random_unit(random));
    for (int j = 0; j < 3; j++) {
        const double side = of->hi[j] - of->lo[j];
        const double in = of->lo[j] + side * random_unit(random);
        point[j] = family == LATTICE ? floor(2 * in) / 2
                   : family == FAR
                       ? in + unit_of(of) * far * (random_unit(random) - 0.5)
                   : family == WILD ? wild_number(random)
                                    : in;
    }
}

/* ---------------------------------------------------------------- tests -- */

static void *allocate(size_t n, size_t size)
{
    void *memory = malloc(n * size);
    if (!memory)
        abort();
    return memory;
}

static void check_scene(const struct scene_shapes *of, uint64_t seed)
{
    double point[3];
    struct question q = {.of = of,
                         .scene = cylint_scene_new(of->shapes, of->n, 1, NULL),
                         .point = point,
                         .distance = allocate(of->n, sizeof(double)),
                         .found = allocate(of->n + 8, sizeof(double)),
                         .numbers = allocate(of->n + 8, sizeof(size_t))};
    uint64_t random = seed;
    if (CHECK(q.scene))
        for (int family = 0; family < FAMILIES; family++)
            for (size_t i = 0; i < points_of_a_family; i++) {
                point_of(of, (enum family)family, &random, point);
                check_point(&q, &random);
            }
    cylint_scene_free((cylint_scene *)(uintptr_t)q.scene);
    free(q.distance);
    free(q.found);
    free(q.numbers);
}

static uint64_t seed(void)
{
    return check_setting("CYLINT_SEED", 1);
}

static void scenes_answer_as_a_loop_over_all_shapes(void)
{
    for (int kind = 0; kind < SCENE_KINDS; kind++) {
        struct scene_shapes of;
        scene_generate(kind, SHAPES, seed(), &of);
        check_scene(&of, seed() + (uint64_t)kind);
        scene_release(&of);
    }
}

static void small_scenes_answer_as_a_loop_over_all_shapes(void)
{
    static const size_t sizes[] = {1, 2, 7, 8, 9, 65};
    static const int kinds[] = {SCENE_LATTICE, SCENE_ROUND, SCENE_UNBOUNDED};
    const size_t points = points_of_a_family;
    points_of_a_family = points / 10 + 1;
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++)
        for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
            struct scene_shapes of;
            scene_generate(kinds[k], sizes[i], seed(), &of);
            check_scene(&of, seed() + 100 + i);
            scene_release(&of);
        }
    points_of_a_family = points;
}

static void nothing_is_near_an_empty_scene(void)
{
    const double point[3] = {1, 2, 3};
    cylint_closest a;
    cylint_scene *scene = cylint_scene_new(NULL, 0, 1, NULL);
    if (!CHECK(scene))
        return;
    CHECK(cylint_scene_closest(scene, point, HUGE_VAL, 0, &a) == 0);
    CHECK(cylint_scene_within_count(scene, point, HUGE_VAL, 0) == 0);
    cylint_scene_free(scene);
}

static void a_bad_point_or_radius_has_no_shape(void)
{
    struct scene_shapes of;
    scene_generate(SCENE_UNBOUNDED, 100, seed(), &of);
    cylint_scene *scene = cylint_scene_new(of.shapes, of.n, 1, NULL);
    const double good[3] = {0, 0, 0};
    const double radii[] = {NAN, -1, -5e-324, -HUGE_VAL};
    const double wrong[] = {NAN, HUGE_VAL, -HUGE_VAL};
    cylint_closest a;
    size_t number;
    double distance;
    if (!CHECK(scene))
        return;
    for (int i = 0; i < 9; i++) {
        double bad[3] = {0, 0, 0};
        bad[i % 3] = wrong[i / 3];
        CHECK(cylint_scene_closest(scene, bad, HUGE_VAL, 0, &a) == of.n);
        CHECK(cylint_scene_within_count(scene, bad, HUGE_VAL, 0) == 0);
        CHECK(cylint_scene_within(scene, bad, HUGE_VAL, 0, &number, &distance,
                                  1) == 0);
    }
    for (int i = 0; i < 4; i++) {
        CHECK(cylint_scene_closest(scene, good, radii[i], 0, &a) == of.n);
        CHECK(cylint_scene_within_count(scene, good, radii[i], 0) == 0);
    }
    CHECK(cylint_scene_within(scene, good, HUGE_VAL, 0, NULL, NULL, 0) == 0);
    CHECK(cylint_scene_within(scene, good, HUGE_VAL, 0, &number, NULL, 1) == 1);
    cylint_scene_free(scene);
    scene_release(&of);
}

/* Copies of one shape, long enough for several pieces, and a point as near to
 * two of its pieces. */
static void a_shape_of_many_pieces_counts_once(void)
{
    enum { COPIES = 300 };
    cylint_shape *shapes = allocate(COPIES, sizeof *shapes);
    size_t numbers[COPIES + 1];
    const double base[3] = {0, 0, 0}, top[3] = {80, 80, 80};
    const double points[][3] = {
        {40, 40, 41}, {0, 0, 1}, {-3, 0, 0}, {20, 20, 20}, {90, 0, 0}};
    for (int i = 0; i < COPIES; i++)
        CHECK(cylint_cylinder(&shapes[i], base, top, 0.25,
                              CYLINT_ENDS_CAPPED) == CYLINT_OK);
    cylint_scene *scene = cylint_scene_new(shapes, COPIES, 1, NULL);
    for (size_t i = 0; scene && i < sizeof points / sizeof *points; i++) {
        cylint_closest a;
        const double d = fabs(cylint_distance(shapes, points[i], 0, &a));
        CHECK(cylint_scene_closest(scene, points[i], d, 0, &a) == 0);
        CHECK(cylint_scene_within_count(scene, points[i], d, 0) == COPIES);
        CHECK(cylint_scene_within_count(scene, points[i], nextafter(d, 0), 0) ==
              0);
        CHECK(cylint_scene_within(scene, points[i], 2 * d, 0, numbers, NULL,
                                  COPIES + 1) == COPIES);
        CHECK(cylint_scene_within(scene, points[i], 2 * d, 290, numbers, NULL,
                                  4) == 4 &&
              numbers[0] == 290 && numbers[3] == 293);
    }
    cylint_scene_free(scene);
    free(shapes);
}

/* ---------------------------------------------------------- environment -- */

/* Bytes of the answers to one point. */
struct answers {
    size_t nearest, count, numbers[5];
    double distance, distances[5];
};

static void answer_point(const cylint_scene *scene, const double point[3],
                         double radius, struct answers *to)
{
    cylint_closest a = {.distance = 0};
    memset(to, 0, sizeof *to);
    to->nearest = cylint_scene_closest(scene, point, HUGE_VAL, 0, &a);
    to->distance = a.distance;
    to->count = cylint_scene_within_count(scene, point, radius, 0);
    cylint_scene_within(scene, point, radius, 0, to->numbers, to->distances, 5);
}

/* Of circular and round shapes, whose distances are correctly rounded. */
static void every_environment_has_the_same_answers(void)
{
    static const int kinds[] = {SCENE_THIN, SCENE_LATTICE, SCENE_ROUND};
    uint64_t random = seed() + 200;
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        struct scene_shapes of;
        scene_generate(kinds[k], 60, seed(), &of);
        cylint_scene *scene = cylint_scene_new(of.shapes, of.n, 1, NULL);
        for (int i = 0; scene && i < 3 * FAMILIES; i++) {
            struct answers want, got;
            double point[3];
            point_of(&of, (enum family)(i % FAMILIES), &random, point);
            answer_point(scene, point, 2, &want);
            for (int e = 1; e < ENVIRONMENTS; e++) {
                if (!can_treat_subnormals(e % 4))
                    continue;
                environment_set(environment_of(e));
                answer_point(scene, point, 2, &got);
                environment_reset();
                if (!CHECK(memcmp(&want, &got, sizeof want) == 0))
                    REPORT("point %a %a %a  # scene %s, environment %d",
                           point[0], point[1], point[2], of.name, e);
            }
        }
        cylint_scene_free(scene);
        scene_release(&of);
    }
}

/* -------------------------------------------------------------- threads -- */

struct part {
    const struct scene_shapes *of;
    const cylint_scene *scene;
    uint64_t sum;
    pthread_t thread;
};

static void *answer_part(void *argument)
{
    struct part *p = argument;
    uint64_t random = 5;
    for (int i = 0; i < 300; i++) {
        double point[3], distance[8];
        size_t numbers[8];
        cylint_closest a = {0};
        uint64_t d;
        point_of(p->of, (enum family)(i % FAR), &random, point);
        p->sum = p->sum * 31 +
                 cylint_scene_closest(p->scene, point, HUGE_VAL, 0, &a);
        memcpy(&d, &a.distance, sizeof d);
        p->sum = p->sum * 31 + d;
        p->sum = p->sum * 31 + cylint_scene_within(p->scene, point,
                                                   2 * fabs(a.distance), 0,
                                                   numbers, distance, 8);
    }
    return NULL;
}

static void threads_share_a_scene_with_the_same_answers(void)
{
    struct part parts[THREADS];
    struct scene_shapes of;
    scene_generate(SCENE_THIN, SHAPES, seed(), &of);
    cylint_scene *scene = cylint_scene_new(of.shapes, of.n, 2, NULL);
    for (int i = 0; i < THREADS; i++) {
        parts[i] = (struct part){.of = &of, .scene = scene};
        if (pthread_create(&parts[i].thread, NULL, answer_part, &parts[i]))
            abort();
    }
    for (int i = 0; i < THREADS; i++)
        pthread_join(parts[i].thread, NULL);
    for (int i = 1; i < THREADS; i++)
        CHECK(parts[i].sum == parts[0].sum);
    cylint_scene_free(scene);
    scene_release(&of);
}

/* The case of cylint_scene(3), section Overlapping shapes. */
static void the_nearest_surface_may_lie_inside_another_shape(void)
{
    const double center[3] = {0, 0, 0}, end[3] = {30, 0, 0}, p[3] = {0, 3, 0};
    cylint_shape shapes[2];
    cylint_closest near;
    CHECK(!cylint_sphere(&shapes[0], center, 10, CYLINT_ENDS_CAPPED) &&
          !cylint_capsule(&shapes[1], center, end, 1, CYLINT_ENDS_CAPPED));
    cylint_scene *scene = cylint_scene_new(shapes, 2, 1, NULL);
    if (!CHECK(scene))
        return;
    CHECK(cylint_scene_closest(scene, p, HUGE_VAL, 0, &near) == 1 &&
          near.distance == 2);
    CHECK(cylint_contains(&shapes[0], p) == 1 &&
          cylint_distance(&shapes[0], p, 0, &near) == -7);
    cylint_scene_free(scene);
}

int main(int argc, char **argv)
{
    if (argc > 1)
        points_of_a_family = strtoull(argv[1], NULL, 10);
    RUN(scenes_answer_as_a_loop_over_all_shapes);
    RUN(small_scenes_answer_as_a_loop_over_all_shapes);
    RUN(nothing_is_near_an_empty_scene);
    RUN(a_bad_point_or_radius_has_no_shape);
    RUN(a_shape_of_many_pieces_counts_once);
    RUN(every_environment_has_the_same_answers);
    RUN(threads_share_a_scene_with_the_same_answers);
    RUN(the_nearest_surface_may_lie_inside_another_shape);
    printf("note: %zu points, %zu questions with a nearest shape\n", n_points,
           n_near);
    return check_end();
}
