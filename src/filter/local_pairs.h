/*
 * local_pairs.h - the line and its forms in pairs, in local coordinates
 *
 * Where doubles leave a sign undecided, the same forms in pairs compute it; and
 * the residuals of roots are those of the line in pairs.
 */
#ifndef CYLINT_LOCAL_PAIRS_H
#define CYLINT_LOCAL_PAIRS_H

#include "local_lines.h"

INLINE vpair vpair_turned(vpair x)
{
    return (vpair){v_turned(x.hi), v_turned(x.lo)};
}

INLINE vpair vpair_firsts(vpair x, vpair y)
{
    return (vpair){v_firsts(x.hi, y.hi), v_firsts(x.lo, y.lo)};
}

#define V vpair
#define FORM(name) name##_pairs
#define ADD(x, y) vpair_add(x, y)
#define SUB(x, y) vpair_sub(x, y)
#define MUL(x, y) vpair_mul(x, y)
#define SUM_OF(x, y, z) vpair_add(vpair_mul(x, y), z)
#define NEGATED(x) ((vpair){-(x).hi, -(x).lo})
#define TRIMMED(x) v_two_sum((x).hi, (x).lo)
#define SUMS(x, y)                \
    vpair_add(vpair_firsts(x, y), \
              vpair_firsts(vpair_turned(x), vpair_turned(y)))
#define TURNED(x) vpair_turned(x)
#define FIRSTS(x) vpair_firsts(x, x)
#define PAIRED(x, y) vpair_firsts(x, y)
#include "local_forms_template.h"

/* The matrix times a vector, whose components are hi[j] + lo[j] in all lanes.
 * lo may be NULL: 0. */
INLINE vqpair transformed(const cylint_local *f, const vq hi[3], const vq lo[3])
{
    vq product[3], error[3];
    EACH(j, 3) {
        /* four numbers at each: height follows the last column */
        const vq M = q_load(f->xyz[j]), M_lo = q_load(f->xyz_lo[j]);
        product[j] = q_mul(hi[j], M);
        error[j] = q_product_error(hi[j], M, product[j]);
        error[j] = q_sum_of(hi[j], M_lo, error[j]);
        if (lo)
            error[j] = q_sum_of(lo[j], M, error[j]);
    }
    const vqpair two = q_two_sum(product[0], product[1]);
    const vqpair all = q_two_sum(two.hi, product[2]);
    return (vqpair){all.hi, q_add(q_add(q_add(error[0], error[1]), error[2]),
                                  q_add(two.lo, all.lo))};
}

INLINE vpair low_of(vqpair x)
{
    return (vpair){q_low(x.hi), q_low(x.lo)};
}

/* Lane 2 twice. */
INLINE vpair third_of(vqpair x)
{
    const vd hi = q_high(x.hi), lo = q_high(x.lo);
    return (vpair){v_firsts(hi, hi), v_firsts(lo, lo)};
}

INLINE vqpair origin_in_pairs(const cylint_shape *shape,
                              const cylint_line *line)
{
    const vqpair from = q_two_diff(q_load(line->o), q_load(shape->base));
    const vq hi[3] = {q_firsts(from.hi), q_seconds(from.hi), q_thirds(from.hi)};
    const vq lo[3] = {q_firsts(from.lo), q_seconds(from.lo), q_thirds(from.lo)};
    return transformed(&shape->local, hi, lo);
}

INLINE vqpair direction_in_pairs(const cylint_shape *shape,
                                 const cylint_line *line)
{
    const double *d = line->d, *d_lo = line->d_lo;
    const vq hi[3] = {q_set(d[0]), q_set(d[1]), q_set(d[2])};
    if (!line->segment)
        return transformed(&shape->local, hi, NULL);
    const vq lo[3] = {q_set(d_lo[0]), q_set(d_lo[1]), q_set(d_lo[2])};
    return transformed(&shape->local, hi, lo);
}

/* z in pairs, of both caps. */
INLINE vpair from_caps(const cylint_local *f, vpair z)
{
    const vpair top = {v_two(0, f->height), v_two(0, f->height_lo)};
    return vpair_sub(z, top);
}

/* The line in pairs. */
INLINE void load_pairs(line_pairs *to, const cylint_shape *shape,
                       const cylint_line *line)
{
    const cylint_local *f = &shape->local;
    const vqpair p = origin_in_pairs(shape, line);
    const vqpair v = direction_in_pairs(shape, line);
    to->p = low_of(p);
    to->v = low_of(v);
    to->w = third_of(v);
    to->z = from_caps(f, third_of(p));
    to->r = (vpair){v_load(&shape->r0), v_set(0)};
    to->slope = twice(f->slope, f->slope_lo);
    set_products_pairs(to);
}

/* ---------------------------------------------- signs of the line ------ */

INLINE vd rounded(vpair x)
{
    return x.hi + x.lo;
}

/* The line as doubles, from pairs. */
INLINE void line_from_pairs(local_line *l, const line_pairs *in,
                            const cylint_shape *shape)
{
    l->unit = shape->local.error;
    l->in.p = rounded(in->p);
    l->in.v = rounded(in->v);
    l->in.z = rounded(in->z);
    l->in.w = rounded(in->w);
    v_store(l->z, l->in.z);
    l->w = v_first(l->in.w);
}

/* The errors have what the values lost when they were rounded, and A t as well
 * when t is estimated: three roundings. */
INLINE local_quadratic quadratic_in_pairs(const local_line *l,
                                          const line_pairs *in,
                                          const cylint_shape *shape,
                                          int tapered)
{
    local_quadratic q =
        with_errors(l, shape, rounded(AB_pairs(in, tapered)), tapered);
    q.A_error += 2 * CYLINT_ROUNDING * fabs(q.A);
    q.B_error += CYLINT_ROUNDING * fabs(q.B);
    return q;
}

/* The signs of the whole line in pairs, and its quadratic. */
INLINE local_verdict classify_in_pairs(const local_line *l, local_quadratic *q,
                                       const line_pairs *in,
                                       const cylint_shape *shape, int tapered,
                                       int extent)
{
    local_verdict v = {0, 0, m_from(0), 0, 0, 3, 0, 0};
    vpair Y = twice(0, 0);
    if (tapered)
        Y = Y_pairs(in);
    v.G = v_first(rounded(G_pairs(in, tapered, &Y)));
    v.G_error =
        tapered ? cone_error(l, shape, rounded(Y)) : disc_error(l, shape->r0);
    *q = quadratic_in_pairs(l, in, shape, tapered);
    if (v.G < -v.G_error) {
        v.misses = 1;
    } else if (extent == CYLINT_BOUNDED) {
        classify_bounded(&v, l, shape, rounded(E_pairs(in)),
                         rounded(N_pairs(in, tapered)), tapered);
    } else {
        const double T =
            extent == CYLINT_NAPPE ? v_first(rounded(T_pairs(in, &Y))) : 0;
        classify_unbounded(&v, l, shape, q->A, q->A_error, T, T_error(l, shape),
                           tapered, extent);
    }
    v.G_error += CYLINT_ROUNDING * fabs(v.G); /* it was rounded */
    return v;
}

/* ------------------------------------------- at points of the line ----- */

/* p + t v: x at both t, then y. */
INLINE vqpair points_at(const line_pairs *in, vd t)
{
    const vq T = q_join(t, t), v = q_spread(in->v.hi);
    const vq step = q_mul(T, v);
    const vq rest =
        q_sum_of(T, q_spread(in->v.lo), q_product_error(T, v, step));
    const vqpair sum = q_two_sum(q_spread(in->p.hi), step);
    return (vqpair){sum.hi, q_add(sum.lo, q_add(q_spread(in->p.lo), rest))};
}

/* rho at t.  Its value at 0 and its growth do not wait for t. */
INLINE vpair radius_at_t(const line_pairs *in, const cylint_shape *shape, vd t)
{
    const vpair z0 = vpair_firsts(in->z, in->z);
    const vpair rho = vpair_add(twice(shape->r0, 0), vpair_mul(in->slope, z0));
    return moved(rho, vpair_mul(in->slope, in->w), t);
}

/* Q at t of both lanes.  `across`: |x| + |y|, and + |rho| of a tapered shape. */
typedef struct {
    vd value, across;
} lateral_value;

INLINE lateral_value lateral_at(const line_pairs *in, const cylint_shape *shape,
                                vd t, int tapered)
{
    const vqpair p = points_at(in, t);
    const vq squares = q_mul(p.hi, p.hi);
    const vq rest = q_sum_of(q_add(q_add(p.hi, p.hi), p.lo), p.lo,
                             q_product_error(p.hi, p.hi, squares));
    const vpair pp = v_two_sum(q_low(squares), q_high(squares));
    vpair rho2;
    vd across = v_abs(q_low(p.hi)) + v_abs(q_high(p.hi));
    if (tapered) {
        const vpair rho = radius_at_t(in, shape, t);
        rho2 = vpair_square(rho);
        across = across + v_abs(rho.hi);
    } else {
        const pair square = two_prod(shape->r0, shape->r0);
        rho2 = twice(square.hi, square.lo);
    }
    const vd squared = (pp.hi - rho2.hi) + (pp.lo - rho2.lo);
    return (lateral_value){squared + (q_low(rest) + q_high(rest)), across};
}

/* As states_in_doubles(), in pairs.  q: the quadratic. */
INLINE local_states states_in_pairs(const local_line *l, const local_verdict *v,
                                    const local_quadratic *q,
                                    const line_pairs *in,
                                    const cylint_shape *shape,
                                    const cylint_line *line, int tapered,
                                    int extent)
{
    const vd t = near_ends(line), size = size_at(t, l->Q, l->D);
    const lateral_value C = lateral_at(in, shape, t, tapered);
    const vpair z0 = vpair_firsts(in->z, in->z);
    const vpair z1 = {v_seconds(in->z.hi, in->z.hi),
                      v_seconds(in->z.lo, in->z.lo)};
    const vd eZ = height_error(size, shape);
    domain_signs at;
    at.C = signs_beyond(C.value, lateral_error(size, C.across, shape, tapered));
    at.above[0] = signs_beyond(height_at(z0, in->w, t), eZ);
    at.above[1] = signs_beyond(height_at(z1, in->w, t), eZ);
    if (extent == CYLINT_NAPPE) {
        const vpair rho = radius_at_t(in, shape, t);
        at.above[0] =
            signs_beyond(rho.hi + rho.lo, v_set(taper_of(shape, 1)) * eZ);
    }
    const vd At = v_set(q->A) * t, B = v_set(q->B);
    at.vertex = signs_beyond(
        At + B, v_sum_of(v_abs(t), v_set(q->A_error), v_set(q->B_error)) +
                    v_set(2 * CYLINT_ROUNDING) * (v_abs(At) + v_abs(B)));
    return states_of(&at, l, v, q->A, line, tapered, extent);
}

#endif
