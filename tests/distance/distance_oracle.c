/*
 * distance_oracle.c - the oracle of distances to circular and round kinds
 *
 * The meridian half plane has the coordinates s, along the axis from the base,
 * and rho >= 0, the distance from the axis.  The figure's pieces are
 *     lateral surface   a segment, a ray, a line or two rays
 *     caps of planes    segments from the axis
 *     round ends        arcs of circles about points of the axis
 * The nearest point of each piece follows by projection.  The first piece with
 * the least distance is the answer.
 *
 * Two numbers are equal if they differ by less than 2^-(bits - GUARD) of the
 * largest length.  The numbers are algebraic of degree at most 16 with integers
 * of 2 or 4 times the range of the input's exponents; `bits` is 12 times that
 * range and BITS more.
 */
#include "distance_oracle.h"

#include <float.h>
#include <math.h>
#include <mpfr.h>
#include <string.h>

#include "cylint_distance.h"
#include "oracle.h"
#include "shapes/layout.h"

#define RND MPFR_RNDN

/* distance_oracle_elliptic.c; size: the distance, not rounded */
void oracle_elliptic_distance(const cylint_shape *shape, const double point[3],
                              struct oracle_closest *expected, mpfr_t size);

enum { BITS = 400, GUARD = 150, PIECES = 4, SCRATCH = 10 };

enum form { SEGMENT, RAY, LINE, ARC };

typedef struct piece {
    enum form form;
    mpfr_t s, rho;                  /* start; arc: centre */
    mpfr_t ds, drho;                /* direction; arc: ds is the radius */
    mpfr_t n[2];                    /* normal along s and rho; arcs: none */
    int part, feature, first, last; /* inside, at the start, at the end */
} piece;

static struct {
    int ready;
    long bits;
    piece pieces[PIECES];
    int count;
    mpfr_t w[3], q[3], W, length, Z, across[3], s, rho;
    mpfr_t r0, r1, dr, sine, cosine, scale;
    mpfr_t best, foot[2], normal[2];
    mpfr_t t[SCRATCH];
} g;

/* ------------------------------------------------------------ numbers -- */

static mpfr_ptr all_numbers[128];
static int numbers;

static void add_number(mpfr_t x)
{
    mpfr_init2(x, 64);
    all_numbers[numbers++] = x;
}

static void start(void)
{
    mpfr_ptr single[] = {g.W,       g.length,  g.Z,         g.s,
                         g.rho,     g.r0,      g.r1,        g.dr,
                         g.sine,    g.cosine,  g.best,      g.scale,
                         g.foot[0], g.foot[1], g.normal[0], g.normal[1]};
    if (g.ready)
        return;
    g.ready = 1;
    for (size_t i = 0; i < sizeof single / sizeof single[0]; i++)
        add_number(single[i]);
    for (int i = 0; i < 3; i++) {
        add_number(g.w[i]);
        add_number(g.q[i]);
        add_number(g.across[i]);
    }
    for (int i = 0; i < SCRATCH; i++)
        add_number(g.t[i]);
    for (int i = 0; i < PIECES; i++) {
        piece *p = &g.pieces[i];
        mpfr_ptr of_piece[] = {p->s, p->rho, p->ds, p->drho, p->n[0], p->n[1]};
        for (int k = 0; k < 6; k++)
            add_number(of_piece[k]);
    }
}

static void widen(const double *x, int n, int *low, int *high)
{
    for (int i = 0; i < n; i++) {
        int e;
        if (x[i] == 0)
            continue;
        frexp(x[i], &e);
        *high = e > *high ? e : *high;
        *low = e - 53 < *low ? e - 53 : *low;
    }
}

/* Gives all numbers the bits that these data need. */
static void set_bits(const cylint_shape *shape, const double point[3])
{
    int low = 4096, high = -4096;
    const double radii[2] = {cylint_r0(shape), cylint_r1(shape)};
    widen(point, 3, &low, &high);
    widen(cylint_base(shape), 3, &low, &high);
    widen(radii, 2, &low, &high);
    if (shape->kind == CYLINT_KIND_ACONE)
        widen(cylint_axis(shape), 3, &low, &high);
    else if (shape->kind != CYLINT_KIND_SPHERE)
        widen(cylint_top(shape), 3, &low, &high);
    const long bits = BITS + 12 * (high > low ? high - low : 1);
    if (bits == g.bits)
        return;
    g.bits = bits;
    for (int i = 0; i < numbers; i++)
        mpfr_set_prec(all_numbers[i], bits);
}

/* The sign of x, a length that was computed from lengths of at most `scale`. */
static int sign_of(mpfr_t x)
{
    if (mpfr_zero_p(x))
        return 0;
    const long least = mpfr_get_exp(g.scale) - (g.bits - GUARD);
    return mpfr_get_exp(x) < least ? 0 : mpfr_sgn(x);
}

/* The same for numbers of size 1. */
static int sign_of_ratio(mpfr_t x)
{
    if (mpfr_zero_p(x))
        return 0;
    return mpfr_get_exp(x) < -(g.bits - GUARD) ? 0 : mpfr_sgn(x);
}

static void dot(mpfr_t to, mpfr_t u[3], mpfr_t v[3])
{
    mpfr_mul(to, u[0], v[0], RND);
    mpfr_fma(to, u[1], v[1], to, RND);
    mpfr_fma(to, u[2], v[2], to, RND);
}

/* `to` is neither u nor v. */
static void cross(mpfr_t to[3], mpfr_t u[3], mpfr_t v[3])
{
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        mpfr_mul(to[i], u[j], v[k], RND);
        mpfr_mul(g.t[9], u[k], v[j], RND);
        mpfr_sub(to[i], to[i], g.t[9], RND);
    }
}

static void norm(mpfr_t to, mpfr_t v[3])
{
    dot(to, v, v);
    mpfr_sqrt(to, to, RND);
}

/* to = sqrt(x^2 + y^2); `to` may be x. */
static void hypotenuse(mpfr_t to, mpfr_t x, mpfr_t y)
{
    mpfr_sqr(g.t[9], x, RND);
    mpfr_fma(g.t[9], y, y, g.t[9], RND);
    mpfr_sqrt(to, g.t[9], RND);
}

/* ------------------------------------------------- shape and point ----- */

/* The unit vector away from the axis through the point; on the axis e x w. */
static void load_across(void)
{
    mpfr_t c[3];
    for (int i = 0; i < 3; i++)
        mpfr_init2(c[i], g.bits);
    cross(c, g.q, g.w);
    if (mpfr_zero_p(c[0]) && mpfr_zero_p(c[1]) && mpfr_zero_p(c[2])) {
        int least = 0;
        for (int i = 1; i < 3; i++)
            if (mpfr_cmpabs(g.w[i], g.w[least]) < 0)
                least = i;
        for (int i = 0; i < 3; i++)
            mpfr_set_si(c[i], i == least, RND);
        cross(g.across, c, g.w);
        mpfr_set_ui(g.rho, 0, RND);
    } else {
        cross(g.across, g.w, c); /* |w|^2 q - (w.q) w */
        norm(g.rho, c);
        mpfr_div(g.rho, g.rho, g.length, RND);
    }
    norm(g.t[0], g.across);
    for (int i = 0; i < 3; i++) {
        mpfr_div(g.across[i], g.across[i], g.t[0], RND);
        mpfr_clear(c[i]);
    }
}

static void load(const cylint_shape *shape, const double point[3])
{
    const int sphere = shape->kind == CYLINT_KIND_SPHERE;
    for (int i = 0; i < 3; i++) {
        mpfr_set_d(g.q[i], point[i], RND);
        mpfr_sub_d(g.q[i], g.q[i], cylint_base(shape)[i], RND);
        if (shape->kind == CYLINT_KIND_ACONE) {
            mpfr_set_d(g.w[i], cylint_axis(shape)[i], RND);
        } else {
            mpfr_set_d(g.w[i], cylint_top(shape)[i], RND);
            mpfr_sub_d(g.w[i], g.w[i], cylint_base(shape)[i], RND);
        }
        if (sphere) /* any axis will do */
            mpfr_set_si(g.w[i], i == 2, RND);
    }
    dot(g.W, g.w, g.w);
    mpfr_sqrt(g.length, g.W, RND);
    dot(g.Z, g.q, g.w);
    mpfr_div(g.s, g.Z, g.length, RND);
    load_across();
    mpfr_set_d(g.r0, cylint_r0(shape), RND);
    mpfr_set_d(g.r1, sphere ? cylint_r0(shape) : cylint_r1(shape), RND);
    if (shape->kind == CYLINT_KIND_ACONE)
        mpfr_mul(g.r1, g.r1, g.length, RND);
    mpfr_sub(g.dr, g.r1, g.r0, RND);
    norm(g.scale, g.q);
    mpfr_max(g.scale, g.scale, g.r0, RND);
    mpfr_max(g.scale, g.scale, g.r1, RND);
    if (!sphere)
        mpfr_max(g.scale, g.scale, g.length, RND);
}

/* -------------------------------------------------------------- pieces -- */

static piece *new_piece(enum form form, int part, int feature)
{
    piece *p = &g.pieces[g.count++];
    p->form = form;
    p->part = part;
    p->feature = p->first = p->last = feature;
    mpfr_set_ui(p->n[0], 0, RND);
    mpfr_set_ui(p->n[1], 0, RND);
    return p;
}

/* The normal (-drho, ds), turned outward: away from the axis. */
static void straight_normal(piece *p)
{
    hypotenuse(g.t[0], p->ds, p->drho);
    mpfr_div(p->n[0], p->drho, g.t[0], RND);
    mpfr_div(p->n[1], p->ds, g.t[0], RND);
    if (mpfr_sgn(p->ds) > 0)
        mpfr_neg(p->n[0], p->n[0], RND);
    else
        mpfr_neg(p->n[1], p->n[1], RND);
}

static void add_lateral_segment(mpfr_t s0, mpfr_t rho0, mpfr_t s1, mpfr_t rho1)
{
    piece *p = new_piece(SEGMENT, CYLINT_PART_LATERAL, CYLINT_FEATURE_LATERAL);
    mpfr_set(p->s, s0, RND);
    mpfr_set(p->rho, rho0, RND);
    mpfr_sub(p->ds, s1, s0, RND);
    mpfr_sub(p->drho, rho1, rho0, RND);
    p->first = mpfr_sgn(rho0) ? CYLINT_FEATURE_RIM0 : CYLINT_FEATURE_APEX;
    p->last = mpfr_sgn(rho1) ? CYLINT_FEATURE_RIM1 : CYLINT_FEATURE_APEX;
    straight_normal(p);
}

/* From the apex to the side `sign` of the axis. */
static void add_nappe(int sign)
{
    piece *p = new_piece(RAY, CYLINT_PART_LATERAL, CYLINT_FEATURE_LATERAL);
    mpfr_mul(p->s, g.r0, g.length, RND);
    mpfr_div(p->s, p->s, g.dr, RND);
    mpfr_neg(p->s, p->s, RND);
    mpfr_set_ui(p->rho, 0, RND);
    mpfr_mul_si(p->ds, g.length, sign, RND);
    mpfr_abs(p->drho, g.dr, RND);
    p->first = CYLINT_FEATURE_APEX;
    straight_normal(p);
}

static void add_cap(int end)
{
    piece *p = new_piece(SEGMENT, end ? CYLINT_PART_CAP1 : CYLINT_PART_CAP0,
                         end ? CYLINT_FEATURE_CAP1 : CYLINT_FEATURE_CAP0);
    mpfr_set_ui(p->s, 0, RND);
    if (end)
        mpfr_set(p->s, g.length, RND);
    mpfr_set_ui(p->rho, 0, RND);
    mpfr_set_ui(p->ds, 0, RND);
    mpfr_set(p->drho, end ? g.r1 : g.r0, RND);
    mpfr_set_si(p->n[0], end ? 1 : -1, RND);
    if (mpfr_zero_p(p->drho))
        g.count--; /* an apex */
}

static void add_arc(int end, int part, int feature)
{
    piece *p = new_piece(ARC, part, feature);
    mpfr_set_ui(p->s, 0, RND);
    if (end)
        mpfr_set(p->s, g.length, RND);
    mpfr_set_ui(p->rho, 0, RND);
    mpfr_set(p->ds, end ? g.r1 : g.r0, RND);
    if (mpfr_zero_p(p->ds))
        g.count--; /* an apex */
}

static int has_cap(const cylint_shape *shape, int end)
{
    return shape->ends == CYLINT_ENDS_CAPPED ||
           shape->ends == (end ? CYLINT_ENDS_CAP1 : CYLINT_ENDS_CAP0);
}

static void straight_pieces(const cylint_shape *shape)
{
    const int growth = mpfr_sgn(g.dr);
    if (shape->ends < CYLINT_ENDS_INFINITE) {
        mpfr_set_ui(g.t[1], 0, RND);
        add_lateral_segment(g.t[1], g.r0, g.length, g.r1);
        for (int end = 0; end < 2; end++)
            if (has_cap(shape, end))
                add_cap(end);
    } else if (growth == 0) {
        mpfr_set_ui(g.t[1], 0, RND);
        add_lateral_segment(g.t[1], g.r0, g.length, g.r1);
        g.pieces[0].form = LINE;
    } else {
        add_nappe(growth);
        if (shape->ends == CYLINT_ENDS_INFINITE)
            add_nappe(-growth);
    }
}

/* The segment that touches both arcs. */
static void round_pieces(const cylint_shape *shape)
{
    if (shape->kind == CYLINT_KIND_SPHERE) {
        static const int feature[] = {CYLINT_FEATURE_LATERAL,
                                      CYLINT_FEATURE_CAP0, CYLINT_FEATURE_CAP1};
        if (cylint_surface(shape) == CYLINT_PART_LATERAL ||
            has_cap(shape, cylint_surface(shape) == CYLINT_PART_CAP1))
            add_arc(0, cylint_surface(shape), feature[cylint_surface(shape)]);
        return;
    }
    mpfr_div(g.sine, g.dr, g.length, RND);
    mpfr_neg(g.sine, g.sine, RND); /* of the normal's angle: its s */
    mpfr_sqr(g.t[0], g.sine, RND);
    mpfr_ui_sub(g.t[0], 1, g.t[0], RND);
    mpfr_sqrt(g.cosine, g.t[0], RND);
    mpfr_mul(g.t[1], g.r0, g.sine, RND);
    mpfr_mul(g.t[2], g.r0, g.cosine, RND);
    mpfr_fma(g.t[3], g.r1, g.sine, g.length, RND);
    mpfr_mul(g.t[4], g.r1, g.cosine, RND);
    add_lateral_segment(g.t[1], g.t[2], g.t[3], g.t[4]);
    if (has_cap(shape, 0))
        add_arc(0, CYLINT_PART_CAP0, CYLINT_FEATURE_CAP0);
    if (has_cap(shape, 1))
        add_arc(1, CYLINT_PART_CAP1, CYLINT_FEATURE_CAP1);
}

/* ------------------------------------------------------- nearest points -- */

/* t[0], t[1]: the point of a straight piece that is nearest.  Returns its
 * feature. */
static int foot_of_straight(const piece *p)
{
    mpfr_ptr s = g.t[0], rho = g.t[1], t = g.t[2], u = g.t[3];
    piece *q = (piece *)p;
    int feature = p->feature;
    mpfr_sub(s, g.s, q->s, RND);
    mpfr_sub(rho, g.rho, q->rho, RND);
    mpfr_mul(t, s, q->ds, RND);
    mpfr_fma(t, rho, q->drho, t, RND);
    hypotenuse(u, q->ds, q->drho);
    mpfr_div(t, t, u, RND); /* the length along the piece, which is u long */
    mpfr_sub(g.t[4], t, u, RND);
    if (p->form != LINE && sign_of(t) <= 0) {
        mpfr_set_ui(t, 0, RND);
        feature = p->first;
    } else if (p->form == SEGMENT && sign_of(g.t[4]) >= 0) {
        mpfr_set(t, u, RND);
        feature = p->last;
    }
    mpfr_div(t, t, u, RND);
    mpfr_fma(s, t, q->ds, q->s, RND);
    mpfr_fma(rho, t, q->drho, q->rho, RND);
    return feature;
}

/* The same for an arc; -1: its nearest point belongs to the lateral
 * surface.  t[5], t[6]: the normal. */
static int foot_of_arc(const piece *p, const cylint_shape *shape)
{
    mpfr_ptr s = g.t[0], rho = g.t[1];
    piece *q = (piece *)p;
    mpfr_sub(s, g.s, q->s, RND);
    hypotenuse(g.t[2], s, g.rho);
    if (mpfr_zero_p(g.t[2]))
        return -1;
    mpfr_div(s, s, g.t[2], RND);
    mpfr_div(rho, g.rho, g.t[2], RND);
    if (shape->kind != CYLINT_KIND_SPHERE) {
        mpfr_sub(g.t[3], s, g.sine, RND);
        if (sign_of_ratio(g.t[3]) != (p->part == CYLINT_PART_CAP1 ? 1 : -1))
            return -1;
    }
    mpfr_set(g.t[5], s, RND);
    mpfr_set(g.t[6], rho, RND);
    mpfr_fma(s, s, q->ds, q->s, RND);
    mpfr_mul(rho, rho, q->ds, RND);
    return p->feature;
}

static void take(const piece *p, int feature, int is_double,
                 struct oracle_closest *expected)
{
    piece *q = (piece *)p;
    const int is_arc = p->form == ARC;
    expected->part = p->part;
    expected->feature = feature;
    mpfr_set(g.best, g.t[7], RND);
    for (int i = 0; i < 2; i++) {
        mpfr_set(g.foot[i], g.t[i], RND);
        mpfr_set(g.normal[i], is_arc ? g.t[5 + i] : q->n[i], RND);
    }
    if (feature == CYLINT_FEATURE_APEX) {
        mpfr_set_si(g.normal[0], p->first == feature ? -1 : 1, RND);
        if (p->form == RAY && mpfr_sgn(q->ds) < 0)
            mpfr_neg(g.normal[0], g.normal[0], RND);
        if (is_double && mpfr_sgn(g.r0) != 0) /* towards the base */
            mpfr_set_si(g.normal[0], mpfr_sgn(g.dr), RND);
        mpfr_set_ui(g.normal[1], 0, RND);
    }
}

static void nearest_piece(const cylint_shape *shape,
                          struct oracle_closest *expected)
{
    expected->part = -1;
    for (int i = 0; i < g.count; i++) {
        const piece *p = &g.pieces[i];
        const int feature =
            p->form == ARC ? foot_of_arc(p, shape) : foot_of_straight(p);
        if (feature < 0)
            continue;
        mpfr_sub(g.t[7], g.t[0], g.s, RND);
        mpfr_sub(g.t[8], g.t[1], g.rho, RND);
        hypotenuse(g.t[7], g.t[7], g.t[8]);
        mpfr_sub(g.t[8], g.t[7], g.best, RND);
        if (expected->part < 0 || sign_of(g.t[8]) < 0)
            take(p, feature, shape->ends == CYLINT_ENDS_INFINITE, expected);
    }
}

/* ---------------------------------------------------------- the answer -- */

/* to = s (the axis's direction) + rho across + base */
static void in_space(double to[3], mpfr_t s, mpfr_t rho, const double *base)
{
    for (int i = 0; i < 3; i++) {
        mpfr_div(g.t[0], g.w[i], g.length, RND);
        mpfr_mul(g.t[0], g.t[0], s, RND);
        mpfr_fma(g.t[0], rho, g.across[i], g.t[0], RND);
        if (base)
            mpfr_add_d(g.t[0], g.t[0], base[i], RND);
        if (!base && sign_of_ratio(g.t[0]) == 0)
            mpfr_set_ui(g.t[0], 0, RND);
        if (base && sign_of(g.t[0]) == 0 &&
            !(mpfr_zero_p(s) && mpfr_zero_p(rho)))
            mpfr_set_ui(g.t[0], 0, RND);
        to[i] = mpfr_get_d(g.t[0], RND);
        if (to[i] == 0 && !mpfr_zero_p(g.t[0]))
            to[i] = mpfr_sgn(g.t[0]) * 0x1p-1074;
    }
}

static int is_signed(const cylint_shape *shape)
{
    return shape->ends == CYLINT_ENDS_CAPPED ||
           shape->ends >= CYLINT_ENDS_INFINITE;
}

static void apply_sign(const cylint_shape *shape, const double point[3])
{
    const int side = oracle_contains(shape, point);
    if (sign_of(g.best) == 0 || (is_signed(shape) && side == 0))
        mpfr_set_ui(g.best, 0, RND);
    else if (is_signed(shape) && side > 0)
        mpfr_neg(g.best, g.best, RND);
}

void oracle_distance(const cylint_shape *shape, const double point[3],
                     struct oracle_closest *expected)
{
    memset(expected, 0, sizeof *expected);
    start();
    if (shape->kind == CYLINT_KIND_ECYLINDER ||
        shape->kind == CYLINT_KIND_ECONE) {
        oracle_elliptic_distance(shape, point, expected, g.best);
        g.bits = 0;
        return;
    }
    set_bits(shape, point);
    load(shape, point);
    g.count = 0;
    if (shape->kind >= CYLINT_KIND_SPHERE)
        round_pieces(shape);
    else
        straight_pieces(shape);
    nearest_piece(shape, expected);
    expected->distance = HUGE_VAL;
    if (shape->kind == CYLINT_KIND_SPHERE && g.count > 0 &&
        expected->part < 0) { /* at the centre: along the first coordinate */
        expected->part = g.pieces[0].part;
        expected->feature = g.pieces[0].feature;
        mpfr_set(g.best, g.r0, RND);
        mpfr_set(g.foot[0], g.r0, RND);
        mpfr_set_ui(g.foot[1], 0, RND);
        mpfr_set_ui(g.normal[0], 1, RND);
        mpfr_set_ui(g.normal[1], 0, RND);
        for (int i = 0; i < 3; i++)
            mpfr_set_si(g.w[i], i == 0, RND);
    }
    if (expected->part < 0)
        return;
    apply_sign(shape, point);
    expected->distance = mpfr_get_d(g.best, RND);
    in_space(expected->point, g.foot[0], g.foot[1], cylint_base(shape));
    in_space(expected->normal, g.normal[0], g.normal[1], NULL);
}

int oracle_distance_is_zero(void)
{
    return mpfr_zero_p(g.best) != 0;
}

double oracle_distance_error(double got)
{
    int e;
    if (mpfr_zero_p(g.best))
        return got == 0 ? 0 : HUGE_VAL;
    if (!isfinite(got))
        return isinf(got) && isinf(mpfr_get_d(g.best, RND)) ? 0 : HUGE_VAL;
    mpfr_set_prec(g.t[0], mpfr_get_prec(g.best));
    frexp(mpfr_get_d(g.best, MPFR_RNDZ), &e);
    if (mpfr_cmpabs_ui(g.best, 0) && mpfr_get_exp(g.best) - 53 < -1074)
        e = -1074 + 53;
    mpfr_abs(g.t[0], g.best, RND);
    mpfr_d_sub(g.t[0], fabs(got), g.t[0], RND);
    mpfr_mul_2si(g.t[0], g.t[0], 53 - e, RND);
    return mpfr_get_d(g.t[0], RND);
}
