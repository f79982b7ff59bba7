/*
 * quick.h - a hit in doubles, where doubles are certain of it
 *
 * For circular shapes with two ends, the great majority of questions: what
 * cylint_intersect() would say, as far as floats show it, or that it has to
 * be asked.
 */
#ifndef CYLINT_EMBREE_QUICK_H
#define CYLINT_EMBREE_QUICK_H

#include "cylint_embree.h"

/* A line with its domain, as yet unchecked; o and d hold floats.  near: some t
 * near the shape, if that is known; else it is not finite. */
typedef struct cylint_quick_line {
    double o[3], d[3], tmin, tmax;
    float near;
} cylint_quick_line;

/* t, within t_error, on a part of the surface; s: t from near the shape. */
typedef struct cylint_quick_hit {
    double t, t_error, s, s_error;
    int part;
} cylint_quick_hit;

/* A question, as quick.c has it, and the hits. */
typedef struct cylint_quick {
    double u[3], w[3], ww, r0, dr; /* direction, axis, radii */
    double from, D[3];             /* t = from + s, D + s u from the base */
    double alpha, beta;            /* D.w, u.w */
    double n[3], a;                /* u x w; of s^2 in Q(s) */
    double U, W, Dn, R, V;         /* sizes */
    cylint_quick_hit hit[2];
} cylint_quick;

/* The hits in the domain on parts that are present, t ascending; returns
 * their number, 0 to 2, or -1: ask cylint_intersect(). */
int cylint_quick_ask(cylint_quick *q, const cylint_shape *shape,
                     const cylint_quick_line *line);

/* z of a hit within *error. */
double cylint_quick_z(const cylint_quick *q, const cylint_quick_hit *hit,
                      double *error);

/* What floats show of a hit: z, phi, normal, rounded as the library's
 * doubles would be; 0 where that is not certain. */
typedef struct cylint_quick_floats {
    float z, phi, normal[3];
} cylint_quick_floats;

int cylint_quick_describe(const cylint_quick *q, const cylint_quick_hit *hit,
                          cylint_quick_floats *floats);

/* phi as a float below 1. */
float cylint_turn(double phi);

#endif
