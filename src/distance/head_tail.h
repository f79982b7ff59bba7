/*
 * head_tail.h - numbers of a head and a tail, in lanes
 *
 * The head is a multiple of a power of two that all numbers of the question share,
 * about 2^-26 of their size (CYLINT_SNAP), and the tail is the rest.  Doubles
 * compute sums and products of heads without error, so only tails are rounded.
 * That is cheaper than pairs and has 71 instead of 90 bits.
 *
 * These are the operations of distance_template.h.
 */
#ifndef CYLINT_HEAD_TAIL_H
#define CYLINT_HEAD_TAIL_H

#include "pair_lanes.h"

INLINE vpair head_tail_split(vd x, vd snap)
{
    const vd head = (x + snap) - snap;
    return (vpair){head, x - head};
}

/* A length of the shape. */
INLINE vpair head_tail_datum(vpair x, const half_plane *m)
{
    const vpair y = head_tail_split(x.hi, m->snap);
    return (vpair){y.hi, y.lo + x.lo};
}

/* A number of size 1 at most: the head is a multiple of 2^-26. */
INLINE vpair head_tail_unit(vpair x)
{
    const vpair y = head_tail_split(x.hi, v_set(CYLINT_UNIT_SNAP));
    return (vpair){y.hi, y.lo + x.lo};
}

INLINE vpair head_tail_minus(vpair a, vpair b)
{
    return (vpair){a.hi - b.hi, a.lo - b.lo};
}

/* a + x y, y = x or -x.  whole: x rounded to a double. */
INLINE vpair head_tail_add_square(vpair a, vpair y, vpair x, vd whole)
{
    return (vpair){v_sum_of(y.hi, x.hi, a.hi),
                   v_sum_of(y.lo, whole + x.hi, a.lo)};
}

/* The point from the base.  The roots begin with the doubles rough_z and
 * rough_square, before heads and tails are there. */
INLINE void head_tail_load(half_plane *m, const shape_lanes *s,
                           const vd point[3], int axial)
{
    const vd zero = v_set(0);
    vpair D[3], square = {zero, zero}, z = square;
    vd rough = zero, rough_square = zero;
    m->size = s->reach;
    m->error = zero;
    EACH(i, 3) {
        D[i] = v_two_sum(point[i], -s->base[i]);
        m->size = m->size + v_abs(D[i].hi);
        rough = v_sum_of(D[i].hi, s->axis[i].hi + s->axis[i].lo, rough);
        rough_square = v_sum_of(D[i].hi, D[i].hi, rough_square);
    }
    m->snap = v_set(CYLINT_SNAP) * m->size;
    EACH(i, 3) {
        const vpair x = head_tail_datum(D[i], m);
        square = head_tail_add_square(square, x, x, D[i].hi);
        z.hi = v_sum_of(x.hi, s->axis[i].hi, z.hi);
        z.lo = v_sum_of(x.lo, s->axis[i].hi,
                        v_sum_of(D[i].hi, s->axis[i].lo, z.lo));
    }
    m->rough_square = rough_square;
    m->square = square;
    if (!axial)
        return;
    m->rough_z = rough;
    m->rough_square = v_sum_of(-rough, rough, rough_square);
    m->z.hi = (rough + m->snap) - m->snap;
    m->z.lo = (z.hi - m->z.hi) + z.lo;
    m->square =
        head_tail_add_square(square, opposite(m->z), m->z, rounded(m->z));
    m->above = head_tail_minus(m->z, head_tail_datum(s->height, m));
}

/* sqrt(a), which is nearly sqrt(rough). */
INLINE bounded_pairs head_tail_root(vpair a, vd rough, const half_plane *m)
{
    const vd root = v_sqrt(rough), half = v_set(0.5) / root;
    const vpair start = head_tail_split(root, m->snap);
    const vpair residual =
        head_tail_add_square(a, opposite(start), start, root);
    const vd unit = v_set(CYLINT_HEAD_TAIL_ERROR) * m->size;
    const vd thin = m->size * half;
    return (bounded_pairs){
        {start.hi, v_sum_of(residual.hi + residual.lo, half, start.lo)},
        v_select(v_le(thin, v_set(CYLINT_HEAD_TAIL_THINNEST)),
                 v_sum_of(unit, thin, unit), v_set(HUGE_VAL))};
}

/* The distance from the axis; of a sphere that from the centre. */
INLINE vpair head_tail_rho(half_plane *m)
{
    const bounded_pairs rho = head_tail_root(m->square, m->rough_square, m);
    m->error = rho.e;
    return rho.v;
}

/* rho in doubles; margin: above it the sign of a foot is right. */
INLINE vd head_tail_rough_rho(const half_plane *m, vd *margin)
{
    const vd rho = v_sqrt(v_max(m->rough_square, v_set(0)));
    const vd M = v_set(CYLINT_FEATURE_MARGIN) * m->size;
    *margin = v_sum_of(M, m->size * (v_set(0.5) / rho), M);
    return rho;
}

/* sqrt(x^2 + y^2). */
INLINE bounded_pairs head_tail_length(vpair x, vpair y, const half_plane *m)
{
    const vpair zero = {v_set(0), v_set(0)};
    const vpair square = head_tail_add_square(
        head_tail_add_square(zero, x, x, rounded(x)), y, y, rounded(y));
    bounded_pairs root = head_tail_root(square, rounded(square), m);
    root.e = root.e + m->error;
    return root;
}

/* The distance from a point of the axis at the height y below. */
INLINE bounded_pairs head_tail_ball(vpair y, vd rough_y, const half_plane *m)
{
    return head_tail_root(head_tail_add_square(m->square, y, y, rounded(y)),
                          v_sum_of(rough_y, rough_y, m->rough_square), m);
}

/* cosine x - sine z. */
INLINE vpair head_tail_turned(const shape_lanes *s, vpair x, vpair z)
{
    const vd C = s->cosine.hi, S = s->sine.hi;
    const vd across = v_sum_of(C, x.lo, s->cosine.lo * (x.hi + x.lo));
    const vd along = v_sum_of(S, z.lo, s->sine.lo * (z.hi + z.lo));
    return (vpair){v_sum_of(C, x.hi, -(S * z.hi)), across - along};
}

/* Unchanged: these operations allow a lo that is not small beside hi. */
INLINE vpair head_tail_trimmed(vpair x)
{
    return x;
}

#define NUMBER(name) head_tail_##name
#include "distance_template.h"

#endif
