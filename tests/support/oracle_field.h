/*
 * oracle_field.h - the oracle's arithmetic: integers, and x + y sqrt(D)
 *
 * Only oracle.c includes it.  A double is an integer times a power of two, and
 * a critical parameter is (p + q sqrt(D)) / r.  This file computes their signs,
 * comparisons and roundings exactly; functions *_value round to BITS bits.
 */
#ifndef CYLINT_ORACLE_FIELD_H
#define CYLINT_ORACLE_FIELD_H

#include <assert.h>
#include <float.h>
#include <gmp.h>
#include <limits.h>
#include <math.h>
#include <mpfr.h>
#include <string.h>

#define BITS 400 /* of a real that is rounded */

typedef struct linear {
    mpz_t g0, g1; /* g0 + g1 tau */
} linear;

typedef struct critical {
    mpz_t p, r; /* (p + q sqrt(D)) / r */
    int q;
    int lateral; /* a root of F */
} critical;

enum { MOST_CRITICAL = 5, SCRATCH = 6 };

/* The numbers of one query, allocated once for all calls. */
static struct {
    int ready;
    long unit, d_unit;
    int circular; /* else elliptic */
    int bounded, nappe;
    mpz_t base[3], w[3], a[3], b[3], r0, dr, o[3], d[3];
    mpz_t q[3];                /* o - base */
    mpz_t gx[3], gy[3], gz[3]; /* elliptic: gradients of X, Y, Z */
    mpz_t whole;               /* z = Z / whole, whole > 0 */
    mpz_t alpha, beta, gamma, delta;
    linear X, Y, Z, rho;
    mpz_t A, B, C, D;
    mpfr_t root_D;
    critical at[MOST_CRITICAL];
    int count;
    mpz_t s[SCRATCH], x, y, x2, y2;
} o_;

/* ------------------------------------------------------ whole numbers -- */

static void start(void)
{
    mpz_t *const first = o_.base;
    if (o_.ready)
        return;
    for (int i = 0; i < 3; i++) {
        mpz_inits(first[i], o_.w[i], o_.a[i], o_.b[i], o_.o[i], o_.d[i],
                  o_.q[i], o_.gx[i], o_.gy[i], o_.gz[i], (mpz_ptr)NULL);
    }
    mpz_inits(o_.r0, o_.dr, o_.whole, o_.alpha, o_.beta, o_.gamma, o_.delta,
              o_.X.g0, o_.X.g1, o_.Y.g0, o_.Y.g1, o_.Z.g0, o_.Z.g1, o_.rho.g0,
              o_.rho.g1, o_.A, o_.B, o_.C, o_.D, o_.x, o_.y, o_.x2, o_.y2,
              (mpz_ptr)NULL);
    for (int i = 0; i < MOST_CRITICAL; i++)
        mpz_inits(o_.at[i].p, o_.at[i].r, (mpz_ptr)NULL);
    for (int i = 0; i < SCRATCH; i++)
        mpz_init(o_.s[i]);
    mpfr_init2(o_.root_D, BITS);
    o_.ready = 1;
}

/* x = m 2^e with m odd (0 for 0). */
static long split(double x, long *e)
{
    int exponent;
    double m = frexp(x, &exponent);
    long whole = (long)ldexp(m, 53);
    *e = exponent - 53;
    while (whole != 0 && whole % 2 == 0) {
        whole /= 2;
        ++*e;
    }
    return whole;
}

/* Lowers *unit to the last binary place of the n numbers at x. */
static void lower_unit(long *unit, const double *x, int n)
{
    for (int i = 0; i < n; i++) {
        long e;
        if (split(x[i], &e) != 0 && e < *unit)
            *unit = e;
    }
}

/* out = x / 2^unit, a whole number. */
static void whole(mpz_t out, double x, long unit)
{
    long e;
    mpz_set_si(out, split(x, &e));
    if (mpz_sgn(out) != 0) {
        assert(e >= unit);
        mpz_mul_2exp(out, out, (mp_bitcnt_t)(e - unit));
    }
}

static void whole3(mpz_t out[3], const double x[3], long unit)
{
    for (int i = 0; i < 3; i++)
        whole(out[i], x[i], unit);
}

/* out = (to - from) / 2^unit */
static void difference(mpz_t out[3], const double to[3], const double from[3],
                       long unit)
{
    for (int i = 0; i < 3; i++) {
        whole(out[i], to[i], unit);
        whole(o_.s[0], from[i], unit);
        mpz_sub(out[i], out[i], o_.s[0]);
    }
}

static void dot(mpz_t out, mpz_t u[3], mpz_t v[3])
{
    mpz_mul(out, u[0], v[0]);
    mpz_addmul(out, u[1], v[1]);
    mpz_addmul(out, u[2], v[2]);
}

/* out is neither u nor v */
static void cross(mpz_t out[3], mpz_t u[3], mpz_t v[3])
{
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        mpz_mul(out[i], u[j], v[k]);
        mpz_submul(out[i], u[k], v[j]);
    }
}

int oracle_sum_sign(const double *x, int n)
{
    long unit = LONG_MAX;
    mpz_t sum, term;
    lower_unit(&unit, x, n);
    mpz_inits(sum, term, (mpz_ptr)NULL);
    for (int i = 0; i < n; i++) {
        whole(term, x[i], unit);
        mpz_add(sum, sum, term);
    }
    const int sign = mpz_sgn(sum);
    mpz_clears(sum, term, (mpz_ptr)NULL);
    return sign;
}

/* ------------------------------------------------- the field of sqrt D -- */

/* The sign of x + y sqrt(D). */
static int surd_sign(mpz_t x, mpz_t y)
{
    const int sx = mpz_sgn(x), sy = mpz_sgn(o_.D) > 0 ? mpz_sgn(y) : 0;
    if (sx * sy >= 0)
        return sx != 0 ? sx : sy;
    mpz_mul(o_.x2, x, x);
    mpz_mul(o_.y2, y, y);
    mpz_mul(o_.y2, o_.y2, o_.D);
    const int order = mpz_cmp(o_.x2, o_.y2);
    return order == 0 ? 0 : order > 0 ? sx : sy;
}

static int compare(const critical *s, const critical *t)
{
    mpz_mul(o_.x, s->p, t->r);
    mpz_submul(o_.x, t->p, s->r);
    mpz_mul_si(o_.y, t->r, s->q);
    mpz_mul_si(o_.s[0], s->r, t->q);
    mpz_sub(o_.y, o_.y, o_.s[0]);
    return surd_sign(o_.x, o_.y);
}

/* x, y with g(tau) r = x + y sqrt(D) */
static void put_in(mpz_t x, mpz_t y, mpz_t g0, mpz_t g1, const critical *at)
{
    mpz_mul(x, g0, at->r);
    mpz_addmul(x, g1, at->p);
    mpz_mul_si(y, g1, at->q);
}

static int linear_sign(linear *g, const critical *at)
{
    put_in(o_.x, o_.y, g->g0, g->g1, at);
    return surd_sign(o_.x, o_.y);
}

/* out = x + y sqrt(D), without cancellation: where the signs differ,
 * (x^2 - y^2 D) / (x - y sqrt(D)). */
static void surd_value(mpfr_t out, mpz_srcptr x, mpz_srcptr y)
{
    const int differ = mpz_sgn(x) * mpz_sgn(y) < 0;
    mpfr_mul_z(out, o_.root_D, y, MPFR_RNDN);
    if (!differ) {
        mpfr_add_z(out, out, x, MPFR_RNDN);
        return;
    }
    mpfr_sub_z(out, out, x, MPFR_RNDN);
    mpz_mul(o_.x2, y, y);
    mpz_mul(o_.x2, o_.x2, o_.D);
    mpz_submul(o_.x2, x, x);
    if (mpz_sgn(o_.x2) == 0) {
        mpfr_set_zero(out, 1);
        return;
    }
    mpfr_t top;
    mpfr_init2(top, BITS);
    mpfr_set_z(top, o_.x2, MPFR_RNDN);
    mpfr_neg(out, out, MPFR_RNDN);
    mpfr_div(out, top, out, MPFR_RNDN);
    mpfr_neg(out, out, MPFR_RNDN);
    mpfr_clear(top);
}

static void linear_value(mpfr_t out, mpz_t g0, mpz_t g1, const critical *at)
{
    put_in(o_.x, o_.y, g0, g1, at);
    surd_value(out, o_.x, o_.y);
    mpfr_div_z(out, out, at->r, MPFR_RNDN);
}

/* The sign of (x + y sqrt(D)) / r 2^shift - m 2^e, r > 0.  Changes o_.x, o_.y. */
static int compare_to(mpz_srcptr x, mpz_srcptr y, mpz_srcptr r, long shift,
                      mpz_srcptr m, long e)
{
    mpz_set(o_.x, x);
    mpz_set(o_.y, y);
    mpz_mul(o_.s[1], m, r);
    if (shift >= e) {
        mpz_mul_2exp(o_.x, o_.x, (mp_bitcnt_t)(shift - e));
        mpz_mul_2exp(o_.y, o_.y, (mp_bitcnt_t)(shift - e));
    } else {
        mpz_mul_2exp(o_.s[1], o_.s[1], (mp_bitcnt_t)(e - shift));
    }
    mpz_sub(o_.x, o_.x, o_.s[1]);
    return surd_sign(o_.x, o_.y);
}

static int compare_to_double(const critical *at, double t)
{
    if (!isfinite(t))
        return t > 0 ? -1 : 1;
    long e;
    mpz_set_si(o_.s[2], split(t, &e));
    mpz_set_si(o_.y, at->q);
    return compare_to(at->p, o_.y, at->r, o_.unit - o_.d_unit, o_.s[2], e);
}

/* o_.s[2] 2^e = (s + next away from zero of s) / 2; returns e.  The next of the
 * largest double counts as 2^1024. */
static long load_midpoint(double s, int sign)
{
    int exponent;
    double m = ldexp(frexp(fabs(s), &exponent), 53);
    long e = exponent - 53;
    if (s == 0 || e < -1074) {
        m = s == 0 ? 0 : ldexp(fabs(s), 1074);
        e = -1074;
    }
    mpz_set_d(o_.s[2], m);
    mpz_mul_2exp(o_.s[2], o_.s[2], 1);
    mpz_add_ui(o_.s[2], o_.s[2], 1);
    if (sign < 0)
        mpz_neg(o_.s[2], o_.s[2]);
    return e - 1;
}

static int is_odd(double x)
{
    unsigned long long bits;
    memcpy(&bits, &x, sizeof bits);
    return (int)(bits & 1);
}

/* The double nearest to (x + y sqrt(D)) / r 2^shift, r > 0; ties to even, 0 is
 * never -0.  MPFR rounds the number towards zero, then the exact comparison with
 * the midpoint beyond it decides.  Changes o_.x and o_.y. */
static double nearest(mpz_srcptr x, mpz_srcptr y, mpz_srcptr r, long shift)
{
    mpfr_t value;
    mpfr_init2(value, BITS);
    surd_value(value, x, y);
    mpfr_div_z(value, value, r, MPFR_RNDN);
    mpfr_mul_2si(value, value, shift, MPFR_RNDN);
    const int sign = mpfr_sgn(value);
    const double low = mpfr_get_d(value, MPFR_RNDZ);
    mpfr_clear(value);
    if (sign == 0)
        return 0;
    const long e = load_midpoint(low, sign);
    const int beyond = sign * compare_to(x, y, r, shift, o_.s[2], e);
    const double high = nextafter(low, sign * (double)INFINITY);
    return beyond > 0 || (beyond == 0 && is_odd(low)) ? high : low + 0;
}

/* The double nearest to t. */
static double nearest_t(const critical *at)
{
    mpz_set_si(o_.y, at->q);
    return nearest(at->p, o_.y, at->r, o_.unit - o_.d_unit);
}

/* The double nearest to (g0 + g1 tau) 2^shift / unit, unit > 0. */
static double nearest_linear(mpz_t g0, mpz_t g1, mpz_t unit, long shift,
                             const critical *at)
{
    put_in(o_.x, o_.y, g0, g1, at);
    mpz_mul(o_.s[3], at->r, unit);
    return nearest(o_.x, o_.y, o_.s[3], shift);
}

#endif
