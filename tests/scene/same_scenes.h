/*
 * same_scenes.h - compares the answers of two scenes, bit for bit
 */
#ifndef SAME_SCENES_H
#define SAME_SCENES_H

#include <math.h>
#include <string.h>

#include "cylint_scene.h"
#include "random.h"
#include "scenes.h"

/* Lines of each kind; points. */
enum { SAME_LINES = 4, SAME_POINTS = 20 };

static inline int same_doubles(const double *x, const double *y, size_t n)
{
    return memcmp(x, y, n * sizeof *x) == 0;
}

static inline int same_hit(const cylint_hit *x, const cylint_hit *y)
{
    return same_doubles(&x->t, &y->t, 1) &&
           same_doubles(x->point, y->point, 3) &&
           same_doubles(x->normal, y->normal, 3) && x->part == y->part &&
           x->side == y->side && same_doubles(&x->z, &y->z, 1) &&
           same_doubles(&x->phi, &y->phi, 1);
}

static inline int same_for_line(const cylint_scene *x, const cylint_scene *y,
                                const cylint_line *line)
{
    cylint_hit first, second;
    size_t numbers[2][16];
    memset(&first, 0, sizeof first);
    memset(&second, 0, sizeof second);
    const size_t number =
        cylint_scene_nearest(x, line, CYLINT_WANT_ALL, &first);
    const size_t n = cylint_scene_all(x, line, 0, numbers[0], 16);
    return cylint_scene_nearest(y, line, CYLINT_WANT_ALL, &second) == number &&
           same_hit(&first, &second) &&
           cylint_scene_count(x, line, 0) == cylint_scene_count(y, line, 0) &&
           cylint_scene_occluded(x, line, number) ==
               cylint_scene_occluded(y, line, number) &&
           cylint_scene_all(y, line, 0, numbers[1], 16) == n &&
           memcmp(numbers[0], numbers[1], n * sizeof *numbers[0]) == 0;
}

static inline int same_for_point(const cylint_scene *x, const cylint_scene *y,
                                 const double point[3], double radius)
{
    cylint_closest first, second;
    memset(&first, 0, sizeof first);
    memset(&second, 0, sizeof second);
    const unsigned want = CYLINT_WANT_POINT | CYLINT_WANT_NORMAL;
    const size_t number = cylint_scene_closest(x, point, radius, want, &first);
    return cylint_scene_closest(y, point, radius, want, &second) == number &&
           same_doubles(&first.distance, &second.distance, 1) &&
           same_doubles(first.point, second.point, 3) &&
           same_doubles(first.normal, second.normal, 3) &&
           cylint_scene_within_count(x, point, radius, 0, 0) ==
               cylint_scene_within_count(y, point, radius, 0, 0);
}

static inline int same_shapes(const cylint_scene *x, const cylint_scene *y)
{
    const size_t n = cylint_scene_size(x);
    int same = cylint_scene_size(y) == n;
    for (size_t i = 0; i < n && same; i++) {
        cylint_shape first, second;
        memset(&first, 0, sizeof first);
        memset(&second, 0, sizeof second);
        cylint_scene_shape(x, i, &first);
        cylint_scene_shape(y, i, &second);
        same = memcmp(&first, &second, sizeof first) == 0;
    }
    return same;
}

/* Returns the number of questions whose answers differ. */
static inline int differences(const cylint_scene *x, const cylint_scene *y,
                              const struct scene_shapes *of, uint64_t seed)
{
    uint64_t random = seed;
    int wrong = !same_shapes(x, y);
    for (int kind = 0; kind < LINES_KINDS; kind++)
        for (uint64_t i = 0; i < SAME_LINES; i++) {
            cylint_line line;
            scene_line(of, (enum scene_lines)kind, seed, i, &line);
            wrong += !same_for_line(x, y, &line);
        }
    for (int i = 0; i < SAME_POINTS; i++) {
        double point[3], size = 0;
        for (int j = 0; j < 3; j++) {
            point[j] = of->lo[j] + (of->hi[j] - of->lo[j]) *
                                       (1.5 * random_unit(&random) - 0.25);
            size = fmax(size, of->hi[j] - of->lo[j]);
        }
        wrong += !same_for_point(x, y, point, 0.2 * size);
    }
    return wrong;
}

#endif
