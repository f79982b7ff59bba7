/*
 * second_step.h - a second step of Newton's, with residuals in triples
 */
#ifndef CYLINT_SECOND_STEP_H
#define CYLINT_SECOND_STEP_H

#include "local_roots.h"

/* Where the second step begins: at the root of the first, or at the estimate if
 * the first may have led so far from the root that the slope differs there. */
INLINE vd second_start(const local_roots *r, const local_ends *at)
{
    const vd off = (r->error + v_abs(r->more)) * at->curvature;
    return v_select(v_le(off, v_set(CYLINT_LOCAL_NEAR) * v_abs(at->slope)),
                    r->value, at->t);
}

/* The step from `start`.  sizes: not less than any term of the residual. */
INLINE local_roots second_step(vd start, vd residual, vd sizes,
                               const cylint_shape *shape, const local_ends *at)
{
    const double error = shape->local.error;
    return stepped(start, residual,
                   v_set(CYLINT_LOCAL_TRIPLE * error * error) * sizes +
                       v_set(CYLINT_LOCAL_SCALING) * v_abs(residual),
                   at);
}

/* The roots of x in lanes of `which`, of y in others. */
INLINE local_roots merged(const local_roots *x, const local_roots *y,
                          unsigned which)
{
    const vm m = m_from(which);
    return (local_roots){v_select(m, x->value, y->value),
                         v_select(m, x->more, y->more),
                         v_select(m, x->error, y->error),
                         v_select(m, x->low, y->low),
                         v_select(m, x->high, y->high),
                         (x->nearest & which) | (y->nearest & ~which)};
}

#endif
