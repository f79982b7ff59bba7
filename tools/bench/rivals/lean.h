/*
 * lean.h - the leanest formulas that a careful user writes for a prepared shape
 *
 * The shape keeps its base, unit axis, length, squared radius and slope.  A
 * line takes one reciprocal of the quadratic's A, one of the speed along the
 * axis, and one square root.  Results are doubles, without parts, sides or
 * relation.  They are wrong where digits cancel.
 */
#ifndef BENCH_LEAN_H
#define BENCH_LEAN_H

#include "inputs.h"

struct lean {
    double base[3];
    /* unit; elliptic: a row of the inverse; capsule, round cone: w = p1 - p0 */
    double axis[3];
    double row[2][3]; /* elliptic: the inverse's other rows */
    double height; /* infinite where there is none; capsule, round cone: w.w */
    double r0, r0_squared;
    double slope;   /* of the radius along the axis; round cone: r1 - r0 */
    double scale;   /* of a lateral normal */
    double outside; /* elliptic: |axis| */
};

/* The number of hits with t0 <= t <= t1, and both ends of the overlap. */
typedef int lean_line(const struct lean *solid, const double o[3],
                      const double d[3], double t0, double t1, double t[2]);

/* Whether there is a hit with t >= 0; the first t and its normal. */
typedef int lean_normal(const struct lean *solid, const double o[3],
                        const double d[3], double *t, double normal[3]);

void lean_prepare(struct lean *to, const cylint_shape *s);
extern const struct lean_formulas {
    lean_line *line;
    lean_normal *normal;
} lean_formulas[KINDS];

/* The signed distance of a point from a prepared solid that is not elliptic
 * [Quilez, iquilezles.org/articles/distfunctions]. */
struct lean_body {
    double base[3]; /* cylinder: the middle of the axis */
    double axis[3]; /* unit; capsule: w */
    double half, r0, r1;
    double sine, cosine; /* round cone: of the half angle */
    double inverse;      /* cone: 1 / (w.w + dr^2); capsule: 1 / w.w */
};
typedef double lean_distance(const struct lean_body *solid,
                             const double point[3]);

void lean_prepare_body(struct lean_body *to, const cylint_shape *s);
extern lean_distance *const lean_distances[KINDS]; /* elliptic: NULL */

#endif
