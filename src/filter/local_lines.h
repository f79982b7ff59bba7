/*
 * local_lines.h - a line in the local coordinates of a shape, in doubles
 *
 * In local coordinates (shapes/local.h) the line is (p, z) + t (v, w), p and v
 * in the plane, and the lateral surface |p|^2 = rho^2, rho = r + slope z.
 * Along the line
 *
 *   Q(t) = |p + t v|^2 - (rho + t slope w)^2 = A t^2 + 2 B t + C,
 *
 * Q < 0 within.  With z_i from the plane of cap i and X_i = w p - z_i v, the
 * forms of forms_template.h become
 *
 *   G   = |r v - slope X_0|^2 - (p x v)^2 = B^2 - A C
 *   E_i = r_i^2 w^2 - |X_i|^2             > 0: the line pierces cap i
 *   N_i = v . X_i - slope r_i w^2         dQ/dz at cap i, times w^2
 *
 * The bounds on their errors are in error_bounds.h.  Q and D there: no
 * coordinate of the line's origin exceeds Q, none of its direction exceeds D.
 */
#ifndef CYLINT_LOCAL_LINES_H
#define CYLINT_LOCAL_LINES_H

#include "../numbers/compiler.h"
#include "../numbers/double_double.h" /* before simd.h */
#include "../numbers/error_bounds.h"
#include "../numbers/simd.h"
#include "../shapes/shape_facts.h"
#include "cylint.h"

/* x y + z, rounded once or twice. */
INLINE double sum_of(double x, double y, double z)
{
#ifdef __FMA__
    return __builtin_fma(x, y, z);
#else
    return x * y + z;
#endif
}

INLINE vd v_sum_of(vd x, vd y, vd z)
{
#if V_HAS_FMA
    return v_fma(x, y, z);
#else
    return x * y + z;
#endif
}

typedef struct {
    vd p, v;            /* x and y */
    double z[2], w;     /* z from the plane of each cap */
    double Q, D, far;   /* far: of the origin from the base */
    double vv, pv, pxv; /* products of p and v */
} local_line;

INLINE void load_local(local_line *l, const cylint_shape *shape,
                       const cylint_line *line)
{
    const cylint_local *f = &shape->local;
    const double x = line->o[0] - shape->base[0];
    const double y = line->o[1] - shape->base[1];
    const double z = line->o[2] - shape->base[2];
    const vd M0 = v_load(f->xyz[0]), M1 = v_load(f->xyz[1]),
             M2 = v_load(f->xyz[2]);
    l->p = v_sum_of(v_set(z), M2, v_sum_of(v_set(y), M1, v_set(x) * M0));
    l->v = v_sum_of(v_set(line->d[2]), M2,
                    v_sum_of(v_set(line->d[1]), M1, v_set(line->d[0]) * M0));
    const double up0 = f->xyz[0][2], up1 = f->xyz[1][2], up2 = f->xyz[2][2];
    l->z[0] = sum_of(z, up2, sum_of(y, up1, x * up0));
    l->z[1] = l->z[0] - f->height;
    l->w = sum_of(line->d[2], up2, sum_of(line->d[1], up1, line->d[0] * up0));
    l->far = cylint_larger(cylint_larger(fabs(x), fabs(y)), fabs(z)) * f->norm;
    l->Q = l->far + f->reach;
    l->D = line->size * f->norm;
    const vd products = v_sums(l->v * l->v, l->p * l->v);
    const vd crossed = l->p * v_turned(l->v);
    l->vv = v_first(products);
    l->pv = v_first(v_turned(products));
    l->pxv = v_first(crossed - v_turned(crossed));
}

/* 1 + |slope|: bounds what a slope adds to the errors. */
INLINE double taper_of(const cylint_shape *shape, int tapered)
{
    return tapered ? 1 + fabs(shape->local.slope) : 1;
}

/* G and a bound on its error. */
INLINE double local_G(const local_line *l, const cylint_shape *shape,
                      int tapered, double *error)
{
    const double unit = CYLINT_LOCAL_FORM * l->Q * l->D, r = shape->r0;
    if (!tapered) {
        *error = unit * l->D * sum_of(CYLINT_LOCAL_SECOND, l->Q, r);
        return sum_of(-l->pxv, l->pxv, r * r * l->vv);
    }
    const double slope = shape->local.slope;
    const vd X = v_sum_of(v_set(-l->z[0]), l->v, v_set(l->w) * l->p);
    const vd Y = v_sum_of(v_set(-slope), X, v_set(r) * l->v), size = v_abs(Y);
    const vd sums = v_sums(Y * Y, size);
    const double off = 0.5 * unit * taper_of(shape, 1);
    *error = 2 * off * (v_first(v_turned(sums)) + off);
    return sum_of(-l->pxv, l->pxv, v_first(sums));
}

/* What is certain of a whole line, by signs.  pierced, spared: bits of caps
 * in which the line pierces the cap's disc or passes outside it. */
typedef struct {
    double G, G_error;
    unsigned pierced, spared;
    int misses, crosses; /* neither: uncertain */
} local_verdict;

/* Which signs are certain: of E and of N inward a bit for each cap, of G. */
typedef struct {
    unsigned positive, negative;
} sign_bits;

typedef struct {
    sign_bits E, inward, G;
} cap_signs;

INLINE sign_bits signs_of(vd x, double error)
{
    return (sign_bits){m_bits(v_lt(v_set(error), x)),
                       m_bits(v_lt(x, v_set(-error)))};
}

INLINE sign_bits at_cap(sign_bits x, int cap)
{
    return (sign_bits){x.positive >> cap, x.negative >> cap};
}

#define FORM(name) name##_local
#define OVERLAP_INLINE INLINE
#define TRUTH unsigned
#define AND(a, b) ((a) & (b))
#define OR(a, b) ((a) | (b))
#define CAPS const cap_signs
#define E(c, i) at_cap((c)->E, i)
#define INWARD(c, i) at_cap((c)->inward, i)
#define G(c) (c)->G
#define POSITIVE(x) (x).positive
#define NEGATIVE(x) (x).negative
#define NOT_POSITIVE(x) (x).negative
#include "../signs/overlap_template.h"

INLINE void classify_bounded(local_verdict *to, const local_line *l,
                             const cylint_shape *shape, int tapered)
{
    const double unit = CYLINT_LOCAL_FORM * l->Q * l->D;
    const double widest =
        tapered ? cylint_larger(shape->r0, shape->r1) : shape->r0;
    const double eE = unit * l->D * sum_of(CYLINT_LOCAL_SECOND, l->Q, widest);
    const double eN = unit * l->D * taper_of(shape, tapered);
    const vd wp = v_set(l->w) * l->p, z = v_load(l->z);
    const vd X0 = v_sum_of(v_set(-l->z[0]), l->v, wp);
    const vd X1 = v_sum_of(v_set(-l->z[1]), l->v, wp);
    const vd r = tapered ? v_load(&shape->r0) : v_set(shape->r0);
    const vd rw = r * v_set(l->w);
    const vd E = v_sum_of(rw, rw, -v_sums(X0 * X0, X1 * X1));
    vd N = v_sum_of(z, v_set(-l->vv), v_set(l->w * l->pv));
    if (tapered)
        N = v_sum_of(rw, v_set(-shape->local.slope * l->w), N);
    const vd inward = N * v_two(-1, 1);
    const cap_signs c = {
        signs_of(E, eE), signs_of(inward, eN), {to->G > to->G_error, 0}};
    to->pierced = c.E.positive;
    to->spared = c.E.negative;
    to->misses = (int)(misses_local(&c) & 1);
    to->crosses = (int)(crosses_local(&c) & 1);
}

/* An unbounded shape is crossed if Q has two roots and missed if it has none:
 * a line cannot stay inside a double cone.  G > 0 implies A > 0, but not for a
 * double cone, where A = 0 leaves one root. */
INLINE void classify_unbounded(local_verdict *to, const local_line *l,
                               const cylint_shape *shape, int tapered)
{
    int two = to->G > to->G_error;
    if (tapered) {
        const double rho1 = shape->local.slope * l->w;
        const double A = sum_of(-rho1, rho1, l->vv);
        const double taper = taper_of(shape, 1), D = l->D * taper;
        two &= fabs(A) > CYLINT_LOCAL_A * D * D;
    }
    to->pierced = to->spared = 0;
    to->misses = 0;
    to->crosses = two;
}

INLINE local_verdict classify(const local_line *l, const cylint_shape *shape,
                              int tapered, int bounded)
{
    local_verdict v = {0, 0, 0, 0, 1, 0};
    v.G = local_G(l, shape, tapered, &v.G_error);
    if (v.G < -v.G_error)
        return v;
    if (bounded)
        classify_bounded(&v, l, shape, tapered);
    else
        classify_unbounded(&v, l, shape, tapered);
    return v;
}

/* A, B and rho1 of Q. */
typedef struct {
    double A, B, A_error, B_error;
} local_quadratic;

INLINE local_quadratic quadratic_of(const local_line *l,
                                    const cylint_shape *shape, int tapered)
{
    const double D = l->D * taper_of(shape, tapered);
    const double Q = l->Q * taper_of(shape, tapered);
    local_quadratic q = {l->vv, l->pv, CYLINT_LOCAL_A * D * D,
                         CYLINT_LOCAL_FORM * Q * D};
    if (tapered) {
        const double slope = shape->local.slope, rho1 = slope * l->w;
        q.A = sum_of(-rho1, rho1, q.A);
        q.B = sum_of(-rho1, sum_of(slope, l->z[0], shape->r0), q.B);
    }
    return q;
}

/* Where a point of a line that crosses the shape lies: before the overlap of
 * line and shape, inside it, or after it. */
enum { LOCAL_BEFORE, LOCAL_INSIDE, LOCAL_AFTER, LOCAL_UNCERTAIN };

/*
 * A point outside lies before the overlap if a point of the chord lies ahead.
 * That is a pierced cap or else the vertex of Q.  Of a double cone with A < 0
 * the overlap is taken for the part of the line between the roots, which is
 * outside the solid.
 */
INLINE int local_state(const local_line *l, const local_verdict *v,
                       const cylint_shape *shape, double t, int tapered,
                       int bounded)
{
    if (t > DBL_MAX)
        return LOCAL_AFTER;
    if (t < -DBL_MAX)
        return LOCAL_BEFORE;
    const local_quadratic q = quadratic_of(l, shape, tapered);
    const vd p = v_sum_of(v_set(t), l->v, l->p);
    const double z0 = sum_of(t, l->w, l->z[0]), z1 = sum_of(t, l->w, l->z[1]);
    const double Q = sum_of(fabs(t), l->D, l->Q);
    const double taper = taper_of(shape, tapered);
    const double rho =
        tapered ? sum_of(shape->local.slope, z0, shape->r0) : shape->r0;
    const double eZ = CYLINT_LOCAL_POSITION * Q, eP = eZ * taper;
    const double widest =
        bounded ? cylint_larger(shape->r0, shape->r1) : taper * Q;
    const double eC = 4 * eP * (widest + eP);
    const double radius2 = v_first(v_sums(p * p, p * p));
    double C = sum_of(-rho, rho, radius2);
    double toward, eT;
    if (bounded && v->pierced) {
        const double z = v->pierced & 1 ? z0 : z1;
        toward = -z * l->w;
        eT = 2 * eZ * l->D;
    } else {
        const double rate = sum_of(q.A, t, q.B), size = Q / l->Q;
        toward = tapered && !bounded && q.A < 0 ? rate : -rate;
        eT = 2 * q.B_error * size;
    }
    if (tapered && !bounded && q.A < 0)
        C = -C;
    int outside = C > eC, inside = C < -eC;
    if (bounded) {
        outside |= (z0 < -eZ) | (z1 > eZ);
        inside &= (z0 > eZ) & (z1 < -eZ);
    }
    if (inside)
        return LOCAL_INSIDE;
    if (!outside || !(fabs(toward) > eT))
        return LOCAL_UNCERTAIN;
    return toward > 0 ? LOCAL_BEFORE : LOCAL_AFTER;
}

/* Of a line that crosses: whether part of the overlap certainly lies ahead of
 * the line's origin. */
INLINE int is_ahead(const local_line *l, const local_verdict *v,
                    const cylint_shape *shape, int tapered, int bounded)
{
    const double eZ = 2 * CYLINT_LOCAL_POSITION * l->Q * l->D;
    if (bounded && v->pierced)
        return ((v->pierced & 1) && l->z[0] * l->w < -eZ) ||
               ((v->pierced & 2) && l->z[1] * l->w < -eZ);
    const local_quadratic q = quadratic_of(l, shape, tapered);
    return (!tapered || bounded || q.A > 0) && q.B < -q.B_error;
}

#endif
