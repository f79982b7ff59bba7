/*
 * quick.c - a hit in doubles, where doubles are certain of it
 *
 * Every quantity comes with a bound on its error, in the same letters: `f` is
 * wrong by at most `e_f`.  Roundings are counted in eps = 2^-49, sixteen
 * of them; no sum or product below takes more, those of the axis (whose
 * double is rounded once) and of an acone's radius (thrice) included.  Sizes
 * of vectors are sums of the sizes of their components, never less than their
 * lengths.
 */
#include "quick.h"

#include <float.h>
#include <math.h>

#include "../each.h"

static const double eps = 0x1p-49;

static double dot(const double x[3], const double y[3])
{
    return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

static double size(const double x[3])
{
    return fabs(x[0]) + fabs(x[1]) + fabs(x[2]);
}

static double larger(double x, double y) /* fmax() is a call */
{
    return x > y ? x : y;
}

static void cross(double to[3], const double x[3], const double y[3])
{
    to[0] = x[1] * y[2] - x[2] * y[1];
    to[1] = x[2] * y[0] - x[0] * y[2];
    to[2] = x[0] * y[1] - x[1] * y[0];
}

/* Products below are of at most ten lengths, each of which may be as large
 * or, if it matters beside the others, as small as this. */
static int in_window(double length)
{
    return length > 0x1p-90 && length < 0x1p90;
}

typedef enum { MISS, HIT, UNSURE } verdict;

/*
 * The origin is moved by `from` multiples of u to near the shape, so that what
 * follows has errors of the shape's size, however far the ray began: to what
 * is known to be near or, else, to the point nearest to the base.  u and
 * `from` having 24 bits, their product is exact; what is lost in o - base is
 * found again [Moller 1965, Knuth]; so D is wrong by its own roundings only.
 */
static double lost_by_difference(double x, double y, double difference)
{
    const double minus_y = difference - x;
    return (x - (difference - minus_y)) - (y + minus_y);
}

static double place_near(const cylint_quick_line *l, const double D0[3])
{
    return fabsf(l->near) <= FLT_MAX
         ? l->near : (float)(-dot(D0, l->d) / dot(l->d, l->d));
}

/*
 * Sizes: V = W + Dn, R at least any radius.  Errors: D's e_D <= eps Dn,
 * alpha's 2 eps W Dn, beta's eps U W.
 */
static int place(cylint_quick *q, const cylint_quick_line *l,
                 const cylint_shape *s)
{
    double D0[3];
    EACH(j, 3) {
        q->u[j] = l->d[j];
        q->w[j] = s->axis[j];
        D0[j] = l->o[j] - s->base[j];
    }
    q->W = size(q->w);
    q->U = size(q->u);
    q->ww = dot(q->w, q->w);
    q->r0 = s->r0;
    q->dr = s->kind == CYLINT_KIND_ACONE ? s->dr * sqrt(q->ww) : s->dr;
    q->R = q->r0 + fabs(q->dr);
    if (!in_window(q->U) || !in_window(q->W) || !in_window(q->R) ||
        !(size(D0) < 0x1p90))
        return 0;
    q->from = place_near(l, D0);
    EACH(j, 3)
        q->D[j] = (D0[j] + q->from * q->u[j]) +
                  lost_by_difference(l->o[j], s->base[j], D0[j]);
    q->Dn = size(q->D);
    q->V = q->W + q->Dn;
    q->alpha = dot(q->D, q->w);
    q->beta = dot(q->u, q->w);
    return q->Dn < 0x1p90;
}

/* The s between which the line is inside the lateral surface. */
typedef struct {
    double s[2], e, most; /* most >= |s| */
} chord;

/*
 * With n = u x w and P = D + s u, Q(s) = |P x w|^2 - (r0 + dr P.w / ww)^2 ww =
 * a s^2 + 2 b s + c, a quarter of its discriminant being G, in the form that
 * does not cancel for origins far away:
 *
 *   a = nn - dr^2 beta^2 / ww,   b = (D x w).n - k dr beta,
 *   k = r0 + dr alpha / ww,      f = D.n,   g = r0 n + dr u x D,
 *   G = ww gg - (ww + dr^2) ff.
 *
 * a > 0: Q < 0 between the roots, on one nappe.  Errors, by eps:
 *
 *   n: U W.   f: 3 Dn U W.   g, which is at most R U V: 3 R U V.
 *   G: 7 ww R^2 U^2 V^2 + 7 (ww + dr^2) Dn^2 U^2 W^2, ww <= W^2;
 *   a: 3 U^2 W^2 + 5 R^2 U^2 W^2 / ww, where W^2 <= 3 ww;
 *   b: 4 Dn U W^2 + 7 R^2 U (W + 3 Dn), as k is at most R (1 + 3 Dn / W) and
 *      wrong by 4 of that, dr beta at most R U W and wrong by 2.
 */
static double error_of_a(const cylint_quick *q)
{
    return 16 * eps * q->U * q->U * (q->W * q->W + q->R * q->R);
}

static verdict cut(cylint_quick *q, chord *c)
{
    const double *w = q->w, dr = q->dr, ww = q->ww;
    const double RR = q->R * q->R, WW = q->W * q->W, UU = q->U * q->U;
    double m[3], g[3];
    cross(q->n, q->u, w);
    EACH(j, 3)
        g[j] = q->r0 * q->n[j];
    if (dr != 0) {
        double uD[3];
        cross(uD, q->u, q->D);
        EACH(j, 3)
            g[j] += dr * uD[j];
    }
    const double f = dot(q->D, q->n);
    const double G = ww * dot(g, g) - (ww + dr * dr) * (f * f);
    const double e_G = 8 * eps * UU * WW * (RR * q->V * q->V +
                                            (WW + RR) * q->Dn * q->Dn);
    if (G < -e_G)
        return MISS;
    const double kb = dr * q->beta, e_a = error_of_a(q);
    q->a = dot(q->n, q->n) - kb * kb / ww;
    if (!(G > 2 * e_G) || !(q->a > 2 * e_a))
        return UNSURE;
    cross(m, q->D, w);
    const double k = q->r0 + dr * q->alpha / ww, per_a = 1 / q->a;
    const double root = sqrt(G), b = dot(m, q->n) - k * kb;
    const double e_b = 24 * eps * q->U * (q->Dn * WW + RR * q->V);
    c->s[0] = (-b - root) * per_a;
    c->s[1] = (-b + root) * per_a;
    c->most = larger(fabs(c->s[0]), fabs(c->s[1]));
    c->e = 2 * (e_b + e_G / root + eps * root + c->most * e_a) * per_a +
           eps * c->most;
    return HIT;
}

/* alpha, zero at the base and ww at the top, and its error anywhere up to
 * `most`, s being wrong by e. */
static double alpha_at(const cylint_quick *q, double s)
{
    return q->alpha + s * q->beta;
}

static double alpha_error(const cylint_quick *q, double most, double e)
{
    return q->W * (q->U * e + 4 * eps * (q->Dn + most * q->U));
}

/* Where a chord's ends are: -1 below the base, 0 between, 1 above the top.
 * 0 where that is uncertain. */
static int find_levels(const cylint_quick *q, const chord *c, int where[2])
{
    const double e = alpha_error(q, c->most, c->e) + eps * q->ww;
    int certain = 1;
    EACH(i, 2) {
        const double alpha = alpha_at(q, c->s[i]);
        where[i] = alpha < 0 ? -1 : alpha > q->ww;
        certain &= fabs(alpha) > e && fabs(alpha - q->ww) > e;
    }
    return certain;
}

/* The chord's end or, where that lies beyond a cap, the cap's plane. */
static int find_stop(const cylint_quick *q, const chord *c, int i, int where,
                     cylint_quick_hit *at)
{
    at->part = where == 0 ? CYLINT_LATERAL
             : where < 0 ? CYLINT_CAP0 : CYLINT_CAP1;
    if (where == 0) {
        at->s = c->s[i];
        at->s_error = c->e;
        return 1;
    }
    const double rise = (where < 0 ? 0 : q->ww) - q->alpha;
    const double b = fabs(q->beta), e_b = eps * q->U * q->W;
    if (!(b > 2 * e_b))
        return 0;
    at->s = rise / q->beta;
    at->s_error = 2 * (2 * eps * q->W * q->Dn +
                       eps * (q->ww + fabs(q->alpha)) +
                       fabs(at->s) * e_b) / b + eps * fabs(at->s);
    return 1;
}

static int present(int ends, int part)
{
    return part == CYLINT_LATERAL || ends == CYLINT_CAPPED ||
           ends == (part == CYLINT_CAP0 ? CYLINT_CAP_0 : CYLINT_CAP_1);
}

/* Whether a stop is a hit: on a part that is there, in the domain. */
static verdict judge(cylint_quick_hit *at, double from, int ends,
                     const cylint_quick_line *l)
{
    if (!present(ends, at->part))
        return MISS;
    at->t = from + at->s;
    at->t_error = at->s_error + eps * (fabs(from) + fabs(at->s));
    if (at->t < l->tmin - at->t_error || at->t > l->tmax + at->t_error)
        return MISS;
    return at->t > l->tmin + at->t_error && at->t < l->tmax - at->t_error
         ? HIT : UNSURE;
}

int cylint_quick_ask(cylint_quick *q, const cylint_shape *shape,
                     const cylint_quick_line *l)
{
    chord c;
    int where[2], n = 0;
    if (shape->kind > CYLINT_KIND_ACONE || !place(q, l, shape))
        return -1;
    const verdict crossed = cut(q, &c);
    if (crossed != HIT)
        return crossed == MISS ? 0 : -1;
    if (!find_levels(q, &c, where))
        return -1;
    if (where[0] * where[1] == 1) /* all of the chord is beyond one end */
        return 0;
    EACH(i, 2) {
        if (!find_stop(q, &c, i, where[i], &q->hit[n]))
            return -1;
        const verdict is = judge(&q->hit[n], q->from, shape->ends, l);
        if (is == UNSURE)
            return -1;
        n += is == HIT;
    }
    return n;
}

/* ---------------------------------------------------------- description -- */

double cylint_quick_z(const cylint_quick *q, const cylint_quick_hit *at,
                      double *error)
{
    *error = 0;
    if (at->part != CYLINT_LATERAL)
        return at->part == CYLINT_CAP1;
    const double z = alpha_at(q, at->s) / q->ww;
    *error = alpha_error(q, fabs(at->s), at->s_error) / q->ww + eps * fabs(z);
    return z;
}

/* The hit's place on the surface, within e; c = P x w. */
typedef struct {
    double P[3], c[3], e;
} place_of_hit;

static double locate(const cylint_quick *q, double s, place_of_hit *p)
{
    EACH(j, 3)
        p->P[j] = q->D[j] + s * q->u[j];
    cross(p->c, p->P, q->w);
    return eps * (2 * q->Dn + fabs(s) * q->U);
}

/*
 * A step of Newton's: near the surface Q(s) is a difference of numbers of its
 * own size, so that s becomes as good as P is, whatever G lost.  With k = r0 +
 * dr P.w / ww and P wrong by e,
 *
 *   c = P x w by e_c = (e + eps |P|) W,   k by e_k = |dr| e_c 3 / W + eps R V',
 *   Q = cc - kk ww by e_c (2 |c| + e_c) + e_k (2 k + e_k) ww + eps (...).
 *
 * What the step misses is a step^2 / (2 H), H = c.n - k dr beta = Q' / 2, and
 * what H's own error makes of the step, which is taken to be less than all of
 * it times the relative errors of s: both are in `rest`.
 */
static int polish(const cylint_quick *q, cylint_quick_hit *at,
                  place_of_hit *p)
{
    const double e = locate(q, at->s, p);
    const double P = size(p->P), c = size(p->c), dr = fabs(q->dr);
    const double k = q->r0 + q->dr * (dot(p->P, q->w) / q->ww);
    const double H = dot(p->c, q->n) - k * q->dr * q->beta;
    const double cc = dot(p->c, p->c), kk = k * k * q->ww;
    const double step = (kk - cc) / (2 * H);
    const double e_c = (e + eps * P) * q->W;
    const double e_k = dr * e_c * 3 / q->W + eps * (q->r0 + dr * 3 * P / q->W);
    const double e_Q = e_c * (2 * c + e_c) +
                       e_k * (2 * fabs(k) + e_k) * q->ww + eps * (cc + kk);
    const double N = q->U * q->W;
    const double e_H = N * (e_c + eps * c) + N * dr * (e_k + eps * fabs(k));
    const double rest = fabs(step) * (fabs(step) * q->a + 2 * e_H);
    if (!(fabs(H) > 4 * (e_H + fabs(step) * q->a)) )
        return 0;
    at->s += step;
    at->s_error = (e_Q + rest) / fabs(H) + eps * fabs(at->s);
    return 1;
}

/* x as a float, if that is certain: x is wrong by at most e, and what it is
 * compared with, the library's, less than that again. */
static int to_float(double x, double e, float *f)
{
    const double wide = 2 * e;
    *f = (float)(x + wide) + 0;
    return (float)(x - wide) + 0 == *f;
}

/*
 * The lateral normal, times |w|^2: N = w x (P x w) - r dr w, r = r0 + dr z.
 * Errors by component, so that components that are zero because those of the
 * axis are stay certain; e_c counts what rounding c's products with w adds.
 */
static void lateral_normal(const cylint_quick *q, const place_of_hit *p,
                           double z, double e_z, double N[3], double e[3])
{
    const double *w = q->w, dr = q->dr;
    const double e_P = p->e + eps * size(p->P);
    double wide[3], e_c[3];
    EACH(j, 3)
        wide[j] = fabs(w[j]);
    EACH(j, 3)
        e_c[j] = e_P * (wide[(j + 1) % 3] + wide[(j + 2) % 3]) +
                 eps * fabs(p->c[j]);
    cross(N, w, p->c);
    EACH(j, 3) {
        const int k = (j + 1) % 3, m = (j + 2) % 3;
        e[j] = wide[k] * e_c[m] + wide[m] * e_c[k];
    }
    if (dr == 0)
        return;
    const double lean = (q->r0 + dr * z) * dr;
    const double e_lean = (fabs(dr) * e_z + eps * (q->r0 + fabs(dr * z))) *
                          fabs(dr) + eps * fabs(lean);
    EACH(j, 3) {
        N[j] -= lean * w[j];
        e[j] += (e_lean + eps * fabs(lean)) * fabs(w[j]) + eps * fabs(N[j]);
    }
}

static void cap_normal(const cylint_quick *q, int part, double N[3],
                       double e[3])
{
    EACH(j, 3) {
        N[j] = part == CYLINT_CAP1 ? q->w[j] : -q->w[j];
        e[j] = eps * fabs(N[j]);
    }
}

static int unit_floats(const double N[3], const double e[3], float unit[3])
{
    const double per_length = 1 / sqrt(dot(N, N));
    const double all = (e[0] + e[1] + e[2]) * per_length;
    int sure = all < 0.25;
    EACH(j, 3) {
        const double x = N[j] * per_length;
        sure &= to_float(x, 2 * e[j] * per_length + fabs(x) * (2 * all + eps),
                         &unit[j]);
    }
    return sure;
}

/* The coordinate along which the axis is least, the first such; -1 where
 * equal doubles leave that to their low parts. */
static int least_component(const double w[3])
{
    const double x = fabs(w[0]), y = fabs(w[1]), z = fabs(w[2]);
    const int least = x <= y ? (x <= z ? 0 : 2) : (y <= z ? 1 : 2);
    const int tied = (x == fabs(w[least])) + (y == fabs(w[least])) +
                     (z == fabs(w[least])) > 1;
    return tied && w[least] != 0 ? -1 : least;
}

float cylint_turn(double phi)
{
    const float v = (float)phi;
    return v < 1 ? v : 1 - FLT_EPSILON / 2;
}

/* atan2(P.(w x v), P.v |w|) over 2 pi, v = e x w. */
static int describe_phi(const cylint_quick *q, const place_of_hit *p,
                        float *phi)
{
    const double two_pi = 6.28318530717958647692, *w = q->w;
    const int least = least_component(w);
    if (least < 0)
        return 0;
    const int j = (least + 1) % 3, k = (least + 2) % 3;
    double v[3] = {0, 0, 0}, y_axis[3];
    v[j] = -w[k];
    v[k] = w[j];
    cross(y_axis, w, v);
    const double x = dot(p->P, v) * sqrt(q->ww), y = dot(p->P, y_axis);
    const double e = q->W * size(v) * (p->e + eps * size(p->P));
    const double far = fabs(x) + fabs(y);
    if (!(far > 8 * e))
        return 0;
    double turn = atan2(y, x) / two_pi;
    if (turn < 0)
        turn += 1;
    /* the angle turns by less than both errors over the hypotenuse, which is
     * at least far / sqrt(2), here over 2 pi < 1 */
    const double wide = 2 * (2 * e / far + eps);
    if (!(turn > wide) || !(turn < 1 - wide))
        return 0;
    *phi = cylint_turn(turn - wide);
    return cylint_turn(turn + wide) == *phi;
}

int cylint_quick_describe(const cylint_quick *q, const cylint_quick_hit *hit,
                          cylint_quick_floats *floats)
{
    cylint_quick_hit at = *hit;
    place_of_hit p;
    double N[3], e[3], e_z;
    if (at.part == CYLINT_LATERAL && !polish(q, &at, &p))
        return 0;
    p.e = locate(q, at.s, &p) + q->U * at.s_error;
    const double z = cylint_quick_z(q, &at, &e_z);
    if (at.part == CYLINT_LATERAL)
        lateral_normal(q, &p, z, e_z, N, e);
    else
        cap_normal(q, at.part, N, e);
    return to_float(z, e_z, &floats->z) && unit_floats(N, e, floats->normal) &&
           describe_phi(q, &p, &floats->phi);
}
