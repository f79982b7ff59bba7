/*
 * one_question.c - one line and one shape: verdicts by signs, roots two at a
 * time
 *
 * Compiled once as it is and again for processors with a fused multiply-add:
 * the answers are the same bits.
 *
 * Verdicts need no root (local_lines.h).  Where t is wanted, the two lanes are
 * the two ends of the overlap.  Of a bounded shape lane i is the end at cap i:
 * the cap's plane where the line pierces the cap, else a root of the lateral
 * quadric.  Of an unbounded shape lane 0 is the root at which the line enters.
 * Each root is estimated in doubles and corrected by Newton's step on a
 * residual in pairs.
 */
#define CYLINT_NARROW
#include "local_lines.h"
#include "residual_in_triples.h"
#include "filter.h"

#ifndef CYLINT_ONE
#define CYLINT_ONE cylint_one_plain
#endif

#define ARGUMENTS                                                      \
    const cylint_shape *shape, const cylint_line *line, unsigned want, \
        cylint_answer *answer, cylint_root_rest *rest

/* For shapes without a kernel. */
static int undecided(ARGUMENTS)
{
    (void)shape;
    (void)line;
    (void)want;
    (void)answer;
    (void)rest;
    return CYLINT_UNDECIDED;
}

#define NEITHER              \
    {                        \
        undecided, undecided \
    }

#define UNDECIDED                                            \
    {                                                        \
        NEITHER, NEITHER, NEITHER, NEITHER, NEITHER, NEITHER \
    }

#if LANES == 2

/* The lanes of ends on parts that are present, as bits. */
INLINE unsigned ends_present(const local_verdict *v, const cylint_shape *shape)
{
    return (~v->pierced & 3) | (v->pierced & cylint_caps_present(shape->ends));
}

/* The lane of the end with the lesser t. */
INLINE int first_lane(const local_line *l, const cylint_shape *shape,
                      int tapered, int bounded)
{
    if (bounded)
        return !(l->w > 0);
    return tapered && quadratic_of(l, shape, 1).A < 0;
}

/* Writes the hits in lanes of `hits`, ascending in t. */
INLINE void write_parts(cylint_answer *answer, const local_verdict *v,
                        unsigned hits, int first, int bounded)
{
    int n = 0;
    EACH(k, 2) {
        const int lane = k ^ first;
        if (!(hits >> lane & 1))
            continue;
        answer->hit[n].part = v->pierced >> lane & 1
                                  ? (lane ? CYLINT_PART_CAP1 : CYLINT_PART_CAP0)
                                  : CYLINT_PART_LATERAL;
        answer->hit[n].side = bounded ? k : lane;
        n++;
    }
}

/* The lanes of the ends in the domain, by signs; or CYLINT_UNDECIDED. */
INLINE int ends_in_domain(const local_line *l, const local_verdict *v,
                          const cylint_shape *shape, const cylint_line *line,
                          int first, int tapered, int bounded)
{
    const int from = local_state(l, v, shape, line->tmin, tapered, bounded);
    const int to = local_state(l, v, shape, line->tmax, tapered, bounded);
    if (from == LOCAL_UNCERTAIN || to == LOCAL_UNCERTAIN)
        return CYLINT_UNDECIDED;
    const int begins = (from == LOCAL_BEFORE) & (to != LOCAL_BEFORE);
    const int ends = (from != LOCAL_AFTER) & (to == LOCAL_AFTER);
    return first ? begins << 1 | ends : ends << 1 | begins;
}

/* ---------------------------------------------------------- the roots -- */

/* Estimates of the ends, t, and what Newton's step needs: the slope of the
 * residual there, a bound on its relative error, and half its curvature. */
typedef struct {
    vd t, slope, slope_error, curvature;
    vm cap;
    unsigned usable;
    int first;
} local_ends;

INLINE local_ends estimate_ends(const local_line *l, const local_verdict *v,
                                const local_quadratic *q, int tapered,
                                int bounded)
{
    local_ends at;
    const int up = !bounded || l->w > 0;
    const double s = sqrt(v->G), s_error = v->G_error / v->G;
    const vd exits = up ? v_two(-1, 1) : v_two(1, -1);
    const vd root = exits * v_set(s);
    vd num = root - v_set(q->B), den = v_set(q->A);
    at.cap = m_from(v->pierced);
    at.slope = root + root;
    at.slope_error = v_set(s_error);
    at.curvature = v_set(fabs(q->A));
    if (bounded) {
        const vd w = v_set(l->w);
        num = v_select(at.cap, -l->in.z, num);
        den = v_select(at.cap, w, den);
        at.slope = v_select(at.cap, w, at.slope);
        at.slope_error = v_select(
            at.cap, v_set(CYLINT_LOCAL_POSITION * l->unit * l->D / fabs(l->w)),
            at.slope_error);
        at.curvature = v_select(at.cap, v_set(0), at.curvature);
    }
    at.t = num * (v_set(1) / den);
    /* the estimate of a lateral root is nearer to it than to the other one */
    const vd off = v_sum_of(v_abs(at.t), v_set(q->A_error), v_set(q->B_error));
    const unsigned near =
        4 * v->G_error < v->G ? m_bits(v_le(off, v_set(0.25 * s))) : 0;
    at.usable = near | v->pierced;
    at.first = bounded ? !up : tapered && q->A < 0;
    return at;
}

/* The residual at t in pairs: of the lateral surface Q, of a cap z. */
INLINE vd residual_at(const cylint_shape *shape, const cylint_line *line, vd t,
                      vm cap, unsigned pierced, int tapered)
{
    const cylint_local *f = &shape->local;
    const vd zero = v_set(0);
    vpair q[3];
    EACH(j, 3) {
        const pair from = two_diff(line->o[j], shape->base[j]);
        vpair step = v_two_prod(t, v_set(line->d[j]));
        step.lo = v_sum_of(t, v_set(line->d_lo[j]), step.lo);
        q[j] = vpair_add(twice(from.hi, from.lo), step);
    }
    const int cap0 = pierced & 1 ? 2 : 0, cap1 = pierced & 2 ? 2 : 0;
    const vpair x = row_times(f, q, cap0, cap1);
    vd value = zero;
    if (pierced != 3) {
        const vpair y = row_times(f, q, 1, 1);
        vpair rho = twice(shape->r0, 0);
        if (tapered) {
            const vpair slope = twice(f->slope, f->slope_lo);
            rho = vpair_add(rho, vpair_mul(slope, row_times(f, q, 2, 2)));
        }
        const vpair Q = vpair_sub(vpair_add(vpair_mul(x, x), vpair_mul(y, y)),
                                  vpair_mul(rho, rho));
        value = Q.hi + Q.lo;
    }
    if (pierced) {
        const vd top = v_two(0, f->height), top_lo = v_two(0, f->height_lo);
        const vd z = (x.hi - top) + (x.lo - top_lo);
        value = v_select(cap, z, value);
    }
    return value;
}

/* The roots: value + more with the error; low and high are bounds that are
 * rounded.  Bits of lanes where value is certainly nearest. */
typedef struct {
    vd value, more, error, low, high;
    unsigned nearest;
} local_roots;

/* Newton's step from t.  residual and error: of each lane; distance: of t from
 * the root, at most. */
#define FORM(name) name##_lanes
#define NEWTON_INLINE INLINE
#define NUM vd
#define ABS(x) v_abs(x)
#define CONSTANT(x) v_set(x)
#define QUOTIENT(x, y, inverse) ((x) * (inverse))
#define SLACK CYLINT_LOCAL_SLACK
#include "../roots/newton_template.h"

/* How the roots round that Newton's step leads to from t. */
INLINE local_roots stepped(vd t, vd residual, vd residual_error,
                           const local_ends *at)
{
    const vd distance = v_set(CYLINT_LOCAL_DISTANCE) *
                        (v_abs(residual) + residual_error) *
                        v_abs(v_set(1) / at->slope);
    const newton_lanes step = newton_step_lanes(
        residual, residual_error, at->slope, at->slope_error * v_abs(at->slope),
        at->curvature, distance);
    const vpair r = v_two_sum(t, -step.delta);
    const vd low = r.hi + (r.lo - step.error);
    const vd high = r.hi + (r.lo + step.error);
    const vd size = v_abs(r.hi);
    const vm in_range = m_and(v_lt(size, v_set(1 / CYLINT_ROOT_LEAST)),
                              v_lt(v_set(CYLINT_ROOT_LEAST), size));
    const vm nearest =
        m_and(m_and(v_eq(low, r.hi), v_eq(high, r.hi)), in_range);
    return (local_roots){r.hi, r.lo, step.error, low, high, m_bits(nearest)};
}

/* Not less than any term of a residual at t. */
INLINE vd size_at(vd t, const local_line *l, const cylint_shape *shape,
                  int tapered)
{
    return v_set(taper_of(shape, tapered)) *
           v_sum_of(v_abs(t), v_set(l->D), v_set(l->Q));
}

INLINE local_roots round_ends(const local_line *l, const local_verdict *v,
                              const cylint_shape *shape,
                              const cylint_line *line, const local_ends *at,
                              int tapered)
{
    const vd residual =
        residual_at(shape, line, at->t, at->cap, v->pierced, tapered);
    const vd size = size_at(at->t, l, shape, tapered);
    const vd rounding =
        v_set(CYLINT_LOCAL_RESIDUAL * shape->local.error) * size;
    return stepped(at->t, residual,
                   v_select(at->cap, rounding, rounding * size), at);
}

/* Corrects the roots in lanes of `which` by a second step, from t = value, with
 * residuals in triples. */
INLINE void correct_ends(local_roots *r, const local_line *l,
                         const local_verdict *v, const cylint_shape *shape,
                         const cylint_line *line, const local_ends *at,
                         unsigned which)
{
    double t[2], residual[2] = {0, 0};
    v_store(t, r->value);
    EACH(i, 2)
        if (which >> i & 1)
            residual[i] = residual_in_triples(
                shape, line, t[i], v->pierced >> i & 1 ? i : -1, shape->kind);
    const double error = shape->local.error;
    const vd size = size_at(r->value, l, shape, 1);
    const vd rounding = v_set(CYLINT_LOCAL_TRIPLE * error * error) * size;
    *r = stepped(r->value, v_load(residual),
                 v_select(at->cap, rounding, rounding * size), at);
}

/* The roots of x in lanes of `which`, of y in others. */
INLINE local_roots merged(const local_roots *x, const local_roots *y,
                          unsigned which)
{
    const vm m = m_from(which);
    return (local_roots){v_select(m, x->value, y->value),
                         v_select(m, x->more, y->more),
                         v_select(m, x->error, y->error),
                         v_select(m, x->low, y->low),
                         v_select(m, x->high, y->high),
                         (x->nearest & which) | (y->nearest & ~which)};
}

/* The hits in their order. */
INLINE void write_roots(cylint_answer *answer, cylint_root_rest *rest,
                        const local_roots *r, unsigned hits, int first)
{
    double t[2], more[2], error[2];
    int n = 0;
    v_store(t, r->value);
    v_store(more, r->more);
    v_store(error, r->error);
    EACH(k, 2) {
        const int lane = k ^ first;
        if (!(hits >> lane & 1))
            continue;
        answer->hit[n].t = t[lane];
        if (rest) {
            rest->more[n] = more[lane];
            rest->error[n] = error[lane];
        }
        n++;
    }
}

/* The hits of a line that crosses, by its roots.  hard: with residuals in
 * triples where pairs do not round a root. */
INLINE int answer_from(const local_line *l, const local_verdict *v,
                       const local_quadratic *q, ARGUMENTS, int tapered,
                       int bounded, int hard)
{
    if (bounded && (v->pierced | v->spared) != 3)
        return CYLINT_UNDECIDED;
    const local_ends at = estimate_ends(l, v, q, tapered, bounded);
    if (at.usable != 3 || !cylint_rounds_to_nearest())
        return CYLINT_UNDECIDED;
    local_roots r = round_ends(l, v, shape, line, &at, tapered);
    if (hard && want & CYLINT_WANT_T && r.nearest != 3) {
        const local_roots kept = r;
        const unsigned which = 3 & ~r.nearest;
        correct_ends(&r, l, v, shape, line, &at, which);
        r = merged(&r, &kept, which);
    }
    const vd tmin = v_set(line->tmin), tmax = v_set(line->tmax);
    const unsigned present = bounded ? ends_present(v, shape) : 3;
    const unsigned in = m_bits(m_and(v_lt(tmin, r.low), v_lt(r.high, tmax)));
    const unsigned out = m_bits(m_or(v_lt(r.high, tmin), v_lt(tmax, r.low)));
    unsigned hits = in & present;
    if (present & ~(in | out))
        return CYLINT_UNDECIDED;
    if (want & CYLINT_WANT_NEAREST && hits == 3)
        hits = 1u << at.first;
    if (want & CYLINT_WANT_T) {
        if (hits & ~r.nearest)
            return CYLINT_UNDECIDED;
        write_roots(answer, rest, &r, hits, at.first);
    }
    if (want & CYLINT_WANT_PART)
        write_parts(answer, v, hits, at.first, bounded);
    return answer->n = (int)(hits & 1) + (int)(hits >> 1);
}

INLINE int answer_by_roots(ARGUMENTS, int tapered, int bounded)
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
    const local_quadratic q = quadratic_of(&l, shape, tapered);
    return answer_from(&l, &v, &q, shape, line, want, answer, rest, tapered,
                       bounded, 0);
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
    unsigned hits = (unsigned)in & (closed ? 3 : ends_present(&v, shape));
    if (want & CYLINT_WANT_NEAREST && hits == 3)
        hits = 1u << first;
    if (want & CYLINT_WANT_PART)
        write_parts(answer, &v, hits, first, bounded);
    return answer->n = (int)(hits & 1) + (int)(hits >> 1);
}

/* A question that its kernel leaves undecided: the line begins on the surface,
 * or is nearly tangent or parallel.  One function for all shapes. */
static int answer_hard(ARGUMENTS)
{
    const int tapered = cylint_is_tapered(shape->kind);
    const int bounded = cylint_ends_are_planes(shape->ends);
    local_line l;
    if (cylint_is_round(shape->kind) || cylint_is_nappe(shape) ||
        !cylint_rounds_to_nearest())
        return CYLINT_UNDECIDED;
    load_local(&l, shape, line, tapered);
    local_verdict v = classify(&l, shape, tapered, bounded);
    local_quadratic q = quadratic_of(&l, shape, tapered);
    int n = CYLINT_UNDECIDED;
    if (v.crosses)
        n = answer_from(&l, &v, &q, shape, line, want, answer, rest, tapered,
                        bounded, 1);
    if (n == CYLINT_UNDECIDED) {
        v = classify_in_pairs(&l, &q, shape, line, tapered, bounded);
        if (v.misses)
            n = answer->n = 0;
        else if (v.crosses)
            n = answer_from(&l, &v, &q, shape, line, want, answer, rest,
                            tapered, bounded, 1);
    }
    answer->relation = v.crosses * CYLINT_RELATION_CROSS;
    return n;
}

/* A kernel of its own for each: tapered or not, bounded or not, with roots or
 * by signs. */
#define KERNELS(name, tapered, bounded)                                      \
    static int roots_##name(ARGUMENTS)                                       \
    {                                                                        \
        return answer_by_roots(shape, line, want, answer, rest, tapered,     \
                               bounded);                                     \
    }                                                                        \
    static int signs_##name(ARGUMENTS)                                       \
    {                                                                        \
        (void)rest;                                                          \
        return answer_by_signs(shape, line, want, answer, tapered, bounded); \
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
const cylint_one_kernels CYLINT_ONE = {{[CYLINT_KIND_NONE] = UNDECIDED,
                                        [CYLINT_KIND_CYLINDER] = STRAIGHT,
                                        [CYLINT_KIND_CONE] = TAPERED,
                                        [CYLINT_KIND_ACONE] = TAPERED,
                                        [CYLINT_KIND_ECYLINDER] = STRAIGHT,
                                        [CYLINT_KIND_ECONE] = TAPERED,
                                        [CYLINT_KIND_SPHERE] = UNDECIDED,
                                        [CYLINT_KIND_CAPSULE] = UNDECIDED,
                                        [CYLINT_KIND_RCONE] = UNDECIDED},
                                       answer_hard};

#else

/* Without vectors of two lanes. */
const cylint_one_kernels CYLINT_ONE = {{UNDECIDED, UNDECIDED, UNDECIDED,
                                        UNDECIDED, UNDECIDED, UNDECIDED,
                                        UNDECIDED, UNDECIDED, UNDECIDED},
                                       undecided};

#endif
