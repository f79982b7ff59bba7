/*
 * forms.h - the forms over each arithmetic of single questions: bounded
 * doubles, quanta, bounded pairs and exact numbers
 */
#ifndef CYLINT_FORMS_H
#define CYLINT_FORMS_H

#include "../numbers/bits.h"
#include "../numbers/error_bounds.h"
#include "../numbers/exact.h"
#include "../shapes/shape_facts.h"
#include "cylint.h"

/* ------------------------------------------- the three arithmetics ----- */

/* A double and the size of what was summed up to it (bounds.h). */
typedef struct {
    double v, size;
} bounded_double;

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
#define MEMORY
#define BEGIN (void)L;
#define RETURN(x) return x;
#include "forms_template.h"

/* The binary exponent of what a number is certainly a multiple of: the same
 * formulas over exponents.  A zero is a multiple of anything. */
static inline int quantum_add(int x, int y)
{
    return x < y ? x : y;
}
static inline int quantum_mul(int x, int y)
{
    return x + y;
}

#define NUM int
#define FORM(name) name##_quantum
#define ADD(x, y) quantum_add(x, y)
#define SUB(x, y) quantum_add(x, y)
#define MUL(x, y) quantum_mul(x, y)
#include "forms_template.h"

/* A pair of doubles and what its error is at most, in units of
 * CYLINT_PAIR_ROUNDING: unlike a size it stays small where sums cancel and are
 * squared.  x' and y' for x and y miss x y by x' (y' - y) + y (x' - x). */
typedef struct {
    pair v;
    double off;
} bounded_pair;

static inline bounded_pair bounded_pair_add(bounded_pair x, bounded_pair y)
{
    return (bounded_pair){pair_add(x.v, y.v),
                          x.off + y.off + (fabs(x.v.hi) + fabs(y.v.hi))};
}
static inline bounded_pair bounded_pair_sub(bounded_pair x, bounded_pair y)
{
    return bounded_pair_add(x, (bounded_pair){pair_neg(y.v), y.off});
}
static inline bounded_pair bounded_pair_mul(bounded_pair x, bounded_pair y)
{
    const double a = fabs(x.v.hi), b = fabs(y.v.hi);
    return (bounded_pair){
        pair_mul(x.v, y.v),
        a * y.off + (b + CYLINT_PAIR_ROUNDING * y.off) * x.off + a * b};
}

#undef INLINE
#define INLINE CYLINT_APART
#define NUM bounded_pair
#define FORM(name) name##_pair
#define ADD(x, y) bounded_pair_add(x, y)
#define SUB(x, y) bounded_pair_sub(x, y)
#define MUL(x, y) bounded_pair_mul(x, y)
#include "forms_template.h"
#undef MEMORY
#undef BEGIN
#undef RETURN

/* Every digit. */
#define NUM exact
#define FORM(name) name##_exact
#define ADD(x, y) cylint_exact_add(L->arena, x, y)
#define SUB(x, y) cylint_exact_add(L->arena, x, cylint_exact_neg(y))
#define MUL(x, y) cylint_exact_mul(L->arena, x, y)
#define MEMORY cylint_arena *arena;
#define BEGIN const int used_before = L->arena->used;
#define RETURN(x) return cylint_exact_keep(L->arena, used_before, x);
#include "forms_template.h"
#undef INLINE
#undef MEMORY
#undef BEGIN
#undef RETURN

static inline double bounded_error(bounded_double x)
{
    return CYLINT_FILTER_BOUND * x.size + CYLINT_UNDERFLOW;
}

static inline double bounded_pair_error(bounded_pair x)
{
    return CYLINT_PAIR_UNIT * x.off + CYLINT_UNDERFLOW;
}

#endif
