/*
 * rounded_distance.c - the double nearest to a distance
 *
 * The square of the distance is (a + b sqrt(c)) / d, so whether the
 * distance is above the middle of two doubles is the sign of another surd_sum.
 */
#include "error_bounds.h"
#include "exact_distance.h"

/* The sign of the distance minus the middle of the double of this rank and the
 * next. */
static int sign_at_middle(meridian *m, const surd_quotient *x, int64_t rank)
{
    const int used = m->arena->used;
    const exact four = cylint_exact_from(m->arena, 4);
    const exact sum = EXACT_ADD(cylint_exact_of_rank(m->arena, rank),
                                cylint_exact_of_rank(m->arena, rank + 1));
    const exact square = EXACT_MUL(EXACT_MUL(sum, sum), x->d);
    const surd_sum at = {EXACT_SUB(EXACT_MUL(four, x->n.a), square),
                         EXACT_MUL(four, x->n.b), x->n.c};
    return cylint_only_sign(m->arena, used,
                            cylint_surd_sum_sign(m->arena, &at));
}

/* The rank of the double nearest to d (1 + error). */
static int64_t nearest_rank(meridian *m, floating d, double error)
{
    const int used = m->arena->used;
    const exact low = cylint_exact_from(m->arena, d.v.lo),
                more = cylint_exact_from(m->arena, d.v.hi * error);
    const exact sum =
        EXACT_ADD(cylint_exact_from(m->arena, d.v.hi), EXACT_ADD(low, more));
    m->arena->used = used;
    return cylint_rank(cylint_exact_nearest(sum, d.e));
}

double cylint_rounded_distance(meridian *m, int feature)
{
    const int used = m->arena->used;
    const surd_quotient x = cylint_square_of_distance(m, feature);
    const floating square = cylint_surd_quotient_value(m->arena, &x);
    double distance = 0;
    if (square.v.hi > 0) {
        const double error = cylint_rounds_to_nearest()
                                 ? CYLINT_SURD_ERROR
                                 : CYLINT_DIRECTED_SURD_ERROR;
        const floating d = cylint_floating_sqrt(square);
        int64_t low = nearest_rank(m, d, -error);
        int64_t high = nearest_rank(m, d, error);
        while (low < high) {
            /* mutant '2' -> '3': slower, any rank between both is right */
            const int64_t middle = low + (high - low) / 2;
            const int sign = sign_at_middle(m, &x, middle);
            if (sign == 0) /* a tie, to even */
                low = high = middle + (middle & 1);
            else if (sign > 0)
                low = middle + 1;
            else
                high = middle;
        }
        /* 0 is on the surface */
        /* mutant '0' -> '1': a rank of 1 gives 1 in both cases */
        distance = cylint_from_bits(low > 0 ? (uint64_t)low : 1);
    }
    m->arena->used = used;
    return distance;
}
