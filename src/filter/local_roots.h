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

#include "filter.h"
#include "local_pairs.h"

#define ARGUMENTS CYLINT_ONE_ARGUMENTS

/* Below this share of G_error an estimate in doubles seldom leads to a root that
 * is certainly rounded.  Only time depends on it. */
#define CYLINT_LOCAL_GRAZING 0x1p-13

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

INLINE int write_miss(cylint_answer *answer)
{
    answer->relation = CYLINT_RELATION_MISS;
    return answer->n = 0;
}

/* hits: bits of lanes. */
INLINE int write_cross(cylint_answer *answer, unsigned hits)
{
    answer->relation = CYLINT_RELATION_CROSS;
    return answer->n = (int)(hits & 1) + (int)(hits >> 1);
}

/* Of two hits the nearest if only that is wanted. */
INLINE unsigned wanted_hits(unsigned hits, unsigned want, int first)
{
    return want & CYLINT_WANT_NEAREST && hits == 3 ? 1u << first : hits;
}

/* The lane of the end with the lesser t.  If the sign of w is uncertain, both
 * ends are lateral and either order of the lanes will do. */
INLINE int first_lane(const local_line *l, double A, int tapered, int extent)
{
    if (extent == CYLINT_BOUNDED)
        return signbit(l->w) != 0;
    return tapered && extent == CYLINT_UNBOUNDED && A < 0;
}

/* Estimates of the ends, t, and what Newton's step needs: the slope of the
 * residual there, the inverse of the slope, a bound on its error, and half its
 * curvature.  usable: lanes whose estimate is nearer to its root than to the
 * other one, or is that of a plane. */
typedef struct {
    vd t, slope, inverse, slope_error, curvature;
    vm cap;
    unsigned usable;
    int first;
} local_ends;

INLINE local_ends estimate_ends(const local_line *l, const local_verdict *v,
                                const local_quadratic *q, int tapered,
                                int extent)
{
    local_ends at;
    const int bounded = extent == CYLINT_BOUNDED;
    const vd s = v_sqrt(v_set(v->G)); /* without errno */
    const vd root = v_like(s, v_set(bounded ? l->w : 1) * v_two(-1, 1));
    vd num = root - v_set(q->B), den = v_set(q->A);
    at.cap = v->cap;
    at.slope = root + root;
    at.curvature = v_set(fabs(q->A) + q->A_error);
    if (bounded) {
        const vd w = v_set(l->w);
        num = v_select(at.cap, -l->in.z, num);
        den = v_select(at.cap, w, den);
        at.slope = v_select(at.cap, w, at.slope);
        at.curvature = v_select(at.cap, v_set(0), at.curvature);
    }
    at.inverse = v_set(1) / at.slope;
    /* 2 s has the error 2 G_error / s */
    at.slope_error = v_set(4 * v->G_error) * v_abs(at.inverse);
    if (bounded)
        at.slope_error =
            v_select(at.cap, v_set(CYLINT_LOCAL_POSITION * l->unit * l->D),
                     at.slope_error);
    at.t = num * (v_set(1) / den);
    const vd off = v_sum_of(v_abs(at.t), v_set(q->A_error), v_set(q->B_error));
    const unsigned near =
        4 * v->G_error < v->G ? m_bits(v_le(off, v_set(0.25) * s)) : 0;
    at.usable = near | v->pierced;
    at.first = first_lane(l, q->A, tapered, extent);
    return at;
}

/* The roots: value + more with the error; low and high are bounds that are
 * rounded.  Bits of lanes where value is certainly nearest. */
typedef struct {
    vd value, more, error, low, high;
    unsigned nearest;
} local_roots;

/* How the roots round that Newton's step leads to from t. */
INLINE local_roots stepped(vd t, vd residual, vd residual_error,
                           const local_ends *at)
{
    const rounded_step r =
        step_from(t, residual, residual_error, at->slope, at->inverse,
                  at->slope_error, at->curvature);
    return (local_roots){r.root.hi, r.root.lo, r.error,
                         r.low,     r.high,    m_bits(r.nearest)};
}

/* By residuals in pairs. */
INLINE local_roots round_ends(const local_line *l, const line_pairs *in,
                              const cylint_shape *shape, const local_ends *at,
                              int tapered, int extent)
{
    const vd size = size_at(at->t, l->Q, l->D);
    const lateral_value Q = lateral_at(in, shape, at->t, tapered);
    vd residual = Q.value;
    vd error = lateral_error(size, Q.across, shape, tapered);
    if (extent == CYLINT_BOUNDED) {
        residual = v_select(at->cap, height_at(in->z, in->w, at->t), residual);
        error = v_select(at->cap, height_error(size, shape), error);
    }
    return stepped(at->t, residual, error, at);
}

/* lane: of the first hit. */
INLINE void write_rests(cylint_root_rest *rest, const local_roots *r,
                        unsigned hits, int lane)
{
    double more[2], error[2];
    v_store(more, r->more);
    v_store(error, r->error);
    for (int n = 0; n < (hits == 3 ? 2 : 1); n++) {
        rest->more[n] = more[lane ^ n];
        rest->error[n] = error[lane ^ n];
    }
}

/* The hits in their order. */
INLINE void write_roots(cylint_answer *answer, cylint_root_rest *rest,
                        const local_roots *r, unsigned hits, int first)
{
    const int lane = hits == 3 ? first : hits == 2;
    double t[2];
    v_store(t, r->value);
    answer->hit[0].t = t[lane];
    if (hits == 3)
        answer->hit[1].t = t[!lane];
    if (rest)
        write_rests(rest, r, hits, lane);
}

/* The roots that are certainly outside the domain of the line, as bits. */
INLINE unsigned roots_outside(const local_roots *r, const cylint_line *line)
{
    return m_bits(m_or(v_lt(r->high, v_set(line->tmin)),
                       v_lt(v_set(line->tmax), r->low)));
}

/* The lanes on parts that are present. */
INLINE unsigned lanes_present(const local_verdict *v, const cylint_shape *shape,
                              int extent)
{
    return extent == CYLINT_BOUNDED ? ends_present(parts_of(v), shape)
                                    : v->lanes;
}

/* The roots that are certainly in the domain of the line, as bits. */
INLINE unsigned roots_within(const local_roots *r, const cylint_line *line)
{
    return m_bits(m_and(v_lt(v_set(line->tmin), r->low),
                        v_lt(r->high, v_set(line->tmax))));
}

/* The roots without which there is no answer. */
INLINE unsigned roots_missing(const local_roots *r, unsigned present,
                              const cylint_line *line, unsigned want)
{
    const unsigned known = want & CYLINT_WANT_T ? r->nearest : 3;
    const unsigned missing = present & ~(roots_within(r, line) & known);
    return missing ? missing & ~roots_outside(r, line) : 0;
}

/* Writes the hits among the roots, of which none is missing. */
INLINE int write_hits(const local_roots *r, int first, end_parts parts,
                      unsigned present, ARGUMENTS, int bounded)
{
    const unsigned hits =
        wanted_hits(present & roots_within(r, line), want, first);
    (void)shape;
    if (want & CYLINT_WANT_T && hits)
        write_roots(answer, rest, r, hits, first);
    if (want & CYLINT_WANT_PART)
        write_parts(answer, parts, hits, first, bounded);
    return write_cross(answer, hits);
}

/* Writes the hits of a line that crosses, by signs alone; or returns
 * CYLINT_UNDECIDED. */
INLINE int write_signs(const local_states *at, const local_verdict *v,
                       int first, unsigned present, unsigned want,
                       cylint_answer *answer, int extent)
{
    if ((at->before | at->inside | at->after) != 3)
        return CYLINT_UNDECIDED;
    const unsigned begins = at->before & 1 & ~(at->before >> 1);
    const unsigned ends = ~at->after & 1 & (at->after >> 1);
    const unsigned hits =
        wanted_hits(present & (begins << first | ends << !first), want, first);
    if (want & CYLINT_WANT_PART)
        write_parts(answer, parts_of(v), hits, first, extent == CYLINT_BOUNDED);
    return write_cross(answer, hits);
}

/* ---------------------------------- for the functions that continue ----- */

INLINE void store_estimates(cylint_estimates *to, double Q, double D,
                            const local_verdict *v, const local_ends *at,
                            const local_roots *r)
{
    to->Q = Q;
    to->D = D;
    to->pierced = v->pierced;
    to->lanes = v->lanes;
    to->nearest = r->nearest;
    to->first = at->first;
    v_store(to->t, at->t);
    v_store(to->slope, at->slope);
    v_store(to->inverse, at->inverse);
    v_store(to->slope_error, at->slope_error);
    v_store(to->curvature, at->curvature);
    v_store(to->value, r->value);
    v_store(to->more, r->more);
    v_store(to->error, r->error);
    v_store(to->low, r->low);
    v_store(to->high, r->high);
}

INLINE void load_estimates(const cylint_estimates *from, local_verdict *v,
                           local_ends *at, local_roots *r)
{
    *v = (local_verdict){0,
                         0,
                         m_from(from->pierced),
                         from->pierced,
                         ~from->pierced & 3,
                         from->lanes,
                         0,
                         1};
    *at = (local_ends){v_load(from->t),
                       v_load(from->slope),
                       v_load(from->inverse),
                       v_load(from->slope_error),
                       v_load(from->curvature),
                       v->cap,
                       3,
                       from->first};
    *r = (local_roots){v_load(from->value), v_load(from->more),
                       v_load(from->error), v_load(from->low),
                       v_load(from->high),  from->nearest};
}

#endif
