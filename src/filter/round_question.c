/*
 * round_question.c - one line and one sphere, capsule or rounded cone
 *
 * Compiled once as it is and again for processors with a fused multiply-add.
 * sphere_question.h has the sphere.  Of a capsule or rounded cone lane i has the
 * forms of end i; the forms of the lateral surface are the same from both ends.
 * Lane i is also the stop at end i: on the ball where the line pierces the disc
 * of its circle, else on the lateral surface.  If both stops are on one ball,
 * both lanes have its forms.  round_lanes.h has the signs.
 */
#define CYLINT_NARROW
#include "round_lanes.h"
#include "sphere_question.h"
#include "filter.h"

#ifndef CYLINT_ROUND
#define CYLINT_ROUND cylint_round_plain
#endif

#define ARGUMENTS CYLINT_ONE_ARGUMENTS

#if LANES == 2

/* The stops as hits: lane `first` has the lesser t. */
typedef struct {
    int first, part[2];
} stop_parts;

/* The lanes on parts that are present. */
INLINE unsigned lanes_present(const stop_parts *x, const cylint_shape *shape)
{
    return (unsigned)cylint_part_is_present(shape->ends, x->part[0]) |
           (unsigned)cylint_part_is_present(shape->ends, x->part[1]) << 1;
}

/* Writes the hits of lanes in `hits`.  r: NULL if no root is wanted. */
INLINE int write_stops(unsigned want, cylint_answer *answer,
                       cylint_root_rest *rest, const stop_parts *x,
                       const lanes_root *r, unsigned hits)
{
    double t[2] = {0, 0}, more[2] = {0, 0}, error[2] = {0, 0};
    int n = 0;
    if (r) {
        v_store(t, r->value);
        v_store(more, r->more);
        v_store(error, r->error);
    }
    EACH(k, 2) {
        const int lane = k ^ x->first;
        if (!(hits >> lane & 1))
            continue;
        if (r)
            answer->hit[n].t = t[lane];
        if (want & CYLINT_WANT_PART) {
            answer->hit[n].part = x->part[lane];
            answer->hit[n].side = k;
        }
        if (r && rest) {
            rest->more[n] = more[lane];
            rest->error[n] = error[lane];
        }
        n++;
        if (want & CYLINT_WANT_NEAREST)
            break;
    }
    return answer->n = n;
}

/* The hits by rounded roots, or CYLINT_UNDECIDED. */
INLINE int accept_stops(ARGUMENTS, const stop_parts *x, const lanes_root *r)
{
    const vd low = r->value + (r->more - r->error);
    const vd high = r->value + (r->more + r->error);
    const vd tmin = v_set(line->tmin), tmax = v_set(line->tmax);
    const unsigned present = lanes_present(x, shape);
    const unsigned in = m_bits(m_and(v_lt(tmin, low), v_lt(high, tmax)));
    const unsigned out = m_bits(m_or(v_lt(high, tmin), v_lt(tmax, low)));
    unsigned hits = in & present;
    if (present & ~(in | out))
        return CYLINT_UNDECIDED;
    if (want & CYLINT_WANT_NEAREST && hits == 3)
        hits = 1u << x->first;
    if (hits & ~m_bits(r->certain))
        return CYLINT_UNDECIDED;
    return write_stops(want, answer, rest, x, r, hits);
}

/* ------------------------------------------------------------- sphere --- */

INLINE int answer_sphere(ARGUMENTS)
{
    const sphere_line l = load_sphere(shape, line);
    const stop_parts x = {0, {shape->surface, shape->surface}};
    answer->relation = CYLINT_RELATION_MISS;
    answer->n = 0;
    if (!(l.X <= CYLINT_WINDOW))
        return CYLINT_UNDECIDED;
    if (l.G < -l.G_error)
        return 0;
    if (!(l.G > l.G_error))
        return CYLINT_UNDECIDED;
    answer->relation = CYLINT_RELATION_CROSS;
    if (want & CYLINT_WANT_T) {
        if (!(l.G_error < CYLINT_RADICAND * l.G) || !cylint_rounds_to_nearest())
            return CYLINT_UNDECIDED;
        const lanes_root r = sphere_roots(&l, shape, line);
        return accept_stops(shape, line, want, answer, rest, &x, &r);
    }
    if ((want & (CYLINT_WANT_NEAREST | CYLINT_WANT_PART)) ==
            CYLINT_WANT_NEAREST &&
        shape->ends == CYLINT_ENDS_CAPPED && line->tmin <= 0 &&
        line->tmax > DBL_MAX && is_sphere_ahead(&l))
        return answer->n = 1;
    const int stops = sphere_stops(&l, line);
    return stops == CYLINT_UNDECIDED
               ? CYLINT_UNDECIDED
               : write_stops(want, answer, rest, &x, NULL,
                             (unsigned)stops & lanes_present(&x, shape));
}

/* ---------------------------------------------- capsule, rounded cone --- */

/* A capsule is a rounded cone of equal radii. */
enum { HULL = CYLINT_KIND_RCONE };

/* The terms of both ends, one in each lane. */
INLINE void load_ends(lanes_query *q, const cylint_shape *shape,
                      const cylint_line *line)
{
    terms_lanes *L = &q->L;
    lanes_shape s;
    lanes_line l;
    broadcast_shape(&s, shape);
    broadcast_line(&l, line);
    EACH(i, 3)
        s.base[i] = v_two(shape->base[i], shape->top[i]);
    s.r[0] = v_two(shape->r0, shape->r1);
    load_shape_lanes(L, &s, HULL);
    load_line_lanes(L, &s, &l);
    const vd D = v_largest(L->D[0]);
    const lanes_sizes most = {.u = v_set(line->size),
                              .w = v_set(shape->size),
                              .D = v_max(D, v_turned(D)),
                              .a = v_set(0),
                              .r = {L->r[0], L->r[0]},
                              .dr = v_abs(L->dr)};
    load_shape_sizes(&q->N, &most, HULL);
    load_line_sizes(&q->N, &most, &most);
    prepare_lanes(L, &q->N);
}

/* Bits of lanes. */
typedef struct {
    unsigned positive, negative;
} sign_bits;

INLINE sign_bits signs_of(bounded_value x)
{
    return (sign_bits){m_bits(positive(x)), m_bits(negative(x))};
}

/* What the signs say.  in, out: the line pierces the disc at an end, or passes
 * outside it.  chord: both stops are on the ball of that end. */
typedef struct {
    int misses, crosses;
    unsigned in, out, chord;
    int up;
    bounded_value G, g;
} end_verdict;

INLINE end_verdict verdict_of(const lanes_query *q)
{
    const terms_lanes *L = &q->L;
    const terms_sizes *N = &q->N;
    end_verdict v;
    v.G = with_bound(form_G_lanes(L), form_G_sizes(N));
    v.g = with_bound(form_end_ball_lanes(L, 0), form_end_ball_sizes(N, 0));
    const sign_bits G = signs_of(v.G), g = signs_of(v.g);
    const sign_bits E =
        signs_of(with_bound(form_E_lanes(L, 0), form_E_sizes(N, 0)));
    const sign_bits inward = signs_of(
        with_bound(form_N_lanes(L, 0) * v_two(-1, 1), form_N_sizes(N, 0)));
    const int outside = E.negative == 3;
    const int side = (inward.positive == 3) & (int)(G.positive & 1);
    const int no_side = (int)(G.negative & 1) | (inward.negative != 0);
    v.in = E.positive;
    v.out = E.negative;
    v.chord = outside ? inward.negative & g.positive : 0;
    v.misses = outside & no_side & ((g.negative | inward.positive) == 3);
    v.crosses = (v.in | v.chord) != 0 || (outside & side);
    v.up = m_bits(v_lt(v_set(0), L->beta)) & 1;
    return v;
}

/* Whether part of the chord certainly lies ahead of the line's origin: where it
 * pierces a disc, or is nearest to the centre of a ball, or the vertex of Q. */
INLINE int is_ahead(const lanes_query *q, const end_verdict *v)
{
    const terms_lanes *L = &q->L;
    const terms_sizes *N = &q->N;
    if (v->in) {
        const sign_bits alpha = signs_of(
            with_bound(form_alpha_lanes(L, 0), form_alpha_sizes(N, 0)));
        return (v->in & (v->up ? alpha.negative : alpha.positive)) != 0;
    }
    if (v->chord) {
        const sign_bits B = signs_of(with_bound(dot_lanes(L, L->D[0], L->u),
                                                dot_sizes(N, N->D[0], N->u)));
        return (v->chord & B.negative) != 0;
    }
    return m_bits(negative(with_bound(form_B_lanes(L), form_B_sizes(N)))) & 1;
}

/* The value of lane `end` in both lanes. */
INLINE vd of_end(vd x, int end)
{
    const vd y = end ? v_turned(x) : x;
    return v_firsts(y, y);
}

INLINE bounded_value of_end_bounded(bounded_value x, int end)
{
    return (bounded_value){of_end(x.v, end), of_end(x.e, end)};
}

/* The stops.  ball: lanes on a ball, as bits.  end: of the ball if both stops
 * are on one, else -1: each lane has its own. */
typedef struct {
    round_stop at;
    vd exits;
    unsigned ball, usable;
    int end;
    stop_parts parts;
} end_stops;

INLINE end_stops stops_of(const lanes_query *q, const end_verdict *v)
{
    end_stops x;
    vm unknown;
    round_quadratic f = quadratic_of_ball(q, v->g, 0);
    x.end = v->chord ? (int)(v->chord >> 1) : -1;
    x.ball = v->chord ? 3 : v->in;
    x.parts.first = !v->chord && !v->up;
    x.exits = x.parts.first ? v_two(1, -1) : v_two(-1, 1);
    if (v->chord) {
        f.B = of_end_bounded(f.B, x.end);
        f.radicand = of_end_bounded(f.radicand, x.end);
        f.known = v_lt(v_set(1 / CYLINT_RADICAND) * f.radicand.e, f.radicand.v);
    } else if (x.ball != 3) {
        const round_quadratic side = quadratic_of_side(q, v->G);
        f = choose_quadratic(m_from(x.ball), &f, &side);
    }
    x.at = root_of(&f, x.exits, &unknown);
    x.usable = v->chord || (v->in | v->out) == 3 ? 3 & ~m_bits(unknown) : 0;
    EACH(lane, 2)
        x.parts.part[lane] = !(x.ball >> lane & 1)         ? CYLINT_PART_LATERAL
                             : (x.end >= 0 ? x.end : lane) ? CYLINT_PART_CAP1
                                                           : CYLINT_PART_CAP0;
    return x;
}

/* Both stops rounded. */
INLINE lanes_root round_stops(const lanes_query *q, const end_stops *x,
                              const cylint_shape *shape,
                              const cylint_line *line)
{
    lanes_shape s;
    lanes_line l;
    vd center[3], radius = q->L.r[0];
    broadcast_shape(&s, shape);
    broadcast_line(&l, line);
    EACH(i, 3)
        center[i] = v_two(shape->base[i], shape->top[i]);
    if (x->end >= 0) {
        radius = of_end(radius, x->end);
        EACH(i, 3)
            center[i] = of_end(center[i], x->end);
    }
    s.r[0] = radius;
    const lanes_slopes slopes = {x->at.R,   {v_set(0), v_set(0)},
                                 x->at.A,   q->N.D[0][0],
                                 q->N.u[0], q->N.w[0],
                                 v_set(0)};
    return round_surface_root(&slopes, &s, center, &l, HULL, x->exits, x->at.t,
                              m_from(x->ball), radius);
}

/* The hits by estimates of the roots, without rounding these. */
INLINE int estimate_stops(ARGUMENTS, const end_stops *x)
{
    vm near;
    const unsigned present = lanes_present(&x->parts, shape);
    const unsigned in = m_bits(
        within_domain(x->at.t, v_set(line->tmin), v_set(line->tmax), &near));
    if (present & (~x->usable | m_bits(near)))
        return CYLINT_UNDECIDED;
    return write_stops(want, answer, rest, &x->parts, NULL, in & present);
}

INLINE int answer_hull(ARGUMENTS)
{
    lanes_query q;
    load_ends(&q, shape, line);
    const end_verdict v = verdict_of(&q);
    if (!(m_bits(v_le(q.N.D[0][0], v_set(CYLINT_WINDOW))) & 1))
        return CYLINT_UNDECIDED;
    answer->relation = v.crosses * CYLINT_RELATION_CROSS;
    answer->n = 0;
    if (v.misses)
        return 0;
    if (!v.crosses)
        return CYLINT_UNDECIDED;
    const int brief = !(want & (CYLINT_WANT_T | CYLINT_WANT_PART)) &
                      (shape->ends == CYLINT_ENDS_CAPPED) &
                      (line->tmax > DBL_MAX);
    const int nearest = (want & CYLINT_WANT_NEAREST) != 0;
    if (brief & (line->tmin < -DBL_MAX))
        return answer->n = 2 - nearest;
    if (brief & nearest & (line->tmin <= 0) && is_ahead(&q, &v))
        return answer->n = 1;
    const end_stops x = stops_of(&q, &v);
    if (!(want & CYLINT_WANT_T))
        return estimate_stops(shape, line, want, answer, rest, &x);
    if (x.usable != 3 || !cylint_rounds_to_nearest())
        return CYLINT_UNDECIDED;
    const lanes_root r = round_stops(&q, &x, shape, line);
    return accept_stops(shape, line, want, answer, rest, &x.parts, &r);
}

int CYLINT_ROUND(ARGUMENTS)
{
    return shape->kind == CYLINT_KIND_SPHERE
               ? answer_sphere(shape, line, want, answer, rest)
               : answer_hull(shape, line, want, answer, rest);
}

#else

/* Without vectors of two lanes. */
int CYLINT_ROUND(ARGUMENTS)
{
    return cylint_undecided(shape, line, want, answer, rest);
}

#endif
