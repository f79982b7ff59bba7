/*
 * near_surface.h - distances near the surface, features beside the planes of ends,
 * and directions from the axis beside it, in triples
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
    const pair length = cylint_number_pair(s, CYLINT_AT_HEIGHT);
    load_difference(D, point, top ? cylint_top(s) : cylint_base(s));
    load_axis(w, s);
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
    const triple T =
        triple_add(triple_times(W, cylint_r0(s)), triple_mul(dr, Dw));
    const triple across = triple_det(DD, W, Dw, Dw);
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

/* A distance in triples takes the place of that in pairs. */
static vdistance distance_of_triples(bounded_pairs d)
{
    const double margin = CYLINT_NEAREST_MARGIN * fabs(d.v.hi);
    vdistance to = pairs_rounded(d.v, d.e + margin);
    to.error = d.e;
    return to;
}

/* Of a point near the surface: the distance from a feature that is no rim. */
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
               : close_to_plane(s, point, top, m->size);
}

/* Whether the distance in pairs is certain, or that in triples, which then takes
 * its place. */
ASIDE int find_distance(vnearest *n, const half_plane *m, const cylint_shape *s,
                        const double point[3])
{
    const double size = fabs(rounded(n->d.value));
    const int certain = n->d.high <= n->d.low && size >= CYLINT_DISTANCE_LEAST;
    /* untaken 1 of 8: the feature is certain in every known case */
    if (certain || !n->certain || n->feature >= (double)CYLINT_FEATURE_RIM0 ||
        (cylint_has_tangent(s->kind) &&
         n->feature > (double)CYLINT_FEATURE_LATERAL) ||
        !(size <= CYLINT_CLOSE * m->size) || !(m->size <= CYLINT_CLOSE_MOST))
        return certain;
    const vdistance d = distance_of_triples(close_distance(n, m, s, point));
    /* untaken 1 of 4: no known distance of numbers in range is so small */
    if (!(d.high <= d.low) || !(fabs(d.low) >= CYLINT_DISTANCE_LEAST))
        return 0;
    n->d = d;
    return 1;
}

/* ----------------------------------------------------------------- ends -- */

enum { CYLINT_CLOSE_UNDECIDED = 2 };
static int sign_within(bounded_pairs x)
{
    return x.v.hi > x.e                    ? 1
           : x.v.hi < -x.e                 ? -1
           : fabs(x.v.hi) <= 0 && x.e <= 0 ? 0
                                           : CYLINT_CLOSE_UNDECIDED;
}

/* (x + f y) / by.  The relative errors of f and `by` are small beside
 * CYLINT_CLOSE_LOSS. */
static bounded_pairs sum_over(bounded_pairs x, pair f, bounded_pairs y, pair by)
{
    const pair fy = pair_mul(f, y.v);
    const double error = x.e + fabs(f.hi) * y.e +
                         CYLINT_CLOSE_LOSS * (fabs(x.v.hi) + fabs(fy.hi));
    return (bounded_pairs){pair_div(pair_add(x.v, fy), by),
                           error / by.hi * CYLINT_SLACK};
}

static bounded_pairs hypotenuse(bounded_pairs x, bounded_pairs y)
{
    const pair d = pair_sqrt(pair_add(pair_mul(x.v, x.v), pair_mul(y.v, y.v)));
    return (bounded_pairs){d, x.e + y.e + CYLINT_CLOSE_LOSS * d.hi};
}

/* The nearest feature to a point beside the plane of an end, and the distance.
 * From the rim the point is at `across` and `beyond` across and along the axis, and
 * at `after` along the lateral surface. */
static int nearest_beside_end(bounded_pairs *d, const half_plane *m,
                              const cylint_shape *s, const double point[3],
                              int top)
{
    const pair one = {1, 0}, sine = cylint_number_pair(s, CYLINT_AT_SINE),
               C = cylint_number_pair(s, CYLINT_AT_COSINE),
               S = top ? sine : pair_neg(sine);
    const bounded_pairs zero = {{0, 0}, 0},
                        line =
                            close_to_line(s, point, m->rho, m->error, m->size),
                        beyond = close_to_plane(s, point, top, m->size),
                        across = sum_over(line, S, beyond, C),
                        after = sum_over(sum_over(zero, C, beyond, one), S,
                                         across, one);
    const int out = sign_within(line), up = sign_within(beyond),
              side = sign_within(across), past = sign_within(after);
    const unsigned caps = cylint_caps_present(s->ends);
    const int has_cap = caps >> top & 1;
    if (has_cap && out < 0 && up < 0) {
        const int less =
            sign_within(sum_over(line, pair_neg(one), beyond, one));
        const int feature =
            less > 0 ? CYLINT_FEATURE_LATERAL : CYLINT_FEATURE_CAP0 + top;
        *d = less > 0 ? line : beyond;
        /* untaken 1 of 2: no known point is as far from both */
        return less == CYLINT_CLOSE_UNDECIDED ? CYLINT_NO_FEATURE : feature;
    }
    *d = beyond;
    if (has_cap && up == 1 && side == -1)
        return CYLINT_FEATURE_CAP0 + top;
    *d = past < 0 ? line : hypotenuse(across, beyond);
    const int outside = out == 1 || (up == 1 && past >= 0);
    const int can_be_over =
        up > 0 && (side < 0 || side == CYLINT_CLOSE_UNDECIDED);
    const int other_cap_is_far =
        !caps ||
        2 * fabs(d->v.hi) <= cylint_number_pair(s, CYLINT_AT_HEIGHT).hi;
    return past == CYLINT_CLOSE_UNDECIDED ||
                   !(has_cap ? outside && !can_be_over : other_cap_is_far)
               ? CYLINT_NO_FEATURE
           : past < 0 ? CYLINT_FEATURE_LATERAL
                      : CYLINT_FEATURE_RIM0 + top;
}

/* Decides feature and distance of a point beside the plane of an end of a
 * cylinder or cone, in triples, where the foot on the lateral surface is far from
 * the other end. */
ASIDE void find_beside_end(vnearest *n, const half_plane *m,
                           const cylint_shape *s, const double point[3])
{
    const int top = is_nearer_to_top(m);
    const double along = fabs(rounded(top ? m->above : m->z)),
                 across = rounded(m->rho) - cylint_end_factor(s, top);
    bounded_pairs d;
    if (!(along <= CYLINT_CLOSE * m->size) ||
        !(4 * (along + fabs(cylint_sine(s) * across)) <=
          cylint_number_pair(s, CYLINT_AT_HEIGHT).hi) ||
        !(m->size <= CYLINT_CLOSE_MOST) || !is_off_axis(m))
        return;
    const int feature = nearest_beside_end(&d, m, s, point, top);
    if (feature == CYLINT_NO_FEATURE)
        return;
    *n = (vnearest){distance_of_triples(d), feature, 1};
}

/* ----------------------------------------- the direction from the axis -- */

/* Of two nearly equal vectors D and z w the difference has few digits.  That of w x
 * (D x w), D the point from an end and w the axis, has all that count. */

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
        squares[i] = vpair_square(m->across[i]);
    }
    const pair length = pairs_root(pairs_sum3(squares), &m->inverse);
    m->rho_error = 3 * error + 2 * CYLINT_CLOSE_LOSS * length.hi;
}

#endif
