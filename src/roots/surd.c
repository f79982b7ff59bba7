/*
 * surd.c - roots in closed form, and affine functions of t at such a root
 *
 * t itself, the point, the gradient, z and the two coordinates of the angle are
 * all f0 + f1 t, z divided by a constant.  Such a value is computed from exact
 * numbers by one square root, one sum in which nothing cancels and one quotient,
 * each cut to its leading limbs.  So its error is relative, however near the
 * value is to 0, and its digits are the same in every floating-point
 * environment.  Its sign is exact.
 */
#include "roots.h"

/* -------------------------------------------------- leading digits ----- */

enum {
    LEADING_LIMBS = 5, /* at least 129 bits */
    /* v 2^-96 exceeds the error of a value v */
    ERROR_LIMBS = 3
};

exact cylint_leading(exact x)
{
    const int less = x.n - LEADING_LIMBS;
    /* mutant '>' -> '>=': 0 limbs less */
    if (less > 0) {
        x.limb += less;
        x.n -= less;
        x.exponent += less;
    }
    return x;
}

exact cylint_sum_of_sizes(cylint_arena *arena, exact x, exact y)
{
    const int higher = cylint_top_of(x) - cylint_top_of(y);
    if (x.sign == 0 || (y.sign != 0 && higher < -LEADING_LIMBS))
        return y;
    if (y.sign == 0 || higher > LEADING_LIMBS)
        return x;
    return cylint_leading(cylint_exact_add(arena, x, y));
}

/* 1 / sqrt(x) with a relative error of at most 2^-30, by integers, so that it is
 * the same in every rounding mode. */
static exact first_inverse_root(cylint_arena *arena, exact x)
{
    const uint64_t leading =
        (uint64_t)x.limb[x.n - 1] << 32 | (x.n > 1 ? x.limb[x.n - 2] : 0);
    int shift = 0;
    while (leading >> shift > UINT32_MAX)
        shift += 2;
    const uint64_t X = leading >> shift; /* 2^30 <= X < 2^32 */
    uint64_t n = 0;                      /* the largest with n^2 X < 2^94 */
    for (uint64_t bit = (uint64_t)1 << 31; bit != 0; bit >>= 1) {
        const uint64_t square = (n | bit) * (n | bit);
        const uint64_t low = (square & UINT32_MAX) * X;
        if ((square >> 32) * X + (low >> 32) < (uint64_t)1 << 62)
            n |= bit;
    }
    /* x is near X 2^(shift + 32 (top - 2)) */
    const int e = -47 - shift / 2 - 16 * (cylint_top_of(x) - 2);
    exact s = cylint_exact_from(arena, (double)n * cylint_power_of_two(e & 31));
    s.exponent += (e - (e & 31)) / 32;
    return s;
}

/* Two steps of Newton's, s + s (1 - x s^2) / 2. */
exact cylint_inverse_root(cylint_arena *arena, exact x)
{
    const int used = arena->used;
    exact s = first_inverse_root(arena, x);
    for (int i = 0; i < 2; i++) {
        const exact xss =
            cylint_exact_mul(arena, x, cylint_exact_mul(arena, s, s));
        const exact residual = cylint_leading(
            cylint_exact_sub(arena, cylint_exact_from(arena, 1), xss));
        const exact step = cylint_exact_mul(
            arena, residual,
            cylint_exact_mul(arena, s, cylint_exact_from(arena, 0.5)));
        s = cylint_exact_keep(arena, used,
                              cylint_leading(cylint_exact_add(arena, s, step)));
    }
    return s;
}

exact cylint_inverse(cylint_arena *arena, exact x)
{
    const int used = arena->used;
    x = cylint_leading(x);
    exact y = cylint_inverse_root(
        arena, cylint_leading(cylint_exact_mul(arena, x, x)));
    y.sign = x.sign;
    return cylint_exact_keep(arena, used, y);
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

static const exact *coefficients(cylint_query *q)
{
    const cylint_terms_exact *L = cylint_load_exact(q, FORM_A, 0);
    if (!q->has_coefficients) {
        q->has_coefficients = 1;
        q->exact_coefficient[0] = cylint_form_exact(L, FORM_A, 0);
        q->exact_coefficient[1] = cylint_form_exact(L, FORM_B, 0);
        q->exact_coefficient[2] = cylint_form_exact(L, FORM_C, 0);
    }
    return q->exact_coefficient;
}

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

surd cylint_surd(cylint_query *q, cylint_root root)
{
    const cylint_terms_exact *L = cylint_load_exact(q, FORM_A, 0);
    const exact *c = root < ROOT_APEX ? coefficients(q) : NULL;
    const exact zero = cylint_exact_zero(&q->arena);
    surd t = {L->beta, zero, zero, 0, zero, zero, q->arena.used};
    if (c) {
        t.A = c[0];
        t.B = c[1];
        t.C = c[2];
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
    if (t.A.sign != 0)
        t.per_A = cylint_inverse(&q->arena, t.A);
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

exact cylint_value_at(cylint_query *q, const surd *t, exact f0, exact f1)
{
    cylint_arena *arena = &q->arena;
    const int used = arena->used;
    const affine F = affine_at(q, t, f0, f1);
    exact sum = cylint_leading(F.X), value = sum;
    if (f1.sign != 0) {
        exact radical_term = cylint_exact_mul(arena, cylint_leading(f1), t->R);
        radical_term.sign = radical_term.sign != 0 ? F.sum : 0;
        sum = cylint_sum_of_sizes(arena, sum, radical_term);
        value = F.opposed ? cylint_exact_mul(arena, cylint_leading(F.beside),
                                             cylint_inverse(arena, sum))
                          : cylint_exact_mul(arena, sum, t->per_A);
    }
    return cylint_exact_keep(arena, used, cylint_leading(value));
}

/* Two doubles next to each other are the only candidates: those nearest to the
 * value minus and plus its error. */
double cylint_nearest_at(cylint_query *q, const surd *t, exact f0, exact f1,
                         exact unit)
{
    cylint_arena *arena = &q->arena;
    const int used = arena->used;
    exact size = cylint_value_at(q, t, f0, f1);
    if (unit.limb != cylint_load_exact(q, FORM_ALPHA, 0)->one.limb)
        size = cylint_exact_mul(arena, size, cylint_inverse(arena, unit));
    const int sign = size.sign;
    size.sign = sign != 0;
    exact error = size;
    error.exponent -= ERROR_LIMBS;
    int64_t low = cylint_rank(
        cylint_exact_nearest(cylint_exact_sub(arena, size, error), 0));
    const int64_t high = cylint_rank(
        cylint_exact_nearest(cylint_exact_add(arena, size, error), 0));
    cylint_contradiction(high > low + 1);
    if (low < high) {
        cylint_reached(MIDDLE);
        exact middle = cylint_exact_mul(
            arena, cylint_exact_from(arena, 0.5),
            cylint_exact_add(arena, cylint_exact_of_rank(arena, low),
                             cylint_exact_of_rank(arena, high)));
        middle.sign = -sign;
        const exact beyond =
            cylint_exact_add(arena, f0, cylint_exact_mul(arena, middle, unit));
        const int side = sign * cylint_sign_at(q, t, beyond, f1);
        if (side > 0 || (side == 0 && !(high & 1))) /* a tie, to even */
            low = high;
    }
    arena->used = used;
    return cylint_from_rank(sign * low);
}
