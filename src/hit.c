/*
 * hit.c - what a hit can tell beside t: point, normal, z and angle
 *
 * Everything is computed in pairs of doubles from the root as a pair, so
 * that a far origin or a thin shape costs no digits, and rounded at the end.
 */
#include "internal.h"

static double rounded(wide x)
{
    return x.v.hi;
}

/* o + t d; from a segment's two ends, so that its ends are met exactly. */
static void hit_point(const cylint_line *l, pair t, double point[3])
{
    for (int i = 0; i < 3; i++) {
        if (l->segment && !(fabs(l->d[i]) <= DBL_MAX)) {
            point[i] = l->o[i] * (1 - t.hi) + l->end[i] * t.hi;
            continue;
        }
        const pair td = pair_mul(t, (pair){l->d[i], l->d_lo[i]});
        point[i] = pair_add((pair){l->o[i], 0}, td).hi;
    }
}

static void normalise(const double x[3], double to[3])
{
    const int e = -cylint_exponent(cylint_largest(x));
    double y[3];
    for (int i = 0; i < 3; i++)
        y[i] = cylint_scaled(x[i], e);
    const double size = sqrt(y[0] * y[0] + y[1] * y[1] + y[2] * y[2]);
    for (int i = 0; i < 3; i++)
        to[i] = y[i] / size + 0; /* no -0 */
}

/* The letters with the line's origin moved to the hit. */
static letters_wide at_hit(cylint_query *q, pair t)
{
    letters_wide L = *cylint_wide(q);
    const wide scaled_t = {{cylint_scaled(t.hi, -q->t_exponent),
                            cylint_scaled(t.lo, -q->t_exponent)},
                           fabs(t.hi)};
    for (int i = 0; i < 3; i++)
        L.D[0][i] = wide_add(L.D[0][i], wide_mul(scaled_t, L.u[i]));
    return L;
}

/* Half the gradient of Q, times the sign of what keeps it outward:
 * s w x (P x w) - rho dr w, or X_p p + X_q q - rho kappa e. */
static void lateral_normal(const letters_wide *L, double to[3])
{
    wide X[3], N[3];
    radial_wide(L, X);
    if (elliptic_wide(L)) {
        for (int i = 0; i < 3; i++)
            N[i] = wide_add(wide_mul(X[0], L->p[i]), wide_mul(X[1], L->q[i]));
    } else {
        cross_wide(L, L->w, X, N);
        if (L->kind == CYLINT_KIND_CONE)
            for (int i = 0; i < 3; i++)
                N[i] = wide_mul(L->vv, N[i]);
    }
    if (L->kind != CYLINT_KIND_CYLINDER && L->kind != CYLINT_KIND_ECYLINDER) {
        const wide k = wide_mul(form_rho0_wide(L), L->dr);
        for (int i = 0; i < 3; i++)
            N[i] = wide_sub(N[i], wide_mul(k, axial_wide(L)[i]));
    }
    const double n[3] = {rounded(N[0]), rounded(N[1]), rounded(N[2])};
    normalise(n, to);
}

static void axial_normal(const letters_wide *L, int sign, double to[3])
{
    const wide *axis = axial_wide(L);
    const double n[3] = {sign * rounded(axis[0]), sign * rounded(axis[1]),
                         sign * rounded(axis[2])};
    normalise(n, to);
}

/* Away from the solid; at a double cone's apex against the line. */
static int apex_sign(cylint_query *q)
{
    if (q->ends == CYLINT_INFINITE)
        return cylint_sign_beta(q) > 0 ? -1 : cylint_sign_beta(q) < 0 ? 1 : -1;
    return -cylint_sign(q->shape->dr);
}

static double axial_coordinate(const letters_wide *L)
{
    const wide alpha = form_alpha_wide(L, 0);
    return pair_div(alpha.v, form_root_of_S_wide(L).v).hi;
}

static double turns(double y, double x)
{
    const double pi = 3.14159265358979323846;
    if (y == 0 && x == 0)
        return 0;
    double phi = atan2(y, x) / (2 * pi);
    if (phi < 0)
        phi += 1;
    return phi < 1 ? phi + 0 : 0;
}

static double angle(const letters_wide *L, int flip)
{
    wide X[3];
    if (elliptic_wide(L)) {
        radial_wide(L, X);
        return turns(flip ? -rounded(X[1]) : rounded(X[1]), rounded(X[0]));
    }
    int least = 0;
    for (int i = 1; i < 3; i++)
        if (fabs(L->w[i].v.hi) < fabs(L->w[least].v.hi))
            least = i;
    const wide zero = {{0, 0}, 0};
    wide e[3] = {zero, zero, zero}, from[3], to[3];
    e[least] = L->one;
    cross_wide(L, e, L->w, from);   /* phi = 0 */
    cross_wide(L, L->w, from, to);  /* a quarter turn on, |w| times longer */
    const pair x = pair_mul(dot_wide(L, L->D[0], from).v,
                            pair_sqrt(L->vv.v));
    return turns(rounded(dot_wide(L, L->D[0], to)), x.hi);
}

void cylint_describe_hit(cylint_query *q, cylint_root root, double t,
                         double more, int part, int apex, unsigned want,
                         cylint_hit *hit)
{
    const pair at = fast_two_sum(t, more);
    if (want & CYLINT_WANT_POINT)
        hit_point(q->line, at, hit->point);
    if (!(want & (CYLINT_WANT_NORMAL | CYLINT_WANT_Z | CYLINT_WANT_PHI)))
        return;
    const letters_wide L = at_hit(q, at);
    if (want & CYLINT_WANT_NORMAL) {
        if (part != CYLINT_LATERAL)
            axial_normal(&L, part == CYLINT_CAP1 ? 1 : -1, hit->normal);
        else if (apex)
            axial_normal(&L, apex_sign(q), hit->normal);
        else
            lateral_normal(&L, hit->normal);
    }
    if (want & CYLINT_WANT_Z)
        hit->z = root == ROOT_CAP0 ? 0 : root == ROOT_CAP1 ? 1
               : axial_coordinate(&L);
    if (want & CYLINT_WANT_PHI)
        hit->phi = apex ? 0 : angle(&L, q->shape->flip);
}
