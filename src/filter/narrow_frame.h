/*
 * narrow_frame.h - frame.h for one line and one shape in both lanes
 */
#ifndef CYLINT_NARROW_FRAME_H
#define CYLINT_NARROW_FRAME_H

#include "frame.h"

/* Rows x and y of the matrix times a vector. */
INLINE vd across(const cylint_shape *s, vd x, vd y, vd z)
{
    const vd M0 = v_load(cylint_column(s, 0)), M1 = v_load(cylint_column(s, 1)),
             M2 = v_load(cylint_column(s, 2));
    return v_sum_of(z, M2, v_sum_of(y, M1, x * M0));
}

/* Row z. */
INLINE vd along(const cylint_shape *s, double x, double y, double z)
{
    const double xy =
        sum_of(y, cylint_column(s, 1)[2], x * cylint_column(s, 0)[2]);
    return v_set(sum_of(z, cylint_column(s, 2)[2], xy));
}

/* The line as first computed: p and v as (x, y); z from the base and w, of
 * tapered solids and balls. */
typedef struct {
    vd p, v, from_base, w, Q, D;
} first_line;

/* z of a point from the base. */
INLINE vd height_of(const double o[3], const cylint_shape *shape, int solid)
{
    const double *b = cylint_base(shape);
    return solid == CYLINT_SOLID_SPHERE
               ? v_set(o[2] - b[2])
               : along(shape, o[0] - b[0], o[1] - b[1], o[2] - b[2]);
}

INLINE void load_along(first_line *to, const source *from, int solid)
{
    const double *d = from->line->d;
    to->from_base = height_of(from->line->o, from->shape, solid);
    to->w = solid == CYLINT_SOLID_SPHERE ? v_set(d[2])
                                         : along(from->shape, d[0], d[1], d[2]);
}

/* No local coordinate of the line's origin exceeds it.  size: no coordinate from
 * the base, not local, exceeds it. */
INLINE vd origin_bound(vd size, const cylint_shape *shape)
{
    return v_sum_of(size, v_set(cylint_norm(shape)),
                    v_set(cylint_reach(shape)));
}

/* No local coordinate of the line's direction exceeds it. */
INLINE vd direction_bound(const source *from)
{
    return v_set(from->line->size * cylint_norm(from->shape));
}

/* p and Q of a point. */
INLINE void load_point(first_line *to, const double o[3],
                       const cylint_shape *shape, int solid)
{
    const double *base = cylint_base(shape);
    const vd xy = v_load(o) - v_load(base), z = v_set(o[2] - base[2]);
    const vd x = v_firsts(xy, xy), y = v_seconds(xy, xy);
    const vd size = v_max(v_max(v_abs(x), v_abs(y)), v_abs(z));
    to->p = solid == CYLINT_SOLID_SPHERE ? xy : across(shape, x, y, z);
    to->Q = origin_bound(size, shape);
}

/* The numbers that G reads. */
INLINE first_line load_first(const source *from, int solid)
{
    const double *d = from->line->d;
    first_line to;
    load_point(&to, from->line->o, from->shape, solid);
    to.v = v_load(d);
    if (solid != CYLINT_SOLID_SPHERE)
        to.v = across(from->shape, v_set(d[0]), v_set(d[1]), v_set(d[2]));
    to.D = direction_bound(from);
    to.from_base = to.w = v_set(0);
    if (cylint_solid_is_tapered(solid) || solid == CYLINT_SOLID_SPHERE)
        load_along(&to, from, solid);
    return to;
}

INLINE void set_line(local_line *l, const first_line *first, const source *from,
                     int solid)
{
    l->in.p[0] = v_firsts(first->p, first->p);
    l->in.p[1] = v_seconds(first->p, first->p);
    l->in.v[0] = v_firsts(first->v, first->v);
    l->in.v[1] = v_seconds(first->v, first->v);
    set_products_doubles(&l->in);
    l->in.w = first->w;
    l->Q = first->Q;
    l->D = first->D;
    l->unit = v_set(cylint_unit(from->shape));
    l->in_range = m_from(3);
    set_surface(l, first->from_base, from, solid);
}

/* Coordinate i of the plane of an end, exactly, and whether all points of the plane
 * have it. */
INLINE vpair plane_coordinate(const source *from, int i, vm top, vm *is_fixed)
{
    const cylint_shape *s = from->shape;
    const double base = cylint_base(s)[i];
    const pair end = cylint_has_end_points(s->kind)
                         ? (pair){cylint_top(s)[i], 0}
                         : two_sum(base, cylint_axis(s)[i]);
    const int fixed = cylint_end_is_level(s, i) && !cylint_too_small(base) &&
                      !cylint_too_small(end.hi);
    *is_fixed = m_from(fixed ? 3 : 0);
    return pick(top, vpair_set(end.hi, end.lo), vpair_set(base, 0));
}

/* A point: the origin of a line with the direction 0. */
INLINE void load_place(local_line *l, const double o[3],
                       const cylint_shape *shape, int solid)
{
    const source from = {shape, NULL};
    first_line first = {.v = v_set(0), .w = v_set(0), .D = v_set(0)};
    load_point(&first, o, shape, solid);
    first.from_base = height_of(o, shape, solid);
    set_line(l, &first, &from, solid);
    set_ends(l, &from, solid);
}

/* z, w and the ends, loaded after the test of G. */
INLINE void load_after_G(local_line *l, const source *from, int solid)
{
    if (!cylint_solid_is_tapered(solid) && cylint_solid_has_planes(solid)) {
        first_line first;
        load_along(&first, from, solid);
        l->from_base = l->in.z = first.from_base;
        l->in.w = first.w;
    }
    l->limit[0] = v_load(&from->line->tmin);
    l->cap[0] = m_from(cylint_caps_present(from->shape->ends));
    set_ends(l, from, solid);
}

/* The numbers of the line in doubles that the stages in pairs read. */
INLINE void set_sizes(local_line *l, const cylint_question *q, int solid)
{
    const source from = {q->shape, q->line};
    set_surface(l, v_set(0), &from, solid);
    load_after_G(l, &from, solid);
    l->Q = v_set(q->Q);
    l->D = v_set(q->D);
    l->unit = v_set(cylint_frame_error(q->shape));
}

/* The matrix times a vector, whose components are hi[j] + lo[j] in all lanes.
 * lo may be NULL: 0. */
INLINE vqpair transformed(const cylint_shape *s, const vq hi[3], const vq lo[3])
{
    vq product[3], error[3];
    EACH(j, 3) {
        /* four numbers at each: another follows the last column */
        const vq M = q_load(cylint_column(s, j)),
                 M_lo = q_load(cylint_column_lo(s, j));
        product[j] = q_mul(hi[j], M);
        error[j] = q_product_error(hi[j], M);
        error[j] = q_sum_of(hi[j], M_lo, error[j]);
        if (lo)
            error[j] = q_sum_of(lo[j], M, error[j]);
    }
    const vqpair two = q_two_sum(product[0], product[1]);
    const vqpair all = q_two_sum(two.hi, product[2]);
    return (vqpair){all.hi, q_add(q_add(q_add(error[0], error[1]), error[2]),
                                  q_add(two.lo, all.lo))};
}

/* The matrix times a vector in lanes 0, 1 and 2. */
INLINE vqpair local_in_pairs(const cylint_shape *s, vqpair x)
{
    const vq hi[3] = {q_firsts(x.hi), q_seconds(x.hi), q_thirds(x.hi)};
    const vq lo[3] = {q_firsts(x.lo), q_seconds(x.lo), q_thirds(x.lo)};
    return transformed(s, hi, lo);
}

INLINE vqpair direction_in_pairs(const source *from, int solid)
{
    const double *d = from->line->d, *d_lo = from->line->d_lo;
    const vq hi[3] = {q_set(d[0]), q_set(d[1]), q_set(d[2])};
    const vq lo[3] = {q_set(d_lo[0]), q_set(d_lo[1]), q_set(d_lo[2])};
    if (solid == CYLINT_SOLID_SPHERE)
        return (vqpair){q_load(d), q_load(d_lo)};
    return transformed(from->shape, hi, from->line->segment ? lo : NULL);
}

/* (x, x, y, y). */
INLINE vqpair across_of(vqpair x)
{
    return (vqpair){q_spread(q_low(x.hi)), q_spread(q_low(x.lo))};
}

/* z in both lanes. */
INLINE vpair along_of(vqpair x)
{
    const vd hi = q_high(x.hi), lo = q_high(x.lo);
    return (vpair){v_firsts(hi, hi), v_firsts(lo, lo)};
}

/* moves: 1 computes v and w; 0 sets them to 0. */
INLINE void load_pairs(pair_line *to, const source *from, int moves, int solid)
{
    const vqpair x =
        q_two_diff(q_load(from->line->o), q_load(cylint_base(from->shape)));
    const vqpair p =
        solid == CYLINT_SOLID_SPHERE ? x : local_in_pairs(from->shape, x);
    vqpair v = {q_set(0), q_set(0)};
    if (moves)
        v = direction_in_pairs(from, solid);
    to->p = across_of(p);
    to->v = across_of(v);
    to->w = along_of(v);
    to->error = v_set(cylint_frame_error(from->shape));
    set_heights(to, along_of(p), from, solid);
}

/* One function for all solids. */
ASIDE void load_any_pairs(pair_line *to, const cylint_shape *shape,
                          const cylint_line *line, int moves)
{
    const source from = {shape, line};
    load_pairs(to, &from, moves, cylint_prepared(shape));
}

#endif
