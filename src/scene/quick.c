/*
 * quick.c - a hit in doubles, where doubles are certain of it
 *
 * Every quantity comes with a bound on its error, in the same letters: `f` is
 * wrong by at most `e_f`.  Roundings u = 2^-53 are counted in eps = 2^-50,
 * eight of them; the axis, whose double is rounded once, is wrong by u, an
 * acone's radius by 6 u.  Those of vectors are of lengths: a cross product's
 * is at most 2 / sqrt(3) of those of its products.  W is the axis's length, U
 * and Dn are sizes of vectors, never less than that.
 *
 * Compiled once as it is and again where the processor has fused multiply-add,
 * contracted: which rounds less, and all that is told is certain either way.
 */
#include "quick.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "../each.h"
#include "turn.h"

/* What a question is made of stays one piece of code, a tenth faster. */
#define INLINE CYLINT_INLINE

static const double eps = 0x1p-50;

static double dot(const double x[3], const double y[3])
{
    return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

static double size(const double x[3])
{
    return fabs(x[0]) + fabs(x[1]) + fabs(x[2]);
}

static void cross(double to[3], const double x[3], const double y[3])
{
    to[0] = x[1] * y[2] - x[2] * y[1];
    to[1] = x[2] * y[0] - x[0] * y[2];
    to[2] = x[0] * y[1] - x[1] * y[0];
}

/* Products below are of at most ten lengths, none of which may be smaller than
 * this, if it matters beside the others: so what is flushed to zero does not.
 * What overflows leaves infinite bounds or NaN, of which nothing is certain. */
static int in_window(const cylint_quick *q)
{
    const double R = q->r0 + fabs(q->dr);
    return cylint_smaller(cylint_smaller(R, q->W), q->U) > 0x1p-90;
}

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
 * Errors: D's 2 u Dn, beta's 4 u U W, alpha's 6 u W Dn, ww's 5 u ww; with n's
 * 4 u U W and m's 6 u Dn W.
 */
static void place(cylint_quick *q, const cylint_quick_shape *s,
                  const cylint_quick_line *l, double D[3])
{
    double D0[3];
    EACH(j, 3)
        D0[j] = l->o[j] - s->base[j];
    q->from = place_near(l, D0);
    EACH(j, 3)
        D[j] = (D0[j] + q->from * l->d[j]) +
               lost_by_difference(l->o[j], s->base[j], D0[j]);
    EACH(j, 3)
        q->w[j] = s->axis[j];
    q->r0 = s->r0;
    q->ww = dot(q->w, q->w);
    q->per_ww = 1 / q->ww;
    q->W = sqrt(q->ww);
    q->dr = s->dr;
    q->U = size(l->d);
    q->Dn = size(D);
    q->alpha = dot(D, q->w);
    q->beta = dot(l->d, q->w);
    cross(q->n, l->d, q->w);
    cross(q->m, D, q->w);
    q->tmin = l->tmin;
}

/*
 * With n = u x w and P = D + s u, Q(s) = |P x w|^2 - (r0 + dr P.w / ww)^2 ww =
 * a s^2 + 2 b s + c, a quarter of its discriminant being G, in the form that
 * does not cancel for origins far away:
 *
 *   a = nn - dr^2 beta^2 / ww,   b = m.n - k dr beta,   m = D x w,
 *   k = r0 + dr alpha / ww,      f = D.n,   g = r0 n + dr u x D,
 *   G = ww gg - (ww + dr^2) ff.
 *
 * a > 0: Q < 0 between the roots, on one nappe.  a < 0: before the first root
 * and behind the second, on one nappe each; that where radii are positive is
 * the second's if they grow along the line, and its chord has no other end.
 * Either way the chord begins at (-b - sqrt(G)) / a and ends at (-b + sqrt(G))
 * / a.  Errors, S being the bound U (r0 W + |dr| Dn) of |g|:
 *
 *   f: 9 u Dn U W.   g: 14 u S.   ww gg: 37 u ww S^2.   ww + dr^2: 13 u of it.
 *   a: 10 u U^2 W^2 + 30 u dr^2 U^2; that of a cylinder is positive if G is.
 */
static cylint_quick_verdict cut(cylint_quick *q, const double u[3],
                                const double D[3])
{
    const double r0 = q->r0, dr = q->dr, kb = dr * q->beta;
    const double ww = q->ww, N = q->U * q->W, f = dot(D, q->n);
    double gg, S = r0 * N, slant = ww, b = dot(q->m, q->n);
    q->a = dot(q->n, q->n);
    gg = r0 * r0 * q->a;
    if (dr != 0) {
        double g[3];
        cross(g, u, D);
        EACH(j, 3)
            g[j] = r0 * q->n[j] + dr * g[j];
        gg = dot(g, g);
        S += fabs(dr) * q->U * q->Dn;
        slant += dr * dr;
        b -= (r0 + dr * q->alpha * q->per_ww) * kb;
        q->a -= kb * kb * q->per_ww;
        if (!(fabs(q->a) > eps * (4 * N * N + 8 * dr * dr * (q->U * q->U))))
            return CYLINT_QUICK_UNSURE;
    }
    const double G = ww * gg - slant * (f * f), e_f = 2 * eps * q->Dn * N;
    const double e_G = 6 * eps * ww * (S * S) +
                       slant * (e_f * (2 * fabs(f) + e_f) + 2 * eps * (f * f));
    if (G < -e_G)
        return CYLINT_QUICK_MISS;
    if (!(G > 16 * e_G))
        return CYLINT_QUICK_UNSURE;
    const double per_a = 1 / q->a;
    q->root = sqrt(G);
    q->per_root = 1 / q->root;
    q->s[0] = (-b - q->root) * per_a;
    q->s[1] = (-b + q->root) * per_a;
    q->endless = q->a < 0 ? kb > 0 : -1;
    return CYLINT_QUICK_HIT;
}

/*
 * What the line has at s: c = P x w = m + s n, z, k; and how far s is from
 * the root of Q that it is taken for, by what Q leaves there.
 *
 * With X = Dn + |s| U and K = r0 + |dr| X / W the errors are
 *
 *   c: 7 u Dn W + 6 u |s| U W < eps W X, alpha + s beta no more;
 *   k: 23 u K < 3 eps K, none of a cylinder's;
 *   Q: e_c (2 |c| + e_c) + e_k (2 |k| + e_k) ww + eps (cc + kk ww).
 *
 * s is on the root's side of the middle if a s + b, which is -+sqrt(G) as
 * computed, is certain of its sign.  Its errors: b: 13 u Dn U W^2 + 28 u |dr|
 * K U W;  s a: 10 u |s| U^2 W^2 + 31 u |dr| K U W;  and 4 u (|b| + sqrt(G))
 * for s.  Then |Q| = |s - root| |2 sqrt(G) +- a |s - root|| >= |s - root|
 * sqrt(G).  G being known to 1/16 of it and a to 1/2, this first bounds
 * a |s - root| by sqrt(G) / 5, and then |s - root| by 0.57 of |Q| / sqrt(G).
 */
INLINE int meet(const cylint_quick *q, double s, cylint_quick_hit *at)
{
    const double X = q->Dn + fabs(s) * q->U, N = q->U * q->W;
    const double e_c = eps * q->W * X;
    double e_k = 0, e_H = 4 * e_c;
    EACH(j, 3)
        at->c[j] = q->m[j] + s * q->n[j];
    at->s = s;
    at->z = (q->alpha + s * q->beta) * q->per_ww;
    at->k = q->r0;
    if (q->dr != 0) {
        const double dr = fabs(q->dr), K = q->r0 + dr * X * (q->W * q->per_ww);
        at->k += q->dr * at->z;
        e_k = 3 * eps * K;
        e_H += 8 * eps * dr * K;
    }
    const double c = size(at->c), cc = dot(at->c, at->c);
    const double kkww = at->k * at->k * q->ww;
    double e_Q = e_c * (2 * c + e_c) + eps * (cc + kkww);
    if (q->dr != 0)
        e_Q += e_k * (2 * fabs(at->k) + e_k) * q->ww;
    const double off = (fabs(cc - kkww) + e_Q) * q->per_root;
    at->s_error = 0.6 * off;
    at->e_c = e_c + N * at->s_error + eps * c;
    at->e_k = e_k + fabs(q->dr) * N * q->per_ww * at->s_error;
    at->z_error = at->e_c * q->per_ww + eps * fabs(at->z);
    return (q->root > 9 * fabs(q->a) * off) & (q->root > N * e_H);
}

/* Where the line is as it begins (i = 0) or ceases to be inside the lateral
 * surface: -1 below the base, 0 between, 1 above the top; 2: uncertain. */
INLINE int level(const cylint_quick *q, int i, cylint_quick_hit *at)
{
    if (i == q->endless)
        return (i == 1) == (q->beta > 0) ? 1 : -1;
    if (!meet(q, q->s[i], at))
        return 2;
    const double e = at->z_error + eps;
    if (at->z > e && at->z < 1 - e)
        return 0;
    return at->z < -e ? -1 : at->z > 1 + e ? 1 : 2;
}

/* Where the line pierces a cap's plane. */
static int pierce(const cylint_quick *q, int part, cylint_quick_hit *at)
{
    const double rise = (part == CYLINT_CAP0 ? 0 : q->ww) - q->alpha;
    const double N = q->U * q->W, b = fabs(q->beta), e_b = eps * N;
    if (!(b > 2 * e_b))
        return 0;
    at->s = rise / q->beta;
    at->s_error = 2 * (eps * q->W * q->Dn + eps * (q->ww + fabs(q->alpha)) +
                       fabs(at->s) * e_b) / b + eps * fabs(at->s);
    EACH(j, 3)
        at->c[j] = q->m[j] + at->s * q->n[j];
    at->e_c = eps * (q->W * (q->Dn + fabs(at->s) * q->U) + size(at->c)) +
              N * at->s_error;
    at->z = part == CYLINT_CAP1;
    at->z_error = 0;
    return 1;
}

static int has_cap(int ends, int part)
{
    return ends == CYLINT_CAPPED ||
           ends == (part == CYLINT_CAP0 ? CYLINT_CAP_0 : CYLINT_CAP_1);
}

/* Where the chord that begins at s[i] comes upon a cap from beyond it. */
static cylint_quick_verdict stop_at_cap(const cylint_quick *q, int i,
                                        int where, cylint_quick_hit *at)
{
    cylint_quick_hit other;
    const int there = level(q, 1 - i, &other);
    if (there == 2)
        return CYLINT_QUICK_UNSURE;
    at->part = where < 0 ? CYLINT_CAP0 : CYLINT_CAP1;
    if (there == where || !has_cap(q->ends, at->part))
        return CYLINT_QUICK_MISS;
    return pierce(q, at->part, at) ? CYLINT_QUICK_HIT : CYLINT_QUICK_UNSURE;
}

INLINE cylint_quick_verdict stop(const cylint_quick *q, int i,
                                 cylint_quick_hit *at)
{
    const int where = level(q, i, at);
    at->part = CYLINT_LATERAL;
    if (where == 2)
        return CYLINT_QUICK_UNSURE;
    if (where != 0) {
        const cylint_quick_verdict is = stop_at_cap(q, i, where, at);
        if (is != CYLINT_QUICK_HIT)
            return is;
    }
    at->t = q->from + at->s;
    at->t_error = at->s_error + eps * fabs(at->t);
    if (at->t < q->tmin - at->t_error)
        return CYLINT_QUICK_MISS;
    return at->t > q->tmin + at->t_error ? CYLINT_QUICK_HIT
                                         : CYLINT_QUICK_UNSURE;
}

/* Differences that were doubles are the same doubles again. */
static const cylint_quick_shape *widened(cylint_quick_shape *to,
                                         const cylint_quick_small *s)
{
    EACH(j, 3) {
        to->base[j] = s->base[j];
        to->axis[j] = (double)s->top[j] - (double)s->base[j];
    }
    to->r0 = s->r0;
    to->dr = (double)s->r1 - (double)s->r0;
    return to;
}

static cylint_quick_verdict enter(cylint_quick *q,
                                  const cylint_quick_subject *subject,
                                  const cylint_quick_line *l,
                                  cylint_quick_hit *at)
{
    double D[3];
    cylint_quick_shape room;
    q->crosses = 0;
    q->whole = subject->whole;
    q->ends = subject->ends;
    place(q, subject->small ? widened(&room, subject->shape) : subject->shape,
          l, D);
    if (!in_window(q))
        return CYLINT_QUICK_UNSURE;
    const cylint_quick_verdict crosses = cut(q, l->d, D);
    if (crosses != CYLINT_QUICK_HIT)
        return crosses;
    q->crosses = 1;
    return stop(q, 0, at);
}

static cylint_quick_verdict leave(const cylint_quick *q, cylint_quick_hit *at)
{
    return q->crosses ? stop(q, 1, at) : CYLINT_QUICK_MISS;
}

/* ---------------------------------------------------------- description -- */

/* x, which is wrong by at most e, the library's own error included, as a
 * float, if that is certain. */
static int to_float(double x, double e, float *f)
{
    *f = (float)(x + e);
    return (float)(x - e) == *f;
}

/* w x c, and its error from e_c, where rounding is counted, by component, so
 * that components that are zero because those of the axis are stay certain. */
static void across(const cylint_quick *q, const cylint_quick_hit *at,
                   double N[3], double e[3])
{
    const double x = fabs(q->w[0]), y = fabs(q->w[1]), z = fabs(q->w[2]);
    cross(N, q->w, at->c);
    e[0] = (y + z) * at->e_c;
    e[1] = (z + x) * at->e_c;
    e[2] = (x + y) * at->e_c;
}

/* N / |N|, the length being wrong by e_length of it. */
static int unit_floats(const double N[3], const double e[3], double per_length,
                       double e_length, float unit[3])
{
    int sure = 1;
    EACH(j, 3) {
        const double x = N[j] * per_length;
        const double e_x = e[j] * per_length + fabs(x) * e_length;
        sure &= to_float(x, 1.1 * e_x, &unit[j]);
    }
    return sure;
}

/*
 * The lateral normal is N = w x c - k dr w.  On the surface, where |c| = k
 * |w|, it is as long as k |w| sqrt(ww + dr^2), which is known to 15 u of it,
 * and to what k is.
 */
static int lateral_normal(const cylint_quick *q, const cylint_quick_hit *at,
                          const double across_w[3], const double e[3],
                          float normal[3])
{
    if (q->dr == 0)
        return unit_floats(across_w, e, q->per_ww / q->r0, 3 * eps, normal);
    const double dr = q->dr, k = at->k, lean = k * dr;
    const double e_lean = fabs(dr) * (at->e_k + eps * fabs(k));
    double N[3], e_N[3];
    EACH(j, 3) {
        N[j] = across_w[j] - lean * q->w[j];
        e_N[j] = e[j] + e_lean * fabs(q->w[j]);
    }
    return k > 32 * at->e_k &&
           unit_floats(N, e_N, 1 / (k * (q->W * sqrt(q->ww + dr * dr))),
                       at->e_k / k + 3 * eps, normal);
}

static int cap_normal(const cylint_quick *q, int part, float normal[3])
{
    const double e[3] = {0, 0, 0};
    return unit_floats(q->w, e, (part == CYLINT_CAP1 ? 1 : -1) / q->W, 2 * eps,
                       normal);
}

/* Whether |w[i]| < |w[j]|, which are equal but for their low parts. */
static int is_lower(const cylint_shape *s, int i, int j)
{
    return s->axis_lo[i] * copysign(1, s->axis[i]) <
           s->axis_lo[j] * copysign(1, s->axis[j]);
}

static int least_in_full(const cylint_shape *s, double least)
{
    int first = 2;
    for (int j = 1; j >= 0; j--)
        if (fabs(s->axis[j]) <= least &&
            (fabs(s->axis[first]) > least || !is_lower(s, first, j)))
            first = j;
    return first;
}

/* The coordinate along which the axis is least, the first such.  What is 0
 * has no low part. */
static int least_component(const cylint_quick *q)
{
    const double x = fabs(q->w[0]), y = fabs(q->w[1]), z = fabs(q->w[2]);
    const double xy = cylint_smaller(x, y), least = cylint_smaller(xy, z);
    const int tied = (x <= least) + (y <= least) + (z <= least) > 1;
    return tied && least > 0 ? least_in_full(q->whole, least)
                             : z < xy ? 2 : y < x;
}

/*
 * phi = atan2(P.(w x v), P.v |w|) over 2 pi, where v = e x w, e being the unit
 * vector along which the axis is least.  That is atan2((w x c).e, -c.e |w|).
 */
static int describe_phi(const cylint_quick *q, const cylint_quick_hit *at,
                        const double across_w[3], float *phi)
{
    const int least = least_component(q);
    double per_far;
    const double turn = cylint_turns(across_w[least], -at->c[least] * q->W,
                                     &per_far);
    /* both are wrong by at most W e_c, so the angle by less than sqrt(2) / (2
     * pi) of that over the hypotenuse, 13/12 at most for per_far */
    const double part = q->W * at->e_c * per_far;
    const double e = 0.25 * part + CYLINT_TURN_ERROR;
    return (part < 0.125) & (turn > e) & (turn + e < 1 - (double)FLT_EPSILON) &
           to_float(turn, e, phi);
}

static int describe(const cylint_quick *q, const cylint_quick_hit *at,
                    cylint_quick_floats *floats)
{
    double across_w[3], e[3];
    across(q, at, across_w, e);
    return to_float(at->z, at->z_error, &floats->z) &
           (at->part == CYLINT_LATERAL
            ? lateral_normal(q, at, across_w, e, floats->normal)
            : cap_normal(q, at->part, floats->normal)) &
           describe_phi(q, at, across_w, &floats->phi);
}

/* --------------------------------------------------------------- builds -- */

#ifndef CYLINT_QUICK
#define CYLINT_QUICK cylint_quick_plain

void cylint_quick_shape_of(cylint_quick_shape *to, const cylint_shape *s)
{
    EACH(j, 3) {
        to->base[j] = s->base[j];
        to->axis[j] = s->axis[j];
    }
    to->r0 = s->kind > CYLINT_KIND_ACONE ? -1 : s->r0;
    to->dr = s->kind > CYLINT_KIND_ACONE ? 0
           : s->kind == CYLINT_KIND_ACONE ? s->dr * sqrt(dot(s->axis, s->axis))
           : s->dr;
}

/* Zero by the bits: a thread may take a subnormal number for it. */
static int is_float(double x, float *to)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    *to = (float)x;
    return (double)*to == x &&
           (fabs(x) >= (double)FLT_MIN || bits << 1 == 0);
}

int cylint_quick_small_of(cylint_quick_small *to, const cylint_shape *s)
{
    int is = s->kind == CYLINT_KIND_CYLINDER || s->kind == CYLINT_KIND_CONE;
    EACH(j, 3)
        is &= is_float(s->base[j], &to->base[j]) &
              is_float(s->top[j], &to->top[j]) &
              ((double)to->top[j] - (double)to->base[j] == s->axis[j]);
    return is & is_float(s->r0, &to->r0) & is_float(s->r1, &to->r1) &
           ((double)to->r1 - (double)to->r0 == s->dr);
}

#endif

const cylint_quick_build CYLINT_QUICK = {enter, leave, describe};
