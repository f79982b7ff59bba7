/*
 * near_surface.h - distances near the surface, and features beside the planes of
 * ends, in triples
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

#include "distance_types.h"
#include "triple_vector.h"

static void load_axis(triple w[3], const cylint_shape *s)
{
    EACH(i, 3)
        w[i] = triple_of_pair(cylint_axis_pair(s, i));
}

/* form / divisor, where the terms of the form divided by the divisor are at most
 * `size` and the divisor has the relative error `relative`. */
static bounded quotient_of_form(triple form, pair divisor, double size,
                                double relative)
{
    const pair d = pair_div(pair_of_triple(form), divisor);
    return (bounded){d, CYLINT_CLOSE_ERROR * size +
                            (relative + CYLINT_CLOSE_LOSS) * fabs(d.hi)};
}

static bounded close_to_plane(const cylint_shape *s, const double point[3],
                              int top, double size)
{
    triple D[3], w[3];
    const pair length = cylint_number_pair(s, CYLINT_AT_HEIGHT);
    load_difference(D, point, top ? cylint_top(s) : cylint_base(s));
    load_axis(w, s);
    bounded to = quotient_of_form(triple_dot(D, w), length, size, 0);
    int in_plane = 1; /* every product is 0 */
    EACH(i, 3)
        in_plane &= cylint_sign(D[i].a) == 0 || cylint_sign(w[i].a) == 0;
    if (in_plane)
        return (bounded){{0, 0}, 0};
    if (!top)
        to.v = pair_neg(to.v);
    return to;
}

static bounded close_to_ball(const double point[3], const double center[3],
                             double r)
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
static bounded close_to_line(const cylint_shape *s, const double point[3],
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
    bounded to = quotient_of_form(form, pair_mul(pair_mul(unit, unit), sum),
                                  CYLINT_CLOSE_CONE * size / sum.hi * size,
                                  error / sum.hi);
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
static vdistance distance_of_triples(bounded d)
{
    const double margin = CYLINT_NEAREST_MARGIN * fabs(d.v.hi);
    vdistance to = pairs_rounded(d.v, d.e + margin);
    to.error = d.e;
    return to;
}

/* Of a point near the surface: the distance from a feature that is no rim. */
static bounded close_distance(const vnearest *n, const half_plane *m,
                              const cylint_shape *s, const double point[3])
{
    const int feature = (int)n->feature, top = cylint_feature_end(feature);
    if (s->kind == CYLINT_KIND_SPHERE ||
        (cylint_is_round(s->kind) && feature != CYLINT_FEATURE_LATERAL))
        return close_to_ball(point, top ? cylint_top(s) : cylint_base(s),
                             cylint_end_factor(s, top));
    if (!is_off_axis(m))
        return (bounded){{0, 0}, HUGE_VAL};
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

enum { CYLINT_NO_SIGN = 2 };
static int sign_within(bounded x)
{
    return x.v.hi > x.e                    ? 1
           : x.v.hi < -x.e                 ? -1
           : fabs(x.v.hi) <= 0 && x.e <= 0 ? 0
                                           : CYLINT_NO_SIGN;
}

/* (x + f y) / by.  The relative errors of f and `by` are small beside
 * CYLINT_CLOSE_LOSS. */
static bounded sum_over(bounded x, pair f, bounded y, pair by)
{
    const pair fy = pair_mul(f, y.v);
    const double error = x.e + fabs(f.hi) * y.e +
                         CYLINT_CLOSE_LOSS * (fabs(x.v.hi) + fabs(fy.hi));
    return (bounded){pair_div(pair_add(x.v, fy), by),
                     error / by.hi * CYLINT_SLACK};
}

static bounded hypotenuse(bounded x, bounded y)
{
    const pair d = pair_sqrt(pair_add(pair_mul(x.v, x.v), pair_mul(y.v, y.v)));
    return (bounded){d, x.e + y.e + CYLINT_CLOSE_LOSS * d.hi};
}

/* The nearest feature to a point beside the plane of an end, and the distance.
 * From the rim the point is at `across` and `beyond` across and along the axis, and
 * at `after` along the lateral surface. */
static int nearest_beside_end(bounded *d, const half_plane *m,
                              const cylint_shape *s, const double point[3],
                              int top)
{
    const pair one = {1, 0}, sine = cylint_number_pair(s, CYLINT_AT_SINE),
               C = cylint_number_pair(s, CYLINT_AT_COSINE),
               S = top ? sine : pair_neg(sine);
    const bounded zero = {{0, 0}, 0},
                  line = close_to_line(s, point, m->rho, m->error, m->size),
                  beyond = close_to_plane(s, point, top, m->size),
                  across = sum_over(line, S, beyond, C),
                  after =
                      sum_over(sum_over(zero, C, beyond, one), S, across, one);
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
        return less == CYLINT_NO_SIGN ? CYLINT_NO_FEATURE : feature;
    }
    *d = beyond;
    if (has_cap && up == 1 && side == -1)
        return CYLINT_FEATURE_CAP0 + top;
    *d = past < 0 ? line : hypotenuse(across, beyond);
    const int outside = out == 1 || (up == 1 && past >= 0);
    const int can_be_over = up > 0 && (side < 0 || side == CYLINT_NO_SIGN);
    const int other_cap_is_far =
        !caps ||
        2 * fabs(d->v.hi) <= cylint_number_pair(s, CYLINT_AT_HEIGHT).hi;
    return past == CYLINT_NO_SIGN ||
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
    bounded d;
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

#endif
