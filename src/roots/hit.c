/*
 * hit.c - point, normal, z and angle of a hit, from exact numbers
 *
 * They depend on the line, the shape and the root only, not on the way in which
 * the root was computed.  All are quotients of facts below, which are affine in
 * t (surd.c), and lengths of vectors of facts.  The point and z are decided by
 * an exact sign where the middle of two doubles is near.  The normal and phi are
 * rounded once from numbers with an error below CYLINT_VALUE_ERROR.
 */
#include "../numbers/turns.h"
#include "roots.h"

/* ------------------------------------------------------ unit vectors --- */

/* sign x / |x|. */
static void write_unit_vector(cylint_arena *arena, const exact x[3], int sign,
                              double to[3])
{
    const int used = arena->used;
    /* mutant '0' -> '1': a number without limbs or without sign is 0 */
    exact sum = {arena->limb, 0, 0, 0};
    /* mutant '<' -> '<=': `make sanitize` detects the element too many */
    for (int i = 0; i < 3; i++)
        sum = cylint_sum_of_sizes(
            arena, sum, cylint_leading(cylint_exact_mul(arena, x[i], x[i])));
    const exact per_size = cylint_inverse_root(arena, sum);
    for (int i = 0; i < 3; i++) {
        exact component = cylint_exact_mul(arena, x[i], per_size);
        component.sign *= sign;
        to[i] = cylint_positive_zero(cylint_exact_nearest(component, 0));
    }
    arena->used = used;
}

/* ------------------------------------------------------------ angles --- */

/* phi is in [0, 1). */
static double below_one(double turns)
{
    return turns < 1 ? turns : 1 - 0x1p-53;
}

/* The double nearest to hi + lo, in every rounding mode. */
static double nearest(cylint_arena *arena, pair x)
{
    return cylint_exact_nearest(
        cylint_exact_add(arena, cylint_exact_from(arena, x.hi),
                         cylint_exact_from(arena, x.lo)),
        0);
}

/* The angle of (x, y) in turns.  Where one of x and y is 2^CYLINT_STEEP_EXPONENT
 * times the other or more, the angle is a quarter turn's multiple, rounded, but
 * next to 0, where it is y / (2 pi x). */
static double turns(cylint_arena *arena, exact x, exact y)
{
    int ex, ey;
    if (y.sign == 0)
        return x.sign < 0 ? 0.5 : 0;
    if (x.sign == 0)
        return y.sign < 0 ? 0.75 : 0.25;
    const pair X = cylint_exact_round(x, &ex), Y = cylint_exact_round(y, &ey);
    if (ey - ex > CYLINT_STEEP_EXPONENT)
        return y.sign < 0 ? 0.75 : 0.25;
    if (ex - ey > CYLINT_STEEP_EXPONENT && x.sign < 0)
        return 0.5;
    if (ex - ey > CYLINT_STEEP_EXPONENT) {
        const exact per_turn = cylint_exact_add(
            arena, cylint_exact_from(arena, CYLINT_TURN_PER_RADIAN),
            cylint_exact_from(arena, CYLINT_TURN_PER_RADIAN_LO));
        const exact slope =
            cylint_exact_mul(arena, y, cylint_inverse(arena, x));
        return y.sign < 0 ? below_one(1)
                          : cylint_exact_nearest(
                                cylint_exact_mul(arena, slope, per_turn), 0);
    }
    const int e = ex > ey ? ex : ey;
    return below_one(
        nearest(arena, cylint_turn_pair(cylint_scaled_pair(X, ex - e),
                                        cylint_scaled_pair(Y, ey - e))));
}

/* ------------------------------------------------------------- facts --- */

/* Forms of the terms whose quotients the hit's numbers are. */
enum { GRADIENT = 0, AXIAL = 3, AXIS = 6, HEIGHT = 9, X, Y, FACTS };

/* Whether z of the hit is that of a cap. */
static int is_on_cap(const cylint_query *q, cylint_root root)
{
    return (root == ROOT_CAP0 || root == ROOT_CAP1) &&
           !cylint_is_round(q->kind);
}

/* Whether the normal is that of a quadric. */
static int is_curved(const cylint_query *q, int part)
{
    return part == CYLINT_PART_LATERAL || cylint_is_round(q->kind);
}

/* A fact of the point that D[0] leads to. */
static exact fact_of(const cylint_query *q, const cylint_terms_exact *L, int i)
{
    exact x, y;
    if (i < AXIAL)
        return cylint_gradient_exact(L, i);
    if (i < AXIS)
        return cylint_axial_exact(L)[i - AXIAL];
    if (i < HEIGHT)
        return L->w[i - AXIS];
    if (i == HEIGHT)
        return cylint_form_height_exact(L, cylint_is_reversed(q->shape));
    cylint_about_axis_exact(L, cylint_least_axis_component(q->shape), &x, &y);
    if (i == X)
        return cylint_is_reversed(q->shape) ? cylint_exact_neg(x) : x;
    return cylint_left_handed(q->shape) ? cylint_exact_neg(y) : y;
}

/* A hit, and the terms at the line's origin o and at o + d. */
typedef struct {
    cylint_query *q;
    surd t;
    cylint_terms_exact at_o, beyond;
} place;

static place place_of(cylint_query *q, cylint_root root)
{
    place at = {q, cylint_surd(q, root), *cylint_load_exact_moments(q),
                *cylint_load_exact_moments(q)};
    for (int i = 0; i < 3; i++)
        at.beyond.D[0][i] =
            cylint_exact_add(&q->arena, at.at_o.D[0][i], at.at_o.u[i]);
    return at;
}

/* A fact is affine in the point: its values at o and at o + d give it along the
 * line, f[0] + f[1] t. */
static void fact_along(const place *at, int i, exact f[2])
{
    cylint_arena *arena = &at->q->arena;
    const int used = arena->used;
    f[0] = cylint_exact_keep(arena, used, fact_of(at->q, &at->at_o, i));
    const int kept = arena->used;
    f[1] = cylint_exact_keep(arena, kept,
                             cylint_exact_add(arena,
                                              fact_of(at->q, &at->beyond, i),
                                              cylint_exact_neg(f[0])));
}

static exact fact_at(const place *at, int i)
{
    const int used = at->q->arena.used;
    exact f[2];
    fact_along(at, i, f);
    return cylint_exact_keep(&at->q->arena, used,
                             cylint_value_at(at->q, &at->t, f[0], f[1]));
}

/* ------------------------------------------------------------- point --- */

/* Coordinate i of all points of a cap whose plane is perpendicular to that
 * coordinate's direction. */
static int cap_coordinate(const cylint_shape *s, int cap, int i, double *x)
{
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const int level =
        cylint_is_elliptic(s->kind)
            ? !cylint_sign(cylint_a(s)[i]) && !cylint_sign(cylint_b(s)[i])
            : !cylint_sign(cylint_axis(s)[j]) &&
                  !cylint_sign(cylint_axis(s)[k]);
    if (level)
        *x = !cap || cylint_has_end_points(s->kind)
                 ? cylint_end_center(s, cap, i)
                 : cylint_difference(cylint_base(s)[i], -cylint_axis(s)[i]).hi;
    return level;
}

/* The coordinates that do not depend on t; returns the bits of the others. */
static unsigned fixed_coordinates(const cylint_query *q, cylint_root root,
                                  double point[3])
{
    const cylint_line *l = q->line;
    unsigned left = 0;
    for (int i = 0; i < 3; i++) {
        if (!cylint_sign(l->d[i]) && !cylint_sign(l->d_lo[i]))
            point[i] = l->o[i];
        else if (!is_on_cap(q, root) ||
                 !cap_coordinate(q->shape, root == ROOT_CAP1, i, &point[i]))
            left |= 1u << i;
        point[i] = cylint_positive_zero(point[i]);
    }
    return left;
}

static void write_point(const place *at, unsigned left, double point[3])
{
    for (int i = 0; i < 3; i++) {
        const int used = at->q->arena.used;
        if (!(left >> i & 1))
            continue;
        const exact o = cylint_exact_from(&at->q->arena, at->q->line->o[i]);
        point[i] =
            cylint_nearest_at(at->q, &at->t, o, at->at_o.u[i], at->at_o.one);
        at->q->arena.used = used;
    }
}

/* -------------------------------------------------------- description -- */

/* The axis's direction or its opposite. */
static int apex_sign(cylint_query *q)
{
    const int along = q->ends == CYLINT_ENDS_INFINITE
                          ? cylint_form_sign(q, FORM_ALONG, 0)
                          : 0;
    return cylint_apex_normal_sign(q->shape, along);
}

static void write_normal(const place *at, int part, int apex, double normal[3])
{
    const int first = !is_curved(at->q, part) ? AXIAL : apex ? AXIS : GRADIENT;
    const int sign = first == GRADIENT          ? 1
                     : first == AXIS            ? apex_sign(at->q)
                     : part == CYLINT_PART_CAP1 ? 1
                                                : -1;
    exact x[3];
    for (int i = 0; i < 3; i++)
        x[i] = fact_at(at, first + i);
    write_unit_vector(&at->q->arena, x, sign, normal);
}

static double z_of(const place *at)
{
    exact f[2];
    fact_along(at, HEIGHT, f);
    return cylint_nearest_at(at->q, &at->t, f[0], f[1],
                             cylint_form_height_unit_exact(&at->at_o));
}

static double phi_of(const place *at)
{
    cylint_arena *arena = &at->q->arena;
    exact x = fact_at(at, X);
    const exact y = fact_at(at, Y);
    if (!cylint_is_elliptic(at->q->kind)) /* x needs a factor |w| */
        x = cylint_exact_mul(arena, x, cylint_square_root(arena, at->at_o.vv));
    return turns(arena, x, y);
}

void cylint_describe_hit(cylint_query *q, cylint_root root, int part, int apex,
                         unsigned want, cylint_hit *hit)
{
    const int has_axis = !cylint_has_no_axis(q->shape);
    const int has_z = has_axis && !is_on_cap(q, root),
              has_phi = has_axis && !apex;
    const unsigned left =
        want & CYLINT_WANT_POINT ? fixed_coordinates(q, root, hit->point) : 0;
    if ((want & CYLINT_WANT_Z) && !has_z)
        hit->z = is_on_cap(q, root) && root == ROOT_CAP1;
    if ((want & CYLINT_WANT_PHI) && !has_phi)
        hit->phi = 0;
    const unsigned from_root = (want & CYLINT_WANT_NORMAL) |
                               (has_z ? want & CYLINT_WANT_Z : 0) |
                               (has_phi ? want & CYLINT_WANT_PHI : 0);
    if (!left && !from_root)
        return;
    const int used = cylint_exact_mark(q, root);
    const place at = place_of(q, root);
    const int kept = q->arena.used;
    write_point(&at, left, hit->point);
    if (want & CYLINT_WANT_NORMAL)
        write_normal(&at, part, apex, hit->normal);
    q->arena.used = kept;
    if (from_root & CYLINT_WANT_Z)
        hit->z = z_of(&at);
    q->arena.used = kept;
    if (from_root & CYLINT_WANT_PHI)
        hit->phi = phi_of(&at);
    q->arena.used = used;
}
