/*
 * hard_question.c - one line and one shape, where doubles do not decide
 *
 * The line is nearly tangent, or nearly parallel to the axis, or it passes near
 * a rim: then the forms are computed in pairs.  Or an end of the domain lies
 * near the surface, as the origin of a ray that begins there: then the signs at
 * that end are.  Or a root is not certainly rounded by a residual in pairs, as
 * the root near 0 of such a ray: then its residual is computed in triples.
 */
#define CYLINT_NARROW
#include "../numbers/double_double.h" /* before simd.h */
#include "../numbers/simd.h"
#include "filter.h"

#ifndef CYLINT_HARD
#define CYLINT_HARD cylint_hard_plain
#define CYLINT_EXACT_ROOTS cylint_exact_roots_plain
#endif

#if LANES == 2

#include "local_roots.h"
#include "residual_in_levels.h"
#include "residual_in_triples.h"
#include "second_step.h"

/* In local coordinates, of the part that holds the root: of the plane of `cap`
 * or, if cap is -1, of the lateral surface. */
ASIDE double exact_residual(const cylint_shape *shape, const cylint_line *line,
                            double t, int cap)
{
    switch (shape->kind) {
    case CYLINT_KIND_CYLINDER:
        return circular_residual(shape, line, t, cap, 0);
    case CYLINT_KIND_CONE:
        return circular_residual(shape, line, t, cap, 1);
    case CYLINT_KIND_ECYLINDER:
        return elliptic_residual(shape, line, t, cap, 0);
    case CYLINT_KIND_ECONE:
        return elliptic_residual(shape, line, t, cap, 1);
    default:
        return cap < 0 ? residual_in_triples(shape, line, t, cap, shape->kind)
                       : circular_residual(shape, line, t, cap, 1);
    }
}

/* Corrects the roots in lanes of `which` by a second step, with exact
 * residuals. */
INLINE local_roots corrected(local_roots r, const local_verdict *v,
                             const local_ends *at, double Q, double D,
                             const cylint_shape *shape, const cylint_line *line,
                             unsigned which)
{
    const vd start = second_start(&r, at);
    const vd height = size_at(start, Q, D);
    const vd size = v_set(taper_of(shape, 1)) * height;
    const vd sizes = v_select(at->cap, height, size * size);
    double t[2];
    v_store(t, start);
    /* nearly always one of them: no branch depends on which */
    for (unsigned left = which; left; left &= left - 1) {
        const int i = (int)(left >> 1 & ~left);
        const double residual =
            exact_residual(shape, line, t[i], v->pierced >> i & 1 ? i : -1);
        const local_roots better =
            second_step(start, v_set(residual), sizes, shape, at);
        r = merged(&better, &r, left & (0 - left));
    }
    return r;
}

/* What bounds the shape. */
INLINE int extent_of(const cylint_shape *shape)
{
    return cylint_ends_are_planes(shape->ends) ? CYLINT_BOUNDED
           : cylint_is_nappe(shape)            ? CYLINT_NAPPE
                                               : CYLINT_UNBOUNDED;
}

/* Writes the hits, if need be after another step. */
INLINE int write_corrected(local_roots r, const local_verdict *v,
                           const local_ends *at, double Q, double D, ARGUMENTS,
                           int extent)
{
    const unsigned present = lanes_present(v, shape, extent);
    const unsigned missing = roots_missing(&r, present, line, want);
    if (missing)
        r = corrected(r, v, at, Q, D, shape, line, missing);
    if (missing && roots_missing(&r, present, line, want))
        return CYLINT_UNDECIDED;
    return write_hits(&r, at->first, parts_of(v), present, shape, line, want,
                      answer, rest, extent == CYLINT_BOUNDED);
}

int CYLINT_EXACT_ROOTS(ARGUMENTS, const cylint_estimates *from)
{
    local_verdict v;
    local_ends at;
    local_roots r;
    load_estimates(from, &v, &at, &r);
    return write_corrected(r, &v, &at, from->Q, from->D, shape, line, want,
                           answer, rest, extent_of(shape));
}

INLINE int answer_by_signs(const local_line *l, const local_quadratic *q,
                           const local_verdict *v, const line_pairs *in,
                           const cylint_shape *shape, const cylint_line *line,
                           unsigned want, cylint_answer *answer, int tapered,
                           int extent)
{
    if ((v->pierced | v->spared) != 3 && extent == CYLINT_BOUNDED &&
        (shape->ends != CYLINT_ENDS_CAPPED || want & CYLINT_WANT_PART))
        return CYLINT_UNDECIDED;
    const local_states at =
        states_in_pairs(l, v, q, in, shape, line, tapered, extent);
    return write_signs(&at, v, first_lane(l, q->A, tapered, extent),
                       lanes_present(v, shape, extent), want, answer, extent);
}

INLINE int answer_by_roots(const local_line *l, const local_quadratic *q,
                           const local_verdict *v, const line_pairs *in,
                           ARGUMENTS, int tapered, int extent)
{
    if ((v->pierced | v->spared) != 3 && extent == CYLINT_BOUNDED)
        return CYLINT_UNDECIDED;
    const local_ends at = estimate_ends(l, v, q, tapered, extent);
    if (lanes_present(v, shape, extent) & ~at.usable)
        return CYLINT_UNDECIDED;
    const local_roots r = round_ends(l, in, shape, &at, tapered, extent);
    return write_corrected(r, v, &at, l->Q, l->D, shape, line, want, answer,
                           rest, extent);
}

int CYLINT_HARD(ARGUMENTS, unsigned known, double Q, double D)
{
    const int tapered = cylint_is_tapered(shape->kind);
    const int extent = extent_of(shape);
    local_line l;
    local_quadratic q;
    line_pairs in;
    local_verdict v = {0, 0, m_from(0), known & 3, ~known & 3, known >> 2 & 3,
                       0, 1};
    if (!cylint_rounds_to_nearest())
        return CYLINT_UNDECIDED;
    l.Q = Q;
    l.D = D;
    load_pairs(&in, shape, line);
    line_from_pairs(&l, &in, shape);
    if (known)
        q = quadratic_in_pairs(&l, &in, shape, tapered);
    else
        v = classify_in_pairs(&l, &q, &in, shape, tapered, extent);
    if (v.misses)
        return write_miss(answer);
    if (!v.crosses)
        return CYLINT_UNDECIDED;
    return want & CYLINT_WANT_T
               ? answer_by_roots(&l, &q, &v, &in, shape, line, want, answer,
                                 rest, tapered, extent)
               : answer_by_signs(&l, &q, &v, &in, shape, line, want, answer,
                                 tapered, extent);
}

#endif
