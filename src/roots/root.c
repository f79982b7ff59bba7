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

/* Whether hi is the double nearest to every number within the error of hi + lo.
 * In other rounding modes neither these additions nor the error bounds are
 * valid. */
static int rounds_to_hi(pair t, double error)
{
    /* untaken 1 of 6: callers have tested the rounding mode */
    return t.hi + (t.lo + error) == t.hi && t.hi + (t.lo - error) == t.hi &&
           cylint_rounds_to_nearest();
}

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

/* x / y.  Relative errors are added to first order: CYLINT_ROOT_SLACK covers their
 * products, each of which is below 2^-10.  A larger error counts as infinite. */
static bounded_pair quotient_of_numbers(bounded_pair x, bounded_pair y)
{
    const pair t = pair_div(x.v, y.v);
    const double error = relative_error(x) + relative_error(y);
    return (bounded_pair){t, error < CYLINT_FIRST_ORDER
                                 ? CYLINT_ROOT_SLACK * fabs(t.hi) *
                                       (error + CYLINT_PAIR_RADICAL_ROUNDING)
                                 : HUGE_VAL};
}

static bounded_pair negative(bounded_pair x)
{
    return (bounded_pair){pair_neg(x.v), x.error};
}

/* R = sqrt(S G), with an infinite error unless S, or its root, and G are certainly
 * positive: the determinant of an elliptic shape can be all error. */
static bounded_pair radical_of(cylint_query *q)
{
    const bounded_pair G = form_in_pairs(q, FORM_G, 0);
    const bounded_pair S = form_in_pairs(q, FORM_ROOT_OF_S, 0);
    /* mutant '>' -> '<': slower, the next stage decides */
    if (!(G.v.hi > 0 && relative_error(G) < CYLINT_FIRST_ORDER && S.v.hi > 0 &&
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
        return quotient_of_numbers(negative(form_in_pairs(q, FORM_B, 0)),
                                   form_in_pairs(q, FORM_A, 0));
    if (root != ROOT_ENTRY && !exits)
        return quotient_of_numbers(
            negative(form_in_pairs(q, FORM_ALPHA, root == ROOT_CAP1)),
            form_in_pairs(q, FORM_BETA, 0));
    const bounded_pair sum = divisor(q, exits, &near);
    if (!(sum.error < HUGE_VAL))
        return undecided;
    const bounded_pair x = form_in_pairs(q, near ? FORM_C : FORM_A, 0);
    const bounded_pair t =
        near ? quotient_of_numbers(x, sum) : quotient_of_numbers(sum, x);
    return near == exits ? negative(t) : t;
}

/* -------------------------------------------------- Newton's steps ----- */

#define FORM(name) name##_double
#define NEWTON_INLINE static
#define NUM double
#define ABS(x) fabs(x)
#define CONSTANT(x) (x)
#define SUM_OF(x, y, z) ((x) * (y) + (z))
#define QUOTIENT(x, y, inverse) ((x) / (y))
#define SLACK CYLINT_ROOT_SLACK
#include "newton_template.h"

/* One step of Newton's from t.  With the line's origin moved to t, near the shape,
 * a far origin costs no digits: f is C there, with the slope 2 B, or alpha of a
 * cap, with the slope beta.  curvature: half the second derivative or more.
 * Undecided for a point outside the window of error_bounds.h. */
static bounded_pair step_from(cylint_query *q, bounded_pair t, cylint_form f,
                              int cap, double curvature)
{
    const cylint_form f_slope = f == FORM_C ? FORM_B : FORM_BETA;
    const double factor = f == FORM_C ? 2 : 1;
    cylint_terms_pair *L = cylint_load_pairs(q, f_slope, cap);
    bounded_pair *D = L->D[cap];
    const bounded_pair kept[3] = {D[0], D[1], D[2]};
    int in_window = 1;
    for (int i = 0; i < 3; i++) {
        D[i] = bounded_pair_add(
            D[i], bounded_pair_mul((bounded_pair){t.v, 0}, L->u[i]));
        in_window &= fabs(D[i].v.hi) <= CYLINT_WINDOW;
    }
    const bounded_pair at = form_in_pairs(q, f, cap);
    const bounded_pair slope = form_in_pairs(q, f_slope, cap);
    memcpy(D, kept, sizeof kept);
    const double s = factor * slope.v.hi, s_error = factor * slope.error;
    if (!in_window || !(s_error < CYLINT_FIRST_ORDER * fabs(s)))
        return undecided;
    const newton_double step =
        newton_step_double(at.v.hi, at.error, s, s_error, curvature, t.error);
    /* with the rounding of t.lo - delta and CYLINT_NEAREST_MARGIN */
    return (bounded_pair){fast_two_sum(t.v.hi, t.v.lo - step.delta),
                          step.error + CYLINT_PAIR_ROUNDING * fabs(t.v.hi)};
}

/* Newton's steps from t until it has all but a few digits of a pair, or they gain
 * little. */
static bounded_pair newton_from(cylint_query *q, cylint_root root,
                                bounded_pair t)
{
    double before;
    if (root == ROOT_CAP0 || root == ROOT_CAP1)
        return step_from(q, t, FORM_ALPHA, root == ROOT_CAP1, 0);
    if (root != ROOT_ENTRY && root != ROOT_EXIT)
        return undecided;
    const bounded_pair A = form_in_pairs(q, FORM_A, 0);
    do {
        before = t.error;
        t = step_from(q, t, FORM_C, 0, fabs(A.v.hi) + A.error);
    } while (t.error >= CYLINT_POLISHED * fabs(t.v.hi) &&
             t.error < CYLINT_NEWTON_GAIN * before);
    return t;
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
static int root_against(cylint_query *q, cylint_root root, double m)
{
    const surd t = cylint_surd(q, root);
    const exact from = cylint_exact_neg(cylint_exact_from(&q->arena, m));
    const exact one = cylint_load_exact(q, FORM_ALPHA, 0)->one;
    return cylint_only_sign(&q->arena, t.mark,
                            cylint_sign_at(q, &t, from, one));
}

/* ------------------------------------------------------ the value ------ */

/* Whether t certainly rounds to t.v.hi, also in its true scale, and no product of t
 * can have underflowed. */
static int settles(const cylint_query *q, bounded_pair t)
{
    const double size = fabs(t.v.hi);
    const int e = cylint_exponent(t.v.hi) + q->t_exponent;
    return rounds_to_hi(t.v, t.error) && size > CYLINT_ROOT_LEAST &&
           size < 1 / CYLINT_ROOT_LEAST && e > -CYLINT_SUM_EXPONENT &&
           e < CYLINT_LARGE_EXPONENT;
}

/* Whether a root is 0: for Q, B has the sign of the slope, and C is 0. */
static int is_at_origin(cylint_query *q, cylint_root root)
{
    if (root == ROOT_CAP0 || root == ROOT_CAP1)
        return cylint_form_sign(q, FORM_ALPHA, root == ROOT_CAP1) == 0;
    const int slope = root == ROOT_EXIT ? 1 : root == ROOT_ENTRY ? -1 : 0;
    return cylint_form_sign(q, FORM_B, 0) == slope &&
           cylint_form_sign(q, FORM_C, 0) == 0;
}

/* Improves *t, a quotient of pairs: it becomes 0 where exact signs prove that,
 * which Newton's steps cannot, or takes these steps.  Returns whether its rounding
 * is certain. */
static int root_in_pairs(cylint_query *q, cylint_root root, bounded_pair *t)
{
    const int can_be_zero =
        fabs(t->v.hi) < HUGE_VAL && fabs(t->v.hi) <= t->error;
    if (can_be_zero && is_at_origin(q, root)) {
        *t = (bounded_pair){{0, 0}, 0};
        return 1;
    }
    if (!settles(q, *t) && t->error < HUGE_VAL)
        *t = newton_from(q, root, *t);
    return settles(q, *t);
}

/* *is_zero: whether the root is certainly 0. */
static double root_value(cylint_query *q, cylint_root root, bounded_pair t,
                         int *is_zero)
{
    *is_zero = 0;
    if (!q->pairs || root == ROOT_APEX || !root_in_pairs(q, root, &t))
        return exact_value(q, root);
    const double value = cylint_scaled(t.v.hi, q->t_exponent);
    cylint_contradiction(exact_value(q, root) != value);
    *is_zero = t.error == 0;
    return value;
}

/* ------------------------------------------------------- the domain ---- */

/* t in the scale of the filters, rounded. */
static double in_scale(const cylint_query *q, double t)
{
    return q->t_exponent == 0 ? t : cylint_scaled(t, -q->t_exponent);
}

/* Where a root with a bounded error lies: 1 within the domain, -1 outside, 0 if
 * it is too near a limit.  In other rounding modes an operation on pairs is less
 * accurate, but far more accurate than one on doubles. */
static int placed(const cylint_query *q, bounded_pair x)
{
    const double from = in_scale(q, q->line->tmin);
    const double to = in_scale(q, q->line->tmax);
    /* of a limit brought into scale */
    const double off_from =
        CYLINT_QUOTIENT_ROUNDING * cylint_smaller(fabs(from), DBL_MAX);
    const double off_to =
        CYLINT_QUOTIENT_ROUNDING * cylint_smaller(fabs(to), DBL_MAX);
    const double t = x.v.hi, error = CYLINT_ROOT_SLACK * x.error +
                                     CYLINT_QUOTIENT_ROUNDING * fabs(t) +
                                     CYLINT_UNDERFLOW;
    /* mutant '||' -> '&&': slower, the root is computed and compared */
    if (t + error < from - off_from || t - error > to + off_to)
        return -1;
    return t - error > from + off_from && t + error < to - off_to;
}

int cylint_root_within(cylint_query *q, cylint_root root, int wanted, double *t)
{
    const double tmin = q->line->tmin, tmax = q->line->tmax;
    const int limited = tmin >= -DBL_MAX || tmax <= DBL_MAX;
    if (tmin > DBL_MAX || tmax < -DBL_MAX)
        return 0; /* beyond all numbers, though t may be rounded to that */
    if (!wanted && !limited)
        return 1;
    const bounded_pair at = root_by_quotient(q, root);
    if (limited) {
        const int place = placed(q, at);
        if (place < 0)
            return 0;
        if (place > 0 && !wanted)
            return 1;
    }
    int is_zero;
    *t = root_value(q, root, at, &is_zero);
    if (*t < tmin || *t > tmax)
        return 0;
    if (is_zero)
        return cylint_sign(tmin) <= 0 && cylint_sign(tmax) >= 0;
    if (*t == tmin && fabs(tmin) <= DBL_MAX && root_against(q, root, tmin) < 0)
        return 0;
    return !(*t == tmax && fabs(tmax) <= DBL_MAX &&
             root_against(q, root, tmax) > 0);
}
