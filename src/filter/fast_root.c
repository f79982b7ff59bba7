/*
 * fast_root.c - what the fast mode answers for one root
 *
 * The fast t of a root is a function of the line, the shape and the root: the
 * quotient in doubles where its error is certainly small enough, else the
 * double nearest to the root.  So it does not depend on whether a lane, a
 * single question or the exact signs led to it.  Here is the quotient for
 * roots that the exact signs led to, in one lane.
 */
#define CYLINT_ONE_LANE
#include "lanes.h"
#include "filter.h"

static bounded_value lateral_root(lanes_query *q, int kind, int exits, vm *sure)
{
    const bounded_value G =
        with_bound(form_G_lanes(&q->L), form_G_sizes(&q->N));
    *sure = m_not(lateral_quadratic(q, G, kind));
    return quotient(lateral_numerator(q, exits ? 1 : -1), q->A);
}

static bounded_value plane_root(lanes_query *q, int cap, vm *sure)
{
    const bounded_value beta = with_bound(q->L.beta, form_beta_sizes(&q->N));
    const bounded_value alpha =
        with_bound(-form_alpha_lanes(&q->L, cap), form_alpha_sizes(&q->N, 0));
    q->R = q->A = beta;
    *sure = certain(beta);
    return quotient(alpha, beta);
}

int cylint_fast_root(const cylint_shape *shape, const cylint_line *line,
                     int part, int exits, double *t)
{
    const int kind = shape->kind;
    lanes_query q;
    lanes_shape s;
    lanes_line l;
    vm sure;
    if (!shape->in_range || !line->in_range || cylint_is_nappe(shape))
        return 0;
    broadcast_shape(&s, shape);
    broadcast_line(&l, line);
    load_terms(&q, &s, &l, kind, cylint_ends_are_planes(shape->ends));
    if (!lanes_in_window(&q, kind))
        return 0;
    const bounded_value root =
        part == CYLINT_PART_LATERAL
            ? lateral_root(&q, kind, exits, &sure)
            : plane_root(&q, part == CYLINT_PART_CAP1, &sure);
    *t = root.v;
    return sure && fast_enough(root, q.N.D[0][0], q.N.u[0]);
}
