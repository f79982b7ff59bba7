/*
 * near_surface.h - distances near the surface, and directions from the axis beside
 * it, in triples
 *
 * Near a surface the distance is a small difference.  It is a form that is 0 on
 * the surface, divided by a number that is not small.  The terms of the form are
 * products of the doubles given, so triples have all digits that count.  With
 * D the point from the base, w the axis, W = w.w and T = r0 W + dr D.w:
 *
 *   plane           D.w / |w|
 *   ball            (D.D - r^2) / (|D| + r)
 *   cylinder        ((D.D - r^2) W - (D.w)^2) / (W (rho + r))
 *   cone            cosine ((D.D W - (D.w)^2) W - T^2) / (W^2 (rho + T / W))
 *   angle cone      cosine (D.D W - (D.w)^2 - T^2) / (W (rho + T / |w|)),
 *                   T = tangent D.w
 *   round cone      ((D.D W - (D.w)^2) (W - dr^2) - T^2)
 *                                              / (W^2 (cosine rho + T / W))
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

/* form / divisor, where the terms of the form divided by the divisor are at most
 * `size` and the divisor has the relative error `relative`. */
static bounded_pairs quotient_of_form(triple form, pair divisor, double size,
                                      double relative)
{
    const pair d = pair_div(pair_of_triple(form), divisor);
    return (bounded_pairs){d, CYLINT_CLOSE_ERROR * size +
                                  (relative + CYLINT_CLOSE_LOSS) * fabs(d.hi)};
}

static bounded_pairs close_to_plane(const cylint_shape *s,
                                    const double point[3], int top, double size)
{
    triple D[3], w[3];
    const int tangent = cylint_has_tangent(s->kind);
    load_difference(D, point, top && !tangent ? cylint_top(s) : cylint_base(s));
    load_axis(w, s);
    if (top && tangent) /* from base + axis; a rounding of triples */
        EACH(i, 3)
            D[i] = triple_sub(D[i], w[i]);
    const pair length =
        tangent ? triple_length(w) : cylint_number_pair(s, CYLINT_AT_HEIGHT);
    bounded_pairs to = quotient_of_form(triple_dot(D, w), length, size, 0);
    int in_plane = 1; /* every product is 0 */
    EACH(i, 3)
        in_plane &= cylint_sign(D[i].a) == 0 || cylint_sign(w[i].a) == 0;
    if (in_plane)
        return (bounded_pairs){{0, 0}, 0};
    if (!top)
        to.v = pair_neg(to.v);
    return to;
}

static bounded_pairs close_to_ball(const double point[3],
                                   const double center[3], double r)
{
    triple D[3];
    load_difference(D, point, center);
    const triple square = triple_dot(D, D);
    const triple form = triple_sub(square, triple_of_pair(two_prod(r, r)));
    const pair length = pair_sqrt(pair_of_triple(square));
    const pair divisor = pair_add(length, (pair){r, 0});
    return quotient_of_form(form, divisor, CYLINT_CLOSE_BALL * divisor.hi, 0);
}

/* error: of rho. */
static bounded_pairs close_to_line(const cylint_shape *s, const double point[3],
                                   pair rho, double error, double size)
{
    triple D[3], w[3];
    load_difference(D, point, cylint_base(s));
    load_axis(w, s);
    const triple DD = triple_dot(D, D), Dw = triple_dot(D, w);
    const triple W = triple_dot(w, w);
    const pair W2 = pair_of_triple(W), r = {cylint_r0(s), 0};
    if (!cylint_is_tapered(s->kind)) {
        const triple rr = triple_of_pair(two_prod(cylint_r0(s), cylint_r0(s)));
        const triple form = triple_det(triple_sub(DD, rr), W, Dw, Dw);
        const pair sum = pair_add(rho, r);
        return quotient_of_form(form, pair_mul(W2, sum),
                                CYLINT_CLOSE_CYLINDER * size / sum.hi * size,
                                error / sum.hi);
    }
    const triple dr = triple_of_pair(cylint_radius_growth(s));
    triple T = triple_add(triple_times(W, cylint_r0(s)), triple_mul(dr, Dw));
    const triple across = triple_det(DD, W, Dw, Dw);
    if (s->ends == CYLINT_ENDS_INFINITE && T.a < 0)
        T = triple_neg(T); /* on the other nappe */
    const pair C = cylint_number_pair(s, CYLINT_AT_COSINE);
    const int round = cylint_is_round(s->kind);
    const int tangent = cylint_has_tangent(s->kind);
    const triple factor = round     ? triple_sub(W, triple_mul(dr, dr))
                          : tangent ? triple_of(1)
                                    : W;
    const triple form = triple_det(across, factor, T, T);
    const pair unit = tangent ? pair_sqrt(W2) : W2; /* of T */
    const pair radius = pair_div(pair_of_triple(T), unit);
    const pair sum = pair_add(round ? pair_mul(C, rho) : rho, radius);
    bounded_pairs to = quotient_of_form(
        form, pair_mul(pair_mul(unit, unit), sum),
        CYLINT_CLOSE_CONE * size / sum.hi * size, error / sum.hi);
    if (!round) { /* the error of T counts the growth along D, too */
        to.v = pair_mul(to.v, C);
        to.e = to.e * cylint_cosine(s) * CYLINT_SLACK +
               CYLINT_CLOSE_CONE * CYLINT_CLOSE_ERROR * size *
                   fabs(cylint_sine(s));
    }
    /* beyond the apex the other nappe can be nearer */
    if (!(radius.hi > 0) || C.hi < CYLINT_CLOSE_FLATTEST)
        to.e = HUGE_VAL;
    return to;
}

/* Whether the point is nearer to the plane of the top. */
static int is_nearer_to_top(const half_plane *m)
{
    return rounded(m->z) + rounded(m->above) > 0;
}

/* Whether the error of rho is small beside it. */
static int is_off_axis(const half_plane *m)
{
    return m->size < 2 * CYLINT_THINNEST * m->rho.hi;
}

/* From the rim the point is at `across` and `beyond` across and along the axis. */
static bounded_pairs close_to_rim(const cylint_shape *s, const double point[3],
                                  const half_plane *m, int top)
{
    const bounded_pairs line =
                            close_to_line(s, point, m->rho, m->error, m->size),
                        beyond = close_to_plane(s, point, top, m->size);
    const pair sine = cylint_number_pair(s, CYLINT_AT_SINE),
               C = cylint_number_pair(s, CYLINT_AT_COSINE),
               y = pair_mul(top ? sine : pair_neg(sine), beyond.v),
               across = pair_div(pair_add(line.v, y), C);
    const double error = line.e + fabs(sine.hi) * beyond.e +
                         CYLINT_CLOSE_LOSS * (fabs(line.v.hi) + fabs(y.hi));
    const pair d = pair_sqrt(
        pair_add(pair_mul(across, across), pair_mul(beyond.v, beyond.v)));
    return (bounded_pairs){d, error / C.hi * CYLINT_SLACK + beyond.e +
                                  CYLINT_CLOSE_LOSS * d.hi};
}

/* Of a point near the surface: the distance from a feature but the circle of
 * tangency of a ball. */
static bounded_pairs close_distance(const vnearest *n, const half_plane *m,
                                    const cylint_shape *s,
                                    const double point[3])
{
    const int feature = (int)n->feature, top = cylint_feature_end(feature);
    if (s->kind == CYLINT_KIND_SPHERE ||
        (cylint_is_round(s->kind) && feature != CYLINT_FEATURE_LATERAL))
        return close_to_ball(point, top ? cylint_top(s) : cylint_base(s),
                             cylint_end_factor(s, top));
    if (!is_off_axis(m))
        return (bounded_pairs){{0, 0}, HUGE_VAL};
    return feature == CYLINT_FEATURE_LATERAL
               ? close_to_line(s, point, m->rho, m->error, m->size)
           : cylint_is_on_end(feature) ? close_to_plane(s, point, top, m->size)
                                       : close_to_rim(s, point, m, top);
}

static int is_certain(const vdistance *d)
{
    return d->high <= d->low &&
           fabs(rounded(d->value)) >= CYLINT_DISTANCE_LEAST;
}

/* The distance in triples, or that in pairs where these do not serve. */
ASIDE vdistance distance_in_triples(const vnearest *n, const half_plane *m,
                                    const cylint_shape *s,
                                    const double point[3])
{
    /* untaken 1 of 4: the feature is certain in every known case */
    if (!n->certain ||
        (cylint_is_round(s->kind) &&
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
        squares[i] = vpair_square(m->across[i]);
    }
    const pair length = pairs_root(pairs_sum3(squares), &m->inverse);
    m->rho_error = 3 * error + 2 * CYLINT_CLOSE_LOSS * length.hi;
}

#endif
