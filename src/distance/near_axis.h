/*
 * near_axis.h - the direction from the axis to a point beside it, in triples
 *
 * Of two nearly equal vectors D and z w the difference has few digits.  That of w x
 * (D x w), D the point from an end and w the axis, has all that count.
 */
#ifndef CYLINT_NEAR_AXIS_H
#define CYLINT_NEAR_AXIS_H

#include "../shapes/measure.h"
#include "near_surface.h"

/* Whether D is 0, or D x w = X is, all products of which are exact: no factor other
 * than 0 is so small that one underflows. */
static int is_on_axis(const triple D[3], const triple w[3], const triple X[3])
{
    int is_end = 1, is_exact = 1;
    EACH(i, 3) {
        is_end &= cylint_sign(D[i].a) == 0;
        is_exact &=
            cylint_sign(D[i].b) == 0 && cylint_sign(w[i].b) == 0 &&
            cylint_sign(X[i].a) == 0 &&
            (cylint_sign(D[i].a) == 0 || fabs(D[i].a) >= CYLINT_DISTANCE_LEAST);
    }
    return is_end | is_exact;
}

/* The direction from the axis to a point beside it: that of w x (D x w), or on the
 * axis that of phi = 0, e x w (nearest_point.c).  m->across is a multiple of
 * it; m->inverse and m->rho_error are those of its length. */
ASIDE void find_direction(half_plane *m, const cylint_shape *s,
                          const double point[3])
{
    triple D[3], w[3], X[3], A[3];
    pair squares[3];
    const int top = cylint_has_end_points(s->kind) && is_nearer_to_top(m);
    load_difference(D, point, top ? cylint_top(s) : cylint_base(s));
    load_axis(w, s);
    triple_cross(X, D, w);
    triple_cross(A, w, X);
    double error = CYLINT_CLOSE_DIRECTION * CYLINT_CLOSE_ERROR * m->size *
                   triple_dot(w, w).a * CYLINT_SLACK;
    if (is_on_axis(D, w, X)) {
        const int i = cylint_least_axis_component(s);
        A[i] = triple_of(0);
        A[(i + 1) % 3] = triple_neg(w[(i + 2) % 3]);
        A[(i + 2) % 3] = w[(i + 1) % 3];
        error = 0;
    }
    EACH(i, 3) {
        m->across[i] = pair_of_triple(A[i]);
        m->across_error[i] = error + CYLINT_CLOSE_LOSS * fabs(m->across[i].hi);
        squares[i] = pairs_square(m->across[i]);
    }
    const pair length = pairs_root(pairs_sum3(squares), &m->inverse);
    m->rho_error = 3 * error + 2 * CYLINT_CLOSE_LOSS * length.hi;
}

#endif
