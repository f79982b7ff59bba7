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

/* center + offset + reach (up) or - reach, rounded outward.  If nothing was
 * rounded before, the sign of the sum's low part decides the rounding.
 * Otherwise the error of the pairs is at most CYLINT_BOX_ERROR; it is added
 * before the last rounding. */
static double outward(double center, pair offset, pair reach, int is_exact,
                      int up)
{
    const pair far = pair_add(offset, up ? reach : pair_neg(reach));
    const pair sum = pair_add((pair){center, 0}, far);
    if (!(fabs(sum.hi) <= DBL_MAX))
        return up ? HUGE_VAL : -HUGE_VAL;
    const int terms = (center != 0) + (offset.hi != 0) + (reach.hi != 0);
    is_exact = is_exact && !cylint_too_small(center) &&
               !cylint_too_small(offset.hi) && !cylint_too_small(reach.hi) &&
               terms <= 2;
    if (is_exact) {
        if (up ? sum.lo <= 0 : sum.lo >= 0)
            return sum.hi;
        return cylint_next(sum.hi, up);
    }
    const double error = CYLINT_BOX_ERROR * fabs(center) +
                         CYLINT_BOX_ERROR * fabs(offset.hi) +
                         CYLINT_BOX_ERROR * fabs(reach.hi);
    const double moved = sum.hi + (up ? sum.lo + error : sum.lo - error);
    return cylint_next(cylint_next(moved, up), up);
}

/* x 2^e; if that overflows, rounded outward. */
static double scaled_outward(double x, int e, int up)
{
    if (e == 0 || fabs(x) < cylint_power_of_two(1024 - e))
        return cylint_scaled(x, e);
    return x > 0 ? (up ? HUGE_VAL : DBL_MAX) : (up ? -DBL_MAX : -HUGE_VAL);
}

/* Extends the box by the disc of a cap.  The sum of two of the three terms may
 * overflow although the sum of all does not: the terms are scaled down first. */
static void add_disc(const cylint_shape *s, int cap, double lo[3], double hi[3])
{
    enum { SMALLER = 4 };
    const long_axis k = axis_of(s);
    const double r = cylint_end_factor(s, cap);
    int er;
    const pair radius = cylint_mantissa(r, &er);
    for (int j = 0; j < 3; j++) {
        int is_exact, e;
        const pair unit = cylint_unit_reach(s, k.axis, j, &e, &is_exact);
        const pair product = pair_mul(unit, radius);
        is_exact =
            cylint_sign(r) == 0 ||
            (is_exact && (r == 1 || unit.hi == 1 || cylint_sign(unit.hi) == 0));
        double center = cylint_base(s)[j], offset = 0;
        if (cap && cylint_has_end_points(s->kind))
            center = cylint_top(s)[j];
        else if (cap)
            offset = cylint_axis(s)[j];
        const double most = cylint_larger(fabs(center), fabs(offset));
        const int down = most > cylint_power_of_two(CYLINT_LARGE_EXPONENT) ||
                                 e + er > CYLINT_LARGE_EXPONENT
                             ? SMALLER
                             : 0;
        const pair reach = cylint_scaled_pair(product, e + er - down);
        /* a reach that rounds to 0 */
        is_exact &= cylint_sign(reach.hi) == cylint_sign(product.hi);
        const pair along = {cylint_scaled(offset, -down), 0};
        center = cylint_scaled(center, -down);
        const double low =
            scaled_outward(outward(center, along, reach, is_exact, 0), down, 0);
        const double high =
            scaled_outward(outward(center, along, reach, is_exact, 1), down, 1);
        extend_side(lo, hi, j, low, high);
    }
}

/* Extends the box by the ball about an end. */
static void add_ball(const cylint_shape *s, int end, double lo[3], double hi[3])
{
    const pair none = {0, 0}, r = {cylint_end_factor(s, end), 0};
    for (int j = 0; j < 3; j++) {
        const double c = cylint_end_center(s, end, j);
        extend_side(lo, hi, j, outward(c, none, r, 1, 0),
                    outward(c, none, r, 1, 1));
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
        pair offset = {0, 0};
        const int ew = cylint_exponent(k.axis[j].hi);
        const int at_base = cylint_sign(cylint_r0(s)) == 0;
        if (!at_base)
            offset = pair_neg(cylint_scaled_pair(
                pair_div(pair_mul(cylint_scaled_pair(k.axis[j], -ew), r0), dr),
                k.e + ew + er - ed));
        const int widens = cylint_sign(k.axis[j].hi) * cylint_sign(growth.hi);
        /* mutant '<' -> '<=': where the nappe leans inward no factor is 0 */
        const int up = widens < 0;
        const double apex =
            outward(cylint_base(s)[j], offset, (pair){0, 0}, at_base, up);
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
        add_disc(shape, 0, lo, hi);
        if (bounded)
            /* mutant '1' -> '2': any number but 0 means the other cap */
            add_disc(shape, 1, lo, hi);
    }
    for (int j = 0; j < 3; j++)
        if (!bounded && (cylint_is_tapered(kind) ||
                         cylint_sign(cylint_axis(shape)[j]) != 0))
            write_side(lo, hi, j, -HUGE_VAL, HUGE_VAL);
}
