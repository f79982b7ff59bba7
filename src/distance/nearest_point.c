/*
 * nearest_point.c - the nearest point and the normal there
 *
 * Let R t = g R / T (exact_distance.h), the direction from the axis to the point:
 * t = sqrt(x / y) with x = g and y = q.  On the axis R = e x w, which points to
 * phi = 0, x = g W and y = |R|^2.  Then, s = 1 off the axis and 0 on it,
 *
 *   lateral    P = point - (s T - c) (R t - dr w) / (W (g + dr^2))
 *   rim        P = centre + r R t / g
 *   tangency   P = centre + r (R t - dr w) / W
 *   cap        P = point - (D_i.w / W) w
 *   ball       P = centre + r D_i t, t = 1 / |D_i|
 *   apex       P = base - (r_0 / dr) w
 *
 * As T = q t and T t = g, every coordinate is (a + b t) / d of exact numbers.
 * Every component of the normal is (a + b t) / sqrt(d): of R t - dr w, w or D_i t,
 * divided by its length.
 */
#include "exact_distance.h"

/* R t; of a ball D_i t. */
typedef struct {
    exact R[3];
    surd t;
} radial;

static radial radial_direction(meridian *m)
{
    const exact *w = m->L->w;
    exact x = m->g, y = m->q;
    radial d;
    if (m->q.sign != 0) {
        cylint_cross_exact(m->L, w, m->X, d.R);
    } else { /* e along the axis's least component */
        const int i = cylint_least_axis_component(m->shape);
        d.R[i] = cylint_exact_zero(m->arena);
        d.R[(i + 1) % 3] = cylint_exact_neg(w[(i + 2) % 3]);
        d.R[(i + 2) % 3] = w[(i + 1) % 3];
        x = EXACT_MUL(m->g, m->L->vv);
        y = cylint_dot_exact(m->L, d.R, d.R);
    }
    d.t = cylint_root_of_quotient(&m->query, x, y);
    return d;
}

/* In the centre of a ball that of the first coordinate. */
static radial direction_from_centre(meridian *m, int end)
{
    const exact *D = m->L->D[end], one = m->L->one;
    exact square = cylint_dot_exact(m->L, D, D);
    radial d = {.R = {D[0], D[1], D[2]}};
    if (square.sign == 0)
        square = d.R[0] = one;
    d.t = cylint_root_of_quotient(&m->query, one, square);
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

/* W (g + dr^2) x - s g R - c dr w + (s q dr w + c R) t. */
static surd_quotient foot(meridian *m, const radial *d, int i)
{
    const exact unit = exact_unit(m), slant = slope(m, i),
                x = cylint_exact_from(m->arena, m->point[i]);
    exact a = EXACT_SUB(EXACT_MUL(unit, x), EXACT_MUL(m->c, slant));
    exact b = EXACT_MUL(m->c, d->R[i]);
    if (m->q.sign != 0) {
        a = EXACT_SUB(a, EXACT_MUL(m->g, d->R[i]));
        b = EXACT_ADD(b, EXACT_MUL(m->q, slant));
    }
    return (surd_quotient){d->t, a, b, unit};
}

/* centre + r (R t - dr w) / u, where dr w counts for a circle of tangency only. */
static surd_quotient on_circle(meridian *m, const radial *d, int end, int i,
                               exact u, int is_tangency)
{
    const exact r = m->L->r[end];
    exact a = EXACT_MUL(u, centre(m, end, i));
    if (is_tangency)
        a = EXACT_SUB(a, EXACT_MUL(r, slope(m, i)));
    return (surd_quotient){d->t, a, EXACT_MUL(r, d->R[i]), u};
}

/* from - (y / u) w */
static surd_quotient shifted_by_axis(meridian *m, const radial *d, exact from,
                                     exact y, exact u, int i)
{
    const exact a = EXACT_SUB(EXACT_MUL(u, from), EXACT_MUL(y, m->L->w[i]));
    return (surd_quotient){d->t, a, cylint_exact_zero(m->arena), u};
}

static surd_quotient coordinate(meridian *m, int feature, const radial *d,
                                int i)
{
    const int end = cylint_end_of(m, feature);
    if (cylint_is_on_ball(m, feature))
        return on_circle(m, d, end, i, m->L->one, 0);
    if (cylint_is_on_plane(m, feature))
        return shifted_by_axis(m, d, cylint_exact_from(m->arena, m->point[i]),
                               m->height[end], m->L->vv, i);
    if (feature == CYLINT_FEATURE_LATERAL)
        return foot(m, d, i);
    return !cylint_ends_are_planes(m->shape->ends)
               ? shifted_by_axis(m, d, centre(m, 0, i), m->L->r[0], m->L->dr, i)
           : cylint_is_round(m->L->kind) ? on_circle(m, d, end, i, m->L->vv, 1)
                                         : on_circle(m, d, end, i, m->g, 0);
}

/* ------------------------------------------------------------ normal --- */

/* A component is (a + b t) / sqrt(d). */
static surd_quotient normal(meridian *m, int feature, const radial *d, int i)
{
    const exact w = m->L->w[i], none = cylint_exact_zero(m->arena);
    const int is_apex =
        cylint_stated_feature(m->shape, feature) == CYLINT_FEATURE_APEX;
    if (cylint_is_on_ball(m, feature))
        return (surd_quotient){d->t, none, d->R[i], m->L->one};
    if (is_apex || cylint_is_on_plane(m, feature)) {
        const int sign = is_apex ? cylint_apex_normal_sign(m->shape, 0)
                         : feature == CYLINT_FEATURE_CAP0 ? -1
                                                          : 1;
        return (surd_quotient){d->t, cylint_exact_signed(w, w.sign * sign),
                               none, m->L->vv};
    }
    return (surd_quotient){d->t, cylint_exact_neg(slope(m, i)), d->R[i],
                           exact_unit(m)};
}

static double rounded_as(meridian *m, cylint_rounded of, surd_quotient x)
{
    return cylint_nearest_at(&m->query, of, &x.t, x.a, x.b, x.d);
}

void cylint_nearest_point(meridian *m, int feature, unsigned want,
                          cylint_closest *answer)
{
    const int used = m->arena->used;
    const radial d = cylint_is_on_ball(m, feature)
                         ? direction_from_centre(m, cylint_end_of(m, feature))
                         : radial_direction(m);
    for (int i = 0; i < 3; i++) {
        const int kept = m->arena->used;
        if (want & CYLINT_WANT_POINT)
            answer->point[i] =
                rounded_as(m, ROUNDED_QUOTIENT, coordinate(m, feature, &d, i));
        m->arena->used = kept;
        if (want & CYLINT_WANT_NORMAL)
            answer->normal[i] =
                rounded_as(m, ROUNDED_COSINE, normal(m, feature, &d, i));
        m->arena->used = kept;
    }
    m->arena->used = used;
}
