/*
 * forms.h - the forms over each arithmetic of single questions: bounded
 * doubles, bounded pairs and exact numbers
 */
#ifndef CYLINT_FORMS_H
#define CYLINT_FORMS_H

#include "../numbers/bits.h"
#include "../numbers/error_bounds.h"
#include "../numbers/exact.h"
#include "../shapes/shape_facts.h"
#include "cylint.h"

/* The forms whose signs decide, and the coefficients of roots.  ALPHA, E, N and
 * END_BALL are of one end. */
typedef enum {
    FORM_ALPHA,
    FORM_ROOT_OF_S,
    FORM_C,
    FORM_RHO0,
    FORM_BETA,
    FORM_RHO1,
    FORM_ALONG, /* u.w: on which side of the line's direction the axis points */
    FORM_E,     /* this and the next ones need the line's moments */
    FORM_N,
    FORM_G,
    FORM_A,
    FORM_B,
    FORM_T,        /* not of round kinds */
    FORM_END_BALL, /* round kinds only */
    CYLINT_FORMS
} cylint_form;

/* R = sqrt(S G), half the square root of the discriminant, over an arithmetic.
 * The argument S is form_root_of_S(): of kinds whose S is a square, its root. */
#define CYLINT_RADICAL(kind, S, G, MUL, SQRT) \
    (cylint_S_is_square(kind) ? MUL(S, SQRT(G)) : SQRT(MUL(S, G)))

/* A double, and the same computed from absolute values by sums only: its size
 * (error_bounds.h). */
typedef struct {
    double v, size;
} bounded_double;

static inline bounded_double bounded_of(double x)
{
    return (bounded_double){x, fabs(x)};
}
static inline bounded_double bounded_add(bounded_double x, bounded_double y)
{
    return (bounded_double){x.v + y.v, x.size + y.size};
}
static inline bounded_double bounded_sub(bounded_double x, bounded_double y)
{
    return (bounded_double){x.v - y.v, x.size + y.size};
}
static inline bounded_double bounded_mul(bounded_double x, bounded_double y)
{
    return (bounded_double){x.v * y.v, x.size * y.size};
}

#define INLINE static inline
#define NUM bounded_double
#define FORM(name) name##_bounded
#define ADD(x, y) bounded_add(x, y)
#define SUB(x, y) bounded_sub(x, y)
#define MUL(x, y) bounded_mul(x, y)
#define DATUM(x) bounded_of(x)
#define DIFFERENCE(x, y) bounded_of((x) - (y))
#define DIRECTION(l, i) bounded_of(l->d[i])
#include "forms_template.h"

/*
 * The error of a bounded pair (double_double.h) is the sum of all that the
 * operations on the way lost, times the factors that followed.  Every operation is
 * a sum of doubles, whose low parts are exact in rounding to nearest; it returns
 * the two largest and counts the rest.  So an error of 0 proves that nothing was
 * lost, unless something underflowed, and unlike a size the error stays small when
 * a sum that cancels is squared.  With x' for x and y' for y the error of x y is
 * x' (y' - y) + y (x' - x).
 */
static inline bounded_pair bounded_pair_add(bounded_pair x, bounded_pair y)
{
    const pair high = two_sum(x.v.hi, y.v.hi);
    if (x.v.lo == 0 && y.v.lo == 0)
        return (bounded_pair){high, x.error + y.error};
    const pair low = two_sum(x.v.lo, y.v.lo), middle = two_sum(high.lo, low.hi);
    return (bounded_pair){two_sum(high.hi, middle.hi),
                          x.error + y.error + (fabs(low.lo) + fabs(middle.lo))};
}
static inline bounded_pair bounded_pair_sub(bounded_pair x, bounded_pair y)
{
    return bounded_pair_add(x, (bounded_pair){pair_neg(y.v), y.error});
}
static inline bounded_pair bounded_pair_mul(bounded_pair x, bounded_pair y)
{
    const double a = fabs(x.v.hi), b = fabs(y.v.hi);
    const double error = a * y.error + (b + y.error) * x.error;
    const pair high = two_prod(x.v.hi, y.v.hi);
    if (x.v.lo == 0 && y.v.lo == 0)
        return (bounded_pair){high, error};
    const pair xy = two_prod(x.v.hi, y.v.lo), yx = two_prod(x.v.lo, y.v.hi);
    const pair low = two_sum(xy.hi, yx.hi), middle = two_sum(high.lo, low.hi);
    const double dropped = fabs(xy.lo) + fabs(yx.lo) + fabs(low.lo) +
                           fabs(middle.lo) + fabs(x.v.lo * y.v.lo);
    return (bounded_pair){two_sum(high.hi, middle.hi), error + dropped};
}

static inline bounded_pair bounded_pair_of(double hi, double lo)
{
    return (bounded_pair){{hi, lo}, 0};
}

static inline bounded_pair bounded_pair_difference(double x, double y)
{
    return (bounded_pair){two_diff(x, y), 0};
}

#undef INLINE

/* Large and rarely needed: sign.c defines these once. */
#define INLINE
#define FORMS_DECLARED
#define FORM(name) cylint_##name##_pair
#include "forms_template.h"

#define FORMS_DECLARED
#define FORMS_OF_HITS
#define NUM exact
#define FORM(name) cylint_##name##_exact
#define MEMORY cylint_arena *arena;
#include "forms_template.h"
#undef INLINE

static inline double bounded_error(bounded_double x)
{
    return CYLINT_FILTER_BOUND * x.size + CYLINT_UNDERFLOW;
}

static inline double bounded_pair_error(bounded_pair x)
{
    return CYLINT_SLACK * x.error + CYLINT_UNDERFLOW;
}

#endif
