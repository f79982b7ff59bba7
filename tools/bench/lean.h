/*
 * lean.h - the leanest formula that a careful user writes for a prepared shape
 *
 * The shape keeps its base, unit axis, length and squared radius; a question
 * takes one reciprocal of the quadratic's A, one of the axial speed, and one
 * square root.  An elliptic cylinder keeps the inverse of its matrix.  The
 * result is hit or miss and two parameters in doubles, without parts, sides
 * or relation, and it is wrong where digits cancel.
 */
#ifndef BENCH_LEAN_H
#define BENCH_LEAN_H

#include "cylint.h"

struct lean_shape {
    double base[3], axis[3]; /* axis: unit; elliptic: rows of the inverse;
                                capsule, rcone: w = p1 - p0 */
    double row[2][3];        /* elliptic: the inverse's other two rows */
    double height;           /* of the slab; infinite where there is none; of a
                                hull the squared length of its axis w */
    double r0, r0_squared, slope; /* slope: of the radius along the unit axis */
};

/* The number of hits of origin + t direction with t0 <= t <= t1 (0 to 2), and
 * the overlap's two ends in t. */
typedef int lean_intersect(const struct lean_shape *shape,
                           const double origin[3], const double direction[3],
                           double t0, double t1, double t[2]);

lean_intersect lean_cylinder, lean_cone, lean_elliptic, lean_sphere, lean_hull;

/* The usual capped cylinder of shaders: the first t >= 0, or 0 hits. */
lean_intersect lean_shader;

/* Prepares a cylinder, cone or ecylinder, capped or infinite, or a sphere,
 * capsule or rcone. */
void lean_prepare(struct lean_shape *to, const cylint_shape *shape);

/* The formula for a prepared shape. */
lean_intersect *lean_formula(const cylint_shape *shape);

#endif
