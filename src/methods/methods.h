/*
 * methods.h - what the published methods share
 *
 * A method's own work is to find where the line overlaps the unbounded
 * solid: its chord.  What its author left to the reader is here, so that
 * every method does it alike: clipping the chord by the planes of the ends
 * (chord.c), turning it into a cylint_answer (report.c) and telling a hit's
 * point, normal, z and phi (tell.c).
 *
 * Everything is plain double arithmetic, without tolerances and without
 * certificates: the methods are here to be measured.  They see a segment's
 * or axis's rounded difference only (d, axis), not its low part.
 */
#ifndef CYLINT_METHODS_INTERNAL_H
#define CYLINT_METHODS_INTERNAL_H

#include <math.h>

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
 * Where a line overlaps a solid: t[0] <= t <= t[1], either end infinite
 * where the overlap is unbounded.  If `gap` is set, the overlap is all but
 * the open interval between them: a line that changes from one nappe of a
 * double cone to the other.
 */
typedef struct cylint_chord {
    int relation; /* cylint_relation; CYLINT_RELATION_MISS: the rest is void */
    int gap;
    double t[2];
    int part[2]; /* cylint_part at t[0] and t[1] */
} cylint_chord;

static inline cylint_chord no_chord(void)
{
    const cylint_chord none = {CYLINT_RELATION_MISS, 0, {0, 0}, {0, 0}};
    return none;
}

static inline cylint_chord chord_between(int relation, double t0, double t1)
{
    const cylint_chord chord = {relation, 0, {t0, t1}, {0, 0}};
    return chord;
}

/* A line parallel to a cylinder's axis at a signed excess over the radius,
 * in any monotone measure: inside it overlaps without end. */
static inline cylint_chord parallel_chord(double excess)
{
    if (!(excess <= 0))
        return no_chord();
    return chord_between(excess < 0 ? CYLINT_RELATION_CROSS
                                    : CYLINT_RELATION_ALONG,
                         -INFINITY, INFINITY);
}

/* An affine function of the line's parameter: at + t slope. */
typedef struct cylint_affine {
    double at, slope;
} cylint_affine;

/* The axial coordinate along the line, from dot products. */
cylint_affine cylint_axial(const cylint_shape *shape, const cylint_line *line);

/* Cuts the chord down to where f >= 0; `part` lies at f = 0. */
void cylint_chord_clip(cylint_chord *chord, cylint_affine f, int part);

/* Cuts it down to 0 <= z <= 1 if the shape's ends bound it there. */
void cylint_chord_ends(cylint_chord *chord, const cylint_shape *shape,
                       cylint_affine z);

/* Of a double cone's chord, what lies on the nappe where rho >= 0. */
void cylint_chord_nappe(cylint_chord *chord, cylint_affine rho);

static inline int is_bounded(const cylint_shape *shape)
{
    return shape->ends != CYLINT_ENDS_INFINITE &&
           shape->ends != CYLINT_ENDS_NAPPE;
}

/* -------------------------------------------------------------- answer -- */

/* A miss that says the question was refused. */
void cylint_method_refuse(cylint_answer *answer);

/* The same for "this method does not answer for this shape". */
cylint_status cylint_method_not_for_this(cylint_answer *answer);

/* Writes the answer a chord amounts to: its ends that lie on a present part
 * and in the line's domain, as far as they are wanted. */
cylint_status cylint_method_report(const cylint_shape *shape,
                                   const cylint_line *line, unsigned want,
                                   const cylint_chord *chord,
                                   cylint_answer *answer);

/* Fills the wanted members of a hit. */
void cylint_method_hit(const cylint_shape *shape, const cylint_line *line,
                       unsigned want, double t, int part, int side,
                       cylint_hit *hit);

/* The direction perpendicular to a circular shape's axis from which phi is
 * counted: e x axis, e being the coordinate direction in which the axis has
 * its smallest component, the first such; not normalised. */
void cylint_phi_origin(const double axis[3], double out[3]);

#endif
