/*
 * elliptic_pairs.h - the distance, nearest point and normal of an elliptic shape in
 * pairs, given the feature and the angle in doubles
 *
 * The effort 0 computes the distance once: its error by that of the angle is of
 * the second order.  The point and the normal, and a distance that is not
 * certain by then, need the angle in pairs: one more step of Newton's
 * iteration, effort 1.  Near the lateral surface and the caps the effort is 2:
 * there n, a small difference of large terms, is computed in triples.  With
 * U = b x h, V = h x a and W = a x b, which are the rows of the inverse matrix
 * times a.(b x h),
 *     n = cos D.U + sin D.V - (a.(b x h) + (k - 1) D.W)
 *     N = cos U + sin V - (k - 1) W.
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

INLINE sized sized_sum(sized x, sized y)
{
    return (sized){vpair_add(x.v, y.v), x.size + y.size};
}

INLINE sized sized_difference(sized x, sized y)
{
    return (sized){vpair_sub(x.v, y.v), x.size + y.size};
}

/* Where terms have cancelled, the low part can be as large as the high one. */
INLINE sized sized_trimmed(sized x)
{
    return (sized){pairs_trimmed(x.v), x.size};
}

INLINE sized sized_of(vpair v)
{
    return (sized){v, v_abs(v.hi)};
}

INLINE sized sized_double(double x)
{
    return sized_of((vpair){v_set(x), v_set(0)});
}

INLINE sized sized_opposite(sized x)
{
    return (sized){opposite(x.v), x.size};
}

INLINE sized sized_dot(const sized x[3], const sized y[3])
{
    sized p[3];
    EACH(i, 3)
        p[i] = sized_product(x[i], y[i]);
    const vpair v[3] = {p[0].v, p[1].v, p[2].v};
    return (sized){pairs_sum3(v), p[0].size + p[1].size + p[2].size};
}

INLINE void sized_cross(sized to[3], const double u[3], const double v[3])
{
    EACH(i, 3) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const vpair p = v_two_prod(v_set(u[j]), v_set(v[k])),
                    q = v_two_prod(v_set(u[k]), v_set(v[j]));
        to[i] = (sized){vpair_sub(p, q), v_abs(p.hi) + v_abs(q.hi)};
    }
}

/* x p + y q */
INLINE sized sized_sum2(sized x, sized p, sized y, sized q)
{
    return sized_sum(sized_product(x, p), sized_product(y, q));
}

/* A question in pairs; a double cone whose other nappe is nearer is turned about
 * its apex. */
typedef struct {
    sized D[3], U[3], V[3], W[3], bent[3]; /* bent: W times k - 1 */
    sized x, y, z, rho, volume;
    double unit;    /* 1 / |volume| */
    double outward; /* the sign of N of the outer side */
} elliptic_numbers;

ASIDE void load_numbers(elliptic_numbers *m, const cylint_shape *s,
                        const double point[3])
{
    const double *a = cylint_a(s), *b = cylint_b(s), *h = cylint_axis(s);
    sized A[3];
    sized_cross(m->U, b, h);
    sized_cross(m->V, h, a);
    sized_cross(m->W, a, b);
    EACH(i, 3) {
        m->D[i] = sized_of(v_two_sum(point[i], -cylint_base(s)[i]));
        A[i] = sized_double(a[i]);
    }
    m->volume = sized_trimmed(sized_dot(A, m->U));
    m->unit = 1 / fabs(m->volume.v.hi);
    m->outward = copysign(1, m->volume.v.hi);
    m->x = sized_trimmed(sized_dot(m->D, m->U));
    m->y = sized_trimmed(sized_dot(m->D, m->V));
    m->z = sized_trimmed(sized_dot(m->D, m->W));
    const sized k1 = sized_of(v_two_sum(cylint_r1(s), -1));
    EACH(i, 3)
        m->bent[i] = sized_product(k1, m->W[i]);
    m->rho = sized_trimmed(sized_sum(m->volume, sized_product(k1, m->z)));
}

static inline void turn_numbers_about_apex(elliptic_numbers *m)
{
    sized *const turned[3] = {&m->x, &m->y, &m->rho};
    EACH(i, 3)
        turned[i]->v = opposite(turned[i]->v);
    m->outward = -m->outward;
}

/* CYLINT_NO_FEATURE: also of a shape so small that products underflow.  No prepared
 * shape is too flat for pairs: the volume is at least 2^-29 of its terms. */
static inline int find_in_pairs(elliptic_question *q, elliptic_numbers *m,
                                const double point[3])
{
    if (find_elliptic_feature(q) == CYLINT_NO_FEATURE)
        return CYLINT_NO_FEATURE;
    load_numbers(m, q->shape, point);
    /* untaken 1 of 2: no known ordinary shape is so small */
    if (!(fabs(m->volume.v.hi) >= CYLINT_DISTANCE_LEAST))
        return CYLINT_NO_FEATURE;
    if (q->is_turned)
        turn_numbers_about_apex(m);
    return q->feature;
}

/* ------------------------------------------------------------- in pairs -- */

/* cos and sin, with cos^2 + sin^2 = 1 in pairs. */
typedef struct {
    sized cos, sin;
} direction_pair;

typedef struct {
    sized n, slope_of_n, N[3], slope_of_N[3], q;
    vpair inverse; /* of the length of N */
} plane_in_pairs;

/* What is written, but for the sign of the distance. */
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

/* Turns it by a step of Newton's iteration.  After a long one the numbers of the
 * angle in doubles are not those of this one: returns 0. */
static inline int turn_direction(direction_pair *e, double by,
                                 const elliptic_question *q)
{
    const vpair step = {by, 0};
    if (!(fabs(by) <= cylint_smaller(CYLINT_PAIR_TURN,
                                     0x1p-4 * q->plane.size / q->at.norm)))
        return 0;
    *e = direction_of(vpair_sub(e->cos.v, vpair_product(e->sin.v, step)),
                      vpair_add(e->sin.v, vpair_product(e->cos.v, step)));
    return 1;
}

/* The tangent plane at an angle. */
ASIDE void load_plane(plane_in_pairs *t, const elliptic_numbers *m,
                      const direction_pair *e)
{
    EACH(i, 3)
        t->N[i] = sized_difference(sized_sum2(e->cos, m->U[i], e->sin, m->V[i]),
                                   m->bent[i]);
    t->n = sized_difference(sized_sum2(e->cos, m->x, e->sin, m->y), m->rho);
    t->q = sized_dot(t->N, t->N);
    pairs_root(t->q.v, &t->inverse);
}

/* n' N.N - n N.V, which is 0 at the nearest point.  Writes n' and N', too. */
ASIDE sized load_slope(plane_in_pairs *t, const elliptic_numbers *m,
                       const direction_pair *e)
{
    const sized minus = sized_opposite(e->sin);
    EACH(i, 3)
        t->slope_of_N[i] = sized_sum2(e->cos, m->V[i], minus, m->U[i]);
    t->slope_of_n = sized_sum2(e->cos, m->y, minus, m->x);
    const sized half_q = sized_dot(t->N, t->slope_of_N);
    return sized_difference(sized_product(t->slope_of_n, t->q),
                            sized_product(t->n, half_q));
}

static inline double at_most(sized x)
{
    return fabs(rounded(x.v)) + CYLINT_SIZED_ERROR * x.size;
}

/* The angle in pairs, and what is uncertain then. */
static inline void correct_plane(plane_in_pairs *t, direction_pair *e,
                                 uncertainty *by, const elliptic_numbers *m,
                                 const elliptic_question *q)
{
    const double slope = slope_of_height(&q->plane, &q->at);
    const double cube = m->unit * m->unit * m->unit;
    const sized before = load_slope(t, m, e);
    const double sign = copysign(1, m->volume.v.hi);
    *by = uncertain_angle;
    if (!turn_direction(e, -sign * rounded(before.v) * cube / slope, q))
        return;
    load_plane(t, m, e);
    const sized after = load_slope(t, m, e);
    *by = uncertainty_of_plane(q, at_most(after) * cube / q->plane.q);
}

static inline bounded_pairs bounded_by(sized x, double error)
{
    return (bounded_pairs){x.v, CYLINT_SIZED_ERROR * x.size + error};
}

/* The relative error of |N|. */
static inline double root_error(const sized *q, double turn_of_size)
{
    return CYLINT_SIZED_ERROR * (q->size / q->v.hi + 1) + turn_of_size;
}

/* n / |N| times `sign`; relative: the relative error of |N|; error: another. */
ASIDE bounded_pairs quotient_by_size(sized n, vpair inverse, double relative,
                                     double error, double sign)
{
    const vpair d = vpair_product(n.v, inverse);
    return (bounded_pairs){{sign * d.hi, sign * d.lo},
                           CYLINT_SIZED_ERROR * n.size * inverse.hi +
                               fabs(d.hi) * relative + error};
}

/* The unit normal, outward.  turn: the error of the angle, by which N changes as
 * `slope`. */
static inline void write_unit(bounded_pairs to[3], const sized N[3],
                              vpair inverse, double relative,
                              const sized *slope, double turn, double sign)
{
    EACH(i, 3)
        to[i] = quotient_by_size(N[i], inverse, relative,
                                 slope ? slope[i].size * turn * inverse.hi : 0,
                                 sign);
}

/* x - d n */
static inline void write_foot(bounded_pairs to[3], const double point[3],
                              bounded_pairs d, const bounded_pairs n[3])
{
    const bounded_pairs back = {opposite(d.v), d.e};
    EACH(i, 3)
        to[i] = step_along((vpair){point[i], 0}, back, n[i]);
}

/* A form in triples as a pair: CYLINT_SIZED_ERROR times its size is the error of
 * triples. */
static inline sized sized_form(triple form, double size)
{
    return (sized){pair_of_triple(form),
                   CYLINT_CLOSE_ERROR / CYLINT_SIZED_ERROR * size};
}

ASIDE triple dot_of_triples(const triple u[3], const triple v[3])
{
    return triple_dot(u, v);
}

/* D.(u x v) */
ASIDE triple triple_volume(const triple D[3], const double u[3],
                           const double v[3])
{
    triple x[3];
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        x[i] = triple_sub(triple_of_pair(two_prod(u[j], v[k])),
                          triple_of_pair(two_prod(u[k], v[j])));
    }
    return dot_of_triples(D, x);
}

/* Numbers of elliptic_numbers in triples. */
typedef struct {
    triple place[3]; /* x, y, rho */
    triple z, volume;
} elliptic_triples;

ASIDE void load_triples(elliptic_triples *to, const cylint_shape *s,
                        const double point[3])
{
    const double *a = cylint_a(s), *b = cylint_b(s), *h = cylint_axis(s);
    triple D[3], A[3];
    load_difference(D, point, cylint_base(s));
    for (int i = 0; i < 3; i++)
        A[i] = triple_of(a[i]);
    to->place[0] = triple_volume(D, b, h);
    to->place[1] = triple_volume(D, h, a);
    to->z = triple_volume(D, a, b);
    to->volume = triple_volume(A, b, h);
    const triple k1 = triple_of_pair(two_diff(cylint_r1(s), 1));
    to->place[2] = triple_add(to->volume, triple_mul(k1, to->z));
}

/* n in triples: cos x + sin y - |e| rho.  |e|, which is 1 in pairs only, is
 * (e.e + 1) / 2 but for less than (e.e - 1)^2.  Returns |e.e - 1|: n / |N| changes
 * by half of that, |N| by half of norm / |N| times that. */
static inline double refine_height(plane_in_pairs *t,
                                   const elliptic_question *q,
                                   const double point[3],
                                   const direction_pair *e)
{
    triple of[3] = {{e->cos.v.hi, e->cos.v.lo, 0},
                    {e->sin.v.hi, e->sin.v.lo, 0},
                    {1, 0, 0}};
    elliptic_triples m;
    load_triples(&m, q->shape, point);
    of[2] = triple_scale(dot_of_triples(of, of), -0.5);
    const triple n = dot_of_triples(of, m.place);
    t->n = sized_form(q->is_turned ? triple_neg(n) : n, t->n.size);
    return 2 * fabs((of[2].a + 1) + of[2].b);
}

static inline void answer_on_lateral(elliptic_answer *to,
                                     const elliptic_question *q,
                                     const elliptic_numbers *m,
                                     const double point[3], int effort,
                                     unsigned want)
{
    plane_in_pairs t;
    double by_length = 0, sign = copysign(1, m->volume.v.hi);
    uncertainty by = q->by;
    direction_pair e = direction_of((vpair){q->e.cos, 0}, (vpair){q->e.sin, 0});
    load_plane(&t, m, &e);
    if (effort)
        correct_plane(&t, &e, &by, m, q);
    const double ratio = q->at.norm / q->plane.size;
    if (effort > 1)
        by_length = ratio * refine_height(&t, q, point, &e);
    to->distance = quotient_by_size(t.n, t.inverse, root_error(&t.q, by_length),
                                    by.distance, sign);
    if (!(want & CYLINT_WANT_GEOMETRY))
        return;
    write_unit(to->normal, t.N, t.inverse, root_error(&t.q, ratio * by.turn),
               t.slope_of_N, by.turn, m->outward);
    write_foot(to->point, point, to->distance, to->normal);
}

/* The coordinate that all points of the end's plane share, if there is one. */
static inline void keep_coordinate(elliptic_answer *to,
                                   const elliptic_question *q,
                                   const elliptic_numbers *m, int end)
{
    const cylint_shape *s = q->shape;
    EACH(i, 3) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        if (m->W[j].size == 0 && m->W[k].size == 0)
            to->point[i] = (bounded_pairs){
                v_two_sum(cylint_base(s)[i], end ? cylint_axis(s)[i] : 0), 0};
    }
}

static inline void answer_on_cap(elliptic_answer *to,
                                 const elliptic_question *q,
                                 const elliptic_numbers *m,
                                 const double point[3], int effort,
                                 unsigned want)
{
    const int end = cylint_feature_end(q->feature);
    vpair inverse;
    const sized square = sized_dot(m->W, m->W);
    sized above = end ? sized_difference(m->z, m->volume) : m->z;
    pairs_root(square.v, &inverse);
    const double relative = root_error(&square, 0);
    const double sign = (m->volume.v.hi < 0) != !end ? -1 : 1;
    if (effort > 1) {
        elliptic_triples t;
        load_triples(&t, q->shape, point);
        above = sized_form(end ? triple_sub(t.z, t.volume) : t.z, above.size);
    }
    to->distance = quotient_by_size(above, inverse, relative, 0, sign);
    if (!(want & CYLINT_WANT_GEOMETRY))
        return;
    write_unit(to->normal, m->W, inverse, relative, NULL, 0, sign);
    write_foot(to->point, point, to->distance, to->normal);
    keep_coordinate(to, q, m, end);
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
static inline void answer_on_apex(elliptic_answer *to,
                                  const elliptic_question *q,
                                  const elliptic_numbers *m)
{
    const cylint_shape *s = q->shape;
    const vpair k1 = v_two_sum(cylint_r1(s), -1);
    const sized by = sized_of(pair_div((pair){-1, 0}, k1));
    sized F[3], h[3];
    vpair inverse;
    EACH(i, 3) {
        const double base = cylint_base(s)[i];
        h[i] = sized_double(cylint_axis(s)[i]);
        const sized step = sized_product(by, h[i]);
        F[i] = sized_difference(m->D[i], step);
        to->point[i] =
            bounded_by((sized){vpair_add((vpair){base, 0}, step.v), step.size},
                       CYLINT_PAIR_PLACE * fabs(base));
    }
    const sized square = sized_dot(h, h);
    pairs_root(square.v, &inverse);
    to->distance = length_of_pairs(F, 0);
    write_unit(to->normal, h, inverse, root_error(&square, 0), NULL, 0,
               cylint_apex_normal_sign(s, 0));
}

/* A rim at an angle: u and v are multiplied by its factor. */
typedef struct {
    sized u[3], v[3], R[3], beside; /* beside: R.v */
    double square;                  /* v.v */
} rim_in_pairs;

ASIDE void load_rim_in_pairs(rim_in_pairs *r, const cylint_shape *s,
                             const sized F[3], double f,
                             const direction_pair *e)
{
    const sized factor = sized_double(f), cos = sized_product(factor, e->cos),
                sin = sized_product(factor, e->sin),
                minus = sized_opposite(sin);
    r->square = 0;
    EACH(i, 3) {
        const sized a = sized_double(cylint_a(s)[i]),
                    b = sized_double(cylint_b(s)[i]);
        r->u[i] = sized_sum2(cos, a, sin, b);
        r->v[i] = sized_sum2(cos, b, minus, a);
        r->R[i] = sized_difference(F[i], r->u[i]);
        r->square += r->v[i].v.hi * r->v[i].v.hi;
    }
    r->beside = sized_dot(r->R, r->v);
}

static inline void answer_on_rim(elliptic_answer *to,
                                 const elliptic_question *q,
                                 const elliptic_numbers *m, int effort,
                                 unsigned want)
{
    const cylint_shape *s = q->shape;
    const int end = cylint_feature_end(q->feature);
    const double f = cylint_end_factor(s, end);
    rim_in_pairs r;
    sized F[3]; /* the point from the centre */
    uncertainty by = q->by;
    direction_pair e = direction_of((vpair){q->e.cos, 0}, (vpair){q->e.sin, 0});
    EACH(i, 3)
        F[i] = end ? sized_difference(m->D[i], sized_double(cylint_axis(s)[i]))
                   : m->D[i];
    load_rim_in_pairs(&r, s, F, f, &e);
    if (effort) {
        const double slope = r.square + rounded(sized_dot(r.R, r.u).v);
        by = uncertain_angle;
        /* untaken 1 of 2: every known step is small enough */
        if (turn_direction(&e, rounded(r.beside.v) / slope, q)) {
            load_rim_in_pairs(&r, s, F, f, &e);
            by = uncertainty_of_plane(q, f * at_most(r.beside) / r.square);
        }
    }
    const double beside = at_most(r.beside);
    to->distance = length_of_pairs(r.R, 2 * by.distance);
    to->distance.e += beside * beside / (r.square * to->distance.v.hi);
    if (!(want & CYLINT_WANT_GEOMETRY))
        return;
    plane_in_pairs t;
    load_plane(&t, m, &e);
    load_slope(&t, m, &e);
    double ratio = 0;
    EACH(i, 3) {
        const vpair center =
            v_two_sum(cylint_base(s)[i], end ? cylint_axis(s)[i] : 0);
        const double error =
            CYLINT_PAIR_PLACE * fabs(center.hi) + r.v[i].size * by.turn;
        to->point[i] = bounded_by(
            (sized){vpair_add(center, r.u[i].v), r.u[i].size}, error);
        ratio += t.slope_of_N[i].size * t.inverse.hi;
    }
    write_unit(to->normal, t.N, t.inverse, root_error(&t.q, ratio * by.turn),
               t.slope_of_N, by.turn, m->outward);
}

static inline void answer_in_pairs(elliptic_answer *to,
                                   const elliptic_question *q,
                                   const elliptic_numbers *m,
                                   const double point[3], int effort,
                                   unsigned want)
{
    switch (q->feature) {
    case CYLINT_FEATURE_LATERAL:
        answer_on_lateral(to, q, m, point, effort, want);
        break;
    case CYLINT_FEATURE_CAP0:
    case CYLINT_FEATURE_CAP1:
        answer_on_cap(to, q, m, point, effort, want);
        break;
    case CYLINT_FEATURE_APEX:
        answer_on_apex(to, q, m);
        break;
    default:
        answer_on_rim(to, q, m, effort, want);
    }
}

#endif
