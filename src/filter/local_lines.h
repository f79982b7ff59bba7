/*
 * local_lines.h - how a line lies to a shape, by signs in local coordinates
 *
 * The forms are those of local_forms_template.h, in doubles or, where those
 * are too near to 0, in pairs.  The bounds on their errors are in
 * error_bounds.h.  Q and D there: no coordinate of the line's origin exceeds
 * Q, none of its direction exceeds D.
 */
#ifndef CYLINT_LOCAL_LINES_H
#define CYLINT_LOCAL_LINES_H

#include "../numbers/compiler.h"
#include "../numbers/double_double.h" /* before simd.h */
#include "../numbers/error_bounds.h"
#include "../numbers/simd.h"
#include "../shapes/shape_facts.h"
#include "filter.h"

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

#define V vd
#define FORM(name) name##_doubles
#define ADD(x, y) ((x) + (y))
#define SUB(x, y) ((x) - (y))
#define MUL(x, y) ((x) * (y))
#define SUM_OF(x, y, z) v_sum_of(x, y, z)
#define NEGATED(x) (-(x))
#define TRIMMED(x) (x)
#define SUMS(x, y) v_sums(x, y)
#define TURNED(x) v_turned(x)
#define FIRSTS(x) v_firsts(x, x)
#define PAIRED(x, y) v_firsts(x, y)
#include "local_forms_template.h"

INLINE vpair vpair_turned(vpair x)
{
    return (vpair){v_turned(x.hi), v_turned(x.lo)};
}

INLINE vpair vpair_firsts(vpair x, vpair y)
{
    return (vpair){v_firsts(x.hi, y.hi), v_firsts(x.lo, y.lo)};
}

#define V vpair
#define FORM(name) name##_pairs
#define ADD(x, y) vpair_add(x, y)
#define SUB(x, y) vpair_sub(x, y)
#define MUL(x, y) vpair_mul(x, y)
#define SUM_OF(x, y, z) vpair_add(vpair_mul(x, y), z)
#define NEGATED(x) ((vpair){-(x).hi, -(x).lo})
#define TRIMMED(x) v_two_sum((x).hi, (x).lo)
#define SUMS(x, y)                \
    vpair_add(vpair_firsts(x, y), \
              vpair_firsts(vpair_turned(x), vpair_turned(y)))
#define TURNED(x) vpair_turned(x)
#define FIRSTS(x) vpair_firsts(x, x)
#define PAIRED(x, y) vpair_firsts(x, y)
#include "local_forms_template.h"

/* The line in doubles.  unit: twice the error of a rounding. */
typedef struct {
    line_doubles in;
    double z[2], w;
    double Q, D, unit;
} local_line;

INLINE void load_local(local_line *l, const cylint_shape *shape,
                       const cylint_line *line, int tapered)
{
    const cylint_local *f = &shape->local;
    const double x = line->o[0] - shape->base[0];
    const double y = line->o[1] - shape->base[1];
    const double z = line->o[2] - shape->base[2];
    const vd M0 = v_load(f->xyz[0]), M1 = v_load(f->xyz[1]),
             M2 = v_load(f->xyz[2]);
    l->in.p = v_sum_of(v_set(z), M2, v_sum_of(v_set(y), M1, v_set(x) * M0));
    l->in.v = v_sum_of(v_set(line->d[2]), M2,
                       v_sum_of(v_set(line->d[1]), M1, v_set(line->d[0]) * M0));
    const double up0 = f->xyz[0][2], up1 = f->xyz[1][2], up2 = f->xyz[2][2];
    l->z[0] = sum_of(z, up2, sum_of(y, up1, x * up0));
    l->z[1] = l->z[0] - f->height;
    l->w = sum_of(line->d[2], up2, sum_of(line->d[1], up1, line->d[0] * up0));
    l->in.z = v_two(l->z[0], l->z[1]);
    l->in.w = v_set(l->w);
    l->in.r = tapered ? v_load(&shape->r0) : v_set(shape->r0);
    l->in.slope = v_set(f->slope);
    set_products_doubles(&l->in);
    l->Q = sum_of(cylint_larger(cylint_larger(fabs(x), fabs(y)), fabs(z)),
                  f->norm, f->reach);
    l->D = line->size * f->norm;
    l->unit = CYLINT_ROUNDING;
}

/* A row of the matrix in pairs times q: row0 in lane 0, row1 in lane 1. */
INLINE vpair row_times(const cylint_local *f, const vpair q[3], int row0,
                       int row1)
{
    vpair sum = {v_set(0), v_set(0)};
    EACH(j, 3) {
        const vpair entry = {v_two(f->xyz[j][row0], f->xyz[j][row1]),
                             v_two(f->xyz_lo[j][row0], f->xyz_lo[j][row1])};
        const vpair product = vpair_mul(q[j], entry);
        sum = j ? vpair_add(sum, product) : product;
    }
    return sum;
}

INLINE vpair twice(double hi, double lo)
{
    return (vpair){v_set(hi), v_set(lo)};
}

/* The line in pairs. */
INLINE void load_pairs(line_pairs *to, const cylint_shape *shape,
                       const cylint_line *line)
{
    const cylint_local *f = &shape->local;
    vpair q[3]; /* the origin in lane 0, the direction in lane 1 */
    EACH(j, 3) {
        const pair from = two_diff(line->o[j], shape->base[j]);
        q[j] =
            (vpair){v_two(from.hi, line->d[j]), v_two(from.lo, line->d_lo[j])};
    }
    const vpair x = row_times(f, q, 0, 0), y = row_times(f, q, 1, 1);
    const vpair z = row_times(f, q, 2, 2);
    to->p = vpair_firsts(x, y);
    to->v = vpair_firsts(vpair_turned(x), vpair_turned(y));
    to->w = vpair_firsts(vpair_turned(z), vpair_turned(z));
    const vpair top = {v_two(0, f->height), v_two(0, f->height_lo)};
    to->z = vpair_sub(vpair_firsts(z, z), top);
    to->r = (vpair){v_load(&shape->r0), v_set(0)};
    to->slope = twice(f->slope, f->slope_lo);
    set_products_pairs(to);
}

/* 1 + |slope|: bounds what a slope adds to the errors. */
INLINE double taper_of(const cylint_shape *shape, int tapered)
{
    return tapered ? 1 + fabs(shape->local.slope) : 1;
}

/* The error of E, and of G of a straight shape. */
INLINE double disc_error(const local_line *l, double r)
{
    return CYLINT_LOCAL_FORM * l->unit * l->Q * l->D * l->D *
           sum_of(CYLINT_LOCAL_SECOND * l->unit, l->Q, r);
}

/* The error of G of a tapered shape. */
INLINE double cone_error(const local_line *l, const cylint_shape *shape, vd Y)
{
    const double off =
        0.5 * CYLINT_LOCAL_FORM * l->unit * l->Q * l->D * taper_of(shape, 1);
    const vd size = v_abs(Y);
    return 2 * off * (v_first(v_sums(size, size)) + off);
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

INLINE double widest_of(const cylint_shape *shape, int tapered)
{
    return tapered ? cylint_larger(shape->r0, shape->r1) : shape->r0;
}

/* E and N: of both caps. */
INLINE cap_signs signs_at_caps(const local_verdict *v, const local_line *l,
                               const cylint_shape *shape, vd E, vd N,
                               int tapered)
{
    const double N_error = CYLINT_LOCAL_FORM * l->unit * l->Q * l->D * l->D *
                           taper_of(shape, tapered);
    return (cap_signs){signs_of(E, disc_error(l, widest_of(shape, tapered))),
                       signs_of(N * v_two(-1, 1), N_error),
                       {v->G > v->G_error, 0}};
}

INLINE void classify_bounded(local_verdict *to, const local_line *l,
                             const cylint_shape *shape, vd E, vd N, int tapered)
{
    const cap_signs c = signs_at_caps(to, l, shape, E, N, tapered);
    to->pierced = c.E.positive;
    to->spared = c.E.negative;
    to->misses = (int)(misses_local(&c) & 1);
    to->crosses = (int)(crosses_local(&c) & 1);
}

/* An unbounded shape is crossed if Q has two roots and missed if it has none:
 * a line cannot stay inside a double cone.  G > 0 implies A > 0, but not for a
 * double cone, where A = 0 leaves one root. */
INLINE void classify_unbounded(local_verdict *to, double A, double A_error,
                               int tapered)
{
    to->pierced = to->spared = 0;
    to->misses = 0;
    to->crosses = (to->G > to->G_error) & (!tapered | (fabs(A) > A_error));
}

/* A and B of Q. */
typedef struct {
    double A, B, A_error, B_error;
} local_quadratic;

INLINE local_quadratic with_errors(const local_line *l,
                                   const cylint_shape *shape, vd AB,
                                   int tapered)
{
    const double D = l->D * taper_of(shape, tapered);
    const double Q = l->Q * taper_of(shape, tapered);
    const double A = v_first(AB), B = v_first(v_turned(AB));
    return (local_quadratic){A, B, CYLINT_LOCAL_A * l->unit * D * D,
                             CYLINT_LOCAL_FORM * l->unit * Q * D};
}

INLINE local_quadratic quadratic_of(const local_line *l,
                                    const cylint_shape *shape, int tapered)
{
    return with_errors(l, shape, AB_doubles(&l->in, tapered), tapered);
}

/* Computes G.  Returns 1 if it shows that the line misses. */
INLINE int classify_by_G(local_verdict *v, const local_line *l,
                         const cylint_shape *shape, int tapered)
{
    vd Y = v_set(0);
    if (tapered)
        Y = Y_doubles(&l->in);
    v->G = v_first(G_doubles(&l->in, tapered, &Y));
    v->G_error = tapered ? cone_error(l, shape, Y) : disc_error(l, shape->r0);
    return v->G < -v->G_error;
}

/* The rest, of a line that G does not show to miss. */
INLINE void classify_rest(local_verdict *v, const local_line *l,
                          const cylint_shape *shape, int tapered, int bounded)
{
    if (bounded) {
        classify_bounded(v, l, shape, E_doubles(&l->in),
                         N_doubles(&l->in, tapered), tapered);
    } else {
        const local_quadratic q = quadratic_of(l, shape, tapered);
        classify_unbounded(v, q.A, q.A_error, tapered);
    }
}

INLINE local_verdict classify(const local_line *l, const cylint_shape *shape,
                              int tapered, int bounded)
{
    local_verdict v = {0, 0, 0, 0, 1, 0};
    if (!classify_by_G(&v, l, shape, tapered))
        classify_rest(&v, l, shape, tapered, bounded);
    return v;
}

INLINE vd rounded(vpair x)
{
    return x.hi + x.lo;
}

/* As classify(), in pairs.  Writes the quadratic too, and rounds the line to
 * doubles again. */
INLINE local_verdict classify_in_pairs(local_line *l, local_quadratic *q,
                                       const cylint_shape *shape,
                                       const cylint_line *line, int tapered,
                                       int bounded)
{
    local_verdict v = {0, 0, 0, 0, 0, 0};
    line_pairs in;
    load_pairs(&in, shape, line);
    l->unit = shape->local.error;
    l->in.p = rounded(in.p);
    l->in.v = rounded(in.v);
    l->in.z = rounded(in.z);
    l->in.w = rounded(in.w);
    v_store(l->z, l->in.z);
    l->w = v_first(l->in.w);
    vpair Y = twice(0, 0);
    if (tapered)
        Y = Y_pairs(&in);
    v.G = v_first(rounded(G_pairs(&in, tapered, &Y)));
    v.G_error =
        tapered ? cone_error(l, shape, rounded(Y)) : disc_error(l, shape->r0);
    v.misses = v.G < -v.G_error;
    *q = with_errors(l, shape, rounded(AB_pairs(&in, tapered)), tapered);
    if (!v.misses && bounded)
        classify_bounded(&v, l, shape, rounded(E_pairs(&in)),
                         rounded(N_pairs(&in, tapered)), tapered);
    else if (!v.misses)
        classify_unbounded(&v, q->A, q->A_error, tapered);
    /* what the values lost when they were rounded, and A t as well when t is
     * estimated: three roundings */
    v.G_error += CYLINT_ROUNDING * fabs(v.G);
    q->A_error += 2 * CYLINT_ROUNDING * fabs(q->A);
    q->B_error += CYLINT_ROUNDING * fabs(q->B);
    return v;
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
    const vd p = v_sum_of(v_set(t), l->in.v, l->in.p);
    const double z0 = sum_of(t, l->w, l->z[0]), z1 = sum_of(t, l->w, l->z[1]);
    const double Q = sum_of(fabs(t), l->D, l->Q);
    const double taper = taper_of(shape, tapered);
    const double rho =
        tapered ? sum_of(shape->local.slope, z0, shape->r0) : shape->r0;
    const double eZ = CYLINT_LOCAL_POSITION * l->unit * Q, eP = eZ * taper;
    const double widest =
        bounded ? cylint_larger(shape->r0, shape->r1) : taper * Q;
    const double eC = 4 * eP * (widest + eP);
    const int reversed = tapered && !bounded && q.A < 0;
    double C = sum_of(-rho, rho, v_first(v_sums(p * p, p * p)));
    double toward, eT;
    if (bounded && v->pierced) {
        toward = -(v->pierced & 1 ? z0 : z1) * l->w;
        eT = 2 * eZ * l->D;
    } else {
        toward = -sum_of(q.A, t, q.B);
        eT = 2 * CYLINT_LOCAL_FORM * l->unit * taper * taper * Q * l->D;
    }
    if (reversed) {
        C = -C;
        toward = -toward;
    }
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

/* The lanes of ends in the domain, as bits, from where its limits lie; or
 * CYLINT_UNDECIDED. */
INLINE int ends_between(int from, int to, int first)
{
    if (from == LOCAL_UNCERTAIN || to == LOCAL_UNCERTAIN)
        return CYLINT_UNDECIDED;
    const int begins = (from == LOCAL_BEFORE) & (to != LOCAL_BEFORE);
    const int ends = (from != LOCAL_AFTER) & (to == LOCAL_AFTER);
    return first ? begins << 1 | ends : ends << 1 | begins;
}

/* Of a line that crosses: whether part of the overlap certainly lies ahead of
 * the line's origin. */
INLINE int is_ahead(const local_line *l, const local_verdict *v,
                    const cylint_shape *shape, int tapered, int bounded)
{
    const double eZ = 2 * CYLINT_LOCAL_POSITION * l->unit * l->Q * l->D;
    if (bounded && v->pierced)
        return ((v->pierced & 1) && l->z[0] * l->w < -eZ) ||
               ((v->pierced & 2) && l->z[1] * l->w < -eZ);
    const local_quadratic q = quadratic_of(l, shape, tapered);
    return (!tapered || bounded || q.A > 0) && q.B < -q.B_error;
}

#endif
