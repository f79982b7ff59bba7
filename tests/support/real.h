/*
 * real.h - the oracles' numbers: MPFR with a bound of the error
 *
 * Every operation returns a new number and a bound of its error.  MPFR reports
 * when a result is exact, so an exact 0 has the sign 0.  A number that is not
 * larger than its error has no sign yet.  The oracle then computes everything
 * again with four times as many bits.  With the last number of bits such a number
 * is 0: what the oracle computes is algebraic, of a degree that bounds how near 0
 * another number can be.
 *
 *     for (real_start(range); real_again();)
 *         compute the answer;
 */
#ifndef CYLINT_REAL_H
#define CYLINT_REAL_H

#include <assert.h>
#include <limits.h>
#include <math.h>
#include <mpfr.h>
#include <string.h>

#define RND MPFR_RNDN
#define EXACT (LONG_MIN / 4)

/* FEW_BITS: of the first try.  The last one has DEGREE times the range of the
 * exponents, and FEW_BITS more.  The worst number is F of a round cone, midway
 * between roots of the cone and of a ball.  By the norms of D (degree 12) and of
 * the difference of the roots (degree 24) it is at least 2^-(38 range) of its
 * terms. */
enum { FEW_BITS = 256, DEGREE = 40, MOST_REALS = 8192 };

typedef struct {
    mpfr_t x;
    long off; /* |error| <= 2^off */
} real_number;

typedef real_number *real;
typedef real vector[3];

static struct {
    real_number at[MOST_REALS];
    int made, used;
    long bits, last_bits;
    int is_lost; /* a sign needs more bits */
} reals;

/* ------------------------------------------------------ bits and range -- */

static inline void real_start(long range)
{
    reals.bits = 0;
    reals.last_bits = FEW_BITS + DEGREE * range;
    reals.is_lost = 1;
}

/* All numbers so far are gone; new ones have this many bits, whatever their signs
 * need. */
static inline void real_fixed(long bits)
{
    reals.bits = reals.last_bits = bits;
    reals.used = 0;
}

/* Whether to compute with more bits.  All numbers so far are gone then. */
static inline int real_again(void)
{
    if (!reals.is_lost)
        return 0;
    reals.bits = reals.bits ? 4 * reals.bits : FEW_BITS;
    if (reals.bits > reals.last_bits)
        reals.bits = reals.last_bits;
    reals.is_lost = reals.used = 0;
    return 1;
}

static inline void need_more_bits(void)
{
    reals.is_lost |= reals.bits < reals.last_bits;
}

/* The exponents of a group of numbers: of the largest, and of the last digit of
 * any. */
typedef struct {
    int least, most;
} exponents;

static inline void widen(exponents *e, const double *x, int n)
{
    for (int i = 0; i < n; i++) {
        int top;
        double m = ldexp(frexp(x[i], &top), 53), half = 0.5 * m;
        if (m == 0)
            continue;
        int last = top - 53;
        for (; half == trunc(half); half *= 0.5)
            last++;
        e->most = e->most < top ? top : e->most;
        e->least = e->least > last ? last : e->least;
    }
}

static const exponents no_exponents = {INT_MAX, INT_MIN};

static inline long range_of(exponents e)
{
    return e.most > e.least ? (long)e.most - e.least : 1;
}

/* ------------------------------------------------------------- numbers -- */

static inline real new_real(void)
{
    assert(reals.used < MOST_REALS);
    real z = &reals.at[reals.used++];
    if (reals.used > reals.made) {
        mpfr_init2(z->x, reals.bits);
        reals.made++;
    } else if (mpfr_get_prec(z->x) != reals.bits) {
        mpfr_set_prec(z->x, reals.bits);
    }
    return z;
}

/* x, while all other numbers since reals.used was `mark` go. */
static inline real real_keep(int mark, real x)
{
    real to = &reals.at[mark];
    mpfr_swap(to->x, x->x);
    to->off = x->off;
    reals.used = mark + 1;
    return to;
}

static inline real power_of_two(long e)
{
    real z = new_real();
    mpfr_set_si_2exp(z->x, 1, e, RND);
    z->off = EXACT;
    return z;
}

/* The exponent of a sum of two errors, of which 2^EXACT is 0. */
static inline long both(long a, long b)
{
    return a == EXACT ? b : b == EXACT ? a : (a > b ? a : b) + 1;
}

/* The exponent of an error times x. */
static inline long scaled(long off, real x)
{
    const long size = mpfr_zero_p(x->x) ? EXACT : mpfr_get_exp(x->x);
    return off == EXACT || both(size, x->off) == EXACT
               ? EXACT
               : off + both(size, x->off);
}

/* z, whose last rounding returned `inexact`, and whose operands' errors add up to
 * 2^off. */
static inline real with_error(real z, int inexact, long off)
{
    z->off = inexact ? both(off, mpfr_get_exp(z->x) - reals.bits) : off;
    return z;
}

static inline real real_of(double x)
{
    real z = new_real();
    return with_error(z, mpfr_set_d(z->x, x, RND), EXACT);
}

static inline int is_zero(real x)
{
    return mpfr_zero_p(x->x) && x->off == EXACT;
}

static inline real plus(real x, real y)
{
    if (is_zero(x) || is_zero(y))
        return is_zero(x) ? y : x;
    real z = new_real();
    return with_error(z, mpfr_add(z->x, x->x, y->x, RND), both(x->off, y->off));
}

static inline real minus(real x, real y)
{
    real z = new_real();
    return with_error(z, mpfr_sub(z->x, x->x, y->x, RND), both(x->off, y->off));
}

static inline real times(real x, real y)
{
    if (is_zero(x) || is_zero(y))
        return is_zero(x) ? x : y;
    real z = new_real();
    return with_error(z, mpfr_mul(z->x, x->x, y->x, RND),
                      both(scaled(x->off, y), scaled(y->off, x)));
}

static inline real negated(real x)
{
    return minus(real_of(0), x);
}

/* -1, 0 or 1 */
static inline int sign_of(real x)
{
    if (mpfr_zero_p(x->x)
            ? x->off == EXACT
            : mpfr_get_exp(x->x) > (x->off == EXACT ? x->off : x->off + 1))
        return mpfr_sgn(x->x);
    need_more_bits();
    return 0;
}

static inline int order_of(real x, real y)
{
    return sign_of(minus(x, y));
}

/* x / y; 0 if y is. */
static inline real over(real x, real y)
{
    real z = new_real();
    if (sign_of(y) == 0)
        return real_of(0);
    const int inexact = mpfr_div(z->x, x->x, y->x, RND);
    z->off = EXACT;
    const long off = both(x->off, scaled(y->off, z));
    return with_error(z, inexact,
                      off == EXACT ? EXACT : off - mpfr_get_exp(y->x) + 2);
}

/* The square root of x; 0 if x is not positive. */
static inline real root_of(real x)
{
    real z = new_real();
    if (sign_of(x) <= 0)
        return real_of(0);
    const int inexact = mpfr_sqrt(z->x, x->x, RND);
    return with_error(z, inexact,
                      x->off == EXACT ? EXACT
                                      : x->off - mpfr_get_exp(x->x) / 2 + 2);
}

static inline real square_of(real x)
{
    return times(x, x);
}

/* Needs more bits where x is not 0 and has fewer than 125. */
static inline void need_digits(real x)
{
    if (sign_of(x) != 0 && x->off != EXACT && mpfr_get_exp(x->x) < x->off + 125)
        need_more_bits();
}

/* f(x), with one rounding; an error of x is not counted. */
static inline real function_of(int f(mpfr_ptr, mpfr_srcptr, mpfr_rnd_t), real x)
{
    real z = new_real();
    return with_error(z, f(z->x, x->x, RND), EXACT);
}

static inline real real_pi(void)
{
    real z = new_real();
    return with_error(z, mpfr_const_pi(z->x, RND), EXACT);
}

/* The angle y / x in turns, in [0, 1), computed with this many bits. */
static inline real real_turns(real x, real y, long bits)
{
    real turn = real_of(0), pi = new_real();
    need_digits(x);
    need_digits(y);
    if (sign_of(x) == 0 && sign_of(y) == 0)
        return turn;
    const real sine = sign_of(y) ? y : turn, cosine = sign_of(x) ? x : turn;
    turn = new_real();
    mpfr_set_prec(turn->x, bits);
    mpfr_set_prec(pi->x, bits);
    mpfr_atan2(turn->x, sine->x, cosine->x, RND);
    mpfr_const_pi(pi->x, RND);
    mpfr_div(turn->x, turn->x, pi->x, RND);
    mpfr_div_ui(turn->x, turn->x, 2, RND);
    if (mpfr_sgn(turn->x) < 0)
        mpfr_add_ui(turn->x, turn->x, 1, RND);
    turn->off = EXACT;
    return turn;
}

/* ------------------------------------------------------------- vectors -- */

static inline real dot(vector u, vector v)
{
    return plus(plus(times(u[0], v[0]), times(u[1], v[1])), times(u[2], v[2]));
}

static inline real norm(vector v)
{
    return root_of(dot(v, v));
}

static inline void cross(vector to, vector u, vector v)
{
    vector w;
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        w[i] = minus(times(u[j], v[k]), times(u[k], v[j]));
    }
    memcpy(to, w, sizeof w);
}

/* to = s v; `to` may be v. */
static inline void scale(vector to, real s, vector v)
{
    for (int i = 0; i < 3; i++)
        to[i] = times(s, v[i]);
}

static inline void set(vector to, const double from[3])
{
    for (int i = 0; i < 3; i++)
        to[i] = real_of(from[i]);
}

/* to = u - v; `to` may be one of them. */
static inline void subtract(vector to, vector u, vector v)
{
    for (int i = 0; i < 3; i++)
        to[i] = minus(u[i], v[i]);
}

/* to += s v */
static inline void add_scaled(vector to, real s, vector v)
{
    for (int i = 0; i < 3; i++)
        to[i] = plus(to[i], times(s, v[i]));
}

/* to = end - from */
static inline void set_difference(vector to, const double end[3],
                                  const double from[3])
{
    for (int i = 0; i < 3; i++)
        to[i] = minus(real_of(end[i]), real_of(from[i]));
}

/* to = v / by; `to` may be v. */
static inline void divide(vector to, vector v, real by)
{
    for (int i = 0; i < 3; i++)
        to[i] = over(v[i], by);
}

/* The first of the components that are nearest to 0. */
static inline int least_component(vector v)
{
    int least = 0;
    for (int i = 1; i < 3; i++)
        if (order_of(square_of(v[i]), square_of(v[least])) < 0)
            least = i;
    return least;
}

/* to = e x v, where e is along the coordinate of that component */
static inline void perpendicular(vector to, vector v)
{
    const int least = least_component(v);
    vector e = {real_of(least == 0), real_of(least == 1), real_of(least == 2)};
    cross(to, e, v);
}

/* ------------------------------------------------------------- doubles -- */

/* The double nearest to x, but where x is nearer than 2^-120 of itself to the
 * middle of two. */
static inline double near_double(real x)
{
    need_digits(x);
    return sign_of(x) ? mpfr_get_d(x->x, RND) : 0;
}

/* The double nearest to x; ties to even, 0 is never -0.  MPFR rounds towards 0,
 * then the exact comparison with the middle beyond decides. */
static inline double nearest_double(real x)
{
    const int sign = sign_of(x);
    if (sign == 0)
        return 0;
    const double low = mpfr_get_d(x->x, MPFR_RNDZ);
    const double high = nextafter(low, sign * HUGE_VAL);
    real beyond = isinf(high) ? real_of(sign * 0x1p1023) : real_of(high);
    if (isinf(high))
        beyond = plus(beyond, beyond);
    const int order =
        sign * order_of(x, times(real_of(0.5), plus(real_of(low), beyond)));
    unsigned long long bits;
    memcpy(&bits, &low, sizeof bits);
    return order > 0 || (order == 0 && bits % 2) ? high : low + 0;
}

#endif
