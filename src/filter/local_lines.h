/*
 * local_lines.h - how a line lies to a shape, by signs in local coordinates
 *
 * The forms are those of local_forms_template.h, in doubles; where those are too
 * near to 0, local_pairs.h has them in pairs.  The bounds on their errors are in
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
#include "local_steps.h"

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

/* What bounds the shape: both planes, none, or the plane through the apex. */
enum { CYLINT_UNBOUNDED, CYLINT_BOUNDED, CYLINT_NAPPE };

/* The line in doubles.  unit: twice the error of a rounding. */
typedef struct {
    line_doubles in;
    double z[2], w;
    double Q, D, unit;
} local_line;

/* The columns of the matrix times x, y, z, each in both lanes. */
INLINE vd sideways(const cylint_local *f, vd x, vd y, vd z)
{
    const vd M0 = v_load(f->xyz[0]), M1 = v_load(f->xyz[1]),
             M2 = v_load(f->xyz[2]);
    return v_sum_of(z, M2, v_sum_of(y, M1, x * M0));
}

INLINE double along(const cylint_local *f, double x, double y, double z)
{
    return sum_of(z, f->xyz[2][2], sum_of(y, f->xyz[1][2], x * f->xyz[0][2]));
}

/* The terms of the forms of a whole line. */
INLINE void set_terms(local_line *l, const cylint_shape *shape, int tapered)
{
    l->in.r = tapered ? v_load(&shape->r0) : v_set(shape->r0);
    l->in.slope = v_set(shape->local.slope);
    if (tapered) {
        l->in.z = v_set(l->z[0]);
        l->in.w = v_set(l->w);
    }
    set_products_doubles(&l->in);
}

/* What every line needs: p and v, and of a tapered shape z and w. */
INLINE void load_start(local_line *l, const cylint_shape *shape,
                       const cylint_line *line, int tapered)
{
    const cylint_local *f = &shape->local;
    const vd from = v_load(line->o) - v_load(shape->base);
    const vd x = v_firsts(from, from), y = v_seconds(from, from);
    const vd z = v_set(line->o[2] - shape->base[2]);
    l->in.p = sideways(f, x, y, z);
    l->in.v =
        sideways(f, v_set(line->d[0]), v_set(line->d[1]), v_set(line->d[2]));
    if (tapered) {
        l->z[0] = along(f, v_first(x), v_first(y), v_first(z));
        l->w = along(f, line->d[0], line->d[1], line->d[2]);
    }
    l->Q = sum_of(v_first(v_larger_size(v_larger_size(x, y), z)), f->norm,
                  f->reach);
    l->D = line->size * f->norm;
    l->unit = CYLINT_ROUNDING;
    set_terms(l, shape, tapered);
}

/* The rest, which a line that misses does not need. */
INLINE void load_rest(local_line *l, const cylint_shape *shape,
                      const cylint_line *line, int tapered, int extent)
{
    const cylint_local *f = &shape->local;
    l->unit = CYLINT_ROUNDING;
    set_terms(l, shape, tapered);
    if (!tapered && extent != CYLINT_BOUNDED)
        return;
    if (!tapered) {
        l->z[0] =
            along(f, line->o[0] - shape->base[0], line->o[1] - shape->base[1],
                  line->o[2] - shape->base[2]);
        l->w = along(f, line->d[0], line->d[1], line->d[2]);
    }
    l->z[1] = l->z[0] - f->height;
    l->in.w = v_set(l->w);
    l->in.z = v_two(l->z[0], l->z[1]);
}

/* All of the line. */
INLINE void load_local(local_line *l, const cylint_shape *shape,
                       const cylint_line *line, int tapered)
{
    load_start(l, shape, line, tapered);
    load_rest(l, shape, line, tapered, CYLINT_BOUNDED);
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

/* The error of T, Y.v. */
INLINE double T_error(const local_line *l, const cylint_shape *shape)
{
    return CYLINT_LOCAL_FORM * l->unit * l->Q * l->D * l->D *
           taper_of(shape, 1);
}

/* What is certain of a whole line, by signs.  pierced, spared: bits of caps
 * in which the line pierces the cap's disc or passes outside it.  lanes: the
 * ends that exist (local_roots.h). */
typedef struct {
    double G, G_error;
    vm cap; /* pierced, as a mask */
    unsigned pierced, spared, lanes;
    int misses, crosses; /* neither: uncertain */
} local_verdict;

/* Which signs are certain: of E and of N inward a bit for each cap, of G. */
typedef struct {
    unsigned positive, negative;
} sign_bits;

typedef struct {
    sign_bits E, inward, G;
} cap_signs;

INLINE sign_bits signs_beyond(vd x, vd error)
{
    return (sign_bits){m_bits(v_lt(error, x)), m_bits(v_lt(x, -error))};
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

/* E and N: of both caps. */
INLINE cap_signs signs_at_caps(local_verdict *v, const local_line *l,
                               const cylint_shape *shape, vd E, vd N,
                               int tapered)
{
    const double N_error = CYLINT_LOCAL_FORM * l->unit * l->Q * l->D * l->D *
                           taper_of(shape, tapered);
    const vd E_error =
        v_set(tapered ? disc_error(l, widest_of(shape, 1)) : v->G_error);
    v->cap = v_lt(E_error, E);
    return (cap_signs){{m_bits(v->cap), m_bits(v_lt(E, -E_error))},
                       signs_beyond(N * v_two(-1, 1), v_set(N_error)),
                       {v->G > v->G_error, 0}};
}

INLINE void classify_bounded(local_verdict *to, const local_line *l,
                             const cylint_shape *shape, vd E, vd N, int tapered)
{
    const cap_signs c = signs_at_caps(to, l, shape, E, N, tapered);
    to->pierced = c.E.positive;
    to->spared = c.E.negative;
    to->lanes = 3;
    to->misses = (int)(misses_local(&c) & 1);
    to->crosses = (int)(crosses_local(&c) & 1);
}

/*
 * An unbounded shape is crossed if Q has two roots and missed if it has none:
 * a line cannot stay inside a double cone.  G > 0 implies A > 0, but not for a
 * double cone, where A = 0 leaves one root.
 *
 * If A > 0 both roots are on the nappe that holds the chord's middle, where rho
 * has the sign of T.  If A < 0 there is one on each: the line enters the nappe
 * if rho grows along it.
 */
INLINE void classify_unbounded(local_verdict *to, const local_line *l,
                               const cylint_shape *shape, double A,
                               double A_error, double T, double T_error,
                               int tapered, int extent)
{
    const int two = to->G > to->G_error;
    to->cap = m_from(0);
    to->pierced = to->spared = 0;
    to->lanes = 3;
    to->misses = 0;
    if (extent == CYLINT_NAPPE) {
        const int leaves = shape->local.slope * l->w < 0;
        to->misses = (A > A_error) & (T < -T_error);
        to->lanes = A > 0 ? 3 : 1u << leaves;
        to->crosses = two & (((A > A_error) & (T > T_error)) | (A < -A_error));
    } else {
        to->crosses = two & (!tapered | (fabs(A) > A_error));
    }
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
                          const cylint_shape *shape, int tapered, int extent)
{
    if (extent == CYLINT_BOUNDED) {
        classify_bounded(v, l, shape, E_doubles(&l->in),
                         N_doubles(&l->in, tapered), tapered);
    } else {
        const local_quadratic q = quadratic_of(l, shape, tapered);
        double T = 0;
        if (extent == CYLINT_NAPPE) {
            const vd Y = Y_doubles(&l->in);
            T = v_first(T_doubles(&l->in, &Y));
        }
        classify_unbounded(v, l, shape, q.A, q.A_error, T, T_error(l, shape),
                           tapered, extent);
    }
}

/*
 * Where the ends of the domain lie, if the line crosses the shape: before the
 * overlap of line and shape, inside it, or after it.  Bit 0: tmin, bit 1: tmax.
 */
typedef struct {
    unsigned before, inside, after;
} local_states;

/* A larger |t| counts as infinite. */
INLINE double latest(int extent)
{
    return extent == CYLINT_BOUNDED ? CYLINT_LATE : DBL_MAX;
}

/* Signs at both ends of the domain, a bit for each: of Q; of z from the plane of
 * each cap, of a nappe of rho; of A t + B. */
typedef struct {
    sign_bits C, above[2], vertex;
} domain_signs;

INLINE sign_bits reversed(sign_bits x)
{
    return (sign_bits){x.negative, x.positive};
}

/* x if `choose`, else y, without a branch. */
INLINE unsigned chosen(int choose, unsigned x, unsigned y)
{
    return y ^ ((x ^ y) & (0u - (unsigned)choose));
}

/* On which side of a pierced cap's centre the points lie, else of the vertex. */
INLINE sign_bits behind_cap(const domain_signs *at, unsigned pierced, int down)
{
    const int first = pierced & 1, any = pierced != 0;
    const unsigned positive =
        chosen(first, at->above[0].positive, at->above[1].positive);
    const unsigned negative =
        chosen(first, at->above[0].negative, at->above[1].negative);
    return (sign_bits){
        chosen(any, chosen(down, negative, positive), at->vertex.positive),
        chosen(any, chosen(down, positive, negative), at->vertex.negative)};
}

/*
 * A point outside lies before the overlap if a point of the chord lies ahead.
 * That is a pierced cap or else the vertex of Q.  Of a double cone with A < 0
 * the overlap is taken for the part of the line between the roots, which is
 * outside the solid.  Of a nappe it is a half-line then.
 */
INLINE local_states states_of(const domain_signs *at, const local_line *l,
                              const local_verdict *v, double A,
                              const cylint_line *line, int tapered, int extent)
{
    const vd t = v_load(&line->tmin), most = v_set(latest(extent));
    const unsigned above = m_bits(v_lt(most, t)),
                   below = m_bits(v_lt(t, -most)),
                   near = m_bits(v_le(v_abs(t), v_set(CYLINT_LATE)));
    sign_bits C = at->C, behind = at->vertex;
    if (extent == CYLINT_BOUNDED)
        behind = behind_cap(at, v->pierced, signbit(l->w) != 0);
    if (tapered && extent == CYLINT_UNBOUNDED && A < 0) {
        C = reversed(C);
        behind = reversed(behind);
    }
    if (extent == CYLINT_NAPPE && v->lanes != 3)
        behind = v->lanes == 1 ? (sign_bits){0, 3} : (sign_bits){3, 0};
    unsigned inside = C.negative, outside = C.positive;
    if (extent != CYLINT_UNBOUNDED) {
        inside &= at->above[0].positive;
        outside |= at->above[0].negative;
    }
    if (extent == CYLINT_BOUNDED) {
        inside &= at->above[1].negative;
        outside |= at->above[1].positive;
    }
    return (local_states){(outside & behind.negative & near) | below,
                          inside & near,
                          (outside & behind.positive & near) | above};
}

/* The ends of the domain, 0 where they are too large for the forms. */
INLINE vd near_ends(const cylint_line *line)
{
    const vd t = v_load(&line->tmin);
    return v_select(v_le(v_abs(t), v_set(CYLINT_LATE)), t, v_set(0));
}

INLINE local_states states_in_doubles(const local_line *l,
                                      const local_verdict *v,
                                      const cylint_shape *shape,
                                      const cylint_line *line, int tapered,
                                      int extent)
{
    const local_quadratic q = quadratic_of(l, shape, tapered);
    const vd t = near_ends(line);
    const vd x =
        v_sum_of(t, v_firsts(l->in.v, l->in.v), v_firsts(l->in.p, l->in.p));
    const vd y =
        v_sum_of(t, v_seconds(l->in.v, l->in.v), v_seconds(l->in.p, l->in.p));
    const vd z0 = v_sum_of(t, v_set(l->w), v_set(l->z[0]));
    const vd z1 = v_sum_of(t, v_set(l->w), v_set(l->z[1]));
    const vd r0 = v_set(shape->r0);
    const vd rho = tapered ? v_sum_of(v_set(shape->local.slope), z0, r0) : r0;
    const double taper = taper_of(shape, tapered);
    const vd Q = v_sum_of(v_abs(t), v_set(l->D), v_set(l->Q));
    const vd eZ = v_set(CYLINT_LOCAL_POSITION * l->unit) * Q;
    const vd eP = eZ * v_set(taper);
    vd widest = v_set(taper) * Q;
    if (extent == CYLINT_BOUNDED)
        widest = v_set(cylint_larger(shape->r0, shape->r1));
    domain_signs at;
    at.C = signs_beyond(v_sum_of(-rho, rho, v_sum_of(x, x, y * y)),
                        v_set(4) * eP * (widest + eP));
    at.above[0] =
        extent == CYLINT_NAPPE ? signs_beyond(rho, eP) : signs_beyond(z0, eZ);
    at.above[1] = signs_beyond(z1, eZ);
    at.vertex = signs_beyond(
        v_sum_of(v_set(q.A), t, v_set(q.B)),
        v_set(2 * CYLINT_LOCAL_FORM * l->unit * taper * taper * l->D) * Q);
    return states_of(&at, l, v, q.A, line, tapered, extent);
}

/* Of a line that crosses: whether part of the overlap certainly lies ahead of
 * the line's origin. */
INLINE int is_ahead(const local_line *l, const local_verdict *v,
                    const cylint_shape *shape, int tapered, int extent)
{
    const local_quadratic q = quadratic_of(l, shape, tapered);
    const int vertex = (!tapered | (extent == CYLINT_BOUNDED) | (q.A > 0)) &
                       (q.B < -q.B_error);
    if (extent != CYLINT_BOUNDED)
        return vertex;
    const double eZ = 2 * CYLINT_LOCAL_POSITION * l->unit * l->Q * l->D;
    const unsigned below = m_bits(v_lt(l->in.z * l->in.w, v_set(-eZ)));
    return ((v->pierced & below) != 0) | ((v->pierced == 0) & vertex);
}

#endif
