/*
 * forms.h - the forms over each arithmetic of single questions: bounded
 * doubles, doubles, sizes, quanta, bounded pairs and exact numbers
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
} ball;

static inline ball ball_add(ball x, ball y)
{
    return (ball){x.v + y.v, x.size + y.size};
}
static inline ball ball_sub(ball x, ball y)
{
    return (ball){x.v - y.v, x.size + y.size};
}
static inline ball ball_mul(ball x, ball y)
{
    return (ball){x.v * y.v, x.size * y.size};
}

#define INLINE static inline
#define NUM ball
#define FORM(name) name##_ball
#define ADD(x, y) ball_add(x, y)
#define SUB(x, y) ball_sub(x, y)
#define MUL(x, y) ball_mul(x, y)
#define MEMORY
#define BEGIN (void)L;
#define RETURN(x) return x;
#include "forms_template.h"

/* Doubles alone, and sizes alone, where one bound serves many. */
#define NUM double
#define FORM(name) name##_double
#define ADD(x, y) ((x) + (y))
#define SUB(x, y) ((x) - (y))
#define MUL(x, y) ((x) * (y))
#include "forms_template.h"

#define NUM double
#define FORM(name) name##_size
#define ADD(x, y) ((x) + (y))
#define SUB(x, y) ((x) + (y))
#define MUL(x, y) ((x) * (y))
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
} wide;

static inline wide wide_add(wide x, wide y)
{
    return (wide){pair_add(x.v, y.v),
                  x.off + y.off + (fabs(x.v.hi) + fabs(y.v.hi))};
}
static inline wide wide_sub(wide x, wide y)
{
    return wide_add(x, (wide){pair_neg(y.v), y.off});
}
static inline wide wide_mul(wide x, wide y)
{
    const double a = fabs(x.v.hi), b = fabs(y.v.hi);
    return (wide){pair_mul(x.v, y.v),
                  a * y.off + (b + CYLINT_PAIR_ROUNDING * y.off) * x.off +
                      a * b};
}

#undef INLINE
#define INLINE CYLINT_APART
#define NUM wide
#define FORM(name) name##_wide
#define ADD(x, y) wide_add(x, y)
#define SUB(x, y) wide_sub(x, y)
#define MUL(x, y) wide_mul(x, y)
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

static inline double ball_error(ball x)
{
    return CYLINT_FILTER_BOUND * x.size + CYLINT_UNDERFLOW;
}

static inline double wide_error(wide x)
{
    return CYLINT_PAIR_UNIT * x.off + CYLINT_UNDERFLOW;
}

#endif
