/*
 * root.c - where the line passes a boundary, correctly rounded
 *
 * First in pairs of doubles, with a bound on the error that decides whether
 * the rounding is certain; else from exact coefficients; and where even that
 * lies too near the middle between two doubles, by the exact sign of the
 * boundary's equation at that middle.  A root is algebraic of degree two, so
 * every tie is decided.
 *
 * On the entry root Q falls, A t + B = -sqrt(S G); on the exit root it rises:
 *
 *   exit  = (-B + R) / A = -C / (B + R),   R = sqrt(S G)
 *   entry = (-B - R) / A =  C / (R - B).
 *
 * That holds for either sign of A and leaves the second form as the limit
 * for A = 0.  Of each two the one without cancellation is used.
 */
#include "internal.h"

/* A quotient's parts, v 2^e each. */
typedef struct {
    pair num, den;
    int num_e, den_e;
    double error; /* relative, of the quotient; above 1: unknown */
} fraction;

/* Certain if |t - (hi + lo)| <= error makes hi the nearest double. */
static int rounds_to_hi(pair t, double error)
{
    return t.hi + (t.lo + error) == t.hi && t.hi + (t.lo - error) == t.hi;
}

/* ------------------------------------------------------- in pairs ------ */

static double relative(wide x)
{
    return wide_error(x) / fabs(x.v.hi);
}

/* R and its relative error; 0 unless G is certainly positive. */
static wide wide_radical(const letters_wide *L, double *error)
{
    const wide G = form_G_wide(L);
    const double eG = relative(G);
    if (!(G.v.hi > 0 && eG < 0x1p-10)) {
        *error = 2;
        return G;
    }
    const wide S = form_root_of_S_wide(L);
    wide R;
    if (L->kind == CYLINT_KIND_CYLINDER || L->kind == CYLINT_KIND_ACONE)
        R.v = pair_sqrt(pair_mul(S.v, G.v));
    else
        R.v = pair_mul(S.v, pair_sqrt(G.v));
    *error = eG + relative(S) + 0x1p-98;
    R.size = fabs(R.v.hi);
    return R;
}

static fraction wide_fraction(const letters_wide *L, cylint_root root)
{
    fraction f = {{0, 0}, {1, 0}, 0, 0, 2};
    wide num, den;
    if (root == ROOT_CAP0 || root == ROOT_CAP1) {
        num = form_alpha_wide(L, root == ROOT_CAP1);
        den = L->beta;
        f.error = relative(num) + relative(den);
        num.v = pair_neg(num.v);
    } else if (root == ROOT_ENTRY || root == ROOT_EXIT) {
        double eR;
        const wide B = form_B_wide(L), R = wide_radical(L, &eR);
        if (eR > 1)
            return f;
        const int exits = root == ROOT_EXIT;
        const pair sum = pair_add(R.v, B.v.hi < 0 ? pair_neg(B.v) : B.v);
        const double eSum = (wide_error(B) + eR * R.size) / sum.hi + 0x1p-98;
        if ((B.v.hi < 0) == exits) {
            den = form_A_wide(L);
            num.v = exits ? sum : pair_neg(sum);
            f.error = eSum + relative(den);
        } else {
            num = form_C_wide(L);
            f.error = eSum + relative(num);
            num.v = exits ? pair_neg(num.v) : num.v;
            den.v = sum;
        }
    } else {
        return f;
    }
    f.num = num.v;
    f.den = den.v;
    return f;
}

/* ---------------------------------------------------------- exact ------ */

static const exact *coefficients(cylint_query *q)
{
    const letters_exact *L = cylint_exact(q);
    if (!(q->ready & CYLINT_READY_QUADRATIC)) {
        q->ready |= CYLINT_READY_QUADRATIC;
        q->exact_coefficient[0] = form_A_exact(L);
        q->exact_coefficient[1] = form_B_exact(L);
        q->exact_coefficient[2] = form_C_exact(L);
    }
    return q->exact_coefficient;
}

/* rho at m, or cap's alpha + m beta. */
static exact linear_at(cylint_query *q, cylint_root root, exact m)
{
    const letters_exact *L = cylint_exact(q);
    const exact at0 = root == ROOT_APEX
                    ? form_rho0_exact(L)
                    : form_alpha_exact(L, root == ROOT_CAP1);
    const exact slope = root == ROOT_APEX ? form_rho1_exact(L) : L->beta;
    const int rising = slope.sign;
    exact sum = cylint_exact_add(L->arena, at0,
                                 cylint_exact_mul(L->arena, slope, m));
    sum.sign *= rising;
    return sum; /* of the sign of m - root */
}

static int quadratic_against(cylint_query *q, cylint_root root, exact m)
{
    const exact *c = coefficients(q);
    cylint_arena *arena = &q->arena;
    const exact Am = cylint_exact_mul(arena, c[0], m);
    const exact slope = cylint_exact_add(arena, Am, c[1]);
    if (root == ROOT_DOUBLE)
        return -slope.sign * c[0].sign;
    const exact twice = cylint_exact_add(arena, slope, c[1]);
    const exact Q = cylint_exact_add(arena,
                        cylint_exact_mul(arena, twice, m), c[2]);
    /* the entry root is the exit root of the line reversed */
    const int flip = root == ROOT_EXIT ? 1 : -1;
    const int rising = slope.sign * flip;
    if (c[0].sign >= 0) {
        if (rising <= 0)
            return Q.sign == 0 && rising == 0 ? 0 : flip;
        return -Q.sign * flip;
    }
    if (rising > 0)
        return -Q.sign * flip;
    return Q.sign == 0 && rising == 0 ? 0 : -flip;
}

static int against_exact(cylint_query *q, cylint_root root, exact m)
{
    if (root >= ROOT_APEX)
        return -linear_at(q, root, m).sign;
    return quadratic_against(q, root, m);
}

/* |B| + R, both with exponents. */
static pair sum_of_sizes(pair x, int xe, pair y, int ye, int *e)
{
    if (xe < ye)
        return sum_of_sizes(y, ye, x, xe, e);
    *e = xe;
    if (xe - ye > 250)
        return x;
    const double w = cylint_power_of_two(ye - xe);
    return pair_add(x, (pair){y.hi * w, y.lo * w});
}

static pair exact_radical(cylint_query *q, int *e)
{
    const letters_exact *L = cylint_exact(q);
    int eS, eG;
    pair S = cylint_exact_round(form_root_of_S_exact(L), &eS);
    pair G = cylint_exact_round(form_G_exact(L), &eG);
    if (L->kind == CYLINT_KIND_CYLINDER || L->kind == CYLINT_KIND_ACONE) {
        G = pair_mul(S, G);
        eG += eS;
        S = (pair){1, 0};
        eS = 0;
    }
    if (eG & 1) {
        G.hi *= 2;
        G.lo *= 2;
        eG--;
    }
    *e = eS + eG / 2;
    return pair_mul(S, pair_sqrt(G));
}

/* num or den is exactly 0 only as a root at t = 0: then num is. */
static fraction exact_fraction(cylint_query *q, cylint_root root)
{
    const letters_exact *L = cylint_exact(q);
    fraction f = {{0, 0}, {1, 0}, 0, 0, 0x1p-97};
    exact num, den = L->beta;
    if (root == ROOT_CAP0 || root == ROOT_CAP1) {
        num = form_alpha_exact(L, root == ROOT_CAP1);
    } else if (root == ROOT_APEX) {
        num = form_rho0_exact(L);
        den = form_rho1_exact(L);
    } else {
        const exact *c = coefficients(q);
        if (root != ROOT_DOUBLE) {
            int eR, eB = 0;
            const pair R = exact_radical(q, &eR);
            const int exits = root == ROOT_EXIT;
            pair B = {0, 0}, sum = R;
            int e = eR;
            if (c[1].sign != 0) {
                B = cylint_exact_round(c[1], &eB);
                if (B.hi < 0)
                    B = pair_neg(B);
                sum = sum_of_sizes(B, eB, R, eR, &e);
            }
            if ((c[1].sign < 0) == exits && c[0].sign != 0) {
                f.num = exits ? sum : pair_neg(sum);
                f.num_e = e;
                f.den = cylint_exact_round(c[0], &f.den_e);
            } else if (c[2].sign != 0) {
                f.num = cylint_exact_round(c[2], &f.num_e);
                if (exits)
                    f.num = pair_neg(f.num);
                f.den = sum;
                f.den_e = e;
            }
            return f;
        }
        num = c[1];
        den = c[0];
    }
    if (num.sign == 0)
        return f;
    f.num = pair_neg(cylint_exact_round(num, &f.num_e));
    f.den = cylint_exact_round(den, &f.den_e);
    return f;
}

/* Sizes of doubles are handled by their bits from here on, because a
 * processor may be told to take subnormals for zero. */
static double from_bits(uint64_t bits, int sign)
{
    double x;
    if (sign < 0)
        bits |= (uint64_t)1 << 63;
    memcpy(&x, &bits, sizeof x);
    return x;
}

#define INFINITE_BITS ((uint64_t)0x7ff << 52)

/* The bits of a double not far from |t| 2^e, 1/4 <= |t| <= 4. */
static uint64_t near_bits(double t, int e)
{
    e += cylint_exponent(t);
    t = fabs(t) * cylint_power_of_two(-cylint_exponent(t));
    if (e < -1076)
        return 0;
    if (e > 1023)
        return INFINITE_BITS - 1;
    if (e < -1022)
        return (uint64_t)(t * cylint_power_of_two(e + 1074));
    uint64_t bits;
    memcpy(&bits, &t, sizeof bits);
    return bits + ((uint64_t)(e + 1023) << 52) - ((uint64_t)1023 << 52);
}

/* The sign of |root| - the middle between the size and the next above. */
static int against_middle(cylint_query *q, cylint_root root, uint64_t size,
                          int sign)
{
    cylint_arena *arena = &q->arena;
    const int used = arena->used;
    const exact low = cylint_exact_from(arena, from_bits(size, sign));
    exact m;
    if (size + 1 == INFINITE_BITS) {
        m = cylint_exact_add(arena, low,
                             cylint_exact_from(arena, sign * 0x1p970));
    } else {
        const double next = from_bits(size + 1, sign);
        const exact sum = cylint_exact_add(arena, low,
                                           cylint_exact_from(arena, next));
        m = cylint_exact_mul(arena, sum, cylint_exact_from(arena, 0.5));
    }
    const int beyond = sign * against_exact(q, root, m);
    arena->used = used;
    return beyond;
}

/* The nearest double, ties to even, from a candidate's size by exact signs
 * at the middles around it; infinite beyond the largest. */
static double settle(cylint_query *q, cylint_root root, uint64_t size)
{
    const exact zero = {q->arena.limb, 0, 0, 0};
    const int sign = against_exact(q, root, zero);
    if (sign == 0)
        return 0;
    for (; size < INFINITE_BITS; size++) {
        const int beyond = against_middle(q, root, size, sign);
        if (beyond < 0 || (beyond == 0 && !(size & 1)))
            break;
    }
    for (; size > 0 && size < INFINITE_BITS; size--) {
        const int beyond = against_middle(q, root, size - 1, sign);
        if (beyond > 0 || (beyond == 0 && !(size & 1)))
            break;
    }
    return from_bits(size, sign);
}

/* Makes what stays in the arena; the rest may be let go to its answer. */
static int settled_arena(cylint_query *q, cylint_root root)
{
    if (root < ROOT_APEX)
        coefficients(q);
    cylint_exact(q);
    return q->arena.used;
}

static double exact_value(cylint_query *q, cylint_root root, double *more)
{
    const int used = settled_arena(q, root);
    const fraction f = exact_fraction(q, root);
    *more = 0;
    if (f.num.hi == 0) {
        q->arena.used = used;
        return 0;
    }
    const pair t = pair_div(f.num, f.den);
    const int e = f.num_e - f.den_e;
    double value;
    if (e > -900 && e < 1000 && rounds_to_hi(t, f.error * fabs(t.hi)))
        value = cylint_scaled(t.hi, e);
    else
        value = settle(q, root, near_bits(t.hi, e));
    if (e > -900 && e < 1000)
        *more = (cylint_scaled(t.hi, e) - value) + cylint_scaled(t.lo, e);
    q->arena.used = used;
    return value;
}

/* -------------------------------------------------------- outside ------ */

double cylint_root_value(cylint_query *q, cylint_root root, double *more)
{
    if (q->filters) {
        const fraction f = wide_fraction(cylint_wide(q), root);
        if (f.error < 0x1p-56) {
            const pair t = pair_div(f.num, f.den);
            const double error = (f.error + 0x1p-98) * fabs(t.hi);
            const int e = cylint_exponent(t.hi) + q->t_exponent;
            if (rounds_to_hi(t, error) && e > -900 && e < 1000) {
                *more = t.lo;
                if (q->t_exponent == 0)
                    return t.hi;
                *more = cylint_scaled(t.lo, q->t_exponent);
                return cylint_scaled(t.hi, q->t_exponent);
            }
        }
    }
    return exact_value(q, root, more);
}

int cylint_root_against(cylint_query *q, cylint_root root, double m)
{
    const int used = settled_arena(q, root);
    const int sign = against_exact(q, root, cylint_exact_from(&q->arena, m));
    q->arena.used = used;
    return sign;
}
