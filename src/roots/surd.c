/*
 * surd.c - roots in closed form, and affine functions of t at such a root
 *
 * t itself, the point, the gradient, z and the two coordinates of the angle are
 * all f0 + f1 t, z divided by a constant.  So are, with a t that is a square root,
 * the point of a surface that is nearest to another one, and its distance and
 * normal but for the root of a constant or of the whole.  Such a value is computed
 * from exact numbers by one square root, one sum in which nothing cancels and one
 * quotient, each cut to its leading limbs.  So its error is relative, however near
 * the value is to 0, and its digits are the same in every floating-point
 * environment.  Its sign is exact.
 */
#include "roots.h"

/* -------------------------------------------------- leading digits ----- */

enum {
    LEADING_LIMBS = 3, /* at least 129 bits */
    /* v 2^-64 exceeds the error of a value v */
    ERROR_LIMBS = 1
};

exact cylint_leading(exact x)
{
    const int less = x.n - LEADING_LIMBS;
    /* mutant '>' -> '>=': 0 limbs less */
    if (less > 0) {
        x.limb += less;
        x.n = LEADING_LIMBS;
        x.exponent += less;
    }
    return x;
}

/* 2^(60 + k) / sqrt(x) with an error of at most 80, by integers, so that it is the
 * same in every rounding mode: Newton's steps y (3 - X y^2) / 2 with 30 bits after
 * the point from y = 1, and the last one, y + y e / 2, with 60. */
static uint64_t first_inverse_root(exact x, int *k)
{
    int shift;
    const uint64_t leading = cylint_leading_bits(x, &shift);
    /* the bits of x / 4^k below the point, which is 1/4 or more and below 1 */
    const uint64_t X = leading >> (shift & 1);
    const uint64_t high = X >> 32, low = X & UINT32_MAX,
                   three = (uint64_t)3 << 30;
    uint64_t y = (uint64_t)1 << 30;
    /* mutant '6' -> '7', '<' -> '<=': slower, y has all its digits */
    for (int i = 0; i < 6; i++)
        y = y * (three - (high * (y * y >> 30) >> 32)) >> 31;
    *k = 32 * cylint_top_of(x) - shift / 2;
    const uint64_t a = y * y >> 32, b = y * y & UINT32_MAX;
    const uint64_t Xyy = high * a + (high * b >> 32) + (low * a >> 32);
    const int64_t e = (int64_t)(((uint64_t)1 << 60) - Xyy);
    const int64_t last = (int64_t)(y << 30) + (int64_t)y * (e / 16) / (1 << 27);
    return ((uint64_t)last + 32) >> 6 << 6; /* of a power of 4 exactly */
}

/* A step of Newton's from s: s + s / 2 (1 - x s^2). */
exact cylint_inverse_root(cylint_arena *arena, exact x)
{
    const int used = arena->used;
    int k;
    const uint64_t first = first_inverse_root(x, &k);
    const exact s = cylint_exact_of_integer(arena, first, -60 - k),
                half = cylint_exact_of_integer(arena, first, -61 - k);
    const exact xss = cylint_exact_mul(arena, x, cylint_exact_mul(arena, s, s));
    const exact residual = cylint_leading(
        cylint_exact_sub(arena, cylint_exact_from(arena, 1), xss));
    const exact step = cylint_exact_mul(arena, residual, half);
    return cylint_exact_keep(arena, used,
                             cylint_leading(cylint_exact_add(arena, s, step)));
}

exact cylint_inverse(cylint_arena *arena, exact x)
{
    const int used = arena->used;
    x = cylint_leading(x);
    exact y = cylint_inverse_root(
        arena, cylint_leading(cylint_exact_mul(arena, x, x)));
    return cylint_exact_keep(arena, used, cylint_exact_signed(y, x.sign));
}

exact cylint_square_root(cylint_arena *arena, exact x)
{
    const int used = arena->used;
    x = cylint_leading(x);
    return cylint_exact_keep(arena, used,
                             cylint_leading(cylint_exact_mul(
                                 arena, x, cylint_inverse_root(arena, x))));
}

/* ------------------------------------------------------- the root ------ */

/* R = sqrt(S G). */
static exact radical(cylint_query *q, const cylint_terms_exact *L)
{
    cylint_arena *arena = &q->arena;
    const int used = arena->used;
    const exact S = cylint_leading(cylint_form_exact(L, FORM_ROOT_OF_S, 0));
    const exact G = cylint_leading(cylint_form_exact(L, FORM_G, 0));
#define MUL(x, y) cylint_exact_mul(arena, x, y)
#define SQRT(x) cylint_square_root(arena, x)
    const exact R = CYLINT_RADICAL(L->kind, S, G, MUL, SQRT);
#undef MUL
#undef SQRT
    return cylint_exact_keep(arena, used, cylint_leading(R));
}

surd cylint_root_of_quotient(cylint_query *q, exact x, exact y)
{
    const exact zero = cylint_exact_zero(&q->arena);
    surd t = {y, zero, cylint_exact_neg(x), x.sign, zero, q->arena.used};
    if (x.sign != 0)
        t.R = cylint_square_root(
            &q->arena,
            cylint_exact_mul(&q->arena, cylint_leading(x), cylint_leading(y)));
    return t;
}

surd cylint_surd(cylint_query *q, cylint_root root)
{
    const cylint_terms_exact *L = cylint_load_exact(q, FORM_A, 0);
    const exact zero = cylint_exact_zero(&q->arena);
    surd t = {L->beta, zero, zero, 0, zero, q->arena.used};
    if (root < ROOT_APEX) {
        t.A = cylint_form_exact(L, FORM_A, 0);
        t.B = cylint_form_exact(L, FORM_B, 0);
        t.C = cylint_form_exact(L, FORM_C, 0);
        /* mutant '1' -> '2': only its sign is used */
        t.s = root == ROOT_DOUBLE ? 0 : root == ROOT_EXIT ? 1 : -1;
    } else if (root == ROOT_APEX) {
        t.A = cylint_form_exact(L, FORM_RHO1, 0);
        t.B = cylint_form_exact(L, FORM_RHO0, 0);
    } else {
        t.B = cylint_form_exact(L, FORM_ALPHA, root == ROOT_CAP1);
    }
    if (t.s != 0)
        t.R = radical(q, L);
    return t;
}

/* ------------------------------------------------ affine functions ----- */

/*
 * F = f0 + f1 t at t = (-B + s R) / A.  Since R^2 = B^2 - A C, two ways:
 *
 *   F = (X + s f1 R) / A,     X = A f0 - B f1
 *     = N / (X - s f1 R),     N = X f0 - (B f0 - C f1) f1
 *
 * In one of them sizes are added: in the second where X and s f1 have opposite
 * signs, else in the first.  X and s f1 have opposite signs if A = 0 and s is the
 * sign of B: the second way gives the limit then, f0 - f1 C / (2 B).
 */
typedef struct {
    exact X, beside; /* beside the sum: A, or N */
    int opposed;
    int sum; /* the sign of X + s f1 R, or of X - s f1 R */
} affine;

static affine affine_at(cylint_query *q, const surd *t, exact f0, exact f1)
{
    const cylint_terms_exact *L = cylint_load_exact(q, FORM_ALPHA, 0);
    const int s = t->s * f1.sign;
    if (f1.sign == 0) /* whatever A is */
        return (affine){f0, L->one, 0, f0.sign};
    const exact X = cylint_combined_exact(L, t->A, f0, t->B, f1);
    if (X.sign * s >= 0)
        return (affine){X, t->A, 0, X.sign != 0 ? X.sign : s};
    const exact Y = cylint_combined_exact(L, t->B, f0, t->C, f1),
                N = cylint_combined_exact(L, X, f0, Y, f1);
    return (affine){X, N, 1, X.sign};
}

int cylint_sign_at(cylint_query *q, const surd *t, exact f0, exact f1)
{
    const int used = q->arena.used;
    const affine F = affine_at(q, t, f0, f1);
    q->arena.used = used;
    return F.sum * F.beside.sign;
}

/* Leading digits of what cylint_nearest_at() rounds.  With f0 + f1 t = x / y that
 * is x / (y unit), sqrt(x y unit) / (y unit), or x / sqrt(y y unit). */
static exact value_of(cylint_query *q, cylint_rounded of, const surd *t,
                      exact f0, exact f1, exact unit)
{
    cylint_arena *arena = &q->arena;
    const int used = arena->used;
    const affine F = affine_at(q, t, f0, f1);
    const exact beside = cylint_leading(F.beside);
    exact sum = cylint_leading(F.X);
    if (f1.sign != 0) {
        exact radical_term = cylint_exact_mul(arena, cylint_leading(f1), t->R);
        if (radical_term.sign != 0)
            radical_term = cylint_exact_signed(radical_term, F.sum);
        sum = cylint_leading(cylint_exact_add(arena, sum, radical_term));
    }
    exact x = F.opposed ? beside : sum, y = F.opposed ? sum : beside;
    const exact u = cylint_leading(unit),
                yu = cylint_leading(cylint_exact_mul(arena, y, u));
    if (x.sign != 0) {
        const exact square = cylint_exact_mul(arena, yu,
                                              of == ROUNDED_ROOT     ? x
                                              : of == ROUNDED_COSINE ? y
                                                                     : yu);
        x = cylint_exact_mul(
            arena, cylint_exact_signed(x, x.sign * y.sign * u.sign),
            cylint_inverse_root(arena, cylint_leading(square)));
    }
    return cylint_exact_keep(arena, used, cylint_leading(x));
}

exact cylint_value_at(cylint_query *q, const surd *t, exact f0, exact f1)
{
    return value_of(q, ROUNDED_QUOTIENT, t, f0, f1,
                    cylint_load_exact(q, FORM_ALPHA, 0)->one);
}

/* (f0 + f1 t)^2 / unit as a value of the same form, as A t^2 = -2 B t - C. */
static void square_value(cylint_query *q, const surd *t, exact *f0, exact *f1,
                         exact *unit)
{
    cylint_arena *arena = &q->arena;
    const cylint_terms_exact *L = cylint_load_exact(q, FORM_ALPHA, 0);
    const int used = arena->used;
    exact x = cylint_combined_exact(L, t->A, *f0, t->B, *f1);
    x = cylint_exact_mul(arena, *f1, x);
    x = cylint_exact_keep(arena, used, cylint_exact_add(arena, x, x));
    const int kept = arena->used;
    *f0 = cylint_exact_keep(
        arena, kept,
        cylint_combined_exact(L, cylint_exact_mul(arena, t->A, *f0), *f0,
                              cylint_exact_mul(arena, t->C, *f1), *f1));
    *f1 = x;
    *unit = cylint_exact_mul(arena, t->A, *unit);
}

/* The sign of |z| - m, z the number that cylint_nearest_at() rounds. */
static int sign_from(cylint_query *q, cylint_rounded of, const surd *t,
                     exact f0, exact f1, exact unit, int sign, exact m)
{
    cylint_arena *arena = &q->arena;
    if (of == ROUNDED_COSINE)
        square_value(q, t, &f0, &f1, &unit);
    if (of != ROUNDED_QUOTIENT) {
        m = cylint_exact_mul(arena, m, m);
        sign = 1;
    }
    const int used = arena->used;
    f0 = cylint_exact_keep(
        arena, used,
        cylint_exact_sub(
            arena, f0,
            cylint_exact_mul(arena, cylint_exact_signed(m, sign), unit)));
    return sign * unit.sign * cylint_sign_at(q, t, f0, f1);
}

/* Two doubles next to each other are the only candidates: those nearest to the
 * value minus and plus its error. */
double cylint_nearest_at(cylint_query *q, cylint_rounded of, const surd *t,
                         exact f0, exact f1, exact unit)
{
    cylint_arena *arena = &q->arena;
    const int used = arena->used;
    const exact value = value_of(q, of, t, f0, f1, unit);
    const int sign = value.sign;
    const exact size = cylint_exact_signed(value, sign != 0);
    exact error = size;
    error.exponent -= ERROR_LIMBS;
    int64_t low = cylint_rank(
        cylint_exact_nearest(cylint_exact_sub(arena, size, error), 0));
    const int64_t high = cylint_rank(
        cylint_exact_nearest(cylint_exact_add(arena, size, error), 0));
    cylint_contradiction(high > low + 1);
    if (low < high) {
        cylint_reached(MIDDLE);
        const exact middle = cylint_exact_mul(
            arena, cylint_exact_from(arena, 0.5),
            cylint_exact_add(arena, cylint_exact_of_rank(arena, low),
                             cylint_exact_of_rank(arena, high)));
        const int side = sign_from(q, of, t, f0, f1, unit, sign, middle);
        if (side > 0 || (side == 0 && !(high & 1))) /* a tie, to even */
            low = high;
    }
    arena->used = used;
    return cylint_from_rank(sign * low);
}
