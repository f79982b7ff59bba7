/*
 * measure.h - sizes, balls and directions of shapes and lines; a point of an array
 */
#ifndef CYLINT_MEASURE_H
#define CYLINT_MEASURE_H

#include "../numbers/bits.h"
#include "cylint.h"
#include "shape_facts.h"

/* Whether doubles neither over- nor underflow in the forms of a shape. */
int cylint_is_in_window(const cylint_shape *shape);

/* Writes size and in_range. */
void cylint_measure_line(cylint_line *line);

/* Writes the centre of a ball that holds the solid, and returns its radius:
 * infinite, if there is none.  The shape is in range: of others squares underflow
 * or overflow. */
double cylint_ball_about(const cylint_shape *shape, double center[3]);

/* The axis has length 0: z and phi of all points are 0. */
static inline int cylint_has_no_axis(const cylint_shape *s)
{
    return cylint_is_zero(cylint_axis(s));
}

/* The ball about an end of a capsule or rcone, as a sphere. */
void cylint_ball_of(cylint_shape *ball, const cylint_shape *shape, int end);

/* The unit normal at a cone's apex is the axis's direction times this.  It points
 * away from the solid.  Of a double cone it points against the line's direction;
 * `along` is the sign of that direction along the axis.  If that is 0, the normal
 * points towards the base, or against the axis if the base is the apex. */
int cylint_apex_normal_sign(const cylint_shape *s, int along);

/* The double nearest to the tangent of an angle in (0, 90) degrees. */
double cylint_tangent(double degrees);

/* The first coordinate along which the axis of a shape has its smallest
 * component. */
int cylint_least_axis_component(const cylint_shape *s);

/* Point i.  All coordinates are read before one is written: then compilers write x
 * and y together, as kernels read them, which else wait 12 ns for them. */
static inline void cylint_read_point(const cylint_points *from, size_t i,
                                     double point[3])
{
    const double x = from->xyz[0][i], y = from->xyz[1][i], z = from->xyz[2][i];
    point[0] = x;
    point[1] = y;
    point[2] = z;
}

#endif
