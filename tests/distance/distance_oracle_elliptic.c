/*
 * distance_oracle_elliptic.c - the oracle of distances to elliptic kinds
 *
 * About the apex, or about the base of a cylinder, the lateral surface is
 * Y.SY = t with t = 0 or 1.  At a stationary point Y of the distance from Q,
 * (1 + m S) Y = Q for some number m.  By Cramer's rule Y = y / det with
 * polynomials y and det in m, so y.Sy - t det^2 = 0: degree 4 in m.  All real
 * zeros are isolated by those of the derivatives, with MPFR.  A rim is the same
 * of the upright cylinder through it, and of the point's foot in its plane.
 *
 * Where Q is on a plane of symmetry, m can be such that 1 + m S is singular.
 * So the point is moved by 2^-MOVED or less of the largest length.  The
 * distance then changes by that much.  Lengths are divided by the power of two
 * of the largest.
 */
#include <math.h>
#include <stdlib.h>

#include "cylint_distance.h"
#include "distance_oracle.h"
#include "oracle.h"

#include "distance_oracle_zeros.h"
#include "shapes/layout.h"

enum { BITS = 1600, MOVED = 240 };

/* The surface Y.SY = t and the point Q, from one origin. */
typedef struct {
    int cone;
    vector Q, gx, gy, gz; /* dual vectors of a, b and the axis */
    vector y[3];          /* y = y[0] + y[1] m + y[2] m^2 */
    real det[4];
} surface;

static struct {
    long moved;
    long exponent; /* lengths are divided by 2^exponent */
    surface side, rim;
    vector a, b, h, w, base, foot, normal, normals[6];
    vector E, across; /* of a rim: the point from its centre; a unit normal */
    real k1, scale, longest, best;
} e;

/* -------------------------------------------------------- the surface --- */

static void set_scaled(vector to, const double from[3])
{
    set(to, from);
    scale(to, power_of_two(-e.exponent), to);
}

/* x in the caller's unit of length, rounded. */
static double length(real x)
{
    return mpfr_get_d(times(x, power_of_two(e.exponent))->x, RND);
}

static real larger(real x, real y)
{
    return compare(x, y) > 0 ? x : y;
}

/* to = S v */
static void apply_S(vector to, surface *of, vector v)
{
    vector sum = {real_of(0), real_of(0), real_of(0)};
    add_scaled(sum, dot(of->gx, v), of->gx);
    add_scaled(sum, dot(of->gy, v), of->gy);
    if (of->cone)
        add_scaled(sum, negated(dot(of->gz, v)), of->gz);
    memcpy(to, sum, sizeof sum);
}

/* Starts with the bits that the data need.  Sets exponent and moved. */
static void start(const cylint_shape *shape, const double point[3])
{
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
    const long range = most - least + abs(factor);
    e.exponent = most;
    e.moved = MOVED + 4 * range;
    real_fixed(BITS + 16 * range);
}

static void load_dual(surface *of, vector a, vector b, vector w)
{
    cross(of->gx, b, w);
    cross(of->gy, w, a);
    cross(of->gz, a, b);
    const real det = dot(a, of->gx);
    divide(of->gx, of->gx, det);
    divide(of->gy, of->gy, det);
    divide(of->gz, of->gz, det);
}

/* The lateral surface; Q from the apex or the base. */
static void load(const cylint_shape *shape, const double point[3])
{
    static const double aside[3] = {1, -0.7, 0.3};
    start(shape, point);
    set_scaled(e.side.Q, point);
    set_scaled(e.base, cylint_base(shape));
    set_scaled(e.a, cylint_a(shape));
    set_scaled(e.b, cylint_b(shape));
    set_scaled(e.h, cylint_axis(shape));
    subtract(e.side.Q, e.side.Q, e.base);
    e.longest = larger(larger(norm(e.a), norm(e.b)), norm(e.h));
    e.scale = larger(norm(e.side.Q), e.longest);
    vector direction;
    set(direction, aside);
    add_scaled(e.side.Q, times(e.scale, power_of_two(-e.moved)), direction);
    e.k1 = minus(real_of(cylint_r1(shape)), real_of(1));
    e.side.cone = sgn(e.k1) != 0;
    memcpy(e.w, e.h, sizeof e.w);
    if (e.side.cone) {
        divide(e.w, e.w, e.k1);
        add_scaled(e.side.Q, real_of(1), e.w);
        subtract(e.base, e.base, e.w);
    }
    load_dual(&e.side, e.a, e.b, e.w);
}

/* det: 1, the trace of S, that of S^2, and the determinant, by products of dual
 * vectors. */
static void load_determinant(surface *of)
{
    vector *const dual[] = {&of->gx, &of->gy, &of->gz}, c;
    real *const trace = &of->det[1], *const minor = &of->det[2];
    const int n = of->cone ? 3 : 2, sign[3] = {1, 1, -1};
    of->det[0] = real_of(1);
    *trace = *minor = real_of(0);
    for (int i = 0; i < n; i++) {
        const real ii = dot(*dual[i], *dual[i]);
        *trace = plus(*trace, times(real_of(sign[i]), ii));
        for (int j = 0; j < i; j++) {
            const real square = minus(times(ii, dot(*dual[j], *dual[j])),
                                      square_of(dot(*dual[i], *dual[j])));
            *minor = plus(*minor, times(real_of(sign[i] * sign[j]), square));
        }
    }
    cross(c, of->gy, of->gz);
    of->det[3] = times(real_of(of->cone ? -1 : 0), square_of(dot(c, of->gx)));
}

/* y = Q + m (T - S) Q + m^2 (C - T S + S^2) Q */
static void load_y(surface *of)
{
    vector SQ;
    apply_S(SQ, of, of->Q);
    apply_S(of->y[2], of, SQ);
    memcpy(of->y[0], of->Q, sizeof of->Q);
    scale(of->y[1], of->det[1], of->Q);
    subtract(of->y[1], of->y[1], SQ);
    add_scaled(of->y[2], negated(of->det[1]), SQ);
    add_scaled(of->y[2], of->det[2], of->Q);
}

/* p = y.Sy - t det^2 */
static void load_polynomial(surface *of, polynomial p)
{
    const int terms = of->cone ? 3 : 2; /* of a cylinder: S y[2] = 0 */
    load_determinant(of);
    load_y(of);
    for (int i = 0; i <= MOST_DEGREE; i++)
        p[i] = real_of(0);
    for (int j = 0; j < terms; j++) {
        vector Sy;
        apply_S(Sy, of, of->y[j]);
        for (int i = 0; i < 3 && i + j < 2 * terms - 1; i++)
            p[i + j] = plus(p[i + j], dot(of->y[i], Sy));
    }
    for (int i = 0; i <= 2 && !of->cone; i++)
        for (int j = 0; j <= 2; j++)
            p[i + j] = minus(p[i + j], times(of->det[i], of->det[j]));
}

/* Y = y / det at a zero m.  Returns 0 where det can be 0: a zero of a circular
 * section can be no stationary point. */
static int load_stationary(surface *of, real m, vector Y)
{
    real slope, det = value_of(of->det, 3, m, &slope);
    memcpy(Y, of->y[1], sizeof(vector));
    add_scaled(Y, m, of->y[2]);
    scale(Y, m, Y);
    add_scaled(Y, real_of(1), of->y[0]);
    divide(Y, Y, det);
    return mpfr_regular_p(det->x) &&
           (det->off == EXACT || mpfr_get_exp(det->x) > det->off + 100);
}

/* ---------------------------------------------------------- candidates -- */

/* R is the residual, N the normal but for its length. */
static void offer_by_feature(struct oracle_closest *expected, int feature,
                             vector R, vector N)
{
    const double size = length(norm(R));
    if (size < expected->by_feature[feature]) {
        expected->by_feature[feature] = size;
        memcpy(e.normals[feature], N, sizeof(vector));
    }
}

static void offer(struct oracle_closest *expected, int part, int feature,
                  vector R, vector N)
{
    const real size = norm(R);
    offer_by_feature(expected, feature, R, N);
    if (expected->part >= 0) {
        const int same = feature == expected->feature && !e.side.cone;
        const long equal = mpfr_get_exp(e.scale->x) - e.moved + 20;
        const long tie = mpfr_get_exp((same ? e.longest : e.scale)->x) - 113;
        const real nearer = minus(e.best, size);
        const long off = sgn(nearer) == 0 ? equal : mpfr_get_exp(nearer->x);
        if (off < tie)
            expected->is_tie = 1;
        if (sgn(nearer) <= 0 || off < equal)
            return;
        if (off >= tie)
            expected->is_tie = 0;
    }
    expected->part = part;
    expected->feature = feature;
    e.best = size;
    subtract(e.foot, e.side.Q, R);
    divide(e.normal, N, norm(N));
}

/* Whether z is beyond an end by less than 2^-100: on a rim, but for roundings. */
static int is_next_to_end(real z)
{
    const real off = sgn(z) > 0 ? minus(z, real_of(1)) : z;
    return sgn(off) == 0 || mpfr_get_exp(off->x) < -100;
}

static void try_lateral(const cylint_shape *shape,
                        struct oracle_closest *expected, real m, int nappe)
{
    const real one = real_of(1);
    vector Y, R, N;
    if (!load_stationary(&e.side, m, Y))
        return;
    real rho = one, z = dot(e.side.gz, Y);
    if (e.side.cone) {
        rho = z;
        z = over(minus(z, one), e.k1);
    }
    if (sgn(rho) != nappe)
        return;
    subtract(R, e.side.Q, Y);
    apply_S(N, &e.side, Y);
    if (shape->ends < CYLINT_ENDS_INFINITE &&
        !(sgn(z) > 0 && compare(z, one) < 0)) {
        if (is_next_to_end(z))
            offer_by_feature(expected, CYLINT_FEATURE_LATERAL, R, N);
        return;
    }
    offer(expected, CYLINT_PART_LATERAL, CYLINT_FEATURE_LATERAL, R, N);
}

static void lateral(const cylint_shape *shape, struct oracle_closest *expected)
{
    polynomial p;
    real zero[MOST_ZEROS];
    load_polynomial(&e.side, p);
    const int n = real_zeros(p, zero);
    for (int i = 0; i < n; i++)
        try_lateral(shape, expected, zero[i], 1);
    for (int i = 0; i < n && shape->ends == CYLINT_ENDS_INFINITE; i++)
        try_lateral(shape, expected, zero[i], -1);
}

static void apex(const cylint_shape *shape, struct oracle_closest *expected)
{
    const int grows = sgn(e.k1) > 0;
    const int is_double = shape->ends == CYLINT_ENDS_INFINITE;
    vector N; /* away from the solid; towards the base */
    scale(N, real_of(grows == is_double ? 1 : -1), e.h);
    offer(expected, CYLINT_PART_LATERAL, CYLINT_FEATURE_APEX, e.side.Q, N);
}

/* The upright cylinder through a rim with this factor, and the point's foot. */
static void load_rim(int end, real factor)
{
    vector a, b;
    memcpy(e.E, e.side.Q, sizeof e.E);
    if (e.side.cone)
        subtract(e.E, e.E, e.w);
    if (end)
        subtract(e.E, e.E, e.h);
    scale(a, factor, e.a);
    scale(b, factor, e.b);
    cross(e.across, e.a, e.b);
    divide(e.across, e.across, norm(e.across));
    load_dual(&e.rim, a, b, e.across);
    memcpy(e.rim.Q, e.E, sizeof e.E);
    add_scaled(e.rim.Q, negated(dot(e.across, e.E)), e.across);
}

static void try_rim(struct oracle_closest *expected, real m, int end)
{
    vector R, Y, N;
    if (!load_stationary(&e.rim, m, Y))
        return;
    subtract(R, e.E, Y);
    subtract(Y, e.side.Q, R);
    apply_S(N, &e.side, Y);
    offer(expected, CYLINT_PART_LATERAL,
          end ? CYLINT_FEATURE_RIM1 : CYLINT_FEATURE_RIM0, R, N);
}

static void cap(struct oracle_closest *expected, int end)
{
    const int feature = end ? CYLINT_FEATURE_CAP1 : CYLINT_FEATURE_CAP0;
    const int upward = sgn(dot(e.across, e.h)) > 0;
    vector R, N, SQ;
    scale(N, real_of(upward == end ? 1 : -1), e.across);
    memcpy(e.normals[feature], N, sizeof N);
    apply_S(SQ, &e.rim, e.rim.Q);
    if (compare(dot(e.rim.Q, SQ), real_of(1)) >= 0)
        return;
    scale(R, dot(e.across, e.E), e.across);
    offer(expected, end ? CYLINT_PART_CAP1 : CYLINT_PART_CAP0, feature, R, N);
}

static void ends(const cylint_shape *shape, struct oracle_closest *expected)
{
    for (int end = 0; end < 2; end++) {
        const real factor = real_of(end ? cylint_r1(shape) : 1);
        polynomial p;
        real zero[MOST_ZEROS];
        if (sgn(factor) == 0) {
            apex(shape, expected);
            continue;
        }
        load_rim(end, factor);
        load_polynomial(&e.rim, p);
        for (int i = 0, n = real_zeros(p, zero); i < n; i++)
            try_rim(expected, zero[i], end);
        if (has_cap(shape, end))
            cap(expected, end);
    }
}

/* ---------------------------------------------------------- the answer -- */

/* The feature of a point that by contains() is on the boundary of the solid, by
 * exact signs; -1: `ends` leaves out that part. */
static int feature_on_surface(const cylint_shape *shape)
{
    const struct oracle_place on = oracle_place();
    const int bounded = shape->ends < CYLINT_ENDS_INFINITE;
    const int base = bounded && on.base, top = bounded && on.top;
    if (on.lateral)
        return e.side.cone && on.apex ? CYLINT_FEATURE_APEX
               : base                 ? CYLINT_FEATURE_RIM0
               : top                  ? CYLINT_FEATURE_RIM1
                                      : CYLINT_FEATURE_LATERAL;
    return base && has_cap(shape, 0)  ? CYLINT_FEATURE_CAP0
           : top && has_cap(shape, 1) ? CYLINT_FEATURE_CAP1
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
    divide(e.normal, e.normals[feature], norm(e.normals[feature]));
}

static void write(struct oracle_closest *expected, const double point[3],
                  int is_on)
{
    const long least = mpfr_get_exp(e.scale->x) - e.moved / 2;
    for (int i = 0; i < 3; i++) {
        const real x = plus(e.foot[i], e.base[i]);
        const int is_zero = sgn(x) == 0 || mpfr_get_exp(x->x) < least;
        expected->point[i] = is_on     ? point[i] + 0.0
                             : is_zero ? 0
                                       : length(x) + 0.0;
        const double n = mpfr_get_d(e.normal[i]->x, RND);
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
    else if (e.side.cone)
        apex(shape, expected);
    const int on = side == 0 ? feature_on_surface(shape) : -1;
    const int is_on = on >= 0;
    if (is_on)
        choose_on_surface(expected, on);
    write(expected, point, is_on);
    real signed_size = e.best;
    if (is_on)
        signed_size = real_of(0);
    else if (side > 0 && (shape->ends == CYLINT_ENDS_CAPPED ||
                          shape->ends >= CYLINT_ENDS_INFINITE))
        signed_size = negated(e.best);
    expected->too_near =
        !is_on && (sgn(signed_size) == 0 ||
                   mpfr_get_exp(signed_size->x) <
                       mpfr_get_exp(e.scale->x) - (e.moved - 64));
    mpfr_set_prec(size, reals.bits);
    mpfr_mul_2si(size, signed_size->x, e.exponent, RND);
    expected->length = length(e.scale);
    expected->distance = mpfr_get_d(size, RND);
}
