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

#include "../numbers/compiler.h"
#include "../numbers/error_bounds.h"
#include "../numbers/simd.h"
#include "../shapes/measure.h"
#include "../shapes/shape_facts.h"
#include "filter.h"

/* ---------------------------------------------------------- the ends ---- */

#ifdef CYLINT_NARROW

#define ENDS 1

/* What an array of ENDS has of end i, in all lanes. */
INLINE vd of_all(vd x, int i)
{
    return i ? v_seconds(x, x) : v_firsts(x, x);
}

INLINE vm m_of_all(vm x, int i)
{
    return i ? m_seconds(x) : m_firsts(x);
}

/* Member k of an array of ENDS, from what belongs to base and top. */
INLINE vd ends_of(vd of_base, vd of_top, int k)
{
    (void)k;
    return v_firsts(of_base, of_top);
}

#else

#define ENDS 2

INLINE vd of_all(vd x, int i)
{
    (void)i;
    return x;
}

INLINE vm m_of_all(vm x, int i)
{
    (void)i;
    return x;
}

INLINE vd ends_of(vd of_base, vd of_top, int k)
{
    return k ? of_top : of_base;
}

#endif

/* x of end i, in all lanes. */
INLINE vd of_end(const vd x[ENDS], int i)
{
    return of_all(x[i % ENDS], i);
}

INLINE vm m_of_end(const vm x[ENDS], int i)
{
    return m_of_all(x[i % ENDS], i);
}

INLINE vpair pairs_of_end(const vpair x[ENDS], int i)
{
    return (vpair){of_all(x[i % ENDS].hi, i), of_all(x[i % ENDS].lo, i)};
}

INLINE vm either_end(const vm x[ENDS])
{
    return m_or(m_of_end(x, 0), m_of_end(x, 1));
}

INLINE vm both_ends(const vm x[ENDS])
{
    return m_and(m_of_end(x, 0), m_of_end(x, 1));
}

/* In lanes of `top` the x of the top, in others the x of the base; narrow each lane
 * has that of its end. */
INLINE vd at_end(vm top, const vd x[ENDS])
{
    return ENDS == 1 ? x[0] : v_select(top, x[ENDS - 1], x[0]);
}

INLINE vm m_at_end(vm top, const vm x[ENDS])
{
    return ENDS == 1 ? x[0] : m_if(top, x[ENDS - 1], x[0]);
}

/* All lanes or none. */
INLINE vm m_if_all(int condition)
{
    return m_from(condition ? (1u << LANES) - 1 : 0);
}

/* Lanes of end 1 in member k. */
INLINE vm last_end(int k)
{
    return ENDS == 1 ? m_from(2) : m_if_all(k);
}

/* x or y, by one condition for all lanes. */
INLINE vd v_if(int condition, vd x, vd y)
{
    return condition ? x : y;
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
 * lateral surface; ball_z, ball_r: of the ends, from which those of a round cone
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
#define NEGATED(x) opposite(x)
#define TRIMMED(x) v_two_sum((x).hi, (x).lo)
#include "local_forms_template.h"

/* p, v: x and y together.  z: of the ends.  rho, growth: the radius of the lateral
 * surface at t = 0 and its growth with t.  error: of the matrix. */
typedef struct {
    vqpair p, v;
    vpair z[ENDS], w, rho, growth;
    vd error;
} pair_line;

INLINE vpair vpair_set(double hi, double lo)
{
    return (vpair){v_set(hi), v_set(lo)};
}

/* z + t w. */
INLINE vpair moved(vpair z, vpair w, vd t)
{
    vpair step = v_two_prod(t, w.hi);
    step.lo = v_sum_of(t, w.lo, step.lo);
    return vpair_add(z, step);
}

/* ------------------------------------------------- the shape and line -- */

/* Facts that can differ between shapes of one solid.  The first two: the cap is
 * present.  Only members of hits read the others. */
enum { FACT_CAP0, FACT_CAP1, FACT_SKEW, FACT_ELLIPTIC, FACT_NO_AXIS, FACTS };

INLINE int has_fact(const cylint_shape *shape, int fact)
{
    switch (fact) {
    case FACT_SKEW:
        return cylint_has_skew_rows(shape->kind);
    case FACT_ELLIPTIC:
        return cylint_is_elliptic(shape->kind);
    case FACT_NO_AXIS:
        return cylint_has_no_axis(shape);
    default:
        return cylint_caps_present(shape->ends) >> fact & 1;
    }
}

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
    return vpair_set(from->line->d[i], from->line->d_lo[i]);
}

INLINE vm fact_of(const source *from, int fact)
{
    return m_from(has_fact(from->shape, fact) ? 3 : 0);
}

#else

/* Lines as given.  segment: d_lo may differ from 0. */
typedef struct {
    vd o[3], d[3], d_lo[3], limit[2];
    int segment;
} line_lanes;

/* The numbers of shapes up to CYLINT_AT_ERROR, in their order, in fours. */
enum { MEMBERS = (CYLINT_AT_ERROR + 4) / 4 * 4 };

typedef struct {
    vd of[MEMBERS];
    vm fact[FACTS];
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

INLINE vm fact_of(const source *from, int fact)
{
    return from->frame->fact[fact];
}

#endif

INLINE vpair pair_at(const source *from, int i)
{
    return (vpair){number_at(from, i), number_at(from, i + CYLINT_LOW)};
}

/* Coordinate i of the line's origin from the base, not local. */
INLINE vd from_base_at(const source *from, int i)
{
    return origin_at(from, i) - number_at(from, CYLINT_AT_BASE + i);
}

/* Moves z from an end, whose radius is r, to the plane in which the lateral surface
 * of a round cone touches the ball there, and r to that circle. */
INLINE void move_to_circle(vd *z, vd *r, const source *from)
{
    *z = v_sum_of(number_at(from, CYLINT_AT_SINE), *r, *z);
    *r = number_at(from, CYLINT_AT_COSINE) * *r;
}

INLINE void move_to_circle_in_pairs(vpair *z, vpair *r, const source *from)
{
    *z = vpair_add(*z, vpair_mul(*r, pair_at(from, CYLINT_AT_SINE)));
    *r = vpair_mul(*r, pair_at(from, CYLINT_AT_COSINE));
}

/* The lateral surface, and z from the base. */
INLINE void set_surface(local_line *l, vd from_base, const source *from,
                        int solid)
{
    const vd one = v_set(1);
    l->from_base = l->in.z = from_base;
    l->in.r = number_at(from, CYLINT_AT_R0);
    l->in.slope = v_set(0);
    l->taper = one;
    if (cylint_solid_is_tapered(solid)) {
        l->in.slope = number_at(from, CYLINT_AT_SLOPE);
        l->taper = one + v_abs(l->in.slope);
    }
    if (solid == CYLINT_SOLID_ROUND_CONE)
        move_to_circle(&l->in.z, &l->in.r, from);
}

/* The planes, circles and balls of the ends, after set_surface(). */
INLINE void set_ends(local_line *l, const source *from, int solid)
{
    const vd r0 = number_at(from, CYLINT_AT_R0);
    vd r1 = r0, from_top = l->from_base;
    if (cylint_solid_is_tapered(solid))
        r1 = number_at(from, CYLINT_AT_R1);
    if (solid != CYLINT_SOLID_SPHERE)
        from_top = l->from_base - number_at(from, CYLINT_AT_HEIGHT);
    l->widest = v_max(r0, r1);
    if (!cylint_solid_is_bounded(solid))
        return;
    EACH(k, ENDS) {
        l->ball_z[k] = ends_of(l->from_base, from_top, k);
        l->ball_r[k] = ends_of(r0, r1, k);
        l->z[k] = l->ball_z[k];
        l->r[k] = l->ball_r[k];
        if (solid == CYLINT_SOLID_ROUND_CONE)
            move_to_circle(&l->z[k], &l->r[k], from);
    }
}

/* Sets z and the radius, after w. */
INLINE void set_heights(pair_line *to, vpair from_base, const source *from,
                        int solid)
{
    const vpair from_top =
        vpair_sub(from_base, pair_at(from, CYLINT_AT_HEIGHT));
    const vpair slope = pair_at(from, CYLINT_AT_SLOPE);
    vpair z = from_base, r = {number_at(from, CYLINT_AT_R0), v_set(0)};
    EACH(k, ENDS)
        to->z[k] = (vpair){ends_of(from_base.hi, from_top.hi, k),
                           ends_of(from_base.lo, from_top.lo, k)};
    to->rho = r;
    to->growth = vpair_set(0, 0);
    if (!cylint_solid_is_tapered(solid))
        return;
    if (solid == CYLINT_SOLID_ROUND_CONE)
        move_to_circle_in_pairs(&z, &r, from);
    to->rho = vpair_add(r, vpair_mul(slope, z));
    to->growth = vpair_mul(slope, to->w);
}

#endif
