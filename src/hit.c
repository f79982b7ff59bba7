/*
 * hit.c - what a hit can tell beside t: point, normal, z and angle
 *
 * Everything is computed in pairs of doubles from the root as a pair, so
 * that a far origin or a thin shape costs no digits, and rounded at the end.
 * Where the point's coordinates nearly cancel, or the data are too wild for
 * pairs, the same forms are evaluated in every digit, at a root refined to
 * some 200 bits.
 */
#include "internal.h"

/* An error so many times smaller leaves 54 bits. */
#define ENOUGH 0x1p54

#define UNDERFLOWS (CYLINT_UNDERFLOW * 0x1p60)

/* A value with a binary exponent of its own. */
typedef struct {
    pair v;
    int e;
} floating;

static int keeps_digits(wide x, double least)
{
    return cylint_larger(fabs(x.v.hi), least) >
           ENOUGH * wide_error(x) + UNDERFLOWS;
}

static floating floating_of_wide(wide x)
{
    return (floating){x.v, 0};
}

static floating floating_of_exact(exact x)
{
    floating f = {{0, 0}, 0};
    if (x.sign != 0)
        f.v = cylint_exact_round(x, &f.e);
    return f;
}

static double rounded(floating x)
{
    return cylint_scaled(x.v.hi, x.e);
}

static void normalise(const floating x[3], int sign, double to[3])
{
    int most = 0;
    for (int i = 1; i < 3; i++)
        if (x[most].v.hi == 0 || (x[i].v.hi != 0 &&
            x[i].e + cylint_exponent(x[i].v.hi) >
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
    double phi = atan2(cylint_scaled(y.v.hi, y.e - e),
                       cylint_scaled(x.v.hi, x.e - e)) / (2 * pi);
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
enum { GRADIENT = 0, AXIAL = 3, AXIS = 6, ALPHA = 9, ALPHA_AT_TOP,
       X = 11, Y, VV, FACTS };

/* Groups of facts that are still needed.  Each is found as if it were alone,
 * so that no answer depends on what else is wanted. */
typedef struct {
    int gradient, axial, axis, z, phi;
} needs;

static needs needs_of(unsigned want, int part, int apex)
{
    const int normal = (want & CYLINT_WANT_NORMAL) != 0;
    const int lateral = part == CYLINT_LATERAL;
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

static int z_in_pairs(const letters_wide *L, floating *facts)
{
    const wide alpha = form_alpha_wide(L, 0), top = form_root_of_S_wide(L);
    facts[ALPHA] = floating_of_wide(alpha);
    facts[ALPHA_AT_TOP] = floating_of_wide(top);
    return keeps_digits(alpha, fabs(top.v.hi));
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
    return keeps_digits(x, wy / scale) &&
           keeps_digits(y, wx * scale);
}

/* In pairs; what that would leave with too few digits is needed still. */
static void facts_in_pairs(cylint_query *q, pair t, needs *need,
                           floating *facts)
{
    if (!q->filters || q->near_shape != q->shape)
        return;
    letters_wide *L = cylint_wide(q);
    const wide at = {t, q->t_error / CYLINT_PAIR_ROUNDING * fabs(t.hi)};
    wide kept[3];
    for (int i = 0; i < 3; i++) {
        kept[i] = L->D[0][i];
        L->D[0][i] = wide_add(kept[i], wide_mul(at, L->u[i]));
    }
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
    for (int i = 0; i < 3; i++)
        L->D[0][i] = kept[i];
}

/* The hit's point as every digit has it. */
static void exact_point(cylint_query *q, exact t, double point[3])
{
    const letters_exact *L = cylint_exact(q);
    for (int i = 0; i < 3; i++) {
        const exact o = cylint_exact_from(&q->arena, q->line->o[i]);
        point[i] = rounded(floating_of_exact(cylint_exact_add(&q->arena, o,
                       cylint_exact_mul(&q->arena, t, L->u[i])))) + 0;
    }
}

/* beta D - alpha u, the direction from the base's centre to where the line
 * pierces a cap's plane: x and y without any error, times |beta|. */
static void about_axis_in_plane(cylint_query *q, int cap, exact *x, exact *y)
{
    letters_exact L = *cylint_exact(q);
    exact alpha = form_alpha_exact(&L, cap), beta = L.beta;
    alpha.sign *= beta.sign;
    beta.sign *= beta.sign;
    for (int i = 0; i < 3; i++)
        L.D[0][i] = cylint_exact_add(L.arena,
            cylint_exact_mul(L.arena, beta, L.D[cap][i]), cylint_exact_neg(
            cylint_exact_mul(L.arena, alpha, L.u[i])));
    about_axis_exact(&L, least_component(q), x, y);
}

static int is_needed(const needs *need, int fact)
{
    return fact < AXIAL ? need->gradient : fact < AXIS ? need->axial
         : fact < ALPHA ? need->axis : fact < X ? need->z : need->phi;
}

static void facts_in_full(cylint_query *q, cylint_root root, exact t,
                          const needs *need, floating *facts)
{
    letters_exact L = *cylint_exact_line(q);
    for (int i = 0; i < 3; i++)
        L.D[0][i] = cylint_exact_add(L.arena, L.D[0][i],
                                     cylint_exact_mul(L.arena, t, L.u[i]));
    for (int i = 0; i < FACTS; i++) {
        const int used = L.arena->used;
        exact x, y;
        if (!is_needed(need, i))
            continue;
        if (i < AXIAL)
            x = gradient_exact(&L, i);
        else if (i < ALPHA)
            x = i < AXIS ? axial_exact(&L)[i - AXIAL] : L.w[i - AXIS];
        else if (i == ALPHA)
            x = form_alpha_exact(&L, 0);
        else if (i == ALPHA_AT_TOP || i == VV)
            x = form_root_of_S_exact(&L);
        else if (root == ROOT_CAP0 || root == ROOT_CAP1)
            about_axis_in_plane(q, root == ROOT_CAP1, &x, &y);
        else
            about_axis_exact(&L, least_component(q), &x, &y);
        facts[i] = floating_of_exact(i == Y ? y : x);
        L.arena->used = used;
    }
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
    if (q->ends != CYLINT_INFINITE)
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
        if (part != CYLINT_LATERAL)
            normalise(facts + AXIAL, part == CYLINT_CAP1 ? 1 : -1, hit->normal);
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
                             facts[ALPHA].e - facts[ALPHA_AT_TOP].e) + 0;
    }
    if (want & CYLINT_WANT_PHI) {
        if (apex) {
            hit->phi = 0;
            return;
        }
        floating x = facts[X], y = facts[Y], vv = facts[VV];
        if (q->kind < CYLINT_KIND_ECYLINDER) {
            const int odd = vv.e & 1;
            const pair even = {vv.v.hi * (odd ? 2 : 1),
                               vv.v.lo * (odd ? 2 : 1)};
            x.v = pair_mul(x.v, pair_sqrt(even));
            x.e += (vv.e - odd) / 2;
        } else if (q->shape->flip) {
            y.v = pair_neg(y.v);
        }
        hit->phi = turns(y, x);
    }
}

void cylint_describe_hit(cylint_query *q, cylint_root root, double t,
                         double more, int part, int apex, unsigned want,
                         cylint_hit *hit)
{
    needs need = needs_of(want, part, apex);
    floating facts[FACTS];
    int point = (want & CYLINT_WANT_POINT) != 0; /* needed still */
    /* a root beyond the doubles is found again from the largest */
    pair at = fabs(t) <= DBL_MAX ? fast_two_sum(t, more)
                                 : (pair){copysign(DBL_MAX, t), 0};
    if (point)
        point = !point_in_pairs(q, at, hit->point);
    if (any_need(&need))
        facts_in_pairs(q, at, &need, facts);
    if ((point || any_need(&need)) && q->t_error > CYLINT_PAIR_ROUNDING) {
        /* once more, from a root as good as pairs can be */
        cylint_polish_root(q, root, &at);
        if (point)
            point = !point_in_pairs(q, at, hit->point);
        if (any_need(&need))
            facts_in_pairs(q, at, &need, facts);
    }
    if (point || any_need(&need)) {
        const int used = cylint_exact_mark(q, root);
        const exact full = cylint_root_in_full(q, root, at);
        if (point)
            exact_point(q, full, hit->point);
        facts_in_full(q, root, full, &need, facts);
        q->arena.used = used;
    }
    describe(q, facts, root, part, apex, want, hit);
}
