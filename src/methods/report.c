/*
 * report.c - writes a chord as a cylint_answer, as cylint_intersect() does
 *
 * The relation is the whole line's.  The hits are the ends of the chord, in
 * ascending order, that lie on a present part and in the line's domain.
 */
#include "methods.h"

static void refuse(cylint_answer *answer)
{
    answer->relation = CYLINT_RELATION_MISS;
    answer->n = 0;
    answer->flags = CYLINT_FLAG_INVALID;
}

cylint_status cylint_method_not_applicable(cylint_answer *answer)
{
    refuse(answer);
    return CYLINT_EMETHOD;
}

static void add_hit(const cylint_shape *shape, const cylint_line *line,
                    unsigned want, double t, int part, int side,
                    cylint_answer *answer)
{
    if (!(t > -INFINITY && t < INFINITY)) /* the chord has no end, or NaN */
        return;
    if (!(t >= line->tmin && t <= line->tmax) ||
        !cylint_part_is_present(shape->ends, part))
        return;
    if (answer->n == 1 && (want & CYLINT_WANT_NEAREST))
        return;
    cylint_method_hit(shape, line, want, t, part, side,
                      &answer->hit[answer->n]);
    answer->n++;
}

cylint_status cylint_method_report(const cylint_shape *shape,
                                   const cylint_line *line, unsigned want,
                                   const cylint_method_chord *chord,
                                   cylint_answer *answer)
{
    if (!line->valid) {
        refuse(answer);
        return CYLINT_OK;
    }
    answer->relation = chord->relation;
    answer->n = 0;
    answer->flags = 0;
    if (chord->relation == CYLINT_RELATION_MISS)
        return CYLINT_OK;

    const int one_point = chord->relation == CYLINT_RELATION_TOUCH ||
                          (chord->gap && chord->t[0] == chord->t[1]);
    const int first = one_point    ? CYLINT_SIDE_BOTH
                      : chord->gap ? CYLINT_SIDE_LEAVING
                                   : CYLINT_SIDE_ENTERING;
    const int second = chord->gap ? CYLINT_SIDE_ENTERING : CYLINT_SIDE_LEAVING;
    add_hit(shape, line, want, chord->t[0], chord->part[0], first, answer);
    if (!one_point)
        add_hit(shape, line, want, chord->t[1], chord->part[1], second, answer);
    return CYLINT_OK;
}
