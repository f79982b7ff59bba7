/*
 * exact_distance.c - the nearest feature, from exact signs, and the doubles nearest
 * to the distance, the nearest point and the normal
 */
#include "exact_distance.h"
#include "../dispatch.h"
#include "../intersect.h"
#include "../signs/origin.h"

/* Sums and products in the arena of a meridian *m.  A function that begins with
 * EXACT_BEGIN and ends with EXACT_RETURN(x) leaves only x in the arena. */
#define EXACT_ADD(x, y) cylint_exact_add(m->arena, x, y)
#define EXACT_SUB(x, y) cylint_exact_sub(m->arena, x, y)
#define EXACT_MUL(x, y) cylint_exact_mul(m->arena, x, y)
#define EXACT_BEGIN const int used_before = m->arena->used;
#define EXACT_RETURN(x) return cylint_exact_keep(m->arena, used_before, x);

/* W (g + dr^2). */
static exact exact_unit(meridian *m)
{
    EXACT_BEGIN
    exact x = EXACT_MUL(m->L->vv, EXACT_ADD(m->g, EXACT_MUL(m->dr, m->dr)));
    EXACT_RETURN(x)
}

/* The end that a feature belongs to; a ball is about the base. */
static int end_of(const meridian *m, int feature)
{
    return m->L->kind != CYLINT_KIND_SPHERE && cylint_feature_end(feature);
}

static int is_on_ball(const meridian *m, int feature)
{
    return m->L->kind == CYLINT_KIND_SPHERE ||
           (cylint_is_round(m->L->kind) && cylint_is_on_end(feature));
}

/* Of no ball: on a cap or a half-space. */
static int is_on_plane(const meridian *m, int feature)
{
    return cylint_is_plane(m->L->kind) || cylint_is_on_end(feature);
}

static exact section(meridian *m)
{
    const cylint_terms_exact *L = m->L;
    EXACT_BEGIN
    exact c =
        EXACT_ADD(EXACT_MUL(L->r[0], L->vv), EXACT_MUL(L->dr, m->height[0]));
    EXACT_RETURN(c)
}

static void load_axis(meridian *m)
{
    const cylint_terms_exact *L = m->L;
    for (int i = 0; i < 2; i++)
        m->height[i] = cylint_dot_exact(L, L->D[i], L->w);
    cylint_cross_exact(L, L->D[0], L->w, m->X);
    m->q = cylint_dot_exact(L, m->X, m->X);
    m->g = cylint_has_tangent(L->kind)
               ? L->one
               : cylint_form_exact(L, FORM_ROOT_OF_S, 0);
    m->T2 = EXACT_MUL(m->g, m->q);
    m->T = cylint_root_of_quotient(&m->query, m->T2, L->one);
    m->c = section(m);
    m->dr = L->dr;
    /* The nappe of a double cone that does not contain the base. */
    if (m->shape->ends == CYLINT_ENDS_INFINITE && m->c.sign < 0) {
        m->c = cylint_exact_neg(m->c);
        m->dr = cylint_exact_neg(m->dr);
    }
}

void cylint_load_meridian(meridian *m, const cylint_shape *shape,
                          const double point[3])
{
    cylint_line line;
    m->shape = shape;
    m->point = point;
    cylint_open_at(&m->query, shape, &line, point);
    m->L = cylint_load_exact(&m->query, FORM_ALPHA, 0);
    m->arena = &m->query.arena;
    if (shape->kind != CYLINT_KIND_SPHERE)
        load_axis(m);
}

/* ------------------------------------------------------------- signs --- */

/* a + b T. */
static int sign_of(meridian *m, exact a, exact b)
{
    return cylint_sign_at(&m->query, &m->T, a, b);
}

/* The foot on the lateral line, from end i towards z = 1. */
static int sign_foot(meridian *m, int i)
{
    const int used = m->arena->used;
    exact a = EXACT_MUL(m->g, m->height[i]);
    if (!cylint_is_round(m->L->kind))
        a = EXACT_SUB(a, EXACT_MUL(EXACT_MUL(m->L->r[i], m->dr), m->L->vv));
    return cylint_only_sign(m->arena, used, sign_of(m, a, m->dr));
}

/* The foot on the line of a nappe, from its apex. */
static int sign_nappe_foot(meridian *m)
{
    const int used = m->arena->used;
    const exact a = EXACT_MUL(m->c, m->g), b = EXACT_MUL(m->dr, m->dr);
    return cylint_only_sign(m->arena, used, sign_of(m, a, b));
}

/* The radial coordinate against the radius of cap i. */
static int sign_disc(meridian *m, int i)
{
    const int used = m->arena->used;
    const exact r = EXACT_MUL(m->L->r[i], m->L->vv);
    const exact over = EXACT_SUB(m->T2, EXACT_MUL(r, r));
    return cylint_only_sign(m->arena, used, over.sign);
}

/* The distance from a feature against that from the plane of cap i. */
static int sign_beyond_cap(meridian *m, int feature, int i)
{
    const int used = m->arena->used;
    const surd_quotient x = cylint_square_of_distance(m, feature);
    const exact square = EXACT_MUL(m->height[i], m->height[i]);
    const exact a = EXACT_SUB(EXACT_MUL(x.a, m->L->vv), EXACT_MUL(square, x.d));
    const exact b = EXACT_MUL(x.b, m->L->vv);
    return cylint_only_sign(m->arena, used, sign_of(m, a, b));
}

/* ----------------------------------------------------------- features -- */

static int on_unbounded(meridian *m)
{
    const int on_apex =
        (cylint_is_nappe(m->shape) && sign_nappe_foot(m) <= 0) ||
        (cylint_is_tapered(m->L->kind) && m->c.sign == 0 && m->q.sign == 0);
    return on_apex ? CYLINT_FEATURE_APEX : CYLINT_FEATURE_LATERAL;
}

/* On the lateral surface and its rims. */
static int on_lateral(meridian *m)
{
    return sign_foot(m, 0) <= 0   ? CYLINT_FEATURE_RIM0
           : sign_foot(m, 1) >= 0 ? CYLINT_FEATURE_RIM1
                                  : CYLINT_FEATURE_LATERAL;
}

static int between_planes(meridian *m)
{
    const unsigned caps = cylint_caps_present(m->shape->ends);
    int feature = on_lateral(m);
    for (int i = 0; i < 2; i++)
        /* mutant '0' -> '1', '<' -> '<=': on the rim it is as
         * near as the plane, so sign_beyond_cap() is not 1 */
        if (caps >> i & 1 && sign_disc(m, i) < 0 &&
            sign_beyond_cap(m, feature, i) > 0)
            feature = CYLINT_FEATURE_CAP0 + i;
    return feature;
}

static int on_hull(meridian *m)
{
    const int before = sign_foot(m, 0), after = sign_foot(m, 1);
    const int end = after >= 0, beyond = before < 0 || after > 0;
    const unsigned caps = cylint_caps_present(m->shape->ends);
    if (beyond && caps >> end & 1 && m->L->r[end].sign != 0)
        return CYLINT_FEATURE_CAP0 + end;
    return before > 0 && after < 0 ? CYLINT_FEATURE_LATERAL
                                   : CYLINT_FEATURE_RIM0 + end;
}

static int on_sphere(const meridian *m)
{
    const int part = cylint_surface(m->shape);
    return cylint_part_is_present(m->shape->ends, part) ? part
                                                        : CYLINT_NO_FEATURE;
}

int cylint_nearest_feature(meridian *m)
{
    const int kind = m->L->kind;
    return cylint_is_plane(kind)                    ? CYLINT_FEATURE_LATERAL
           : kind == CYLINT_KIND_SPHERE             ? on_sphere(m)
           : cylint_is_round(kind)                  ? on_hull(m)
           : cylint_ends_are_planes(m->shape->ends) ? between_planes(m)
                                                    : on_unbounded(m);
}

/* ------------------------------------------------ square of distance --- */

/* -2 x. */
static exact minus_twice(meridian *m, exact x)
{
    return cylint_exact_neg(EXACT_ADD(x, x));
}

/* (|D_end| - r)^2. */
static surd_quotient from_ball(meridian *m, int end)
{
    const cylint_terms_exact *L = m->L;
    const exact dd = cylint_dot_exact(L, L->D[end], L->D[end]), r = L->r[end];
    return (surd_quotient){cylint_root_of_quotient(&m->query, dd, L->one),
                           EXACT_ADD(dd, EXACT_MUL(r, r)), minus_twice(m, r),
                           L->one};
}

/* (T - c)^2 / (W (g + dr^2)). */
static surd_quotient from_lateral(meridian *m)
{
    return (surd_quotient){m->T, EXACT_ADD(m->T2, EXACT_MUL(m->c, m->c)),
                           minus_twice(m, m->c), exact_unit(m)};
}

/* The plane of a cap. */
static surd_quotient from_plane(meridian *m, int end)
{
    return (surd_quotient){m->T, EXACT_MUL(m->height[end], m->height[end]),
                           cylint_exact_zero(m->arena), m->L->vv};
}

/* The circle of radius r about an end, h the height: (q + h^2 + r^2 W - 2 r T) / W.
 * Of an angle cone, whose radius is r |w|, r W takes the place of r, and (r W)^2
 * that of r^2 W.  The circle of tangency of a ball: + 2 r dr h / W. */
static surd_quotient from_circle(meridian *m, int end)
{
    const exact h = m->height[end], W = m->L->vv;
    exact r = m->L->r[end], across = EXACT_MUL(EXACT_MUL(r, r), W),
          along = EXACT_MUL(h, h);
    if (cylint_is_round(m->L->kind))
        along =
            EXACT_SUB(along, EXACT_MUL(h, minus_twice(m, EXACT_MUL(r, m->dr))));
    if (cylint_has_tangent(m->L->kind)) {
        r = EXACT_MUL(r, W);
        across = EXACT_MUL(r, r);
    }
    const exact square = EXACT_ADD(m->q, EXACT_ADD(across, along));
    return (surd_quotient){m->T, square, minus_twice(m, r), W};
}

/* The apex of a nappe: (c^2 + dr^2 q) / (W dr^2). */
static surd_quotient from_apex(meridian *m)
{
    const exact dr2 = EXACT_MUL(m->dr, m->dr);
    return (surd_quotient){
        m->T, EXACT_ADD(EXACT_MUL(m->c, m->c), EXACT_MUL(dr2, m->q)),
        cylint_exact_zero(m->arena), EXACT_MUL(m->L->vv, dr2)};
}

surd_quotient cylint_square_of_distance(meridian *m, int feature)
{
    const int end = end_of(m, feature);
    if (is_on_ball(m, feature))
        return from_ball(m, end);
    if (is_on_plane(m, feature))
        return from_plane(m, end);
    if (feature == CYLINT_FEATURE_LATERAL)
        return from_lateral(m);
    return cylint_ends_are_planes(m->shape->ends) ? from_circle(m, end)
                                                  : from_apex(m);
}

double cylint_rounded_distance(meridian *m, int feature)
{
    const int used = m->arena->used;
    const surd_quotient x = cylint_square_of_distance(m, feature);
    double distance =
        cylint_nearest_at(&m->query, ROUNDED_ROOT, &x.t, x.a, x.b, x.d);
    if (!cylint_sign(distance)) /* 0 is on the surface */
        distance = cylint_from_rank(cylint_sign_at(&m->query, &x.t, x.a, x.b));
    m->arena->used = used;
    return distance;
}

/* ------------------------------------ features of points on a surface --- */

int cylint_side_of(const cylint_shape *shape, const double point[3],
                   int surface)
{
    const pair origin = {0, 0};
    cylint_line line;
    cylint_line_at(&line, point);
    return CYLINT_OF_FMA(cylint_sign_on_line)(shape, &line, origin, surface);
}

static int is_apex(const cylint_shape *shape, const double point[3])
{
    cylint_line line;
    cylint_query q;
    cylint_open_at(&q, shape, &line, point);
    return cylint_form_sign(&q, FORM_RHO0, 0) == 0;
}

int cylint_boundary_feature(const cylint_shape *shape, const double point[3])
{
    const unsigned caps = cylint_caps_present(shape->ends);
    const int bounded = cylint_is_bounded(shape);
    if (cylint_is_round(shape->kind) || cylint_has_tangent(shape->kind))
        return CYLINT_NO_FEATURE;
    const int at0 = bounded && cylint_side_of(shape, point, 0) == 0;
    const int at1 = bounded && !at0 && cylint_side_of(shape, point, 1) == 0;
    if (cylint_side_of(shape, point, CYLINT_LATERAL_SURFACE) == 0) {
        if (cylint_is_tapered(shape->kind) && is_apex(shape, point))
            return CYLINT_FEATURE_APEX;
        return at0   ? CYLINT_FEATURE_RIM0
               : at1 ? CYLINT_FEATURE_RIM1
                     : CYLINT_FEATURE_LATERAL;
    }
    return at0 && (caps & 1)   ? CYLINT_FEATURE_CAP0
           : at1 && (caps & 2) ? CYLINT_FEATURE_CAP1
                               : CYLINT_NO_FEATURE;
}

/* ------------------------------------------- nearest point and normal -- */

/*
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
    const int end = end_of(m, feature);
    if (is_on_ball(m, feature))
        return on_circle(m, d, end, i, m->L->one, 0);
    if (is_on_plane(m, feature))
        return shifted_by_axis(m, d, cylint_exact_from(m->arena, m->point[i]),
                               m->height[end], m->L->vv, i);
    if (feature == CYLINT_FEATURE_LATERAL)
        return foot(m, d, i);
    const int round = cylint_is_round(m->L->kind);
    return cylint_ends_are_planes(m->shape->ends)
               ? on_circle(m, d, end, i, round ? m->L->vv : m->g, round)
               : shifted_by_axis(m, d, centre(m, 0, i), m->L->r[0], m->L->dr,
                                 i);
}

/* ------------------------------------------------------------ normal --- */

/* A component is (a + b t) / sqrt(d). */
static surd_quotient normal(meridian *m, int feature, const radial *d, int i)
{
    const exact w = m->L->w[i], none = cylint_exact_zero(m->arena);
    const int is_apex =
        cylint_stated_feature(m->shape, feature) == CYLINT_FEATURE_APEX;
    if (is_on_ball(m, feature))
        return (surd_quotient){d->t, none, d->R[i], m->L->one};
    if (is_apex || is_on_plane(m, feature)) {
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
    const radial d = is_on_ball(m, feature)
                         ? direction_from_centre(m, end_of(m, feature))
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
