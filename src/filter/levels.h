/*
 * levels.h - the residual at a root that pairs do not round
 *
 * A line that begins on the surface has a root near 0.  It is so small beside
 * the shape that the residual in pairs has too few digits.  Here the point
 * P = o + t d is written as
 *
 *   P = base + s w + F                circular kinds
 *   P = base + x a + y b + s w + F    elliptic kinds
 *
 * with doubles s, x, y that are near its coordinates.  F is then a sum of
 * products of doubles.  Circular kinds, with g = F.w and e = g / w.w:
 *
 *   Q = |F|^2 - g e - (r0 + dr (s + e))^2
 *
 * Of an acone the radius counts multiples of |w|, and Q is divided by w.w.
 * Elliptic kinds: F is small, so that its local coordinates f = M F are
 * accurate in pairs, and Q = (x + f_x)^2 + (y + f_y)^2 - rho^2, with rho at the
 * height of s + f_z.  Of a cap s is the end's, 0 or 1, and the residual is g or
 * f_z.
 *
 * Round kinds, with F = P - center of a ball of radius r: Q = |F|^2 - r^2.  The
 * cylinder of a capsule is a circular kind.  The cone of a round cone, with
 * F = P - base and c^2 = (w.w - dr^2) / w.w, is
 *
 *   c^2 Q = (|F|^2 - r0^2) (w.w - dr^2) / w.w - (F.w + dr r0)^2 / w.w
 *
 * Sums are kept in levels (levels_template.h).
 */
#ifndef CYLINT_LEVELS_H
#define CYLINT_LEVELS_H

#include "surfaces.h"

/* ----------------------------------------------------------- levels ----- */

/* Without a fused multiply-add the code for a product's error is long. */
#if V_HAS_FMA
#define LEVELS_INLINE INLINE
#else
#define LEVELS_INLINE ASIDE
#endif

/* The text for four lanes, of which three are used, and for one double. */
#define REAL vq
#define LEVELS vq_levels
#define FORM(name) q_##name
#define ADD(x, y) q_add(x, y)
#define MUL(x, y) q_mul(x, y)
#define SUM_OF(x, y, z) q_sum_of(x, y, z)
#define PAIR vqpair
#define TWO_SUM(x, y) q_two_sum(x, y)
#define PRODUCT_ERROR(x, y) q_product_error(x, y)
#include "levels_template.h"

#define REAL double
#define LEVELS levels
#define FORM(name) name
#define ADD(x, y) ((x) + (y))
#define MUL(x, y) ((x) * (y))
#define SUM_OF(x, y, z) sum_of(x, y, z)
#define PAIR pair
#define TWO_SUM(x, y) two_sum(x, y)
#define PRODUCT_ERROR(x, y) two_prod(x, y).lo
#include "levels_template.h"

INLINE double total(const levels *x)
{
    const pair s = two_sum(x->a, x->b);
    return s.hi + (s.lo + x->c);
}

/* Its total as a pair. */
INLINE pair total_pair(const levels *x)
{
    const pair s = two_sum(x->a, x->b);
    return fast_two_sum(s.hi, s.lo + x->c);
}

/* Adds lanes 0, 1 and 2. */
INLINE void add_lanes(levels *sum, const vq_levels *x)
{
    double a[4], b[4], c[4];
    q_store(a, x->a);
    q_store(b, x->b);
    q_store(c, x->c);
    EACH(i, 3)
        add_a(sum, a[i]);
    EACH(i, 3)
        add_b(sum, b[i]);
    sum->c += (c[0] + c[1]) + c[2];
}

/* The sum of lanes 0, 1 and 2. */
INLINE levels sum_of_lanes(const vq_levels *x)
{
    levels sum = {0, 0, 0};
    add_lanes(&sum, x);
    return sum;
}

INLINE void subtract(levels *from, levels x)
{
    add_a(from, -x.a);
    add_b(from, -x.b);
    from->c -= x.c;
}

/* -------------------------------------------------------- the point ----- */

/* A point near P: its coordinates along the axis, which is counted as 1, and in
 * units of the semi-axes. */
typedef struct {
    double x, y, s;
} near_point;

INLINE near_point point_near(const cylint_shape *shape, const cylint_line *line,
                             double t, int cap)
{
    double q[3], p[2];
    EACH(i, 3)
        q[i] = sum_of(t, line->d[i], line->o[i] - cylint_base(shape)[i]);
    v_store(p, across(shape, v_set(q[0]), v_set(q[1]), v_set(q[2])));
    const double s =
        v_first(along(shape, q[0], q[1], q[2])) * (1 / cylint_height(shape));
    return (near_point){p[0], p[1], cap < 0 ? s : cap};
}

/* P - center in lanes 0, 1 and 2.  A double follows the center. */
INLINE vq_levels vector_from_center(const double center[3],
                                    const cylint_line *line, double t)
{
    const vqpair from = q_two_diff(q_load(line->o), q_load(center));
    const vq T = q_set(t);
    vq_levels F = {from.hi, from.lo, q_set(0)};
    q_add_product_to_a(&F, T, q_load(line->d));
    q_add_product_to_b(&F, T, q_load(line->d_lo));
    return F;
}

/* The axis of a circular kind in lanes 0, 1 and 2. */
INLINE vq_levels axis_of(const cylint_shape *shape)
{
    const vq zero = q_set(0);
    if (cylint_has_tangent(shape->kind))
        return (vq_levels){q_load(cylint_axis(shape)), zero, zero};
    const vqpair w =
        q_two_diff(q_load(cylint_top(shape)), q_load(cylint_base(shape)));
    return (vq_levels){w.hi, w.lo, zero};
}

/* F in lanes 0, 1 and 2.  A number follows each vector of the shape. */
INLINE vq_levels vector_from(const near_point *near, const cylint_shape *shape,
                             const cylint_line *line, double t, int elliptic)
{
    const vq s = q_set(-near->s);
    vq_levels F = vector_from_center(cylint_base(shape), line, t);
    if (elliptic) {
        q_add_product_to_a(&F, q_set(-near->x), q_load(cylint_a(shape)));
        q_add_product_to_a(&F, q_set(-near->y), q_load(cylint_b(shape)));
        q_add_product_to_a(&F, s, q_load(cylint_axis(shape)));
        return F;
    }
    const vq_levels w = axis_of(shape);
    q_add_product_to_a(&F, s, w.a);
    q_add_product_to_b(&F, s, w.b);
    return F;
}

/* ---------------------------------------------------- the residuals ----- */

/* r0 + dr z, z = s + e. */
INLINE levels radius_at(const cylint_shape *shape, double s, pair e)
{
    levels rho = {cylint_r0(shape), 0, 0};
    const pair dr = cylint_radius_growth(shape);
    add_product_to_a(&rho, dr.hi, s);
    add_product_to_b(&rho, dr.lo, s);
    add_product_to_b(&rho, dr.hi, e.hi);
    rho.c += sum_of(dr.hi, e.lo, dr.lo * e.hi);
    return rho;
}

/* |F|^2 - r^2. */
INLINE levels surplus_in_levels(const vq_levels *F, double r)
{
    const vq_levels FF = q_square(F);
    const pair r2 = two_prod(-r, r);
    levels Q = {r2.hi, r2.lo, 0};
    add_lanes(&Q, &FF);
    return Q;
}

/* F.w of a small F.w, accurate enough for its square. */
INLINE double small_product(const vq_levels *F, vq w, vq w_lo)
{
    const vq high = q_mul(F->a, w);
    const vq low =
        q_sum_of(F->b, w, q_sum_of(F->a, w_lo, q_product_error(F->a, w)));
    double h[4], l[4];
    q_store(h, high);
    q_store(l, low);
    const pair two = two_sum(h[0], h[1]), all = two_sum(two.hi, h[2]);
    return all.hi + ((all.lo + two.lo) + ((l[0] + l[1]) + l[2]));
}

/* |w|^2 of an acone, |w| of other circular kinds. */
INLINE double scale_of(const cylint_shape *shape)
{
    const double *w = cylint_axis(shape);
    return cylint_has_tangent(shape->kind) ? cylint_dot(w, w)
                                           : cylint_height(shape);
}

INLINE double circular_residual(const cylint_shape *shape,
                                const cylint_line *line, double t, int cap,
                                int tapered)
{
    const near_point near = point_near(shape, line, t, cap);
    const vq_levels F = vector_from(&near, shape, line, t, 0);
    const vq_levels w = axis_of(shape);
    if (cap < 0 && !tapered) {
        levels Q = surplus_in_levels(&F, cylint_r0(shape));
        const double e =
            small_product(&F, w.a, w.b) * (1 / cylint_height(shape));
        Q.c -= e * e;
        return total(&Q);
    }
    const vq_levels Fw = q_levels_product(&F, &w), ww = q_square(&w);
    const levels g = sum_of_lanes(&Fw);
    if (cap >= 0)
        return total(&g) / scale_of(shape);
    const levels WW = sum_of_lanes(&ww);
    const pair e = pair_div(total_pair(&g), total_pair(&WW));
    const levels rho = radius_at(shape, near.s, e), rho2 = square(&rho);
    levels Q = surplus_in_levels(&F, 0);
    Q.c -= total(&g) * e.hi;
    if (!cylint_has_tangent(shape->kind)) {
        subtract(&Q, rho2);
        return total(&Q);
    }
    subtract(&Q, levels_product(&rho2, &WW));
    return total(&Q) / scale_of(shape);
}

INLINE double elliptic_residual(const cylint_shape *shape,
                                const cylint_line *line, double t, int cap,
                                int tapered)
{
    const near_point near = point_near(shape, line, t, cap);
    const vq_levels F = vector_from(&near, shape, line, t, 1);
    const vqpair sum = q_two_sum(F.a, F.b);
    const vqpair f =
        local_in_pairs(shape, (vqpair){sum.hi, q_add(sum.lo, F.c)});
    double f_hi[4], f_lo[4];
    q_store(f_hi, f.hi);
    q_store(f_lo, f.lo);
    if (cap >= 0)
        return f_hi[2] + f_lo[2];
    const double at[2] = {near.x, near.y};
    levels Q = {0, 0, 0}, rho = {1, 0, 0};
    EACH(i, 2) {
        add_product_to_a(&Q, at[i], at[i]);
        add_product_to_b(&Q, 2 * at[i], f_hi[i]);
        Q.c += sum_of(2 * at[i], f_lo[i], f_hi[i] * f_hi[i]);
    }
    if (tapered) {
        /* the row of z counts in units of 1 / height, a power of two */
        const double unit = 1 / cylint_height(shape);
        rho = radius_at(shape, near.s, (pair){f_hi[2] * unit, f_lo[2] * unit});
    }
    subtract(&Q, square(&rho));
    return total(&Q);
}

/* The residual of the ball about an end. */
INLINE double ball_residual_in_levels(const cylint_shape *shape,
                                      const cylint_line *line, double t,
                                      int top)
{
    const vq_levels F = vector_from_center(
        top ? cylint_top(shape) : cylint_base(shape), line, t);
    const levels Q = surplus_in_levels(&F, cylint_end_factor(shape, top));
    return total(&Q);
}

INLINE double round_cone_residual_in_levels(const cylint_shape *shape,
                                            const cylint_line *line, double t)
{
    const vq_levels F = vector_from_center(cylint_base(shape), line, t);
    const vq_levels w = axis_of(shape), ww = q_square(&w);
    const vq_levels Fw = q_levels_product(&F, &w);
    const levels surplus = surplus_in_levels(&F, cylint_r0(shape));
    const pair growth = cylint_radius_growth(shape);
    const levels dr = {growth.hi, growth.lo, 0};
    levels lateral2 = sum_of_lanes(&ww), height = sum_of_lanes(&Fw);
    subtract(&lateral2, square(&dr));
    add_product_to_a(&height, growth.hi, cylint_r0(shape));
    add_product_to_b(&height, growth.lo, cylint_r0(shape));
    levels Q = levels_product(&surplus, &lateral2);
    subtract(&Q, square(&height));
    const double side = cylint_height(shape) * cylint_cosine(shape);
    return total(&Q) / (side * side);
}

/* At t, of end `end` of the shape: of its ball or its plane if on_end, else of the
 * lateral surface. */
ASIDE double residual_in_levels(const cylint_shape *shape,
                                const cylint_line *line, double t, int end,
                                int on_end)
{
    const int cap = on_end ? end : -1;
    const int tapered = cylint_is_tapered(shape->kind);
    const int is_ball = shape->kind == CYLINT_KIND_SPHERE;
    if (is_ball || (cylint_is_round(shape->kind) && on_end))
        return ball_residual_in_levels(shape, line, t, is_ball ? 0 : end);
    if (shape->kind == CYLINT_KIND_RCONE)
        return round_cone_residual_in_levels(shape, line, t);
    return cylint_is_elliptic(shape->kind)
               ? elliptic_residual(shape, line, t, cap, tapered)
               : circular_residual(shape, line, t, cap, tapered);
}

/* Such residuals at t with the bounds on their errors. */
INLINE bounded_value bounded_levels(vd residual, vd t, const local_line *l,
                                    vm on_end, int solid)
{
    const vd size = size_at(t, l), wide = l->taper * size;
    const vm plane = m_and(on_end, m_if_all(!cylint_solid_is_round(solid)));
    return (bounded_value){residual,
                           v_set(CYLINT_LOCAL_LEVELS) * (l->unit * l->unit) *
                                   v_select(plane, size, wide * wide) +
                               v_set(CYLINT_LOCAL_SCALING) * v_abs(residual)};
}

#endif
