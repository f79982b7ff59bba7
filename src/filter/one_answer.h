/*
 * one_answer.h - the answer to one question, from signs or roots at both ends
 *
 * Narrow lanes (frame.h): lane i belongs to end i.  What a stage computed of a
 * question that it does not decide is stored in the question.
 */
#ifndef CYLINT_ONE_ANSWER_H
#define CYLINT_ONE_ANSWER_H

#include "describe.h"

/* ----------------------------------------------------------- answers ---- */

/* The surface of a sphere is one part, which may be a ball of a round cone. */
INLINE cylint_end_bits parts_of_sphere(const cylint_shape *shape)
{
    return (cylint_end_bits){
        cylint_surface(shape) == CYLINT_PART_LATERAL ? 0 : 3,
        cylint_surface(shape) == CYLINT_PART_CAP1 ? 3 : 0,
        cylint_part_is_present(shape->ends, cylint_surface(shape)) ? 3 : 0, 0};
}

INLINE cylint_end_bits bits_of_end(const line_end *e, const local_line *l,
                                   const verdict *v, const cylint_shape *shape,
                                   int solid)
{
    if (solid == CYLINT_SOLID_SPHERE)
        return parts_of_sphere(shape);
    return (cylint_end_bits){m_bits(e->on_end), m_bits(e->top),
                             m_bits(is_present(l, v, e, 0, solid)),
                             (int)(m_bits(is_backward(l, v, solid)) & 1)};
}

INLINE int write_miss(cylint_answer *answer)
{
    answer->relation = CYLINT_RELATION_MISS;
    return answer->n = 0;
}

/* The lane of hit n. */
INLINE int lane_of_hit(unsigned hits, int n, int back)
{
    return hits == 3 ? n ^ back : hits == 2;
}

INLINE void write_parts(cylint_answer *answer, cylint_end_bits e, unsigned hits,
                        int unbounded)
{
    const int n = hits == 3 ? 2 : hits != 0;
    EACH(i, 2) {
        if (i >= n)
            break;
        const int lane = lane_of_hit(hits, i, e.back);
        answer->hit[i].part = !(e.on_end >> lane & 1) ? CYLINT_PART_LATERAL
                              : e.top >> lane & 1     ? CYLINT_PART_CAP1
                                                      : CYLINT_PART_CAP0;
        answer->hit[i].side = unbounded ? lane : lane ^ e.back;
    }
}

/* Writes a line that crosses with hits at those ends.  r: their roots, if t is
 * wanted.  in: the line in pairs, if other members are wanted. */
INLINE int write_hits(unsigned hits, cylint_end_bits e, const root *r,
                      const pair_line *in, cylint_question *q, int solid)
{
    const int unbounded = !cylint_solid_is_bounded(solid);
    cylint_answer *answer = q->answer;
    if (q->want & CYLINT_WANT_NEAREST && hits == 3)
        hits = 1u << e.back;
    answer->relation = CYLINT_RELATION_CROSS;
    if (q->want & CYLINT_WANT_T && hits) {
        double t[2];
        const int lane = lane_of_hit(hits, 0, e.back);
        v_store(t, r->value);
        answer->hit[0].t = t[lane];
        if (hits == 3)
            answer->hit[1].t = t[!lane];
        if (q->want & CYLINT_WANT_BESIDE_T)
            describe_hits(q, in, r, e, hits == 3 ? 2 : 1, lane);
    }
    if (q->want & CYLINT_WANT_PART)
        write_parts(answer, e, hits, unbounded);
    return answer->n = (int)(hits & 1) + (int)(hits >> 1);
}

/* ------------------------------------------------------------ kernels --- */

/* The hits of a line that crosses, by the signs at the ends of the domain. */
INLINE int answer_by_places(const place *at, cylint_end_bits e,
                            cylint_question *q, int solid)
{
    const unsigned before = m_bits(at->before), inside = m_bits(at->inside),
                   after = m_bits(at->after);
    if ((before | inside | after) != 3)
        return CYLINT_UNDECIDED;
    const unsigned begins = before & 1 & ~(before >> 1);
    const unsigned ends = ~after & 1 & (after >> 1);
    return write_hits(e.present & (begins << e.back | ends << !e.back), e, NULL,
                      NULL, q, solid);
}

/* All ends are present, and their parts are not wanted. */
INLINE int ignores_parts(const cylint_question *q, int solid)
{
    return (q->shape->ends == CYLINT_ENDS_CAPPED ||
            !cylint_solid_is_bounded(solid)) &&
           !(q->want & CYLINT_WANT_PART);
}

/* Whether part of the overlap of a line that crosses certainly lies ahead of its
 * origin. */
INLINE vm is_ahead(const local_line *l, const verdict *v, int solid)
{
    const vd eZ = v_set(2 * CYLINT_LOCAL_POSITION) * l->unit * l->Q * l->D;
    vm ahead = v_lt(v->B.v, -v->B.e);
    if (solid == CYLINT_SOLID_DOUBLE_CONE)
        ahead = m_and(ahead, v_lt(v_set(0), v->A.v));
    if (!cylint_solid_has_planes(solid))
        return ahead;
    vm on_end = v->pierced[0],
       cap = m_and(on_end, v_lt(l->z[0] * l->in.w, -eZ));
    if (cylint_solid_is_hull(solid) && m_any(v->chord[0])) {
        const bounded_value B = v->ball.B[0];
        cap = m_or(cap, m_and(v->chord[0], v_lt(B.v, -B.e)));
        on_end = m_or(on_end, v->chord[0]);
    }
    return m_or(either_end(&cap), m_and_not(ahead, either_end(&on_end)));
}

INLINE int leave_undecided(cylint_question *q, cylint_refinement next)
{
    q->next = next;
    return CYLINT_UNDECIDED;
}

INLINE int answer_by_signs(const local_line *l, const verdict *v,
                           cylint_question *q, int solid)
{
    const cylint_line *line = q->line;
    const int no_parts = ignores_parts(q, solid);
    if (!no_parts && !(m_bits(v->sided) & 1))
        return leave_undecided(q, CYLINT_REFINE_LINE);
    if (no_parts && q->want & CYLINT_WANT_NEAREST && line->tmin <= 0 &&
        line->tmax > v_first(latest(solid)) && solid != CYLINT_SOLID_NAPPE &&
        m_bits(is_ahead(l, v, solid)) & 1) {
        q->answer->relation = CYLINT_RELATION_CROSS;
        return q->answer->n = 1;
    }
    const line_end e = end_number(l, v, 0, solid);
    const cylint_end_bits bits = bits_of_end(&e, l, v, q->shape, solid);
    point_signs at = no_point_signs;
    set_point_signs(&at, l, v, near_limit(l->limit[0]), solid);
    const place where = place_of(&at, v, l->limit[0], solid);
    const int n = answer_by_places(&where, bits, q, solid);
    if (n != CYLINT_UNDECIDED)
        return n;
    q->ends = bits;
    q->exists = m_bits(v->exists[0]);
    q->past[0] = m_bits(at.past.positive);
    q->past[1] = m_bits(at.past.negative);
    q->A = v_first(v->A.v);
    q->rises = (int)(m_bits(v_lt(v->B.e, v->B.v)) & 1) -
               (int)(m_bits(v_lt(v->B.v, -v->B.e)) & 1);
    return leave_undecided(q, CYLINT_REFINE_ENDS);
}

/* The ends without which there is no answer. */
INLINE unsigned ends_needed(hits h, cylint_end_bits e, unsigned want)
{
    const unsigned lanes = m_bits(h.undecided), first = 1u << e.back;
    return want & CYLINT_WANT_NEAREST && m_bits(h.hit) & first ? lanes & first
                                                               : lanes;
}

INLINE int answer_by_roots(const local_line *l, verdict *v, const pair_line *in,
                           cylint_question *q, int solid)
{
    if (cylint_solid_is_hull(solid))
        compute_balls(&v->ball, l);
    const line_end e = end_number(l, v, 0, solid);
    const estimate at = estimate_end(l, v, &e, solid);
    const cylint_end_bits bits = bits_of_end(&e, l, v, q->shape, solid);
    if (bits.present & ~m_bits(at.is_near))
        return leave_undecided(q, CYLINT_REFINE_LINE);
    root r = step_from(at.t, residual_at(in, l, at.t, &e, solid), &at);
    if (!(q->want & CYLINT_WANT_T)) /* its rounding may be uncertain */
        r.nearest = m_from(3);
    const hits h = hits_of_roots(&r, l, m_from(bits.present));
    if (!ends_needed(h, bits, q->want))
        return write_hits(m_bits(h.hit), bits, &r, in, q, solid);
    q->ends = bits;
    v_store(q->slope, at.slope);
    v_store(q->slope_error, at.slope_error);
    v_store(q->curvature, at.curvature);
    v_store(q->value, r.value);
    v_store(q->tail, r.tail);
    v_store(q->error, r.error);
    return leave_undecided(q, CYLINT_REFINE_ROOTS);
}

#endif
