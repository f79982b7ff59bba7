/*
 * hard_question.c - one line and one shape, where doubles do not decide
 *
 * The line is nearly tangent, or nearly parallel to the axis, or it passes near
 * a rim: then the forms are computed in pairs.  Or a root is not certainly
 * rounded by a residual in pairs, as the root near 0 of a line that begins on
 * the surface: then its residual is computed in triples.
 */
#define CYLINT_NARROW
#include "local_roots.h"
#include "residual_in_triples.h"
#include "second_step.h"

#ifndef CYLINT_HARD
#define CYLINT_HARD cylint_hard_plain
#define CYLINT_HARD_ROUND cylint_hard_round_plain
#endif

#if LANES == 2

/* Corrects the roots in lanes of `which` by a second step, with residuals in
 * triples. */
INLINE void correct_ends(local_roots *r, const local_line *l,
                         const local_verdict *v, const cylint_shape *shape,
                         const cylint_line *line, const local_ends *at,
                         unsigned which)
{
    const vd start = second_start(r, at);
    double t[2], residual[2] = {0, 0};
    v_store(t, start);
    EACH(i, 2)
        if (which >> i & 1)
            residual[i] = residual_in_triples(
                shape, line, t[i], v->pierced >> i & 1 ? i : -1, shape->kind);
    const vd size = size_at(start, l, shape, 1);
    *r = second_step(start, v_load(residual),
                     v_select(at->cap, size, size * size), shape, at);
}

/* By the roots. */
INLINE int answer_from(const local_line *l, const local_verdict *v,
                       const local_quadratic *q, ARGUMENTS, int tapered,
                       int bounded)
{
    if (bounded && (v->pierced | v->spared) != 3)
        return CYLINT_UNDECIDED;
    const local_ends at = estimate_ends(l, v, q, tapered, bounded);
    if (at.usable != 3)
        return CYLINT_UNDECIDED;
    local_roots r = round_ends(l, v, shape, line, &at, tapered);
    const unsigned which = 3 & ~r.nearest & ~roots_outside(&r, line);
    if (want & CYLINT_WANT_T && which) {
        const local_roots kept = r;
        correct_ends(&r, l, v, shape, line, &at, which);
        r = merged(&r, &kept, which);
    }
    return accept_roots(&r, at.first, parts_of(v), shape, line, want, answer,
                        rest, bounded);
}

int CYLINT_HARD(ARGUMENTS)
{
    const int tapered = cylint_is_tapered(shape->kind);
    const int bounded = cylint_ends_are_planes(shape->ends);
    int n = CYLINT_UNDECIDED;
    local_line l;
    if (cylint_is_round(shape->kind))
        return CYLINT_HARD_ROUND(shape, line, want, answer, rest);
    if (cylint_is_nappe(shape) || !cylint_rounds_to_nearest())
        return CYLINT_UNDECIDED;
    load_local(&l, shape, line, tapered);
    for (int in_pairs = 0; in_pairs < 2 && n == CYLINT_UNDECIDED; in_pairs++) {
        local_quadratic q;
        local_verdict v;
        if (in_pairs) {
            v = classify_in_pairs(&l, &q, shape, line, tapered, bounded);
        } else {
            v = classify(&l, shape, tapered, bounded);
            q = quadratic_of(&l, shape, tapered);
        }
        answer->relation = v.crosses * CYLINT_RELATION_CROSS;
        if (v.misses)
            return answer->n = 0;
        if (v.crosses)
            n = answer_from(&l, &v, &q, shape, line, want, answer, rest,
                            tapered, bounded);
    }
    return n;
}

#else

/* Without vectors of two lanes. */
int CYLINT_HARD(ARGUMENTS)
{
    return cylint_undecided(shape, line, want, answer, rest);
}

#endif
