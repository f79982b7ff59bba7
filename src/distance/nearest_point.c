/*
 * nearest_point.c - the nearest point and the normal there
 *
 * Let V / sqrt(K) = g R / T (exact_distance.h).  Off the axis V = g R and
 * K = T^2.  On the axis V = g W U and K = g W |U|^2, where U = e x w points to
 * phi = 0.  Then, t = 1 off the axis and 0 on it,
 *
 *   lateral    P = x - (t sqrt(K) - c) (V / sqrt(K) - dr w) / (W (g + dr^2))
 *   rim        P = centre + r V / (g sqrt(K))
 *   tangency   P = centre + r (V / sqrt(K) - dr w) / W
 *   cap        P = x - (D_i.w / W) w
 *   ball       P = centre + r D_i / |D_i|
 *   apex       P = base - (r_0 / dr) w
 *
 * so every coordinate is (a + b sqrt(K)) / d of exact numbers.
 */
#include <limits.h>

#include "../roots/roots.h"
#include "exact_distance.h"

/* The direction from the axis to the point: V / sqrt(K). */
typedef struct {
    exact V[3], K;
} radial;

static radial radial_direction(meridian *m)
{
    const exact *w = m->L->w;
    exact R[3], factor = m->g;
    radial d;
    d.K = m->T2;
    if (m->q.sign != 0) {
        cylint_cross_exact(m->L, w, m->X, R);
    } else { /* e x w, e along the axis's least component */
        const int i = cylint_least_axis_component(m->shape);
        R[i] = cylint_exact_zero(m->arena);
        R[(i + 1) % 3] = cylint_exact_neg(w[(i + 2) % 3]);
        R[(i + 2) % 3] = w[(i + 1) % 3];
        factor = EXACT_MUL(m->g, m->L->vv);
        d.K = EXACT_MUL(factor, cylint_dot_exact(m->L, R, R));
    }
    for (int i = 0; i < 3; i++)
        d.V[i] = EXACT_MUL(factor, R[i]);
    return d;
}

/* The direction from the centre of a ball. */
static radial ball_direction(meridian *m, int end)
{
    const exact *D = m->L->D[end];
    radial d = {{D[0], D[1], D[2]}, cylint_dot_exact(m->L, D, D)};
    if (d.K.sign == 0)
        d.K = d.V[0] = m->L->one;
    return d;
}

/* ------------------------------------------------------------- point --- */

/* Coordinate i of the centre of an end. */
static exact centre(meridian *m, int end, int i)
{
    const cylint_shape *s = m->shape;
    const exact base = cylint_exact_from(m->arena, cylint_base(s)[i]);
    if (!end)
        return base;
    return cylint_has_end_points(s->kind)
               ? cylint_exact_from(m->arena, cylint_top(s)[i])
               : EXACT_ADD(base, m->L->w[i]);
}

/* dr w. */
static exact slope(meridian *m, int i)
{
    return EXACT_MUL(m->dr, m->L->w[i]);
}

/* K (W (g + dr^2) x - t V - c dr w). */
static exact foot_a(meridian *m, const radial *d, int i)
{
    EXACT_BEGIN
    exact a =
        EXACT_MUL(exact_unit(m), cylint_exact_from(m->arena, m->point[i]));
    a = EXACT_SUB(a, EXACT_MUL(m->c, slope(m, i)));
    if (m->q.sign != 0)
        a = EXACT_SUB(a, d->V[i]);
    a = EXACT_MUL(d->K, a);
    EXACT_RETURN(a)
}

/* t dr w K + c V. */
static exact foot_b(meridian *m, const radial *d, int i)
{
    EXACT_BEGIN
    exact b = EXACT_MUL(m->c, d->V[i]);
    if (m->q.sign != 0)
        b = EXACT_ADD(b, EXACT_MUL(slope(m, i), d->K));
    EXACT_RETURN(b)
}

static surd_quotient foot(meridian *m, const radial *d, int i)
{
    const exact a = foot_a(m, d, i), b = foot_b(m, d, i);
    return (surd_quotient){{a, b, d->K}, EXACT_MUL(d->K, exact_unit(m))};
}

/* centre + r (V / sqrt(K) - dr w) / u, where dr w counts for a circle of tangency
 * only. */
static surd_quotient on_circle(meridian *m, const radial *d, int end, int i,
                               exact u, int is_tangency)
{
    const exact r = m->L->r[end];
    exact a = EXACT_MUL(u, centre(m, end, i));
    if (is_tangency)
        a = EXACT_SUB(a, EXACT_MUL(r, slope(m, i)));
    return (surd_quotient){{EXACT_MUL(d->K, a), EXACT_MUL(r, d->V[i]), d->K},
                           EXACT_MUL(d->K, u)};
}

/* x - (y / u) w */
static surd_quotient shifted_by_axis(meridian *m, exact x, exact y, exact u,
                                     int i)
{
    return exact_quotient(
        m, EXACT_SUB(EXACT_MUL(u, x), EXACT_MUL(y, m->L->w[i])), u);
}

static surd_quotient coordinate(meridian *m, int feature, const radial *d,
                                int i)
{
    const int end = cylint_end_of(m, feature);
    if (cylint_is_on_ball(m, feature))
        return on_circle(m, d, end, i, m->L->one, 0);
    if (cylint_is_on_plane(m, feature))
        return shifted_by_axis(m, cylint_exact_from(m->arena, m->point[i]),
                               m->height[end], m->L->vv, i);
    if (feature == CYLINT_FEATURE_LATERAL)
        return foot(m, d, i);
    return !cylint_ends_are_planes(m->shape->ends)
               ? shifted_by_axis(m, centre(m, 0, i), m->L->r[0], m->L->dr, i)
           : cylint_is_round(m->L->kind) ? on_circle(m, d, end, i, m->L->vv, 1)
                                         : on_circle(m, d, end, i, m->g, 0);
}

static double double_of(meridian *m, floating x)
{
    return cylint_positive_zero(cylint_double_of_pair(m->arena, x.v, x.e));
}

static void write_nearest_point(meridian *m, int feature, const radial *d,
                                double point[3])
{
    for (int i = 0; i < 3; i++) {
        const int used = m->arena->used;
        const surd_quotient x = coordinate(m, feature, d, i);
        point[i] = double_of(m, cylint_surd_quotient_value(m->arena, &x));
        m->arena->used = used;
    }
}

/* ------------------------------------------------------------ normal --- */

/* Component i of V - dr w sqrt(K). */
static floating lateral_normal(meridian *m, const radial *d, int i)
{
    const int used = m->arena->used;
    const surd_sum x = {d->V[i], cylint_exact_neg(EXACT_MUL(m->dr, m->L->w[i])),
                        d->K};
    const floating value = cylint_surd_sum_value(m->arena, &x);
    m->arena->used = used;
    return value;
}

/* x / |x|, rounded from a quotient of pairs. */
static void normalise(meridian *m, const floating x[3], int sign, double to[3])
{
    pair sum = {0, 0};
    int e = INT_MIN / 2; /* below all exponents, and can be negated */
    for (int i = 0; i < 3; i++)
        if (x[i].v.hi != 0 && x[i].e > e)
            e = x[i].e;
    for (int i = 0; i < 3; i++) {
        const pair y = cylint_scaled_pair(x[i].v, x[i].e - e);
        sum = pair_add(sum, pair_mul(y, y));
    }
    const floating size = {pair_sqrt(sum), e};
    for (int i = 0; i < 3; i++) {
        const floating n = floating_div(x[i], size);
        /* mutant '<' -> '<=': sign is 1 or -1 */
        const pair v = sign < 0 ? pair_neg(n.v) : n.v;
        to[i] = double_of(m, (floating){v, n.e});
    }
}

static void write_nearest_normal(meridian *m, int feature, const radial *d,
                                 double normal[3])
{
    const int on_ball = cylint_is_on_ball(m, feature);
    const int on_plane = !on_ball && cylint_is_on_plane(m, feature);
    const int is_apex =
        cylint_stated_feature(m->shape, feature) == CYLINT_FEATURE_APEX;
    floating x[3];
    for (int i = 0; i < 3; i++)
        x[i] = on_ball               ? cylint_floating(d->V[i])
               : on_plane || is_apex ? cylint_floating(m->L->w[i])
                                     : lateral_normal(m, d, i);
    const int sign = is_apex ? cylint_apex_normal_sign(m->shape, 0)
                     : feature == CYLINT_FEATURE_CAP0 && !on_ball ? -1
                                                                  : 1;
    normalise(m, x, sign, normal);
}

void cylint_nearest_point(meridian *m, int feature, unsigned want,
                          cylint_closest *answer)
{
    const int used = m->arena->used;
    const radial d = cylint_is_on_ball(m, feature)
                         ? ball_direction(m, cylint_end_of(m, feature))
                         : radial_direction(m);
    if (want & CYLINT_WANT_POINT)
        write_nearest_point(m, feature, &d, answer->point);
    if (want & CYLINT_WANT_NORMAL)
        write_nearest_normal(m, feature, &d, answer->normal);
    m->arena->used = used;
}
