/*
 * hit.c - point, normal, z and angle of a hit
 *
 * They depend on the line, the shape and the root only, not on the way in which
 * the root was computed.  The point and the facts below are affine in t.  They
 * are computed up to three times, each time with bounds on their errors:
 *
 *   1. in pairs of doubles, at t and its canonical rest (root.c);
 *   2. in pairs, at the root as a pair, for values that cancel;
 *   3. exactly, by surd.c, for values that still cancel, for exact zeros and for
 *      data out of the range of pairs.
 *
 * A number is computed in the next step if it has too few digits.  Every step,
 * and the choice among them, depends on line, shape and root only, so that all
 * paths give the same bits.
 */
#include <limits.h>

#include "roots.h"

/*
 * A zero is accepted if no rounding was on its way, that is if the sum of the
 * errors is 0, and no product can have underflowed: a component of the data is
 * 0 or at least 2^-150, a difference of two such is 0 or at least 2^-202, and
 * no fact is of a degree above 5.
 */
static int is_zero_or_tame(double x)
{
    return cylint_sign(x) == 0 || fabs(x) >= CYLINT_TAME_LEAST;
}

static int data_are_tame(const cylint_query *q)
{
    const cylint_shape *s = q->shape;
    const cylint_line *l = q->line;
    int tame = is_zero_or_tame(cylint_r0(s)) && is_zero_or_tame(cylint_r1(s)) &&
               is_zero_or_tame(cylint_radius_growth(s).hi);
    for (int i = 0; i < 3; i++) {
        tame &= is_zero_or_tame(l->o[i]) && is_zero_or_tame(l->d[i]);
        tame &= is_zero_or_tame(cylint_base(s)[i]) &&
                is_zero_or_tame(cylint_axis(s)[i]);
        if (cylint_is_elliptic(q->kind))
            tame &= is_zero_or_tame(cylint_a(s)[i]) &&
                    is_zero_or_tame(cylint_b(s)[i]);
    }
    return tame;
}

/* Whether the error of x is small beside a size. */
static int is_known(bounded_pair x, double size)
{
    return size > CYLINT_DIGITS * bounded_pair_error(x);
}

/* Whether x has digits enough of its own. */
static int has_digits(const cylint_query *q, bounded_pair x)
{
    if (x.error == 0) /* a datum, or a sum of products by 0 */
        return x.v.hi != 0 || data_are_tame(q);
    return is_known(x, fabs(x.v.hi));
}

/* ------------------------------------------------- the last roundings -- */

static double rounded(floating x)
{
    return cylint_scaled(x.v.hi, x.e);
}

/* Below those of all other numbers for 0. */
static int floating_exponent(floating x)
{
    return x.v.hi == 0 ? INT_MIN / 2 : x.e + cylint_exponent(x.v.hi);
}

/* Each component is within 3 units in its last place: |x|^2 is summed in pairs,
 * so that there remain the roundings of it, of its root, of the component and of
 * the quotient.  No component exceeds 1.  Squares neither overflow nor, of the
 * largest component, underflow. */
static void write_unit_vector(const floating x[3], int sign, double to[3])
{
    pair y[3], sum = {0, 0};
    int e = floating_exponent(x[0]), scaled = 0;
    for (int i = 1; i < 3; i++)
        e = floating_exponent(x[i]) > e ? floating_exponent(x[i]) : e;
    /* mutant '<' -> '<=': `make sanitize` detects the element too many */
    for (int i = 0; i < 3; i++)
        scaled |= x[i].e != 0;
    scaled |= e > CYLINT_SQUARE_EXPONENT || e < -CYLINT_SQUARE_EXPONENT;
    for (int i = 0; i < 3; i++) {
        y[i] = scaled ? floating_scaled(x[i], -e) : x[i].v;
        sum = pair_add(sum, pair_mul(y[i], y[i]));
    }
    const double size = sign * sqrt(sum.hi);
    for (int i = 0; i < 3; i++) {
        const double component = cylint_positive_zero(y[i].hi / size);
        to[i] = component > 1 ? 1 : component < -1 ? -1 : component;
    }
}

/* atan2(y, x) over 2 pi, in [0, 1).  The low parts dx and dy turn the angle by
 * (x dy - y dx) / (x^2 + y^2). */
static double turns(floating y, floating x)
{
    if (y.v.hi == 0 && x.v.hi == 0)
        return 0;
    const int ex = floating_exponent(x), ey = floating_exponent(y),
              e = ex > ey ? ex : ey;
    const pair X = floating_scaled(x, -e), Y = floating_scaled(y, -e);
    const double rest =
        (X.hi * Y.lo - Y.hi * X.lo) / (X.hi * X.hi + Y.hi * Y.hi);
    return cylint_turns(atan2(Y.hi, X.hi) + rest);
}

/* ------------------------------------------------------------- facts --- */

/* Forms of the terms whose quotients the hit's numbers are. */
enum {
    GRADIENT = 0,
    AXIAL = 3,
    AXIS = 6,
    HEIGHT = 9,
    HEIGHT_UNIT,
    X = 11,
    Y,
    VV,
    FACTS
};

/* Whether z of the hit is that of a cap. */
static int is_on_cap(const cylint_query *q, cylint_root root)
{
    return (root == ROOT_CAP0 || root == ROOT_CAP1) &&
           !cylint_is_round(q->kind);
}

/* Whether the normal is that of a quadric. */
static int is_curved(const cylint_query *q, int part)
{
    return part == CYLINT_PART_LATERAL || cylint_is_round(q->kind);
}

/* The facts that are needed, as bits.  Each is computed as if it were alone, so
 * that no answer depends on what else is wanted. */
enum {
    NEED_Z = 1u << HEIGHT | 1u << HEIGHT_UNIT,
    NEED_PHI = 1u << X | 1u << Y | 1u << VV
};

static unsigned needs_of(const cylint_query *q, unsigned want, cylint_root root,
                         int part, int apex)
{
    const int axis = !cylint_has_no_axis(q->shape);
    unsigned need = 0;
    if (want & CYLINT_WANT_NORMAL)
        need |= 7u << (!is_curved(q, part) ? AXIAL : apex ? AXIS : GRADIENT);
    if ((want & CYLINT_WANT_Z) && !is_on_cap(q, root) && axis)
        need |= NEED_Z;
    if ((want & CYLINT_WANT_PHI) && !apex && axis)
        need |= NEED_PHI;
    return need;
}

/* The needed facts of the point that D[0] leads to. */
static void facts_of(const cylint_query *q, const cylint_terms_pair *L,
                     unsigned need, bounded_pair x[FACTS])
{
    /* mutant '<' -> '<=': `make sanitize` detects the element too many */
    for (int i = 0; i < HEIGHT; i++)
        if (need >> i & 1)
            x[i] = i < AXIAL  ? cylint_gradient_pair(L, i)
                   : i < AXIS ? cylint_axial_pair(L)[i - AXIAL]
                              : L->w[i - AXIS];
    if (need & NEED_Z) {
        x[HEIGHT] = cylint_form_height_pair(L, cylint_is_reversed(q->shape));
        x[HEIGHT_UNIT] = cylint_form_height_unit_pair(L);
    }
    if (need & NEED_PHI) {
        x[VV] = cylint_form_height_unit_pair(L);
        cylint_about_axis_pair(L, cylint_least_axis_component(q->shape), &x[X],
                               &x[Y]);
        if (cylint_is_reversed(q->shape))
            x[X].v = pair_neg(x[X].v);
    }
}

/* The angle is small where y is, if x > 0: then it needs the digits of y.
 * Elsewhere x and y need those of the larger of them. */
static int angle_has_digits(const cylint_query *q, const bounded_pair *x)
{
    const double scale = !cylint_is_elliptic(q->kind) ? sqrt(x[VV].v.hi) : 1;
    const double wx = fabs(x[X].v.hi), wy = fabs(x[Y].v.hi);
    if (!is_known(x[X], cylint_larger(wx, wy / scale)))
        return 0;
    return x[X].v.hi > 0 ? has_digits(q, x[Y])
                         : is_known(x[Y], cylint_larger(wy, wx * scale));
}

/* In pairs, with the line's origin moved to the hit, if that lies in the
 * window in which bounded_pair_error() holds.  Returns the needed facts that have
 * too few digits. */
static unsigned facts_in_pairs(cylint_query *q, bounded_pair t, unsigned need,
                               floating *facts)
{
    cylint_terms_pair *L = cylint_load_pairs(q);
    bounded_pair kept[3], x[FACTS];
    const int in_window = cylint_move_origin(L, 0, t, kept);
    if (in_window)
        facts_of(q, L, need, x);
    cylint_restore_origin(L, 0, kept);
    if (!in_window)
        return need;
    unsigned done = 0;
    for (int i = 0; i < FACTS; i++)
        if (need >> i & 1) {
            facts[i] = (floating){x[i].v, 0};
            if (i < HEIGHT)
                done |= (unsigned)has_digits(q, x[i]) << i;
        }
    if ((need & NEED_Z) && has_digits(q, x[HEIGHT]) &&
        has_digits(q, x[HEIGHT_UNIT]))
        done |= NEED_Z;
    if ((need & NEED_PHI) && angle_has_digits(q, x))
        done |= NEED_PHI;
    return need & ~done;
}

/* A fact of the point that D[0] leads to. */
static exact fact_exact(const cylint_query *q, const cylint_terms_exact *L,
                        int i)
{
    exact x, y;
    if (i < AXIAL)
        return cylint_gradient_exact(L, i);
    if (i < AXIS)
        return cylint_axial_exact(L)[i - AXIAL];
    if (i < HEIGHT)
        return L->w[i - AXIS];
    if (i == HEIGHT)
        return cylint_form_height_exact(L, cylint_is_reversed(q->shape));
    if (i == HEIGHT_UNIT || i == VV)
        return cylint_form_height_unit_exact(L);
    cylint_about_axis_exact(L, cylint_least_axis_component(q->shape), &x, &y);
    if (cylint_is_reversed(q->shape))
        x = cylint_exact_neg(x);
    return i == X ? x : y;
}

/* Every fact is affine in the point: its values at o and at o + d give it
 * along the line. */
static void facts_in_full(cylint_query *q, surd *t, unsigned need,
                          floating *facts)
{
    cylint_arena *arena = &q->arena;
    const int used = arena->used;
    cylint_terms_exact at_o = *cylint_load_exact_moments(q), beyond = at_o;
    for (int i = 0; i < 3; i++)
        beyond.D[0][i] = cylint_exact_add(arena, at_o.D[0][i], at_o.u[i]);
    for (int i = 0; i < FACTS; i++) {
        const int kept = arena->used;
        if (!(need >> i & 1))
            continue;
        const exact f0 = fact_exact(q, &at_o, i);
        const exact f1 = cylint_exact_add(arena, fact_exact(q, &beyond, i),
                                          cylint_exact_neg(f0));
        facts[i] = cylint_value_at(q, t, f0, f1);
        arena->used = kept;
    }
    arena->used = used;
}

/* ------------------------------------------------------------- point --- */

/* Coordinate i of all points of a cap whose plane is perpendicular to that
 * coordinate's direction. */
static int cap_coordinate(const cylint_shape *s, int cap, int i, double *x)
{
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const int level =
        cylint_is_elliptic(s->kind)
            ? !cylint_sign(cylint_a(s)[i]) && !cylint_sign(cylint_b(s)[i])
            : !cylint_sign(cylint_axis(s)[j]) &&
                  !cylint_sign(cylint_axis(s)[k]);
    if (level)
        *x = cylint_end_center(s, cap, i);
    return level;
}

/* The coordinates that do not depend on t; returns the bits of the others. */
static unsigned fixed_coordinates(const cylint_query *q, cylint_root root,
                                  double point[3])
{
    const cylint_line *l = q->line;
    unsigned left = 0;
    for (int i = 0; i < 3; i++) {
        if (!cylint_sign(l->d[i]) && !cylint_sign(l->d_lo[i]))
            point[i] = l->o[i];
        else if (!is_on_cap(q, root) ||
                 !cap_coordinate(q->shape, root == ROOT_CAP1, i, &point[i]))
            left |= 1u << i;
        point[i] = cylint_positive_zero(point[i]);
    }
    return left;
}

/* o + t d in pairs; returns the bits of coordinates with too few digits. */
static unsigned coordinates_in_pairs(const cylint_query *q, bounded_pair t,
                                     unsigned left, double point[3])
{
    const cylint_line *l = q->line;
    const double t_error = CYLINT_PAIR_UNIT * t.error;
    for (int i = 0; i < 3; i++) {
        if (!(left >> i & 1))
            continue;
        const pair step = pair_mul(t.v, (pair){l->d[i], l->d_lo[i]});
        const pair x = pair_add((pair){l->o[i], 0}, step);
        const double sizes = fabs(l->o[i]) + 2 * fabs(step.hi);
        const double error = CYLINT_PAIR_UNIT * sizes +
                             t_error * fabs(l->d[i]) + CYLINT_UNDERFLOW;
        point[i] = cylint_positive_zero(x.hi);
        left &= ~((unsigned)(fabs(x.hi) > CYLINT_DIGITS * error) << i);
    }
    return left;
}

static void coordinates_in_full(cylint_query *q, surd *t, unsigned left,
                                double point[3])
{
    const cylint_terms_exact *L = cylint_load_exact(q);
    for (int i = 0; i < 3; i++) {
        const int used = q->arena.used;
        if (!(left >> i & 1))
            continue;
        const exact o = cylint_exact_from(&q->arena, q->line->o[i]);
        point[i] =
            cylint_positive_zero(rounded(cylint_value_at(q, t, o, L->u[i])));
        q->arena.used = used;
    }
}

/* -------------------------------------------------------- description -- */

/* The axis's direction or its opposite. */
static int apex_sign(cylint_query *q)
{
    const int along = q->ends == CYLINT_ENDS_INFINITE
                          ? cylint_form_sign(q, FORM_ALONG, 0)
                          : 0;
    return cylint_apex_normal_sign(q->shape, along);
}

static double z_of(const floating *facts)
{
    const floating height = facts[HEIGHT], unit = facts[HEIGHT_UNIT];
    return cylint_positive_zero(
        cylint_scaled(pair_div(height.v, unit.v).hi, height.e - unit.e));
}

static void write_facts(cylint_query *q, const floating *facts,
                        cylint_root root, int part, int apex, unsigned want,
                        cylint_hit *hit)
{
    if (want & CYLINT_WANT_NORMAL) {
        if (!is_curved(q, part))
            write_unit_vector(facts + AXIAL, part == CYLINT_PART_CAP1 ? 1 : -1,
                              hit->normal);
        else if (apex)
            write_unit_vector(facts + AXIS, apex_sign(q), hit->normal);
        else
            write_unit_vector(facts + GRADIENT, 1, hit->normal);
    }
    if (want & CYLINT_WANT_Z)
        hit->z = is_on_cap(q, root)             ? root == ROOT_CAP1
                 : cylint_has_no_axis(q->shape) ? 0
                                                : z_of(facts);
    if (want & CYLINT_WANT_PHI) {
        if (apex || cylint_has_no_axis(q->shape)) {
            hit->phi = 0;
            return;
        }
        floating x = facts[X], y = facts[Y], vv = facts[VV];
        if (!cylint_is_elliptic(q->kind)) {
            const floating size = cylint_floating_sqrt(vv);
            x.v = pair_mul(x.v, size.v);
            x.e += size.e;
        } else if (cylint_left_handed(q->shape)) {
            y.v = pair_neg(y.v);
        }
        hit->phi = turns(y, x);
    }
}

/* What is still needed of a hit, as bits of coordinates of the point and of
 * facts; and the facts so far. */
typedef struct {
    unsigned left, need;
    floating facts[FACTS];
} description;

static int is_complete(const description *x)
{
    return !x->left && !x->need;
}

static void describe_in_pairs(cylint_query *q, bounded_pair t, description *x,
                              double point[3])
{
    if (x->left)
        x->left = coordinates_in_pairs(q, t, x->left, point);
    if (x->need)
        x->need = facts_in_pairs(q, t, x->need, x->facts);
}

static void describe_in_full(cylint_query *q, cylint_root root, description *x,
                             double point[3])
{
    const int used = cylint_exact_mark(q, root);
    surd t = cylint_surd(q, root);
    coordinates_in_full(q, &t, x->left, point);
    facts_in_full(q, &t, x->need, x->facts);
    q->arena.used = used;
}

/* Whether pairs are of use: data in the window, of which none was scaled, and
 * a root whose rest is a normal number too; or 0. */
static int has_pairs(const cylint_query *q, double t)
{
    return q->pairs && q->near_shape == q->shape &&
           fabs(t) < CYLINT_REST_MOST &&
           (fabs(t) > CYLINT_REST_LEAST || cylint_sign(t) == 0);
}

/* So far away that the canonical root would leave the facts too few digits. */
static int is_far(const cylint_query *q, double t)
{
    const cylint_shape *s = q->shape;
    double size = cylint_axis_size(s);
    if (!cylint_has_factors(s->kind))
        size = cylint_larger(size, cylint_larger(cylint_r0(s), cylint_r1(s)));
    return fabs(t) * q->line->size > CYLINT_REST_FAR * size;
}

void cylint_describe_hit(cylint_query *q, cylint_root root, double t,
                         double more, double error, int part, int apex,
                         unsigned want, cylint_hit *hit)
{
    description x;
    x.left =
        want & CYLINT_WANT_POINT ? fixed_coordinates(q, root, hit->point) : 0;
    x.need = needs_of(q, want, root, part, apex);
    if (!is_complete(&x) && has_pairs(q, t)) {
        bounded_pair at = cylint_canonical_root(q, root, t, more, error);
        if (!is_far(q, t))
            describe_in_pairs(q, at, &x, hit->point);
        /* a rest of 0 is often all of it: a better root would not help */
        if (!is_complete(&x) && at.v.lo != 0 &&
            cylint_polish_root(q, root, &at))
            describe_in_pairs(q, at, &x, hit->point);
    }
    if (!is_complete(&x))
        describe_in_full(q, root, &x, hit->point);
    write_facts(q, x.facts, root, part, apex, want, hit);
}
