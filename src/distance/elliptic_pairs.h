/*
 * elliptic_pairs.h - the distance, nearest point and normal of an elliptic shape in
 * pairs, given the feature and the angle in doubles
 *
 * As in elliptic.c, an angle has u = a cos + b sin, u' = b cos - a sin, the ruling
 * v = h + (k - 1) u and the normal N = u' x v.  With the point D from the base, and
 * F from the centre of an end whose factor is f, the distance is
 *     (D - u).N / |N|       from the tangent plane,
 *     F.(a x b) / |a x b|   from the plane of a cap,
 *     |F - f u|             from a rim.
 *
 * The effort 0 computes the distance once: its error by that of the angle is of
 * the second order.  The point and the normal, and a distance that is not
 * certain by then, need the angle in pairs: one more step of Newton's
 * iteration, effort 1.  Near the lateral surface and the caps the effort is 2:
 * there a small difference of large terms is computed in triples.
 */
#ifndef CYLINT_ELLIPTIC_PAIRS_H
#define CYLINT_ELLIPTIC_PAIRS_H

#include "../shapes/measure.h"
#include "describe_nearest.h"
#include "elliptic_feature.h"
#include "one_distance.h"
#include "triple.h"

/* --------------------- pairs with the sum of the sizes of their terms ---- */

/* The error of a sum of products of numbers without an error is at most
 * CYLINT_SIZED_ERROR times the sum of the sizes of its terms: where all terms are
 * 0, so is the error. */
typedef struct {
    vpair v;
    vd size;
} sized;

INLINE sized sized_product(sized x, sized y)
{
    return (sized){vpair_product(x.v, y.v), x.size * y.size};
}

INLINE sized sized_times(sized x, double f)
{
    const vpair p = v_two_prod(x.v.hi, f);
    return (sized){{p.hi, v_sum_of(x.v.lo, f, p.lo)}, x.size * fabs(f)};
}

INLINE sized sized_sum(sized x, sized y)
{
    return (sized){vpair_add(x.v, y.v), x.size + y.size};
}

INLINE sized sized_difference(sized x, sized y)
{
    return (sized){vpair_sub(x.v, y.v), x.size + y.size};
}

INLINE sized sized_of(vpair v)
{
    return (sized){v, v_abs(v.hi)};
}

INLINE sized sized_double(double x)
{
    return sized_of((vpair){v_set(x), v_set(0)});
}

INLINE sized sized_dot(const sized x[3], const sized y[3])
{
    sized p[3];
    EACH(i, 3)
        p[i] = sized_product(x[i], y[i]);
    const vpair v[3] = {p[0].v, p[1].v, p[2].v};
    return (sized){pairs_sum3(v), p[0].size + p[1].size + p[2].size};
}

INLINE void sized_cross(sized to[3], const sized u[3], const sized v[3])
{
    EACH(i, 3) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        to[i] = sized_difference(sized_product(u[j], v[k]),
                                 sized_product(u[k], v[j]));
    }
}

/* ------------------------------------------------------------- in pairs -- */

/* cos and sin, with cos^2 + sin^2 = 1 in pairs. */
typedef struct {
    sized cos, sin;
} direction_pair;

/* A normal, not of length 1. */
typedef struct {
    sized N[3];
    vpair inverse;        /* of |N| */
    double square, error; /* N.N; the relative error of |N| */
} normal_in_pairs;

/* What belongs to an angle.  R: F - f u, of the lateral surface D - u. */
typedef struct {
    sized u[3], v[3], du[3], R[3]; /* du: u' */
    normal_in_pairs normal;
} ruling_in_pairs;

/* The answer.  The distance has a sign, whatever the ends. */
typedef struct {
    bounded_pairs distance, point[3], normal[3];
} elliptic_answer;

static inline direction_pair direction_of(vpair c, vpair s)
{
    const vpair square = vpair_add(vpair_square(c), vpair_square(s));
    const double excess = 0.5 * ((square.hi - 1) + square.lo);
    const vpair f = v_two_sum(1, -excess + 1.5 * excess * excess);
    return (direction_pair){sized_of(pairs_trimmed(vpair_product(c, f))),
                            sized_of(pairs_trimmed(vpair_product(s, f)))};
}

/* Turns it by a step of Newton's iteration.  Returns 0, and does not turn it, if
 * the step is so long that direction_of() would not make the length 1 in pairs. */
static inline int turn_direction(direction_pair *e, double by)
{
    const vpair step = {by, 0};
    if (!(fabs(by) <= 0x1p-20))
        return 0;
    *e = direction_of(vpair_sub(e->cos.v, vpair_product(e->sin.v, step)),
                      vpair_add(e->sin.v, vpair_product(e->cos.v, step)));
    return 1;
}

/* F: the point minus base + share h. */
static inline void load_pairs_from_axis(sized F[3], const cylint_shape *s,
                                        const double point[3], sized share)
{
    EACH(i, 3)
        F[i] =
            sized_difference(sized_of(v_two_sum(point[i], -cylint_base(s)[i])),
                             sized_times(share, cylint_axis(s)[i]));
}

/* Writes what follows from N. */
static inline void measure_normal(normal_in_pairs *n)
{
    const sized square = sized_dot(n->N, n->N);
    pairs_root(square.v, &n->inverse);
    n->square = square.v.hi;
    n->error = CYLINT_SIZED_ERROR * (square.size / square.v.hi + 1);
}

ASIDE void load_ruling_in_pairs(ruling_in_pairs *t, const cylint_shape *s,
                                const sized F[3], double f,
                                const direction_pair *e)
{
    const double *a = cylint_a(s), *b = cylint_b(s), *h = cylint_axis(s);
    const sized k1 = sized_of(v_two_sum(cylint_r1(s), -1));
    EACH(i, 3) {
        t->u[i] =
            sized_sum(sized_times(e->cos, a[i]), sized_times(e->sin, b[i]));
        t->du[i] = sized_difference(sized_times(e->cos, b[i]),
                                    sized_times(e->sin, a[i]));
        t->v[i] = sized_sum(sized_double(h[i]), sized_product(k1, t->u[i]));
        t->R[i] = sized_difference(F[i], sized_times(t->u[i], f));
    }
    sized_cross(t->normal.N, t->du, t->v);
    measure_normal(&t->normal);
}

/* l (elliptic_certainty.h), which is 0 at the nearest point: of the lateral surface
 * (R.u' v.v - R.v u'.v) / N.N, of a rim R.u' / u'.u'.  *most: at least |l|. */
ASIDE double turn_of_ruling(const ruling_in_pairs *t, int on_rim, double *most)
{
    sized turn = sized_dot(t->R, t->du);
    double unit;
    if (on_rim) {
        unit = sized_dot(t->du, t->du).v.hi;
    } else {
        turn = sized_difference(
            sized_product(turn, sized_dot(t->v, t->v)),
            sized_product(sized_dot(t->R, t->v), sized_dot(t->du, t->v)));
        unit = t->normal.square;
    }
    *most = (fabs(rounded(turn.v)) + CYLINT_SIZED_ERROR * turn.size) / unit;
    return rounded(turn.v) / unit;
}

/* Turns the ruling and its angle by a step of Newton's iteration, and writes the
 * uncertainty there. */
static inline void correct_ruling(ruling_in_pairs *t, direction_pair *e,
                                  elliptic_question *q, const sized F[3],
                                  double f)
{
    const int on_rim = q->feature != CYLINT_FEATURE_LATERAL;
    double most;
    const double l = turn_of_ruling(t, on_rim, &most) * q->plane.q /
                     slope_of_height(&q->plane, &q->at);
    if (turn_direction(e, q->is_turned ? l : -l)) {
        load_ruling_in_pairs(t, q->shape, F, f, e);
        q->e = (angle){e->cos.v.hi, e->sin.v.hi};
        load_tangent_plane(&q->plane, &q->at, q->e);
        load_foot(q);
        turn_of_ruling(t, on_rim, &most);
    }
    q->by = uncertainty_of(q, most);
}

/* n / |N| times `sign`.  turned: the relative change of |N|, error: that of the
 * quotient, by the error of the angle. */
ASIDE bounded_pairs quotient_by_size(sized n, const normal_in_pairs *by,
                                     double turned, double error, double sign)
{
    const vpair d = vpair_product(n.v, by->inverse);
    return (bounded_pairs){{sign * d.hi, sign * d.lo},
                           CYLINT_SIZED_ERROR * n.size * by->inverse.hi +
                               fabs(d.hi) * (by->error + turned) + error};
}

/* N / |N| times `sign`.  change: of the components of N, by the error of the
 * angle. */
static inline void write_unit(bounded_pairs to[3], const normal_in_pairs *n,
                              const double change[3], double sign)
{
    const double turned = (change[0] + change[1] + change[2]) * n->inverse.hi;
    EACH(i, 3)
        to[i] = quotient_by_size(n->N[i], n, turned, change[i] * n->inverse.hi,
                                 sign);
}

static const double no_change[3] = {0, 0, 0};

/* By how much N changes at most by a turn: N' = h x u, N'' = h x u'. */
static inline void change_of_normal(double change[3], const ruling_in_pairs *t,
                                    const cylint_shape *s, double turn)
{
    const double *h = cylint_axis(s);
    double by[3];
    EACH(i, 3)
        by[i] = turn * (t->u[i].size + turn * t->du[i].size);
    EACH(i, 3) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        change[i] = fabs(h[j]) * by[k] + fabs(h[k]) * by[j];
    }
}

/* x - d n */
static inline void write_foot(bounded_pairs to[3], const double point[3],
                              bounded_pairs d, const bounded_pairs n[3])
{
    const bounded_pairs back = {opposite(d.v), d.e};
    EACH(i, 3)
        to[i] = step_along((vpair){point[i], 0}, back, n[i]);
}

/* from + step; error: that of the step by the angle. */
static inline bounded_pairs place_beside(vpair from, sized step, double error)
{
    return (bounded_pairs){vpair_add(from, step.v),
                           CYLINT_SIZED_ERROR * step.size +
                               CYLINT_PAIR_PLACE * fabs(from.hi) + error};
}

/* A form in triples as a pair: CYLINT_SIZED_ERROR times its size is the error of
 * triples. */
static inline sized sized_form(triple form, double size)
{
    return (sized){pair_of_triple(form),
                   CYLINT_CLOSE_ERROR / CYLINT_SIZED_ERROR * size};
}

/* (D - u).N.  The direction, whose length is 1 in pairs, is divided by its length
 * in triples: that changes neither the angle nor the tangent plane. */
ASIDE triple height_in_triples(const cylint_shape *s, const double point[3],
                               const direction_pair *e)
{
    const triple k1 = triple_of_pair(two_diff(cylint_r1(s), 1));
    direction at = {triple_of_pair(e->cos.v), triple_of_pair(e->sin.v)};
    triple D[3], a[3], b[3], h[3], N[3];
    ruling r;
    normalize(&at);
    load_difference(D, point, cylint_base(s));
    EACH(i, 3) {
        a[i] = triple_of(cylint_a(s)[i]);
        b[i] = triple_of(cylint_b(s)[i]);
        h[i] = triple_of(cylint_axis(s)[i]);
    }
    load_ruling(&r, a, b, h, k1, &at);
    EACH(i, 3)
        D[i] = triple_sub(D[i], r.u[i]);
    triple_cross(N, r.du, r.v);
    return triple_dot(D, N);
}

/* F.(a x b) */
ASIDE triple height_over_end(const cylint_shape *s, const double point[3],
                             int end)
{
    triple F[3], a[3], b[3], W[3];
    load_difference(F, point, cylint_base(s));
    EACH(i, 3) {
        F[i] = triple_sub(F[i], triple_of(end ? cylint_axis(s)[i] : 0));
        a[i] = triple_of(cylint_a(s)[i]);
        b[i] = triple_of(cylint_b(s)[i]);
    }
    triple_cross(W, a, b);
    return triple_dot(F, W);
}

/* ------------------------------------------------------------ answers -- */

/* N: a x b */
static inline void load_normal_of_caps(normal_in_pairs *n,
                                       const cylint_shape *s)
{
    sized a[3], b[3];
    EACH(i, 3) {
        a[i] = sized_double(cylint_a(s)[i]);
        b[i] = sized_double(cylint_b(s)[i]);
    }
    sized_cross(n->N, a, b);
    measure_normal(n);
}

/* Writes, without an error, the coordinate that all points of the end's plane
 * share, if there is one. */
static inline void keep_coordinate(elliptic_answer *to, const cylint_shape *s,
                                   const sized W[3], int end)
{
    EACH(i, 3) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        if (W[j].size == 0 && W[k].size == 0)
            to->point[i] = (bounded_pairs){
                v_two_sum(cylint_base(s)[i], end ? cylint_axis(s)[i] : 0), 0};
    }
}

static inline void answer_on_cap(elliptic_answer *to,
                                 const elliptic_question *q,
                                 const double point[3], int effort,
                                 unsigned want)
{
    const cylint_shape *s = q->shape;
    const int end = cylint_feature_end(q->feature);
    const double sign = cylint_left_handed(s) != !end ? -1 : 1;
    normal_in_pairs n;
    sized F[3];
    load_pairs_from_axis(F, s, point, sized_double(end));
    load_normal_of_caps(&n, s);
    sized above = sized_dot(F, n.N);
    /* mutant '>' -> '>=': slower, where pairs suffice */
    if (effort > 1)
        above = sized_form(height_over_end(s, point, end), above.size);
    to->distance = quotient_by_size(above, &n, 0, 0, sign);
    if (!(want & CYLINT_WANT_GEOMETRY))
        return;
    write_unit(to->normal, &n, no_change, sign);
    write_foot(to->point, point, to->distance, to->normal);
    keep_coordinate(to, s, n.N, end);
}

static inline bounded_pairs length_of_pairs(const sized R[3], double error)
{
    vpair inverse;
    const sized square = sized_dot(R, R);
    const vpair d = pairs_root(square.v, &inverse);
    return (bounded_pairs){
        d, CYLINT_SIZED_ERROR * (square.size * inverse.hi + d.hi) + error};
}

/* The apex is at base - h / (k - 1), the top if k is 0. */
static inline void answer_on_apex(elliptic_answer *to, const cylint_shape *s,
                                  const double point[3])
{
    const vpair k1 = v_two_sum(cylint_r1(s), -1);
    const sized share = sized_of(pair_div((pair){-1, 0}, k1));
    normal_in_pairs n;
    sized F[3];
    load_pairs_from_axis(F, s, point, share);
    EACH(i, 3) {
        n.N[i] = sized_double(cylint_axis(s)[i]);
        to->point[i] = place_beside((vpair){cylint_base(s)[i], 0},
                                    sized_times(share, cylint_axis(s)[i]), 0);
    }
    measure_normal(&n);
    to->distance = length_of_pairs(F, 0);
    write_unit(to->normal, &n, no_change, cylint_apex_normal_sign(s, 0));
}

/* On the lateral surface or a rim.  The end of a lateral surface is the base. */
static inline void answer_on_ruling(elliptic_answer *to, elliptic_question *q,
                                    const double point[3], int effort,
                                    unsigned want)
{
    const cylint_shape *s = q->shape;
    const int on_rim = q->feature != CYLINT_FEATURE_LATERAL,
              end = cylint_feature_end(q->feature);
    const double f = cylint_end_factor(s, end),
                 outward = cylint_left_handed(s) != q->is_turned ? -1 : 1;
    direction_pair e = direction_of((vpair){q->e.cos, 0}, (vpair){q->e.sin, 0});
    ruling_in_pairs t;
    sized F[3];
    double change[3];
    load_pairs_from_axis(F, s, point, sized_double(end));
    load_ruling_in_pairs(&t, s, F, f, &e);
    if (effort)
        correct_ruling(&t, &e, q, F, f);
    if (on_rim) {
        to->distance = length_of_pairs(t.R, 0);
        to->distance.e += q->by.away * q->by.away / to->distance.v.hi;
    } else {
        sized n = sized_dot(t.R, t.normal.N);
        /* mutant '>' -> '>=': slower, where pairs suffice */
        if (effort > 1)
            n = sized_form(height_in_triples(s, point, &e), n.size);
        to->distance =
            quotient_by_size(n, &t.normal, 0, q->by.distance, outward);
    }
    if (!(want & CYLINT_WANT_GEOMETRY))
        return;
    const double turn = turn_of(q);
    change_of_normal(change, &t, s, turn);
    write_unit(to->normal, &t.normal, change, outward);
    if (!on_rim)
        write_foot(to->point, point, to->distance, to->normal);
    else
        EACH(i, 3) {
            const vpair center =
                v_two_sum(cylint_base(s)[i], end ? cylint_axis(s)[i] : 0);
            to->point[i] =
                place_beside(center, sized_times(t.u[i], f),
                             f * turn * (t.du[i].size + turn * t.u[i].size));
        }
}

static inline void answer_in_pairs(elliptic_answer *to, elliptic_question *q,
                                   const double point[3], int effort,
                                   unsigned want)
{
    switch (q->feature) {
    case CYLINT_FEATURE_CAP0:
    case CYLINT_FEATURE_CAP1:
        answer_on_cap(to, q, point, effort, want);
        break;
    case CYLINT_FEATURE_APEX:
        answer_on_apex(to, q->shape, point);
        break;
    default:
        answer_on_ruling(to, q, point, effort, want);
    }
}

#endif
