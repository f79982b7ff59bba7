/*
 * near_surface.h - distances near the surface, in triples
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
 *   rounded cone    ((D.D W - (D.w)^2) (W - dr^2) - T^2)
 *                                              / (W^2 (cosine rho + T / W))
 */
#ifndef CYLINT_NEAR_SURFACE_H
#define CYLINT_NEAR_SURFACE_H

#include "half_plane.h"
#include "nearest.h"
#include "triple_vector.h"

static triple triple_of_pair(pair x)
{
    return (triple){x.hi, x.lo, 0};
}

static pair pair_of_triple(triple x)
{
    return fast_two_sum(x.a, x.b + x.c);
}

static void load_difference(triple D[3], const double point[3],
                            const double from[3])
{
    EACH(i, 3)
        D[i] = triple_of_pair(two_diff(point[i], from[i]));
}

static void load_axis(triple w[3], const cylint_shape *s)
{
    EACH(i, 3)
        w[i] = triple_of_pair(cylint_axis_pair(s, i));
}

/* A distance and the bound on its error. */
typedef struct {
    pair d;
    double error;
} close_distance;

/* form / divisor, where the terms of the form divided by the divisor are at most
 * `size` and the divisor has the relative error `loss`. */
static close_distance quotient_of_form(triple form, pair divisor, double size,
                                       double loss)
{
    const pair d = pair_div(pair_of_triple(form), divisor);
    return (close_distance){d, CYLINT_CLOSE_ERROR * size +
                                   (loss + CYLINT_CLOSE_LOSS) * fabs(d.hi)};
}

/* What pairs computed.  size: at least |D|, the height and the radii.  error: of
 * rho, z and d. */
typedef struct {
    int feature;
    pair rho, d;
    double size, error;
} distance_in_pairs;

static close_distance close_to_plane(const cylint_shape *s,
                                     const double point[3], int top,
                                     double size)
{
    triple D[3], w[3];
    const pair length = cylint_number_pair(s, CYLINT_AT_HEIGHT);
    load_difference(D, point, top ? cylint_top(s) : cylint_base(s));
    load_axis(w, s);
    close_distance to = quotient_of_form(triple_dot(D, w), length, size, 0);
    if (!top)
        to.d = pair_neg(to.d);
    return to;
}

static close_distance close_to_ball(const double point[3],
                                    const double center[3], double r)
{
    triple D[3];
    load_difference(D, point, center);
    const triple square = triple_dot(D, D);
    const triple form = triple_sub(square, triple_of_pair(two_prod(r, r)));
    const pair length = pair_sqrt(pair_of_triple(square));
    const pair divisor = pair_add(length, (pair){r, 0});
    return quotient_of_form(form, divisor, 2 * divisor.hi, 0);
}

/* error: of rho. */
static close_distance close_to_line(const cylint_shape *s,
                                    const double point[3], pair rho,
                                    double error, double size)
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
                                4 * size / sum.hi * size, error / sum.hi);
    }
    const triple dr = triple_of_pair(cylint_radius_growth(s));
    const triple T =
        triple_add(triple_times(W, cylint_r0(s)), triple_mul(dr, Dw));
    const triple across = triple_det(DD, W, Dw, Dw);
    const pair C = cylint_number_pair(s, CYLINT_AT_COSINE);
    const int round = cylint_is_round(s->kind);
    const triple factor = round ? triple_sub(W, triple_mul(dr, dr)) : W;
    const triple form = triple_det(across, factor, T, T);
    const pair radius = pair_div(pair_of_triple(T), W2);
    const pair sum = pair_add(round ? pair_mul(C, rho) : rho, radius);
    close_distance to =
        quotient_of_form(form, pair_mul(pair_mul(W2, W2), sum),
                         16 * size / sum.hi * size, error / sum.hi);
    if (!round) {
        to.d = pair_mul(to.d, C);
        to.error *= cylint_cosine(s) * CYLINT_SLACK;
    }
    if (!(radius.hi > 0)) /* beyond the apex: the other nappe can be nearer */
        to.error = HUGE_VAL;
    return to;
}

/* A from the lateral line and B from the plane of the end, both positive outside:
 * with the slope S of the line, whose sign is that at the top, the distance from
 * the rim across the axis is (A + S B) / cosine. */
static close_distance close_to_rim(const cylint_shape *s, const double point[3],
                                   const distance_in_pairs *at, int top)
{
    const close_distance lateral =
        close_to_line(s, point, at->rho, at->error, at->size);
    const close_distance plane = close_to_plane(s, point, top, at->size);
    const pair C = cylint_number_pair(s, CYLINT_AT_COSINE);
    const pair sine = cylint_number_pair(s, CYLINT_AT_SINE);
    const pair S = top ? sine : pair_neg(sine);
    const pair across = pair_div(pair_add(lateral.d, pair_mul(S, plane.d)), C);
    const pair d = pair_sqrt(
        pair_add(pair_mul(across, across), pair_mul(plane.d, plane.d)));
    return (close_distance){d, 4 * (lateral.error + plane.error) /
                                       cylint_cosine(s) +
                                   CYLINT_CLOSE_LOSS * d.hi};
}

/* Computes the distance of a point near the surface from the feature that is
 * nearest; whether it is certain. */
ASIDE int is_certain_in_triples(distance_in_pairs *at, const cylint_shape *s,
                                const double point[3])
{
    const double size = at->size;
    const int feature = at->feature, round = cylint_is_round(s->kind);
    const int top = cylint_feature_end(feature);
    const int ball = s->kind == CYLINT_KIND_SPHERE ||
                     (round && feature != CYLINT_FEATURE_LATERAL);
    const int rim = feature >= CYLINT_FEATURE_RIM0;
    if ((rim && (round || s->ends != CYLINT_ENDS_CAPPED)) ||
        cylint_has_tangent(s->kind) ||
        !(fabs(at->d.hi) <= CYLINT_CLOSE * size) ||
        !(size <= CYLINT_CLOSE_MOST) ||
        (!ball && !(size < 2 * CYLINT_THINNEST * at->rho.hi)))
        return 0;
    const close_distance to =
        ball  ? close_to_ball(point, top ? cylint_top(s) : cylint_base(s),
                              cylint_end_factor(s, top))
        : rim ? close_to_rim(s, point, at, top)
        : feature == CYLINT_FEATURE_LATERAL
            ? close_to_line(s, point, at->rho, at->error, size)
            : close_to_plane(s, point, top, size);
    at->d = fast_two_sum(to.d.hi, to.d.lo);
    at->error = to.error;
    const double most = to.error + CYLINT_NEAREST_MARGIN * fabs(at->d.hi);
    return (at->d.hi + (at->d.lo + most) == at->d.hi) &
           (at->d.hi + (at->d.lo - most) == at->d.hi) &
           (fabs(at->d.hi) >= CYLINT_DISTANCE_LEAST);
}

#endif
