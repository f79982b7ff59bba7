/*
 * local_steps.h - residuals in pairs with their errors, and Newton's step, for
 * one line and for many
 *
 * In local coordinates, in lanes of any number.  The bounds are those of
 * error_bounds.h.
 */
#ifndef CYLINT_LOCAL_STEPS_H
#define CYLINT_LOCAL_STEPS_H

#include "../numbers/error_bounds.h"
#include "../numbers/simd.h"
#include "../shapes/shape_facts.h"

/* 1 + |slope|: bounds what a slope adds to the errors. */
INLINE double taper_of(const cylint_shape *shape, int tapered)
{
    return tapered ? 1 + fabs(shape->local.slope) : 1;
}

INLINE double widest_of(const cylint_shape *shape, int tapered)
{
    return tapered ? cylint_larger(shape->r0, shape->r1) : shape->r0;
}

INLINE vpair twice(double hi, double lo)
{
    return (vpair){v_set(hi), v_set(lo)};
}

/* z + t w in pairs. */
INLINE vpair moved(vpair z, vpair w, vd t)
{
    vpair step = v_two_prod(t, w.hi);
    step.lo = v_sum_of(t, w.lo, step.lo);
    return vpair_add(z, step);
}

/* x^2.  x.lo may be larger than a rounding of x.hi. */
INLINE vpair vpair_square(vpair x)
{
    const vpair square = v_two_prod(x.hi, x.hi);
    return (vpair){square.hi, v_sum_of(x.hi + x.hi + x.lo, x.lo, square.lo)};
}

/* z + t w, rounded: the error is relative to it, but for that of z and w. */
INLINE vd height_at(vpair z, vpair w, vd t)
{
    const vd low = v_sum_of(t, w.lo, z.lo);
#if V_HAS_FMA
    return v_fma(t, w.hi, z.hi) + low;
#else
    const vpair step = v_two_prod(t, w.hi);
    return (z.hi + step.hi) + (step.lo + low);
#endif
}

/* Not less than any coordinate at t. */
INLINE vd size_at(vd t, double Q, double D)
{
    return v_sum_of(v_abs(t), v_set(D), v_set(Q));
}

/* The errors of height_at() and of lateral_at(). */
INLINE vd height_error(vd size, const cylint_shape *shape)
{
    return v_set(CYLINT_LOCAL_RESIDUAL * shape->local.error) * size;
}

INLINE vd lateral_error(vd size, vd across, const cylint_shape *shape,
                        int tapered)
{
    const vd most = v_set(taper_of(shape, tapered)) * size;
    const vd off = height_error(most, shape);
    return off * v_sum_of(v_set(CYLINT_LOCAL_UNTRIMMED), most, across + off);
}

/* What Newton's step leads to: root.hi + root.lo with the error; low and high are
 * bounds that are rounded.  nearest: root.hi is certainly the nearest double. */
typedef struct {
    vpair root;
    vd error, low, high;
    vm nearest;
} rounded_step;

#define FORM(name) name##_local
#define NEWTON_INLINE INLINE
#define NUM vd
#define ABS(x) v_abs(x)
#define CONSTANT(x) v_set(x)
#define SUM_OF(x, y, z) v_sum_of(x, y, z)
#define QUOTIENT(x, y, inverse) ((x) * (inverse))
#define SLACK CYLINT_LOCAL_SLACK
#include "../roots/newton_template.h"

/* From t.  slope: of the residual at t; inverse: 1 / slope; curvature: half of
 * the residual's.  The difference of t and the step has no error or, where the
 * step is larger than t, one rounding of it. */
INLINE rounded_step step_from(vd t, vd residual, vd residual_error, vd slope,
                              vd inverse, vd slope_error, vd curvature)
{
    /* in multiples of CYLINT_LOCAL_DISTANCE, the curvature in its square */
    const vd distance =
        v_sum_of(residual_error, v_abs(inverse), v_abs(residual * inverse));
    const newton_local step = newton_step_local(
        residual, residual_error, slope, slope_error,
        v_set(CYLINT_LOCAL_DISTANCE * CYLINT_LOCAL_DISTANCE) * curvature,
        distance);
    const vd hi = t - step.delta;
    const vpair r = {hi, (t - hi) - step.delta};
    const vd low = r.hi + (r.lo - step.error);
    const vd high = r.hi + (r.lo + step.error);
    const vd size = v_abs(r.hi);
    const vm in_range = m_and(v_lt(size, v_set(1 / CYLINT_ROOT_LEAST)),
                              v_lt(v_set(CYLINT_ROOT_LEAST), size));
    return (rounded_step){
        r, step.error, low, high,
        m_and(m_and(v_eq(low, r.hi), v_eq(high, r.hi)), in_range)};
}

#endif
