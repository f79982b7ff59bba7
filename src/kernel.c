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

/* Both stops, rounded or as they are. */
typedef struct {
    double t[2], more[2], error[2];
    unsigned sure; /* bits 0 and 1 */
} both_roots;

INLINE unsigned first(vm m)
{
    return m_bits(m) & 1;
}

INLINE void store_roots(both_roots *to, lanes_root r0, lanes_root r1)
{
    v_store_firsts(to->t, r0.value, r1.value);
    v_store_firsts(to->more, r0.more, r1.more);
    v_store_firsts(to->error, r0.error, r1.error);
    to->sure = first(r0.sure) | first(r1.sure) << 1;
}

INLINE void take_both(both_roots *to, const lanes_query *q,
                      const lanes_verdict *v)
{
    store_roots(to, take_root(q, v->stop[0]), take_root(q, v->stop[1]));
}

/* In two lanes at once where there are two. */
INLINE void round_both(both_roots *to, const lanes_query *q,
                       const lanes_shape *s, const lanes_line *l, int kind,
                       const lanes_verdict *v)
{
    const vd plus = v_set(1), minus = v_set(-1);
    const vd exits = v_select(v->leaving_first, plus, minus);
#if LANES == 2
    const bounded_value t = {v_firsts(v->stop[0].v, v->stop[1].v),
                             v_firsts(v->stop[0].e, v->stop[1].e)};
    const lanes_root r = round_root(q, s, l, kind, v_firsts(exits, -exits), t,
                                    v_firsts(v->part[0], v->part[1]));
    v_store(to->t, r.value);
    v_store(to->more, r.more);
    v_store(to->error, r.error);
    to->sure = m_bits(r.sure);
#else
    store_roots(to, round_root(q, s, l, kind, exits, v->stop[0], v->part[0]),
                round_root(q, s, l, kind, -exits, v->stop[1], v->part[1]));
#endif
}

INLINE int answer_one(const cylint_shape *shape,
                             const cylint_line *line, int kind, int bounded,
                             unsigned want, cylint_kernel_answer *answer)
{
    const unsigned needs_t = CYLINT_WANT_T | CYLINT_WANT_POINT |
        CYLINT_WANT_NORMAL | CYLINT_WANT_Z | CYLINT_WANT_PHI;
    lanes_shape s;
    lanes_line l;
    lanes_query q;
    broadcast_shape(&s, shape, kind);
    broadcast_line(&l, line);
    const lanes_verdict v = lanes_judge(&q, &s, &l, kind, bounded,
                                        m_from((1u << LANES) - 1));
    if (m_any(v.undecided))
        return 0;
    unsigned hits = first(v.hit[0]) | first(v.hit[1]) << 1;
    if (want & CYLINT_WANT_NEAREST && hits & 1)
        hits = 1;
    answer->relation = first(v.cross) ? CYLINT_CROSS : CYLINT_MISS;
    answer->n = (int)(hits & 1) + (int)(hits >> 1);
    if (!hits)
        return 1;
    both_roots roots = {{0, 0}, {0, 0}, {0, 0}, 0};
    if (want & needs_t && want & CYLINT_WANT_FAST)
        take_both(&roots, &q, &v);
    if (want & needs_t && hits & ~roots.sure) {
        both_roots rounded;
        if (!cylint_rounds_to_nearest()) /* would certify nothing */
            return 0;
        round_both(&rounded, &q, &s, &l, kind, &v);
        if (hits & ~(roots.sure | rounded.sure))
            return 0;
        EACH(i, 2) {
            if (roots.sure >> i & 1)
                continue;
            roots.t[i] = rounded.t[i];
            roots.more[i] = rounded.more[i];
            roots.error[i] = rounded.error[i];
        }
    }
    double part[2];
    v_store_firsts(part, v.part[0], v.part[1]);
    int n = 0;
    EACH(i, 2) {
        if (!(hits >> i & 1))
            continue;
        answer->part[n] = (int)part[i];
        answer->side[n] = first(v.leaving_first) ? !i : i;
        answer->t[n] = roots.t[i];
        answer->more[n] = roots.more[i];
        answer->error[n] = roots.error[i];
        n++;
    }
    return 1;
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
