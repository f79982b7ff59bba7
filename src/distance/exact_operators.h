/*
 * exact_operators.h - sums and products of exact numbers in the arena of a
 * meridian *m
 *
 * A function that begins with BEGIN and ends with RETURN(x) leaves only x in the
 * arena.
 */
#ifndef CYLINT_EXACT_OPERATORS_H
#define CYLINT_EXACT_OPERATORS_H

#include "exact_distance.h"

#define ADD(x, y) cylint_exact_add(m->arena, x, y)
#define SUB(x, y) cylint_exact_add(m->arena, x, cylint_exact_neg(y))
#define MUL(x, y) cylint_exact_mul(m->arena, x, y)
#define BEGIN const int used_before = m->arena->used;
#define RETURN(x) return cylint_exact_keep(m->arena, used_before, x);

static inline exact dot(meridian *m, const exact x[3], const exact y[3])
{
    BEGIN
    exact sum = ADD(ADD(MUL(x[0], y[0]), MUL(x[1], y[1])), MUL(x[2], y[2]));
    RETURN(sum)
}

#endif
