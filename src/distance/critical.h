/*
 * critical.h - the points of an ellipse at which a distance is stationary
 */
#ifndef CYLINT_CRITICAL_H
#define CYLINT_CRITICAL_H

#include "triple.h"

/*
 * A point of the ellipse is cos a + sin b.  Its distance from something is
 * stationary where
 *     linear[0] cos + linear[1] sin
 *         + square[0] cos^2 + square[1] cos sin + square[2] sin^2 = 0.
 */
typedef struct {
    triple linear[2], square[3];
    double terms; /* the sizes of all terms of these, where square[0] is
                     -square[2] */
} stationary;

/* cos and sin of an angle; the sum of their squares is 1 to the last place. */
typedef struct {
    triple cos, sin;
} direction;

enum { CYLINT_MOST_CRITICAL = 8 };

/* The integral of the form over the angle, where square[0] is -square[2]. */
triple cylint_integral_at(const stationary *form, const direction *at);

/* Writes the directions in which the form is 0, with the digits of triples: all
 * that are simple, some of them twice; 0 and half a turn if all coefficients are
 * 0.  Returns their number. */
int cylint_critical_directions(const stationary *form,
                               direction to[CYLINT_MOST_CRITICAL]);

/* The error of its angle, in units of the rounding of triples, at most 1.  It
 * is far below 1 only where cos or sin, and most terms, are nearly 0. */
double cylint_direction_error(const stationary *form, const direction *at);

#endif
