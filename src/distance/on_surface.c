/*
 * on_surface.c - whether points are on the surface, or some units in the last
 * place from it
 */
#include "../numbers/bits.h"
#include "../shapes/measure.h"
#include "lanes.h"

/* The exponent of the distance of |x| from the next larger double. */
static int exponent_of_last_place(double x)
{
    const int e = cylint_exponent(x) - 52;
    /* mutant '>' -> '>=': -1074 gives -1074, too */
    return e > -1074 ? e : -1074;
}

/* Whether x <= y 2^e, for positive finite x and y.  A subnormal product would
 * be rounded. */
static int is_at_most(double x, double y, int e)
{
    const int of_x = cylint_any_exponent(x), of_y = cylint_any_exponent(y);
    return of_x != of_y + e
               ? of_x < of_y + e
               : cylint_scaled(x, -of_x) <= cylint_scaled(y, -of_y);
}

/* Whether the distance of the point is at most `ulps` units. */
static int is_within_ulps(double distance, const double point[3], double ulps)
{
    const double size = fabs(distance);
    if (!(size <= DBL_MAX) || ulps != ulps || cylint_sign(ulps) < 0)
        return 0;
    if (cylint_sign(size) == 0 || ulps > DBL_MAX)
        return 1;
    return cylint_sign(ulps) != 0 &&
           is_at_most(size, ulps,
                      exponent_of_last_place(cylint_largest(point)));
}

int cylint_on_surface(const cylint_shape *shape, const double point[3],
                      double ulps)
{
    cylint_closest answer;
    /* mutant '0' -> '1': CYLINT_WANT_T has no effect here */
    const double distance = cylint_distance(shape, point, 0, &answer);
    return is_within_ulps(distance, point, ulps);
}

/* Answer i is that of point i and shape number each * i. */
static void write_on_surface(const cylint_shape *shapes, size_t each,
                             const cylint_points *points, double ulps,
                             signed char *on)
{
    double distance[CYLINT_POINT_BLOCK];
    const cylint_closest_columns to = {.distance = distance};
    for (size_t first = 0; first < points->n; first += CYLINT_POINT_BLOCK) {
        const size_t ahead = points->n - first;
        const cylint_points block = {
            ahead < CYLINT_POINT_BLOCK ? ahead : CYLINT_POINT_BLOCK,
            {points->xyz[0] + first, points->xyz[1] + first,
             points->xyz[2] + first}};
        if (each)
            cylint_distance_pairs(shapes + first, &block, &to);
        else
            cylint_distance_points(shapes, &block, &to);
        for (size_t i = 0; i < block.n; i++) {
            double point[3];
            cylint_read_point(&block, i, point);
            on[first + i] =
                (signed char)is_within_ulps(distance[i], point, ulps);
        }
    }
}

void cylint_on_surface_points(const cylint_shape *shape,
                              const cylint_points *points, double ulps,
                              signed char *on)
{
    write_on_surface(shape, 0, points, ulps, on);
}

void cylint_on_surface_pairs(const cylint_shape *shapes,
                             const cylint_points *points, double ulps,
                             signed char *on)
{
    write_on_surface(shapes, 1, points, ulps, on);
}
