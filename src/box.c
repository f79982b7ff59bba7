/*
 * box.c - the least axis-parallel box of a shape, rounded outward
 *
 * A bounded shape is the convex hull of its two discs.
 */
#include "intersect.h"

/* The axis is 2^e times these pairs.  e is 0 unless a component of the axis
 * overflows. */
typedef struct {
    pair axis[3];
    int e;
} long_axis;

static long_axis axis_of(const cylint_shape *s)
{
    long_axis k = {.e = 0};
    const int fits = cylint_largest(cylint_axis(s)) <= DBL_MAX;
    double hi[3], lo[3];
    if (!fits) {
        k.e = 2;
        cylint_scaled_difference(hi, lo, cylint_top(s), cylint_base(s), -k.e);
    }
    for (int i = 0; i < 3; i++)
        k.axis[i] = fits ? cylint_axis_pair(s, i) : (pair){hi[i], lo[i]};
    return k;
}

static void write_side(double lo[3], double hi[3], int j, double low,
                       double high)
{
    lo[j] = low;
    hi[j] = high;
}

static void extend_side(double lo[3], double hi[3], int j, double low,
                        double high)
{
    write_side(lo, hi, j, cylint_less(low, lo[j]) ? low : lo[j],
               cylint_less(hi[j], high) ? high : hi[j]);
}

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
    *side = cylint_next(cylint_next(moved, up), up);
    return error <= CYLINT_ROUNDING / 2 * fabs(sum.hi);
}

/* ----------------------------------------------------- by exact numbers -- */

/* Whether pairs serve for a side of these terms: their sums are exact, or within
 * CYLINT_BOX_ERROR, only where rounding is to nearest, and nothing is flushed to
 * zero or overflows. */
static int pairs_serve(double center, double offset, double reach)
{
    const double most =
        cylint_larger(cylint_larger(fabs(center), fabs(offset)), fabs(reach));
    const int tiny = cylint_too_small(center) | cylint_too_small(offset) |
                     cylint_too_small(reach);
    return most <= cylint_power_of_two(CYLINT_LARGE_EXPONENT) &&
           cylint_rounds_to_nearest() && !(tiny && cylint_flushes_subnormals());
}

/* The number middle / unit + sqrt(square / by), where unit > 0 and by > 0, and unit
 * is 1 unless square is 0. */
typedef struct {
    cylint_arena *arena;
    exact middle, unit, square, by;
} exact_side;

/* Whether a double is at least this number. */
static int is_beyond(const exact_side *q, double x)
{
    cylint_arena *m = q->arena;
    const int used = m->used;
    const exact reach = cylint_exact_add(
        m, cylint_exact_mul(m, cylint_exact_from(m, x), q->unit),
        cylint_exact_neg(q->middle));
    const exact square =
        cylint_exact_mul(m, cylint_exact_mul(m, reach, reach), q->by);
    const int sign =
        cylint_exact_add(m, square, cylint_exact_neg(q->square)).sign;
    m->used = used;
    return reach.sign >= 0 && sign >= 0;
}

/* The least double that is_beyond(), infinite if none is.  `guess` only saves
 * time: the steps away from it double, and end before a rank can overflow. */
static double least_beyond(const exact_side *q, double guess)
{
    const int64_t longest = (int64_t)1 << 52;
    int64_t out = cylint_rank(HUGE_VAL), in = -out, step = 1;
    int64_t at = fabs(guess) <= DBL_MAX ? cylint_rank(guess) : 0;
    while (in + 1 < out) {
        if (at <= in || at >= out || step == longest)
            at = in + (int64_t)(((uint64_t)out - (uint64_t)in) / 2);
        if (is_beyond(q, cylint_from_rank(at)))
            at = (out = at) - step;
        else
            at = (in = at) + step;
        step = step < longest ? 2 * step : longest;
    }
    return cylint_from_rank(out);
}

/* The greatest double that is not above middle / unit - sqrt(square / by), or the
 * least one that is not below it (up). */
static double exactly_outward(exact_side *q, double guess, int up)
{
    if (!up)
        q->middle = cylint_exact_neg(q->middle);
    return up ? least_beyond(q, guess) : -least_beyond(q, -guess);
}

/* A side of the disc or ball at an end, whose centre is center + offset. */
ASIDE double exact_side_of_end(const cylint_shape *s, int end, int j,
                               double center, double offset, double guess,
                               int up)
{
    cylint_line line;
    cylint_query q;
    cylint_open_at(&q, s, &line, cylint_base(s));
    const cylint_terms_exact *L = cylint_load_exact(&q, FORM_ALPHA, 0);
    cylint_arena *m = &q.arena;
    const exact middle = cylint_exact_add(m, cylint_exact_from(m, center),
                                          cylint_exact_from(m, offset));
    const exact square = cylint_exact_mul(m, L->r[end], L->r[end]);
    exact_side side = {m, middle, L->one, square, L->one};
    if (!cylint_is_round(s->kind)) {
        const exact w2 = cylint_exact_mul(m, L->w[j], L->w[j]);
        const exact across =
            cylint_is_elliptic(s->kind)
                ? cylint_exact_add(m, cylint_exact_mul(m, L->a[j], L->a[j]),
                                   cylint_exact_mul(m, L->b[j], L->b[j]))
                : cylint_exact_add(m, L->vv, cylint_exact_neg(w2));
        side.square = cylint_exact_mul(m, square, across);
        if (cylint_has_end_points(s->kind))
            side.by = L->vv;
    }
    return exactly_outward(&side, guess, up);
}

/* A coordinate of the apex: base - w r0 / dr. */
static double exact_side_of_apex(cylint_query *q, int j, double guess, int up)
{
    const cylint_terms_exact *L = cylint_load_exact(q, FORM_ALPHA, 0);
    cylint_arena *m = &q->arena;
    const exact base = cylint_exact_from(m, cylint_base(q->shape)[j]);
    const exact middle = cylint_exact_add(
        m, cylint_exact_mul(m, base, L->dr),
        cylint_exact_neg(cylint_exact_mul(m, L->w[j], L->r[0])));
    const int is_positive = L->dr.sign > 0;
    exact_side side = {m, is_positive ? middle : cylint_exact_neg(middle),
                       is_positive ? L->dr : cylint_exact_neg(L->dr),
                       cylint_exact_from(m, 0), L->one};
    return exactly_outward(&side, guess, up);
}

/* ---------------------------------------------------------------- boxes -- */

/* Extends the box by the sides center + offset -+ reach. */
static void add_end(const cylint_shape *s, int end, int j, double center,
                    double offset, pair reach, int is_exact, int serves,
                    double lo[3], double hi[3])
{
    double side[2];
    const pair middle = pair_add((pair){center, 0}, (pair){offset, 0});
    for (int up = 0; up < 2; up++) {
        if (!outward(middle, reach, is_exact, up, &side[up]) || !serves)
            side[up] =
                exact_side_of_end(s, end, j, center, offset, side[up], up);
    }
    extend_side(lo, hi, j, side[0], side[1]);
}

/* Extends the box along coordinate j by the disc of a cap.  unit 2^e is the reach
 * of a disc of radius 1. */
static void add_disc(const cylint_shape *s, int cap, int j, pair unit, int e,
                     int is_exact, double lo[3], double hi[3])
{
    const double r = cylint_end_factor(s, cap);
    int er;
    const pair radius = cylint_mantissa(r, &er);
    const pair product = pair_mul(unit, radius);
    double center = cylint_base(s)[j], offset = 0;
    if (cap && cylint_has_end_points(s->kind))
        center = cylint_top(s)[j];
    else if (cap)
        offset = cylint_axis(s)[j];
    const pair reach = cylint_scaled_pair(product, e + er);
    is_exact =
        cylint_sign(r) == 0 ||
        (is_exact && (r == 1 || unit.hi == 1 || cylint_sign(unit.hi) == 0));
    /* not a reach that rounds to a subnormal number or 0 */
    is_exact &= cylint_scaled(reach.hi, -e - er) == product.hi;
    const int serves = pairs_serve(center, offset, reach.hi);
    add_end(s, cap, j, center, offset, reach, is_exact, serves, lo, hi);
}

/* Extends the box by the discs of the first caps. */
static void add_discs(const cylint_shape *s, int caps, double lo[3],
                      double hi[3])
{
    const long_axis k = axis_of(s);
    for (int j = 0; j < 3; j++) {
        int is_exact, e;
        const pair unit = cylint_unit_reach(s, k.axis, j, &e, &is_exact);
        for (int cap = 0; cap < caps; cap++)
            add_disc(s, cap, j, unit, e, is_exact, lo, hi);
    }
}

/* Extends the box by the ball about an end. */
static void add_ball(const cylint_shape *s, int end, double lo[3], double hi[3])
{
    const pair r = {cylint_end_factor(s, end), 0};
    for (int j = 0; j < 3; j++) {
        const double c = cylint_end_center(s, end, j);
        add_end(s, end, j, c, 0, r, 1, pairs_serve(c, 0, r.hi), lo, hi);
    }
}

/* Whether |axis_j| is at least the growth of the disc's reach along coordinate
 * j, both per unit of z.  Exact. */
static int leans_inward(cylint_query *q, int j)
{
    const cylint_terms_exact *L = cylint_load_exact(q, FORM_ALPHA, 0);
    cylint_arena *m = &q->arena;
    const int used = m->used;
    exact along = cylint_exact_mul(m, L->w[j], L->w[j]), across;
    const exact dr2 = cylint_exact_mul(m, L->dr, L->dr);
    if (cylint_is_elliptic(q->kind)) {
        across = cylint_exact_add(m, cylint_exact_mul(m, L->a[j], L->a[j]),
                                  cylint_exact_mul(m, L->b[j], L->b[j]));
    } else {
        const exact wj2 = along;
        across = cylint_exact_add(m, L->vv, cylint_exact_neg(wj2));
        if (cylint_has_end_points(q->kind))
            along = cylint_exact_mul(m, along, L->vv);
    }
    const int sign =
        cylint_exact_add(m, along,
                         cylint_exact_neg(cylint_exact_mul(m, dr2, across)))
            .sign;
    m->used = used;
    return sign >= 0;
}

/* Writes the box of a nappe.  It is unbounded, except on one side of each
 * coordinate along which no ruling runs backwards: there the apex bounds it. */
static void write_nappe_box(const cylint_shape *s, double lo[3], double hi[3])
{
    cylint_line line;
    cylint_query q;
    cylint_open_at(&q, s, &line, cylint_base(s));
    const long_axis k = axis_of(s);
    const pair growth = cylint_radius_growth(s);
    const int er = cylint_exponent(cylint_r0(s)),
              ed = cylint_exponent(growth.hi);
    const pair r0 = {cylint_scaled(cylint_r0(s), -er), 0};
    const pair dr = cylint_scaled_pair(growth, -ed);
    for (int j = 0; j < 3; j++) {
        write_side(lo, hi, j, -HUGE_VAL, HUGE_VAL);
        if (!leans_inward(&q, j))
            continue;
        /* the apex: p0 - w r0 / dr */
        pair quotient = {0, 0};
        const int ew = cylint_exponent(k.axis[j].hi);
        const int at_base = cylint_sign(cylint_r0(s)) == 0;
        if (!at_base)
            quotient = pair_neg(
                pair_div(pair_mul(cylint_scaled_pair(k.axis[j], -ew), r0), dr));
        const pair offset = cylint_scaled_pair(quotient, k.e + ew + er - ed);
        const int widens = cylint_sign(k.axis[j].hi) * cylint_sign(growth.hi);
        /* mutant '<' -> '<=': where the nappe leans inward no factor is 0 */
        const int up = widens < 0;
        const double base = cylint_base(s)[j];
        double apex;
        if (!outward((pair){base, 0}, up ? offset : pair_neg(offset), at_base,
                     up, &apex) ||
            !pairs_serve(base, offset.hi, 0))
            apex = exact_side_of_apex(&q, j, apex, up);
        *(up ? &hi[j] : &lo[j]) = apex;
    }
}

/* The plane bounds the box on one side, if it is perpendicular to an axis. */
static void write_half_space_box(const cylint_shape *s, double lo[3],
                                 double hi[3])
{
    const double *n = cylint_axis(s);
    for (int j = 0; j < 3; j++) {
        const int k = (j + 1) % 3, m = (j + 2) % 3;
        const int side =
            cylint_sign(n[k]) || cylint_sign(n[m]) ? 0 : cylint_sign(n[j]);
        write_side(lo, hi, j, side < 0 ? cylint_base(s)[j] : -HUGE_VAL,
                   side > 0 ? cylint_base(s)[j] : HUGE_VAL);
    }
}

void cylint_bounds(const cylint_shape *shape, double lo[3], double hi[3])
{
    const int kind = shape->kind, bounded = cylint_is_bounded(shape);
    for (int j = 0; j < 3; j++)
        write_side(lo, hi, j, HUGE_VAL, -HUGE_VAL);
    if (kind == CYLINT_KIND_NONE)
        return;
    if (cylint_is_plane(kind)) {
        write_half_space_box(shape, lo, hi);
        return;
    }
    if (cylint_is_nappe(shape)) {
        write_nappe_box(shape, lo, hi);
        return;
    }
    if (cylint_is_round(kind)) {
        add_ball(shape, 0, lo, hi);
        if (kind != CYLINT_KIND_SPHERE)
            add_ball(shape, 1, lo, hi);
    } else if (bounded || !cylint_is_tapered(kind)) {
        add_discs(shape, bounded ? 2 : 1, lo, hi);
    }
    for (int j = 0; j < 3; j++)
        if (!bounded && (cylint_is_tapered(kind) ||
                         cylint_sign(cylint_axis(shape)[j]) != 0))
            write_side(lo, hi, j, -HUGE_VAL, HUGE_VAL);
}
