/*
 * measure.h - the derived members of shapes and lines
 */
#ifndef CYLINT_MEASURE_H
#define CYLINT_MEASURE_H

#include "cylint.h"
#include "shape_facts.h"

/* center, bound_radius, size and in_range of a shape; size and in_range of a
 * line. */
void cylint_measure_shape(cylint_shape *shape);
void cylint_measure_line(cylint_line *line);

/* The axis has length 0: z and phi of all points are 0. */
int cylint_has_no_axis(const cylint_shape *s);

/* The ball about an end of a capsule or rcone, as a sphere. */
void cylint_ball_of(cylint_shape *ball, const cylint_shape *shape, int end);

/* The unit normal at a cone's apex is the axis's direction times this: away
 * from the solid; of a double cone against a line's direction, whose sign along
 * the axis is `along`, and for 0 towards the base or, where that is the apex
 * itself, against the axis. */
int cylint_apex_normal_sign(const cylint_shape *s, int along);

/* The double nearest to the tangent of an angle in (0, 90) degrees. */
double cylint_tangent(double degrees);

/* The binary exponent of the largest length of a shape. */
int cylint_length_exponent(const cylint_shape *s);

#endif
