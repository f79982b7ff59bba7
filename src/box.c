/*
 * box.c - the least axis-parallel box of a shape, rounded outward
 *
 * A bounded shape is the convex hull of the discs, ellipses or balls at its ends.
 */
#include "roots/roots.h"
#include "intersect.h"

/* A shape and the box that its ends extend. */
typedef struct {
    const cylint_shape *shape;
    double *lo, *hi; /* [3] */
    int serves;      /* pairs_serve() */
} box;

/* Writes center + reach (up) or - reach, rounded outward.  If nothing was rounded
 * before, the sign of the sum's low part decides the rounding.  Otherwise the error
 * of the pairs is at most CYLINT_BOX_ERROR; it is added before the last rounding.
 * Returns 0 if the two nearly cancel, so that this is more than a unit in the last
 * place of their sum. */
static int outward(pair center, pair reach, int is_exact, int up, double *side)
{
    const pair sum = pair_add(center, up ? reach : pair_neg(reach));
    const double error =
        CYLINT_BOX_ERROR * fabs(center.hi) + CYLINT_BOX_ERROR * fabs(reach.hi);
    if (is_exact && (reach.hi == 0 || center.lo == 0)) {
        const int is_inside = up ? sum.lo > 0 : sum.lo < 0;
        *side = is_inside ? cylint_next(sum.hi, up) : sum.hi;
        return 1;
    }
    const double moved = sum.hi + (up ? sum.lo + error : sum.lo - error);
    *side = cylint_from_rank(cylint_rank(moved) + (up ? 2 : -2));
    return error <= CYLINT_ROUNDING / 2 * fabs(sum.hi);
}

/* Whether all numbers of the shape are 0 or of moderate size: no power of them in a
 * side overflows or loses digits. */
static int pairs_serve(const cylint_shape *s)
{
    enum { MOST = 250 };
    const double *const vectors[] = {cylint_base(s), cylint_axis(s),
                                     cylint_top(s), cylint_a(s), cylint_b(s)};
    const int n = (int)(sizeof vectors / sizeof *vectors);
    const double radii[3] = {cylint_r0(s), cylint_r1(s), 0};
    int serve = cylint_rounds_to_nearest();
    for (int i = 0; i <= n; i++) {
        const double *x = i < n ? vectors[i] : radii;
        serve &= cylint_largest(x) <= cylint_power_of_two(MOST) &&
                 !cylint_is_small(x[0], MOST) && !cylint_is_small(x[1], MOST) &&
                 !cylint_is_small(x[2], MOST);
    }
    return serve;
}

/* ----------------------------------------------------- by exact numbers -- */

/* The greatest double that is not above (f0 + f1 t) / unit, or the least one that
 * is not below it (up). */
static double exactly_outward(cylint_query *q, const surd *t, exact f0,
                              exact f1, exact unit, int up)
{
    cylint_arena *m = &q->arena;
    const double side = cylint_nearest_at(q, ROUNDED_QUOTIENT, t, f0, f1, unit);
    /* an infinite one counts as 2^1024 */
    const exact beyond = cylint_exact_sub(
        m, f0, cylint_exact_mul(m, cylint_exact_from(m, side), unit));
    const int sign = unit.sign * cylint_sign_at(q, t, beyond, f1);
    return sign == (up ? 1 : -1) ? cylint_positive_zero(cylint_next(side, up))
                                 : side;
}

/* The square of the reach of a section of radius 1 along a coordinate; of a
 * circular kind with two end points times |w|^2. */
static exact exact_square_across(cylint_arena *m, const cylint_terms_exact *L,
                                 int j)
{
    if (cylint_is_round(L->kind))
        return L->one;
    if (cylint_is_elliptic(L->kind))
        return cylint_exact_add(m, cylint_exact_mul(m, L->a[j], L->a[j]),
                                cylint_exact_mul(m, L->b[j], L->b[j]));
    return cylint_exact_sub(m, L->vv, cylint_exact_mul(m, L->w[j], L->w[j]));
}

/* A side of the disc or ball at an end: x = middle -+ sqrt(square / by), where
 * middle is center + offset. */
ASIDE double exact_side_of_end(const cylint_shape *s, int end, int j,
                               double center, double offset, int up)
{
    cylint_line line;
    cylint_query q;
    cylint_open_at(&q, s, &line, cylint_base(s));
    const cylint_terms_exact *L = cylint_load_exact(&q, FORM_ALPHA, 0);
    cylint_arena *m = &q.arena;
    const exact middle = cylint_exact_of_sum(m, center, offset);
    const exact by = !cylint_is_round(s->kind) && cylint_has_end_points(s->kind)
                         ? L->vv
                         : L->one;
    const exact square =
        cylint_exact_mul(m, cylint_exact_mul(m, L->r[end], L->r[end]),
                         exact_square_across(m, L, j));
    const surd reach = cylint_root_of_quotient(&q, square, by);
    return exactly_outward(&q, &reach, middle,
                           up ? L->one : cylint_exact_neg(L->one), L->one, up);
}

/* A coordinate of the apex: base - w r0 / dr. */
static double exact_side_of_apex(cylint_query *q, int j, int up)
{
    const cylint_terms_exact *L = cylint_load_exact(q, FORM_ALPHA, 0);
    const exact base = cylint_exact_from(&q->arena, cylint_base(q->shape)[j]);
    const exact f0 = cylint_combined_exact(L, base, L->dr, L->w[j], L->r[0]),
                zero = cylint_exact_zero(&q->arena);
    const surd none = cylint_root_of_quotient(q, zero, L->one);
    return exactly_outward(q, &none, f0, zero, L->dr, up);
}

/* ---------------------------------------------------------------- boxes -- */

/* Extends the box by the sides center + offset -+ reach. */
static void add_end(const box *to, int end, int j, double center, double offset,
                    pair reach, int is_exact)
{
    double side[2];
    const pair middle = pair_add((pair){center, 0}, (pair){offset, 0});
    for (int up = 0; up < 2; up++) {
        if (!outward(middle, reach, is_exact, up, &side[up]) || !to->serves)
            side[up] = exact_side_of_end(to->shape, end, j, center, offset, up);
    }
    to->lo[j] = cylint_less(side[0], to->lo[j]) ? side[0] : to->lo[j];
    to->hi[j] = cylint_less(to->hi[j], side[1]) ? side[1] : to->hi[j];
}

/* How far a section of radius 1 reaches along a coordinate: sqrt(square / by).  A
 * disc perpendicular to the axis w reaches sqrt(1 - w_j^2 / w.w) from its centre,
 * the ellipse with the semi-axes a and b sqrt(a_j^2 + b_j^2).  acone: the section
 * at z = 1 of a cone of tangent 1. */
typedef struct {
    pair square[3], by;
} unit_reaches;

static pair square_of(pair x)
{
    return pair_mul(x, x);
}

static unit_reaches reaches_of(const cylint_shape *s)
{
    unit_reaches u = {.by = {1, 0}};
    if (cylint_is_round(s->kind)) /* plain */
        return u;
    if (cylint_is_elliptic(s->kind)) {
        for (int j = 0; j < 3; j++)
            u.square[j] = pair_add(square_of((pair){cylint_a(s)[j], 0}),
                                   square_of((pair){cylint_b(s)[j], 0}));
        return u;
    }
    pair along[3];
    for (int j = 0; j < 3; j++)
        along[j] = square_of(cylint_axis_pair(s, j));
    for (int j = 0; j < 3; j++)
        u.square[j] = pair_add(along[(j + 1) % 3], along[(j + 2) % 3]);
    if (!cylint_has_tangent(s->kind))
        u.by = pair_add(u.square[0], along[0]);
    return u;
}

/* Whether a unit reach is a double, as that of a ball; then writes it. */
static int is_plain_reach(const cylint_shape *s, int j, double *reach)
{
    *reach = 1;
    if (cylint_is_round(s->kind))
        return 1;
    if (!cylint_is_elliptic(s->kind)) {
        *reach = cylint_runs_along(cylint_axis(s), j) ? 0 : 1;
        return *reach == 0 || (cylint_sign(cylint_axis(s)[j]) == 0 &&
                               !cylint_has_tangent(s->kind));
    }
    const double a = fabs(cylint_a(s)[j]), b = fabs(cylint_b(s)[j]);
    *reach = cylint_larger(a, b);
    return cylint_sign(a) == 0 || cylint_sign(b) == 0;
}

/* Extends the box by the discs or balls of the first `ends` ends. */
static void add_ends(const box *to, int ends)
{
    const cylint_shape *s = to->shape;
    const unit_reaches u = reaches_of(s);
    for (int j = 0; j < 3; j++) {
        pair unit = {0, 0};
        const int is_plain = is_plain_reach(s, j, &unit.hi);
        if (!is_plain)
            unit = pair_sqrt(pair_div(u.square[j], u.by));
        for (int end = 0; end < ends; end++) {
            const pair reach =
                pair_mul(unit, (pair){cylint_end_factor(s, end), 0});
            const int is_exact = reach.hi == 0 || (is_plain && reach.lo == 0);
            double center = cylint_base(s)[j], offset = 0;
            if (end && cylint_has_end_points(s->kind))
                center = cylint_top(s)[j];
            else if (end)
                offset = cylint_axis(s)[j];
            add_end(to, end, j, center, offset, reach, is_exact);
        }
    }
}

/* Whether |axis_j| is at least the growth of the disc's reach along coordinate
 * j, both per unit of z.  Exact. */
static int leans_inward(cylint_query *q, int j)
{
    const cylint_terms_exact *L = cylint_load_exact(q, FORM_ALPHA, 0);
    cylint_arena *m = &q->arena;
    const int used = m->used;
    exact along = cylint_exact_mul(m, L->w[j], L->w[j]);
    const exact dr2 = cylint_exact_mul(m, L->dr, L->dr);
    const exact growth = cylint_exact_mul(m, dr2, exact_square_across(m, L, j));
    if (cylint_has_end_points(q->kind))
        along = cylint_exact_mul(m, along, L->vv);
    const exact over = cylint_exact_sub(m, along, growth);
    return cylint_only_sign(m, used, over.sign) >= 0;
}

/* Writes the box of a nappe.  It is unbounded, except on one side of each
 * coordinate along which no ruling runs backwards: there the apex bounds it. */
static void write_nappe_box(const box *to)
{
    const cylint_shape *s = to->shape;
    cylint_line line;
    cylint_query q;
    cylint_open_at(&q, s, &line, cylint_base(s));
    const pair r0 = {cylint_r0(s), 0}, growth = cylint_radius_growth(s);
    const int at_base = cylint_sign(r0.hi) == 0;
    for (int j = 0; j < 3; j++) {
        to->lo[j] = -HUGE_VAL;
        to->hi[j] = HUGE_VAL;
        if (!leans_inward(&q, j))
            continue;
        /* the apex: p0 - w r0 / dr */
        const pair w = cylint_axis_pair(s, j);
        pair offset = {0, 0};
        if (!at_base)
            offset = pair_neg(pair_div(pair_mul(w, r0), growth));
        /* mutant '<' -> '<=': where the nappe leans inward no factor is 0 */
        const int up = cylint_sign(w.hi) * cylint_sign(growth.hi) < 0;
        const double base = cylint_base(s)[j];
        double apex;
        if (!outward((pair){base, 0}, up ? offset : pair_neg(offset), at_base,
                     up, &apex) ||
            !to->serves)
            apex = exact_side_of_apex(&q, j, up);
        *(up ? &to->hi[j] : &to->lo[j]) = apex;
    }
}

/* The plane bounds the box on one side, if it is perpendicular to an axis. */
static void write_half_space_box(const cylint_shape *s, double lo[3],
                                 double hi[3])
{
    const double *n = cylint_axis(s);
    for (int j = 0; j < 3; j++) {
        const int side = cylint_runs_along(n, j) ? cylint_sign(n[j]) : 0;
        const double at = cylint_positive_zero(cylint_base(s)[j]);
        lo[j] = side < 0 ? at : -HUGE_VAL;
        hi[j] = side > 0 ? at : HUGE_VAL;
    }
}

void cylint_bounds(const cylint_shape *shape, double lo[3], double hi[3])
{
    const int kind = shape->kind, bounded = cylint_is_bounded(shape);
    for (int j = 0; j < 3; j++) {
        lo[j] = HUGE_VAL;
        hi[j] = -HUGE_VAL;
    }
    if (kind == CYLINT_KIND_NONE)
        return;
    if (cylint_is_plane(kind)) {
        write_half_space_box(shape, lo, hi);
        return;
    }
    const box to = {shape, lo, hi, pairs_serve(shape)};
    if (cylint_is_nappe(shape)) {
        write_nappe_box(&to);
        return;
    }
    if (bounded || !cylint_is_tapered(kind))
        add_ends(&to, bounded && kind != CYLINT_KIND_SPHERE ? 2 : 1);
    for (int j = 0; j < 3; j++)
        if (!bounded && (cylint_is_tapered(kind) ||
                         cylint_sign(cylint_axis(shape)[j]) != 0)) {
            lo[j] = -HUGE_VAL;
            hi[j] = HUGE_VAL;
        }
}
