/*
 * meridian.c - the nearest feature, from exact signs
 */
#include "../intersect.h"
#include "exact_distance.h"

static exact scale_of_T(meridian *m)
{
    const cylint_terms_exact *L = m->L;
    EXACT_BEGIN
    if (cylint_has_tangent(L->kind))
        return L->one;
    if (!cylint_is_round(L->kind))
        return L->vv;
    exact g = EXACT_SUB(L->vv, EXACT_MUL(L->dr, L->dr));
    EXACT_RETURN(g)
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
    m->g = scale_of_T(m);
    m->T2 = EXACT_MUL(m->g, m->q);
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

static int sign_of(meridian *m, exact a, exact b, exact c)
{
    const surd_sum x = {a, b, c};
    return cylint_surd_sum_sign(m->arena, &x);
}

/* T - c: outside or inside the lateral surface. */
static int sign_lateral(meridian *m)
{
    return sign_of(m, cylint_exact_neg(m->c), m->L->one, m->T2);
}

/* The foot on the lateral line, from end i towards z = 1. */
static int sign_foot(meridian *m, int i)
{
    const int used = m->arena->used;
    exact a = EXACT_MUL(m->g, m->height[i]);
    if (!cylint_is_round(m->L->kind))
        a = EXACT_SUB(a, EXACT_MUL(EXACT_MUL(m->L->r[i], m->dr), m->L->vv));
    return cylint_only_sign(m->arena, used, sign_of(m, a, m->dr, m->T2));
}

/* The foot on the line of a nappe, from its apex. */
static int sign_nappe_foot(meridian *m)
{
    const int used = m->arena->used;
    const exact a = EXACT_MUL(m->c, m->g), b = EXACT_MUL(m->dr, m->dr);
    return cylint_only_sign(m->arena, used, sign_of(m, a, b, m->T2));
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
    const exact a =
        EXACT_SUB(EXACT_MUL(x.n.a, m->L->vv), EXACT_MUL(square, x.d));
    const exact b = EXACT_MUL(x.n.b, m->L->vv);
    return cylint_only_sign(m->arena, used, sign_of(m, a, b, x.n.c));
}

/* ----------------------------------------------------------- features -- */

static nearest on_unbounded(meridian *m)
{
    const int on_apex =
        (cylint_is_nappe(m->shape) && sign_nappe_foot(m) <= 0) ||
        (cylint_is_tapered(m->L->kind) && m->c.sign == 0 && m->q.sign == 0);
    return (nearest){on_apex ? CYLINT_FEATURE_APEX : CYLINT_FEATURE_LATERAL,
                     sign_lateral(m)};
}

/* On the lateral surface and its rims. */
static int on_lateral(meridian *m)
{
    return sign_foot(m, 0) <= 0   ? CYLINT_FEATURE_RIM0
           : sign_foot(m, 1) >= 0 ? CYLINT_FEATURE_RIM1
                                  : CYLINT_FEATURE_LATERAL;
}

/* -1, 0, 1: inside, on, outside of the solid between the planes. */
static int sign_of_solid(meridian *m)
{
    const int below = -m->height[0].sign, above = m->height[1].sign;
    const int beyond = below > above ? below : above;
    const int side = sign_lateral(m);
    return side > beyond ? side : beyond;
}

static nearest between_planes(meridian *m)
{
    const unsigned caps = cylint_caps_present(m->shape->ends);
    nearest n = {on_lateral(m), 1};
    for (int i = 0; i < 2; i++)
        /* mutant '0' -> '1', '<' -> '<=': on the rim it is as
         * near as the plane, so sign_beyond_cap() is not 1 */
        if (caps >> i & 1 && sign_disc(m, i) < 0 &&
            sign_beyond_cap(m, n.feature, i) > 0)
            n.feature = CYLINT_FEATURE_CAP0 + i;
    if (cylint_surface_is_whole(m->shape->ends))
        n.sign = sign_of_solid(m);
    return n;
}

static int sign_of_ball(meridian *m, int end)
{
    const cylint_terms_exact *L = m->L;
    const int used = m->arena->used;
    const exact square = cylint_dot_exact(L, L->D[end], L->D[end]);
    const exact over = EXACT_SUB(square, EXACT_MUL(L->r[end], L->r[end]));
    return cylint_only_sign(m->arena, used, over.sign);
}

static nearest on_hull(meridian *m)
{
    const int before = sign_foot(m, 0), after = sign_foot(m, 1);
    const int end = after >= 0, beyond = before < 0 || after > 0;
    const int whole = cylint_surface_is_whole(m->shape->ends);
    const unsigned caps = cylint_caps_present(m->shape->ends);
    if (beyond && caps >> end & 1 && m->L->r[end].sign != 0)
        return (nearest){CYLINT_FEATURE_CAP0 + end,
                         whole ? sign_of_ball(m, end) : 1};
    return (nearest){before > 0 && after < 0 ? CYLINT_FEATURE_LATERAL
                                             : CYLINT_FEATURE_RIM0 + end,
                     whole ? sign_lateral(m) : 1};
}

static nearest on_sphere(meridian *m)
{
    const int part = cylint_surface(m->shape), ends = m->shape->ends;
    return (nearest){cylint_part_is_present(ends, part) ? part
                                                        : CYLINT_NO_FEATURE,
                     cylint_surface_is_whole(ends) ? sign_of_ball(m, 0) : 1};
}

nearest cylint_nearest_feature(meridian *m)
{
    const int kind = m->L->kind;
    if (cylint_is_plane(kind))
        return (nearest){CYLINT_FEATURE_LATERAL, m->height[0].sign};
    return kind == CYLINT_KIND_SPHERE               ? on_sphere(m)
           : cylint_is_round(kind)                  ? on_hull(m)
           : cylint_ends_are_planes(m->shape->ends) ? between_planes(m)
                                                    : on_unbounded(m);
}

/* ------------------------------------------------ square of distance --- */

/* 2 x. */
static exact twice(meridian *m, exact x)
{
    return EXACT_ADD(x, x);
}

/* (|D_end| - r)^2. */
static surd_quotient from_ball(meridian *m, int end)
{
    const cylint_terms_exact *L = m->L;
    const exact dd = cylint_dot_exact(L, L->D[end], L->D[end]), r = L->r[end];
    return (surd_quotient){
        {EXACT_ADD(dd, EXACT_MUL(r, r)), cylint_exact_neg(twice(m, r)), dd},
        L->one};
}

/* (T - c)^2 / (W (g + dr^2)). */
static surd_quotient from_lateral(meridian *m)
{
    return (surd_quotient){{EXACT_ADD(m->T2, EXACT_MUL(m->c, m->c)),
                            cylint_exact_neg(twice(m, m->c)), m->T2},
                           exact_unit(m)};
}

/* The plane of a cap. */
static surd_quotient from_plane(meridian *m, int end)
{
    return exact_quotient(m, EXACT_MUL(m->height[end], m->height[end]),
                          m->L->vv);
}

/* The circle of radius r about the end: (g (q + h^2) + r^2 W^2 - 2 r W T) /
 * (g W), h the height. */
static surd_quotient from_rim(meridian *m, int end)
{
    const exact h = m->height[end], W = m->L->vv;
    const exact r = EXACT_MUL(m->L->r[end], W);
    const exact square = EXACT_MUL(m->g, EXACT_ADD(m->q, EXACT_MUL(h, h)));
    return (surd_quotient){{EXACT_ADD(square, EXACT_MUL(r, r)),
                            cylint_exact_neg(twice(m, r)), m->T2},
                           EXACT_MUL(m->g, W)};
}

/* The circle of tangency of a ball: (q + h^2 + r^2 W + 2 r dr h - 2 r T) / W. */
static surd_quotient from_tangency(meridian *m, int end)
{
    const exact h = m->height[end], W = m->L->vv, r = m->L->r[end];
    const exact across = EXACT_ADD(m->q, EXACT_MUL(EXACT_MUL(r, r), W));
    const exact along =
        EXACT_MUL(h, EXACT_ADD(h, twice(m, EXACT_MUL(r, m->dr))));
    return (surd_quotient){
        {EXACT_ADD(across, along), cylint_exact_neg(twice(m, r)), m->T2}, W};
}

/* The apex of a nappe: (c^2 + dr^2 q) / (W dr^2). */
static surd_quotient from_apex(meridian *m)
{
    const exact dr2 = EXACT_MUL(m->dr, m->dr);
    return exact_quotient(
        m, EXACT_ADD(EXACT_MUL(m->c, m->c), EXACT_MUL(dr2, m->q)),
        EXACT_MUL(m->L->vv, dr2));
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
