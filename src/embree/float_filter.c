/*
 * float_filter.c - hits of float rays in doubles, a question in each lane
 *
 * Compiled with one lane as it is and again for processors with fused
 * multiply-add, and with the lanes of AVX2.
 */
#ifndef CYLINT_FLOAT_FILTER
#define CYLINT_FLOAT_FILTER cylint_float_filter_plain
#define CYLINT_ONE_LANE
#endif

#include "../bvh/float_bounds.h"

#include "float_filter_lanes.h"

/* For each lane i of `lanes`. */
#define EACH_LANE(i, lanes)         \
    for (int i = 0; i < LANES; i++) \
        if ((lanes) >> i & 1)

/* ------------------------------------------------------------- accepting -- */

/* HIT: the hit counts; MISS: it does not, but the next may.  e: 0 if t is exact. */
INLINE cylint_float_filter_result accept_hit(double t, double e, double z,
                                             double z_error, int is_present,
                                             int on_ball, question *of)
{
    const double tmax = of->line.tmax;
    if (t + e < of->line.tmin || !is_present)
        return CYLINT_FLOAT_FILTER_MISS;
    const float above = of->t = cylint_float_above(t);
    if (e > 0 && !(t - e > of->line.tmin && cylint_is_float_above(above, t, e)))
        return CYLINT_FLOAT_FILTER_UNDECIDED;
    if ((double)above > tmax) /* t may be less where both are subnormal */
        return t > tmax ? CYLINT_FLOAT_FILTER_MISS
                        : CYLINT_FLOAT_FILTER_UNDECIDED;
    const int count = of->slice.count;
    if (count > 1) {
        const int index = cylint_slice_at(z - z_error, count);
        if (index != cylint_slice_at(z + z_error, count))
            return CYLINT_FLOAT_FILTER_UNDECIDED;
        if (index != of->slice.index)
            return CYLINT_FLOAT_FILTER_MISS;
    }
    return (double)above < tmax || on_ball ? CYLINT_FLOAT_FILTER_HIT
                                           : CYLINT_FLOAT_FILTER_UNDECIDED;
}

/* Whether the line pierces a cap in a plane of coordinates where t is a float,
 * which is written: data of few digits often do.  A low part flushed to 0 is too
 * small to change the double nearest to t. */
INLINE int pierces_at_float(const question *of, int top, double *t)
{
    const double *p0 = of->record.p0, *p1 = of->record.p1;
    const double w[3] = {p1[0] - p0[0], p1[1] - p0[1], p1[2] - p0[2]};
    EACH(j, 3) {
        if (!cylint_runs_along(w, j))
            continue;
        const pair rise = two_diff(top ? p1[j] : p0[j], of->line.o[j]);
        *t = (double)(float)(rise.hi / of->line.d[j]);
        return rise.lo == 0 && *t * of->line.d[j] == rise.hi;
    }
    return 0;
}

/* Accepts hits in `lanes`.  Returns those with a hit that counts. */
INLINE unsigned accept_hits(const questions *q, const hit *at, unsigned lanes,
                            int is_round, unsigned *uncertain)
{
    double t[LANES], e[LANES], z[LANES], z_error[LANES];
    const vd all = q->from + at->s;
    const unsigned at_end = m_bits(at->at_end), top = m_bits(at->top);
    const unsigned planes = is_round ? 0 : at_end & ~m_bits(q->is_angle);
    const unsigned balls = is_round ? at_end : 0;
    unsigned hits = 0;
    v_store(t, all);
    v_store(e, at->s_error + eps(1) * v_abs(all));
    v_store(z, at->z);
    v_store(z_error, at->z_error);
    *uncertain = 0;
    EACH_LANE(i, lanes) {
        const int is_present =
            !(at_end >> i & 1) ||
            cylint_caps_present(q->of[i]->ends) >> (top >> i & 1) & 1;
        cylint_float_filter_result is =
            accept_hit(t[i], e[i], z[i], z_error[i], is_present,
                       (int)(balls >> i & 1), q->of[i]);
        if (is == CYLINT_FLOAT_FILTER_UNDECIDED && planes >> i & 1 &&
            pierces_at_float(q->of[i], (int)(top >> i & 1), &t[i]))
            is = accept_hit(t[i], 0, z[i], 0, is_present, 0, q->of[i]);
        hits |= (unsigned)(is == CYLINT_FLOAT_FILTER_HIT) << i;
        *uncertain |= (unsigned)(is == CYLINT_FLOAT_FILTER_UNDECIDED) << i;
        q->of[i]->ball = balls >> i & 1 ? (int)(top >> i & 1) : -1;
    }
    return hits;
}

/* ------------------------------------------------------------ describing -- */

/* A vector N with errors e[].  Its length is 1 / per_length, with a relative
 * error of e_length. */
typedef struct {
    vd N[3], e[3], per_length, e_length;
} bounded_vector;

/* Rounds x to a float, stored as a double.  x has an error of at most e, which
 * includes the error of the library's x.  Returns whether the float is certain. */
INLINE vm to_float(vd x, vd e, vd *f)
{
    *f = v_float(x + e);
    return v_eq(v_float(x - e), *f);
}

/* a: w x c and its error, which follows from e_c, rounding included, and its length
 * on a cylinder.  The error is computed by component: a component that is zero
 * because components of the axis are zero stays exact. */
INLINE void lateral_direction(const questions *q, const vd c[3], vd e_c,
                              bounded_vector *a)
{
    const vd x = v_abs(q->w[0]), y = v_abs(q->w[1]), z = v_abs(q->w[2]);
    v_cross(a->N, q->w, c);
    a->e[0] = (y + z) * e_c;
    a->e[1] = (z + x) * e_c;
    a->e[2] = (x + y) * e_c;
    a->per_length = q->per_ww / where_or_one(v_lt(v_set(0), q->r0), q->r0);
    a->e_length = eps(3);
}

/*
 * The lateral normal is N = S (w x c) - k dr w, of which `a` is w x c.  As |c|^2 =
 * k^2 ww / S, its length is k |w| sqrt(S ww + dr^2), with a relative error of 20 u
 * plus that of k.
 */
INLINE vm lean_on_cone(const questions *q, const hit *at, vm lateral,
                       bounded_vector *a)
{
    const vd dr = q->dr;
    vd e_k;
    if (!m_any(m_not(v_eq(dr, v_set(0)))))
        return lateral;
    const vd k = cone_radius(q, at, &e_k), lean = k * dr;
    e_k = e_k + v_abs(dr * q->dz) * at->s_error;
    const vd e_lean = v_abs(dr) * (e_k + eps(1) * v_abs(k));
    const vm certain = m_and(lateral, v_lt(v_set(32) * e_k, k));
    EACH(j, 3) {
        const vd N = q->S * a->N[j];
        a->e[j] =
            q->S * a->e[j] + eps(2) * v_abs(a->N[j]) + e_lean * v_abs(q->w[j]);
        a->N[j] = N - lean * q->w[j];
    }
    const vd length = k * (q->W * v_sqrt(q->S * q->ww + dr * dr));
    a->per_length = v_set(1) / where_or_one(certain, length);
    a->e_length = e_k / where_or_one(certain, k) + eps(3);
    return certain;
}

/* The outward normal on a cap, or on the ball about an end, in the lanes `where`:
 * -w or w, or P from the centre. */
INLINE void set_end_normal(const questions *q, const hit *at, int is_round,
                           vm where, bounded_vector *a)
{
    const vd zero = v_set(0), one = v_set(1);
    vd e = zero, length = q->W, e_length = eps(2);
    if (is_round) {
        const vd X = size_along(q, at->s) + v_select(at->top, q->W, zero);
        const vd r = v_select(at->top, q->r0 + q->dr, q->r0);
        e = q->U * at->s_error + eps(1) * X;
        length = where_or_one(v_lt(zero, r), r);
        e_length = eps(1) * (q->R / length + one);
    }
    EACH(j, 3) {
        const vd w = q->w[j], center = v_select(at->top, w, zero);
        const vd su = at->s * q->u[j];
        const vd sizes = v_abs(q->D[j]) + v_abs(su) + v_abs(center);
        const vd P = (q->D[j] + su) - center;
        const vd N = is_round ? P : v_select(at->top, w, -w);
        a->N[j] = v_select(where, N, a->N[j]);
        a->e[j] =
            v_select(where, v_select(v_lt(zero, sizes), e, zero), a->e[j]);
    }
    a->per_length = v_select(where, one / length, a->per_length);
    a->e_length = v_select(where, e_length, a->e_length);
}

/*
 * phi = atan2(P.(w x v), P.v |w|) over 2 pi, where v = e x w, e being the unit
 * vector along which the axis is least.  That is atan2((w x c).e, -c.e |w|).  Of
 * equal coordinates of the axis the low parts decide, then the order.
 */
INLINE vm describe_phi(const questions *q, const vd across_w[3], const vd c[3],
                       vd e_c, vd *phi)
{
    const vd zero = v_set(0), one = v_set(1);
    vd size[3], low[3], per_far;
    EACH(j, 3) {
        size[j] = v_abs(q->w[j]);
        low[j] = v_like(one, q->w[j]) * q->w_low[j];
    }
    const vm y = v_lt((size[1] - size[0]) + (low[1] - low[0]), zero);
    const vd xy = v_select(y, size[1], size[0]);
    const vd xy_low = v_select(y, low[1], low[0]);
    const vm z = v_lt((size[2] - xy) + (low[2] - xy_low), zero);
    const vd up =
        v_select(z, across_w[2], v_select(y, across_w[1], across_w[0]));
    const vd along = v_select(z, c[2], v_select(y, c[1], c[0]));
    const vd turn = cylint_atan2_turns(up, -along * q->W, &per_far);
    /* both have an error of at most W e_c, so the angle's is less than
     * sqrt(2) / (2 pi) of that over the hypotenuse; 13/12 covers per_far */
    const vd part = q->W * e_c * per_far;
    const vd e = v_set(0.25) * part + v_set(CYLINT_ATAN2_TURNS_ERROR);
    const vm inside =
        m_and(v_lt(e, turn), v_lt(turn + e, v_set(1 - (double)FLT_EPSILON)));
    return m_and(m_and(v_lt(part, v_set(0.125)), inside),
                 to_float(turn, e, phi));
}

/* The unit normal N / |N|, from *a, that of lateral_direction(). */
INLINE vm normal_on_shape(const questions *q, const hit *at, int is_round,
                          bounded_vector *a, vd normal[3])
{
    const vm at_end = at->at_end, lateral = m_not(at_end);
    vm certain = at_end;
    if (m_any(lateral))
        certain = m_or(at_end, lean_on_cone(q, at, lateral, a));
    if (m_any(at_end))
        set_end_normal(q, at, is_round, at_end, a);
    EACH(j, 3) {
        const vd x = a->N[j] * a->per_length;
        const vd e = a->e[j] * a->per_length + v_abs(x) * a->e_length;
        certain = m_and(certain, to_float(x, v_set(1.1) * e, &normal[j]));
    }
    return certain;
}

/* Writes the floats of hits; returns the lanes in which they are certain. */
INLINE unsigned describe_floats(const questions *q, const hit *at,
                                unsigned lanes, int is_round)
{
    vd c[3];
    bounded_vector normal;
    vd f[CYLINT_HIT_FLOATS]; /* the normal, z, phi */
    double stored[CYLINT_HIT_FLOATS][LANES];
    const vd e_c = cross_at(q, at->s, at->s_error, c);
    lateral_direction(q, c, e_c, &normal);
    vm certain = m_and(to_float(at->z, at->z_error, &f[3]),
                       describe_phi(q, normal.N, c, e_c, &f[4]));
    if (is_round) {
        EACH(j, 2)
            f[3 + j] = v_select(q->is_ball, v_set(0), f[3 + j]);
        certain = m_or(q->is_ball, certain);
    }
    certain = m_and(certain, normal_on_shape(q, at, is_round, &normal, f));
    EACH(j, CYLINT_HIT_FLOATS)
        v_store(stored[j], f[j]);
    lanes &= m_bits(certain);
    EACH_LANE(i, lanes) {
        /* not by a loop, which gcc 12 makes wait for the stores */
        float *to = q->of[i]->floats;
        to[0] = (float)stored[0][i];
        to[1] = (float)stored[1][i];
        to[2] = (float)stored[2][i];
        to[3] = (float)stored[3][i];
        to[4] = (float)stored[4][i];
    }
    return lanes;
}

/* Hits for which a step pays: without it about one hit in 2^6 between discs, and
 * one in 2^11 on round shapes, would have uncertain floats. */
INLINE unsigned need_step(const questions *q, const hit *at, int is_round)
{
    const vd share = v_set(is_round ? 0x1p-38 : 0x1p-33);
    return m_bits(
        m_and_not(v_lt(share * q->R, at->s_error * q->U), at->at_end));
}

/* ------------------------------------------------------------- answering -- */

INLINE void answer_as(questions *q, int is_round)
{
    hit first;
    unsigned hits = 0, leaves = 0, unsure;
    cross_shape(q, is_round);
    unsigned open = m_bits(q->may) & q->used, uncertain = m_bits(q->uncertain);
    for (int end = q->of[0]->exit_only; end < 2 && open; end++) {
        hit at = end_on_shape(q, is_round, end);
        uncertain |= m_bits(at.uncertain) & open;
        open &= m_bits(at.is);
        const unsigned inexact = open & need_step(q, &at, is_round);
        if (inexact)
            step_on_cone(q, end, m_from(inexact), &at);
        const unsigned accepted = accept_hits(q, &at, open, is_round, &unsure);
        if (LANES == 1 || !hits)
            first = at;
        else
            select_hit(&first, m_from(accepted), &at);
        uncertain |= unsure;
        leaves |= end ? accepted : 0;
        hits |= accepted;
        open &= ~(accepted | unsure);
    }
    if (hits && q->of[0]->describes)
        uncertain |= hits & ~describe_floats(q, &first, hits, is_round);
    EACH_LANE(i, q->used) {
        q->of[i]->is = uncertain >> i & 1 ? CYLINT_FLOAT_FILTER_UNDECIDED
                       : hits >> i & 1    ? CYLINT_FLOAT_FILTER_HIT
                                          : CYLINT_FLOAT_FILTER_MISS;
        q->of[i]->leaves = (int)(leaves >> i & 1);
    }
}

void CYLINT_FLOAT_FILTER(question *const of[], int n)
{
    for (int from = 0; from < n; from += LANES) {
        questions q;
        q.used = 0;
        for (int i = 0; i < LANES; i++) {
            q.of[i] = of[from + i < n ? from + i : from];
            q.used |= (unsigned)(from + i < n) << i;
        }
        load_questions(&q);
        const unsigned round =
            q.used & m_bits(v_lt(q.r0 + (q.r0 + q.dr), v_set(0)));
        q.used &= ~round;
        if (q.used)
            answer_as(&q, 0);
        q.used = round;
        q.r0 = -q.r0;
        q.dr = -q.dr;
        if (q.used)
            answer_as(&q, 1);
    }
}
