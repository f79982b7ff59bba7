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

#include "../signs/radical.h"

/* Certain if |t - (hi + lo)| <= error makes hi the nearest double.  In other
 * rounding modes neither these additions nor the error bounds are valid. */
static int rounds_to_hi(pair t, double error)
{
    return t.hi + (t.lo + error) == t.hi && t.hi + (t.lo - error) == t.hi &&
           cylint_rounds_to_nearest();
}

/* ---------------------------------------------- doubles and pairs ------ */

static double double_sqrt(double x)
{
    return sqrt(x);
}

#define NUM bounded_double
#define VALUE double
#define HIGH(v) (v)
#define OF(x) (x).v
#define FORM(name) name##_bounded
#define V_ADD(x, y) ((x) + (y))
#define V_MUL(x, y) ((x) * (y))
#define V_NEG(x) (-(x))
#define V_SQRT(x) double_sqrt(x)
#define ERROR(x) bounded_error(x)
#define ROUNDING CYLINT_RADICAL_ROUNDING
#include "root_quotient_template.h"
#define NUM bounded_pair
#define VALUE pair
#define HIGH(x) ((x).hi)
#define OF(x) (x).v
#define FORM(name) cylint_##name##_pair
#define V_ADD(x, y) pair_add(x, y)
#define V_MUL(x, y) pair_mul(x, y)
#define V_NEG(x) pair_neg(x)
#define V_SQRT(x) pair_sqrt(x)
#define ERROR(x) bounded_pair_error(x)
#define ROUNDING CYLINT_PAIR_RADICAL_ROUNDING
#include "root_quotient_template.h"

/* A root in doubles, its slope, and bounds on their errors. */
typedef struct {
    double t, error;    /* absolute */
    double slope;       /* A t + B at the root */
    double slope_error; /* relative */
    double curvature;   /* at least |A| */
} estimate;

/* Whether doubles or pairs can compute the root, as a quotient. */
static int is_quotient(const cylint_query *q, cylint_root root)
{
    return q->filters && root != ROOT_APEX;
}

static estimate estimate_of(cylint_query *q, cylint_root root)
{
    estimate k = {0, HUGE_VAL, 0, 2, 0};
    if (!is_quotient(q, root))
        return k;
    const terms_bounded *L =
        root == ROOT_CAP1 ? cylint_load_top(q) : &q->bounded_terms;
    const quotient_bounded f = quotient_of_bounded(L, root);
    if (!(f.error < CYLINT_FIRST_ORDER))
        return k;
    k.t = f.num / f.den;
    k.error = (f.error + CYLINT_RADICAL_ROUNDING) * fabs(k.t);
    k.slope = root == ROOT_EXIT ? f.radical : -f.radical;
    k.slope_error = f.radical_error;
    k.curvature = f.A;
    return k;
}

#define FORM(name) name##_double
#define NEWTON_INLINE static
#define NUM double
#define ABS(x) fabs(x)
#define CONSTANT(x) (x)
#define SUM_OF(x, y, z) ((x) * (y) + (z))
#define QUOTIENT(x, y, inverse) ((x) / (y))
#define SLACK CYLINT_ROOT_SLACK
#include "newton_template.h"

int cylint_move_origin(cylint_terms_pair *L, int cap, bounded_pair t,
                       bounded_pair kept[3])
{
    int in_window = 1;
    for (int i = 0; i < 3; i++) {
        kept[i] = L->D[cap][i];
        L->D[cap][i] = bounded_pair_add(kept[i], bounded_pair_mul(t, L->u[i]));
        in_window &= fabs(L->D[cap][i].v.hi) <= CYLINT_WINDOW;
    }
    return in_window;
}

void cylint_restore_origin(cylint_terms_pair *L, int cap,
                           const bounded_pair kept[3])
{
    for (int i = 0; i < 3; i++)
        L->D[cap][i] = kept[i];
}

/* Subtracts the step from t; returns the bound on the error of the sum. */
static double subtract_step(pair *t, newton_double step)
{
    *t = fast_two_sum(t->hi, t->lo - step.delta);
    return step.error;
}

/*
 * One step of Newton's from t0 = k.t + low, with the slope at the root.  Q(t0)
 * is C of the line with its origin moved to D + t0 u.  That may lie outside the
 * window of error_bounds.h, within 2^361 where settles() accepts t.  Then the
 * underflows on the way to x, which is squared last, add up to less than
 * 2^-560.  Twice that times x is below the rounding of x^2, or, if x is below
 * 2^-450, below CYLINT_UNDERFLOW.
 */
static pair refined(cylint_query *q, estimate k, double low, double *error)
{
    cylint_terms_pair *L = cylint_load_pairs(q);
    bounded_pair kept[3];
    pair t = {k.t, low};
    cylint_move_origin(L, 0, (bounded_pair){t, 0}, kept);
    const bounded_pair Q = cylint_form_C_pair(L);
    cylint_restore_origin(L, 0, kept);
    const double slope = 2 * k.slope;
    *error = subtract_step(
        &t, newton_step_double(Q.v.hi, bounded_pair_error(Q), slope,
                               k.slope_error * fabs(slope), k.curvature,
                               CYLINT_ROOT_SLACK * k.error));
    return t;
}

/* ---------------------------------------------------------- exact ------ */

/* The sign of t - m. */
static int against_exact(cylint_query *q, const surd *t, exact m)
{
    return cylint_sign_at(q, t, cylint_exact_neg(m), cylint_load_exact(q)->one);
}

/* Sizes of doubles are handled by their bits from here on, because a
 * processor can be set to read subnormals as zero. */
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
static int against_middle(cylint_query *q, const surd *t, uint64_t size,
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
        const exact sum =
            cylint_exact_add(arena, low, cylint_exact_from(arena, next));
        m = cylint_exact_mul(arena, sum, cylint_exact_from(arena, 0.5));
    }
    const int beyond = sign * against_exact(q, t, m);
    arena->used = used;
    return beyond;
}

/*
 * The double nearest to a root other than 0, ties to even, infinite beyond the
 * largest; from near_bits of the root in pairs, by exact signs at the middles
 * around it.  It is that size or the next to it: in rounding to nearest the
 * root is within |lo| + CYLINT_SURD_ERROR |hi| of hi, that is within 0.51 of
 * the gap between doubles on its side of hi, and where subnormals lie wider
 * than hi's digits, within 0.26 of theirs, of which near_bits drops less than
 * one.  In other modes |lo| may be twice that: it is two steps at most.
 */
enum { MOST_STEPS = 2 };

static double settle(cylint_query *q, const surd *t, int sign, uint64_t size)
{
    const uint64_t from = size;
    cylint_reached(MIDDLE);
    for (; size < INFINITE_BITS; size++) {
        const int beyond = against_middle(q, t, size, sign);
        if (beyond < 0 || (beyond == 0 && !(size & 1)))
            break;
    }
    for (; size > 0 && size < INFINITE_BITS; size--) {
        const int beyond = against_middle(q, t, size - 1, sign);
        if (beyond > 0 || (beyond == 0 && !(size & 1)))
            break;
    }
    cylint_contradiction(size > from + MOST_STEPS || from > size + MOST_STEPS);
    return size > 0 ? from_bits(size, sign) : 0;
}

/* t in every digit there is need of. */
static floating exact_root(cylint_query *q, surd *t)
{
    /* mutant '0' -> '1': a number without limbs or without sign is 0 */
    const exact zero = {q->arena.limb, 0, 0, 0};
    return cylint_value_at(q, t, zero, cylint_load_exact(q)->one);
}

static double exact_value(cylint_query *q, cylint_root root, double *more)
{
    const int used = cylint_exact_mark(q, root);
    surd in_full = cylint_surd(q, root);
    const floating f = exact_root(q, &in_full);
    const pair t = f.v;
    const int tame = f.e > -CYLINT_SUM_EXPONENT && f.e < CYLINT_LARGE_EXPONENT;
    double value;
    if (t.hi == 0)
        value = 0;
    else if (tame && rounds_to_hi(t, CYLINT_SURD_ERROR * fabs(t.hi)))
        value = cylint_scaled(t.hi, f.e);
    else
        value = settle(q, &in_full, cylint_sign(t.hi), near_bits(t.hi, f.e));
    *more = tame ? (cylint_scaled(t.hi, f.e) - value) + cylint_scaled(t.lo, f.e)
                 : 0;
    q->arena.used = used;
    return value;
}

/* The sign of root - m, exactly. */
static int root_against(cylint_query *q, cylint_root root, double m)
{
    const int used = cylint_exact_mark(q, root);
    const surd t = cylint_surd(q, root);
    const int sign = against_exact(q, &t, cylint_exact_from(&q->arena, m));
    q->arena.used = used;
    return sign;
}

/* -------------------------------------------------------- outside ------ */

/* Whether a certain rounding is also one in the true scale of t, and no
 * product of t on the way can have underflowed. */
static int settles(const cylint_query *q, pair t, double error)
{
    const double size = fabs(t.hi);
    const int e = cylint_exponent(t.hi) + q->t_exponent;
    /* untaken 1 of 4: no root of that size is known that pairs decide */
    return rounds_to_hi(t, error) && size > CYLINT_ROOT_LEAST &&
           size < 1 / CYLINT_ROOT_LEAST && e > -CYLINT_SUM_EXPONENT &&
           e < CYLINT_LARGE_EXPONENT;
}

/* Whether a root that is no root of a quadratic, or its double root, is 0. */
static int lies_at_origin(cylint_query *q, cylint_root root)
{
    return root == ROOT_DOUBLE ? cylint_sign_B(q) == 0
                               : cylint_sign_alpha(q, root == ROOT_CAP1) == 0;
}

/*
 * A root so near to the line's origin that nothing is left of C in pairs:
 * C in every digit, over the other half of the quotient in pairs.
 */
static pair root_near_origin(cylint_query *q, cylint_root root, double *error)
{
    const pair none = {0, 0};
    const int exits = root == ROOT_EXIT;
    int near, e = 0;
    *error = HUGE_VAL;
    if (root != ROOT_ENTRY && !exits) {
        *error = lies_at_origin(q, root) ? 0 : HUGE_VAL;
        return none;
    }
    if (q->near_shape != q->shape)
        return none;
    const cylint_quotient_pair f =
        cylint_half_quotient_pair(cylint_load_pair_moments(q), exits, &near);
    if (!near || !(f.error < CYLINT_NEAR_ORIGIN))
        return none;
    if (cylint_sign_C(q) == 0) {
        /* mutant '0' -> '1': slower, the next stage computes 0, too */
        *error = 0;
        return none;
    }
    const cylint_terms_exact *L = cylint_load_exact(q);
    const int used = q->arena.used;
    pair num = cylint_exact_round(cylint_form_C_exact(L), &e);
    q->arena.used = used;
    /* untaken 1 of 4: C is far below 2^400 where filters apply */
    if (e < -CYLINT_SQUARE_EXPONENT || e > CYLINT_SQUARE_EXPONENT)
        return none;
    num.hi *= cylint_power_of_two(e);
    num.lo *= cylint_power_of_two(e);
    const pair t = pair_div(exits ? pair_neg(num) : num, f.den);
    *error = (f.error + CYLINT_PAIR_RADICAL_ROUNDING) * fabs(t.hi);
    return t;
}

/* From the quotient in pairs, for roots that doubles leave uncertain. */
static estimate estimate_by_pairs(cylint_root root,
                                  const cylint_quotient_pair *f, pair t,
                                  double error)
{
    return (estimate){t.hi, error, root == ROOT_EXIT ? f->radical : -f->radical,
                      f->radical_error, f->A};
}

/* Newton's steps from k.t + low until the rounding is certain or they gain
 * little; each squares the error that is left of k's. */
static int newton(cylint_query *q, estimate k, double low, pair *t,
                  double *error)
{
    *error = HUGE_VAL;
    while (k.slope_error < CYLINT_FIRST_ORDER) {
        *t = refined(q, k, low, error);
        if (settles(q, *t, *error))
            return 1;
        if (!(*error < CYLINT_NEWTON_GAIN * k.error))
            return 0;
        k.t = t->hi;
        k.error = *error;
        low = t->lo;
    }
    return 0;
}

/* As far as pairs go: a refinement of the root in doubles, the quotient in
 * pairs (NULL: not found yet), its refinement, the quotient with an exact
 * numerator.  Returns whether the rounding is certain. */
static int root_in_pairs(cylint_query *q, cylint_root root, estimate k,
                         const cylint_quotient_pair *known, pair *t,
                         double *error)
{
    if (newton(q, k, 0, t, error))
        return 1;
    const cylint_quotient_pair f =
        known ? *known
              : cylint_quotient_of_pair(cylint_load_pair_moments(q), root);
    if (f.error < CYLINT_FIRST_ORDER) {
        *t = pair_div(f.num, f.den);
        *error = (f.error + CYLINT_PAIR_RADICAL_ROUNDING) * fabs(t->hi);
        if (settles(q, *t, *error))
            return 1;
        if (newton(q, estimate_by_pairs(root, &f, *t, *error), t->lo, t, error))
            return 1;
    }
    *t = root_near_origin(q, root, error);
    return *error == 0 || settles(q, *t, *error);
}

static double root_value(cylint_query *q, cylint_root root, estimate k,
                         const cylint_quotient_pair *known, double *more)
{
    pair t = {0, 0};
    double error;
    if (q->pairs && is_quotient(q, root) &&
        root_in_pairs(q, root, k, known, &t, &error)) {
        const double value = cylint_scaled(t.hi, q->t_exponent);
        cylint_contradiction(exact_value(q, root, more) != value);
        /* mutant '0' -> '1': slower, second 0: an exact t is computed twice */
        /* mutant '>' -> '>=': slower, a t of 0 has the error NaN, which decides
         * nothing */
        q->t_error = error > 0 ? error / fabs(t.hi) : 0;
        *more = cylint_scaled(t.lo, q->t_exponent);
        return value;
    }
    q->t_error = CYLINT_SURD_ERROR;
    return exact_value(q, root, more);
}

/* ----------------------------------------------- canonical pairs ------ */

/* One step of Newton's from *t, which is at most *error from the root, with the
 * slope at *t.  curvature: at least half the second derivative. */
static void step_from(bounded_pair residual, bounded_pair slope,
                      double curvature, pair *t, double *error)
{
    const double slope_error = bounded_pair_error(slope);
    if (slope_error < CYLINT_FIRST_ORDER * fabs(slope.v.hi))
        *error = subtract_step(
            t, newton_step_double(residual.v.hi, bounded_pair_error(residual),
                                  slope.v.hi, slope_error, curvature, *error));
    else
        *error = HUGE_VAL;
}

/* Towards a root of the lateral quadric.  With the line's origin moved to *t,
 * C is Q there and B half its slope, near the shape, so that a far origin costs
 * no digits. */
static void step_to_lateral(cylint_terms_pair *L, double curvature, pair *t,
                            double *error)
{
    bounded_pair kept[3];
    cylint_move_origin(L, 0, (bounded_pair){*t, 0}, kept);
    const bounded_pair C = cylint_form_C_pair(L), B = cylint_form_B_pair(L);
    cylint_restore_origin(L, 0, kept);
    const bounded_pair slope = {{2 * B.v.hi, 2 * B.v.lo}, 2 * B.error};
    step_from(C, slope, curvature, t, error);
}

/* Towards the plane of a cap. */
static void step_to_plane(cylint_terms_pair *L, int cap, pair *t, double *error)
{
    bounded_pair kept[3];
    cylint_move_origin(L, cap, (bounded_pair){*t, 0}, kept);
    const bounded_pair alpha = cylint_form_alpha_pair(L, cap);
    cylint_restore_origin(L, cap, kept);
    step_from(alpha, L->beta, 0, t, error);
}

/* Newton's steps from *t, at most *error away.  Returns whether they give all
 * but a few digits of a pair. */
static int newton_from(cylint_query *q, cylint_root root, pair *t,
                       double *error)
{
    const double enough = CYLINT_POLISHED * fabs(t->hi);
    double before;
    if (root == ROOT_CAP0 || root == ROOT_CAP1) {
        step_to_plane(cylint_load_pairs(q), root == ROOT_CAP1, t, error);
        return *error < enough;
    }
    if (root != ROOT_ENTRY && root != ROOT_EXIT)
        return 0;
    cylint_terms_pair *L = cylint_load_pair_moments(q);
    const bounded_pair A = cylint_form_A_pair(L);
    do {
        before = *error;
        step_to_lateral(L, fabs(A.v.hi) + bounded_pair_error(A), t, error);
    } while (*error >= enough && *error < CYLINT_NEWTON_GAIN * before);
    return *error < enough;
}

/* The multiple of the quantum, a power of two, nearest to the rest, if that is
 * certain. */
static int rest_rounds(double rest, double error, double quantum, double *to)
{
    const double nearest = (rest + 0x3p51 * quantum) - 0x3p51 * quantum;
    *to = nearest;
    return fabs(rest - nearest) + error < (0.5 - CYLINT_REST_MARGIN) * quantum;
}

/* From t, which is within half a unit of the root. */
static int rest_by_newton(cylint_query *q, cylint_root root, double t,
                          double quantum, double *rest)
{
    pair x = {t, 0};
    double error = CYLINT_ROUNDING / 2 * fabs(t);
    return newton_from(q, root, &x, &error) &&
           rest_rounds((x.hi - t) + x.lo, error, quantum, rest);
}

static void rest_in_full(cylint_query *q, cylint_root root, double t,
                         double quantum, double *rest)
{
    const int used = cylint_exact_mark(q, root);
    surd in_full = cylint_surd(q, root);
    const exact from = cylint_exact_neg(cylint_exact_from(&q->arena, t));
    const floating f =
        cylint_value_at(q, &in_full, from, cylint_load_exact(q)->one);
    rest_rounds(cylint_scaled(f.v.hi, f.e), 0, quantum, rest);
    q->arena.used = used;
}

bounded_pair cylint_canonical_root(cylint_query *q, cylint_root root, double t,
                                   double more, double error)
{
    if (t == 0) /* the root is below the least double */
        return (bounded_pair){{0, 0}, CYLINT_ZERO_ROOT_ERROR};
    const double quantum =
        cylint_power_of_two(cylint_exponent(t) - 52 - CYLINT_REST_BITS);
    double rest;
    if (!rest_rounds(more, error, quantum, &rest) &&
        !rest_by_newton(q, root, t, quantum, &rest))
        rest_in_full(q, root, t, quantum, &rest);
    return (bounded_pair){{t, rest}, 0.51 * quantum / CYLINT_PAIR_ROUNDING};
}

int cylint_polish_root(cylint_query *q, cylint_root root, bounded_pair *t)
{
    double error = CYLINT_PAIR_UNIT * t->error;
    if (t->v.hi == 0)
        return 0;
    if (!newton_from(q, root, &t->v, &error)) {
        const int used = cylint_exact_mark(q, root);
        surd in_full = cylint_surd(q, root);
        const floating f = exact_root(q, &in_full);
        q->arena.used = used;
        t->v = (pair){cylint_scaled(f.v.hi, f.e), cylint_scaled(f.v.lo, f.e)};
        error = CYLINT_SURD_ERROR * fabs(t->v.hi);
    }
    t->error = CYLINT_ROOT_SLACK * error / CYLINT_PAIR_ROUNDING;
    return 1;
}

/* ------------------------------------------------------- the domain ---- */

/* t in the scale of the filters, rounded. */
static double in_scale(const cylint_query *q, double t)
{
    return q->t_exponent == 0 ? t : cylint_scaled(t, -q->t_exponent);
}

/* Where a root with a bounded error lies: 1 within the domain, -1 outside, 0 if
 * it is too near a limit. */
static int placed(const cylint_query *q, double t, double error)
{
    const double from = in_scale(q, q->line->tmin);
    const double to = in_scale(q, q->line->tmax);
    /* of a limit brought into scale */
    const double off_from =
        CYLINT_QUOTIENT_ROUNDING * cylint_smaller(fabs(from), DBL_MAX);
    const double off_to =
        CYLINT_QUOTIENT_ROUNDING * cylint_smaller(fabs(to), DBL_MAX);
    error = CYLINT_ROOT_SLACK * error + CYLINT_UNDERFLOW;
    if (t + error < from - off_from || t - error > to + off_to)
        return -1;
    return t - error > from + off_from && t + error < to - off_to;
}

/* The same by pairs, which give a root near the line's origin its digits. */
static int placed_by_pairs(const cylint_query *q, const cylint_quotient_pair *f)
{
    if (!(f->error < CYLINT_FIRST_ORDER))
        return 0;
    const double t = pair_div(f->num, f->den).hi;
    return placed(q, t, (f->error + CYLINT_QUOTIENT_ROUNDING) * fabs(t));
}

int cylint_root_within(cylint_query *q, cylint_root root, int wanted, double *t,
                       double *more)
{
    const double tmin = q->line->tmin, tmax = q->line->tmax;
    const int limited = tmin >= -DBL_MAX || tmax <= DBL_MAX;
    if (tmin > DBL_MAX || tmax < -DBL_MAX)
        return 0; /* beyond all numbers, though t may be rounded to that */
    if (!wanted && !limited)
        return 1;
    const estimate k = estimate_of(q, root);
    cylint_quotient_pair f;
    const cylint_quotient_pair *known = NULL;
    if (limited) {
        int place = k.error < HUGE_VAL ? placed(q, k.t, k.error) : 0;
        if (place == 0 && q->pairs && is_quotient(q, root)) {
            f = cylint_quotient_of_pair(cylint_load_pair_moments(q), root);
            known = &f;
            place = placed_by_pairs(q, known);
        }
        if (place < 0)
            return 0;
        if (place > 0 && !wanted)
            return 1;
    }
    *t = root_value(q, root, k, known, more);
    if (*t < tmin || *t > tmax)
        return 0;
    if (*t == tmin && fabs(tmin) <= DBL_MAX && root_against(q, root, tmin) < 0)
        return 0;
    return !(*t == tmax && fabs(tmax) <= DBL_MAX &&
             root_against(q, root, tmax) > 0);
}
