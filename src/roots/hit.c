/*
 * hit.c - what a hit can tell beside t: point, normal, z and angle
 *
 * Everything is computed in pairs of doubles from the root as a pair, so
 * that a far origin or a thin shape costs no digits, and rounded at the end.
 * Where the point's coordinates nearly cancel, or the data are too wild for
 * pairs, the same forms are evaluated in every digit, and at the root by
 * surd.c, which loses none of them.
 */
#include "roots.h"

/* An error so many times smaller leaves 54 bits. */
#define ENOUGH 0x1p54

#define UNDERFLOWS (CYLINT_UNDERFLOW * 0x1p60)

static int keeps_digits(wide x, double least)
{
    return cylint_larger(fabs(x.v.hi), least) >
           ENOUGH * wide_error(x) + UNDERFLOWS;
}

static floating floating_of_wide(wide x)
{
    return (floating){x.v, 0};
}

static double rounded(floating x)
{
    return cylint_scaled(x.v.hi, x.e);
}

static void normalise(const floating x[3], int sign, double to[3])
{
    int most = 0;
    for (int i = 1; i < 3; i++)
        if (x[most].v.hi == 0 ||
            (x[i].v.hi != 0 && x[i].e + cylint_exponent(x[i].v.hi) >
                                   x[most].e + cylint_exponent(x[most].v.hi)))
            most = i;
    const int e = x[most].e + cylint_exponent(x[most].v.hi);
    double y[3];
    for (int i = 0; i < 3; i++)
        y[i] = cylint_scaled(x[i].v.hi, x[i].e - e);
    const double size = sqrt(y[0] * y[0] + y[1] * y[1] + y[2] * y[2]);
    for (int i = 0; i < 3; i++)
        to[i] = sign * y[i] / size + 0; /* no -0 */
}

/* atan2(y, x) over 2 pi, in [0, 1). */
static double turns(floating y, floating x)
{
    const double pi = 3.14159265358979323846;
    if (y.v.hi == 0 && x.v.hi == 0)
        return 0;
    const int e = x.v.hi == 0 || (y.v.hi != 0 && y.e > x.e) ? y.e : x.e;
    double phi =
        atan2(cylint_scaled(y.v.hi, y.e - e), cylint_scaled(x.v.hi, x.e - e)) /
        (2 * pi);
    if (phi < 0)
        phi += 1;
    return phi < 1 ? phi + 0 : 0;
}

/* |x| < |y|. */
static int smaller(pair x, pair y)
{
    const double xh = fabs(x.hi), yh = fabs(y.hi);
    if (xh != yh)
        return cylint_less(xh, yh);
    return cylint_less(cylint_sign(x.hi) < 0 ? -x.lo : x.lo,
                       cylint_sign(y.hi) < 0 ? -y.lo : y.lo);
}

/* The coordinate along which the axis has its smallest component. */
static int least_component(const cylint_query *q)
{
    const cylint_shape *s = q->shape;
    double hi[3], lo[3];
    for (int i = 0; i < 3; i++) {
        hi[i] = s->axis[i];
        lo[i] = s->axis_lo[i];
    }
    if (!(cylint_largest(hi) <= DBL_MAX))
        cylint_scaled_difference(hi, lo, s->top, s->base, -2);
    int least = 0;
    for (int i = 1; i < 3; i++)
        if (smaller((pair){hi[i], lo[i]}, (pair){hi[least], lo[least]}))
            least = i;
    return least;
}

/* What the hit's letters give. */
enum {
    GRADIENT = 0,
    AXIAL = 3,
    AXIS = 6,
    ALPHA = 9,
    ALPHA_AT_TOP,
    X = 11,
    Y,
    VV,
    FACTS
};

/* Groups of facts that are still needed.  Each is found as if it were alone,
 * so that no answer depends on what else is wanted. */
typedef struct {
    int gradient, axial, axis, z, phi;
} needs;

static needs needs_of(unsigned want, int part, int apex)
{
    const int normal = (want & CYLINT_WANT_NORMAL) != 0;
    const int lateral = part == CYLINT_PART_LATERAL;
    return (needs){normal && lateral && !apex, normal && !lateral,
                   normal && lateral && apex, (want & CYLINT_WANT_Z) != 0,
                   (want & CYLINT_WANT_PHI) != 0 && !apex};
}

static int any_need(const needs *n)
{
    return n->gradient || n->axial || n->axis || n->z || n->phi;
}

/* A direction: each component beside the largest. */
static int vector_in_pairs(const wide x[3], floating *facts)
{
    double most = 0;
    int keeps = 1;
    for (int i = 0; i < 3; i++) {
        most = cylint_larger(most, fabs(x[i].v.hi));
        facts[i] = floating_of_wide(x[i]);
    }
    for (int i = 0; i < 3; i++)
        keeps &= keeps_digits(x[i], most);
    return keeps;
}

static int gradient_in_pairs(const letters_wide *L, floating *facts)
{
    wide x[3];
    for (int i = 0; i < 3; i++)
        x[i] = gradient_wide(L, i);
    return vector_in_pairs(x, facts);
}

/* The quotient of two; the point may be near, the base's vectors be nearly
 * dependent, so that each must have its own digits. */
static int z_in_pairs(const letters_wide *L, floating *facts)
{
    const wide alpha = form_alpha_wide(L, 0), top = form_root_of_S_wide(L);
    facts[ALPHA] = floating_of_wide(alpha);
    facts[ALPHA_AT_TOP] = floating_of_wide(top);
    return keeps_digits(alpha, fabs(top.v.hi)) && keeps_digits(top, 0);
}

static int angle_in_pairs(const cylint_query *q, const letters_wide *L,
                          floating *facts)
{
    wide x, y;
    const wide vv = form_root_of_S_wide(L);
    about_axis_wide(L, least_component(q), &x, &y);
    facts[X] = floating_of_wide(x);
    facts[Y] = floating_of_wide(y);
    facts[VV] = floating_of_wide(vv);
    const double wx = fabs(x.v.hi), wy = fabs(y.v.hi);
    const double scale = q->kind < CYLINT_KIND_ECYLINDER ? sqrt(vv.v.hi) : 1;
    return keeps_digits(x, wy / scale) && keeps_digits(y, wx * scale);
}

static void facts_of(const cylint_query *q, const letters_wide *L, needs *need,
                     floating *facts)
{
    if (need->axial)
        need->axial = !vector_in_pairs(axial_wide(L), facts + AXIAL);
    if (need->axis)
        need->axis = !vector_in_pairs(L->w, facts + AXIS);
    if (need->gradient)
        need->gradient = !gradient_in_pairs(L, facts + GRADIENT);
    if (need->z)
        need->z = !z_in_pairs(L, facts);
    if (need->phi)
        need->phi = !angle_in_pairs(q, L, facts);
}

/* In pairs, the line's origin moved to the hit.  What that would leave with
 * too few digits is needed still, and all of a hit so far away that what
 * underflows counts for more than wide_error() has for it. */
static void facts_in_pairs(cylint_query *q, pair t, needs *need,
                           floating *facts)
{
    if (!q->filters || q->near_shape != q->shape)
        return;
    letters_wide *L = cylint_wide(q);
    const wide at = {t, q->t_error / CYLINT_PAIR_ROUNDING * fabs(t.hi)};
    wide kept[3];
    int in_window = 1;
    for (int i = 0; i < 3; i++) {
        kept[i] = L->D[0][i];
        L->D[0][i] = wide_add(kept[i], wide_mul(at, L->u[i]));
        in_window &= fabs(L->D[0][i].v.hi) <= CYLINT_WINDOW;
    }
    if (in_window)
        facts_of(q, L, need, facts);
    for (int i = 0; i < 3; i++)
        L->D[0][i] = kept[i];
}

/* The hit's point as every digit has it. */
static void point_in_full(cylint_query *q, surd *t, double point[3])
{
    const letters_exact *L = cylint_exact(q);
    for (int i = 0; i < 3; i++) {
        const int used = q->arena.used;
        const exact o = cylint_exact_from(&q->arena, q->line->o[i]);
        point[i] = rounded(cylint_value_at(q, t, o, L->u[i])) + 0;
        q->arena.used = used;
    }
}

static int is_needed(const needs *need, int fact)
{
    return fact < AXIAL   ? need->gradient
           : fact < AXIS  ? need->axial
           : fact < ALPHA ? need->axis
           : fact < X     ? need->z
                          : need->phi;
}

/* A fact of the point that D[0] leads to. */
static exact fact_exact(const cylint_query *q, const letters_exact *L, int i)
{
    exact x, y;
    if (i < AXIAL)
        return gradient_exact(L, i);
    if (i < AXIS)
        return axial_exact(L)[i - AXIAL];
    if (i < ALPHA)
        return L->w[i - AXIS];
    if (i == ALPHA)
        return form_alpha_exact(L, 0);
    if (i == ALPHA_AT_TOP || i == VV)
        return form_root_of_S_exact(L);
    about_axis_exact(L, least_component(q), &x, &y);
    return i == X ? x : y;
}

/* Every fact is affine in the point, so that o and o + d tell it all along
 * the line. */
static void facts_in_full(cylint_query *q, surd *t, const needs *need,
                          floating *facts)
{
    cylint_arena *arena = &q->arena;
    const int used = arena->used;
    letters_exact at_o = *cylint_exact_line(q), beyond = at_o;
    for (int i = 0; i < 3; i++)
        beyond.D[0][i] = cylint_exact_add(arena, at_o.D[0][i], at_o.u[i]);
    for (int i = 0; i < FACTS; i++) {
        const int kept = arena->used;
        if (!is_needed(need, i))
            continue;
        const exact f0 = fact_exact(q, &at_o, i);
        const exact f1 = cylint_exact_add(arena, fact_exact(q, &beyond, i),
                                          cylint_exact_neg(f0));
        facts[i] = cylint_value_at(q, t, f0, f1);
        arena->used = kept;
    }
    arena->used = used;
}

/* o + t d in pairs; 0 where that would leave too few digits. */
static int point_in_pairs(const cylint_query *q, pair t, double point[3])
{
    const cylint_line *l = q->line;
    if (!q->filters || q->near_shape != q->shape || !(fabs(t.hi) > 0x1p-900))
        return 0;
    double from = 0, size = 0;
    for (int i = 0; i < 3; i++) {
        const pair step = pair_mul(t, (pair){l->d[i], l->d_lo[i]});
        point[i] = pair_add((pair){l->o[i], 0}, step).hi;
        from = cylint_larger(from, fabs(l->o[i]) + fabs(step.hi));
        size = cylint_larger(size, fabs(point[i]));
    }
    return size > ENOUGH * (2 * CYLINT_PAIR_ROUNDING + q->t_error) * from;
}

/* Away from the solid; at a double cone's apex against the line. */
static int apex_sign(cylint_query *q)
{
    const int grows = cylint_sign(q->shape->dr);
    if (q->ends != CYLINT_ENDS_INFINITE)
        return -grows;
    const int along = cylint_sign_along(q);
    if (along == 0) /* towards the base, if that is not the apex itself */
        return cylint_sign(q->shape->r0) == 0 ? -1 : grows;
    return -along;
}

static void describe(cylint_query *q, const floating *facts, cylint_root root,
                     int part, int apex, unsigned want, cylint_hit *hit)
{
    if (want & CYLINT_WANT_NORMAL) {
        if (part != CYLINT_PART_LATERAL)
            normalise(facts + AXIAL, part == CYLINT_PART_CAP1 ? 1 : -1,
                      hit->normal);
        else if (apex)
            normalise(facts + AXIS, apex_sign(q), hit->normal);
        else
            normalise(facts + GRADIENT, 1, hit->normal);
    }
    if (want & CYLINT_WANT_Z) {
        const int known = root == ROOT_CAP0 || root == ROOT_CAP1;
        hit->z = known ? root == ROOT_CAP1
                       : cylint_scaled(
                             pair_div(facts[ALPHA].v, facts[ALPHA_AT_TOP].v).hi,
                             facts[ALPHA].e - facts[ALPHA_AT_TOP].e) +
                             0;
    }
    if (want & CYLINT_WANT_PHI) {
        if (apex) {
            hit->phi = 0;
            return;
        }
        floating x = facts[X], y = facts[Y], vv = facts[VV];
        if (q->kind < CYLINT_KIND_ECYLINDER) {
            const floating size = cylint_floating_sqrt(vv);
            x.v = pair_mul(x.v, size.v);
            x.e += size.e;
        } else if (q->shape->flip) {
            y.v = pair_neg(y.v);
        }
        hit->phi = turns(y, x);
    }
}

/* What a hit can tell, and what of it is still needed. */
typedef struct {
    int point;
    needs need;
    floating facts[FACTS];
} told;

static int is_told(const told *x)
{
    return !x->point && !any_need(&x->need);
}

static void tell_in_pairs(cylint_query *q, pair t, told *x, double point[3])
{
    if (x->point)
        x->point = !point_in_pairs(q, t, point);
    if (any_need(&x->need))
        facts_in_pairs(q, t, &x->need, x->facts);
}

static void tell_in_full(cylint_query *q, cylint_root root, told *x,
                         double point[3])
{
    const int used = cylint_exact_mark(q, root);
    surd t = cylint_surd(q, root);
    if (x->point)
        point_in_full(q, &t, point);
    facts_in_full(q, &t, &x->need, x->facts);
    q->arena.used = used;
}

void cylint_describe_hit(cylint_query *q, cylint_root root, double t,
                         double more, int part, int apex, unsigned want,
                         cylint_hit *hit)
{
    told x;
    x.point = (want & CYLINT_WANT_POINT) != 0;
    x.need = needs_of(want, part, apex);
    if (fabs(t) <= DBL_MAX) {
        pair at = fast_two_sum(t, more);
        tell_in_pairs(q, at, &x, hit->point);
        if (!is_told(&x) && q->t_error > CYLINT_PAIR_ROUNDING) {
            /* once more, from a root as good as pairs can be */
            cylint_polish_root(q, root, &at);
            tell_in_pairs(q, at, &x, hit->point);
        }
    }
    if (!is_told(&x))
        tell_in_full(q, root, &x, hit->point);
    describe(q, x.facts, root, part, apex, want, hit);
}
