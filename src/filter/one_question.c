/*
 * one_question.c - one line and one shape: verdicts by signs, roots two at a
 * time
 *
 * Compiled once as it is and again for processors with a fused multiply-add:
 * the answers are the same bits.  Verdicts need no root (local_lines.h).  What
 * doubles and a residual in pairs leave undecided hard_question.c continues.
 */
#define CYLINT_NARROW
#include "../numbers/double_double.h" /* before simd.h */
#include "../numbers/simd.h"
#include "filter.h"

#ifndef CYLINT_ONE
#define CYLINT_ONE cylint_one_plain
#define CYLINT_HARD cylint_hard_plain
#define CYLINT_EXACT_ROOTS cylint_exact_roots_plain
#endif

#ifndef CYLINT_ROUND
#define CYLINT_ROUND plain
#endif

#define NEITHER                            \
    {                                      \
        cylint_undecided, cylint_undecided \
    }

#if LANES == 2

#include "local_roots.h"

/* What a kernel has computed of a line that G does not show to miss, in
 * registers. */
#define START vd p, vd v, double G, double G_error, double Q, double D

INLINE local_line started(vd p, vd v, double Q, double D)
{
    local_line l;
    l.in.p = p;
    l.in.v = v;
    l.Q = Q;
    l.D = D;
    return l;
}

/* Where G does not show a miss. */
INLINE int ends_by_roots(local_line *l, local_verdict v, ARGUMENTS, int tapered,
                         int extent)
{
    want |= CYLINT_WANT_T; /* as it is, but the compiler need not test it */
    load_rest(l, shape, line, tapered, extent);
    classify_rest(&v, l, shape, tapered, extent);
    if (v.misses)
        return write_miss(answer);
    if (!v.crosses ||
        (extent == CYLINT_BOUNDED && (v.pierced | v.spared) != 3) ||
        (v.pierced != 3 && v.G_error > CYLINT_LOCAL_GRAZING * v.G))
        return CYLINT_HARD(shape, line, want, answer, rest, 0, l->Q, l->D);
    if (!cylint_rounds_to_nearest())
        return CYLINT_UNDECIDED;
    line_pairs in;
    load_pairs(&in, shape, line);
    const local_quadratic q = quadratic_of(l, shape, tapered);
    const local_ends at = estimate_ends(l, &v, &q, tapered, extent);
    const unsigned present = lanes_present(&v, shape, extent);
    if (present & ~at.usable)
        return CYLINT_UNDECIDED;
    const local_roots r = round_ends(l, &in, shape, &at, tapered, extent);
    if (roots_missing(&r, present, line, want)) {
        cylint_estimates known;
        store_estimates(&known, l->Q, l->D, &v, &at, &r);
        return CYLINT_EXACT_ROOTS(shape, line, want, answer, rest, &known);
    }
    return write_hits(&r, at.first, parts_of(&v), present, shape, line, want,
                      answer, rest, extent == CYLINT_BOUNDED);
}

INLINE int ends_by_signs(local_line *l, local_verdict v, ARGUMENTS, int tapered,
                         int extent)
{
    const int bounded = extent == CYLINT_BOUNDED;
    const int closed = shape->ends == CYLINT_ENDS_CAPPED || !bounded;
    const int plain = closed && !(want & CYLINT_WANT_PART);
    load_rest(l, shape, line, tapered, extent);
    classify_rest(&v, l, shape, tapered, extent);
    if (v.misses)
        return write_miss(answer);
    if (!v.crosses || (!plain && bounded && (v.pierced | v.spared) != 3))
        return CYLINT_HARD(shape, line, want, answer, rest, 0, l->Q, l->D);
    if (plain && want & CYLINT_WANT_NEAREST && line->tmin <= 0 &&
        line->tmax > latest(extent) && extent != CYLINT_NAPPE &&
        is_ahead(l, &v, shape, tapered, extent)) {
        answer->relation = CYLINT_RELATION_CROSS;
        return answer->n = 1;
    }
    const local_states at =
        states_in_doubles(l, &v, shape, line, tapered, extent);
    const double A = quadratic_of(l, shape, tapered).A;
    const int n =
        write_signs(&at, &v, first_lane(l, A, tapered, extent),
                    lanes_present(&v, shape, extent), want, answer, extent);
    if (n != CYLINT_UNDECIDED)
        return n;
    return CYLINT_HARD(shape, line, want, answer, rest,
                       CYLINT_KNOWN_LINE | v.pierced | v.lanes << 2, l->Q,
                       l->D);
}

/* A kernel of its own for each: tapered or not, each extent, with roots or by
 * signs.  Each begins with G and continues in a function of its own, so that a
 * miss saves no registers. */
#define KERNEL(name, way, tapered, extent, MORE, LOAD_MORE, PASS_MORE)        \
    ASIDE int way##_on_##name(ARGUMENTS, START MORE)                          \
    {                                                                         \
        local_line l = started(p, v, Q, D);                                   \
        const local_verdict verdict = {G, G_error, m_from(0), 0, 0, 3, 0, 0}; \
        LOAD_MORE                                                             \
        return ends_by_##way(&l, verdict, shape, line, want, answer, rest,    \
                             tapered, extent);                                \
    }                                                                         \
    static int way##_##name(ARGUMENTS)                                        \
    {                                                                         \
        local_line l;                                                         \
        local_verdict v;                                                      \
        load_start(&l, shape, line, tapered);                                 \
        if (classify_by_G(&v, &l, shape, tapered))                            \
            return write_miss(answer);                                        \
        return way##_on_##name(shape, line, want, answer, rest, l.in.p,       \
                               l.in.v, v.G, v.G_error, l.Q, l.D PASS_MORE);   \
    }
#define NO_MORE
#define KERNELS(name, extent)                                 \
    KERNEL(name, roots, 0, extent, NO_MORE, NO_MORE, NO_MORE) \
    KERNEL(name, signs, 0, extent, NO_MORE, NO_MORE, NO_MORE)
#define COMMA ,
#define HEIGHTS COMMA double z COMMA double w
#define SET_HEIGHTS \
    l.z[0] = z;     \
    l.w = w;
#define PASS_HEIGHTS COMMA l.z[0] COMMA l.w
#define TAPERED_KERNELS(name, extent)                                  \
    KERNEL(name, roots, 1, extent, HEIGHTS, SET_HEIGHTS, PASS_HEIGHTS) \
    KERNEL(name, signs, 1, extent, HEIGHTS, SET_HEIGHTS, PASS_HEIGHTS)
KERNELS(cylinder, CYLINT_BOUNDED)
KERNELS(whole_cylinder, CYLINT_UNBOUNDED)
TAPERED_KERNELS(cone, CYLINT_BOUNDED)
TAPERED_KERNELS(double_cone, CYLINT_UNBOUNDED)
TAPERED_KERNELS(nappe, CYLINT_NAPPE)

#define BOTH(name)                 \
    {                              \
        signs_##name, roots_##name \
    }
#define ROUND_OF(name, build)                                        \
    {                                                                \
        cylint_##name##_signs_##build, cylint_##name##_roots_##build \
    }
#define ROUND_BOTH(name, build) ROUND_OF(name, build)
#define ROUND(name) ROUND_BOTH(name, CYLINT_ROUND)
const cylint_one_kernels CYLINT_ONE = {
    {[CYLINT_SOLID_NONE] = NEITHER,
     [CYLINT_SOLID_CYLINDER] = BOTH(cylinder),
     [CYLINT_SOLID_CONE] = BOTH(cone),
     [CYLINT_SOLID_WHOLE_CYLINDER] = BOTH(whole_cylinder),
     [CYLINT_SOLID_DOUBLE_CONE] = BOTH(double_cone),
     [CYLINT_SOLID_NAPPE] = BOTH(nappe),
     [CYLINT_SOLID_SPHERE] = ROUND(sphere),
     [CYLINT_SOLID_CAPSULE] = ROUND(capsule),
     [CYLINT_SOLID_ROUND_CONE] = ROUND(rcone)}};

#else

/* Without vectors of two lanes. */
const cylint_one_kernels CYLINT_ONE = {{NEITHER, NEITHER, NEITHER, NEITHER,
                                        NEITHER, NEITHER, NEITHER, NEITHER,
                                        NEITHER}};

#endif
