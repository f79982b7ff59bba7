/*
 * one_question.c - one line and one shape: verdicts by signs, roots two at a
 * time
 *
 * Compiled once as it is and again for processors with a fused multiply-add:
 * the answers are the same bits.  Verdicts need no root (local_lines.h).  What
 * is left undecided here is computed by hard_question.c.
 */
#define CYLINT_NARROW
#include "local_roots.h"

#ifndef CYLINT_ONE
#define CYLINT_ONE cylint_one_plain
#define CYLINT_HARD cylint_hard_plain
#endif

#ifndef CYLINT_ROUND
#define CYLINT_ROUND plain
#endif

#define NEITHER                            \
    {                                      \
        cylint_undecided, cylint_undecided \
    }

#define UNDECIDED                                            \
    {                                                        \
        NEITHER, NEITHER, NEITHER, NEITHER, NEITHER, NEITHER \
    }

#if LANES == 2

/* The lane of the end with the lesser t. */
INLINE int first_lane(const local_line *l, const cylint_shape *shape,
                      int tapered, int bounded)
{
    if (bounded)
        return !(l->w > 0);
    return tapered && quadratic_of(l, shape, 1).A < 0;
}

/* The lanes of the ends in the domain, by signs; or CYLINT_UNDECIDED. */
INLINE int ends_in_domain(const local_line *l, const local_verdict *v,
                          const cylint_shape *shape, const cylint_line *line,
                          int first, int tapered, int bounded)
{
    const int from = local_state(l, v, shape, line->tmin, tapered, bounded);
    const int to = local_state(l, v, shape, line->tmax, tapered, bounded);
    return ends_between(from, to, first);
}

/* Returns 0 if G shows that the line misses, which *answer then says, else 1. */
INLINE int begins_by_roots(local_line *l, local_verdict *v, ARGUMENTS,
                           int tapered)
{
    (void)want;
    (void)rest;
    load_local(l, shape, line, tapered);
    answer->relation = CYLINT_RELATION_MISS;
    answer->n = 0;
    return !classify_by_G(v, l, shape, tapered);
}

/* From there on. */
INLINE int ends_by_roots(const local_line *l, local_verdict v, ARGUMENTS,
                         int tapered, int bounded)
{
    classify_rest(&v, l, shape, tapered, bounded);
    if (v.misses)
        return 0;
    if (__builtin_expect(!v.crosses, 0) ||
        (bounded && (v.pierced | v.spared) != 3) || !cylint_rounds_to_nearest())
        return CYLINT_UNDECIDED;
    answer->relation = CYLINT_RELATION_CROSS;
    const local_quadratic q = quadratic_of(l, shape, tapered);
    const local_ends at = estimate_ends(l, &v, &q, tapered, bounded);
    if (at.usable != 3)
        return CYLINT_UNDECIDED;
    const local_roots r = round_ends(l, &v, shape, line, &at, tapered);
    return accept_roots(&r, at.first, parts_of(&v), shape, line, want, answer,
                        rest, bounded);
}

INLINE int answer_by_signs(const cylint_shape *shape, const cylint_line *line,
                           unsigned want, cylint_answer *answer, int tapered,
                           int bounded)
{
    local_line l;
    load_local(&l, shape, line, tapered);
    const local_verdict v = classify(&l, shape, tapered, bounded);
    answer->relation = v.crosses * CYLINT_RELATION_CROSS;
    answer->n = 0;
    if (v.misses)
        return 0;
    if (__builtin_expect(!v.crosses, 0))
        return CYLINT_UNDECIDED;
    const int closed = shape->ends == CYLINT_ENDS_CAPPED || !bounded;
    const int plain = closed && !(want & CYLINT_WANT_PART);
    if (plain && want & CYLINT_WANT_NEAREST && line->tmin <= 0 &&
        line->tmax > DBL_MAX && is_ahead(&l, &v, shape, tapered, bounded))
        return answer->n = 1;
    if (!plain && bounded && (v.pierced | v.spared) != 3)
        return CYLINT_UNDECIDED;
    const int first = first_lane(&l, shape, tapered, bounded);
    const int in = ends_in_domain(&l, &v, shape, line, first, tapered, bounded);
    if (in == CYLINT_UNDECIDED)
        return CYLINT_UNDECIDED;
    const unsigned hits = wanted_hits(
        (unsigned)in & (closed ? 3 : ends_present(parts_of(&v), shape)), want,
        first);
    if (want & CYLINT_WANT_PART)
        write_parts(answer, parts_of(&v), hits, first, bounded);
    return answer->n = (int)(hits & 1) + (int)(hits >> 1);
}

/* A kernel of its own for each: tapered or not, bounded or not, with roots or
 * by signs. */
#define KERNELS(name, tapered, bounded)                                       \
    ASIDE int crossing_##name(const local_line *l, const local_verdict *v,    \
                              ARGUMENTS)                                      \
    {                                                                         \
        return ends_by_roots(l, *v, shape, line, want, answer, rest, tapered, \
                             bounded);                                        \
    }                                                                         \
    static int roots_##name(ARGUMENTS)                                        \
    {                                                                         \
        local_line l;                                                         \
        local_verdict v;                                                      \
        if (!begins_by_roots(&l, &v, shape, line, want, answer, rest,         \
                             tapered))                                        \
            return 0;                                                         \
        return crossing_##name(&l, &v, shape, line, want, answer, rest);      \
    }                                                                         \
    static int signs_##name(ARGUMENTS)                                        \
    {                                                                         \
        (void)rest;                                                           \
        return answer_by_signs(shape, line, want, answer, tapered, bounded);  \
    }
KERNELS(cylinder, 0, 1)
KERNELS(cone, 1, 1)
KERNELS(whole_cylinder, 0, 0)
KERNELS(double_cone, 1, 0)

#define BOTH(name)                 \
    {                              \
        roots_##name, signs_##name \
    }
#define STRAIGHT                                                        \
    {                                                                   \
        BOTH(cylinder), BOTH(cylinder), BOTH(cylinder), BOTH(cylinder), \
            BOTH(whole_cylinder), BOTH(whole_cylinder)                  \
    }
#define TAPERED                                                            \
    {                                                                      \
        BOTH(cone), BOTH(cone), BOTH(cone), BOTH(cone), BOTH(double_cone), \
            NEITHER                                                        \
    }
#define ROUND_OF(name, build)                                        \
    {                                                                \
        cylint_##name##_roots_##build, cylint_##name##_signs_##build \
    }
#define ROUND_BOTH(name, build) ROUND_OF(name, build)
#define ROUND(name)                                                         \
    {                                                                       \
        ROUND_BOTH(name, CYLINT_ROUND), ROUND_BOTH(name, CYLINT_ROUND),     \
            ROUND_BOTH(name, CYLINT_ROUND), ROUND_BOTH(name, CYLINT_ROUND), \
            NEITHER, NEITHER                                                \
    }
const cylint_one_kernels CYLINT_ONE = {{[CYLINT_KIND_NONE] = UNDECIDED,
                                        [CYLINT_KIND_CYLINDER] = STRAIGHT,
                                        [CYLINT_KIND_CONE] = TAPERED,
                                        [CYLINT_KIND_ACONE] = TAPERED,
                                        [CYLINT_KIND_ECYLINDER] = STRAIGHT,
                                        [CYLINT_KIND_ECONE] = TAPERED,
                                        [CYLINT_KIND_SPHERE] = ROUND(sphere),
                                        [CYLINT_KIND_CAPSULE] = ROUND(capsule),
                                        [CYLINT_KIND_RCONE] = ROUND(rcone)},
                                       CYLINT_HARD};

#else

/* Without vectors of two lanes. */
const cylint_one_kernels CYLINT_ONE = {{UNDECIDED, UNDECIDED, UNDECIDED,
                                        UNDECIDED, UNDECIDED, UNDECIDED,
                                        UNDECIDED, UNDECIDED, UNDECIDED},
                                       CYLINT_HARD};

#endif
