/*
 * local_lanes.h - one shape and a line in every lane, in local coordinates
 *
 * The forms are those of local_forms_template.h and the bounds those of
 * error_bounds.h, as for one line (local_lines.h, local_roots.h).  Here the two
 * numbers of a form are two vectors, and each condition is a mask.  The lines of
 * many_questions.c have no low parts: none is a segment.
 */
#ifndef CYLINT_LOCAL_LANES_H
#define CYLINT_LOCAL_LANES_H

#include "filter.h"
#include "local_steps.h"
#include "sphere_lanes.h"

/* The lines.  from: the origin less the base; tmin, tmax: the domain. */
typedef struct {
    line_many in;
    vd o[3], d[3], from[3], tmin, tmax, Q, D;
    vm in_range;
} local_lines;

INLINE vd row_of(const cylint_local *f, int row, const vd x[3])
{
    const vd M0 = v_set(f->xyz[0][row]), M1 = v_set(f->xyz[1][row]),
             M2 = v_set(f->xyz[2][row]);
    return v_sum_of(x[2], M2, v_sum_of(x[1], M1, x[0] * M0));
}

INLINE void load_local_lines(local_lines *l, const cylint_shape *shape,
                             int tapered)
{
    const cylint_local *f = &shape->local;
    line_many *in = &l->in;
    EACH(i, 3)
        l->from[i] = l->o[i] - v_set(shape->base[i]);
    const vd size = v_largest(l->d), z = row_of(f, 2, l->from);
    in->p = EACH_OF_TWO(row_of(f, 0, l->from), row_of(f, 1, l->from));
    in->v = EACH_OF_TWO(row_of(f, 0, l->d), row_of(f, 1, l->d));
    in->z = EACH_OF_TWO(z, z - v_set(f->height));
    in->w = two_of(row_of(f, 2, l->d));
    in->r =
        EACH_OF_TWO(v_set(shape->r0), v_set(tapered ? shape->r1 : shape->r0));
    in->slope = two_of(v_set(f->slope));
    set_products_many(in);
    l->Q = v_sum_of(v_largest(l->from), v_set(f->norm), v_set(f->reach));
    l->D = size * v_set(f->norm);
    l->in_range = m_and(v_le(v_set(1 / CYLINT_WINDOW), size),
                        v_le(size, v_set(CYLINT_WINDOW)));
}

/* Masks of certain signs. */
typedef struct {
    vm positive, negative;
} sign_masks;

INLINE sign_masks masks_of(vd x, vd error)
{
    return (sign_masks){v_lt(error, x), v_lt(x, -error)};
}

INLINE sign_masks masks_if(vm m, sign_masks x, sign_masks y)
{
    return (sign_masks){
        m_or(m_and(m, x.positive), m_and(m_not(m), y.positive)),
        m_or(m_and(m, x.negative), m_and(m_not(m), y.negative))};
}

INLINE sign_masks masks_reversed(sign_masks x)
{
    return (sign_masks){x.negative, x.positive};
}

/* Signs of E and of N inward, of both caps, and of G. */
typedef struct {
    sign_masks E[2], inward[2], G;
} cap_masks;

#define FORM(name) name##_of_masks
#define OVERLAP_INLINE INLINE
#define TRUTH vm
#define AND(x, y) m_and(x, y)
#define OR(x, y) m_or(x, y)
#define CAPS const cap_masks
#define E(c, i) (c)->E[i]
#define INWARD(c, i) (c)->inward[i]
#define G(c) (c)->G
#define POSITIVE(x) (x).positive
#define NEGATIVE(x) (x).negative
#define NOT_POSITIVE(x) (x).negative
#include "../signs/overlap_template.h"

/* What is certain of whole lines, by signs.  G, A, B with bounds on errors;
 * cap: lines that pierce the disc of each cap; sided: for both caps that is
 * certain. */
typedef struct {
    bounded_value G, A, B;
    vm cap[2], sided, misses, crosses;
} lines_verdict;

/* Computes G.  Returns the lines that it shows to miss. */
INLINE vm miss_by_G(lines_verdict *v, const local_lines *l,
                    const cylint_shape *shape, int tapered)
{
    const double u = CYLINT_ROUNDING;
    vtwo Y = two_of(v_set(0));
    if (tapered)
        Y = Y_many(&l->in);
    v->G.v = G_many(&l->in, tapered, &Y).a;
    if (tapered) {
        const vd off = v_set(0.5 * CYLINT_LOCAL_FORM * u * taper_of(shape, 1)) *
                       l->Q * l->D;
        v->G.e = (off + off) * (v_abs(Y.a) + v_abs(Y.b) + off);
    } else {
        v->G.e =
            v_set(CYLINT_LOCAL_FORM * u) * l->Q * l->D * l->D *
            v_sum_of(v_set(CYLINT_LOCAL_SECOND * u), l->Q, v_set(shape->r0));
    }
    return m_and(l->in_range, v_lt(v->G.v, -v->G.e));
}

/* The rest. */
INLINE void classify_lines(lines_verdict *v, const local_lines *l,
                           const cylint_shape *shape, int tapered, int bounded)
{
    const double u = CYLINT_ROUNDING, k = taper_of(shape, tapered);
    const vtwo AB = AB_many(&l->in, tapered);
    const vd D = v_set(k) * l->D, Q = v_set(k) * l->Q;
    v->A = (bounded_value){AB.a, v_set(CYLINT_LOCAL_A * u) * D * D};
    v->B = (bounded_value){AB.b, v_set(CYLINT_LOCAL_FORM * u) * Q * D};
    v->cap[0] = v->cap[1] = m_from(0);
    v->sided = l->in_range;
    v->misses = m_from(0);
    if (!bounded) {
        v->crosses = v_lt(v->G.e, v->G.v);
        if (tapered)
            v->crosses = m_and(v->crosses, v_lt(v->A.e, v_abs(v->A.v)));
        return;
    }
    const vd scale = v_set(CYLINT_LOCAL_FORM * u) * l->Q * l->D * l->D;
    const vd eE = scale * v_sum_of(v_set(CYLINT_LOCAL_SECOND * u), l->Q,
                                   v_set(widest_of(shape, tapered)));
    const vd eN = v_set(k) * scale;
    const vtwo E = E_many(&l->in), N = N_many(&l->in, tapered);
    const cap_masks c = {{masks_of(E.a, eE), masks_of(E.b, eE)},
                         {masks_of(-N.a, eN), masks_of(N.b, eN)},
                         {v_lt(v->G.e, v->G.v), v_lt(v->G.v, -v->G.e)}};
    EACH(i, 2) {
        v->cap[i] = c.E[i].positive;
        v->sided = m_and(v->sided, m_or(c.E[i].positive, c.E[i].negative));
    }
    v->misses = misses_of_masks(&c);
    v->crosses = crosses_of_masks(&c);
}

/* Where the points at t lie, if the line crosses: as local_states. */
typedef struct {
    vm before, inside, after;
} lines_state;

INLINE lines_state state_at(const local_lines *l, const lines_verdict *v,
                            const cylint_shape *shape, vd limit, int tapered,
                            int bounded)
{
    const double u = CYLINT_ROUNDING, k = taper_of(shape, tapered);
    const line_many *in = &l->in;
    const vd most = v_set(bounded ? CYLINT_LATE : DBL_MAX);
    const vm above = v_lt(most, limit), below = v_lt(limit, -most);
    const vm near = v_le(v_abs(limit), v_set(CYLINT_LATE));
    const vd t = v_select(near, limit, v_set(0));
    const vd x = v_sum_of(t, in->v.a, in->p.a);
    const vd y = v_sum_of(t, in->v.b, in->p.b);
    const vd z0 = v_sum_of(t, in->w.a, in->z.a);
    const vd z1 = v_sum_of(t, in->w.a, in->z.b);
    const vd Q = v_sum_of(v_abs(t), l->D, l->Q);
    const vd eZ = v_set(CYLINT_LOCAL_POSITION * u) * Q, eP = v_set(k) * eZ;
    vd rho = v_set(shape->r0), widest = v_set(k) * Q;
    if (tapered)
        rho = v_sum_of(in->slope.a, z0, rho);
    if (bounded)
        widest = v_set(widest_of(shape, tapered));
    sign_masks C = masks_of(v_sum_of(-rho, rho, v_sum_of(x, x, y * y)),
                            v_set(4) * eP * (widest + eP));
    sign_masks behind =
        masks_of(v_sum_of(v->A.v, t, v->B.v),
                 v_set(2 * CYLINT_LOCAL_FORM * u * k * k) * l->D * Q);
    vm inside = C.negative, outside = C.positive;
    if (bounded) {
        const sign_masks s0 = masks_of(z0, eZ), s1 = masks_of(z1, eZ);
        const sign_masks of_cap = masks_if(v->cap[0], s0, s1);
        const vm down = v_lt(in->w.a, v_set(0));
        behind =
            masks_if(m_or(v->cap[0], v->cap[1]),
                     masks_if(down, masks_reversed(of_cap), of_cap), behind);
        inside = m_and(inside, m_and(s0.positive, s1.negative));
        outside = m_or(outside, m_or(s0.negative, s1.positive));
    } else if (tapered) {
        const vm reversed = v_lt(v->A.v, v_set(0));
        const sign_masks sides = masks_if(reversed, masks_reversed(C), C);
        behind = masks_if(reversed, masks_reversed(behind), behind);
        inside = sides.negative;
        outside = sides.positive;
    }
    return (lines_state){
        m_or(m_and(m_and(outside, behind.negative), near), below),
        m_and(inside, near),
        m_or(m_and(m_and(outside, behind.positive), near), above)};
}

/* ------------------------------------------------------------ roots ----- */

/* The coordinates in pairs. */
typedef struct {
    vpair p[2], v[2], z[2], w;
} lines_in_pairs;

/* A row of the matrix times x, as transformed() in local_pairs.h. */
INLINE vpair row_in_pairs(const cylint_local *f, int row, const vpair x[3],
                          int exact)
{
    vpair product[3];
    EACH(j, 3) {
        const vd M = v_set(f->xyz[j][row]);
        product[j] = v_two_prod(x[j].hi, M);
        product[j].lo =
            v_sum_of(x[j].hi, v_set(f->xyz_lo[j][row]), product[j].lo);
        if (!exact)
            product[j].lo = v_sum_of(x[j].lo, M, product[j].lo);
    }
    const vpair first = v_two_sum(product[0].hi, product[1].hi);
    const vpair all = v_two_sum(first.hi, product[2].hi);
    return (vpair){all.hi, ((product[0].lo + product[1].lo) + product[2].lo) +
                               (first.lo + all.lo)};
}

INLINE void lines_to_pairs(lines_in_pairs *to, const local_lines *l,
                           const cylint_shape *shape)
{
    const cylint_local *f = &shape->local;
    vpair from[3], d[3];
    EACH(i, 3) {
        from[i] = v_two_sum(l->o[i], v_set(-shape->base[i]));
        d[i] = (vpair){l->d[i], v_set(0)};
    }
    EACH(i, 2) {
        to->p[i] = row_in_pairs(f, i, from, 0);
        to->v[i] = row_in_pairs(f, i, d, 1);
    }
    to->z[0] = row_in_pairs(f, 2, from, 0);
    to->z[1] = vpair_sub(to->z[0], twice(f->height, f->height_lo));
    to->w = row_in_pairs(f, 2, d, 1);
}

/* The root of one end.  known: certainly rounded; low, high: bounds. */
typedef struct {
    vd value, low, high;
    vm known;
} lines_root;

/* The residual at t of the lateral surface, with its error. */
INLINE bounded_value lateral_residual(const lines_in_pairs *in, vd t, vd size,
                                      const cylint_shape *shape, int tapered)
{
    const cylint_local *f = &shape->local;
    const vpair x = moved(in->p[0], in->v[0], t);
    const vpair y = moved(in->p[1], in->v[1], t);
    const vpair xx = vpair_square(x), yy = vpair_square(y);
    const vpair pp = v_two_sum(xx.hi, yy.hi);
    vd across = v_abs(x.hi) + v_abs(y.hi);
    vpair rho2;
    if (tapered) {
        const vpair z = moved(in->z[0], in->w, t);
        const vpair rho = vpair_add(twice(shape->r0, 0),
                                    vpair_mul(twice(f->slope, f->slope_lo), z));
        rho2 = vpair_square(rho);
        across = across + v_abs(rho.hi);
    } else {
        rho2 = v_two_prod(v_set(shape->r0), v_set(shape->r0));
    }
    return (bounded_value){(pp.hi - rho2.hi) +
                               ((pp.lo + (xx.lo + yy.lo)) - rho2.lo),
                           lateral_error(size, across, shape, tapered)};
}

/* As estimate_ends() and round_ends() for one end: of cap 1 in lanes of `top`,
 * else of cap 0.  sign: of the root. */
INLINE lines_root root_of_line(const local_lines *l, const lines_verdict *v,
                               const lines_in_pairs *in, vm top, vd s, vd sign,
                               const cylint_shape *shape, int tapered,
                               int bounded)
{
    const vd root = sign * s;
    vd num = root - v->B.v, den = v->A.v, slope = root + root;
    vd curvature = v_abs(v->A.v) + v->A.e;
    vm cap = m_from(0);
    if (bounded) {
        cap = m_or(m_and(top, v->cap[1]), m_and(m_not(top), v->cap[0]));
        num = v_select(cap, -v_select(top, l->in.z.b, l->in.z.a), num);
        den = v_select(cap, l->in.w.a, den);
        slope = v_select(cap, l->in.w.a, slope);
        curvature = v_select(cap, v_set(0), curvature);
    }
    const vd inverse = v_set(1) / slope, t = num * (v_set(1) / den);
    vd slope_error = v_set(4) * v->G.e * v_abs(inverse);
    const vd size = v_sum_of(v_abs(t), l->D, l->Q);
    const bounded_value lateral = lateral_residual(in, t, size, shape, tapered);
    vd residual = lateral.v, error = lateral.e;
    if (bounded) {
        const vpair z = {v_select(top, in->z[1].hi, in->z[0].hi),
                         v_select(top, in->z[1].lo, in->z[0].lo)};
        slope_error =
            v_select(cap, v_set(CYLINT_LOCAL_POSITION * CYLINT_ROUNDING) * l->D,
                     slope_error);
        residual = v_select(cap, height_at(z, in->w, t), residual);
        error = v_select(cap, height_error(size, shape), error);
    }
    const rounded_step r =
        step_from(t, residual, error, slope, inverse, slope_error, curvature);
    const vd off = v_sum_of(v_abs(t), v->A.e, v->B.e);
    const vm usable = m_or(cap, m_and(v_le(off, v_set(0.25) * s),
                                      v_lt(v_set(4) * v->G.e, v->G.v)));
    return (lines_root){r.root.hi, r.low, r.high, m_and(usable, r.nearest)};
}

/* ---------------------------------------------------------- answers ----- */

/* One end as a hit: on a part that is present, in the domain for certain or
 * not certainly outside of it. */
typedef struct {
    vm hit, unknown;
} lines_hit;

INLINE lines_hit hit_of_root(const lines_root *r, const local_lines *l,
                             vm present)
{
    const vm in =
        m_and(m_and(v_lt(l->tmin, r->low), v_lt(r->high, l->tmax)), r->known);
    const vm out = m_or(v_lt(r->high, l->tmin), v_lt(l->tmax, r->low));
    return (lines_hit){m_and(present, in),
                       m_and(present, m_not(m_or(in, out)))};
}

/* Writes the answers.  lanes: those in use. */
INLINE void answer_local_lines(const local_lines *l, const cylint_shape *shape,
                               unsigned want, int relations, vm lanes,
                               int tapered, int bounded, cylint_filter_group *g)
{
    const vd zero = v_set(0), one = v_set(1);
    lines_verdict v;
    const vm alive = m_and(lanes, m_not(miss_by_G(&v, l, shape, tapered)));
    g->found = g->undecided = g->hit[0] = g->hit[1] = g->leaving_first = 0;
    if (!m_any(alive))
        return;
    classify_lines(&v, l, shape, tapered, bounded);
    vm crosses = m_and(m_and(alive, v.crosses), v.sided);
    const vm missed = m_and(v.misses, l->in_range);
    vm undecided = m_and(alive, m_not(m_or(missed, crosses)));
    const vm down = bounded ? v_lt(l->in.w.a, zero)
                            : (tapered ? v_lt(v.A.v, zero) : m_from(0));
    const vm equal = v_eq(l->tmin, l->tmax); /* may be zeros that differ */
    vm hit[2] = {m_from(0), m_from(0)};
    if (m_any(crosses)) {
        /* k counts the ends in the order of t */
        const vm none = m_from(0);
        const unsigned caps = cylint_caps_present(shape->ends);
        const vm has[2] = {m_from(caps & 1 ? (1u << LANES) - 1 : 0),
                           m_from(caps & 2 ? (1u << LANES) - 1 : 0)};
        const vm top[2] = {bounded ? down : none, bounded ? m_not(down) : none};
        const vd turn = bounded ? one : v_select(down, v_set(-1), one);
        lines_hit at[2] = {{none, none}, {none, none}};
        vm cap[2], present[2];
        EACH(k, 2) {
            cap[k] =
                m_or(m_and(top[k], v.cap[1]), m_and(m_not(top[k]), v.cap[0]));
            present[k] =
                m_or(m_not(cap[k]),
                     m_or(m_and(top[k], has[1]), m_and(m_not(top[k]), has[0])));
        }
        if (want & CYLINT_WANT_T) {
            lines_in_pairs in;
            lines_to_pairs(&in, l, shape);
            const vd s = v_sqrt(v_select(v_lt(zero, v.G.v), v.G.v, one));
            for (int k = 0; k < 2; k++) {
                const lines_root r =
                    root_of_line(l, &v, &in, k ? top[1] : top[0], s,
                                 k ? turn : -turn, shape, tapered, bounded);
                at[k] = hit_of_root(&r, l, present[k]);
                v_store(g->t[k], r.value);
                if (want & CYLINT_WANT_NEAREST &&
                    !m_any(m_and(crosses, m_not(at[k].hit))))
                    break;
            }
        } else {
            const lines_state from =
                state_at(l, &v, shape, l->tmin, tapered, bounded);
            const lines_state to =
                state_at(l, &v, shape, l->tmax, tapered, bounded);
            const vm unknown =
                m_not(m_and(m_or(from.before, m_or(from.inside, from.after)),
                            m_or(to.before, m_or(to.inside, to.after))));
            const vm begins = m_and(from.before, m_not(to.before));
            const vm ends = m_and(m_not(from.after), to.after);
            at[0] = (lines_hit){m_and(present[0], begins), unknown};
            at[1] = (lines_hit){m_and(present[1], ends), unknown};
        }
        EACH(k, 2) {
            const vd part = v_select(top[k], v_set(CYLINT_PART_CAP1),
                                     v_set(CYLINT_PART_CAP0));
            hit[k] = at[k].hit;
            v_store(g->part[k],
                    v_select(cap[k], part, v_set(CYLINT_PART_LATERAL)));
        }
        undecided = m_or(
            undecided,
            m_and(crosses, m_or(equal, m_or(at[0].unknown, at[1].unknown))));
        crosses = m_and(crosses, m_not(undecided));
    }
    g->undecided = m_bits(undecided);
    g->hit[0] = m_bits(m_and(hit[0], crosses));
    g->hit[1] = m_bits(m_and(hit[1], crosses));
    g->leaving_first = bounded ? 0 : m_bits(down);
    g->found =
        g->undecided | (relations ? m_bits(crosses) : g->hit[0] | g->hit[1]);
}

#endif
