/*
 * many_safety.c - lower bounds of the distances of many points, one by one
 */
#include "../shapes/measure.h"
#include "cylint_distance.h"

/* Of point i and shape number each * i. */
static void write_safety(const cylint_shape *shapes, size_t each,
                         const cylint_points *points, double *safety)
{
    for (size_t i = 0; i < points->n; i++) {
        double point[3];
        cylint_read_point(points, i, point);
        safety[i] = cylint_safety(shapes + each * i, point);
    }
}

void cylint_safety_points(const cylint_shape *shape,
                          const cylint_points *points, double *safety)
{
    write_safety(shape, 0, points, safety);
}

void cylint_safety_pairs(const cylint_shape *shapes,
                         const cylint_points *points, double *safety)
{
    write_safety(shapes, 1, points, safety);
}
