/*
 * surd.c - roots in closed form, and affine functions of t at such a root
 *
 * t itself, the point, the gradient, z and the two coordinates of the angle are
 * all f0 + f1 t.  Such a value is computed from exact numbers by one square
 * root, one sum in which nothing cancels and one quotient.  So all but the last
 * few digits of a pair are right, however near the value is to 0.  Its sign is
 * exact.
 */
#include "roots.h"

/* ---------------------------------------- pairs with an exponent ------- */

floating cylint_floating(exact x)
{
    /* mutant '0' -> '1': the value of a 0 is not read, only its sign */
    floating f = {{0, 0}, 0};
    if (x.sign != 0)
        f.v = cylint_exact_round(x, &f.e);
    return f;
}

floating cylint_floating_sqrt(floating x)
{
    const int odd = x.e & 1, twice = odd ? 2 : 1;
    const pair even = {x.v.hi * twice, x.v.lo * twice};
    return (floating){pair_sqrt(even), (x.e - odd) / 2};
}

/* ------------------------------------------------------- the root ------ */

static const exact *coefficients(cylint_query *q)
{
    const cylint_terms_exact *L = cylint_load_exact_moments(q);
    if (cylint_is_first(q, CYLINT_READY_QUADRATIC)) {
        q->exact_coefficient[0] = cylint_form_exact(L, FORM_A, 0);
        q->exact_coefficient[1] = cylint_form_exact(L, FORM_B, 0);
        q->exact_coefficient[2] = cylint_form_exact(L, FORM_C, 0);
    }
    return q->exact_coefficient;
}

int cylint_exact_mark(cylint_query *q, cylint_root root)
{
    if (root < ROOT_APEX)
        coefficients(q);
    cylint_load_exact_moments(q);
    return q->arena.used;
}

surd cylint_surd(cylint_query *q, cylint_root root)
{
    const cylint_terms_exact *L = cylint_load_exact_moments(q);
    /* mutant '0' -> '1': a number without limbs or without sign is 0 */
    const exact zero = {q->arena.limb, 0, 0, 0};
    surd t = {L->beta, zero, zero, 0, {{0, 0}, 0}};
    if (root < ROOT_APEX) {
        const exact *c = coefficients(q);
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
    return t;
}

/* R = sqrt(S G).  The first call computes it. */
static floating radical(cylint_query *q, surd *t)
{
    if (t->R.v.hi != 0)
        return t->R;
    const cylint_terms_exact *L = cylint_load_exact_moments(q);
    const int used = q->arena.used;
    const floating S = cylint_floating(cylint_form_exact(L, FORM_ROOT_OF_S, 0));
    const floating G = cylint_floating(cylint_form_exact(L, FORM_G, 0));
    q->arena.used = used;
    t->R = CYLINT_RADICAL(L->kind, S, G, floating_mul, cylint_floating_sqrt);
    return t->R;
}

/* ------------------------------------------------ affine functions ----- */

/*
 * F = f0 + f1 t at t = (-B + s R) / A.  Since R^2 = B^2 - A C, two ways:
 *
 *   F = (X + s f1 R) / A,     X = A f0 - B f1
 *     = N / (X - s f1 R),     N = X f0 - (B f0 - C f1) f1
 *
 * and in one of them sizes are added: in the first, but where X and s f1 are
 * opposed.  That they are for A = 0 too, when s is the sign of B, and the
 * second way gives the limit, f0 - f1 C / (2 B).
 */
typedef struct {
    exact X, beside; /* beside the sum: A, or N */
    int opposed;
    int sum; /* the sign of X + s f1 R, or of X - s f1 R */
} affine;

static affine affine_at(cylint_query *q, const surd *t, exact f0, exact f1)
{
    cylint_arena *arena = &q->arena;
    const int s = t->s * f1.sign, used = arena->used;
    if (f1.sign == 0) /* whatever A is */
        return (affine){f0, cylint_load_exact(q)->one, 0, f0.sign};
    const exact X = cylint_exact_keep(
        arena, used,
        cylint_exact_add(arena, cylint_exact_mul(arena, t->A, f0),
                         cylint_exact_neg(cylint_exact_mul(arena, t->B, f1))));
    if (X.sign * s >= 0)
        return (affine){X, t->A, 0, X.sign != 0 ? X.sign : s};
    const int kept = arena->used;
    const exact Y = cylint_exact_keep(
        arena, kept,
        cylint_exact_add(arena, cylint_exact_mul(arena, t->B, f0),
                         cylint_exact_neg(cylint_exact_mul(arena, t->C, f1))));
    const exact N = cylint_exact_keep(
        arena, kept,
        cylint_exact_add(arena, cylint_exact_mul(arena, X, f0),
                         cylint_exact_neg(cylint_exact_mul(arena, Y, f1))));
    return (affine){X, N, 1, X.sign};
}

int cylint_sign_at(cylint_query *q, const surd *t, exact f0, exact f1)
{
    const int used = q->arena.used;
    const affine F = affine_at(q, t, f0, f1);
    q->arena.used = used;
    return F.sum * F.beside.sign;
}

floating cylint_value_at(cylint_query *q, surd *t, exact f0, exact f1)
{
    const int used = q->arena.used;
    const affine F = affine_at(q, t, f0, f1);
    floating sum = floating_size(cylint_floating(F.X));
    const floating beside = cylint_floating(F.beside);
    q->arena.used = used;
    if (F.sum * F.beside.sign == 0)
        return (floating){{0, 0}, 0};
    if (t->s * f1.sign != 0) {
        const floating rest =
            floating_mul(floating_size(cylint_floating(f1)), radical(q, t));
        sum = F.X.sign != 0 ? floating_sum_of_sizes(sum, rest) : rest;
    }
    /* mutant '0' -> '1', '<' -> '<=': F.sum is -1 or 1 here */
    if (F.sum < 0)
        sum.v = pair_neg(sum.v);
    return F.opposed ? floating_div(beside, sum) : floating_div(sum, beside);
}
