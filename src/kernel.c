/*
 * kernel.c - kernel.h for a single line and shape
 *
 * Compiled once as it is and, where the Makefile knows a processor with a
 * fused multiply-add, again for that: the answers are the same bits.
 */
#define CYLINT_NARROW
#include "kernel.h"
#include "kernels.h"

#ifndef CYLINT_ONE
#define CYLINT_ONE cylint_one_plain
#endif

INLINE void store_root(cylint_kernel_answer *to, int n, const lanes_root *r,
                       int lane)
{
    double x[LANES];
    v_store(x, r->value);
    to->t[n] = x[lane];
    v_store(x, r->more);
    to->more[n] = x[lane];
    v_store(x, r->error);
    to->error[n] = x[lane];
}

INLINE int first(vm m)
{
    return (int)(m_bits(m) & 1);
}

/* Rounds the roots of the hits, two lanes at once where there are two. */
INLINE int answer_roots(const lanes_query *q, const lanes_shape *s,
                               const lanes_line *l, int kind,
                               const lanes_verdict *v, int from, int to,
                               unsigned want, cylint_kernel_answer *answer)
{
    if (want & CYLINT_WANT_FAST) {
        int sure = 1;
        for (int i = from; i < to; i++) {
            const lanes_root r = take_root(q, v->stop[i]);
            sure &= first(r.sure);
            store_root(answer, i - from, &r, 0);
        }
        if (sure)
            return 1;
    }
    if (!cylint_rounds_to_nearest()) /* what follows would certify nothing */
        return 0;
    const int swapped = first(v->leaving_first);
    const double sign[2] = {swapped ? 1 : -1, swapped ? -1 : 1};
#if LANES == 2
    if (to - from == 2) {
        const bounded_value t = {v_both(v->stop[0].v, v->stop[1].v),
                                 v_both(v->stop[0].e, v->stop[1].e)};
        const lanes_root r = round_root(q, s, l, kind, v_load(sign), t,
                                        v_both(v->part[0], v->part[1]));
        store_root(answer, 0, &r, 0);
        store_root(answer, 1, &r, 1);
        return m_bits(r.sure) == 3;
    }
#endif
    for (int i = from; i < to; i++) {
        const lanes_root r = round_root(q, s, l, kind, v_set(sign[i]),
                                        v->stop[i], v->part[i]);
        if (!first(r.sure))
            return 0;
        store_root(answer, i - from, &r, 0);
    }
    return 1;
}

INLINE int answer_one(const cylint_shape *shape,
                             const cylint_line *line, int kind, int bounded,
                             unsigned want, cylint_kernel_answer *answer)
{
    lanes_shape s;
    lanes_line l;
    lanes_query q;
    broadcast_shape(&s, shape, kind);
    broadcast_line(&l, line);
    const unsigned all = (1u << LANES) - 1;
    const lanes_verdict v = lanes_judge(&q, &s, &l, kind, bounded,
                                        m_from(all));
    if (m_any(v.undecided))
        return 0;
    answer->relation = first(v.cross) ? CYLINT_CROSS : CYLINT_MISS;
    const int from = first(v.hit[0]) ? 0 : 1;
    int to = first(v.hit[1]) ? 2 : 1;
    if (to - from == 2 && (want & CYLINT_WANT_NEAREST))
        to = 1;
    answer->n = to - from;
    for (int i = from; i < to; i++) {
        double part[LANES];
        v_store(part, v.part[i]);
        answer->part[i - from] = (int)part[0];
        answer->side[i - from] = first(v.leaving_first) ? !i : i;
    }
    const unsigned needs_t = CYLINT_WANT_T | CYLINT_WANT_POINT |
        CYLINT_WANT_NORMAL | CYLINT_WANT_Z | CYLINT_WANT_PHI;
    if (from == to || !(want & needs_t))
        return 1;
    return answer_roots(&q, &s, &l, kind, &v, from, to, want, answer);
}

/* The constants make a kernel of its own out of each call. */
int CYLINT_ONE(const cylint_shape *shape, const cylint_line *line,
               unsigned want, cylint_kernel_answer *answer)
{
    const int bounded = shape->ends < CYLINT_INFINITE;
    if (shape->ends == CYLINT_NAPPE && shape->kind != CYLINT_KIND_CYLINDER &&
        shape->kind != CYLINT_KIND_ECYLINDER)
        return 0;
#define KIND(kind) answer_one(shape, line, kind, bounded, want, answer)
    switch (shape->kind) {
    case CYLINT_KIND_CYLINDER:
        return KIND(CYLINT_KIND_CYLINDER);
    case CYLINT_KIND_CONE:
        return KIND(CYLINT_KIND_CONE);
    case CYLINT_KIND_ACONE:
        return KIND(CYLINT_KIND_ACONE);
    case CYLINT_KIND_ECYLINDER:
        return KIND(CYLINT_KIND_ECYLINDER);
    default:
        return KIND(CYLINT_KIND_ECONE);
    }
#undef KIND
}
