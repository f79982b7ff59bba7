/*
 * near_surface.h - distances near the surface, and directions from the axis beside
 * it, in triples
 *
 * Near a surface the distance is a small difference of roots, x - y.  It is
 * (x^2 - y^2) / (x + y).  The terms of the squares are products of the doubles
 * given, so triples have all digits of the numerator that count.  With D the point
 * from an end, w the axis, W = w.w, q = D.D W - (D.w)^2 and c = r0 W + dr D.w:
 *
 *   plane           D.w / |w|
 *   ball            (D.D - r^2) / (|D| + r)
 *   cylinder        (q - r^2 W) / (W (rho + r))
 *   cone            cosine (q W - c^2) / (W^2 (rho + c / W))
 *   angle cone      cosine (q - c^2) / (W (rho + c / |w|))
 *   round cone      (q (W - dr^2) - c^2) / (W^2 (cosine rho + c / W))
 *
 * A rim is on a cylinder and on a plane.
 */
#ifndef CYLINT_NEAR_SURFACE_H
#define CYLINT_NEAR_SURFACE_H

#include "../shapes/measure.h"
#include "pair_lanes.h"
#include "triple.h"

static void load_axis(triple w[3], const cylint_shape *s)
{
    EACH(i, 3)
        w[i] = triple_of_pair(cylint_axis_pair(s, i));
}

/* form / (unit sum), where the error of the form is at most CYLINT_CLOSE_SQUARES
 * CYLINT_CLOSE_ERROR size^2 unit, and that of the sum `error` besides. */
static bounded_pairs over_sum(triple form, pair unit, pair sum, double size,
                              double error)
{
    const pair d = pair_div(pair_of_triple(form), pair_mul(unit, sum));
    const double inverse = 1 / sum.hi, of_form = CYLINT_CLOSE_SQUARES *
                                                 CYLINT_CLOSE_ERROR * size *
                                                 size * inverse;
    return (bounded_pairs){
        d, of_form +
               ((of_form + error) * inverse + CYLINT_CLOSE_LOSS) * fabs(d.hi)};
}

static bounded_pairs close_to_ball(triple square, double r)
{
    const triple form = triple_sub(square, triple_of_pair(two_prod(r, r)));
    const pair length = pair_sqrt(pair_of_triple(square));
    return over_sum(form, (pair){1, 0}, pair_add(length, (pair){r, 0}),
                    length.hi + r, 0);
}

/* tangent: the radius is r |w|. */
static bounded_pairs close_to_cylinder(const half_plane *m, triple DD, triple W,
                                       triple Dw, double r, int tangent)
{
    const pair unit = pair_of_triple(W);
    triple square = triple_of_pair(two_prod(r, r));
    pair radius = {r, 0};
    if (tangent) {
        square = triple_mul(square, W);
        radius = pair_mul(radius, pair_sqrt(unit));
    }
    return over_sum(triple_det(triple_sub(DD, square), W, Dw, Dw), unit,
                    pair_add(m->rho, radius), m->size, m->error);
}

static bounded_pairs close_to_cone(const half_plane *m, const cylint_shape *s,
                                   triple DD, triple W, triple Dw)
{
    const int round = cylint_is_round(s->kind);
    const int tangent = cylint_has_tangent(s->kind);
    const triple dr = triple_of_pair(cylint_radius_growth(s)),
                 q = triple_det(DD, W, Dw, Dw);
    const pair C = cylint_number_pair(s, CYLINT_AT_COSINE),
               W2 = pair_of_triple(W), unit = tangent ? pair_sqrt(W2) : W2;
    triple c = triple_add(triple_times(W, cylint_r0(s)), triple_mul(dr, Dw));
    if (s->ends == CYLINT_ENDS_INFINITE && c.a < 0)
        c = triple_neg(c); /* on the other nappe */
    const triple g = round     ? triple_sub(W, triple_mul(dr, dr))
                     : tangent ? triple_of(1)
                               : W;
    const pair units = pair_mul(unit, unit),
               radius = pair_div(pair_of_triple(c), unit);
    /* beside a flat cone the radius can be far larger than all lengths */
    bounded_pairs to =
        over_sum(triple_det(q, g, c, c), round ? units : pair_div(units, C),
                 pair_add(round ? pair_mul(C, m->rho) : m->rho, radius),
                 cylint_larger(m->size, radius.hi), m->error);
    /* beyond the apex the other nappe can be nearer */
    if (radius.hi < 0)
        to.e = HUGE_VAL;
    return to;
}

/* Of a point near the surface: the distance from a feature but the circle of
 * tangency of a ball. */
static bounded_pairs close_distance(const vnearest *n, const half_plane *m,
                                    const cylint_shape *s,
                                    const double point[3])
{
    const int feature = (int)n->feature, top = cylint_feature_end(feature);
    const int on_end = cylint_is_on_end(feature);
    const int tangent = cylint_has_tangent(s->kind);
    bounded_pairs across = {{0, 0}, 0};
    triple D[3], w[3];
    load_difference(D, point, top && !tangent ? cylint_top(s) : cylint_base(s));
    if (s->kind == CYLINT_KIND_SPHERE || (on_end && cylint_is_round(s->kind)))
        return close_to_ball(triple_dot(D, D), cylint_end_factor(s, top));
    load_axis(w, s);
    if (top && tangent) /* from base + axis; a rounding of triples */
        EACH(i, 3)
            D[i] = triple_sub(D[i], w[i]);
    const triple W = triple_dot(w, w), Dw = triple_dot(D, w);
    if (!on_end) {
        const triple DD = triple_dot(D, D);
        const int lateral = feature == CYLINT_FEATURE_LATERAL;
        across = lateral && cylint_is_tapered(s->kind)
                     ? close_to_cone(m, s, DD, W, Dw)
                     : close_to_cylinder(m, DD, W, Dw,
                                         cylint_end_factor(s, top), tangent);
        if (lateral)
            return across;
    }
    const pair up = pair_div(pair_of_triple(Dw), pair_sqrt(pair_of_triple(W)));
    const double error =
        CYLINT_CLOSE_ERROR * m->size + CYLINT_CLOSE_LOSS * fabs(up.hi);
    if (on_end)
        return (bounded_pairs){top ? up : pair_neg(up), error};
    const pair d =
        pair_sqrt(pair_add(pair_mul(across.v, across.v), pair_mul(up, up)));
    return (bounded_pairs){d, across.e + error + CYLINT_CLOSE_LOSS * d.hi};
}

static int is_certain(const vdistance *d)
{
    return d->high <= d->low &&
           fabs(rounded(d->value)) >= CYLINT_DISTANCE_LEAST;
}

/* The distance in triples, or that in pairs where these do not serve.  The feature
 * is certain: else the error in pairs is infinite, and the distance can be 0. */
ASIDE vdistance distance_in_triples(const vnearest *n, const half_plane *m,
                                    const cylint_shape *s,
                                    const double point[3])
{
    if ((cylint_is_round(s->kind) &&
         n->feature >= (double)CYLINT_FEATURE_RIM0) ||
        !(fabs(rounded(n->d.value)) <= CYLINT_CLOSE * m->size) ||
        !(m->size <= CYLINT_CLOSE_MOST))
        return n->d;
    const bounded_pairs d = close_distance(n, m, s, point);
    vdistance to =
        pairs_rounded(d.v, d.e + CYLINT_NEAREST_MARGIN * fabs(d.v.hi));
    to.error = d.e;
    return to;
}

/* ----------------------------------------- the direction from the axis -- */

/* With D the point from an end and w the axis, D - z w has few digits where both
 * are nearly equal.  w x (D x w), a multiple of it, has all that count. */

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
 * axis that of phi = 0, e x w (exact_distance.c).  m->across is a multiple of
 * it; m->inverse and m->rho_error are those of its length. */
ASIDE void find_direction(half_plane *m, const cylint_shape *s,
                          const double point[3])
{
    triple D[3], w[3], X[3], A[3];
    pair squares[3];
    const int top = cylint_has_end_points(s->kind) &&
                    rounded(m->z) + rounded(m->above) > 0; /* it is nearer */
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
        error = 0; /* mutant '0' -> '1': slower, by exact numbers */
    }
    EACH(i, 3) {
        m->across[i] = pair_of_triple(A[i]);
        m->across_error[i] = error + CYLINT_CLOSE_LOSS * fabs(m->across[i].hi);
        squares[i] = vpair_square(m->across[i]);
    }
    const pair length = pairs_root(pairs_sum3(squares), &m->inverse);
    m->rho_error = 3 * error + 2 * CYLINT_CLOSE_LOSS * length.hi;
}

#endif
