/*
 * meridian.c - the nearest feature, from exact signs, and the double nearest to the
 * distance
 */
#include "../dispatch.h"
#include "../intersect.h"
#include "../signs/origin.h"
#include "exact_distance.h"

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

/* The circle of radius r about the end: (g (q + h^2) + r^2 W^2 - 2 r W T) /
 * (g W), h the height. */
static surd_quotient from_rim(meridian *m, int end)
{
    const exact h = m->height[end], W = m->L->vv;
    const exact r = EXACT_MUL(m->L->r[end], W);
    const exact square = EXACT_MUL(m->g, EXACT_ADD(m->q, EXACT_MUL(h, h)));
    return (surd_quotient){m->T, EXACT_ADD(square, EXACT_MUL(r, r)),
                           minus_twice(m, r), EXACT_MUL(m->g, W)};
}

/* The circle of tangency of a ball: (q + h^2 + r^2 W + 2 r dr h - 2 r T) / W. */
static surd_quotient from_tangency(meridian *m, int end)
{
    const exact h = m->height[end], W = m->L->vv, r = m->L->r[end];
    const exact across = EXACT_ADD(m->q, EXACT_MUL(EXACT_MUL(r, r), W));
    const exact along =
        EXACT_MUL(h, EXACT_SUB(h, minus_twice(m, EXACT_MUL(r, m->dr))));
    return (surd_quotient){m->T, EXACT_ADD(across, along), minus_twice(m, r),
                           W};
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
    const int end = cylint_end_of(m, feature);
    if (cylint_is_on_ball(m, feature))
        return from_ball(m, end);
    if (cylint_is_on_plane(m, feature))
        return from_plane(m, end);
    if (feature == CYLINT_FEATURE_LATERAL)
        return from_lateral(m);
    return !cylint_ends_are_planes(m->shape->ends) ? from_apex(m)
           : cylint_is_round(m->L->kind)           ? from_tangency(m, end)
                                                   : from_rim(m, end);
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

static int side_of(const cylint_shape *shape, const cylint_line *line,
                   int surface)
{
    const pair origin = {0, 0};
    return CYLINT_OF_FMA(cylint_sign_on_line)(shape, line, origin, surface);
}

static int is_apex(const cylint_shape *shape, const cylint_line *line)
{
    cylint_query q;
    cylint_query_open(&q, shape, line);
    return cylint_form_sign(&q, FORM_RHO0, 0) == 0;
}

int cylint_boundary_feature(const cylint_shape *shape, const double point[3])
{
    const unsigned caps = cylint_caps_present(shape->ends);
    const int bounded = cylint_is_bounded(shape);
    cylint_line line;
    if (cylint_is_round(shape->kind) || cylint_has_tangent(shape->kind))
        return CYLINT_NO_FEATURE;
    cylint_line_at(&line, point);
    const int at0 = bounded && side_of(shape, &line, 0) == 0;
    const int at1 = bounded && !at0 && side_of(shape, &line, 1) == 0;
    if (side_of(shape, &line, CYLINT_LATERAL_SURFACE) == 0) {
        if (cylint_is_tapered(shape->kind) && is_apex(shape, &line))
            return CYLINT_FEATURE_APEX;
        return at0   ? CYLINT_FEATURE_RIM0
               : at1 ? CYLINT_FEATURE_RIM1
                     : CYLINT_FEATURE_LATERAL;
    }
    return at0 && (caps & 1)   ? CYLINT_FEATURE_CAP0
           : at1 && (caps & 2) ? CYLINT_FEATURE_CAP1
                               : CYLINT_NO_FEATURE;
}
