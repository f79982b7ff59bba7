/*
 * exact_distance.h - the nearest feature, the distance and the nearest point
 * of circular and round kinds from exact numbers
 */
#ifndef CYLINT_EXACT_DISTANCE_H
#define CYLINT_EXACT_DISTANCE_H

#include "../roots/roots.h"
#include "nearest.h"

/* (a + b t) / d */
typedef struct {
    surd t;
    exact a, b, d;
} surd_quotient;

/* ------------------------------------------------------ the half plane -- */

/*
 * The point and the shape in the half plane through the axis and the point.
 * X is the point minus the base, w the axis, W = w.w, D_i the point minus the
 * centre of end i.  The point has the axial coordinate X.w / |w| and the radial
 * coordinate sqrt(q / W), q = |X x w|^2.
 *
 * All kinds with an axis have these expressions with the T, c, g of the table,
 * and T = sqrt(g q):
 *
 *                     g            c
 *   cylinder, cone    W            r0 W + dr X.w
 *   acone             1            dr X.w
 *   capsule, rcone    W - dr^2     r0 W + dr X.w
 *
 *   distance from the line in which the half plane intersects the lateral
 *     surface, positive outside:       (T - c) / sqrt(W (g + dr^2))
 *   the point's foot on that line is before the lateral surface begins or after
 *     it ends:                         sign of foot_i,
 *     foot_i = g D_i.w + dr T - (r_i dr W unless the kind is round)
 *   the normal of the lateral surface:  g R / T - dr w,
 *     R = w x (X x w), |R|^2 = W q.
 *
 * The nappe of a double cone that does not contain the base has the opposite c and
 * dr.  On the axis T and R are 0.  There R / T is the limit from the side of the
 * direction phi = 0.
 */
typedef struct {
    const cylint_shape *shape;
    const double *point;
    cylint_query query; /* the terms and the arena */
    const cylint_terms_exact *L;
    cylint_arena *arena;
    /* Of all kinds but spheres. */
    exact X[3]; /* D_0 x w */
    exact q, g, c, dr, T2;
    surd T;
    exact height[2]; /* D_i.w */
} meridian;

void cylint_load_meridian(meridian *m, const cylint_shape *shape,
                          const double point[3]);

/* The feature of a valid shape that is not elliptic; CYLINT_NO_FEATURE where there
 * is no surface.  A rim of radius 0 is an apex: cylint_stated_feature(). */
int cylint_nearest_feature(meridian *m);

surd_quotient cylint_square_of_distance(meridian *m, int feature);

/* The double nearest to the absolute distance; the least above 0 for distances
 * that would round to 0.  The same in every floating-point environment. */
double cylint_rounded_distance(meridian *m, int feature);

/* Point and normal. */
void cylint_nearest_point(meridian *m, int feature, unsigned want,
                          cylint_closest *answer);

#endif
