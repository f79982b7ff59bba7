/*
 * packet_filter.c - a hit in doubles, where doubles are certain of it: a question
 * a lane
 *
 * Compiled for several instruction sets, contracted as float_filter.c is.
 */
#include "packet_filter.h"

#include "float_filter_lanes.h"

#ifndef CYLINT_PACKET_FILTER
#define CYLINT_PACKET_FILTER cylint_packet_filter_plain
#endif

typedef struct {
    const char *shape[LANES], *line[LANES];
    vm cap[2], some; /* that there are */
} rows;

static rows rows_of(const cylint_float_filter_target *subject,
                    const cylint_float_filter_ray *const *line, int n)
{
    rows r;
    unsigned cap[2] = {0, 0};
    for (int i = 0; i < LANES; i++) {
        const int k = i < n ? i : 0; /* lanes to spare ask the first again */
        r.shape[i] = subject[k].shape;
        r.line[i] = (const char *)line[k];
        for (int top = 0; top < 2; top++)
            cap[top] |=
                (unsigned)cylint_float_filter_has_cap(subject[k].ends, top)
                << i;
    }
    r.cap[0] = m_from(cap[0]);
    r.cap[1] = m_from(cap[1]);
    r.some = m_from((1u << (n < LANES ? n : LANES)) - 1);
    return r;
}

static vm describe(const question *q, const hit *at, int from,
                   cylint_packet_filter_results *to)
{
    vm least[3];
    floats f;
    const vm known = least_components(q, least);
    const vm sure = m_and(known, describe_lanes(q, at, least, &f));
    v_store(to->float_z + from, f.z);
    v_store(to->phi + from, f.phi);
    EACH(j, 3)
        v_store(to->normal[j] + from, f.normal[j]);
    return sure;
}

static void answer(const rows *r, int small, int from, int describes,
                   cylint_packet_filter_results *to)
{
    const cut_shape shape = shape_of(r->shape, small);
    const cut_line line = line_of(r->line);
    question q;
    hit at;
    q.cap[0] = r->cap[0];
    q.cap[1] = r->cap[1];
    const verdict comes = crosses(&q, &shape, &line);
    to->unsure |= m_bits(m_and(comes.unsure, r->some)) << from;
    if (!m_any(comes.hit))
        return;
    const verdict is = stop(&q, 0, &at);
    const vm hits = m_and(is.hit, r->some);
    to->hit |= m_bits(hits) << from;
    to->unsure |= m_bits(m_and(is.unsure, r->some)) << from;
    to->crosses |= m_bits(m_and(q.crosses, r->some)) << from;
    v_store(to->t + from, at.t);
    v_store(to->t_error + from, at.t_error);
    v_store(to->z + from, at.z);
    v_store(to->z_error + from, at.z_error);
    if (describes && m_any(hits))
        to->described |= m_bits(m_and(hits, describe(&q, &at, from, to)))
                         << from;
}

void CYLINT_PACKET_FILTER(const cylint_float_filter_target subject[],
                          const cylint_float_filter_ray *const line[], int n,
                          int describe, cylint_packet_filter_results *to)
{
    to->hit = to->unsure = to->crosses = to->described = 0;
    for (int from = 0; from < n; from += LANES) {
        const rows r = rows_of(subject + from, line + from, n - from);
        answer(&r, subject[0].small, from, describe, to);
    }
}
