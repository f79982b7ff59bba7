/*
 * limbs.h - a point and a shape in the half plane through the axis and the
 * point, in numbers of two limbs
 *
 * A number is hi + lo.  hi is a multiple of a power of two that all numbers of
 * the question share, about 2^-26 of their size (CYLINT_LIMB_SNAP), and lo is the
 * rest.  Doubles compute sums and products of hi without error, so only lo is
 * rounded.  That is cheaper than pairs and has 71 instead of 90 bits.
 */
#ifndef CYLINT_LIMBS_H
#define CYLINT_LIMBS_H

#include "half_plane.h"

#if LANES == 2

typedef struct {
    double hi, lo;
} limbs;

/* x as a multiple of the last bit of `snap`, and the rest. */
INLINE limbs split(double x, double snap)
{
    const double hi = (x + snap) - snap;
    return (limbs){hi, x - hi};
}

INLINE limbs limbs_sub(limbs a, limbs b)
{
    return (limbs){a.hi - b.hi, a.lo - b.lo};
}

INLINE double sum_of_limbs(limbs a)
{
    return a.hi + a.lo;
}

/* a + x^2 and a - x^2; x2: x rounded to a double. */
INLINE limbs plus_square(limbs a, limbs x, double x2)
{
    return (limbs){sum_of(x.hi, x.hi, a.hi), sum_of(x.lo, x2 + x.hi, a.lo)};
}

INLINE limbs minus_square(limbs a, limbs x, double x2)
{
    return (limbs){sum_of(-x.hi, x.hi, a.hi), sum_of(-x.lo, x2 + x.hi, a.lo)};
}

INLINE limbs limbs_from(vd x)
{
    return (limbs){v_first(x), v_first(v_turned(x))};
}

/* The point D from the base: z = D.unit and the square of |D|.  The same in
 * doubles, where roots begin before the limbs are there. */
typedef struct {
    limbs z, square;
    double rough_z, rough_square;
    double size, snap; /* size: at least |D|, the height and the radii */
} upright;

/* The direction of the axis as multiples of 2^-26, and the rest. */
INLINE vqpair split_axis(const cylint_shape *s)
{
    const double *x = cylint_column(s, 0), *y = cylint_column(s, 1),
                 *z = cylint_column(s, 2);
    const vq hi = q_join(v_two(x[2], y[2]), v_two(z[2], 0));
    const vq lo = q_join(v_two(x[2 + CYLINT_LOW], y[2 + CYLINT_LOW]),
                         v_two(z[2 + CYLINT_LOW], 0));
    const vq snap = q_set(CYLINT_UNIT_SNAP);
    const vq unit = q_sub(q_add(hi, snap), snap);
    return (vqpair){unit, q_add(q_sub(hi, unit), lo)};
}

/* The same of cosine and sine. */
INLINE limbs split_unit(pair x)
{
    const limbs y = split(x.hi, CYLINT_UNIT_SNAP);
    return (limbs){y.hi, y.lo + x.lo};
}

/* Reads a point.  Near the shape a snap of the shape alone serves, so that nothing
 * waits for the size.  `axial`: with z. */
INLINE void load_upright(upright *m, const cylint_shape *s,
                         const double point[3], int axial)
{
    const vq zero = q_set(0);
    const vqpair D = q_two_diff(q_load3(point), q_load3(cylint_base(s)));
    m->size = q_sum3(q_abs(D.hi)) + cylint_reach(s);
    m->snap = cylint_reach(s) * (CYLINT_LIMB_NEAR * CYLINT_LIMB_SNAP);
    if (!(CYLINT_LIMB_SNAP * m->size <= m->snap)) {
        CYLINT_BY_BRANCH;
        m->snap = CYLINT_LIMB_SNAP * m->size;
    }
    const vqpair axis = axial ? split_axis(s) : (vqpair){zero, zero};
    const vq unit = axis.hi, rest = q_mul(D.hi, axis.lo);
    const vd rough = q_sums3(q_sum_of(D.hi, unit, rest), q_mul(D.hi, D.hi));
    m->rough_z = v_first(rough);
    m->rough_square = v_first(v_turned(rough));
    const vq snap = q_set(m->snap), hi = q_sub(q_add(D.hi, snap), snap);
    const vq lo = q_add(q_sub(D.hi, hi), D.lo);
    m->square = limbs_from(q_sums3(q_mul(hi, hi), q_mul(lo, q_add(D.hi, hi))));
    if (!axial)
        return;
    const limbs z =
        limbs_from(q_sums3(q_mul(hi, unit), q_sum_of(lo, unit, rest)));
    m->z.hi = (m->rough_z + m->snap) - m->snap;
    m->z.lo = (z.hi - m->z.hi) + z.lo;
}

/* sqrt(a), s its root in doubles, and the bound on its error. */
INLINE limbs root_of_limbs(limbs a, double s, const upright *m, double *error)
{
    const double half = 0.5 / s;
    const limbs root = split(s, m->snap);
    const double rest = sum_of_limbs(minus_square(a, root, s));
    const double unit = CYLINT_LIMB_ERROR / CYLINT_LIMB_SNAP * m->snap;
    const double thin = m->size * half;
    *error = thin <= CYLINT_LIMB_THINNEST ? sum_of(unit, thin, unit) : HUGE_VAL;
    return (limbs){root.hi, sum_of(rest, half, root.lo)};
}

/* The square of the distance from the axis. */
INLINE limbs square_across(const upright *m)
{
    return minus_square(m->square, m->z, sum_of_limbs(m->z));
}

INLINE double rough_square_across(const upright *m)
{
    return sum_of(-m->rough_z, m->rough_z, m->rough_square);
}

INLINE limbs limbs_select(vm which, limbs a, limbs b)
{
    return limbs_from(v_select(which, v_two(a.hi, a.lo), v_two(b.hi, b.lo)));
}

/* (-error, error) */
INLINE vd both_ways(double error)
{
    return v_two(-error, error);
}

/* The doubles nearest to the ends of the interval a + both.  If they are equal,
 * every number between rounds to them. */
INLINE vd round_limbs(limbs a, vd both)
{
    return v_set(a.hi) + (v_set(a.lo) + both);
}

#endif
#endif
