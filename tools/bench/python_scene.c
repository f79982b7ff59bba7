/*
 * python_scene.c - the C library's time for the questions of python_rays.py and
 * python_distance.py
 *
 * usage: python_scene SHAPES RAYS ANSWERS
 *        python_scene -p SHAPES POINTS ANSWERS
 *
 * SHAPES has p0 p1 r of cylinders, RAYS o d, POINTS x y z, in doubles.  Writes
 * index and t of the nearest hit of each ray, -1 and NaN for none, or index and
 * distance of the cylinder nearest to each point.  The distances from one
 * cylinder are computed in a batch, those from several by a scene.  Prints
 * nanoseconds of processor time a ray or point, the least of several rounds.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "cylint_scene.h"

enum { ROUNDS = 3 };

static double *read_doubles(const char *name, size_t *count)
{
    FILE *file = fopen(name, "rb");
    if (!file || fseek(file, 0, SEEK_END) != 0) {
        perror(name);
        exit(1);
    }
    *count = (size_t)ftell(file) / sizeof(double);
    rewind(file);
    double *data = malloc(*count * sizeof *data);
    if (!data || fread(data, sizeof *data, *count, file) != *count) {
        fprintf(stderr, "%s: cannot be read\n", name);
        exit(1);
    }
    fclose(file);
    return data;
}

/* Distances of all points, whose coordinates are written to `columns` first. */
static void measure_batch(const cylint_shape *shape, const double *points,
                          size_t n, double *columns, double *answers)
{
    double *const distances = columns + 3 * n;
    for (size_t i = 0; i < n; i++)
        for (size_t axis = 0; axis < 3; axis++)
            columns[axis * n + i] = points[3 * i + axis];
    const cylint_points all = {n, {columns, columns + n, columns + 2 * n}};
    const cylint_closest_columns to = {.distance = distances};
    cylint_distance_points(shape, &all, &to);
    for (size_t i = 0; i < n; i++) {
        answers[2 * i] = 0;
        answers[2 * i + 1] = distances[i];
    }
}

static void measure(const cylint_scene *scene, const double *points, size_t n,
                    double *answers)
{
    for (size_t i = 0; i < n; i++) {
        cylint_closest closest;
        answers[2 * i] = (double)cylint_scene_closest(scene, points + 3 * i,
                                                      HUGE_VAL, 0, &closest);
        answers[2 * i + 1] = closest.distance;
    }
}

static void answer(const cylint_scene *scene, size_t shapes, const double *rays,
                   size_t n, double *answers)
{
    for (size_t i = 0; i < n; i++) {
        cylint_line line;
        cylint_hit hit;
        cylint_ray(&line, rays + 6 * i, rays + 6 * i + 3);
        const size_t found = cylint_scene_nearest(
            scene, &line, CYLINT_WANT_T | CYLINT_WANT_PART, &hit);
        answers[2 * i] = found < shapes ? (double)found : -1;
        answers[2 * i + 1] = found < shapes ? hit.t : (double)NAN;
    }
}

int main(int count, char **argument)
{
    size_t shapes, rays;
    const int points = count == 5 && strcmp(argument[1], "-p") == 0;
    if (!points && count != 4) {
        fputs("usage: python_scene [-p] SHAPES RAYS ANSWERS\n", stderr);
        return 2;
    }
    argument += points;
    const double *of_shapes = read_doubles(argument[1], &shapes);
    const double *of_rays = read_doubles(argument[2], &rays);
    shapes /= 7;
    rays /= points ? 3 : 6;
    cylint_shape *made = malloc(shapes * sizeof *made);
    double *answers = malloc(2 * rays * sizeof *answers);
    double *columns = malloc(4 * rays * sizeof *columns);
    if (!made || !answers || !columns) {
        return 1;
    }
    for (size_t i = 0; i < shapes; i++) {
        const double *x = of_shapes + 7 * i;
        cylint_cylinder(&made[i], x, x + 3, x[6], CYLINT_ENDS_CAPPED);
    }
    cylint_scene *scene = cylint_scene_new(made, shapes, 0, NULL);
    double least = HUGE_VAL;
    for (int round = 0; scene && round < ROUNDS; round++) {
        const clock_t start = clock();
        if (points && shapes == 1)
            measure_batch(made, of_rays, rays, columns, answers);
        else if (points)
            measure(scene, of_rays, rays, answers);
        else
            answer(scene, shapes, of_rays, rays, answers);
        const double spent = (double)(clock() - start) / CLOCKS_PER_SEC;
        least = spent < least ? spent : least;
    }
    FILE *file = fopen(argument[3], "wb");
    if (!scene || !file ||
        fwrite(answers, 2 * sizeof *answers, rays, file) != rays ||
        fclose(file) != 0) {
        return 1;
    }
    printf("%.1f\n", 1e9 * least / (double)rays);
    return 0;
}
