/*
 * local_roots.h - the ends of the overlap of a line and a shape, as roots
 *
 * Of a bounded shape lane i is the end at cap i: the cap's plane where the line
 * pierces the cap, else a root of the lateral quadric.  Of an unbounded shape
 * lane 0 is the root at which the line enters.  Each root is estimated in
 * doubles and corrected by Newton's step on a residual in pairs.
 */
#ifndef CYLINT_LOCAL_ROOTS_H
#define CYLINT_LOCAL_ROOTS_H

#include "local_lines.h"

#define ARGUMENTS CYLINT_ONE_ARGUMENTS

/* The parts of the ends, as bits of lanes: those on a cap, and of these those
 * on cap 1. */
typedef struct {
    unsigned cap, top;
} end_parts;

INLINE end_parts parts_of(const local_verdict *v)
{
    return (end_parts){v->pierced, 2};
}

/* The lanes of ends on parts that are present, as bits. */
INLINE unsigned ends_present(end_parts p, const cylint_shape *shape)
{
    if (shape->ends == CYLINT_ENDS_CAPPED)
        return 3;
    const unsigned caps = cylint_caps_present(shape->ends);
    const unsigned present = (caps & 2 ? p.top : 0) | (caps & 1 ? ~p.top : 0);
    return (~p.cap | present) & 3;
}

/* Writes the hits in lanes of `hits`, ascending in t. */
INLINE void write_parts(cylint_answer *answer, end_parts p, unsigned hits,
                        int first, int bounded)
{
    int n = 0;
    EACH(k, 2) {
        const int lane = k ^ first;
        if (!(hits >> lane & 1))
            continue;
        answer->hit[n].part = !(p.cap >> lane & 1) ? CYLINT_PART_LATERAL
                              : p.top >> lane & 1  ? CYLINT_PART_CAP1
                                                   : CYLINT_PART_CAP0;
        answer->hit[n].side = bounded ? k : lane;
        n++;
    }
}

/* Of two hits the nearest if only that is wanted. */
INLINE unsigned wanted_hits(unsigned hits, unsigned want, int first)
{
    return want & CYLINT_WANT_NEAREST && hits == 3 ? 1u << first : hits;
}

/* Estimates of the ends, t, and what Newton's step needs: the slope of the
 * residual there, a bound on its error, and half its curvature. */
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
    const double s = sqrt(v->G);
    const vd exits = up ? v_two(-1, 1) : v_two(1, -1);
    const vd root = exits * v_set(s);
    vd num = root - v_set(q->B), den = v_set(q->A);
    at.cap = m_from(v->pierced);
    at.slope = root + root;
    at.slope_error = v_set(2 * v->G_error / s);
    at.curvature = v_set(fabs(q->A) + q->A_error);
    if (bounded) {
        const vd w = v_set(l->w);
        num = v_select(at.cap, -l->in.z, num);
        den = v_select(at.cap, w, den);
        at.slope = v_select(at.cap, w, at.slope);
        at.slope_error =
            v_select(at.cap, v_set(CYLINT_LOCAL_POSITION * l->unit * l->D),
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
    const newton_lanes step =
        newton_step_lanes(residual, residual_error, at->slope, at->slope_error,
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

/* The roots that are certainly outside the domain of the line, as bits. */
INLINE unsigned roots_outside(const local_roots *r, const cylint_line *line)
{
    return m_bits(m_or(v_lt(r->high, v_set(line->tmin)),
                       v_lt(v_set(line->tmax), r->low)));
}

/* Writes the hits among the roots.  CYLINT_UNDECIDED: a root is too near to an
 * end of the domain, or is not certainly rounded. */
INLINE int accept_roots(const local_roots *r, int first, end_parts parts,
                        ARGUMENTS, int bounded)
{
    const vd tmin = v_set(line->tmin), tmax = v_set(line->tmax);
    const unsigned present = bounded ? ends_present(parts, shape) : 3;
    const unsigned in = m_bits(m_and(v_lt(tmin, r->low), v_lt(r->high, tmax)));
    const unsigned hits = wanted_hits(in & present, want, first);
    if (present & ~in && present & ~(in | roots_outside(r, line)))
        return CYLINT_UNDECIDED;
    if (want & CYLINT_WANT_T) {
        if (hits & ~r->nearest)
            return CYLINT_UNDECIDED;
        write_roots(answer, rest, r, hits, first);
    }
    if (want & CYLINT_WANT_PART)
        write_parts(answer, parts, hits, first, bounded);
    return answer->n = (int)(hits & 1) + (int)(hits >> 1);
}

#endif
