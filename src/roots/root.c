/*
 * root.c - roots in the domain, correctly rounded
 *
 * A root is computed in pairs of doubles with a bound on the error, which
 * decides whether the rounding is certain.  If it is not, the root is computed
 * from exact coefficients.  If that is too near to the midpoint of two doubles,
 * the exact sign of the equation at the midpoint decides.  A root is algebraic
 * of degree two, so every tie is decidable.
 *
 * At the entry root Q falls, A t + B = -sqrt(S G); at the exit root it rises:
 *
 *   exit  = (-B + R) / A = -C / (B + R),   R = sqrt(S G)
 *   entry = (-B - R) / A =  C / (R - B).
 *
 * Both equations hold for either sign of A.  If A = 0, the second form is the
 * limit.  The code uses the form without cancellation.
 */
#include "roots.h"

/* ------------------------------------------------------ quotients ------ */

static bounded_pair form_in_pairs(cylint_query *q, cylint_form f, int end)
{
    bounded_pair x = cylint_form_pair(cylint_load_pairs(q, f, end), f, end);
    x.error = bounded_pair_error(x);
    return x;
}

static double relative_error(bounded_pair x)
{
    return x.error / fabs(x.v.hi);
}

static bounded_pair negative(bounded_pair x)
{
    return (bounded_pair){pair_neg(x.v), x.error};
}

/* R = sqrt(S G), with an infinite error unless S, or its root, and G are certainly
 * not 0, and so positive: the determinant of an elliptic shape can be all error. */
static bounded_pair radical_of(cylint_query *q)
{
    const bounded_pair G = form_in_pairs(q, FORM_G, 0);
    const bounded_pair S = form_in_pairs(q, FORM_ROOT_OF_S, 0);
    if (!(relative_error(G) < CYLINT_FIRST_ORDER &&
          relative_error(S) < CYLINT_FIRST_ORDER))
        return (bounded_pair){G.v, HUGE_VAL};
    /* without a square, S G may have underflowed */
    const pair R = CYLINT_RADICAL(q->kind, S.v, G.v, pair_mul, pair_sqrt);
    if (!cylint_S_is_square(q->kind) && !(R.hi > CYLINT_RADICAL_LEAST))
        return (bounded_pair){R, HUGE_VAL};
    return (bounded_pair){R, R.hi * (relative_error(G) + relative_error(S) +
                                     CYLINT_PAIR_RADICAL_ROUNDING)};
}

/* |B| + R: the divisor or the dividend of the form of a root in which nothing
 * cancels.  *near: whether it is the divisor, and the dividend is C.  That is so of
 * the root nearer to the line's origin; of the other one the divisor is A. */
static bounded_pair divisor(cylint_query *q, int exits, int *near)
{
    const bounded_pair B = form_in_pairs(q, FORM_B, 0), R = radical_of(q);
    /* mutant '<' -> '<=': for B = 0 either sign is right */
    const int falls = B.v.hi < 0;
    const pair sum = pair_add(R.v, falls ? pair_neg(B.v) : B.v);
    *near = falls != exits;
    return (bounded_pair){sum, B.error + R.error +
                                   CYLINT_PAIR_RADICAL_ROUNDING * fabs(sum.hi)};
}

static const bounded_pair undecided = {{HUGE_VAL, 0}, HUGE_VAL};

/* Undecided if the root is no quotient of forms, or pairs are not certain. */
static bounded_pair root_by_quotient(cylint_query *q, cylint_root root)
{
    const int exits = root == ROOT_EXIT;
    int near;
    if (!q->pairs || root == ROOT_APEX)
        return undecided;
    if (root == ROOT_DOUBLE)
        return cylint_quotient(negative(form_in_pairs(q, FORM_B, 0)),
                               form_in_pairs(q, FORM_A, 0));
    if (root != ROOT_ENTRY && !exits)
        return cylint_quotient(
            negative(form_in_pairs(q, FORM_ALPHA, root == ROOT_CAP1)),
            form_in_pairs(q, FORM_BETA, 0));
    const bounded_pair sum = divisor(q, exits, &near);
    if (!(sum.error < HUGE_VAL))
        return undecided;
    const bounded_pair x = form_in_pairs(q, near ? FORM_C : FORM_A, 0);
    const bounded_pair t =
        near ? cylint_quotient(x, sum) : cylint_quotient(sum, x);
    return near == exits ? negative(t) : t;
}

/* ---------------------------------------------------------- exact ------ */

static double exact_value(cylint_query *q, cylint_root root)
{
    const surd t = cylint_surd(q, root);
    const exact zero = cylint_exact_zero(&q->arena);
    const exact one = cylint_load_exact(q, FORM_ALPHA, 0)->one;
    const double value =
        cylint_nearest_at(q, ROUNDED_QUOTIENT, &t, zero, one, one);
    q->arena.used = t.mark;
    return value;
}

/* The sign of root - m, exactly. */
static int exact_side(cylint_query *q, cylint_root root, double m)
{
    const surd t = cylint_surd(q, root);
    const exact from = cylint_exact_neg(cylint_exact_from(&q->arena, m));
    const exact one = cylint_load_exact(q, FORM_ALPHA, 0)->one;
    return cylint_only_sign(&q->arena, t.mark,
                            cylint_sign_at(q, &t, from, one));
}

/* ------------------------------------------------------- the domain ---- */

/* Whether a root is 0: for Q, B has the sign of the slope, and C is 0. */
static int is_at_origin(cylint_query *q, cylint_root root)
{
    if (root == ROOT_CAP0 || root == ROOT_CAP1)
        return cylint_form_sign(q, FORM_ALPHA, root == ROOT_CAP1) == 0;
    const int slope = root == ROOT_EXIT ? 1 : root == ROOT_ENTRY ? -1 : 0;
    return cylint_form_sign(q, FORM_B, 0) == slope &&
           cylint_form_sign(q, FORM_C, 0) == 0;
}

/* The root in pairs: 0 without error where exact signs prove that. */
static bounded_pair root_in_pairs(cylint_query *q, cylint_root root)
{
    const bounded_pair t = root_by_quotient(q, root);
    const int can_be_zero = fabs(t.v.hi) < HUGE_VAL && fabs(t.v.hi) <= t.error;
    return can_be_zero && is_at_origin(q, root) ? (bounded_pair){{0, 0}, 0} : t;
}

/* The double nearest to the root, which is t in pairs. */
static double root_value(cylint_query *q, cylint_root root, bounded_pair t)
{
    if (!cylint_is_exact_zero(t) && !cylint_is_rounded(t))
        return exact_value(q, root);
    cylint_contradiction(exact_value(q, root) != t.v.hi);
    return t.v.hi;
}

/* The sign of root - limit, exactly; t: the root in pairs. */
static int side_of_limit(cylint_query *q, cylint_root root, bounded_pair t,
                         double limit)
{
    if (fabs(limit) > DBL_MAX) /* beyond all numbers, though t may be rounded */
        return limit < 0 ? 1 : -1;
    const int side = cylint_side_of_number(t, limit);
    return side == CYLINT_SIGN_UNDECIDED ? exact_side(q, root, limit) : side;
}

int cylint_root_within(cylint_query *q, cylint_root root, int wanted, double *t)
{
    const double tmin = q->line->tmin, tmax = q->line->tmax;
    if (!wanted && tmin < -DBL_MAX && tmax > DBL_MAX)
        return 1;
    const bounded_pair at = root_in_pairs(q, root);
    if (side_of_limit(q, root, at, tmin) < 0 ||
        side_of_limit(q, root, at, tmax) > 0)
        return 0;
    if (wanted)
        *t = root_value(q, root, at);
    return 1;
}
