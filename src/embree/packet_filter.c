/*
 * packet_filter.c - the float filter, one question in each vector lane
 *
 * Compiled for several instruction sets; operations may be fused, as in
 * float_filter.c.
 */
#include "packet_filter.h"

#include "../shapes/shape_facts.h"
#include "float_filter_lanes.h"

#ifndef CYLINT_PACKET_FILTER
#define CYLINT_PACKET_FILTER cylint_packet_filter_plain
#endif

typedef struct {
    const char *shape[LANES], *line[LANES];
    vm cap[2], used; /* used: lanes with a question */
} question_rows;

static question_rows load_rows(const cylint_float_filter_target *target,
                               const cylint_float_filter_ray *const *line,
                               int n)
{
    question_rows r;
    unsigned cap[2] = {0, 0};
    for (int i = 0; i < LANES; i++) {
        const int k = i < n ? i : 0; /* unused lanes repeat the first */
        r.shape[i] = target[k].shape;
        r.line[i] = (const char *)line[k];
        for (int top = 0; top < 2; top++)
            cap[top] |= (cylint_caps_present(target[k].ends) >> top & 1) << i;
    }
    r.cap[0] = m_from(cap[0]);
    r.cap[1] = m_from(cap[1]);
    r.used = m_from((1u << (n < LANES ? n : LANES)) - 1);
    return r;
}

static vm describe_hits(const question *q, const hit *at, int from,
                        cylint_packet_filter_results *to)
{
    vm least[3];
    floats f;
    const vm known = least_components(q, least);
    const vm certain = m_and(known, describe_lanes(q, at, least, &f));
    v_store(to->float_z + from, f.z);
    v_store(to->phi + from, f.phi);
    EACH(j, 3)
        v_store(to->normal[j] + from, f.normal[j]);
    return certain;
}

static void answer_lanes(const question_rows *r, int small, int from,
                         int describe, cylint_packet_filter_results *to)
{
    const shape_columns shape = shape_of(r->shape, small);
    const line_columns line = line_of(r->line);
    question q;
    hit at;
    q.cap[0] = r->cap[0];
    q.cap[1] = r->cap[1];
    const hit_result comes = load_and_cross(&q, &shape, &line);
    to->uncertain |= m_bits(m_and(comes.uncertain, r->used)) << from;
    if (!m_any(comes.hit))
        return;
    const hit_result is = hit_at_end(&q, 0, &at);
    const vm hits = m_and(is.hit, r->used);
    to->hit |= m_bits(hits) << from;
    to->uncertain |= m_bits(m_and(is.uncertain, r->used)) << from;
    to->crosses |= m_bits(m_and(q.crosses, r->used)) << from;
    v_store(to->t + from, at.t);
    v_store(to->t_error + from, at.t_error);
    v_store(to->z + from, at.z);
    v_store(to->z_error + from, at.z_error);
    if (describe && m_any(hits))
        to->described |= m_bits(m_and(hits, describe_hits(&q, &at, from, to)))
                         << from;
}

void CYLINT_PACKET_FILTER(const cylint_float_filter_target target[],
                          const cylint_float_filter_ray *const line[], int n,
                          int describe, cylint_packet_filter_results *to)
{
    to->hit = to->uncertain = to->crosses = to->described = 0;
    for (int from = 0; from < n; from += LANES) {
        const question_rows r = load_rows(target + from, line + from, n - from);
        answer_lanes(&r, target[0].small, from, describe, to);
    }
}
