/*
 * round_question.c - one line and one sphere, capsule or rounded cone
 *
 * Compiled once as it is and again for processors with a fused multiply-add, as
 * one_question.c is.  What is left undecided here is computed by
 * hard_round_question.c.
 */
#define CYLINT_NARROW
#include "../numbers/double_double.h" /* before simd.h */
#include "../numbers/simd.h"
#include "filter.h"

#ifndef CYLINT_ROUND
#define CYLINT_ROUND plain
#define CYLINT_HARD_ROUND cylint_hard_round_plain
#define CYLINT_EXACT_ROUND cylint_exact_round_plain
#endif

/* The kernels of this build. */
#define NAME(kernel) NAME_OF(kernel, CYLINT_ROUND)
#define NAME_OF(kernel, build) NAME_JOINED(kernel, build)
#define NAME_JOINED(kernel, build) cylint_##kernel##_##build

#if LANES == 2

#include "round_roots.h"

/* The answer by roots, of a line that misses_at_once() does not show to miss. */
INLINE int round_by_roots(round_line *x, round_verdict v, ARGUMENTS, int kind)
{
    const int tapered = kind == ROUND_TAPERED;
    classify_round(&v, x, shape, kind);
    if (v.cone.misses)
        return 0;
    if (!v.cone.crosses || (v.cone.pierced | v.cone.spared) != 3 ||
        !cylint_rounds_to_nearest())
        return CYLINT_UNDECIDED;
    answer->relation = CYLINT_RELATION_CROSS;
    if (kind != ROUND_BALL && !v.chord)
        compute_balls(&v, x);
    const end_parts e = ends_of(&v);
    round_quadratic q = quadratic_of_balls(x, &v, ball_A_doubles(&x->l.in),
                                           ball_B_doubles(&x->l.in, &x->balls));
    if (kind != ROUND_BALL) {
        const local_quadratic cone = quadratic_of(&x->l, shape, tapered);
        q = choose_cone(m_from(e.cap), &q, &v, &cone, shape, tapered);
    }
    const local_ends at = estimate_round(&q, v.chord || x->l.w > 0);
    if (at.usable != 3)
        return CYLINT_UNDECIDED;
    const local_roots r = rounded_ends(x, shape, line, &at, e, kind);
    const end_parts parts = round_parts(e, shape, kind);
    const unsigned present = ends_present(parts, shape);
    if (roots_missing(&r, present, line, want)) {
        const local_verdict ends = {0, 0, m_from(0), e.cap, 0, e.top, 0, 1};
        cylint_estimates known;
        store_estimates(&known, x->l.Q, x->l.D, &ends, &at, &r);
        return CYLINT_EXACT_ROUND(shape, line, want, answer, rest, &known);
    }
    return write_hits(&r, at.first, parts, present, shape, line, want, answer,
                      rest, 1);
}

/* Where a point near the surface lies. */
typedef int side_function(const cylint_shape *shape, const cylint_line *line,
                          double t, double Q, double D, int aside);

#define SIDE(name, kind)                                                  \
    ASIDE int side_of_##name(const cylint_shape *shape,                   \
                             const cylint_line *line, double t, double Q, \
                             double D, int aside)                         \
    {                                                                     \
        return cylint_rounds_to_nearest()                                 \
                   ? side_in_pairs(shape, line, t, Q, D, aside, kind)     \
                   : LOCAL_UNCERTAIN;                                     \
    }
SIDE(sphere, ROUND_BALL)
SIDE(capsule, ROUND_STRAIGHT)
SIDE(rcone, ROUND_TAPERED)

/* Where the point at t lies, in doubles or else in pairs. */
INLINE int certain_state(const round_line *x, const round_verdict *v,
                         const cylint_shape *shape, const cylint_line *line,
                         double t, int kind)
{
    side_function *const side = kind == ROUND_BALL       ? side_of_sphere
                                : kind == ROUND_STRAIGHT ? side_of_capsule
                                                         : side_of_rcone;
    const int state = round_state(x, v, shape, t, kind);
    return state < LOCAL_NEAR
               ? state
               : side(shape, line, t, x->l.Q, x->l.D, state - LOCAL_NEAR);
}

INLINE int round_by_signs(round_line *x, round_verdict v, ARGUMENTS, int kind)
{
    (void)rest;
    classify_round(&v, x, shape, kind);
    if (v.cone.misses)
        return 0;
    if (!v.cone.crosses)
        return CYLINT_UNDECIDED;
    answer->relation = CYLINT_RELATION_CROSS;
    const int closed = shape->ends == CYLINT_ENDS_CAPPED;
    const int plain = closed && !(want & CYLINT_WANT_PART);
    if (plain && want & CYLINT_WANT_NEAREST && line->tmin <= 0 &&
        line->tmax > CYLINT_LATE && is_round_ahead(x, &v, shape, kind))
        return answer->n = 1;
    if (!plain && (v.cone.pierced | v.cone.spared) != 3)
        return CYLINT_UNDECIDED;
    const int first = !v.chord && !(x->l.w > 0);
    const int in = ends_between(
        certain_state(x, &v, shape, line, line->tmin, kind),
        certain_state(x, &v, shape, line, line->tmax, kind), first);
    if (in == CYLINT_UNDECIDED)
        return CYLINT_UNDECIDED;
    const end_parts e = ends_of(&v);
    const end_parts parts = round_parts(e, shape, kind);
    const unsigned hits =
        wanted_hits((unsigned)in & ends_present(parts, shape), want, first);
    if (want & CYLINT_WANT_PART)
        write_parts(answer, parts, hits, first, 1);
    return write_cross(answer, hits);
}

/* A kernel that begins with the part that decides most misses. */
#define KERNEL(name, rest_of, kind)                                          \
    int NAME(name)(ARGUMENTS)                                                \
    {                                                                        \
        round_line x;                                                        \
        round_verdict v;                                                     \
        load_round(&x, shape, line, kind);                                   \
        answer->relation = CYLINT_RELATION_MISS;                             \
        answer->n = 0;                                                       \
        if (misses_at_once(&v, &x, shape, kind))                             \
            return 0;                                                        \
        const int n = rest_of(&x, v, shape, line, want, answer, rest, kind); \
        return n == CYLINT_UNDECIDED                                         \
                   ? CYLINT_HARD_ROUND(shape, line, want, answer, rest)      \
                   : n;                                                      \
    }
#define KERNELS(name, kind)                    \
    KERNEL(name##_roots, round_by_roots, kind) \
    KERNEL(name##_signs, round_by_signs, kind)
KERNELS(sphere, ROUND_BALL)
KERNELS(capsule, ROUND_STRAIGHT)
KERNELS(rcone, ROUND_TAPERED)

#else

/* Without vectors of two lanes. */
#define KERNELS(name)                                             \
    int NAME(name##_roots)(CYLINT_ONE_ARGUMENTS)                  \
    {                                                             \
        return cylint_undecided(shape, line, want, answer, rest); \
    }                                                             \
    int NAME(name##_signs)(CYLINT_ONE_ARGUMENTS)                  \
    {                                                             \
        return cylint_undecided(shape, line, want, answer, rest); \
    }
KERNELS(sphere)
KERNELS(capsule)
KERNELS(rcone)

#endif
