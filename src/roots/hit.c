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

/* x / |x| of leading digits. */
static void write_unit_vector(cylint_arena *arena, const exact x[3],
                              double to[3])
{
    const int used = arena->used;
    exact sum = cylint_exact_zero(arena);
    /* mutant '<' -> '<=': `make sanitize` detects the element too many */
    for (int i = 0; i < 3; i++)
        sum = cylint_exact_add(arena, sum, cylint_exact_mul(arena, x[i], x[i]));
    const exact per_size = cylint_inverse_root(arena, cylint_leading(sum));
    for (int i = 0; i < 3; i++)
        to[i] = cylint_positive_zero(
            cylint_exact_nearest(cylint_exact_mul(arena, x[i], per_size), 0));
    arena->used = used;
}

/* ------------------------------------------------------------ angles --- */

/* atan(q) / (2 pi), leading digits, for |q| < 2^-6: q - q^3 / 3 + q^5 / 5 - ...
 * The sum is MULTIPLE times as large, so that the divisors are whole numbers;
 * `scale` divides by it.  The first term left out is below 2^-111 of q. */
static exact angle_of_tangent(cylint_arena *arena, exact q)
{
    enum { MULTIPLE = 5 * 7 * 9 * 11 * 13 * 17 };
    const exact square = cylint_leading(cylint_exact_mul(arena, q, q));
    const exact per_turn = cylint_exact_of_sum(arena, CYLINT_TURN_PER_RADIAN,
                                               CYLINT_TURN_PER_RADIAN_LO);
    const exact scale =
        cylint_inverse(arena, cylint_exact_from(arena, MULTIPLE));
    const int used = arena->used;
    exact sum = cylint_exact_zero(arena);
    for (int n = 17; n > 0; n -= 2) {
        sum = cylint_exact_sub(arena, cylint_exact_from(arena, MULTIPLE / n),
                               cylint_exact_mul(arena, square, sum));
        sum = cylint_exact_keep(arena, used, cylint_leading(sum));
    }
    return cylint_exact_mul(arena, cylint_exact_mul(arena, q, sum),
                            cylint_exact_mul(arena, scale, per_turn));
}

exact cylint_angle(cylint_arena *arena, exact x, exact y)
{
    const int left = x.sign < 0, below = y.sign < 0;
    const exact across = cylint_exact_signed(x, x.sign != 0),
                up = cylint_exact_signed(y, y.sign != 0);
    const int steep = cylint_exact_sub(arena, across, up).sign < 0;
    const exact u = steep ? up : across, v = steep ? across : up;
    const double r = cylint_exact_nearest(
        cylint_exact_mul(arena, v, cylint_inverse(arena, u)), 0);
    const int k =
        (int)(256 * r * (CYLINT_TURN_SLOPE - CYLINT_TURN_CURVE * r) + 0.5);
    const double *node = cylint_turn_node[k];
    const exact cosine = cylint_exact_of_sum(arena, node[0], node[1]),
                sine = cylint_exact_of_sum(arena, node[2], node[3]);
    const exact num =
        cylint_exact_sub(arena, cylint_exact_mul(arena, v, cosine),
                         cylint_exact_mul(arena, u, sine));
    const exact den =
        cylint_exact_add(arena, cylint_exact_mul(arena, u, cosine),
                         cylint_exact_mul(arena, v, sine));
    const exact q = cylint_leading(
        cylint_exact_mul(arena, num, cylint_inverse(arena, den)));
    const exact beyond = angle_of_tangent(arena, q);
    const int back = steep ^ left ^ below; /* the octant is run backwards */
    const double axis = steep ? (below ? 0.75 : 0.25) : left ? 0.5 : below;
    const exact turn =
        cylint_exact_from(arena, axis + (back ? -k : k) * 0x1p-8);
    return cylint_exact_add(arena, turn,
                            back ? cylint_exact_neg(beyond) : beyond);
}

/* ------------------------------------------------------------- facts --- */

/* Whether the normal is that of a quadric. */
static int is_curved(const cylint_query *q, int part)
{
    return (part == CYLINT_PART_LATERAL && !cylint_is_plane(q->kind)) ||
           cylint_is_round(q->kind);
}

/* A hit, with the terms at the line's origin, and those whose D[0] is the line's
 * direction.  The latter lack what is the same at all points, so that the facts
 * of the line are f0 + f1 t, f0 from the first and f1 from the second. */
typedef struct {
    cylint_query *q;
    surd t;
    cylint_terms_exact at_o, along;
} described;

static described described_at(cylint_query *q, cylint_root root)
{
    const cylint_terms_exact *L = cylint_load_exact(q, FORM_A, 0);
    described at = {q, cylint_surd(q, root), *L, *L};
    memcpy(at.along.D[0], L->u, sizeof L->u);
    at.along.r[0].sign = at.along.det.sign = 0;
    return at;
}

/* ------------------------------------------------------------- point --- */

static void write_point(const described *at, double point[3])
{
    cylint_query *q = at->q;
    for (int i = 0; i < 3; i++) {
        const int used = q->arena.used;
        point[i] =
            cylint_nearest_at(q, ROUNDED_QUOTIENT, &at->t,
                              cylint_exact_from(&q->arena, q->line->o[i]),
                              at->at_o.u[i], at->at_o.one);
        q->arena.used = used;
    }
}

/* -------------------------------------------------------- description -- */

/* 1 if the normal at the apex has the axis's direction, -1 if the opposite one. */
static int apex_sign(cylint_query *q)
{
    const int along = q->ends == CYLINT_ENDS_INFINITE
                          ? cylint_form_sign(q, FORM_ALONG, 0)
                          : 0;
    return cylint_apex_normal_sign(q->shape, along);
}

/* Without the limbs of intermediate results. */
static void gradient_of(const cylint_terms_exact *L, exact N[3])
{
    const int used = L->arena->used;
    cylint_gradient_exact(L, N);
    for (int i = 0, kept = used; i < 3; i++, kept = L->arena->used)
        N[i] = cylint_exact_keep(L->arena, kept, N[i]);
}

/* sign x / |x|, each component the nearest double. */
static void write_axial_normal(const described *at, const exact x[3], int sign,
                               double normal[3])
{
    const exact square = cylint_dot_exact(&at->at_o, x, x),
                zero = cylint_exact_zero(&at->q->arena);
    for (int i = 0; i < 3; i++)
        normal[i] = cylint_nearest_at(
            at->q, ROUNDED_COSINE, &at->t,
            cylint_exact_signed(x[i], x[i].sign * sign), zero, square);
}

static void write_normal(const described *at, const cylint_stop *stop,
                         double normal[3])
{
    if (!is_curved(at->q, stop->part)) {
        write_axial_normal(at, cylint_axial_exact(&at->at_o),
                           stop->part == CYLINT_PART_CAP0 ? -1 : 1, normal);
    } else if (stop->apex) {
        write_axial_normal(at, at->at_o.w, apex_sign(at->q), normal);
    } else {
        exact f0[3], f1[3], x[3];
        gradient_of(&at->at_o, f0);
        gradient_of(&at->along, f1);
        for (int i = 0; i < 3; i++)
            x[i] = cylint_value_at(at->q, &at->t, f0[i], f1[i]);
        write_unit_vector(&at->q->arena, x, normal);
    }
}

static double z_of(const described *at)
{
    cylint_arena *arena = &at->q->arena;
    const cylint_terms_exact *L = &at->at_o;
    const exact unit = cylint_is_elliptic(L->kind) ? L->det : L->vv;
    exact f0 = cylint_dot_exact(L, L->D[0], cylint_axial_exact(L)),
          f1 = L->beta;
    if (cylint_is_reversed(at->q->shape)) {
        f0 = cylint_exact_sub(arena, unit, f0);
        f1 = cylint_exact_neg(f1);
    }
    return cylint_nearest_at(at->q, ROUNDED_QUOTIENT, &at->t, f0, f1, unit);
}

static double phi_of(const described *at)
{
    cylint_arena *arena = &at->q->arena;
    const cylint_shape *s = at->q->shape;
    const int e = cylint_least_axis_component(s);
    exact x0, x1, y0, y1;
    cylint_about_axis_exact(&at->at_o, e, &x0, &y0);
    cylint_about_axis_exact(&at->along, e, &x1, &y1);
    exact x = cylint_value_at(at->q, &at->t, x0, x1);
    exact y = cylint_value_at(at->q, &at->t, y0, y1);
    if (!cylint_is_elliptic(s->kind)) /* the cosine needs a factor |w| */
        x = cylint_exact_mul(arena, x, cylint_square_root(arena, at->at_o.vv));
    if (cylint_is_reversed(s))
        x = cylint_exact_neg(x);
    if (cylint_left_handed(s))
        y = cylint_exact_neg(y);
    if (x.sign == 0 && y.sign == 0) /* on the axis */
        return 0;
    const double turns = cylint_exact_nearest(cylint_angle(arena, x, y), 0);
    return turns < 1 ? turns : 1 - CYLINT_NEAREST_ROUNDING;
}

void cylint_describe_hit(cylint_query *q, const cylint_stop *stop,
                         unsigned want, cylint_hit *hit)
{
    const int has_axis = !cylint_has_no_axis(q->shape);
    if (!want)
        return;
    const described at = described_at(q, stop->root);
    const int kept = q->arena.used;
    if (want & CYLINT_WANT_POINT)
        write_point(&at, hit->point);
    if (want & CYLINT_WANT_NORMAL)
        write_normal(&at, stop, hit->normal);
    q->arena.used = kept;
    if (want & CYLINT_WANT_Z)
        hit->z = has_axis ? z_of(&at) : 0;
    q->arena.used = kept;
    if (want & CYLINT_WANT_PHI)
        hit->phi = has_axis && !cylint_is_plane(q->kind) ? phi_of(&at) : 0;
    q->arena.used = at.t.mark;
}
