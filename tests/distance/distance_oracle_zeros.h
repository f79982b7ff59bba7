/*
 * distance_oracle_zeros.h - the numbers of the elliptic oracle of distances:
 * vectors, and the real zeros of a polynomial of degree 4
 *
 * Only distance_oracle_elliptic.c includes it.
 */
#ifndef CYLINT_DISTANCE_ORACLE_ZEROS_H
#define CYLINT_DISTANCE_ORACLE_ZEROS_H

#include <math.h>
#include <mpfr.h>
#include <stdlib.h>

#define RND MPFR_RNDN

enum {
    BITS = 1600,
    FEW_BITS = 128,
    MOVED = 240,
    DEGREE = 4,
    MOST_ROOTS = 12,
    MOST_STEPS = 4000
};

typedef mpfr_t vector[3];

/* Of Newton's iteration. */
struct work {
    mpfr_t x, f, slope, step, last, below, above, next, p[DEGREE + 1];
};

static struct {
    int ready, cone;
    int has_twin; /* of the candidate: another point of the rim is as far */
    long bits, moved;
    long exponent; /* lengths are divided by 2^exponent */
    vector Q, a, b, h, w, gx, gy, gz, base, Y, R, N, foot, normal, E;
    vector y[3], Sy[3]; /* y = y[0] + y[1] m + y[2] m^2 */
    mpfr_t k1, det[4], trace, minor, scale, longest, best, size, rho, z;
    mpfr_t p[DEGREE + 1], q[DEGREE][DEGREE + 1];
    mpfr_t root[MOST_ROOTS], turn[MOST_ROOTS];
    mpfr_t in[2][2], flat[2], S2[3]; /* of a rim: its plane */
    vector plane[3], normals[6];
    mpfr_t t[12];
    struct work all, few;
} e;

/* ----------------------------------------------------------- vectors ---- */

/* Gives all numbers the bits for data whose exponents differ by `range`. */
static void start(long range)
{
    mpfr_t *const first = e.Q;
    const size_t numbers =
        (sizeof e - (size_t)((char *)first - (char *)&e)) / sizeof(mpfr_t);
    const long bits = BITS + 16 * range;
    e.moved = MOVED + 4 * range;
    if (e.bits == bits)
        return;
    e.bits = bits;
    for (size_t i = 0; i < numbers; i++)
        if (e.ready)
            mpfr_set_prec(first[i], bits);
        else
            mpfr_init2(first[i], bits);
    e.ready = 1;
    mpfr_t *const few = &e.few.x;
    for (size_t i = 0; i < sizeof e.few / sizeof(mpfr_t); i++)
        mpfr_set_prec(few[i], FEW_BITS);
}

static void set(vector to, const double from[3])
{
    for (int i = 0; i < 3; i++) {
        mpfr_set_d(to[i], from[i], RND);
        mpfr_mul_2si(to[i], to[i], -e.exponent, RND);
    }
}

/* x in the caller's unit of length, rounded. */
static double length(mpfr_t x)
{
    mpfr_mul_2si(e.t[10], x, e.exponent, RND);
    return mpfr_get_d(e.t[10], RND);
}

static void dot(mpfr_t to, vector u, vector v)
{
    mpfr_mul(e.t[11], u[0], v[0], RND);
    mpfr_fma(e.t[11], u[1], v[1], e.t[11], RND);
    mpfr_fma(to, u[2], v[2], e.t[11], RND);
}

/* `to` is neither u nor v. */
static void cross(vector to, vector u, vector v)
{
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        mpfr_mul(to[i], u[j], v[k], RND);
        mpfr_mul(e.t[11], u[k], v[j], RND);
        mpfr_sub(to[i], to[i], e.t[11], RND);
    }
}

/* to += u s; s is not t[10] */
static void add(vector to, vector u, mpfr_t s)
{
    for (int i = 0; i < 3; i++)
        mpfr_fma(to[i], u[i], s, to[i], RND);
}

static void copy(vector to, vector from)
{
    for (int i = 0; i < 3; i++)
        mpfr_set(to[i], from[i], RND);
}

static void norm(mpfr_t to, vector v)
{
    dot(to, v, v);
    mpfr_sqrt(to, to, RND);
}

static void divide(vector v, mpfr_t by)
{
    for (int i = 0; i < 3; i++)
        mpfr_div(v[i], v[i], by, RND);
}

/* ---------------------------------------------------------- real zeros -- */

static void value_of(mpfr_t value, mpfr_t slope, mpfr_t *p, int degree,
                     mpfr_t at)
{
    mpfr_set(value, p[degree], RND);
    mpfr_set_ui(slope, 0, RND);
    for (int i = degree - 1; i >= 0; i--) {
        mpfr_fma(slope, slope, at, value, RND);
        mpfr_fma(value, value, at, p[i], RND);
    }
}

/* x = a number between low and high: 0 if the signs differ; the one in the middle
 * of the exponents if those differ; or the arithmetic mean. */
static void middle(mpfr_t x, mpfr_t low, mpfr_t high)
{
    const long least = -20000;
    const int sign = mpfr_sgn(low) + mpfr_sgn(high) < 0 ? -1 : 1;
    const long l = mpfr_zero_p(low) ? least : mpfr_get_exp(low);
    const long h = mpfr_zero_p(high) ? least : mpfr_get_exp(high);
    if (mpfr_sgn(low) * mpfr_sgn(high) < 0) {
        mpfr_set_ui(x, 0, RND);
    } else if (labs(l - h) > 1) {
        const long inner = l < h ? l : h;
        mpfr_set_si_2exp(x, sign, inner + labs(l - h) / 2 - 1, RND);
    } else {
        mpfr_add(x, low, high, RND);
        mpfr_div_2ui(x, x, 1, RND);
    }
}

/* |x| < 2^-digits |y| */
static int is_tiny(mpfr_t x, mpfr_t y, long digits)
{
    return mpfr_regular_p(x) && mpfr_regular_p(y) &&
           mpfr_get_exp(x) < mpfr_get_exp(y) - digits;
}

/* Improves w->x, a zero between low and high, at which the signs differ, by
 * Newton's iteration with bisection, until a step is 2^-digits of x. */
static void iterate(struct work *w, mpfr_t *p, int degree, mpfr_t low,
                    mpfr_t high, long digits)
{
    mpfr_set(w->below, low, RND);
    mpfr_set(w->above, high, RND);
    value_of(w->f, w->slope, p, degree, high);
    const int sign = mpfr_sgn(w->f);
    mpfr_sub(w->last, high, low, RND);
    if (mpfr_cmp(w->x, low) <= 0 || mpfr_cmp(w->x, high) >= 0)
        middle(w->x, low, high);
    for (int i = 0; i < MOST_STEPS + e.bits; i++) {
        value_of(w->f, w->slope, p, degree, w->x);
        if (mpfr_zero_p(w->f))
            return;
        mpfr_set(mpfr_sgn(w->f) == sign ? w->above : w->below, w->x, RND);
        mpfr_div(w->step, w->f, w->slope, RND);
        mpfr_sub(w->next, w->x, w->step, RND);
        mpfr_mul_d(w->f, w->step, 1.25, RND);
        if (is_tiny(w->step, w->x, digits)) {
            mpfr_set(w->x, w->next, RND);
            return;
        }
        if (!mpfr_number_p(w->next) || mpfr_cmpabs(w->f, w->last) > 0 ||
            mpfr_cmp(w->next, w->below) <= 0 ||
            mpfr_cmp(w->next, w->above) >= 0)
            middle(w->next, w->below, w->above);
        mpfr_sub(w->last, w->next, w->x, RND);
        mpfr_set(w->x, w->next, RND);
        if (mpfr_zero_p(w->last) || is_tiny(w->last, w->x, e.bits))
            return;
    }
}

/* x = the zero between low and high: first with few bits.  Newton's iteration
 * doubles the number of digits. */
static void zero_between(mpfr_t x, mpfr_t *p, int degree, mpfr_t low,
                         mpfr_t high)
{
    for (int i = 0; i <= degree; i++)
        mpfr_set(e.few.p[i], p[i], RND);
    mpfr_set(e.few.x, low, RND);
    iterate(&e.few, e.few.p, degree, low, high, FEW_BITS / 2);
    mpfr_set(e.all.x, e.few.x, RND);
    iterate(&e.all, p, degree, low, high, e.bits / 2);
    mpfr_set(x, e.all.x, RND);
}

/* e.root: the zeros of e.q[k], given those of its derivative in e.turn, within
 * the bound in t[9]. */
static int zeros_between_turns(mpfr_t *p, int degree, int turns)
{
    mpfr_ptr low = e.t[7], at_low = e.t[8], high = e.t[10];
    int n = 0;
    mpfr_neg(low, e.t[9], RND);
    value_of(at_low, e.t[0], p, degree, low);
    for (int i = 0; i <= turns; i++) {
        mpfr_set(high, i < turns ? e.turn[i] : e.t[9], RND);
        if (mpfr_cmp(high, low) <= 0)
            continue;
        value_of(e.t[1], e.t[0], p, degree, high);
        const int sign = mpfr_sgn(e.t[1]);
        if (mpfr_zero_p(at_low))
            mpfr_set(e.root[n++], low, RND);
        else if (sign * mpfr_sgn(at_low) < 0)
            zero_between(e.root[n++], p, degree, low, high);
        mpfr_set(low, high, RND);
        value_of(at_low, e.t[0], p, degree, low);
    }
    if (mpfr_zero_p(at_low))
        mpfr_set(e.root[n++], low, RND);
    return n;
}

/* t[9] = a number above the absolute values of the zeros of e.p.  Returns its
 * degree. */
static int bound_zeros(void)
{
    int degree = DEGREE;
    while (degree > 0 && mpfr_zero_p(e.p[degree]))
        degree--;
    mpfr_set_ui(e.t[9], 1, RND);
    for (int i = 0; i < degree; i++) {
        mpfr_div(e.t[0], e.p[i], e.p[degree], RND);
        mpfr_abs(e.t[0], e.t[0], RND);
        mpfr_add(e.t[9], e.t[9], e.t[0], RND);
    }
    return degree;
}

/* All real zeros of e.p. */
static int real_zeros(void)
{
    const int degree = bound_zeros();
    int n = 0;
    for (int i = 0; i <= degree; i++)
        mpfr_set(e.q[0][i], e.p[i], RND);
    for (int k = 1; k < degree; k++)
        for (int i = 0; i <= degree - k; i++)
            mpfr_mul_si(e.q[k][i], e.q[k - 1][i + 1], i + 1, RND);
    for (int k = degree - 1; k >= 0; k--) {
        for (int i = 0; i < n; i++)
            mpfr_set(e.turn[i], e.root[i], RND);
        n = zeros_between_turns(e.q[k], degree - k, n);
    }
    return n;
}

/* The only zero of e.p above `low`, if the sign of e.p changes there. */
static int zero_above(mpfr_t low)
{
    const int degree = bound_zeros();
    value_of(e.t[7], e.t[0], e.p, degree, low);
    value_of(e.t[8], e.t[0], e.p, degree, e.t[9]);
    if (mpfr_sgn(e.t[7]) * mpfr_sgn(e.t[8]) >= 0)
        return 0;
    zero_between(e.root[0], e.p, degree, low, e.t[9]);
    return 1;
}

#endif
