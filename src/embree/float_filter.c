/*
 * float_filter.c - hits of float rays in doubles, a question in each lane
 *
 * Compiled with one lane as it is and again for processors with fused
 * multiply-add, and with the lanes of AVX2 and AVX-512.
 */
#ifndef CYLINT_FLOAT_FILTER
#define CYLINT_FLOAT_FILTER cylint_float_filter_plain
#define CYLINT_ONE_LANE
#endif

#include "../bvh/float_bounds.h"
#include "../bvh/swept_disc.h"

#include "float_filter_describe.h"

/* For each lane i of `lanes`: at most once where there is one lane. */
#define EACH_LANE(i, lanes)                                                   \
    for (unsigned i##_of = (lanes), i;                                        \
         i##_of && (i = LANES == 1 ? 0 : (unsigned)cylint_lowest(i##_of), 1); \
         i##_of = LANES == 1 ? 0 : i##_of & (i##_of - 1))

/* ------------------------------------------------------------- accepting -- */

/* HIT: the hit counts; MISS: it does not, but the next may. */
INLINE cylint_float_filter_result accept_hit(double t, double e, double z,
                                             double z_error, int is_present,
                                             asked *of)
{
    if (t + e < of->tmin || !is_present)
        return CYLINT_FLOAT_FILTER_MISS;
    const float above = of->t = cylint_float_above(t);
    if (!(t - e > of->tmin && cylint_is_float_above(above, t, e)))
        return CYLINT_FLOAT_FILTER_UNCERTAIN;
    if (above > of->tfar)
        return CYLINT_FLOAT_FILTER_MISS;
    if (of->count > 1) {
        const int piece = cylint_piece_at(z - z_error, of->count);
        if (piece != cylint_piece_at(z + z_error, of->count))
            return CYLINT_FLOAT_FILTER_UNCERTAIN;
        if (piece != of->index)
            return CYLINT_FLOAT_FILTER_MISS;
    }
    return above < of->tfar ? CYLINT_FLOAT_FILTER_HIT
                            : CYLINT_FLOAT_FILTER_UNCERTAIN;
}

/* The same for `lanes`.  Returns the lanes with a hit. */
INLINE unsigned accept_hits(const questions *q, const hit *at, unsigned lanes,
                            unsigned *uncertain)
{
    double t[LANES], e[LANES], z[LANES], z_error[LANES];
    const vd all = q->from + at->s;
    const unsigned capped = m_bits(at->capped), top = m_bits(at->top);
    unsigned hits = 0;
    v_store(t, all);
    v_store(e, at->s_error + eps(1) * v_abs(all));
    v_store(z, at->z);
    v_store(z_error, at->z_error);
    *uncertain = 0;
    EACH_LANE(i, lanes)
    {
        const int is_present =
            !(capped >> i & 1) ||
            cylint_caps_present(q->of[i]->ends) >> (top >> i & 1) & 1;
        const cylint_float_filter_result is =
            accept_hit(t[i], e[i], z[i], z_error[i], is_present, q->of[i]);
        hits |= (unsigned)(is == CYLINT_FLOAT_FILTER_HIT) << i;
        *uncertain |= (unsigned)(is == CYLINT_FLOAT_FILTER_UNCERTAIN) << i;
    }
    return hits;
}

/* ------------------------------------------------------------ describing -- */

/* The unit normal, from *a, that of lateral_direction(). */
INLINE vm normal_on_shape(const questions *q, const hit *at, int is_round,
                          bounded_vector *a, vd normal[3])
{
    const vm at_end = is_round ? is_on_ball(q, at) : at->capped;
    const vm lateral = m_not(at_end);
    vm certain = at_end;
    if (m_any(lateral))
        certain = m_or(at_end, lean_on_cone(q, at, lateral, a));
    if (m_any(at_end))
        set_end_normal(q, at, is_round, at_end, a);
    return m_and(certain, unit_floats(a, normal));
}

/* Writes the floats of hits; returns the lanes in which they are certain. */
INLINE unsigned describe_hits(const questions *q, const hit *at, unsigned lanes,
                              int is_round)
{
    vm least[3];
    vd c[3];
    bounded_vector normal;
    vd f[CYLINT_HIT_FLOATS]; /* the normal, z, phi */
    double stored[CYLINT_HIT_FLOATS][LANES];
    find_least(q, least);
    const vd e_c = across(q, at, c);
    lateral_direction(q, c, e_c, &normal);
    vm certain = to_float(at->z, at->z_error, &f[3]);
    const vm phi = describe_phi(q, e_c, along_least(normal.N, least),
                                along_least(c, least), &f[4]);
    certain = m_and(certain, phi);
    if (is_round) {
        EACH(j, 2)
            f[3 + j] = v_select(q->is_ball, v_set(0), f[3 + j]);
        certain = m_or(q->is_ball, certain);
    }
    certain = m_and(certain, normal_on_shape(q, at, is_round, &normal, f));
    EACH(j, CYLINT_HIT_FLOATS)
        v_store(stored[j], f[j]);
    lanes &= m_bits(certain);
    EACH_LANE(i, lanes)
    {
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

/* Hits for which a step pays: of these the floats would be uncertain, on discs
 * about one of 2^6, on round shapes one of 2^11. */
INLINE unsigned need_step(const questions *q, const hit *at, int is_round)
{
    const vm far =
        v_lt(v_set(is_round ? 0x1p-38 : 0x1p-33) * q->R, at->s_error * q->U);
    return m_bits(is_round ? far : m_and_not(far, at->capped));
}

/* ------------------------------------------------------------- answering -- */

/* The first hits.  *uncertain: the undecided lanes; *leaves: those in which the
 * line leaves the shape.  Returns the lanes with a hit. */
INLINE unsigned find_hits(questions *q, int is_round, hit *first,
                          unsigned *uncertain, unsigned *leaves)
{
    unsigned hits = 0;
    const verdict crosses = cross_shape(q, is_round);
    unsigned left = m_bits(crosses.hit) & q->used;
    *uncertain = m_bits(crosses.uncertain);
    *leaves = 0;
    for (int end = 0; end < 2; end++) {
        unsigned here = end ? left : left & ~q->exit_only, unsure;
        hit at;
        if (!here)
            continue;
        const verdict v =
            is_round ? end_on_round(q, end, &at) : end_on_discs(q, end, &at);
        *uncertain |= m_bits(v.uncertain) & here;
        left &= ~here | m_bits(v.hit);
        here &= m_bits(v.hit);
        const unsigned inexact = here & need_step(q, &at, is_round);
        if (inexact)
            step_on_shape(q, end, is_round, m_from(inexact), &at);
        const unsigned accepted = accept_hits(q, &at, here, &unsure);
        if (LANES == 1 || !hits)
            *first = at;
        else
            select_hit(first, m_from(accepted), &at);
        *uncertain |= unsure;
        *leaves |= end ? accepted : 0;
        hits |= accepted;
        left &= ~(accepted | unsure);
    }
    return hits;
}

INLINE void answer_as(questions *q, int is_round)
{
    hit at = no_hit();
    unsigned uncertain, leaves;
    const unsigned hits = find_hits(q, is_round, &at, &uncertain, &leaves);
    const unsigned wanted = hits & q->describes;
    if (wanted)
        uncertain |= wanted & ~describe_hits(q, &at, wanted, is_round);
    EACH_LANE(i, q->used)
    {
        q->of[i]->is = uncertain >> i & 1 ? CYLINT_FLOAT_FILTER_UNCERTAIN
                       : hits >> i & 1    ? CYLINT_FLOAT_FILTER_HIT
                                          : CYLINT_FLOAT_FILTER_MISS;
        q->of[i]->leaves = (int)(leaves >> i & 1);
    }
}

INLINE void answer_questions(asked *const of[], int n)
{
    questions q;
    q.used = q.exit_only = q.describes = 0;
    for (int i = 0; i < LANES; i++) {
        asked *one = q.of[i] = of[i < n ? i : 0];
        q.used |= (unsigned)(i < n) << i;
        q.exit_only |= (unsigned)one->exit_only << i;
        q.describes |= (unsigned)one->describes << i;
    }
    load_questions(&q);
    if (m_bits(v_lt(q.r0 + (q.r0 + q.dr), v_set(0))) & 1) {
        q.r0 = -q.r0;
        q.dr = -q.dr;
        answer_as(&q, 1);
    } else {
        answer_as(&q, 0);
    }
}

void CYLINT_FLOAT_FILTER(asked *const of[], int n)
{
    for (int from = 0; from < n; from += LANES)
        answer_questions(of + from, n - from);
}
