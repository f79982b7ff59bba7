/*
 * distance_scene.c - time of the shapes of a scene that are near a point
 *
 *     distance_scene [KIND [N...]]
 *
 * KIND is a number of tests/support/scenes.h (0: thin cylinders and cones), N
 * the numbers of shapes (1e3 1e4 1e5 1e6).  The points lie in the box of all shapes,
 * 16 sizes away from it, and on the surfaces of shapes.  A line of output has
 * shapes, points, nanoseconds a point for the nearest shape and for the count
 * within 1/2 (neighbours are about 1 apart), for a loop of cylint_distance(),
 * and the speed of the scene beside the loop.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "cylint_scene.h"
#include "random.h"
#include "scenes.h"
#include "timing.h"
#include "../../src/shapes/measure.h"

enum { POINTS = 4096, TURNS = 3, BRUTE_QUESTIONS = 1000000 };
enum family { IN_BOX, ON_SHAPES, OUTSIDE, FAMILIES };

static const char *const family_names[FAMILIES] = {"in the box", "on shapes",
                                                   "16 sizes away"};
static double points[POINTS][3];
static volatile double sink;

static double between(uint64_t *random, double low, double high)
{
    return low + (high - low) * random_unit(random);
}

static void make_point(const struct scene_shapes *of, enum family family,
                       uint64_t *random, double point[3])
{
    cylint_closest a = {.part = 0};
    const cylint_shape *shape = &of->shapes[random_below(random, of->n)];
    double center[3];
    const double radius = cylint_ball_about(shape, center);
    for (int j = 0; j < 3; j++) {
        const double lo = of->lo[j], hi = of->hi[j];
        point[j] = family == OUTSIDE ? between(random, lo - 16 * (hi - lo),
                                               hi + 16 * (hi - lo))
                                     : between(random, lo, hi);
        if (family == ON_SHAPES)
            point[j] = center[j] + between(random, -1, 1) * radius;
    }
    if (family == ON_SHAPES)
        cylint_distance(shape, point, CYLINT_WANT_POINT, &a);
    for (int j = 0; j < 3 && family == ON_SHAPES && a.part >= 0; j++)
        point[j] = a.point[j];
}

enum call { CLOSEST, WITHIN, BRUTE, CALLS };

static double answer(const struct scene_shapes *of, const cylint_scene *scene,
                     enum call call, const double point[3])
{
    cylint_closest a = {.distance = 0};
    if (call == WITHIN)
        return (double)cylint_scene_within_count(scene, point, 0.5, 0, 0);
    if (call == CLOSEST)
        cylint_scene_closest(scene, point, HUGE_VAL, 0, &a);
    else
        cylint_closest_shape(of->shapes, of->n, point, HUGE_VAL, 0, &a);
    return a.distance;
}

/* Nanoseconds a point, the least of several turns. */
static double time_of(const struct scene_shapes *of, const cylint_scene *scene,
                      enum call call)
{
    const int few = (int)(BRUTE_QUESTIONS / of->n) + 1;
    const int n = call == BRUTE && few < POINTS ? few : POINTS;
    double least = HUGE_VAL;
    for (int turn = 0; turn < (call == BRUTE ? 1 : TURNS); turn++) {
        double sum = 0;
        const struct timing start = timing_now();
        for (int i = 0; i < n; i++)
            sum += answer(of, scene, call, points[i]);
        least = fmin(least, timing_since(start).ns / n);
        sink = sum;
    }
    return least;
}

static int measure(int kind, size_t n)
{
    struct scene_shapes of;
    uint64_t random = 1;
    if (!scene_generate(kind, n, 1, &of))
        return 2;
    const struct timing start = timing_now();
    cylint_scene *scene = cylint_scene_new(of.shapes, of.n, 1, NULL);
    if (!scene)
        return 4;
    printf("%s: %zu shapes, built in %.3f s\n", of.name, of.n,
           1e-9 * timing_since(start).ns);
    for (int family = 0; family < FAMILIES; family++) {
        for (int i = 0; i < POINTS; i++)
            make_point(&of, (enum family)family, &random, points[i]);
        const double closest = time_of(&of, scene, CLOSEST);
        const double within = time_of(&of, scene, WITHIN);
        const double brute = time_of(&of, scene, BRUTE);
        printf("%-14s nearest %8.0f ns, %9.0f points/s; within 0.5 %8.0f ns; "
               "loop %12.0f ns; %8.0f times as fast\n",
               family_names[family], closest, 1e9 / closest, within, brute,
               brute / closest);
        fflush(stdout);
    }
    cylint_scene_free(scene);
    scene_release(&of);
    return 0;
}

int main(int argc, char **argv)
{
    const int kind = argc > 1 ? atoi(argv[1]) : SCENE_THIN;
    static const double sizes[] = {1e3, 1e4, 1e5, 1e6};
    int status = 0;
    timing_begin();
    for (int i = 2; i < argc && status == 0; i++)
        status = measure(kind, (size_t)strtod(argv[i], NULL));
    for (int i = 0; i < 4 && argc <= 2 && status == 0; i++)
        status = measure(kind, (size_t)sizes[i]);
    return status;
}
