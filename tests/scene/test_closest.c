/*
 * test_closest.c - the shapes near a point and those that hold it, beside a
 * loop over all shapes
 *
 *     test_closest [POINTS]
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
static size_t n_points, n_near, n_inside;

/* ---------------------------------------------------------- brute force -- */

/* Makes the closed solid by the shape's constructor. */
static void make_closed(const cylint_shape *s, cylint_shape *closed)
{
    const int reversed = cylint_is_reversed(s);
    const double *const begin = reversed ? cylint_top(s) : cylint_base(s);
    const double *const end = reversed ? cylint_base(s) : cylint_top(s);
    const double r0 = cylint_end_factor(s, reversed);
    const double r1 = cylint_end_factor(s, !reversed);
    *closed = *s;
    if (!cylint_is_bounded(s))
        return;
    switch (cylint_constructor_kind(s)) {
    case CYLINT_KIND_CONE:
        cylint_cone(closed, begin, r0, end, r1, CYLINT_ENDS_CAPPED);
        break;
    case CYLINT_KIND_ACONE:
        cylint_tangent_cone(closed, cylint_base(s), cylint_axis(s), r1,
                            CYLINT_ENDS_CAPPED);
        break;
    case CYLINT_KIND_ECONE:
        cylint_elliptic_cone(closed, cylint_base(s), cylint_a(s), cylint_b(s),
                             cylint_axis(s), r1, CYLINT_ENDS_CAPPED);
        break;
    case CYLINT_KIND_SPHERE:
        cylint_sphere(closed, cylint_base(s), r0, CYLINT_ENDS_CAPPED);
        break;
    default:
        cylint_round_cone(closed, begin, r0, end, r1, CYLINT_ENDS_CAPPED);
    }
}

/* Absolute distances of all shapes, or signed ones of closed solids; NaN if there
 * is no surface. */
static void all_distances(const cylint_shape *shapes, size_t n, unsigned want,
                          const double point[3], double *distance)
{
    for (size_t i = 0; i < n; i++) {
        cylint_closest a;
        a.part = 0;
        const double d = cylint_distance(&shapes[i], point, 0, &a);
        distance[i] = a.part < 0 ? NAN : want & CYLINT_SIGNED ? d : fabs(d);
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
    const cylint_shape *closed; /* the closed solids */
    const cylint_scene *scene;
    const double *point;
    unsigned want;    /* 0 or CYLINT_SIGNED */
    double *distance; /* of all shapes */
    double *found;    /* places for cylint_scene_within() */
    size_t *numbers;
};

static void show(const struct question *q, double radius, const char *what)
{
    REPORT("point %a %a %a  # scene %s, radius %a%s: %s", q->point[0],
           q->point[1], q->point[2], q->of->name, radius,
           q->want ? ", signed" : "", what);
}

/* The shapes, or their closed solids. */
static const cylint_shape *compared_shapes(const struct question *q)
{
    return q->want ? q->closed : q->of->shapes;
}

static void check_closest(const struct question *q, double radius)
{
    const unsigned members = CYLINT_WANT_PART | CYLINT_WANT_POINT;
    const unsigned want = members | q->want;
    const size_t n = q->of->n;
    const size_t nearest = nearest_of(q->distance, n, radius);
    cylint_closest a, b, c;
    memset(&a, 0x55, sizeof a);
    b = c = a;
    if (nearest < n)
        cylint_distance(&compared_shapes(q)[nearest], q->point, members, &a);
    const int same =
        cylint_scene_closest(q->scene, q->point, radius, want, &b) == nearest &&
        memcmp(&a, &b, sizeof a) == 0;
    if (!CHECK(same))
        show(q, radius, "the nearest shape of the scene");
    if (!CHECK(cylint_closest_shape(q->of->shapes, n, q->point, radius, want,
                                    &c) == nearest &&
               memcmp(&a, &c, sizeof a) == 0))
        show(q, radius, "the nearest shape of the array");
    if (nearest < n &&
        cylint_scene_closest(q->scene, q->point, radius, q->want, &c) ==
            nearest &&
        !CHECK(memcmp(&a.distance, &c.distance, sizeof a.distance) == 0 &&
               a.flags == c.flags))
        show(q, radius, "the distance without other members");
    n_near += nearest < n;
}

/* All shapes within the radius, `capacity` at a time. */
static size_t list_within(const struct question *q, double radius,
                          size_t capacity)
{
    size_t n = 0, found, first = 0;
    do {
        found = cylint_scene_within(q->scene, q->point, radius, q->want, first,
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
    if (!CHECK(cylint_scene_within_count(q->scene, q->point, radius, q->want,
                                         0) == count))
        show(q, radius, "the count");
    if (!CHECK(cylint_scene_within_count(q->scene, q->point, radius, q->want,
                                         3) == (count < 3 ? count : 3)))
        show(q, radius, "the count up to 3");
}

/* How many shapes hold the point, and that these are the shapes with distances of
 * at most 0.  The number of all distances is ready. */
static void check_contains(const struct question *q)
{
    size_t count = 0, wrong = 0;
    for (size_t i = 0; i < q->of->n; i++) {
        const int side = cylint_contains(&q->of->shapes[i], q->point);
        const double d = q->distance[i];
        count += side >= 0;
        wrong += side >= 0 ? !(d <= 0) || (side > 0) != (d < 0) : d <= 0;
    }
    for (size_t enough = 0; enough <= 4; enough++)
        if (!CHECK(cylint_scene_contains(q->scene, q->point, enough) ==
                   (enough > 0 && enough < count ? enough : count)))
            show(q, 0, "the number of solids that hold the point");
    if (!CHECK(wrong == 0))
        show(q, 0, "the signs of the distances");
    n_inside += count > 0;
}

/* Radii about the least distance and about those of a few other shapes, where a
 * step of the doubles decides. */
static void check_radii(struct question *q, uint64_t *random)
{
    double radii[8] = {HUGE_VAL, 0};
    int n = 2;
    all_distances(compared_shapes(q), q->of->n, q->want, q->point, q->distance);
    const size_t nearest = nearest_of(q->distance, q->of->n, HUGE_VAL);
    const size_t other = (size_t)random_below(random, q->of->n);
    if (nearest < q->of->n) {
        const double least = q->distance[nearest];
        radii[n++] = least;
        radii[n++] = nextafter(least, -HUGE_VAL);
        radii[n++] = 3 * least;
    }
    if (q->distance[other] <= DBL_MAX) {
        radii[n++] = q->distance[other];
        radii[n++] = nextafter(q->distance[other], -HUGE_VAL);
    }
    if (q->want)
        check_contains(q);
    for (int i = 0; i < n; i++) {
        check_closest(q, radii[i]);
        check_within(q, radii[i], i % 2 ? 3 : q->of->n + 1);
    }
}

static void check_point(struct question *q, uint64_t *random)
{
    q->want = 0;
    check_radii(q, random);
    q->want = CYLINT_SIGNED;
    check_radii(q, random);
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
    cylint_shape *closed = allocate(of->n, sizeof *closed);
    for (size_t i = 0; i < of->n; i++)
        make_closed(&of->shapes[i], &closed[i]);
    struct question q = {.of = of,
                         .closed = closed,
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
    free(closed);
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
    CHECK(cylint_scene_within_count(scene, point, HUGE_VAL, 0, 0) == 0);
    CHECK(cylint_scene_closest(scene, point, HUGE_VAL, CYLINT_SIGNED, &a) == 0);
    CHECK(cylint_scene_contains(scene, point, 0) == 0);
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
    for (int i = 0; i < 18; i++) {
        const unsigned want = i < 9 ? 0 : CYLINT_SIGNED;
        double bad[3] = {0, 0, 0};
        bad[i % 3] = wrong[i / 3 % 3];
        CHECK(cylint_scene_closest(scene, bad, HUGE_VAL, want, &a) == of.n);
        CHECK(cylint_scene_within_count(scene, bad, HUGE_VAL, want, 0) == 0);
        CHECK(cylint_scene_within(scene, bad, HUGE_VAL, want, 0, &number,
                                  &distance, 1) == 0);
        CHECK(cylint_scene_contains(scene, bad, 0) == 0);
    }
    for (int i = 0; i < 4; i++) {
        CHECK(cylint_scene_closest(scene, good, radii[i], 0, &a) == of.n);
        CHECK(cylint_scene_within_count(scene, good, radii[i], 0, 0) == 0);
    }
    CHECK(cylint_scene_closest(scene, good, NAN, CYLINT_SIGNED, &a) == of.n);
    CHECK(cylint_scene_within_count(scene, good, -NAN, CYLINT_SIGNED, 0) == 0);
    CHECK(cylint_scene_closest(scene, good, -HUGE_VAL, CYLINT_SIGNED, &a) ==
          of.n);
    CHECK(cylint_scene_within(scene, good, HUGE_VAL, 0, 0, NULL, NULL, 0) == 0);
    CHECK(cylint_scene_within(scene, good, HUGE_VAL, 0, 0, &number, NULL, 1) ==
          1);
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
        CHECK(cylint_scene_within_count(scene, points[i], d, 0, 0) == COPIES);
        CHECK(cylint_scene_within_count(scene, points[i], nextafter(d, 0), 0,
                                        0) == 0);
        CHECK(cylint_scene_within(scene, points[i], 2 * d, 0, 0, numbers, NULL,
                                  COPIES + 1) == COPIES);
        CHECK(cylint_scene_within(scene, points[i], 2 * d, 0, 290, numbers,
                                  NULL, 4) == 4 &&
              numbers[0] == 290 && numbers[3] == 293);
    }
    cylint_scene_free(scene);
    free(shapes);
}

/* ---------------------------------------------------------- environment -- */

/* Bytes of the answers to one point. */
struct answers {
    size_t nearest, count, numbers[5], deepest, inside, inside_count;
    double distance, distances[5], depth;
};

static void answer_point(const cylint_scene *scene, const double point[3],
                         double radius, struct answers *to)
{
    cylint_closest a = {.distance = 0};
    memset(to, 0, sizeof *to);
    to->nearest = cylint_scene_closest(scene, point, HUGE_VAL, 0, &a);
    to->distance = a.distance;
    to->count = cylint_scene_within_count(scene, point, radius, 0, 0);
    cylint_scene_within(scene, point, radius, 0, 0, to->numbers, to->distances,
                        5);
    to->deepest =
        cylint_scene_closest(scene, point, HUGE_VAL, CYLINT_SIGNED, &a);
    to->depth = a.distance;
    to->inside = cylint_scene_contains(scene, point, 0);
    to->inside_count =
        cylint_scene_within_count(scene, point, 0, CYLINT_SIGNED, 0);
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
                                                   2 * fabs(a.distance), 0, 0,
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

/* The case of cylint_scene(3), section Overlapping shapes, and its points on the
 * surface of the union. */
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
    CHECK(cylint_scene_closest(scene, p, HUGE_VAL, CYLINT_SIGNED, &near) == 0 &&
          near.distance == -7);
    CHECK(cylint_scene_contains(scene, p, 0) == 1);
    cylint_scene_free(scene);
}

/* Two sectors of one pipe, end to end, so that the cap between them lies inside
 * the union; and a nappe.  All numbers are small whole ones, so that points lie
 * exactly on caps, lateral surfaces and rims. */
static void the_boundary_belongs_to_the_solid(void)
{
    static const double begin[3] = {0, 0, 0}, middle[3] = {0, 0, 4},
                        end[3] = {0, 0, 8}, apex[3] = {20, 0, 0},
                        up[3] = {0, 0, 1};
    static const struct {
        double point[3];
        size_t holding, least;
        double distance;
    } cases[] = {
        {{0, 0, 4}, 2, 0, 0},      /* on the cap between them */
        {{5, 0, 2}, 1, 0, 0},      /* on the lateral surface */
        {{3, 4, 8}, 1, 1, 0},      /* on a rim */
        {{3, 4, 4}, 2, 0, 0},      /* on two rims */
        {{0, 0, 0}, 1, 0, 0},      /* on a cap that is missing */
        {{0, 0, 2}, 1, 0, -2},     /* as near to both caps */
        {{0, 4.5, 5}, 1, 1, -0.5}, /* near the lateral surface */
        {{0, 0, 9}, 0, 1, 1},      /* before a cap that is missing */
        {{0, 8, 12}, 0, 1, 5},     /* before its rim */
        {{20, 0, 0}, 1, 2, 0},     /* on the apex of the nappe */
        {{23, 0, 3}, 1, 2, 0},     /* on its lateral surface */
        {{20, 0, 0x1p900}, 1, 2, -0x1.6a09e667f3bcdp899}, /* far inside it */
        {{20, 0, -2}, 0, 2, 2}};
    for (int ends = CYLINT_ENDS_CAPPED; ends <= CYLINT_ENDS_CAP1; ends++) {
        cylint_shape shapes[3];
        CHECK(
            !cylint_cylinder(&shapes[0], begin, middle, 5, (cylint_ends)ends) &&
            !cylint_cylinder(&shapes[1], middle, end, 5, (cylint_ends)ends) &&
            !cylint_tangent_cone(&shapes[2], apex, up, 1, CYLINT_ENDS_NAPPE));
        cylint_scene *scene = cylint_scene_new(shapes, 3, 1, NULL);
        for (size_t i = 0; scene && i < sizeof cases / sizeof *cases; i++) {
            const double *p = cases[i].point;
            cylint_closest near;
            const size_t least =
                cylint_scene_closest(scene, p, HUGE_VAL, CYLINT_SIGNED, &near);
            if (!CHECK(cylint_scene_contains(scene, p, 0) == cases[i].holding &&
                       least == cases[i].least &&
                       fabs(near.distance - cases[i].distance) <= 0))
                REPORT("case %zu, ends %d: %zu, %g", i, ends, least,
                       near.distance);
        }
        cylint_scene_free(scene);
    }
}

/* Points inside a neuron's soma and branches, of tapered pieces whose inner ends
 * lie in each other: the nearest surface is often such an end. */
static void a_point_of_the_union_has_no_positive_signed_distance(void)
{
    enum { BRANCHES = 12, PIECES = 25, N = BRANCHES * PIECES };
    cylint_shape *shapes = allocate(N, sizeof *shapes);
    uint64_t random = seed() + 300;
    size_t n = 0, positive = 0, outside = 0, wrong = 0;
    for (int b = 0; b < BRANCHES; b++) {
        double from[3] = {0, 0, 0}, r = 4;
        for (int i = 0; i < PIECES; i++) {
            double to[3];
            for (int j = 0; j < 3; j++)
                to[j] = from[j] + (b >> j & 1 ? 1 : -1) * 3 *
                                      (random_unit(&random) - 0.2);
            CHECK(!cylint_cone(&shapes[n++], from, r, to, 0.9 * r,
                               i % 2 ? CYLINT_ENDS_OPEN : CYLINT_ENDS_CAPPED));
            memcpy(from, to, sizeof from);
            r *= 0.9;
        }
    }
    cylint_scene *scene = cylint_scene_new(shapes, n, 1, NULL);
    for (int i = 0; scene && i < 400; i++) {
        const cylint_shape *s = &shapes[random_below(&random, n)];
        const double z = random_unit(&random);
        cylint_closest surface, solid;
        double p[3];
        for (int j = 0; j < 3; j++)
            p[j] = cylint_base(s)[j] + z * cylint_axis(s)[j] +
                   0.4 * cylint_r1(s) * (random_unit(&random) - 0.5);
        cylint_scene_closest(scene, p, HUGE_VAL, 0, &surface);
        cylint_scene_closest(scene, p, HUGE_VAL, CYLINT_SIGNED, &solid);
        const size_t holding = cylint_scene_contains(scene, p, 0);
        positive += holding > 0 && surface.distance > 0;
        outside += holding == 0;
        wrong += (holding > 0) != (solid.distance <= 0);
    }
    CHECK(wrong == 0 && positive > 100 && outside < 100);
    cylint_scene_free(scene);
    free(shapes);
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
    RUN(the_boundary_belongs_to_the_solid);
    RUN(a_point_of_the_union_has_no_positive_signed_distance);
    printf("note: %zu points, %zu of them inside, %zu questions with a nearest "
           "shape\n",
           n_points, n_inside, n_near);
    return check_end();
}
