/*
 * pair_lanes.h - the operations of distance_template.h on pairs of doubles
 *
 * With |D| for |D0| + |D1| + |D2| and u = CYLINT_POINT_ROUNDING, which is more
 * than the relative error of an entry of the axis, the bounds on errors are
 *
 *   z        u |D|
 *   A_i      u (3 |D| |w_i| + 2^-6 |D_i|),  A = D - z w
 *   rho      the sum of these, and CYLINT_PAIR_QUOTIENT rho
 *
 * Where the axis runs along a coordinate, that of A is 0, and the others are those
 * of D, without an error: the zeros of such a shape are certain.
 *
 * A is trimmed before it is squared: near the axis its tail is as large as its
 * head.
 */
#ifndef CYLINT_PAIR_LANES_H
#define CYLINT_PAIR_LANES_H

#include "half_plane.h"

INLINE vpair pairs_trimmed(vpair x)
{
    return v_fast_two_sum(x.hi, x.lo);
}

INLINE vpair pairs_datum(vpair x, const half_plane *m)
{
    (void)m;
    return x;
}

INLINE vpair pairs_unit(vpair x)
{
    return x;
}

INLINE vpair pairs_minus(vpair a, vpair b)
{
    return vpair_sub(a, b);
}

INLINE vpair pairs_sum3(const vpair x[3])
{
    const vpair s = v_two_sum(x[0].hi, x[1].hi), t = v_two_sum(s.hi, x[2].hi);
    return (vpair){t.hi, (s.lo + t.lo) + (x[0].lo + (x[1].lo + x[2].lo))};
}

/* sqrt(a) and its inverse, both 0 where a is; relative errors
 * CYLINT_PAIR_QUOTIENT. */
INLINE vpair pairs_root(vpair a, vpair *inverse)
{
    a = pairs_trimmed(a);
    const vd zero = v_set(0), one = v_set(1), s = v_sqrt(a.hi);
    const vd y = v_select(v_lt(zero, s), one / s, zero);
    const vpair p = v_two_prod(s, s), q = v_two_prod(y, s);
    const vd step = (((a.hi - p.hi) - p.lo) + a.lo) * (v_set(0.5) * y);
    const vd residual = (one - q.hi) - q.lo;
    *inverse = (vpair){y, y * v_sum_of(-y, step, residual)};
    return (vpair){s, step};
}

INLINE void pairs_load(half_plane *m, const shape_lanes *s, const vd x[3],
                       int axial)
{
    vpair p[3];
    vd size = v_set(0);
    EACH(i, 3) {
        m->D[i] = v_two_sum(x[i], -s->base[i]);
        size = size + v_abs(m->D[i].hi);
        p[i] =
            axial ? vpair_product(m->D[i], s->axis[i]) : vpair_square(m->D[i]);
    }
    m->size = size + s->reach;
    if (!axial) {
        const vd zero = v_set(0);
        m->square = pairs_sum3(p);
        m->z = (vpair){zero, zero};
        m->z_error = zero;
        EACH(i, 3)
            m->across_error[i] = zero;
        return;
    }
    m->z = pairs_sum3(p);
    const vd zero = v_set(0), u = v_set(CYLINT_POINT_ROUNDING);
    m->z_error = u * size;
    m->above = vpair_sub(m->z, s->height);
    EACH(i, 3) {
        const vpair along = vpair_product(m->z, s->axis[i]);
        const vpair across = pairs_trimmed(vpair_sub(m->D[i], along));
        const vd error = v_sum_of(v_set(3) * size, v_abs(s->axis[i].hi),
                                  v_set(0x1p-6) * v_abs(m->D[i].hi));
        m->across[i] = pick(s->own[i], (vpair){zero, zero}, across);
        m->across_error[i] = v_select(s->along, zero, u * error);
        p[i] = vpair_square(m->across[i]);
    }
    m->square = pairs_sum3(p);
    m->rough_z = rounded(m->z);
}

/* Then rho, with the errors of it and of all.  One lane takes less time if it is
 * computed where it is used. */
INLINE void pairs_load_rho(half_plane *m)
{
    m->rho = pairs_root(m->square, &m->inverse);
    m->rho_error = v_set(CYLINT_PAIR_QUOTIENT) * m->rho.hi;
    EACH(i, 3)
        m->rho_error = m->rho_error + m->across_error[i];
    m->error = v_sum_of(v_set(CYLINT_PAIR_DISTANCE), m->size,
                        m->z_error + m->rho_error);
}

INLINE vpair pairs_rho(const half_plane *m)
{
    return m->rho;
}

INLINE vd pairs_rough_rho(const half_plane *m, vd *margin)
{
    *margin = margin_of(m);
    return m->rho.hi;
}

INLINE bounded_pairs pairs_length(vpair x, vpair y, const half_plane *m)
{
    vpair inverse;
    const vpair square = vpair_add(vpair_square(x), vpair_square(y));
    return (bounded_pairs){pairs_root(square, &inverse), m->error};
}

INLINE bounded_pairs pairs_ball(vpair y, vd rough_y, const half_plane *m)
{
    (void)rough_y;
    vpair inverse;
    const vpair square = vpair_add(m->square, vpair_square(y));
    return (bounded_pairs){pairs_root(square, &inverse), m->error};
}

INLINE vpair pairs_turned(const shape_lanes *s, vpair x, vpair z)
{
    return vpair_sub(vpair_product(s->cosine, x), vpair_product(s->sine, z));
}

#define NUMBER(name) pairs_##name
#include "distance_template.h"

#endif
