/*
 * exact_operators.h - sums and products of exact numbers in the arena of a
 * meridian *m
 *
 * A function that begins with EXACT_BEGIN and ends with EXACT_RETURN(x) leaves
 * only x in the arena.
 */
#ifndef CYLINT_EXACT_OPERATORS_H
#define CYLINT_EXACT_OPERATORS_H

#include "exact_distance.h"

#define EXACT_ADD(x, y) cylint_exact_add(m->arena, x, y)
#define EXACT_SUB(x, y) cylint_exact_sub(m->arena, x, y)
#define EXACT_MUL(x, y) cylint_exact_mul(m->arena, x, y)
#define EXACT_BEGIN const int used_before = m->arena->used;
#define EXACT_RETURN(x) return cylint_exact_keep(m->arena, used_before, x);

/* a / d */
static inline surd_quotient exact_quotient(const meridian *m, exact a, exact d)
{
    const exact zero = cylint_exact_zero(m->arena);
    return (surd_quotient){{a, zero, zero}, d};
}

/* W (g + dr^2). */
static inline exact exact_unit(meridian *m)
{
    EXACT_BEGIN
    exact x = EXACT_MUL(m->L->vv, EXACT_ADD(m->g, EXACT_MUL(m->dr, m->dr)));
    EXACT_RETURN(x)
}

#endif
