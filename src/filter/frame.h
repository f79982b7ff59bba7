/*
 * frame.h - a line in the local coordinates of a shape, in lanes
 *
 * Wide: each lane has a question of its own, a line and a shape.  Narrow
 * (CYLINT_NARROW): both lanes have the same question, and lane i has what belongs
 * to end i: to the cap or ball i, to the root i, or to the end i of the domain.
 * What belongs to the ends is an array of ENDS members: wide one for each end,
 * narrow one for both.
 */
#ifndef CYLINT_FRAME_H
#define CYLINT_FRAME_H

#include <float.h>

#include "../numbers/compiler.h"
#include "../numbers/double_double.h" /* before simd.h */
#include "../numbers/error_bounds.h"
#include "../numbers/simd.h"
#include "../shapes/measure.h"
#include "../shapes/shape_facts.h"
#include "filter.h"

/* ---------------------------------------------------------- the ends ---- */

#ifdef CYLINT_NARROW

#define ENDS 1

/* Of end i, in all lanes. */
INLINE vd of_end(const vd x[ENDS], int i)
{
    return i ? v_seconds(x[0], x[0]) : v_firsts(x[0], x[0]);
}

INLINE vm m_of_end(const vm x[ENDS], int i)
{
    return i ? m_seconds(x[0]) : m_firsts(x[0]);
}

INLINE vm either_end(const vm x[ENDS])
{
    return m_or(x[0], m_turned(x[0]));
}

INLINE vm both_ends(const vm x[ENDS])
{
    return m_and(x[0], m_turned(x[0]));
}

/* x[k] of end 0 and of end 1. */
INLINE vd ends_of(vd of_base, vd of_top, int k)
{
    (void)k;
    return v_firsts(of_base, of_top);
}

/* Lanes of end 1 in member k. */
INLINE vm last_end(int k)
{
    (void)k;
    return m_from(2);
}

/* Of the end at the top in lanes of `top`, in others of that at the base. */
INLINE vd at_end(vm top, const vd x[ENDS])
{
    (void)top;
    return x[0];
}

INLINE vm m_at_end(vm top, const vm x[ENDS])
{
    (void)top;
    return x[0];
}

#else

#define ENDS 2

INLINE vd of_end(const vd x[ENDS], int i)
{
    return x[i];
}

INLINE vm m_of_end(const vm x[ENDS], int i)
{
    return x[i];
}

INLINE vm either_end(const vm x[ENDS])
{
    return m_or(x[0], x[1]);
}

INLINE vm both_ends(const vm x[ENDS])
{
    return m_and(x[0], x[1]);
}

INLINE vd ends_of(vd of_base, vd of_top, int k)
{
    return k ? of_top : of_base;
}

INLINE vm last_end(int k)
{
    return m_from(k ? (1u << LANES) - 1 : 0);
}

INLINE vd at_end(vm top, const vd x[ENDS])
{
    return v_select(top, x[1], x[0]);
}

INLINE vm m_at_end(vm top, const vm x[ENDS])
{
    return m_if(top, x[1], x[0]);
}

#endif

/* x or y, as one condition of all lanes has it. */
INLINE vd v_if(int condition, vd x, vd y)
{
    return condition ? x : y;
}

INLINE vpair pairs_of_ends(vpair of_base, vpair of_top, int k)
{
    return (vpair){ends_of(of_base.hi, of_top.hi, k),
                   ends_of(of_base.lo, of_top.lo, k)};
}

/* Of end i, in all lanes. */
INLINE vpair pairs_of_end(const vpair x[ENDS], int i)
{
    vd hi[ENDS], lo[ENDS];
    EACH(k, ENDS) {
        hi[k] = x[k].hi;
        lo[k] = x[k].lo;
    }
    return (vpair){of_end(hi, i), of_end(lo, i)};
}

/* The first numbers, or the second. */
INLINE vpair pairs_of_two(vqpair x, int second)
{
    return second ? (vpair){q_high(x.hi), q_high(x.lo)}
                  : (vpair){q_low(x.hi), q_low(x.lo)};
}

/* ------------------------------------------------- the line in doubles -- */

#define NUM vd
#define FORM(name) name##_doubles
#define SUB(x, y) ((x) - (y))
#define MUL(x, y) ((x) * (y))
#define SUM_OF(x, y, z) v_sum_of(x, y, z)
#define NEGATED(x) (-(x))
#define TRIMMED(x) (x)
#include "local_forms_template.h"

/*
 * from_base: z from the base.  z, r: of the planes and circles that bound the
 * lateral surface; ball_z, ball_r: of the ends, from which those of a rounded cone
 * differ.  No coordinate of the origin exceeds Q, none of the direction D.
 * unit: the error of an operation.  taper: 1 + |slope|; widest: the larger radius.
 */
typedef struct {
    line_doubles in;
    vd from_base, Q, D, unit, taper, widest;
    vd z[ENDS], r[ENDS], ball_z[ENDS], ball_r[ENDS];
    vd limit[ENDS]; /* of the domain */
    vm cap[ENDS];   /* present */
    vm in_range;    /* no form over- or underflows */
} local_line;

/* --------------------------------------------------- the line in pairs -- */

#define NUM vpair
#define FORM(name) name##_pairs
#define SUB(x, y) vpair_sub(x, y)
#define MUL(x, y) vpair_mul(x, y)
#define SUM_OF(x, y, z) vpair_add(vpair_mul(x, y), z)
#define NEGATED(x) ((vpair){-(x).hi, -(x).lo})
#define TRIMMED(x) v_two_sum((x).hi, (x).lo)
#include "local_forms_template.h"

/* p, v: x and y together.  z: of the ends.  rho, growth: the radius of the lateral
 * surface at t = 0 and its growth with t.  error: of the matrix. */
typedef struct {
    vqpair p, v;
    vpair z[ENDS], w, rho, growth;
    vd error;
} pair_line;

INLINE vpair twice(double hi, double lo)
{
    return (vpair){v_set(hi), v_set(lo)};
}

INLINE vpair both_lanes(pair x)
{
    return twice(x.hi, x.lo);
}

/* z + t w. */
INLINE vpair moved(vpair z, vpair w, vd t)
{
    vpair step = v_two_prod(t, w.hi);
    step.lo = v_sum_of(t, w.lo, step.lo);
    return vpair_add(z, step);
}

/* ------------------------------------------------- the shape and line -- */

#ifdef CYLINT_NARROW

typedef struct {
    const cylint_shape *shape;
    const cylint_line *line;
} source;

INLINE vd number_at(const source *from, int i)
{
    return v_set(from->shape->library.number[i]);
}

INLINE vd origin_at(const source *from, int i)
{
    return v_set(from->line->o[i]);
}

INLINE vpair direction_at(const source *from, int i)
{
    return twice(from->line->d[i], from->line->d_lo[i]);
}

INLINE vm is_skew(const source *from)
{
    return m_from(cylint_has_skew_rows(from->shape->kind) ? 3 : 0);
}

INLINE vm is_elliptic(const source *from)
{
    return m_from(cylint_is_elliptic(from->shape->kind) ? 3 : 0);
}

INLINE vm has_no_axis(const source *from)
{
    return m_from(cylint_has_no_axis(from->shape) ? 3 : 0);
}

#else

/* Lines as given.  segment: u_lo may differ from 0. */
typedef struct {
    vd o[3], d[3], d_lo[3], limit[2];
    int segment;
} line_lanes;

/* The numbers of shapes up to CYLINT_AT_ERROR, in their order, in fours. */
enum { MEMBERS = (CYLINT_AT_ERROR + 4) / 4 * 4 };

/* The masks after cap: what members of hits take (shape_facts.h, measure.h). */
typedef struct {
    vd of[MEMBERS];
    vm cap[2]; /* present */
    vm skew, elliptic, no_axis;
} frames;

typedef struct {
    const frames *frame;
    const line_lanes *line;
} source;

INLINE vd number_at(const source *from, int i)
{
    return from->frame->of[i];
}

INLINE vd origin_at(const source *from, int i)
{
    return from->line->o[i];
}

INLINE vpair direction_at(const source *from, int i)
{
    return (vpair){from->line->d[i], from->line->d_lo[i]};
}

INLINE vm is_skew(const source *from)
{
    return from->frame->skew;
}

INLINE vm is_elliptic(const source *from)
{
    return from->frame->elliptic;
}

INLINE vm has_no_axis(const source *from)
{
    return from->frame->no_axis;
}

#endif

INLINE vpair pair_at(const source *from, int i)
{
    return (vpair){number_at(from, i), number_at(from, i + CYLINT_LOW)};
}

/* Sets z and the radius, after w. */
INLINE void set_heights(pair_line *to, vpair from_base, const source *from,
                        int solid)
{
    const vpair from_top =
        vpair_sub(from_base, pair_at(from, CYLINT_AT_HEIGHT));
    const vpair slope = pair_at(from, CYLINT_AT_SLOPE);
    const vpair r = {number_at(from, CYLINT_AT_R0), v_set(0)};
    vpair circle = r, from_circle = from_base;
    EACH(k, ENDS)
        to->z[k] = pairs_of_ends(from_base, from_top, k);
    to->rho = r;
    to->growth = twice(0, 0);
    if (!cylint_solid_is_tapered(solid))
        return;
    if (cylint_solid_is_round(solid)) {
        circle = vpair_mul(r, pair_at(from, CYLINT_AT_COSINE));
        from_circle =
            vpair_add(from_base, vpair_mul(r, pair_at(from, CYLINT_AT_SINE)));
    }
    to->rho = vpair_add(circle, vpair_mul(slope, from_circle));
    to->growth = vpair_mul(slope, to->w);
}

#ifdef CYLINT_NARROW

/* ------------------------------------------------- one line, one shape -- */

/* Rows x and y of the matrix times a vector. */
INLINE vd across(const cylint_shape *s, vd x, vd y, vd z)
{
    const vd M0 = v_load(cylint_column(s, 0)), M1 = v_load(cylint_column(s, 1)),
             M2 = v_load(cylint_column(s, 2));
    return v_sum_of(z, M2, v_sum_of(y, M1, x * M0));
}

/* Row z. */
INLINE vd along(const cylint_shape *s, double x, double y, double z)
{
    const double rest =
        sum_of(y, cylint_column(s, 1)[2], x * cylint_column(s, 0)[2]);
    return v_set(sum_of(z, cylint_column(s, 2)[2], rest));
}

/* The line as first computed: p and v as (x, y); z from the base and w, of
 * tapered solids and balls. */
typedef struct {
    vd p, v, from_base, w, Q, D;
} first_line;

/* z of a point from the base. */
INLINE vd height_of(const double o[3], const cylint_shape *shape, int solid)
{
    const double *b = cylint_base(shape);
    return cylint_solid_is_ball(solid)
               ? v_set(o[2] - b[2])
               : along(shape, o[0] - b[0], o[1] - b[1], o[2] - b[2]);
}

INLINE void load_along(first_line *to, const source *from, int solid)
{
    const double *d = from->line->d;
    to->from_base = height_of(from->line->o, from->shape, solid);
    to->w = cylint_solid_is_ball(solid) ? v_set(d[2])
                                        : along(from->shape, d[0], d[1], d[2]);
}

/* p and Q of a point. */
INLINE void load_point(first_line *to, const double o[3],
                       const cylint_shape *shape, int solid)
{
    const double *base = cylint_base(shape);
    const vd xy = v_load(o) - v_load(base), z = v_set(o[2] - base[2]);
    const vd x = v_firsts(xy, xy), y = v_seconds(xy, xy);
    const vd size = v_max(v_max(v_abs(x), v_abs(y)), v_abs(z));
    to->p = cylint_solid_is_ball(solid) ? xy : across(shape, x, y, z);
    to->Q =
        v_sum_of(size, v_set(cylint_norm(shape)), v_set(cylint_reach(shape)));
}

/* What G takes. */
INLINE first_line load_first(const source *from, int solid)
{
    const double *d = from->line->d;
    first_line to;
    load_point(&to, from->line->o, from->shape, solid);
    to.v = v_load(d);
    if (!cylint_solid_is_ball(solid))
        to.v = across(from->shape, v_set(d[0]), v_set(d[1]), v_set(d[2]));
    to.D = v_set(from->line->size * cylint_norm(from->shape));
    to.from_base = to.w = v_set(0);
    if (cylint_solid_is_tapered(solid) || cylint_solid_is_ball(solid))
        load_along(&to, from, solid);
    return to;
}

INLINE void set_line(local_line *l, const first_line *first,
                     const cylint_shape *shape, int solid)
{
    const int tapered = cylint_solid_is_tapered(solid);
    const vd r = v_set(cylint_r0(shape));
    l->in.p[0] = v_firsts(first->p, first->p);
    l->in.p[1] = v_seconds(first->p, first->p);
    l->in.v[0] = v_firsts(first->v, first->v);
    l->in.v[1] = v_seconds(first->v, first->v);
    set_products_doubles(&l->in);
    l->from_base = l->in.z = first->from_base;
    l->in.w = first->w;
    l->in.r = r;
    l->in.slope = v_set(tapered ? cylint_slope(shape) : 0);
    l->taper = v_set(tapered ? 1 + fabs(cylint_slope(shape)) : 1);
    l->Q = first->Q;
    l->D = first->D;
    l->unit = v_set(cylint_unit(shape));
    l->in_range = m_from(3);
    if (solid == CYLINT_SOLID_ROUND_CONE) {
        l->in.z = v_sum_of(v_set(cylint_sine(shape)), r, first->from_base);
        l->in.r = v_set(cylint_cosine(shape)) * r;
    }
}

/* The planes, circles and balls of the ends, after from_base. */
INLINE void load_ends(local_line *l, const cylint_shape *shape, int solid)
{
    const int tapered = cylint_solid_is_tapered(solid);
    l->widest = tapered
                    ? v_set(cylint_larger(cylint_r0(shape), cylint_r1(shape)))
                    : l->in.r;
    if (!cylint_solid_is_bounded(solid))
        return;
    l->ball_z[0] =
        v_firsts(l->from_base, l->from_base - v_set(cylint_height(shape)));
    l->ball_r[0] = v_set(cylint_r0(shape));
    if (tapered)
        l->ball_r[0] = v_load(cylint_radii(shape));
    l->z[0] = l->ball_z[0];
    l->r[0] = l->ball_r[0];
    if (solid == CYLINT_SOLID_ROUND_CONE) {
        l->z[0] =
            v_sum_of(v_set(cylint_sine(shape)), l->ball_r[0], l->ball_z[0]);
        l->r[0] = v_set(cylint_cosine(shape)) * l->ball_r[0];
    }
}

/* A point: the origin of a line with the direction 0. */
INLINE void load_place(local_line *l, const double o[3],
                       const cylint_shape *shape, int solid)
{
    first_line first = {.v = v_set(0), .w = v_set(0), .D = v_set(0)};
    load_point(&first, o, shape, solid);
    first.from_base = height_of(o, shape, solid);
    set_line(l, &first, shape, solid);
    load_ends(l, shape, solid);
}

/* What the stages in pairs take of the line in doubles. */
INLINE void set_sizes(local_line *l, const cylint_shape *shape,
                      const cylint_line *line, double Q, double D, int solid)
{
    const int tapered = cylint_solid_is_tapered(solid);
    const vd r = v_set(cylint_r0(shape)), both = v_load(cylint_radii(shape));
    l->Q = v_set(Q);
    l->D = v_set(D);
    l->taper = v_set(tapered ? 1 + fabs(cylint_slope(shape)) : 1);
    l->unit = v_set(cylint_frame_error(shape));
    l->in.r = r;
    l->ball_r[0] = v_if(tapered, both, r);
    l->widest = v_if(tapered, v_max(both, v_turned(both)), r);
    l->limit[0] = v_load(&line->tmin);
    l->cap[0] = m_from(cylint_caps_present(shape->ends));
}

/* z, w and the ends, loaded after the test of G. */
INLINE void load_rest(local_line *l, const source *from, int solid)
{
    if (!cylint_solid_is_tapered(solid) && cylint_solid_is_bounded(solid) &&
        !cylint_solid_is_ball(solid)) {
        first_line first;
        load_along(&first, from, solid);
        l->from_base = l->in.z = first.from_base;
        l->in.w = first.w;
    }
    l->limit[0] = v_load(&from->line->tmin);
    l->cap[0] = m_from(cylint_caps_present(from->shape->ends));
    load_ends(l, from->shape, solid);
}

/* The matrix times a vector, whose components are hi[j] + lo[j] in all lanes.
 * lo may be NULL: 0. */
INLINE vqpair transformed(const cylint_shape *s, const vq hi[3], const vq lo[3])
{
    vq product[3], error[3];
    EACH(j, 3) {
        /* four numbers at each: another follows the last column */
        const vq M = q_load(cylint_column(s, j)),
                 M_lo = q_load(cylint_column_lo(s, j));
        product[j] = q_mul(hi[j], M);
        error[j] = q_product_error(hi[j], M, product[j]);
        error[j] = q_sum_of(hi[j], M_lo, error[j]);
        if (lo)
            error[j] = q_sum_of(lo[j], M, error[j]);
    }
    const vqpair two = q_two_sum(product[0], product[1]);
    const vqpair all = q_two_sum(two.hi, product[2]);
    return (vqpair){all.hi, q_add(q_add(q_add(error[0], error[1]), error[2]),
                                  q_add(two.lo, all.lo))};
}

INLINE vqpair origin_in_pairs(const source *from, int solid)
{
    const vqpair x =
        q_two_diff(q_load(from->line->o), q_load(cylint_base(from->shape)));
    const vq hi[3] = {q_firsts(x.hi), q_seconds(x.hi), q_thirds(x.hi)};
    const vq lo[3] = {q_firsts(x.lo), q_seconds(x.lo), q_thirds(x.lo)};
    return cylint_solid_is_ball(solid) ? x : transformed(from->shape, hi, lo);
}

INLINE vqpair direction_in_pairs(const source *from, int solid)
{
    const double *d = from->line->d, *d_lo = from->line->d_lo;
    const vq hi[3] = {q_set(d[0]), q_set(d[1]), q_set(d[2])};
    const vq lo[3] = {q_set(d_lo[0]), q_set(d_lo[1]), q_set(d_lo[2])};
    if (cylint_solid_is_ball(solid))
        return (vqpair){q_load(d), q_load(d_lo)};
    return transformed(from->shape, hi, from->line->segment ? lo : NULL);
}

/* x and y: (x, x, y, y).  z in both lanes. */
INLINE vqpair across_of(vqpair x)
{
    return (vqpair){q_spread(q_low(x.hi)), q_spread(q_low(x.lo))};
}

INLINE vpair along_of(vqpair x)
{
    const vd hi = q_high(x.hi), lo = q_high(x.lo);
    return (vpair){v_firsts(hi, hi), v_firsts(lo, lo)};
}

/* moves: with v and w, which are 0 else. */
INLINE void load_pairs(pair_line *to, const source *from, int moves, int solid)
{
    const vqpair p = origin_in_pairs(from, solid);
    vqpair v = {q_set(0), q_set(0)};
    if (moves)
        v = direction_in_pairs(from, solid);
    to->p = across_of(p);
    to->v = across_of(v);
    to->w = along_of(v);
    to->error = v_set(cylint_frame_error(from->shape));
    set_heights(to, along_of(p), from, solid);
}

#else

/* ----------------------------------------------- a question in each lane -- */

INLINE vm m_if_all(int condition)
{
    return m_from(condition ? (1u << LANES) - 1 : 0);
}

/* The same shape in all lanes. */
INLINE void broadcast_shape(frames *to, const cylint_shape *shape)
{
    const unsigned caps = cylint_caps_present(shape->ends);
    for (int i = 0; i < MEMBERS; i++)
        to->of[i] = v_set(shape->library.number[i]);
    to->cap[0] = m_if_all(caps & 1);
    to->cap[1] = m_if_all(caps & 2);
    to->skew = m_if_all(cylint_has_skew_rows(shape->kind));
    to->elliptic = m_if_all(cylint_is_elliptic(shape->kind));
    to->no_axis = m_if_all(cylint_has_no_axis(shape));
}

/* Reads members of the shapes, each at shape[lane], from `first` to before `end`
 * in fours. */
INLINE void gather_members(frames *to, const cylint_shape *const shape[LANES],
                           int first, int end)
{
    const char *row[LANES];
    for (int i = 0; i < LANES; i++)
        row[i] = (const char *)shape[i]->library.number;
    for (int i = first; i < end; i += 4)
        v_columns(row, (size_t)i * sizeof(double), &to->of[i]);
}

/* What all of a solid's questions read. */
INLINE void gather_numbers(frames *to, const cylint_shape *const shape[LANES],
                           int solid)
{
    gather_members(to, shape, 0,
                   cylint_solid_is_ball(solid)
                       ? CYLINT_AT_R1
                       : CYLINT_AT_COLUMNS + CYLINT_LOW);
}

/* The same and the caps, and then what roots read: the low parts. */
INLINE void gather_shapes(frames *to, const cylint_shape *const shape[LANES],
                          int solid)
{
    unsigned caps[2] = {0, 0};
    for (int i = 0; i < LANES; i++) {
        const unsigned present = cylint_caps_present(shape[i]->ends);
        caps[0] |= (present & 1) << i;
        caps[1] |= (present >> 1) << i;
    }
    to->cap[0] = m_from(caps[0]);
    to->cap[1] = m_from(caps[1]);
    gather_numbers(to, shape, solid);
}

INLINE void gather_pairs(frames *to, const cylint_shape *const shape[LANES],
                         int solid)
{
    if (!cylint_solid_is_ball(solid))
        gather_members(to, shape, CYLINT_AT_COLUMNS + CYLINT_LOW, MEMBERS);
}

/* What members of hits take of the kinds. */
INLINE void gather_kinds(frames *to, const cylint_shape *const shape[LANES])
{
    unsigned skew = 0, elliptic = 0, no_axis = 0;
    for (int i = 0; i < LANES; i++) {
        skew |= (unsigned)cylint_has_skew_rows(shape[i]->kind) << i;
        elliptic |= (unsigned)cylint_is_elliptic(shape[i]->kind) << i;
        no_axis |= (unsigned)cylint_has_no_axis(shape[i]) << i;
    }
    to->skew = m_from(skew);
    to->elliptic = m_from(elliptic);
    to->no_axis = m_from(no_axis);
}

INLINE vd v_largest(const vd x[3])
{
    return v_max(v_max(v_abs(x[0]), v_abs(x[1])), v_abs(x[2]));
}

INLINE vd row_of(const frames *f, int row, const vd x[3])
{
    return v_sum_of(x[2], f->of[CYLINT_AT_COLUMNS + 6 + row],
                    v_sum_of(x[1], f->of[CYLINT_AT_COLUMNS + 3 + row],
                             x[0] * f->of[CYLINT_AT_COLUMNS + row]));
}

/* The line's origin, and what of the shape G takes. */
INLINE void load_point(local_line *l, const vd o[3], const frames *f, int solid)
{
    const int tapered = cylint_solid_is_tapered(solid);
    const int ball = cylint_solid_is_ball(solid);
    vd x[3];
    EACH(i, 3)
        x[i] = o[i] - f->of[CYLINT_AT_BASE + i];
    EACH(i, 2)
        l->in.p[i] = v_if(ball, x[i], row_of(f, i, x));
    l->from_base = v_if(ball, x[2], row_of(f, 2, x));
    l->in.z = l->from_base;
    l->in.r = f->of[CYLINT_AT_R0];
    l->in.slope = v_if(tapered, f->of[CYLINT_AT_SLOPE], v_set(0));
    if (solid == CYLINT_SOLID_ROUND_CONE) {
        l->in.z =
            v_sum_of(f->of[CYLINT_AT_SINE], f->of[CYLINT_AT_R0], l->from_base);
        l->in.r = f->of[CYLINT_AT_COSINE] * f->of[CYLINT_AT_R0];
    }
    l->Q = v_if(
        ball, v_largest(x) + f->of[CYLINT_AT_R0],
        v_sum_of(v_largest(x), f->of[CYLINT_AT_NORM], f->of[CYLINT_AT_REACH]));
    l->unit = v_set(solid == CYLINT_SOLID_ROUND_CONE
                        ? CYLINT_LOCAL_ROUND * CYLINT_ROUNDING
                        : CYLINT_ROUNDING);
    l->taper =
        v_if(tapered, v_set(1) + v_abs(f->of[CYLINT_AT_SLOPE]), v_set(1));
    l->in_range = v_le(v_largest(o), v_set(CYLINT_FAR));
}

INLINE void load_first(local_line *l, const source *from, int solid)
{
    const frames *f = from->frame;
    const int ball = cylint_solid_is_ball(solid);
    const vd *d = from->line->d;
    const vd size = v_largest(d), most = v_set(CYLINT_WINDOW);
    load_point(l, from->line->o, f, solid);
    EACH(i, 2)
        l->in.v[i] = v_if(ball, d[i], row_of(f, i, d));
    l->in.w = v_if(ball, d[2], row_of(f, 2, d));
    set_products_doubles(&l->in);
    l->D = v_if(ball, size, size * f->of[CYLINT_AT_NORM]);
    l->in_range =
        m_and(m_and(v_le(v_set(1 / CYLINT_WINDOW), size), v_le(size, most)),
              l->in_range);
}

/* The planes, circles and balls of the ends, after from_base. */
INLINE void load_ends(local_line *l, const frames *f, int solid)
{
    const int tapered = cylint_solid_is_tapered(solid);
    const int ball = cylint_solid_is_ball(solid);
    l->widest = v_if(tapered, v_max(f->of[CYLINT_AT_R0], f->of[CYLINT_AT_R1]),
                     f->of[CYLINT_AT_R0]);
    EACH(k, 2) {
        l->ball_z[k] = v_if(k && !ball, l->from_base - f->of[CYLINT_AT_HEIGHT],
                            l->from_base);
        l->ball_r[k] = f->of[CYLINT_AT_R0 + (tapered ? k : 0)];
        l->z[k] = l->ball_z[k];
        l->r[k] = l->ball_r[k];
        if (solid == CYLINT_SOLID_ROUND_CONE) {
            l->z[k] = v_sum_of(f->of[CYLINT_AT_SINE], f->of[CYLINT_AT_R0 + k],
                               l->ball_z[k]);
            l->r[k] = f->of[CYLINT_AT_COSINE] * f->of[CYLINT_AT_R0 + k];
        }
    }
}

INLINE void load_rest(local_line *l, const source *from, int solid)
{
    EACH(k, 2) {
        l->limit[k] = from->line->limit[k];
        l->cap[k] = from->frame->cap[k];
    }
    load_ends(l, from->frame, solid);
}

/* A point: the origin of a line with the direction 0. */
INLINE void load_place(local_line *l, const vd o[3], const frames *f, int solid)
{
    load_point(l, o, f, solid);
    l->in.v[0] = l->in.v[1] = l->in.w = l->D = v_set(0);
    load_ends(l, f, solid);
}

/* A row of the matrix times x.  exact: x has no low parts. */
INLINE vpair row_in_pairs(const frames *f, int row, const vpair x[3], int exact)
{
    vpair product[3];
    EACH(j, 3) {
        product[j] =
            v_two_prod(x[j].hi, f->of[CYLINT_AT_COLUMNS + 3 * j + row]);
        product[j].lo = v_sum_of(
            x[j].hi, f->of[CYLINT_AT_COLUMNS + CYLINT_LOW + 3 * j + row],
            product[j].lo);
        if (!exact)
            product[j].lo = v_sum_of(
                x[j].lo, f->of[CYLINT_AT_COLUMNS + 3 * j + row], product[j].lo);
    }
    const vpair first = v_two_sum(product[0].hi, product[1].hi);
    const vpair all = v_two_sum(first.hi, product[2].hi);
    return (vpair){all.hi, ((product[0].lo + product[1].lo) + product[2].lo) +
                               (first.lo + all.lo)};
}

INLINE void load_pairs(pair_line *to, const source *from, int solid)
{
    const frames *f = from->frame;
    const int ball = cylint_solid_is_ball(solid);
    const int exact = !from->line->segment;
    vpair x[3], d[3], p[3], v[3];
    EACH(i, 3) {
        x[i] = v_two_sum(from->line->o[i], -f->of[CYLINT_AT_BASE + i]);
        d[i] = direction_at(from, i);
    }
    EACH(i, 3) {
        p[i] = ball ? x[i] : row_in_pairs(f, i, x, 0);
        v[i] = ball ? d[i] : row_in_pairs(f, i, d, exact);
    }
    to->p = (vqpair){q_join(p[0].hi, p[1].hi), q_join(p[0].lo, p[1].lo)};
    to->v = (vqpair){q_join(v[0].hi, v[1].hi), q_join(v[0].lo, v[1].lo)};
    to->w = v[2];
    to->error = v_if(ball, v_set(CYLINT_LOCAL_ERROR), f->of[CYLINT_AT_ERROR]);
    set_heights(to, p[2], from, solid);
}

#endif

#endif
