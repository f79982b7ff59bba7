/*
 * distance_oracle_elliptic.c - the oracle of distances to elliptic kinds
 *
 * About the apex, or about the base of a cylinder, the lateral surface is
 * Y.SY = t with t = 0 or 1.  At a stationary point Y of the distance from Q,
 * (1 + m S) Y = Q for some number m.  By Cramer's rule Y = y / det with
 * polynomials y and det in m, so y.Sy - t det^2 = 0: degree 4 in m.  All real
 * zeros are isolated by those of the derivatives, with MPFR.  A rim is the same
 * in its plane.
 *
 * Where Q is on a plane of symmetry, m can be such that 1 + m S is singular.
 * So the point is moved by 2^-MOVED or less of the largest length.  The
 * distance then changes by that much.  Lengths are divided by the power of two
 * of the largest.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cylint_distance.h"
#include "distance_oracle.h"
#include "oracle.h"

#include "distance_oracle_zeros.h"
#include "shapes/layout.h"

/* -------------------------------------------------------- the surface --- */

/* to = S v */
static void apply_S(vector to, vector v)
{
    for (int i = 0; i < 3; i++)
        mpfr_set_ui(to[i], 0, RND);
    dot(e.t[0], e.gx, v);
    add(to, e.gx, e.t[0]);
    dot(e.t[0], e.gy, v);
    add(to, e.gy, e.t[0]);
    if (!e.cone)
        return;
    dot(e.t[0], e.gz, v);
    mpfr_neg(e.t[0], e.t[0], RND);
    add(to, e.gz, e.t[0]);
}

/* Q from the apex or the base; the dual vectors of a, b and the axis w. */
static void load(const cylint_shape *shape, const double point[3])
{
    static const double aside[3] = {1, -0.7, 0.3};
    const double *data[] = {point, cylint_base(shape), cylint_a(shape),
                            cylint_b(shape), cylint_axis(shape)};
    int least = 4000, most = -4000, factor = 0;
    for (int i = 0; i < 15; i++) {
        int exponent;
        frexp(data[i / 3][i % 3], &exponent);
        if (data[i / 3][i % 3] == 0)
            continue;
        most = exponent > most ? exponent : most;
        least = exponent < least ? exponent : least;
    }
    frexp(cylint_r1(shape), &factor);
    start(most - least + abs(factor));
    e.exponent = most;
    set(e.Q, point);
    set(e.base, cylint_base(shape));
    set(e.a, cylint_a(shape));
    set(e.b, cylint_b(shape));
    set(e.h, cylint_axis(shape));
    for (int i = 0; i < 3; i++)
        mpfr_sub(e.Q[i], e.Q[i], e.base[i], RND);
    vector *const lengths[] = {&e.a, &e.b, &e.h};
    norm(e.longest, e.a);
    for (int i = 1; i < 3; i++) {
        norm(e.t[0], *lengths[i]);
        mpfr_max(e.longest, e.longest, e.t[0], RND);
    }
    norm(e.scale, e.Q);
    mpfr_max(e.scale, e.scale, e.longest, RND);
    for (int i = 0; i < 3; i++) {
        mpfr_mul_d(e.t[0], e.scale, aside[i], RND);
        mpfr_div_2si(e.t[0], e.t[0], e.moved, RND);
        mpfr_add(e.Q[i], e.Q[i], e.t[0], RND);
    }
    mpfr_set_d(e.k1, cylint_r1(shape), RND);
    mpfr_sub_ui(e.k1, e.k1, 1, RND);
    e.cone = !mpfr_zero_p(e.k1);
    copy(e.w, e.h);
    if (e.cone) {
        divide(e.w, e.k1);
        for (int i = 0; i < 3; i++) {
            mpfr_add(e.Q[i], e.Q[i], e.w[i], RND);
            mpfr_sub(e.base[i], e.base[i], e.w[i], RND);
        }
    }
    cross(e.gx, e.b, e.w);
    cross(e.gy, e.w, e.a);
    cross(e.gz, e.a, e.b);
    dot(e.t[0], e.a, e.gx);
    divide(e.gx, e.t[0]);
    divide(e.gy, e.t[0]);
    divide(e.gz, e.t[0]);
}

/* Sums of products of dual vectors: trace of S, of S^2 and its determinant. */
static void load_determinant(void)
{
    mpfr_t g[3][3];
    vector *const dual[] = {&e.gx, &e.gy, &e.gz};
    const int n = e.cone ? 3 : 2, sign[3] = {1, 1, -1};
    mpfr_set_ui(e.trace, 0, RND);
    mpfr_set_ui(e.minor, 0, RND);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            mpfr_init2(g[i][j], e.bits);
            dot(g[i][j], *dual[i], *dual[j]);
        }
    for (int i = 0; i < n; i++) {
        mpfr_mul_si(e.t[0], g[i][i], sign[i], RND);
        mpfr_add(e.trace, e.trace, e.t[0], RND);
        for (int j = 0; j < i; j++) {
            mpfr_mul(e.t[0], g[i][i], g[j][j], RND);
            mpfr_mul(e.t[1], g[i][j], g[i][j], RND);
            mpfr_sub(e.t[0], e.t[0], e.t[1], RND);
            mpfr_mul_si(e.t[0], e.t[0], sign[i] * sign[j], RND);
            mpfr_add(e.minor, e.minor, e.t[0], RND);
        }
    }
    vector c;
    for (int i = 0; i < 3; i++)
        mpfr_init2(c[i], e.bits);
    cross(c, e.gy, e.gz);
    dot(e.det[3], c, e.gx);
    mpfr_sqr(e.det[3], e.det[3], RND);
    mpfr_mul_si(e.det[3], e.det[3], e.cone ? -1 : 0, RND);
    for (int i = 0; i < 3; i++) {
        mpfr_clear(c[i]);
        for (int j = 0; j < 3; j++)
            mpfr_clear(g[i][j]);
    }
    mpfr_set_ui(e.det[0], 1, RND);
    mpfr_set(e.det[1], e.trace, RND);
    mpfr_set(e.det[2], e.minor, RND);
}

/* y = Q + m (T - S) Q + m^2 (C - T S + S^2) Q */
static void load_y(void)
{
    copy(e.y[0], e.Q);
    apply_S(e.y[1], e.Q);
    apply_S(e.y[2], e.y[1]);
    mpfr_neg(e.t[1], e.trace, RND);
    add(e.y[2], e.y[1], e.t[1]);
    add(e.y[2], e.Q, e.minor);
    for (int i = 0; i < 3; i++)
        mpfr_neg(e.y[1][i], e.y[1][i], RND);
    add(e.y[1], e.Q, e.trace);
    for (int k = 0; k < 3; k++)
        apply_S(e.Sy[k], e.y[k]);
}

/* p -= det^2 */
static void subtract_det_squared(int degree)
{
    for (int i = 0; i <= degree; i++)
        for (int j = 0; j <= degree && i + j <= DEGREE; j++) {
            mpfr_mul(e.t[0], e.det[i], e.det[j], RND);
            mpfr_sub(e.p[i + j], e.p[i + j], e.t[0], RND);
        }
}

static void lateral_polynomial(void)
{
    load_determinant();
    load_y();
    for (int i = 0; i <= DEGREE; i++)
        mpfr_set_ui(e.p[i], 0, RND);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            dot(e.t[0], e.y[i], e.Sy[j]);
            mpfr_add(e.p[i + j], e.p[i + j], e.t[0], RND);
        }
    if (!e.cone) { /* degree 2: S y[2] = 0 */
        mpfr_set_ui(e.p[3], 0, RND);
        mpfr_set_ui(e.p[4], 0, RND);
        subtract_det_squared(2);
    }
}

/* ---------------------------------------------------------- candidates -- */

/* e.R is the residual, e.N the normal but for its length. */
static void offer_by_feature(struct oracle_closest *expected, int feature)
{
    norm(e.size, e.R);
    const double size = length(e.size);
    if (size < expected->by_feature[feature]) {
        expected->by_feature[feature] = size;
        copy(e.normals[feature], e.N);
    }
}

static void offer(struct oracle_closest *expected, int part, int feature)
{
    offer_by_feature(expected, feature);
    if (expected->part >= 0) {
        const int same = feature == expected->feature && !e.cone;
        const long equal = mpfr_get_exp(e.scale) - e.moved + 20;
        const long tie = mpfr_get_exp(same ? e.longest : e.scale) - 113;
        mpfr_sub(e.t[0], e.best, e.size, RND);
        const int sign = mpfr_sgn(e.t[0]);
        const long off = sign == 0 ? equal : mpfr_get_exp(e.t[0]);
        if (off < tie)
            expected->is_tie = 1;
        if (sign <= 0 || off < equal)
            return;
        if (off >= tie)
            expected->is_tie = 0;
    }
    expected->is_tie |= e.has_twin;
    expected->part = part;
    expected->feature = feature;
    mpfr_set(e.best, e.size, RND);
    for (int i = 0; i < 3; i++)
        mpfr_sub(e.foot[i], e.Q[i], e.R[i], RND);
    copy(e.normal, e.N);
    norm(e.t[0], e.normal);
    divide(e.normal, e.t[0]);
}

/* rho and z of Y. */
static void place(void)
{
    dot(e.z, e.gz, e.Y);
    mpfr_set_ui(e.rho, 1, RND);
    if (e.cone) {
        mpfr_set(e.rho, e.z, RND);
        mpfr_sub_ui(e.z, e.z, 1, RND);
        mpfr_div(e.z, e.z, e.k1, RND);
    }
}

/* Whether z is beyond an end by less than 2^-100: on a rim, but for roundings. */
static int is_next_to_end(void)
{
    mpfr_set(e.t[0], e.z, RND);
    if (mpfr_sgn(e.z) > 0)
        mpfr_sub_ui(e.t[0], e.z, 1, RND);
    return mpfr_zero_p(e.t[0]) || mpfr_get_exp(e.t[0]) < -100;
}

static void try_lateral(const cylint_shape *shape,
                        struct oracle_closest *expected, mpfr_t m, int nappe)
{
    for (int i = 0; i < 3; i++) {
        mpfr_fma(e.Y[i], e.y[2][i], m, e.y[1][i], RND);
        mpfr_fma(e.Y[i], e.Y[i], m, e.y[0][i], RND);
    }
    mpfr_set(e.t[0], e.det[3], RND);
    for (int i = 2; i >= 0; i--)
        mpfr_fma(e.t[0], e.t[0], m, e.det[i], RND);
    if (mpfr_zero_p(e.t[0]))
        return;
    divide(e.Y, e.t[0]);
    place();
    if (mpfr_sgn(e.rho) != nappe)
        return;
    for (int i = 0; i < 3; i++)
        mpfr_sub(e.R[i], e.Q[i], e.Y[i], RND);
    apply_S(e.N, e.Y);
    if (shape->ends < CYLINT_ENDS_INFINITE &&
        !(mpfr_sgn(e.z) > 0 && mpfr_cmp_ui(e.z, 1) < 0)) {
        if (is_next_to_end())
            offer_by_feature(expected, CYLINT_FEATURE_LATERAL);
        return;
    }
    offer(expected, CYLINT_PART_LATERAL, CYLINT_FEATURE_LATERAL);
}

static void lateral(const cylint_shape *shape, struct oracle_closest *expected)
{
    lateral_polynomial();
    const int n = real_zeros();
    for (int i = 0; i < n; i++)
        try_lateral(shape, expected, e.root[i], 1);
    for (int i = 0; i < n && shape->ends == CYLINT_ENDS_INFINITE; i++)
        try_lateral(shape, expected, e.root[i], -1);
}

static void apex(const cylint_shape *shape, struct oracle_closest *expected)
{
    const int grows = mpfr_sgn(e.k1) > 0;
    const int is_double = shape->ends == CYLINT_ENDS_INFINITE;
    copy(e.R, e.Q);
    copy(e.N, e.h);
    for (int i = 0; i < 3; i++) /* away from the solid; towards the base */
        mpfr_mul_si(e.N[i], e.N[i], grows == is_double ? 1 : -1, RND);
    offer(expected, CYLINT_PART_LATERAL, CYLINT_FEATURE_APEX);
}

/* An orthonormal system with the third vector perpendicular to the rim's
 * plane; the coordinates of a and b and of E, the point from the centre. */
static void load_plane(int end)
{
    copy(e.E, e.Q);
    if (e.cone) {
        mpfr_set_si(e.t[0], -1, RND);
        add(e.E, e.w, e.t[0]);
    }
    if (end) {
        mpfr_set_si(e.t[0], -1, RND);
        add(e.E, e.h, e.t[0]);
    }
    copy(e.plane[0], e.a);
    cross(e.plane[2], e.a, e.b);
    cross(e.plane[1], e.plane[2], e.a);
    for (int k = 0; k < 3; k++) {
        norm(e.t[0], e.plane[k]);
        divide(e.plane[k], e.t[0]);
    }
    for (int k = 0; k < 2; k++) {
        dot(e.in[k][0], e.plane[k], e.a);
        dot(e.in[k][1], e.plane[k], e.b);
        dot(e.flat[k], e.plane[k], e.E);
    }
}

/* S2 = s00, s01, s11 with v.S2 v = 1 on the rim of the factor. */
static void load_S2(mpfr_t factor)
{
    /* the matrix in = [p r; 0 q], its inverse [1/p -r/(pq); 0 1/q] */
    mpfr_ptr p = e.t[0], q = e.t[1], r = e.t[2];
    mpfr_ui_div(p, 1, e.in[0][0], RND);
    mpfr_ui_div(q, 1, e.in[1][1], RND);
    mpfr_mul(r, e.in[0][1], p, RND);
    mpfr_mul(r, r, q, RND);
    mpfr_neg(r, r, RND);
    mpfr_mul(e.S2[0], p, p, RND);
    mpfr_mul(e.S2[1], p, r, RND);
    mpfr_mul(e.S2[2], r, r, RND);
    mpfr_fma(e.S2[2], q, q, e.S2[2], RND);
    for (int i = 0; i < 3; i++) {
        mpfr_div(e.S2[i], e.S2[i], factor, RND);
        mpfr_div(e.S2[i], e.S2[i], factor, RND);
    }
}

/* v.S2 v */
static void form2(mpfr_t to, mpfr_t x, mpfr_t y, mpfr_t u, mpfr_t v)
{
    mpfr_mul(e.t[10], x, u, RND);
    mpfr_mul(to, e.t[10], e.S2[0], RND);
    mpfr_mul(e.t[10], y, v, RND);
    mpfr_fma(to, e.t[10], e.S2[2], to, RND);
    mpfr_mul(e.t[10], x, v, RND);
    mpfr_fma(e.t[10], y, u, e.t[10], RND);
    mpfr_fma(to, e.t[10], e.S2[1], to, RND);
}

/* y = flat + m (T - S2) flat, in y[0][0..1] and y[1][0..1] */
static void rim_polynomial(void)
{
    mpfr_add(e.det[1], e.S2[0], e.S2[2], RND);
    mpfr_mul(e.det[2], e.S2[0], e.S2[2], RND);
    mpfr_mul(e.t[0], e.S2[1], e.S2[1], RND);
    mpfr_sub(e.det[2], e.det[2], e.t[0], RND);
    mpfr_set_ui(e.det[0], 1, RND);
    for (int k = 0; k < 2; k++) {
        mpfr_set(e.y[0][k], e.flat[k], RND);
        mpfr_mul(e.t[0], e.S2[2 - 2 * k], e.flat[k], RND);
        mpfr_mul(e.t[1], e.S2[1], e.flat[1 - k], RND);
        mpfr_sub(e.y[1][k], e.t[0], e.t[1], RND);
    }
    for (int i = 0; i <= DEGREE; i++)
        mpfr_set_ui(e.p[i], 0, RND);
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2; j++) {
            form2(e.t[0], e.y[i][0], e.y[i][1], e.y[j][0], e.y[j][1]);
            mpfr_add(e.p[i + j], e.p[i + j], e.t[0], RND);
        }
    subtract_det_squared(2);
}

/* At the nearest point of the rim 1 + m S2 is positive semidefinite: m is at least
 * -1 / s, s the larger eigenvalue of S2, 2 s = T + sqrt(T^2 - 4 det).  There
 * p / det^2 falls from +infinity to -1.  m is larger by at least 2^-moved / s,
 * because the point is moved. */
static int nearest_of_rim(void)
{
    mpfr_ptr low = e.t[6];
    mpfr_sqr(e.t[0], e.det[1], RND);
    mpfr_mul_2ui(e.t[1], e.det[2], 2, RND);
    mpfr_sub(e.t[0], e.t[0], e.t[1], RND);
    mpfr_set_ui(e.t[1], 0, RND);
    mpfr_max(e.t[0], e.t[0], e.t[1], RND);
    mpfr_sqrt(e.t[0], e.t[0], RND);
    mpfr_add(e.t[0], e.t[0], e.det[1], RND);
    mpfr_si_div(low, -2, e.t[0], RND);
    mpfr_div_2si(e.t[0], low, e.moved + 50, RND);
    mpfr_sub(low, low, e.t[0], RND);
    if (!zero_above(low))
        return real_zeros();
    mpfr_sub(e.t[0], e.root[0], low, RND);
    e.has_twin = is_tiny(e.t[0], low, 110);
    return 1;
}

static void try_rim(struct oracle_closest *expected, mpfr_t m, int end)
{
    mpfr_fma(e.t[0], e.det[2], m, e.det[1], RND);
    mpfr_fma(e.t[0], e.t[0], m, e.det[0], RND);
    if (mpfr_zero_p(e.t[0]))
        return;
    copy(e.R, e.E);
    for (int k = 0; k < 2; k++) {
        mpfr_fma(e.t[1], e.y[1][k], m, e.y[0][k], RND);
        mpfr_div(e.t[1], e.t[1], e.t[0], RND);
        mpfr_neg(e.t[1], e.t[1], RND);
        add(e.R, e.plane[k], e.t[1]);
    }
    for (int i = 0; i < 3; i++)
        mpfr_sub(e.Y[i], e.Q[i], e.R[i], RND);
    apply_S(e.N, e.Y);
    offer(expected, CYLINT_PART_LATERAL,
          end ? CYLINT_FEATURE_RIM1 : CYLINT_FEATURE_RIM0);
}

static void cap(struct oracle_closest *expected, int end)
{
    const int feature = end ? CYLINT_FEATURE_CAP1 : CYLINT_FEATURE_CAP0;
    dot(e.t[0], e.plane[2], e.h);
    copy(e.N, e.plane[2]);
    for (int i = 0; i < 3; i++)
        mpfr_mul_si(e.N[i], e.N[i], (mpfr_sgn(e.t[0]) > 0) == end ? 1 : -1,
                    RND);
    copy(e.normals[feature], e.N);
    form2(e.t[0], e.flat[0], e.flat[1], e.flat[0], e.flat[1]);
    if (mpfr_cmp_ui(e.t[0], 1) >= 0)
        return;
    dot(e.t[0], e.plane[2], e.E);
    for (int i = 0; i < 3; i++)
        mpfr_mul(e.R[i], e.plane[2][i], e.t[0], RND);
    offer(expected, end ? CYLINT_PART_CAP1 : CYLINT_PART_CAP0, feature);
}

static void ends(const cylint_shape *shape, struct oracle_closest *expected)
{
    for (int end = 0; end < 2; end++) {
        const int is_cap =
            shape->ends == CYLINT_ENDS_CAPPED ||
            shape->ends == (end ? CYLINT_ENDS_CAP1 : CYLINT_ENDS_CAP0);
        mpfr_set_d(e.z, end ? cylint_r1(shape) : 1, RND);
        if (mpfr_zero_p(e.z)) {
            apex(shape, expected);
            continue;
        }
        load_plane(end);
        load_S2(e.z);
        rim_polynomial();
        for (int i = 0, n = nearest_of_rim(); i < n; i++)
            try_rim(expected, e.root[i], end);
        e.has_twin = 0;
        if (is_cap)
            cap(expected, end);
    }
}

/* ---------------------------------------------------------- the answer -- */

/* The feature of a point that contains() says is on the boundary of the solid,
 * by exact signs; -1: `ends` leaves out that part. */
static int feature_on_surface(const cylint_shape *shape)
{
    const struct oracle_place on = oracle_place();
    const int bounded = shape->ends < CYLINT_ENDS_INFINITE, ends = shape->ends;
    const int base = bounded && on.base, top = bounded && on.top;
    const int cap0 = ends == CYLINT_ENDS_CAPPED || ends == CYLINT_ENDS_CAP0;
    const int cap1 = ends == CYLINT_ENDS_CAPPED || ends == CYLINT_ENDS_CAP1;
    if (on.lateral)
        return e.cone && on.apex ? CYLINT_FEATURE_APEX
               : base            ? CYLINT_FEATURE_RIM0
               : top             ? CYLINT_FEATURE_RIM1
                                 : CYLINT_FEATURE_LATERAL;
    return base && cap0  ? CYLINT_FEATURE_CAP0
           : top && cap1 ? CYLINT_FEATURE_CAP1
                         : -1;
}

/* The normal of the moved point's foot.  If that is beyond a rim, it is the
 * rim's. */
static void choose_on_surface(struct oracle_closest *expected, int feature)
{
    const double *by = expected->by_feature;
    expected->feature = feature;
    expected->part = feature == CYLINT_FEATURE_CAP0   ? CYLINT_PART_CAP0
                     : feature == CYLINT_FEATURE_CAP1 ? CYLINT_PART_CAP1
                                                      : CYLINT_PART_LATERAL;
    if (feature == CYLINT_FEATURE_LATERAL)
        for (int rim = CYLINT_FEATURE_RIM0; rim <= CYLINT_FEATURE_RIM1; rim++)
            feature = by[rim] < by[feature] ? rim : feature;
    copy(e.normal, e.normals[feature]);
    norm(e.t[0], e.normal);
    divide(e.normal, e.t[0]);
}

static void write(struct oracle_closest *expected, const double point[3],
                  int is_on)
{
    for (int i = 0; i < 3; i++) {
        mpfr_add(e.t[0], e.foot[i], e.base[i], RND);
        const int is_zero =
            mpfr_zero_p(e.t[0]) ||
            mpfr_get_exp(e.t[0]) < mpfr_get_exp(e.scale) - e.moved / 2;
        expected->point[i] = is_on     ? point[i] + 0.0
                             : is_zero ? 0
                                       : length(e.t[0]) + 0.0;
        const double n = mpfr_get_d(e.normal[i], RND);
        expected->normal[i] = fabs(n) < 0x1p-120 ? 0 : n;
    }
}

void oracle_elliptic_distance(const cylint_shape *shape, const double point[3],
                              struct oracle_closest *expected, mpfr_t size)
{
    const int side = oracle_contains(shape, point);
    load(shape, point);
    expected->part = -1;
    for (int i = 0; i <= CYLINT_FEATURE_APEX; i++)
        expected->by_feature[i] = HUGE_VAL;
    lateral(shape, expected);
    if (shape->ends < CYLINT_ENDS_INFINITE)
        ends(shape, expected);
    else if (e.cone)
        apex(shape, expected);
    const int on = side == 0 ? feature_on_surface(shape) : -1;
    const int is_on = on >= 0;
    if (is_on)
        choose_on_surface(expected, on);
    write(expected, point, is_on);
    mpfr_set_prec(size, e.bits);
    mpfr_set(size, e.best, RND);
    if (is_on)
        mpfr_set_ui(size, 0, RND);
    else if (side > 0 && (shape->ends == CYLINT_ENDS_CAPPED ||
                          shape->ends >= CYLINT_ENDS_INFINITE))
        mpfr_neg(size, size, RND);
    expected->too_near =
        !is_on && (mpfr_zero_p(size) ||
                   mpfr_get_exp(size) < mpfr_get_exp(e.scale) - (e.moved - 64));
    mpfr_mul_2si(size, size, e.exponent, RND);
    expected->length = length(e.scale);
    expected->distance = mpfr_get_d(size, RND);
}
