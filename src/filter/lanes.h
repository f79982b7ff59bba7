/*
 * lanes.h - a line and a shape in every lane: decisions in doubles
 *
 * The forms of forms_template.h in doubles give two intervals whose overlap is
 * the answer, with bounds on their errors.  One step of Newton's in pairs of
 * doubles rounds each root that is wanted.  A lane with an uncertain sign or
 * rounding is marked undecided; then intersect.c computes its answer.  All
 * decided answers are exact.
 *
 * The error bounds are those of error_bounds.h with one simplification: the
 * sizes are computed from the largest components of u, w, D, ..., once for all
 * forms.
 */
#ifndef CYLINT_KERNEL_H
#define CYLINT_KERNEL_H

#include "../numbers/error_bounds.h"
#include "cylint.h"
#include "../numbers/compiler.h"
#include "../numbers/simd.h"
#include "../shapes/shape_facts.h"
#include "../signs/radical.h"
#include "lanes_frame.h"

#define BEGIN (void)L;
#define RETURN(x) return x;
#define MEMORY

#define NUM vd
#define FORM(name) name##_lanes
#define ADD(x, y) ((x) + (y))
#define SUB(x, y) ((x) - (y))
#define MUL(x, y) ((x) * (y))
#include "../signs/forms_template.h"

#define NUM vd
#define FORM(name) name##_sizes
#define ADD(x, y) ((x) + (y))
#define SUB(x, y) ((x) + (y))
#define MUL(x, y) ((x) * (y))
#include "../signs/forms_template.h"

#define NUM vpair
#define FORM(name) name##_pairs
#define ADD(x, y) vpair_add(x, y)
#define SUB(x, y) vpair_sub(x, y)
#define MUL(x, y) vpair_mul(x, y)
#include "../signs/forms_template.h"
#undef MEMORY
#undef BEGIN
#undef RETURN

INLINE vd v_times(vd x, vd y)
{
    return x * y;
}

/* What the lanes hold of lines and shapes; see cylint.h for the members. */
typedef struct {
    vd o[3], u[3], u_lo[3], tmin, tmax;
    int segment; /* 0: u_lo is 0 */
} lanes_line;

typedef struct {
    vd base[3], top[3], axis[3], axis_lo[3], a[3], b[3], r[2], dr, dr_lo;
    vm cap[2]; /* present */
    lanes_frame frame;
} lanes_shape;

/* The same line and shape in all lanes. */
INLINE void broadcast_line(lanes_line *to, const cylint_line *l)
{
    EACH(i, 3) {
        to->o[i] = v_set(l->o[i]);
        to->u[i] = v_set(l->d[i]);
        to->u_lo[i] = v_set(l->d_lo[i]);
    }
    to->tmin = v_set(l->tmin);
    to->tmax = v_set(l->tmax);
    to->segment = l->segment;
}

/* kind: of the shape. */
INLINE void broadcast_shape(lanes_shape *to, const cylint_shape *s, int kind)
{
    EACH(i, 3) {
        to->base[i] = v_set(s->base[i]);
        to->top[i] = v_set(s->top[i]);
    }
    to->r[0] = v_set(s->r0);
    to->r[1] = v_set(s->r1);
    const unsigned all = (1u << LANES) - 1, caps = cylint_caps_present(s->ends);
    to->cap[0] = m_from(caps & 1 ? all : 0);
    to->cap[1] = m_from(caps & 2 ? all : 0);
    if (cylint_is_hull(kind))
        broadcast_frame(&to->frame, &s->local);
    if (cylint_is_round(kind))
        return;
    EACH(i, 3) {
        to->axis[i] = v_set(s->axis[i]);
        to->axis_lo[i] = v_set(s->axis_lo[i]);
        to->a[i] = v_set(s->a[i]);
        to->b[i] = v_set(s->left_handed ? -s->b[i] : s->b[i]);
    }
    to->dr = v_set(s->dr);
    to->dr_lo = v_set(s->dr_lo);
}

/* A value with a bound on its error. */
typedef struct {
    vd v, e;
} bounded_value;

INLINE vd v_largest(const vd x[3])
{
    return v_max(v_max(v_abs(x[0]), v_abs(x[1])), v_abs(x[2]));
}

INLINE bounded_value with_bound(vd v, vd size)
{
    return (bounded_value){v, v_set(CYLINT_FILTER_BOUND) * size +
                                  v_set(CYLINT_UNDERFLOW)};
}

/* x / y for certain y. */
INLINE bounded_value quotient(bounded_value x, bounded_value y)
{
    const vd inverse = v_set(1) / y.v, t = x.v * inverse;
    return (bounded_value){t, (x.e + v_abs(t) * y.e) * v_abs(inverse) *
                                      v_set(CYLINT_LANES_SLACK) +
                                  v_abs(t) * v_set(CYLINT_QUOTIENT_ROUNDING)};
}

/* cross: the relation is cross; neither cross nor undecided: it is miss.
 * hit: in the domain, on a part that is present.  leaving_first: the first
 * stop ends an overlap, the second begins one. */
typedef struct {
    vm undecided, cross, hit[2], leaving_first;
    bounded_value stop[2];
    vd part[2];
} lanes_verdict;

/* Clearly of a sign. */
INLINE vm certain(bounded_value x)
{
    return v_lt(v_set(1 / CYLINT_FIRST_ORDER) * x.e, v_abs(x.v));
}

INLINE vm above(bounded_value x, bounded_value y)
{
    return v_lt((x.e + y.e) * v_set(CYLINT_LANES_SLACK), x.v - y.v);
}

INLINE bounded_value limit(vd t)
{
    return (bounded_value){t, v_set(0)};
}

INLINE bounded_value choose(vm m, bounded_value x, bounded_value y)
{
    return (bounded_value){v_select(m, x.v, y.v), v_select(m, x.e, y.e)};
}

/* The later (or else the earlier) of two stops. */
INLINE bounded_value inner(bounded_value x, bounded_value y, int last)
{
    const vm first = v_lt(x.v, y.v);
    return last ? choose(first, y, x) : choose(first, x, y);
}

/* Everything about a lane that later steps need. */
typedef struct {
    terms_lanes L;
    terms_sizes N; /* the same terms, each its largest component */
    bounded_value A, B, R, beta, alpha[2];
} lanes_query;

INLINE void prepare_lanes(terms_lanes *L, terms_sizes *N)
{
    prepare_shape_lanes(L);
    prepare_shape_sizes(N);
    prepare_line_lanes(L);
    prepare_line_sizes(N);
}

#define FORM(name) name##_lanes
#define LOAD_INLINE INLINE
#define SHAPE lanes_shape
#define LINE lanes_line
#define DIRECTION(l, i) l->u[i]
#define AXIS(s, i) s->axis[i]
#define FROM_BASE(l, s, i) l->o[i] - s->base[i]
#define FROM_TOP(l, s, i) l->o[i] - s->top[i]
#define BEFORE_TOP(D, w) D - w
#define SEMI_AXIS_A(s, i) s->a[i]
#define SEMI_AXIS_B(s, i) s->b[i]
#define RADIUS(s, end) s->r[end]
#define RADIUS_GROWTH(s) s->dr
#define ONE v_set(1)
#include "../signs/load_template.h"

/* The largest components of the data. */
typedef struct {
    vd u, w, D, a, r[2], dr;
} lanes_sizes;

#define FORM(name) name##_sizes
#define LOAD_INLINE INLINE
#define SHAPE lanes_sizes
#define LINE lanes_sizes
#define DIRECTION(l, i) l->u
#define AXIS(s, i) s->w
#define FROM_BASE(l, s, i) l->D
#define FROM_TOP(l, s, i) l->D
#define BEFORE_TOP(D, w) D
#define SEMI_AXIS_A(s, i) s->a
#define SEMI_AXIS_B(s, i) s->a
#define RADIUS(s, end) s->r[end]
#define RADIUS_GROWTH(s) s->dr
#define ONE v_set(1)
#include "../signs/load_template.h"

/* The terms of lines and shapes in lanes, and their sizes. */
INLINE void load_terms(lanes_query *q, const lanes_shape *s,
                       const lanes_line *l, int kind, int bounded)
{
    terms_lanes *L = &q->L;
    load_shape_lanes(L, s, kind);
    load_line_lanes(L, s, l);
    load_top_lanes(L, s, l);
    lanes_sizes most = {v_largest(L->u), v_largest(L->w),    v_largest(L->D[0]),
                        v_set(0),        {s->r[0], s->r[1]}, v_abs(s->dr)};
    if (bounded)
        most.D = v_max(most.D, v_largest(L->D[1]));
    if (cylint_is_elliptic(kind))
        most.a = v_max(v_largest(s->a), v_largest(s->b));
    load_shape_sizes(&q->N, &most, kind);
    load_line_sizes(&q->N, &most, &most);
    load_top_sizes(&q->N, &most, &most);
    prepare_lanes(L, &q->N);
}

/* Lanes whose data lie in the window of error_bounds.h. */
INLINE vm lanes_in_window(const lanes_query *q, int kind)
{
    const terms_sizes *N = &q->N;
    const vd most = v_set(CYLINT_WINDOW), least = v_set(1 / CYLINT_WINDOW);
    vm within = m_and(m_and(v_le(N->u[0], most), v_le(least, N->u[0])),
                      m_and(v_le(N->w[0], most), v_le(N->D[0][0], most)));
    vd length = N->w[0];
    if (cylint_is_elliptic(kind)) {
        within = m_and(within, v_le(N->a[0], most));
        length = v_max(length, N->a[0]);
    }
    if (!cylint_has_factors(kind))
        length = v_max(length, v_max(N->r[0], N->r[1]));
    within = m_and(within, v_le(v_max(N->r[0], N->r[1]), most));
    return m_and(within, v_le(least, length));
}

/* A, B and R = sqrt(S G) of lanes with G > 0.  Returns which of them are not
 * known well enough for a root. */
INLINE vm lateral_quadratic(lanes_query *q, bounded_value G, int kind)
{
    const terms_lanes *L = &q->L;
    const terms_sizes *N = &q->N;
    q->A = with_bound(form_A_lanes(L), form_A_sizes(N));
    q->B = with_bound(form_B_lanes(L), form_B_sizes(N));
    const vd S = form_root_of_S_lanes(L);
    /* mutant '*' -> '+': slower, a larger bound */
    const vd eS = v_set(CYLINT_FILTER_BOUND) * form_root_of_S_sizes(N);
    /* dR / R <= dG / G + dS / S while these are small */
    const vd SG = S * G.v, R = CYLINT_RADICAL(kind, S, G.v, v_times, v_sqrt);
    q->R = (bounded_value){
        /* mutant '*' -> '+': a larger bound, or a smaller one that
         * CYLINT_RADICAL_ROUNDING covers */
        R, R * ((S * G.e + eS * G.v) / SG + v_set(CYLINT_RADICAL_ROUNDING))};
    vm known = m_and(certain(q->A),
                     certain((bounded_value){S, eS + v_set(CYLINT_UNDERFLOW)}));
    known = m_and(known, v_lt(v_set(1 / CYLINT_RADICAND) * G.e, G.v));
    if (!cylint_S_is_square(kind)) /* else nothing can have underflowed */
        known = m_and(known, v_lt(v_set(CYLINT_RADICAL_LEAST), R));
    return m_not(known);
}

/* What A divides for a root: -1 for the entry root, +1 for the exit root. */
INLINE bounded_value lateral_numerator(const lanes_query *q, vd exits)
{
    return (bounded_value){-q->B.v + exits * q->R.v,
                           (q->B.e + q->R.e) * v_set(CYLINT_LANES_SLACK)};
}

/* The interval in which the lateral quadric is within, of lanes with G > 0:
 * for one side of a cone it may have no beginning or no end. */
INLINE void lateral_interval(lanes_query *q, bounded_value G, int kind,
                             int bounded, bounded_value stop[2], vm *uncertain,
                             vm *outside)
{
    const terms_lanes *L = &q->L;
    *uncertain = m_or(*uncertain, lateral_quadratic(q, G, kind));
    stop[0] = quotient(lateral_numerator(q, v_set(-1)), q->A);
    stop[1] = quotient(lateral_numerator(q, v_set(1)), q->A);
    *outside = v_lt(q->A.v, v_set(0));
    if (bounded && cylint_is_tapered(kind)) {
        /* on the nappe of the solid rho grows along the line, or shrinks */
        const vd growth = q->beta.v * L->dr;
        const vm ends = m_and(*outside, v_lt(growth, v_set(0)));
        const vm begins = m_and(*outside, m_not(v_lt(growth, v_set(0))));
        stop[0] = choose(ends, limit(v_set(-HUGE_VAL)), stop[0]);
        stop[1] = choose(begins, limit(v_set(HUGE_VAL)), stop[1]);
    }
}

/* The slab between the caps, first plane first. */
INLINE void slab_interval(lanes_query *q, bounded_value plane[2], vm *uncertain,
                          vm *up)
{
    const terms_lanes *L = &q->L;
    const vd size = form_alpha_sizes(&q->N, 0);
    EACH(i, 2)
        q->alpha[i] = with_bound(-form_alpha_lanes(L, i), size);
    *uncertain = m_or(*uncertain, m_not(certain(q->beta)));
    *up = v_lt(v_set(0), q->beta.v);
    const bounded_value at0 = quotient(q->alpha[0], q->beta);
    const bounded_value at1 = quotient(q->alpha[1], q->beta);
    plane[0] = choose(*up, at0, at1);
    plane[1] = choose(*up, at1, at0);
}

/* Which stops are hits; uncertain where a limit is too near. */
INLINE vm within_domain(bounded_value t, vd tmin, vd tmax, vm *uncertain)
{
    const bounded_value from = limit(tmin), to = limit(tmax);
    const vm in = m_and(above(t, from), above(to, t));
    const vm out = m_or(above(from, t), above(t, to));
    *uncertain = m_not(m_or(in, out));
    return in;
}

INLINE vm part_present(const lanes_shape *s, vd part)
{
    const vm cap0 = v_eq(part, v_set(CYLINT_PART_CAP0));
    const vm cap1 = v_eq(part, v_set(CYLINT_PART_CAP1));
    const vm lateral = m_not(m_or(cap0, cap1));
    return m_or(lateral, m_or(m_and(cap0, s->cap[0]), m_and(cap1, s->cap[1])));
}

#define FORM(name) name##_lanes
#define OVERLAP_INLINE INLINE
#define TRUTH vm
#define PART vd
#define CHOOSE(a, x, y) v_select(a, x, y)
#define CAP0 v_set(CYLINT_PART_CAP0)
#define CAP1 v_set(CYLINT_PART_CAP1)
#define LATERAL v_set(CYLINT_PART_LATERAL)
#define VALUE bounded_value
#define LATER(s, t) above(s, t)
#include "../signs/overlap_template.h"

/*
 * Relation and hits.  kind is a constant where this is inlined; bounded: the
 * ends are planes.  An unbounded kind other than cylinder and ecylinder is
 * the double cone (its nappe is for intersect.c).  lanes: those in use.
 */
INLINE lanes_verdict lanes_classify(lanes_query *q, const lanes_shape *s,
                                    const lanes_line *l, int kind, int bounded,
                                    vm lanes)
{
    const vm none = m_from(0);
    const vd lateral = v_set(CYLINT_PART_LATERAL), zero = v_set(0);
    const bounded_value nowhere = {zero, zero};
    lanes_verdict v = {
        none, none, {none, none}, none, {nowhere, nowhere}, {lateral, lateral}};
    q->A = q->B = q->R = q->beta = nowhere;
    load_terms(q, s, l, kind, bounded);
    const bounded_value G =
        with_bound(form_G_lanes(&q->L), form_G_sizes(&q->N));
    const vm window = lanes_in_window(q, kind);
    const vm alive = m_and(lanes, m_not(m_and(window, v_lt(G.v, -G.e))));
    if (!m_any(alive))
        return v;

    vm uncertain = m_not(window), outside;
    bounded_value *const stop = v.stop;
    q->beta = with_bound(q->L.beta, form_beta_sizes(&q->N));
    lateral_interval(q, G, kind, bounded, stop, &uncertain, &outside);
    if (bounded) {
        bounded_value plane[2];
        vm up, certain_ends;
        slab_interval(q, plane, &uncertain, &up);
        const bounds_lanes by = bounds_of_lanes(stop, plane);
        certain_ends = m_and(m_or(by.by_root[0], by.by_plane[0]),
                             m_or(by.by_root[1], by.by_plane[1]));
        EACH(i, 2) {
            v.part[i] = part_at_lanes(up, m_not(by.by_root[i]), i);
            stop[i] = inner(stop[i], plane[i], !i);
        }
        const vm apart = above(stop[0], stop[1]);
        v.cross = m_and(above(stop[1], stop[0]), certain_ends);
        uncertain = m_or(uncertain, m_not(m_or(apart, v.cross)));
    } else {
        const bounded_value first = stop[0];
        v.leaving_first = outside;
        stop[0] = choose(outside, stop[1], first);
        stop[1] = choose(outside, first, stop[1]);
        /* mutant '0' -> '1': slower, the next stage decides */
        v.cross = above(stop[1], stop[0]);
        uncertain = m_or(uncertain, m_not(v.cross));
    }
    v.cross = m_and(m_and(v.cross, alive), m_not(uncertain));
    v.undecided = m_and(alive, uncertain);
    EACH(i, 2) {
        vm near;
        const vm in = within_domain(stop[i], l->tmin, l->tmax, &near);
        const vm there = m_and(v.cross, part_present(s, v.part[i]));
        v.hit[i] = m_and(there, in);
        v.undecided = m_or(v.undecided, m_and(there, near));
    }
    v.cross = m_and(v.cross, m_not(v.undecided));
    v.hit[0] = m_and(v.hit[0], v.cross);
    v.hit[1] = m_and(v.hit[1], v.cross);
    return v;
}

/* What rounding takes from a query that was judged. */
typedef struct {
    bounded_value R, beta;
    vd A, D, u, w, a; /* |A|; the largest components of vectors */
} lanes_slopes;

INLINE lanes_slopes slopes_of(const lanes_query *q)
{
    return (lanes_slopes){q->R,
                          q->beta,
                          v_abs(q->A.v),
                          q->N.D[0][0],
                          q->N.u[0],
                          q->N.w[0],
                          elliptic_sizes(&q->N) ? q->N.a[0] : v_set(0)};
}

/* A root rounded: value + more, and whether value is certainly nearest. */
typedef struct {
    vd value, more, error;
    vm certain;
} lanes_root;

/* The centre from which each lane's root is computed: of its cap, or of the
 * base. */
INLINE void root_centers(vd center[3], const lanes_shape *s, int kind, vd part)
{
    const vm top = v_eq(part, v_set(CYLINT_PART_CAP1));
    EACH(i, 3)
        center[i] = cylint_has_end_points(kind)
                        ? v_select(top, s->top[i], s->base[i])
                        : s->base[i];
}

/* A line in pairs: its direction, and its origin from a centre. */
typedef struct {
    vpair u[3], D[3];
} lanes_pair_line;

#define FORM(name) name##_pairs
#define LOAD_INLINE INLINE
#define SHAPE lanes_shape
#define LINE lanes_pair_line
#define DIRECTION(l, i) l->u[i]
#define AXIS(s, i) ((vpair){s->axis[i], s->axis_lo[i]})
#define FROM_BASE(l, s, i) l->D[i]
#define FROM_TOP(l, s, i) l->D[i]
#define BEFORE_TOP(D, w) vpair_sub(D, w)
#define SEMI_AXIS_A(s, i) ((vpair){s->a[i], v_set(0)})
#define SEMI_AXIS_B(s, i) ((vpair){s->b[i], v_set(0)})
#define RADIUS(s, end) ((vpair){s->r[end], v_set(0)})
#define RADIUS_GROWTH(s) ((vpair){s->dr, s->dr_lo})
#define ONE ((vpair){v_set(1), v_set(0)})
#include "../signs/load_template.h"

/* Moves the line's origin by t and measures it from a centre, or from the
 * centre of the top in lanes of `top` where the shape has no end points. */
INLINE vd move_line(lanes_pair_line *to, const lanes_shape *s,
                    const vd center[3], const lanes_line *l, int kind, vd t,
                    vm top)
{
    const vd zero = v_set(0);
    vd size = zero;
    EACH(i, 3) {
        vpair D = v_two_sum(l->o[i], -center[i]);
        if (!cylint_has_end_points(kind))
            D = vpair_sub(D, (vpair){v_select(top, s->axis[i], zero), zero});
        vpair step = v_two_prod(t, l->u[i]);
        if (l->segment)
            step.lo = step.lo + t * l->u_lo[i];
        const vpair at = vpair_add(D, step);
        to->u[i] = (vpair){l->u[i], l->u_lo[i]};
        to->D[i] = v_fast_two_sum(at.hi, at.lo);
        size = v_max(size, v_abs(at.hi));
    }
    return size;
}

/* The pairs and sizes of a query whose line begins at t.  Returns the size of
 * the terms of the origin's coordinates, divided by that of these. */
INLINE vd terms_at(terms_pairs *P, terms_sizes *N, const lanes_slopes *q,
                   const lanes_shape *s, const vd center[3],
                   const lanes_line *l, int kind, vd t, vd part)
{
    lanes_pair_line moved;
    const vd size = move_line(&moved, s, center, l, kind, t,
                              v_eq(part, v_set(CYLINT_PART_CAP1)));
    const lanes_sizes most = {q->u,        q->w, size, q->a, {s->r[0], s->r[1]},
                              v_abs(s->dr)};
    load_shape_sizes(N, &most, kind);
    load_line_sizes(N, &most, &most);
    load_shape_pairs(P, s, kind);
    load_line_pairs(P, s, &moved);
    prepare_shape_sizes(N);
    prepare_shape_pairs(P);
    return (q->D + v_abs(t) * q->u) / size;
}

#define FORM(name) name##_lanes
#define NEWTON_INLINE INLINE
#define NUM vd
#define ABS(x) v_abs(x)
#define CONSTANT(x) v_set(x)
#define SUM_OF(x, y, z) v_sum_of(x, y, z)
#define QUOTIENT(x, y, inverse) ((x) * (inverse))
#define SLACK CYLINT_LANES_SLACK
#include "../roots/newton_template.h"

/* The error of a residual of those sizes.  from: terms_at(); the terms at t have
 * an error of 2^-101 of the terms of their origin. */
INLINE vd residual_error(vd sizes, vd from)
{
    const vd spread =
        v_set(CYLINT_LAZY_BOUND) + v_set(CYLINT_MOVED_BOUND) * from;
    return spread * sizes + v_set(CYLINT_UNDERFLOW);
}

/* Newton's step from t.  Each value has a bound on its error. */
INLINE lanes_root newton_root(vd residual, vd residual_e, vd slope, vd slope_e,
                              vd curvature, bounded_value t)
{
    const newton_lanes step =
        newton_step_lanes(residual, residual_e, slope, slope_e, curvature, t.e);
    const vd e = step.error;
    const vpair r = v_fast_two_sum(t.v, -step.delta);
    const vd t_size = v_abs(r.hi);
    const vm nearest =
        m_and(v_eq(r.hi + (r.lo + e), r.hi), v_eq(r.hi + (r.lo - e), r.hi));
    const vm in_range = m_and(v_lt(t_size, v_set(1 / CYLINT_ROOT_LEAST)),
                              v_lt(v_set(CYLINT_ROOT_LEAST), t_size));
    return (lanes_root){r.hi, r.lo, e, m_and(nearest, in_range)};
}

/*
 * One step of Newton's; the residual is computed in pairs.
 * exits: +1 in lanes whose lateral root leaves the quadric, -1 elsewhere.
 * The terms of a lateral root may begin at any centre where s->r[0] is the
 * radius.  caps: 0 if there are certainly none.
 */
INLINE lanes_root round_root(const lanes_slopes *q, const lanes_shape *s,
                             const vd center[3], const lanes_line *l, int kind,
                             int caps, vd exits, bounded_value t, vd part)
{
    const vd zero = v_set(0);
    const vm cap = caps ? v_lt(zero, part) : m_from(0);
    terms_pairs P;
    terms_sizes N;
    const vd from = terms_at(&P, &N, q, s, center, l, kind, t.v, part);
    vd residual = zero, sizes = zero, slope = zero, slope_e = zero;
    vd curvature = zero;
    if (!caps || m_any(m_not(cap))) {
        const vpair Q = form_C_pairs(&P);
        residual = Q.hi + Q.lo;
        sizes = form_C_sizes(&N);
        slope = v_set(2) * exits * q->R.v;
        /* mutant '2' -> '3': slower, a larger bound */
        slope_e = v_set(2) * q->R.e;
        curvature = q->A;
    }
    if (caps && m_any(cap)) {
        const vpair plane = form_alpha_pairs(&P, 0);
        residual = v_select(cap, plane.hi + plane.lo, residual);
        sizes = v_select(cap, form_alpha_sizes(&N, 0), sizes);
        slope = v_select(cap, q->beta.v, slope);
        slope_e = v_select(cap, q->beta.e, slope_e);
        curvature = v_select(cap, zero, curvature);
    }
    return newton_root(residual, residual_error(sizes, from), slope, slope_e,
                       curvature, t);
}

#endif
