/*
 * methods.h - what the published methods share
 *
 * A method computes the chord: the interval in which the line overlaps the
 * unbounded solid.  The steps that the authors leave to the reader are
 * shared, so that every method does them alike (answer.c): clipping the chord by
 * the planes of the ends, writing it as a cylint_answer, and computing a hit's
 * point, normal, z and phi.
 *
 * All arithmetic is in plain doubles, without tolerances and without error
 * bounds, because the methods are here to be measured.  They read only the
 * rounded differences d and axis of a segment and of an axis between two
 * points, not the low parts.
 */
#ifndef CYLINT_METHODS_INTERNAL_H
#define CYLINT_METHODS_INTERNAL_H

#include <math.h>
#include <string.h>

#include "../shapes/shape_facts.h"
#include "cylint_methods.h"

/* ------------------------------------------------------------- vectors -- */

static inline double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void cross(const double a[3], const double b[3], double out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

static inline void minus(const double a[3], const double b[3], double out[3])
{
    out[0] = a[0] - b[0];
    out[1] = a[1] - b[1];
    out[2] = a[2] - b[2];
}

/* out = a + t b */
static inline void along(const double a[3], double t, const double b[3],
                         double out[3])
{
    out[0] = a[0] + t * b[0];
    out[1] = a[1] + t * b[1];
    out[2] = a[2] + t * b[2];
}

static inline double length(const double a[3])
{
    return sqrt(dot(a, a));
}

/* out = a / |a|; returns |a| */
static inline double unit(const double a[3], double out[3])
{
    const double size = length(a);

    out[0] = a[0] / size;
    out[1] = a[1] / size;
    out[2] = a[2] / size;
    return size;
}

/* --------------------------------------------------------------- chord -- */

/*
 * The overlap of a line and a solid: t[0] <= t <= t[1].  An end is infinite
 * if the overlap has no end there.  If `gap` is set, the overlap is the
 * complement, t <= t[0] and t >= t[1]: the line crosses both nappes of a
 * double cone.
 */
typedef struct cylint_method_chord {
    int relation; /* cylint_relation; of a miss no other member is set */
    int gap;
    double t[2];
    int part[2]; /* cylint_part at t[0] and t[1] */
} cylint_method_chord;

static inline cylint_method_chord no_chord(void)
{
    return (cylint_method_chord){.relation = CYLINT_RELATION_MISS};
}

static inline cylint_method_chord chord_between(int relation, double t0,
                                                double t1)
{
    return (cylint_method_chord){relation, 0, {t0, t1}, {0, 0}};
}

static inline cylint_method_chord chord_with_gap(double t0, double t1)
{
    cylint_method_chord chord = chord_between(CYLINT_RELATION_CROSS, t0, t1);
    chord.gap = 1;
    return chord;
}

/* The chord A t^2 + B t + C <= 0, A not 0. */
static inline cylint_method_chord quadratic_chord(double A, double B, double C)
{
    const double disc = B * B - 4 * A * C;
    if (!(disc >= 0))
        return no_chord();

    const double s = sqrt(disc);
    const double t0 = (-B - s) / (2 * A), t1 = (-B + s) / (2 * A);
    if (A > 0)
        return chord_between(
            disc > 0 ? CYLINT_RELATION_CROSS : CYLINT_RELATION_TOUCH, t0, t1);
    /* steeper than the rulings: outside only between the nappes */
    return chord_with_gap(t1, t0);
}

/* The chord of a line parallel to a cylinder's axis.  `excess` has the sign
 * of the line's distance from the axis minus the radius. */
static inline cylint_method_chord parallel_chord(double excess)
{
    if (!(excess <= 0))
        return no_chord();
    return chord_between(excess < 0 ? CYLINT_RELATION_CROSS
                                    : CYLINT_RELATION_ALONG,
                         -INFINITY, INFINITY);
}

/* The same for two parallel lines of direction d.  D is a vector from a point of
 * one to a point of the other. */
static inline cylint_method_chord parallel_lines(const double D[3],
                                                 const double d[3], double r)
{
    double apart[3];

    along(D, -dot(D, d) / dot(d, d), d, apart);
    return parallel_chord(length(apart) - r);
}

/* An affine function of the line's parameter t: at + t slope. */
typedef struct cylint_affine {
    double at, slope;
} cylint_affine;

/* Clips the chord to f >= 0.  `part` is the part on the plane f = 0. */
void cylint_chord_clip(cylint_method_chord *chord, cylint_affine f, int part);

/* Clips the chord to 0 <= z <= 1 if the shape's ends bound it. */
void cylint_chord_ends(cylint_method_chord *chord, const cylint_shape *shape,
                       cylint_affine z);

/* -------------------------------------------------------------- answer -- */

/* Writes a miss with CYLINT_FLAG_INVALID and returns CYLINT_EMETHOD: the method
 * does not support this shape or these ends. */
cylint_status cylint_method_not_applicable(cylint_answer *answer);

/* Writes the chord as an answer.  Its hits are the ends of the chord that lie
 * on a present part and in the line's domain.  Of an invalid line the answer
 * is a miss with CYLINT_FLAG_INVALID. */
cylint_status cylint_method_report(const cylint_shape *shape,
                                   const cylint_line *line, unsigned want,
                                   const cylint_method_chord *chord,
                                   cylint_answer *answer);

/* The rows of the inverse of [a b h], so that a point c + x a + y b + z h has
 * (x, y, z) = rows (point - c).  h is the axis.  The semi-axes a and b of a
 * circular shape have the length `radius` and are perpendicular to it; a is along
 * e x axis, where e is the coordinate direction in which the axis has its smallest
 * component, the first of equal ones. */
void cylint_method_rows(const cylint_shape *shape, double radius,
                        double row[3][3]);

#endif
