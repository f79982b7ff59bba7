/*
 * box.c - the least axis-parallel box of a shape, rounded outward
 *
 * A disc of radius r across the axis w reaches r sqrt(1 - w_j^2 / vv) from
 * its centre along coordinate j; the ellipse of a and b reaches
 * sqrt(a_j^2 + b_j^2).  A bounded shape is the hull of its two discs.
 */
#include "internal.h"

/* A shape with lengths near 1: true lengths are 2^e times these. */
typedef struct {
    pair axis[3], a[3], b[3];
    int e, kind;
} scaled;

static scaled scaled_of(const cylint_shape *s)
{
    scaled k = {.e = cylint_length_exponent(s), .kind = s->kind};
    double hi[3], lo[3] = {0, 0, 0};
    const int dimensionless = s->kind >= CYLINT_KIND_ACONE;
    if (dimensionless)
        for (int i = 0; i < 3; i++)
            hi[i] = cylint_scaled(s->axis[i], -k.e);
    else
        cylint_scaled_difference(hi, lo, s->top, s->base, -k.e);
    for (int i = 0; i < 3; i++) {
        k.axis[i] = (pair){hi[i], lo[i]};
        k.a[i] = (pair){cylint_scaled(s->a[i], -k.e), 0};
        k.b[i] = (pair){cylint_scaled(s->b[i], -k.e), 0};
    }
    return k;
}

static pair squares(pair x, pair y)
{
    return pair_add(pair_mul(x, x), pair_mul(y, y));
}

static pair unscaled(pair x, int e)
{
    return (pair){cylint_scaled(x.hi, e), cylint_scaled(x.lo, e)};
}

static pair root(pair x)
{
    return x.hi > 0 ? pair_sqrt(x) : (pair){0, 0};
}

/* sqrt(x^2 + y^2) 2^*e, whatever the exponents of x and y. */
static pair hypotenuse(pair x, pair y, int *e)
{
    const double most = fmax(fabs(x.hi), fabs(y.hi));
    const int k = most < DBL_MIN ? cylint_exponent(most * 0x1p60) - 60
                                 : cylint_exponent(most);
    *e += k;
    return root(squares(unscaled(x, -k), unscaled(y, -k)));
}

/* How far the section of unit radius (circular: at distance 1 from the axis;
 * acone: where the tangent is 1) reaches along coordinate j, times 2^*e;
 * *is_exact: no rounding was needed. */
static pair unit_reach(const scaled *k, int j, int *e, int *is_exact)
{
    const pair zero = {0, 0}, one = {1, 0};
    *is_exact = 0;
    *e = 0;
    if (k->kind >= CYLINT_KIND_ECYLINDER) {
        const int flat_a = k->a[j].hi == 0, flat_b = k->b[j].hi == 0;
        *is_exact = flat_a || flat_b;
        if (*is_exact)
            return (pair){fabs(flat_a ? k->b[j].hi : k->a[j].hi), 0};
        return hypotenuse(k->a[j], k->b[j], e);
    }
    const pair y = k->axis[(j + 1) % 3], z = k->axis[(j + 2) % 3];
    if (y.hi == 0 && z.hi == 0) {
        *is_exact = 1;
        return zero;
    }
    const pair across = hypotenuse(y, z, e);
    if (k->kind == CYLINT_KIND_ACONE)
        return across;
    if (k->axis[j].hi == 0) {
        *is_exact = 1;
        *e = 0;
        return one;
    }
    int whole = 0;
    const pair length = hypotenuse(unscaled(across, *e), k->axis[j], &whole);
    *e -= whole;
    return pair_div(across, length);
}

static double step(double x, int up)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    if (bits << 1 == 0) {
        bits = up ? 1 : (uint64_t)1 << 63 | 1;
    } else {
        const int grow = (bits >> 63 ? 0 : 1) == up;
        bits = grow ? bits + 1 : bits - 1;
    }
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* center + offset + reach, outward.  The pairs' errors are far below an
 * ulp of the largest term; where nothing was rounded the sum's own low part
 * tells on which side of hi it lies. */
static double outward(double center, pair offset, pair reach, int is_exact,
                      int up)
{
    const pair far = pair_add(offset, up ? reach : pair_neg(reach));
    const pair sum = pair_add((pair){center, 0}, far);
    if (!(fabs(sum.hi) <= DBL_MAX))
        return up ? HUGE_VAL : -HUGE_VAL;
    const int terms = (center != 0) + (offset.hi != 0) + (reach.hi != 0);
    if (is_exact && (terms <= 1 ? far.lo == 0 : terms == 2)) {
        const double exact_low = sum.lo;
        if (up ? exact_low <= 0 : exact_low >= 0)
            return sum.hi;
        return step(sum.hi, up);
    }
    return step(step(sum.hi, up), up);
}

/* The disc of cap i, to the box. */
static void take_disc(const cylint_shape *s, const scaled *k, int cap,
                      double lo[3], double hi[3])
{
    const double r = cap ? s->r1 : s->r0;
    const int er = r < DBL_MIN ? -1022 : cylint_exponent(r);
    for (int j = 0; j < 3; j++) {
        int is_exact, e;
        pair reach = unit_reach(k, j, &e, &is_exact);
        const int keeps = r == 1 || reach.hi == 1 || reach.hi == 0 ||
                          cylint_sign(r) == 0;
        if (s->kind >= CYLINT_KIND_ACONE) /* a length by a factor */
            e += k->e;
        reach = unscaled(pair_mul(reach, (pair){cylint_scaled(r, -er), 0}),
                         e + er);
        is_exact = keeps && (is_exact || reach.hi == 0);
        double center = s->base[j];
        pair offset = {0, 0};
        if (cap && s->kind <= CYLINT_KIND_CONE)
            center = s->top[j];
        else if (cap)
            offset = (pair){s->axis[j], 0};
        const double low = outward(center, offset, reach, is_exact, 0);
        const double high = outward(center, offset, reach, is_exact, 1);
        lo[j] = low < lo[j] ? low : lo[j];
        hi[j] = high > hi[j] ? high : hi[j];
    }
}

/* The sign of |axis_j| - reach of the rulings, per unit of z; exactly. */
static int leans_inward(cylint_query *q, int j)
{
    const letters_exact *L = cylint_exact(q);
    cylint_arena *m = &q->arena;
    const int used = m->used;
    exact along = cylint_exact_mul(m, L->w[j], L->w[j]), across;
    const exact dr2 = cylint_exact_mul(m, L->dr, L->dr);
    if (q->kind >= CYLINT_KIND_ECYLINDER) {
        across = cylint_exact_add(m, cylint_exact_mul(m, L->a[j], L->a[j]),
                                  cylint_exact_mul(m, L->b[j], L->b[j]));
    } else {
        const exact wj2 = along;
        across = cylint_exact_add(m, L->vv, cylint_exact_neg(wj2));
        if (q->kind == CYLINT_KIND_CONE)
            along = cylint_exact_mul(m, along, L->vv);
    }
    const int sign = cylint_exact_add(m, along, cylint_exact_neg(
                         cylint_exact_mul(m, dr2, across))).sign;
    m->used = used;
    return sign >= 0;
}

/* A nappe grows from its apex without bound, but not backwards along a
 * coordinate to which all its rulings lean the same way. */
static void take_nappe(const cylint_shape *s, double lo[3], double hi[3])
{
    static const double along[3] = {1, 0, 0};
    cylint_line line;
    cylint_query q;
    cylint_whole_line(&line, s->base, along);
    cylint_query_open(&q, s, &line);
    const scaled k = scaled_of(s);
    const pair dr = {s->dr, s->dr_lo};
    for (int j = 0; j < 3; j++) {
        lo[j] = -HUGE_VAL;
        hi[j] = HUGE_VAL;
        if (!leans_inward(&q, j))
            continue;
        /* the apex: p0 - w r0 / dr */
        pair offset = {0, 0};
        if (cylint_sign(s->r0) != 0 && k.axis[j].hi != 0)
            offset = pair_neg(pair_div(
                unscaled(pair_mul(k.axis[j], (pair){s->r0, 0}), k.e), dr));
        const int up = cylint_sign(k.axis[j].hi) * cylint_sign(s->dr) < 0;
        const double apex = outward(s->base[j], offset, (pair){0, 0},
                                    offset.hi == 0, up);
        *(up ? &hi[j] : &lo[j]) = apex;
    }
}

void cylint_bounds(const cylint_shape *shape, double lo[3], double hi[3])
{
    for (int j = 0; j < 3; j++) {
        lo[j] = HUGE_VAL;
        hi[j] = -HUGE_VAL;
    }
    if (shape->kind == CYLINT_KIND_NONE)
        return;
    const int constant = shape->kind == CYLINT_KIND_CYLINDER ||
                         shape->kind == CYLINT_KIND_ECYLINDER;
    if (shape->ends >= CYLINT_INFINITE && !constant) {
        if (shape->ends == CYLINT_NAPPE) {
            take_nappe(shape, lo, hi);
            return;
        }
        for (int j = 0; j < 3; j++) {
            lo[j] = -HUGE_VAL;
            hi[j] = HUGE_VAL;
        }
        return;
    }
    const scaled k = scaled_of(shape);
    take_disc(shape, &k, 0, lo, hi);
    if (shape->ends < CYLINT_INFINITE) {
        take_disc(shape, &k, 1, lo, hi);
        return;
    }
    for (int j = 0; j < 3; j++)
        if (cylint_sign(k.axis[j].hi) != 0) {
            lo[j] = -HUGE_VAL;
            hi[j] = HUGE_VAL;
        }
}
