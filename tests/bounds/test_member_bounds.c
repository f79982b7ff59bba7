/*
 * test_member_bounds.c - floor filter: the bounds of members.h and describe.h
 * against MPFR
 *
 * Computes the members of hits of random lines with random shapes, as one.c does,
 * and in MPFR from the numbers that a shape is made of and the exact root.  The
 * root given to members.h errs by at most its error, often by all of it.  Each note
 * has the largest error of a number over its bound, which must be at most 1.  A
 * bound 0 is that of an exact number.
 *
 * Shapes: all kinds, oblique, needles, discs, upright; sizes from 2^-20 to 2^20.
 * Lines: origins up to 1e8 sizes away, grazing, parallel to axes, segments.
 */
#define CYLINT_NARROW
#include "numbers/double_double.h" /* before simd.h */
#include "numbers/simd.h"

#if defined(HAVE_MPFR) && LANES == 2
#include <math.h>
#include <mpfr.h>
#include <stdint.h>
#include <stdlib.h>

#include "check.h"
#include "filter/describe.h"
#include "random.h"
#include "vectors.h"

enum { BITS = 448, LINES = 4, ROOTS = 3 };

static uint64_t stream = 24;

static double unit(void) /* in [-1, 1) */
{
    return 2 * random_unit(&stream) - 1;
}

static int below(int n)
{
    return random_int(&stream, n);
}

/* Either sign of 2^e, e from -range to range. */
static double power(int range)
{
    return ldexp(1 + random_unit(&stream), below(2 * range + 1) - range);
}

/* -------------------------------------------------------------- shapes -- */

/* Along a coordinate, of whole numbers, or any. */
static void any_vector(double v[3], double size)
{
    const int how = below(6), i = below(3);
    for (int j = 0; j < 3; j++)
        v[j] = how == 0   ? (i == j ? (below(2) ? 1 : -1) : 0)
               : how == 1 ? below(7) - 3
                          : unit();
    v[i] = v[i] == 0 ? 1 : v[i];
    for (int j = 0; j < 3; j++)
        v[j] *= size;
}

static void add_to(double to[3], double by, const double v[3])
{
    for (int j = 0; j < 3; j++)
        to[j] += by * v[j];
}

/* Makes the first two of the size, and all of them oblique or not. */
static void any_semi_axes(double a[3], double b[3], double h[3], double size)
{
    double other[3];
    any_vector(other, 1);
    any_vector(h, 1);
    cross3(a, h, other);
    cross3(b, a, h);
    if (below(4) == 0) { /* a component of b x h that cancels */
        const int i = below(3);
        const double by = unit();
        h[i] = by * b[i];
        h[(i + 1) % 3] = by * b[(i + 1) % 3] * (1 + ldexp(1, -below(50)));
    } else if (below(2)) {
        add_to(b, 3 * unit(), a);
        add_to(h, ldexp(unit(), below(8)), a);
        add_to(h, unit(), b);
    }
    const double scale[3] = {size, size * power(below(8)),
                             size * power(below(16))};
    for (int j = 0; j < 3; j++) {
        a[j] *= scale[0];
        b[j] *= scale[1];
        h[j] *= scale[2];
    }
}

/* Whether it is one that pairs serve. */
static int any_shape(cylint_shape *s)
{
    static const cylint_ends all[] = {CYLINT_ENDS_CAPPED, CYLINT_ENDS_CAPPED,
                                      CYLINT_ENDS_INFINITE, CYLINT_ENDS_NAPPE};
    const int kind = CYLINT_KIND_CYLINDER + below(CYLINT_KINDS - 1);
    const double size = below(3) ? 1 : power(20);
    const double thin = below(2) ? power(1) : power(below(20));
    const double r = size * (below(2) ? 1 : 0.5 + random_unit(&stream));
    const double r1 = below(4) ? r * 2 * random_unit(&stream) : 0;
    const cylint_ends ends = all[below(4)];
    double p[3], q[3], w[3], a[3], b[3], h[3];
    any_vector(p, below(3) ? size : size * power(below(20)));
    any_vector(w, size * thin);
    any_semi_axes(a, b, h, size);
    for (int j = 0; j < 3; j++)
        q[j] = p[j] + w[j];
    switch (kind) {
    case CYLINT_KIND_CYLINDER:
        cylint_cylinder(s, p, q, r, ends);
        break;
    case CYLINT_KIND_CONE:
        below(2) ? cylint_cone(s, p, r, q, r1, ends)
                 : cylint_cone(s, p, r1, q, r, ends);
        break;
    case CYLINT_KIND_ACONE:
        cylint_angle_cone(s, p, w,
                          below(2) ? 90 * random_unit(&stream)
                                   : 45 * ldexp(1, -below(20)),
                          ends);
        break;
    case CYLINT_KIND_ECYLINDER:
        cylint_elliptic_cylinder(s, p, a, b, h, ends);
        break;
    case CYLINT_KIND_ECONE:
        cylint_elliptic_cone(s, p, a, b, h, r1 / size, ends);
        break;
    case CYLINT_KIND_SPHERE:
        cylint_sphere(s, p, r, CYLINT_ENDS_CAPPED);
        break;
    case CYLINT_KIND_CAPSULE:
        cylint_capsule(s, p, q, r, CYLINT_ENDS_CAPPED);
        break;
    default:
        cylint_round_cone(s, p, r, q, r1, CYLINT_ENDS_CAPPED);
    }
    return cylint_prepared(s) != CYLINT_SOLID_NONE;
}

/* --------------------------------------------------------------- lines -- */

/* A point near the surface, the direction from the axis to it, and its distance
 * from the axis. */
static double any_place(const cylint_shape *s, double p[3], double out[3])
{
    const int solid = cylint_prepared(s);
    const double turn = 6.283185307179586 * random_unit(&stream);
    const double z = random_unit(&stream), x = cos(turn), y = sin(turn);
    const double in = below(3) ? 1 : below(4) ? random_unit(&stream) : 0;
    const double end = below(4) ? z : below(2);
    double from[3] = {0, 0, 0}, to[3] = {0, 0, 0}, r = cylint_r0(s);
    if (cylint_solid_is_ball(solid)) {
        any_vector(out, 1);
    } else {
        for (int j = 0; j < 3; j++) {
            from[j] = cylint_is_elliptic(s->kind) ? cylint_a(s)[j]
                                                  : cylint_column(s, j)[0];
            to[j] = cylint_is_elliptic(s->kind) ? cylint_b(s)[j]
                                                : cylint_column(s, j)[1];
            out[j] = x * from[j] + y * to[j];
        }
    }
    if (cylint_solid_is_tapered(solid))
        r = (1 - end) * r + end * cylint_r1(s);
    if (cylint_has_tangent(s->kind))
        r *= dot3(cylint_axis(s), cylint_axis(s));
    for (int j = 0; j < 3; j++) {
        p[j] = cylint_base(s)[j] + in * r * out[j];
        if (!cylint_solid_is_ball(solid))
            p[j] += end * cylint_axis(s)[j];
        if (cylint_solid_is_round(solid) && below(2))
            p[j] += r * unit();
    }
    return in * r * sqrt(dot3(out, out));
}

static void any_line(cylint_line *line, const cylint_shape *s)
{
    double p[3], out[3], d[3], o[3], other[3];
    const double r = any_place(s, p, out);
    const double size = r > 0 ? r : cylint_axis_size(s);
    any_vector(d, 1);
    if (below(3) == 0) { /* grazing */
        any_vector(other, 1);
        cross3(d, out, other);
        add_to(d, ldexp(unit(), -below(50)), out);
    }
    if (below(8) == 0)
        memcpy(d, cylint_axis(s), sizeof d);
    if (dot3(d, d) == 0)
        any_vector(d, 1);
    const double length = sqrt(dot3(d, d));
    const double back = below(6)   ? size * ldexp(unit(), 6 - below(12))
                        : below(2) ? size * ldexp(unit(), below(27))
                                   : 0;
    for (int j = 0; j < 3; j++)
        o[j] = p[j] - back / length * d[j];
    if (below(4) == 0) {
        for (int j = 0; j < 3; j++)
            p[j] += size * unit();
        cylint_segment(line, o, p);
    } else {
        for (int j = 0; j < 3; j++)
            d[j] *= below(2) ? 1 : 1 / length;
        cylint_whole_line(line, o, d);
    }
}

/* --------------------------------------------------------------- truth -- */

/* Everything true, in MPFR.  Local coordinates as in local.h. */
typedef mpfr_t vector[3];
static struct {
    vector row[3], q, d, p, v; /* q: the origin from the base */
    mpfr_t height, slope, sine, cosine, r0, r1, rho, growth;
    vector at, point, normal; /* of the hit; at: local coordinates */
    mpfr_t t, radius, z, phi, turn, slope_there;
} the;
static mpfr_t a_, b_, c_, s_, x_, y_;

#define EACH_OF(j) for (int j = 0; j < 3; j++)

static void dot(mpfr_t to, vector x, vector y)
{
    mpfr_mul(s_, x[0], y[0], MPFR_RNDN);
    mpfr_fma(s_, x[1], y[1], s_, MPFR_RNDN);
    mpfr_fma(to, x[2], y[2], s_, MPFR_RNDN);
}

static void cross(vector to, vector x, vector y)
{
    EACH_OF(j)
    {
        const int k = (j + 1) % 3, l = (j + 2) % 3;
        mpfr_fmms(to[j], x[k], y[l], x[l], y[k], MPFR_RNDN);
    }
}

static void divide(vector x, mpfr_t by)
{
    EACH_OF(j)
    mpfr_div(x[j], x[j], by, MPFR_RNDN);
}

static void length_of(mpfr_t to, vector x)
{
    dot(to, x, x);
    mpfr_sqrt(to, to, MPFR_RNDN);
}

static void set_sum(mpfr_t to, double x, double y)
{
    mpfr_set_d(to, x, MPFR_RNDN);
    mpfr_add_d(to, to, y, MPFR_RNDN);
}

/* The axis is the least coordinate's: local.h. */
static void set_upright_rows(const cylint_shape *s, vector axis)
{
    const int least = cylint_least_axis_component(s);
    EACH_OF(j)
    mpfr_set_d(the.normal[j], j == least, MPFR_RNDN);
    length_of(the.height, axis);
    cross(the.row[0], axis, the.normal);
    length_of(a_, the.row[0]);
    divide(the.row[0], a_);
    EACH_OF(j)
    mpfr_div(the.row[2][j], axis[j], the.height, MPFR_RNDN);
    cross(the.row[1], the.row[2], the.row[0]);
    set_sum(the.slope, cylint_r1(s), -cylint_r0(s));
    if (cylint_has_tangent(s->kind)) {
        for (int i = 0; i < 3; i++)
            divide(the.row[i], the.height);
        mpfr_set_d(the.height, 1, MPFR_RNDN);
    } else {
        mpfr_div(the.slope, the.slope, the.height, MPFR_RNDN);
    }
}

static void set_inverse_rows(const cylint_shape *s, vector axis)
{
    for (int i = 0; i < 2; i++)
        EACH_OF(j)
    mpfr_set_d(the.row[i][j], (i ? cylint_b(s) : cylint_a(s))[j], MPFR_RNDN);
    cross(the.row[2], the.row[0], the.row[1]); /* a x b */
    cross(the.normal, the.row[1], axis);       /* b x h */
    cross(the.row[1], axis, the.row[0]);       /* h x a */
    dot(a_, the.row[0], the.normal);
    EACH_OF(j)
    mpfr_swap(the.row[0][j], the.normal[j]);
    for (int i = 0; i < 3; i++)
        divide(the.row[i], a_);
    EACH_OF(j)
    mpfr_mul_d(the.row[2][j], the.row[2][j], cylint_height(s), MPFR_RNDN);
    mpfr_set_d(the.height, cylint_height(s), MPFR_RNDN); /* a power of two */
    set_sum(the.slope, cylint_r1(s), -cylint_r0(s));
    mpfr_div(the.slope, the.slope, the.height, MPFR_RNDN);
}

static void set_angle(const cylint_shape *s)
{
    mpfr_set(the.sine, the.slope, MPFR_RNDN);
    mpfr_sqr(a_, the.slope, MPFR_RNDN);
    if (s->kind == CYLINT_KIND_RCONE) {
        mpfr_ui_sub(a_, 1, a_, MPFR_RNDN);
        mpfr_sqrt(the.cosine, a_, MPFR_RNDN);
        mpfr_div(the.slope, the.sine, the.cosine, MPFR_RNDN);
    } else {
        mpfr_add_ui(a_, a_, 1, MPFR_RNDN);
        mpfr_rec_sqrt(the.cosine, a_, MPFR_RNDN);
        mpfr_mul(the.sine, the.slope, the.cosine, MPFR_RNDN);
    }
}

static void set_true_shape(const cylint_shape *s)
{
    mpfr_t *const axis = the.point;
    EACH_OF(j)
    {
        mpfr_set_d(axis[j], cylint_axis(s)[j], MPFR_RNDN);
        if (cylint_has_end_points(s->kind))
            set_sum(axis[j], cylint_top(s)[j], -cylint_base(s)[j]);
    }
    mpfr_set_d(the.r0, cylint_r0(s), MPFR_RNDN);
    mpfr_set_d(the.r1, cylint_r1(s), MPFR_RNDN);
    if (s->kind == CYLINT_KIND_SPHERE) {
        for (int i = 0; i < 3; i++)
            EACH_OF(j)
        mpfr_set_d(the.row[i][j], i == j, MPFR_RNDN);
        mpfr_set_zero(the.height, 1);
        mpfr_set_zero(the.slope, 1);
    } else if (cylint_is_elliptic(s->kind)) {
        set_inverse_rows(s, axis);
    } else {
        set_upright_rows(s, axis);
    }
    if (!cylint_is_tapered(s->kind))
        mpfr_set_zero(the.slope, 1);
    set_angle(s);
}

static void set_true_line(const cylint_shape *s, const cylint_line *line)
{
    EACH_OF(j)
    {
        set_sum(the.q[j], line->o[j], -cylint_base(s)[j]);
        set_sum(the.d[j], line->d[j], line->d_lo[j]);
    }
    for (int i = 0; i < 3; i++) {
        dot(the.p[i], the.row[i], the.q);
        dot(the.v[i], the.row[i], the.d);
    }
    mpfr_set(the.rho, the.r0, MPFR_RNDN);
    if (s->kind == CYLINT_KIND_RCONE)
        mpfr_div(the.rho, the.r0, the.cosine, MPFR_RNDN);
    mpfr_fma(the.rho, the.slope, the.p[2], the.rho, MPFR_RNDN);
    mpfr_mul(the.growth, the.slope, the.v[2], MPFR_RNDN);
}

/* A surface of the shape: the lateral one, or that of an end. */
typedef struct {
    int on_end, top, ball;
} surface;

static surface any_surface(int solid)
{
    const int ball = cylint_solid_is_ball(solid);
    surface f = {0, 0, ball};
    if (!ball && cylint_solid_is_bounded(solid) && below(2)) {
        f.on_end = 1;
        f.top = below(2);
        f.ball = cylint_solid_is_round(solid);
    }
    return f;
}

/* z from the plane or the centre of the end. */
static void above_end(mpfr_t to, mpfr_t z, const surface *f)
{
    mpfr_set(to, z, MPFR_RNDN);
    if (f->top)
        mpfr_sub(to, to, the.height, MPFR_RNDN);
}

/* A surface's last term: rho of the lateral one, z of a ball, and its growth. */
static void set_last_term(const surface *f, mpfr_t x, mpfr_t by)
{
    mpfr_set(x, the.rho, MPFR_RNDN);
    mpfr_set(by, the.growth, MPFR_RNDN);
    if (f->ball) {
        above_end(x, the.p[2], f);
        mpfr_set(by, the.v[2], MPFR_RNDN);
    }
}

static mpfr_ptr radius_of_ball(const surface *f, int solid)
{
    return f->top && cylint_solid_is_tapered(solid) ? the.r1 : the.r0;
}

/* x += or -= y z */
static void add_product(mpfr_t x, mpfr_t y, mpfr_t z, int sign)
{
    mpfr_mul(s_, y, z, MPFR_RNDN);
    (sign > 0 ? mpfr_add : mpfr_sub)(x, x, s_, MPFR_RNDN);
}

/* Sets the.t to a root; returns whether there is one. */
static int set_true_root(const surface *f, int solid, int second)
{
    const int sign = f->ball ? 1 : -1;
    if (f->on_end && !f->ball) {
        above_end(a_, the.p[2], f);
        mpfr_div(the.t, a_, the.v[2], MPFR_RNDN);
        mpfr_neg(the.t, the.t, MPFR_RNDN);
    } else {
        mpfr_fmma(a_, the.v[0], the.v[0], the.v[1], the.v[1], MPFR_RNDN);
        mpfr_fmma(b_, the.p[0], the.v[0], the.p[1], the.v[1], MPFR_RNDN);
        mpfr_fmma(c_, the.p[0], the.p[0], the.p[1], the.p[1], MPFR_RNDN);
        set_last_term(f, x_, y_);
        add_product(a_, y_, y_, sign);
        add_product(b_, x_, y_, sign);
        add_product(c_, x_, x_, sign);
        if (f->ball)
            add_product(c_, radius_of_ball(f, solid), radius_of_ball(f, solid),
                        -1);
        mpfr_fmms(s_, b_, b_, a_, c_, MPFR_RNDN);
        mpfr_sqrt(s_, s_, MPFR_RNDN); /* NaN: no root */
        if (second)
            mpfr_neg(s_, s_, MPFR_RNDN);
        mpfr_sub(s_, s_, b_, MPFR_RNDN);
        mpfr_div(the.t, s_, a_, MPFR_RNDN);
    }
    const double t = fabs(mpfr_get_d(the.t, MPFR_RNDN));
    return mpfr_zero_p(the.t) || (t < CYLINT_WINDOW && t > 1 / CYLINT_WINDOW);
}

/* from + t by */
static void set_at(mpfr_t to, mpfr_t from, mpfr_t by)
{
    mpfr_fma(to, the.t, by, from, MPFR_RNDN);
}

static void set_true_normal(const surface *f)
{
    const int plane = f->on_end && !f->ball;
    mpfr_set_d(a_, plane ? (f->top ? 1 : -1) : 0, MPFR_RNDN);
    if (f->ball) {
        above_end(a_, the.at[2], f);
    } else if (!plane) {
        mpfr_mul(a_, the.slope, the.radius, MPFR_RNDN);
        mpfr_neg(a_, a_, MPFR_RNDN);
    }
    EACH_OF(j)
    {
        mpfr_mul(the.normal[j], a_, the.row[2][j], MPFR_RNDN);
        for (int i = 0; i < 2 && !plane; i++)
            add_product(the.normal[j], the.at[i], the.row[i][j], 1);
    }
    length_of(a_, the.normal);
    divide(the.normal, a_);
}

/* x y + ...: half the slope of x^2 + ... */
static void set_true_slope(const surface *f)
{
    if (f->on_end && !f->ball) {
        mpfr_set(the.slope_there, the.v[2], MPFR_RNDN);
        return;
    }
    set_last_term(f, x_, y_);
    set_at(x_, x_, y_);
    mpfr_fmma(the.slope_there, the.at[0], the.v[0], the.at[1], the.v[1],
              MPFR_RNDN);
    add_product(the.slope_there, x_, y_, f->ball ? 1 : -1);
    mpfr_mul_2ui(the.slope_there, the.slope_there, 1, MPFR_RNDN);
}

static void set_true_hit(const cylint_shape *s, const cylint_line *line,
                         const surface *f)
{
    for (int i = 0; i < 3; i++) {
        set_at(the.at[i], the.p[i], the.v[i]);
        mpfr_set_d(the.point[i], line->o[i], MPFR_RNDN);
        set_at(the.point[i], the.point[i], the.d[i]);
    }
    set_at(the.radius, the.rho, the.growth);
    set_true_normal(f);
    set_true_slope(f);
    if (s->kind == CYLINT_KIND_SPHERE)
        return;
    mpfr_div(the.z, the.at[2], the.height, MPFR_RNDN);
    mpfr_set(x_, the.at[0], MPFR_RNDN);
    mpfr_set(y_, the.at[1], MPFR_RNDN);
    if (!cylint_is_elliptic(s->kind)) {
        mpfr_neg(x_, x_, MPFR_RNDN);
        mpfr_neg(y_, y_, MPFR_RNDN);
    }
    mpfr_atan2(the.phi, y_, x_, MPFR_RNDN);
    mpfr_div(the.phi, the.phi, the.turn, MPFR_RNDN);
    if (mpfr_sgn(the.phi) < 0)
        mpfr_add_ui(the.phi, the.phi, 1, MPFR_RNDN);
}

/* --------------------------------------------------------------- judge -- */

typedef struct {
    const char *name;
    double worst, of_pair; /* of_pair: where the root errs less than a pair */
    long n;
    int is_normal;
} number;
static int root_is_pair;

static number X = {"local x", 0, 0, 0, 0}, Y = {"local y", 0, 0, 0, 0},
              Z = {"local z", 0, 0, 0, 0}, RHO = {"rho", 0, 0, 0, 0},
              POINT = {"point", 0, 0, 0, 0},
              OF_SIDE = {"normal, lateral", 0, 0, 0, 1},
              OF_SKEW = {"normal, skew rows", 0, 0, 0, 1},
              OF_BALL = {"normal, ball", 0, 0, 0, 1},
              OF_PLANE = {"normal, plane", 0, 0, 0, 1},
              OF_SKEW_PLANE = {"normal, skew plane", 0, 0, 0, 1},
              HEIGHT = {"z", 0, 0, 0, 0}, PHI = {"phi", 0, 0, 0, 0},
              SLOPE = {"slope", 0, 0, 0, 0},
              ROOT[2] = {{"root_beside(), pairs", 0, 0, 0, 0},
                         {"root_beside(), levels", 0, 0, 0, 0}};

static const cylint_shape *shape_now;
static const cylint_line *line_now;
static const surface *surface_now;

static void print_case(const number *x, int component, double ratio)
{
    static const int at[] = {CYLINT_AT_BASE, CYLINT_AT_TOP, CYLINT_AT_AXIS,
                             CYLINT_AT_A, CYLINT_AT_B};
    const double *all = shape_now->library.number;
    REPORT("%s %d: %g; kind %d, end %d, top %d, r %a %a, frame error %g",
           x->name, component, ratio, shape_now->kind, surface_now->on_end,
           surface_now->top, cylint_r0(shape_now), cylint_r1(shape_now),
           cylint_frame_error(shape_now));
    for (int i = 0; i < 5; i++)
        REPORT("  shape: %a %a %a", all[at[i]], all[at[i] + 1], all[at[i] + 2]);
    REPORT("  o: %a %a %a", line_now->o[0], line_now->o[1], line_now->o[2]);
    REPORT("  d: %a %a %a", line_now->d[0], line_now->d[1], line_now->d[2]);
    REPORT("  d_lo: %a %a %a, t %a", line_now->d_lo[0], line_now->d_lo[1],
           line_now->d_lo[2], mpfr_get_d(the.t, MPFR_RNDN));
}

/* hi + lo against the true number, with the bound in units.  At an apex there
 * is no normal, and angles and normals are NaN, or their bounds are: then
 * nothing is certain.  Bounds of normals are of first order: a larger one makes
 * nothing certain either. */
static void judge_number(number *x, int component, double hi, double lo,
                         double bound, mpfr_t truth)
{
    const double size = fabs(hi + lo);
    if (!(bound < HUGE_VAL) || !(size < HUGE_VAL) || mpfr_nan_p(truth) ||
        (x->is_normal &&
         bound * CYLINT_MEMBER_UNIT > CYLINT_FIRST_ORDER * size))
        return;
    mpfr_sub_d(s_, truth, hi, MPFR_RNDN);
    mpfr_sub_d(s_, s_, lo, MPFR_RNDN);
    mpfr_div_d(s_, s_, CYLINT_MEMBER_UNIT, MPFR_RNDN);
    const double error = fabs(mpfr_get_d(s_, MPFR_RNDA));
    const double ratio = error == 0 ? 0 : error / bound;
    x->n++;
    x->worst = fmax(x->worst, ratio);
    if (root_is_pair)
        x->of_pair = fmax(x->of_pair, ratio);
    if (!CHECK(ratio <= 1))
        print_case(x, component, ratio);
}

static void judge_pairs(number *x, int component, const bounded_pairs *pairs,
                        mpfr_t truth)
{
    double hi[LANES], lo[LANES], e[LANES];
    v_store(hi, pairs->v.hi);
    v_store(lo, pairs->v.lo);
    v_store(e, pairs->e);
    judge_number(x, component, hi[0], lo[0], e[0], truth);
}

static number *normal_now(int solid)
{
    const int skew = cylint_has_skew_rows(shape_now->kind);
    return surface_now->ball ? &OF_BALL
           : surface_now->on_end && !cylint_solid_is_round(solid)
               ? skew ? &OF_SKEW_PLANE : &OF_PLANE
           : skew ? &OF_SKEW
                  : &OF_SIDE;
}

static void judge_slope(const local_hit *h, const pair_line *in,
                        const hit_root *r, const source *from, int solid)
{
    double slope[LANES], error[LANES];
    const slope_at_hit s =
        slope_of(h, in, r, from, load_first(from, solid).D, solid);
    v_store(slope, s.slope);
    v_store(error, v_set(1 / CYLINT_MEMBER_UNIT) * s.error);
    judge_number(&SLOPE, 0, slope[0], 0, error[0], the.slope_there);
}

static void judge_members(const source *from, const pair_line *in,
                          const hit_root *r, int solid)
{
    const int ball = cylint_solid_is_ball(solid);
    const local_hit h = hit_at(from, in, r, 1, solid);
    bounded_pairs x[3];
    judge_pairs(&X, 0, &h.x, the.at[0]);
    judge_pairs(&Y, 1, &h.y, the.at[1]);
    judge_pairs(&Z, 2, &h.z, the.at[2]);
    if (!ball)
        judge_pairs(&RHO, 0, &h.rho, the.radius);
    point_of(x, from, r);
    EACH_OF(j)
    judge_pairs(&POINT, j, &x[j], the.point[j]);
    normal_of(x, &h, from, r, solid);
    EACH_OF(j)
    judge_pairs(normal_now(solid), j, &x[j], the.normal[j]);
    judge_slope(&h, in, r, from, solid);
    if (ball)
        return;
    x[0] = height_share(&h, from);
    x[1] = angle_of(&h, from);
    judge_pairs(&HEIGHT, 0, &x[0], the.z);
    judge_pairs(&PHI, 0, &x[1], the.phi);
}

/* The true root, wrong by at most the error that it returns. */
static hit_root any_root(const surface *f)
{
    double t = mpfr_get_d(the.t, MPFR_RNDN);
    if (below(4) == 0) /* an end of step_from() */
        t = nextafter(t, below(2) ? HUGE_VAL : -HUGE_VAL);
    mpfr_sub_d(s_, the.t, t, MPFR_RNDN);
    double tail = mpfr_get_d(s_, MPFR_RNDN);
    const double error = below(4) ? ldexp(t, -54 - below(60)) : 0;
    tail += below(3) ? (below(2) ? error : -error) : error * unit();
    mpfr_sub_d(s_, s_, tail, MPFR_RNDN);
    const double most = fabs(mpfr_get_d(s_, MPFR_RNDA));
    root_is_pair = error == 0;
    return (hit_root){v_set(t), v_set(tail),
                      v_set(below(2) ? most : fmax(most, fabs(error))),
                      m_from(f->on_end ? 3 : 0), m_from(f->top ? 3 : 0)};
}

static void judge_root(const source *from, const pair_line *in,
                       const surface *f, int solid)
{
    double tail[LANES], error[LANES];
    const double t = mpfr_get_d(the.t, MPFR_RNDN);
    const int part = !f->on_end ? CYLINT_PART_LATERAL
                     : f->top   ? CYLINT_PART_CAP1
                                : CYLINT_PART_CAP0;
    for (int levels = 0; levels < 2; levels++) {
        const hit_root r = root_beside(from, in, t, part, levels, solid);
        v_store(tail, r.tail);
        v_store(error, v_set(1 / CYLINT_MEMBER_UNIT) * r.error);
        judge_number(&ROOT[levels], 0, t, tail[0], error[0], the.t);
    }
}

/* ---------------------------------------------------------------- test -- */

static int judge_line(const cylint_shape *s, const cylint_line *line)
{
    const int solid = cylint_prepared(s);
    const source from = {s, line};
    const surface f = any_surface(solid);
    if (!set_true_root(&f, solid, below(2)))
        return 0;
    set_true_hit(s, line, &f);
    shape_now = s;
    line_now = line;
    surface_now = &f;
    pair_line in;
    load_pairs(&in, &from, 1, solid);
    const hit_root r = any_root(&f);
    judge_members(&from, &in, &r, solid);
    judge_root(&from, &in, &f, solid);
    return 1;
}

static void every_number_has_its_bound(void)
{
    const uint64_t hits = check_setting("CYLINT_CASES", 1 << 17);
    for (uint64_t n = 0; n < hits;) {
        cylint_shape s;
        if (!any_shape(&s))
            continue;
        set_true_shape(&s);
        for (int i = 0; i < LINES; i++) {
            cylint_line line;
            any_line(&line, &s);
            if (!line.valid || !line.in_range)
                continue;
            set_true_line(&s, &line);
            for (int k = 0; k < ROOTS; k++)
                n += (uint64_t)judge_line(&s, &line);
        }
    }
}

static void bounds_are_not_far_above_the_errors(void)
{
    static const number *const all[] = {
        &X,       &Y,       &Z,       &RHO,      &POINT,
        &OF_SIDE, &OF_SKEW, &OF_BALL, &OF_PLANE, &OF_SKEW_PLANE,
        &HEIGHT,  &PHI,     &SLOPE,   &ROOT[0],  &ROOT[1]};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        printf(
            "note: %-18s error over its bound: %.6f, of a root in pairs %.3g; "
            "%ld\n",
            all[i]->name, all[i]->worst, all[i]->of_pair, all[i]->n);
        CHECK(all[i]->worst > 0 && all[i]->n > 0);
    }
    /* Of nearly every root that levels find, pairs find the tail. */
    CHECK(ROOT[0].n > ROOT[1].n - ROOT[1].n / 32);
}

int main(void)
{
    (void)describe_again;
    mpfr_set_default_prec(BITS);
    mpfr_ptr numbers = (mpfr_ptr)&the;
    for (size_t i = 0; i < sizeof the / sizeof *numbers; i++)
        mpfr_init(numbers + i);
    mpfr_inits(a_, b_, c_, s_, x_, y_, (mpfr_ptr)0);
    mpfr_const_pi(the.turn, MPFR_RNDN);
    mpfr_mul_2ui(the.turn, the.turn, 1, MPFR_RNDN);
    RUN(every_number_has_its_bound);
    RUN(bounds_are_not_far_above_the_errors);
    for (size_t i = 0; i < sizeof the / sizeof *numbers; i++)
        mpfr_clear(numbers + i);
    mpfr_clears(a_, b_, c_, s_, x_, y_, (mpfr_ptr)0);
    mpfr_free_cache();
    return check_end();
}

#else

#include "program.h"

int main(void)
{
    return check_skip("no MPFR: nothing to compare with (make deps)");
}

#endif
