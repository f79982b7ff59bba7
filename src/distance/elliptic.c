/*
 * elliptic.c - the distance of elliptic kinds
 *
 * The point of the ruling c + u + z v of an angle (elliptic_terms.h) that is
 * nearest to Q has z = E.v / v.v, E = Q - u, and the residual R = E - z v.  The
 * distance |R| is stationary where R.u' = 0.  Times v.v this is a form of cos
 * and sin (critical.h):
 *     E.u' v.v - E.v v.u' = 0.
 * A rim has the points f + e u, where f is the centre of the end and e its
 * factor.  Its R = Q - f - e u is stationary where R.u' = 0, too.  So the nearest
 * point of the surface is one of
 *     the stationary points of the lateral surface, at most 4, within its ends
 *     those of each rim, at most 4
 *     the apex
 *     the foot of the perpendicular on the plane of a cap, within the cap.
 * The residual R of each is computed in triples, and F, the nearest point minus
 * the base, as G + z v, whose exponents can differ much (elliptic_terms.h).
 * The difference of two squares of distances is (F' - F).(R + R').  On one rim,
 * and on the lateral surface of a cylinder, it is proportional to that of the
 * integrals of the form, which has no terms of the size of R: it is better where R
 * is large, the product where R is small.  The first of those that are not farther
 * by more than the rounding errors of that difference is the answer.  At the
 * lateral surface the distance is computed as R.N / |N|, N = u' x v: its relative
 * error is small beside the surface, too.
 */
#include "one_distance.h"

#include "../shapes/shape_facts.h"
#include "../signs/sign.h"
#include "elliptic_terms.h"
#include "nearest.h"

/* The error of a distance relative to the longest length, for shapes with a
 * volume a.(b x h) of at least FLAT of the cube of the longest of a, b and h. */
#define DISTANCE_ERROR 0x1p-80
#define FLAT 0x1p-60

/* The error of a difference of squared distances relative to its terms. */
#define ORDER_ERROR 0x1p-130

/* The error of a component of a residual or normal relative to its terms: a
 * smaller one is 0. */
#define VECTOR_ERROR 0x1p-100

/* A point of the surface. */
typedef struct {
    int feature;     /* CYLINT_NO_FEATURE: none */
    int nappe;       /* the sign of the section's factor there */
    direction at;    /* of lateral surface and rims; else the angle 0 */
    double factor;   /* of u in G; else 0 */
    triple G[3];     /* in the unit of the shape */
    double terms[3]; /* the sizes of the terms of G */
    triple z, zv[3]; /* of the lateral surface, in the unit of Q; else 0 */
    triple R[3];     /* Q - F */
} candidate;

typedef struct {
    elliptic_terms p;
    stationary form[CYLINT_FEATURE_APEX]; /* of lateral surface and rims */
    int inside;                           /* feet beyond the ends serve, too */
    int has_lateral; /* there is a candidate on the lateral surface */
    candidate best;
    triple N[3];   /* its normal, but for the length */
    pair distance; /* of it */
} search;

static double sizes(const triple v[3])
{
    return fabs(v[0].a) + fabs(v[1].a) + fabs(v[2].a);
}

/* -------------------------------------------------------- candidates ---- */

static const direction along_a = {{1, 0, 0}, {0, 0, 0}};

static candidate candidate_of(int feature, double factor, const direction *at)
{
    return (candidate){
        .feature = feature, .nappe = 1, .at = *at, .factor = factor};
}

/* Whether phi of x is less than that of y; both from 0 to a turn.  On the other
 * nappe of a double cone it is half a turn more than the angle of the ruling. */
static int is_before(const candidate *x, const candidate *y)
{
    const double cos_x = x->nappe * x->at.cos.a, sin_x = x->nappe * x->at.sin.a;
    const double cos_y = y->nappe * y->at.cos.a, sin_y = y->nappe * y->at.sin.a;
    if ((sin_x < 0) != (sin_y < 0))
        return sin_y < 0;
    return sin_x < 0 ? cos_x < cos_y : cos_x > cos_y;
}

static int sign_beyond(double x, double error)
{
    return fabs(x) <= error ? 0 : x < 0 ? -1 : 1;
}

/* -1: x is nearer than the best so far, 1: it is farther, 0: the difference of
 * their distances is not certain. */
static int compare(const search *s, const candidate *x)
{
    const candidate *best = &s->best;
    triple between[3], sum[3];
    double error = 0;
    if (x->feature == best->feature &&
        (x->feature != CYLINT_FEATURE_LATERAL || s->p.k1.a == 0)) {
        /* half of the difference of the squares */
        const stationary *form = &s->form[x->feature];
        const triple more =
            triple_sub(integral_at(form, &best->at), integral_at(form, &x->at));
        const int order =
            sign_beyond(triple_value(more), ORDER_ERROR * form->terms);
        if (order != 0)
            return order;
    }
    for (int i = 0; i < 3; i++) {
        between[i] =
            triple_add(triple_scale(triple_sub(best->G[i], x->G[i]), s->p.near),
                       triple_sub(best->zv[i], x->zv[i]));
        sum[i] = triple_add(best->R[i], x->R[i]);
        error += (s->p.near * (best->terms[i] + x->terms[i]) +
                  fabs(best->zv[i].a) + fabs(x->zv[i].a)) *
                 (fabs(best->R[i].a) + fabs(x->R[i].a));
    }
    return sign_beyond(triple_value(triple_dot(between, sum)),
                       ORDER_ERROR * error);
}

/* Accepts a candidate if it is nearer than all before, or as near and of an
 * earlier part, of the nappe of the base, or of smaller phi. */
static void offer(search *s, const candidate *x)
{
    const candidate *best = &s->best;
    if (!(sizes(x->R) <= DBL_MAX))
        return;
    const int part = cylint_feature_part(x->feature),
              best_part = cylint_feature_part(best->feature);
    const int order = best->feature == CYLINT_NO_FEATURE ? -1 : compare(s, x);
    const int is_earlier = part != best_part             ? part < best_part
                           : x->feature != best->feature ? 0
                           : x->nappe != best->nappe     ? x->nappe > 0
                                                         : is_before(x, best);
    if (order < 0 || (order == 0 && is_earlier))
        s->best = *x;
}

/* G = centre of the end + u p + v q, R = Q - G - z v. */
static void place(const search *s, candidate *x, const triple u[3], triple p,
                  const triple v[3], triple q)
{
    const int end = cylint_feature_end(x->feature);
    for (int i = 0; i < 3; i++) {
        const triple up = triple_mul(u[i], p), vq = triple_mul(v[i], q);
        const triple from = triple_add(up, vq);
        x->G[i] = end ? triple_add(s->p.h[i], from) : from;
        x->terms[i] = (end ? fabs(s->p.h[i].a) : 0) + fabs(up.a) + fabs(vq.a);
        x->R[i] = triple_sub(
            triple_sub(s->p.Q[i], triple_scale(x->G[i], s->p.near)), x->zv[i]);
    }
}

/* Whether the lateral surface has the point z of a ruling.  z and rho, which
 * is 1 + k1 z, are in the unit of Q. */
static int is_within(const search *s, triple z, double rho)
{
    if (rho < 0 && s->p.shape->ends != CYLINT_ENDS_INFINITE)
        return 0;
    if (s->inside)
        return 1;
    if (cylint_is_bounded(s->p.shape))
        return z.a > 0 && triple_value(triple_sub(z, triple_of(s->p.near))) < 0;
    return rho != 0;
}

static void try_lateral(search *s, const direction *at)
{
    ruling r;
    triple E[3];
    candidate x = candidate_of(CYLINT_FEATURE_LATERAL, 1, at);
    load_ruling(&r, s->p.a, s->p.b, s->p.g, s->p.k1, at);
    for (int i = 0; i < 3; i++)
        E[i] = triple_sub(s->p.Q[i], triple_scale(r.u[i], s->p.near));
    x.z = triple_div(triple_dot(E, r.v), triple_dot(r.v, r.v));
    const double rho = triple_value(
        triple_add(triple_of(s->p.near), triple_mul(s->p.k1, x.z)));
    x.nappe = rho < 0 ? -1 : 1;
    if (!is_within(s, triple_scale(x.z, s->p.stretch), rho))
        return;
    for (int i = 0; i < 3; i++)
        x.zv[i] = triple_mul(x.z, r.v[i]);
    s->has_lateral = 1;
    place(s, &x, s->p.a, at->cos, s->p.b, at->sin);
    offer(s, &x);
}

static void try_rim(search *s, int end, const direction *at)
{
    const double factor = cylint_end_factor(s->p.shape, end);
    candidate x = candidate_of(CYLINT_FEATURE_RIM0 + end, factor, at);
    place(s, &x, s->p.a, triple_times(at->cos, factor), s->p.b,
          triple_times(at->sin, factor));
    offer(s, &x);
}

/* The apex is at h share. */
static void try_apex(search *s, const triple h[3], triple share)
{
    candidate x = candidate_of(CYLINT_FEATURE_APEX, 0, &along_a);
    place(s, &x, h, share, h, triple_of(0));
    offer(s, &x);
}

/* to = u x v, times a power of two. */
static void cross_units(triple to[3], const triple u[3], const triple v[3])
{
    triple x[3], y[3], z[3];
    triple_unit(x, u);
    triple_unit(y, v);
    triple_cross(z, x, y);
    triple_unit(to, z);
}

/* The perpendicular on the plane of an end has the foot x a + y b from its
 * centre, x = (from x b).M / M.M and y = (a x from).M / M.M, M = a x b.  `from`
 * is in the unit of Q. */
static void try_cap(search *s, int end)
{
    triple from[3], a[3], b[3], M[3], right[3], up[3];
    candidate c = candidate_of(CYLINT_FEATURE_CAP0 + end, 0, &along_a);
    const triple factor = triple_of(cylint_end_factor(s->p.shape, end));
    const double of_a = triple_unit(a, s->p.a), of_b = triple_unit(b, s->p.b);
    from_end(&s->p, end, from);
    triple_cross(M, a, b);
    triple_cross(right, from, b);
    triple_cross(up, a, from);
    const triple whole = triple_dot(M, M);
    const double unit = 1 / s->p.near;
    const triple x =
        triple_scale(triple_div(triple_dot(right, M), whole), unit);
    const triple y = triple_scale(triple_div(triple_dot(up, M), whole), unit);
    const triple in_a = triple_scale(x, of_a), in_b = triple_scale(y, of_b);
    const triple room = triple_sub(triple_mul(factor, factor),
                                   triple_mul2(in_a, in_a, in_b, in_b));
    if (!s->inside && !(triple_value(room) > 0))
        return;
    place(s, &c, a, x, b, y);
    offer(s, &c);
}

/* --------------------------------------------------- distance and normal -- */

/* |v|.  Where terms have cancelled, v[i].a can be 0 though v[i] is not. */
static pair length_of(const triple v[3])
{
    triple sum[3], unit[3];
    for (int i = 0; i < 3; i++)
        sum[i] = triple_of_pair(pair_of_triple(v[i]));
    const double scale = triple_unit(unit, sum);
    const pair norm = triple_length(unit);
    return (pair){norm.hi / scale, norm.lo / scale};
}

/* |R.N| / |N| */
static pair height_over(const triple R[3], const triple N[3])
{
    triple unit[3];
    triple_unit(unit, N);
    const triple product = triple_dot(R, unit);
    const pair size = fast_two_sum(product.a, product.b);
    return pair_div(size.hi < 0 ? pair_neg(size) : size, triple_length(unit));
}

/* N is u' x v, a x b or the axis, outward. */
static void load_normal(search *s)
{
    ruling r;
    /* mutant '1' -> '2': no effect, unit vectors follow from N */
    const int right = cylint_left_handed(s->p.shape) ? -1 : 1;
    int sign = s->best.nappe * right;
    if (s->best.feature == CYLINT_FEATURE_APEX) {
        triple_unit(s->N, s->p.h);
        sign = cylint_apex_normal_sign(s->p.shape, 0);
    } else if (cylint_is_on_end(s->best.feature)) {
        cross_units(s->N, s->p.a, s->p.b);
        sign = s->best.feature == CYLINT_FEATURE_CAP0 ? -right : right;
    } else {
        load_ruling(&r, s->p.a, s->p.b, s->p.g, s->p.k1, &s->best.at);
        cross_units(s->N, r.du, r.v);
    }
    for (int i = 0; i < 3; i++)
        s->N[i] = triple_scale(s->N[i], sign);
}

/* Normal and distance of the best candidate.  Where exponents differ by more than
 * 900, products underflow: a normal that vanished is replaced by a, b or h. */
static void measure_best(search *s)
{
    if (s->best.feature == CYLINT_NO_FEATURE)
        s->best.feature = CYLINT_FEATURE_LATERAL;
    load_normal(s);
    const double size = sizes(s->N);
    /* untaken 1 of 4: no known direction overflows */
    const int vanished = !(size > 0 && size <= DBL_MAX);
    s->distance = vanished || s->best.feature >= CYLINT_FEATURE_RIM0
                      ? length_of(s->best.R)
                      : height_over(s->best.R, s->N);
    if (vanished)
        triple_unit(s->N, sizes(s->p.a) > 0   ? s->p.a
                          : sizes(s->p.b) > 0 ? s->p.b
                                              : s->p.h);
}

/* Whether there is a point of a cap or of the lateral surface from which the
 * residual points outward. */
static int has_outward(search *s)
{
    if (s->best.feature == CYLINT_NO_FEATURE)
        return 0;
    load_normal(s);
    return triple_value(triple_dot(s->best.R, s->N)) > 0;
}

/* ---------------------------------------------------------- features ---- */

/* The lateral surface or a rim. */
static void search_curve(search *s, int feature)
{
    const int end = cylint_feature_end(feature);
    direction at[MOST_CRITICAL];
    stationary *form = &s->form[feature];
    if (feature == CYLINT_FEATURE_LATERAL)
        lateral_form(&s->p, form);
    else
        rim_form(&s->p, end, form);
    const int n = critical_directions(form, at);
    for (int i = 0; i < n; i++)
        if (feature == CYLINT_FEATURE_LATERAL)
            try_lateral(s, &at[i]);
        else
            try_rim(s, end, &at[i]);
}

/* Rims, and the apex that an end of radius 0 is. */
static void search_ends(search *s)
{
    for (int end = 0; end < 2; end++) {
        if (cylint_sign(cylint_end_factor(s->p.shape, end)) == 0)
            try_apex(s, s->p.h, triple_of(end));
        else
            search_curve(s, CYLINT_FEATURE_RIM0 + end);
    }
}

/*
 * Bounded shapes are convex.  A point outside has one nearest point of the
 * solid: where the solid lies on the inner side of the plane through it that is
 * perpendicular to the residual.  A point inside is never nearest to a rim or
 * an apex of a solid with both caps, because the balls about it that are in the
 * solid do not touch those.  No plane of a cap and no tangent plane of the
 * lateral surface is nearer to it than the surface, so it does not matter whether
 * the foot on such a plane is within the ends.  Next to an apex roundings may
 * put all feet on the other nappe.
 */
static void search_bounded(search *s, int side)
{
    const unsigned caps = cylint_caps_present(s->p.shape->ends);
    for (int end = 0; end < 2; end++)
        if (caps >> end & 1)
            try_cap(s, end);
    if (side < 0 && has_outward(s))
        return;
    search_curve(s, CYLINT_FEATURE_LATERAL);
    if (side < 0 ? has_outward(s) : s->inside && s->has_lateral)
        return;
    search_ends(s);
}

static void search_all(search *s, int side)
{
    if (cylint_is_bounded(s->p.shape)) {
        search_bounded(s, side);
        return;
    }
    search_curve(s, CYLINT_FEATURE_LATERAL);
    if (s->p.k1.a != 0) /* an unbounded cone: its apex is at -h / k1 */
        try_apex(s, s->p.g, triple_div(triple_of(-1), s->p.k1));
}

/* The point is on this feature.  Normals of caps and apex need no angle. */
static void search_feature(search *s, int feature)
{
    s->inside = 1;
    if (!cylint_is_on_end(feature) && feature != CYLINT_FEATURE_APEX)
        search_curve(s, feature);
    s->best.feature = feature;
}

/* ---------------------------------------------------------- the answer -- */

/* The coordinate base + G + z v.  The exponents of the terms can differ by more
 * than the range of doubles.  G_terms and zv_terms: their sizes. */
static double point_of(const search *s, int i, triple zv, double G_terms,
                       double zv_terms)
{
    const int e = s->p.e, far = e + s->p.far;
    const double base = cylint_base(s->p.shape)[i];
    const int of_base = exponent_or_none(base),
              of_G = exponent_or_none(G_terms) + e,
              of_zv = exponent_or_none(zv_terms) + far;
    const int most = of_G > of_zv ? of_G : of_zv,
              unit = of_base > most ? of_base : most;
    const triple c = triple_of(cylint_scaled(base, -unit)),
                 G = triple_scaled(s->best.G[i], e - unit),
                 along = triple_scaled(zv, far - unit);
    const double p = triple_value(triple_add(c, triple_add(G, along)));
    const double terms = fabs(c.a) + cylint_scaled(G_terms, e - unit) +
                         cylint_scaled(zv_terms, far - unit);
    return cylint_scaled(fabs(p) < VECTOR_ERROR * terms ? 0 : p, unit);
}

static void write_elliptic_point(const search *s, int is_on, double to[3])
{
    const elliptic_terms *p = &s->p;
    const candidate *best = &s->best;
    const double turn =
        best->factor > 0 ? direction_error(&s->form[best->feature], &best->at)
                         : 0;
    ruling r;
    const triple z = triple_add(best->z, p->moved);
    const double z_terms = fabs(best->z.a) + fabs(p->moved.a);
    load_ruling(&r, p->a, p->b, p->g, p->k1, &best->at);
    for (int i = 0; i < 3; i++) {
        const double turned = turn * fabs(r.du[i].a);
        const double v_terms =
            fabs(p->g[i].a) + fabs(p->k1.a) * (fabs(r.u[i].a) + turned);
        const double x = is_on
                             ? p->point[i]
                             : point_of(s, i, triple_mul(z, r.v[i]),
                                        best->terms[i] + best->factor * turned,
                                        z_terms * v_terms);
        to[i] = cylint_positive_zero(x);
    }
}

static void write_elliptic_normal(const search *s, double to[3])
{
    triple unit[3];
    triple_unit(unit, s->N);
    const pair norm = triple_length(unit);
    for (int i = 0; i < 3; i++) {
        const double n = pair_div(fast_two_sum(unit[i].a, unit[i].b), norm).hi;
        to[i] = fabs(n) < VECTOR_ERROR ? 0 : n;
    }
}

double cylint_elliptic_distance(const cylint_shape *shape,
                                const double point[3], unsigned want,
                                cylint_closest *answer)
{
    search s;
    const int side = cylint_contains(shape, point);
    load_elliptic(&s.p, shape, point);
    s.best = candidate_of(CYLINT_NO_FEATURE, 0, &along_a); /* the end of a */
    place(&s, &s.best, s.p.a, triple_of(1), s.p.b, triple_of(0));
    /* mutant '0' -> '1': no effect, feet beyond the ends are then passed over */
    s.inside = side > 0 && shape->ends == CYLINT_ENDS_CAPPED;
    s.has_lateral = 0;
    const int on =
        side == 0 ? cylint_boundary_feature(shape, point) : CYLINT_NO_FEATURE;
    const int is_on = on != CYLINT_NO_FEATURE;
    if (is_on)
        search_feature(&s, on);
    else
        search_all(&s, side);
    measure_best(&s);
    if (want & CYLINT_WANT_PART)
        cylint_write_feature(shape, s.best.feature, answer);
    if (want & CYLINT_WANT_POINT)
        write_elliptic_point(&s, is_on, answer->point);
    if (want & CYLINT_WANT_NORMAL)
        write_elliptic_normal(&s, answer->normal);
    if (is_on)
        return answer->distance = 0;
    const double d = cylint_scaled(s.distance.hi, s.p.e + s.p.far);
    /* of an extreme shape the sign is right */
    const double size = isnan(d)              ? HUGE_VAL
                        : cylint_sign(d) == 0 ? 0x1p-1074
                                              : d;
    return answer->distance =
               side > 0 && cylint_surface_is_whole(shape->ends) ? -size : size;
}

double cylint_below_elliptic(const cylint_shape *shape, const double point[3],
                             double below)
{
    elliptic_terms p;
    triple M[3];
    load_elliptic(&p, shape, point);
    triple_cross(M, p.a, p.b);
    if (!cylint_rounds_to_nearest() || !(fabs(triple_dot(M, p.h).a) >= FLAT))
        return 0;
    const double error =
        DISTANCE_ERROR * (1 + p.length); /* a, b and h are below 2 */
    const double bound = below - cylint_scaled(error, p.e + p.far);
    return bound > 0 ? fabs(cylint_next_above(-bound)) : 0; /* no -0 */
}
