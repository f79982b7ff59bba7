/*
 * pair_forms.h - the forms of one line and one shape in pairs, rounded
 *
 * Narrow lanes (frame.h): lane i belongs to end i.
 */
#ifndef CYLINT_PAIR_FORMS_H
#define CYLINT_PAIR_FORMS_H

#include "surfaces.h"

/* Zeros, without which compilers warn where `solid` is not a constant. */
static const local_line no_line;
static const forms no_forms;
static const verdict no_verdict;

/* The planes and circles of the ends. */
INLINE void set_planes(vpair z[1], vpair r[1], const pair_line *in,
                       const cylint_shape *shape, int solid)
{
    const source from = {shape, NULL};
    const vd r0 = v_set(cylint_r0(shape)), both = v_load(cylint_radii(shape));
    z[0] = in->z[0];
    r[0].hi = v_if(cylint_solid_is_tapered(solid), both, r0);
    r[0].lo = v_set(0);
    if (solid == CYLINT_SOLID_ROUND_CONE)
        move_to_circle_in_pairs(z, r, &from);
}

/* The line of the forms. */
INLINE void set_pairs(line_pairs *x, const pair_line *in, vpair z, vpair r,
                      const cylint_shape *shape, int solid)
{
    const int tapered = cylint_solid_is_tapered(solid);
    EACH(i, 2) {
        x->p[i] = pairs_of_two(in->p, i);
        x->v[i] = pairs_of_two(in->v, i);
    }
    x->z = pairs_of_end(&z, 0);
    x->r = pairs_of_end(&r, 0);
    x->w = in->w;
    x->slope =
        vpair_set(tapered ? cylint_slope(shape) : 0,
                  tapered ? cylint_number_pair(shape, CYLINT_AT_SLOPE).lo : 0);
    set_products_pairs(x);
}

/* The forms in pairs, rounded; and the line rounded. */
INLINE void forms_in_pairs(forms *f, balls *b, local_line *l,
                           const pair_line *in, const cylint_shape *shape,
                           int solid)
{
    const int tapered = cylint_solid_is_tapered(solid);
    const int ball = solid == CYLINT_SOLID_SPHERE;
    vpair z[1], r[1], Y[2] = {vpair_set(0, 0), vpair_set(0, 0)};
    line_pairs x;
    set_planes(z, r, in, shape, solid);
    set_pairs(&x, in, z[0], r[0], shape, solid);
    l->z[0] = rounded(z[0]);
    l->in.w = rounded(x.w);
    l->in.slope = x.slope.hi;
    if (cylint_solid_is_round(solid)) {
        const vpair center = ball ? x.z : in->z[0];
        const vpair radius = {l->ball_r[0], v_set(0)};
        f->A = rounded(ball_A_pairs(&x));
        f->B = rounded(ball_B_pairs(&x, center));
        f->G = rounded(ball_g_pairs(&x, center, radius));
        if (ball)
            return;
        set_balls(b, l, f->A, &f->B, &f->G);
    }
    if (tapered)
        set_Y_pairs(&x, Y);
    EACH(i, 2)
        f->Y[i] = v_if(tapered, rounded(Y[i]), v_set(0));
    f->G = rounded(G_pairs(&x, tapered, Y));
    f->A = rounded(A_pairs(&x, tapered));
    f->B = rounded(B_pairs(&x, tapered));
    if (solid == CYLINT_SOLID_NAPPE)
        f->T = rounded(T_pairs(&x, Y));
    if (!cylint_solid_has_planes(solid))
        return;
    f->E[0] = rounded(E_pairs(&x, z[0], r[0]));
    f->N[0] = rounded(N_pairs(&x, z[0], r[0], tapered));
}

/* Adds to the bound the roundings of a value; of A also that of A t where t is
 * estimated. */
INLINE void count_roundings(bounded_value *x, int roundings)
{
    x->e = v_sum_of(v_set(roundings * CYLINT_ROUNDING), v_abs(x->v), x->e);
}

INLINE void count_all_roundings(verdict *v, int solid)
{
    count_roundings(&v->G, 1);
    count_roundings(&v->A, 2);
    count_roundings(&v->B, 1);
    if (!cylint_solid_is_hull(solid))
        return;
    count_roundings(&v->ball.g[0], 1);
    count_roundings(&v->ball.A, 2);
    count_roundings(&v->ball.B[0], 1);
}

#endif
