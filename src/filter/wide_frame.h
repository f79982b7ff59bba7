/*
 * wide_frame.h - frame.h for a question in each lane
 */
#ifndef CYLINT_WIDE_FRAME_H
#define CYLINT_WIDE_FRAME_H

#include "frame.h"

/* The same shape in all lanes. */
INLINE void broadcast_shape(frames *to, const cylint_shape *shape)
{
    for (int i = 0; i < MEMBERS; i++)
        to->of[i] = v_set(shape->library.number[i]);
    for (int i = 0; i < FACTS; i++)
        to->fact[i] = m_if_all(has_fact(shape, i));
}

/* Reads members of the shapes, each at shape[lane], from `first` to before `end`
 * in fours. */
INLINE void gather_members(frames *to, const cylint_shape *const shape[LANES],
                           int first, int end)
{
    const char *row[LANES];
    for (int i = 0; i < LANES; i++)
        row[i] = (const char *)shape[i]->library.number;
    for (int i = first; i < end; i += 4)
        v_columns(row, (size_t)i * sizeof(double), &to->of[i]);
}

/* What all of a solid's questions read. */
INLINE void gather_numbers(frames *to, const cylint_shape *const shape[LANES],
                           int solid)
{
    gather_members(to, shape, 0,
                   solid == CYLINT_SOLID_SPHERE
                       ? CYLINT_AT_R1
                       : CYLINT_AT_COLUMNS + CYLINT_LOW);
}

INLINE void gather_fact(frames *to, const cylint_shape *const shape[LANES],
                        int fact)
{
    unsigned bits = 0;
    for (int i = 0; i < LANES; i++)
        bits |= (unsigned)has_fact(shape[i], fact) << i;
    to->fact[fact] = m_from(bits);
}

/* The numbers and the caps.  gather_pairs(): the low parts, which roots read. */
INLINE void gather_shapes(frames *to, const cylint_shape *const shape[LANES],
                          int solid)
{
    EACH(i, 2)
        gather_fact(to, shape, FACT_CAP0 + i);
    gather_numbers(to, shape, solid);
}

INLINE void gather_pairs(frames *to, const cylint_shape *const shape[LANES],
                         int solid)
{
    if (solid != CYLINT_SOLID_SPHERE)
        gather_members(to, shape, CYLINT_AT_COLUMNS + CYLINT_LOW, MEMBERS);
}

INLINE vd v_largest(const vd x[3])
{
    return v_max(v_max(v_abs(x[0]), v_abs(x[1])), v_abs(x[2]));
}

INLINE vd row_of(const frames *f, int row, const vd x[3])
{
    return v_sum_of(x[2], f->of[CYLINT_AT_COLUMNS + 6 + row],
                    v_sum_of(x[1], f->of[CYLINT_AT_COLUMNS + 3 + row],
                             x[0] * f->of[CYLINT_AT_COLUMNS + row]));
}

/* The line's origin, and the numbers of the shape that G reads. */
INLINE void load_point(local_line *l, const vd o[3], const source *from,
                       int solid)
{
    const frames *f = from->frame;
    const int ball = solid == CYLINT_SOLID_SPHERE;
    vd x[3];
    EACH(i, 3)
        x[i] = o[i] - f->of[CYLINT_AT_BASE + i];
    EACH(i, 2)
        l->in.p[i] = v_if(ball, x[i], row_of(f, i, x));
    set_surface(l, v_if(ball, x[2], row_of(f, 2, x)), from, solid);
    l->Q = v_if(
        ball, v_largest(x) + f->of[CYLINT_AT_R0],
        v_sum_of(v_largest(x), f->of[CYLINT_AT_NORM], f->of[CYLINT_AT_REACH]));
    l->unit = v_set(solid == CYLINT_SOLID_ROUND_CONE
                        ? CYLINT_LOCAL_ROUND * CYLINT_ROUNDING
                        : CYLINT_ROUNDING);
    l->in_range = v_le(v_largest(o), v_set(CYLINT_FAR));
}

INLINE void load_first(local_line *l, const source *from, int solid)
{
    const frames *f = from->frame;
    const int ball = solid == CYLINT_SOLID_SPHERE;
    const vd *d = from->line->d;
    const vd size = v_largest(d), most = v_set(CYLINT_WINDOW);
    load_point(l, from->line->o, from, solid);
    EACH(i, 2)
        l->in.v[i] = v_if(ball, d[i], row_of(f, i, d));
    l->in.w = v_if(ball, d[2], row_of(f, 2, d));
    set_products_doubles(&l->in);
    l->D = v_if(ball, size, size * f->of[CYLINT_AT_NORM]);
    l->in_range =
        m_and(m_and(v_le(v_set(1 / CYLINT_WINDOW), size), v_le(size, most)),
              l->in_range);
}

INLINE void load_after_G(local_line *l, const source *from, int solid)
{
    EACH(k, 2) {
        l->limit[k] = from->line->limit[k];
        l->cap[k] = fact_of(from, k);
    }
    set_ends(l, from, solid);
}

/* A point: the origin of a line with the direction 0. */
INLINE void load_place(local_line *l, const vd o[3], const frames *f, int solid)
{
    const source from = {f, NULL};
    load_point(l, o, &from, solid);
    l->in.v[0] = l->in.v[1] = l->in.w = l->D = v_set(0);
    set_ends(l, &from, solid);
}

/* Coordinate i of the plane of an end, exactly, and the lanes in which it certainly
 * is that of all points of the plane: frames do not have the top. */
INLINE vpair plane_coordinate(const source *from, int i, vm top, vm *is_fixed)
{
    const int j = CYLINT_AT_COLUMNS + 3 * ((i + 1) % 3) + 2,
              k = CYLINT_AT_COLUMNS + 3 * ((i + 2) % 3) + 2;
    const vd turned = v_abs(number_at(from, j)) + v_abs(number_at(from, k));
    *is_fixed = m_and_not(v_eq(turned, v_set(0)), top);
    return (vpair){number_at(from, CYLINT_AT_BASE + i), v_set(0)};
}

/* A row of the matrix times x.  exact: x has no low parts. */
INLINE vpair row_in_pairs(const frames *f, int row, const vpair x[3], int exact)
{
    vpair product[3];
    EACH(j, 3) {
        product[j] =
            v_two_prod(x[j].hi, f->of[CYLINT_AT_COLUMNS + 3 * j + row]);
        product[j].lo = v_sum_of(
            x[j].hi, f->of[CYLINT_AT_COLUMNS + CYLINT_LOW + 3 * j + row],
            product[j].lo);
        if (!exact)
            product[j].lo = v_sum_of(
                x[j].lo, f->of[CYLINT_AT_COLUMNS + 3 * j + row], product[j].lo);
    }
    const vpair first = v_two_sum(product[0].hi, product[1].hi);
    const vpair all = v_two_sum(first.hi, product[2].hi);
    return (vpair){all.hi, ((product[0].lo + product[1].lo) + product[2].lo) +
                               (first.lo + all.lo)};
}

INLINE void load_pairs(pair_line *to, const source *from, int solid)
{
    const frames *f = from->frame;
    const int ball = solid == CYLINT_SOLID_SPHERE;
    const int exact = !from->line->segment;
    vpair x[3], d[3], p[3], v[3];
    EACH(i, 3) {
        x[i] = v_two_sum(from->line->o[i], -f->of[CYLINT_AT_BASE + i]);
        d[i] = direction_at(from, i);
    }
    EACH_FUSED(i, 3) {
        p[i] = ball ? x[i] : row_in_pairs(f, i, x, 0);
        v[i] = ball ? d[i] : row_in_pairs(f, i, d, exact);
    }
    to->p = (vqpair){q_join(p[0].hi, p[1].hi), q_join(p[0].lo, p[1].lo)};
    to->v = (vqpair){q_join(v[0].hi, v[1].hi), q_join(v[0].lo, v[1].lo)};
    to->w = v[2];
    to->error = v_if(ball, v_set(CYLINT_LOCAL_ERROR), f->of[CYLINT_AT_ERROR]);
    set_heights(to, p[2], from, solid);
}

#endif
