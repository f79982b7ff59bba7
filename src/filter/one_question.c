/*
 * one_question.c - one line and one shape: verdicts by signs, roots two at a time
 *
 * Compiled once as it is and, where the Makefile knows a processor with a
 * fused multiply-add, again for that: the answers are the same bits.
 *
 * The two lanes are the two caps: in each the line begins relative to the centre
 * of its cap, with its radius.  The signs of forms_template.h at both tell what
 * is met, as in intersect.c, slab(), but without a branch; no root is needed
 * for that.  Then the lanes are the two stops: the plane of a cap where the
 * line pierces it, else a root of the lateral quadric.  Of an unbounded shape
 * both lanes have the base.
 */
#define CYLINT_NARROW
#include "lanes.h"
#include "filter.h"

#ifndef CYLINT_ONE
#define CYLINT_ONE cylint_one_plain
#endif

#define ARGUMENTS                                                      \
    const cylint_shape *shape, const cylint_line *line, unsigned want, \
        cylint_answer *answer, cylint_root_rest *rest

/* For what has no kernel. */
static int undecided(ARGUMENTS)
{
    (void)shape;
    (void)line;
    (void)want;
    (void)answer;
    (void)rest;
    return CYLINT_UNDECIDED;
}

#define NEITHER              \
    {                        \
        undecided, undecided \
    }

#if LANES == 2

INLINE vm is_positive(bounded_value x)
{
    return v_lt(x.e, x.v);
}

INLINE vm is_negative(bounded_value x)
{
    return v_lt(x.v, -x.e);
}

/* Of the first lane. */
INLINE int at_base(vm m)
{
    return m_bits(m) & 1;
}

/* The first lane's in both. */
INLINE bounded_value of_base(bounded_value x)
{
    return (bounded_value){v_firsts(x.v, x.v), v_firsts(x.e, x.e)};
}

/* The terms, each lane from the centre of its own cap. */
INLINE void load_terms_of_caps(lanes_query *q, const cylint_shape *shape,
                               const cylint_line *line, int kind, int bounded)
{
    terms_lanes *L = &q->L;
    const int two_ends = bounded && cylint_has_end_points(kind);
    L->kind = kind;
    EACH(i, 3) {
        const vd base = two_ends ? v_two(shape->base[i], shape->top[i])
                                 : v_set(shape->base[i]);
        L->u[i] = v_set(line->d[i]);
        L->w[i] = v_set(shape->axis[i]);
        L->D[0][i] = v_set(line->o[i]) - base;
        if (bounded && !two_ends)
            L->D[0][i] = L->D[0][i] - v_two(0, shape->axis[i]);
        if (cylint_is_elliptic(kind)) {
            L->a[i] = v_set(shape->a[i]);
            L->b[i] = v_set(shape->left_handed ? -shape->b[i] : shape->b[i]);
        }
    }
    L->r[0] = bounded ? v_two(shape->r0, shape->r1) : v_set(shape->r0);
    L->dr = v_set(shape->dr);
    L->one = v_set(1);
    prepare_shape_lanes(L);
    prepare_line_lanes(L);
}

/* Their sizes. */
INLINE void load_sizes(lanes_query *q, const cylint_shape *shape,
                       const cylint_line *line, int kind, int bounded)
{
    const terms_lanes *L = &q->L;
    terms_sizes *N = &q->N;
    N->kind = kind;
    N->r[0] = L->r[0];
    N->dr = v_abs(L->dr);
    N->one = L->one;
    vd D = v_largest(L->D[0]);
    if (bounded)
        D = v_max(D, v_turned(D));
    EACH(i, 3) {
        N->u[i] = v_set(line->size);
        N->w[i] = v_set(shape->size);
        N->D[0][i] = D;
        if (cylint_is_elliptic(kind))
            N->a[i] = N->b[i] = v_max(v_largest(L->a), v_largest(L->b));
    }
    prepare_shape_sizes(N);
    prepare_line_sizes(N);
}

/* Whether the line certainly misses the ball about a bounded shape.  The middle
 * of the axis is the mean of the centres of the caps, its moment that of
 * theirs. */
INLINE int passes_ball(const lanes_query *q, const cylint_shape *shape)
{
    const vd twice = v_set(2 * shape->bound_radius);
    vd M[3], sizes[3];
    EACH(i, 3) {
        M[i] = q->L.M[0][i] + v_turned(q->L.M[0][i]);
        sizes[i] = q->N.M[0][i] + q->N.M[0][i];
    }
    const bounded_value near = with_bound(form_ball_lanes(&q->L, M, twice),
                                          form_ball_sizes(&q->N, sizes, twice));
    return at_base(is_negative(near));
}

/* What is certain by signs: the relation, and which caps the line
 * pierces and which not. */
typedef struct {
    int misses, crosses; /* neither: uncertain */
    vm pierced, spared;
} verdict;

/* The signs of E and inward, a bit for each cap, and of G. */
typedef struct {
    unsigned positive, negative;
} sign_bits;

typedef struct {
    sign_bits E, inward, G;
} cap_signs;

INLINE sign_bits signs_of(bounded_value x)
{
    return (sign_bits){m_bits(is_positive(x)), m_bits(is_negative(x))};
}

INLINE sign_bits at_cap(sign_bits x, int cap)
{
    return (sign_bits){x.positive >> cap, x.negative >> cap};
}

#define FORM(name) name##_one
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

INLINE verdict classify_bounded(const lanes_query *q, bounded_value G)
{
    const bounded_value E =
        with_bound(form_E_lanes(&q->L, 0), form_E_sizes(&q->N, 0));
    const bounded_value N =
        with_bound(form_N_lanes(&q->L, 0), form_N_sizes(&q->N, 0));
    const bounded_value inward = {N.v * v_two(-1, 1), N.e};
    const cap_signs c = {signs_of(E), signs_of(inward), signs_of(G)};
    const int misses = (int)(misses_one(&c) & 1);
    const int crosses = (int)(crosses_one(&c) & 1);
    return (verdict){misses, crosses & !misses, is_positive(E), is_negative(E)};
}

/* An unbounded one is crossed if Q has two roots, and missed if it has none:
 * a line cannot stay inside a double cone.  G > 0 tells that A > 0, but of a
 * double cone, where A = 0 leaves one root. */
INLINE verdict classify_unbounded(const lanes_query *q, bounded_value G,
                                  int kind)
{
    const vm no_caps = m_from(0);
    const int none = at_base(is_negative(G));
    int two = at_base(is_positive(G));
    if (cylint_is_tapered(kind)) {
        const bounded_value A =
            with_bound(form_A_lanes(&q->L), form_A_sizes(&q->N));
        two &= at_base(m_or(is_positive(A), is_negative(A)));
    }
    return (verdict){none, two, no_caps, no_caps};
}

/* The ends of the overlap, one a lane. */
typedef struct {
    bounded_value t;
    vd part, exits;  /* exits: -1, or +1 where Q rises */
    unsigned unsure; /* bits of lanes */
    int first;       /* the lane of the lesser t */
    lanes_slopes slopes;
} stops;

/* A stop on the side is the entry root in the lane of the cap that is come
 * to first, the exit root in the other. */
INLINE stops stops_bounded(lanes_query *q, bounded_value G, int kind,
                           const verdict *v)
{
    const vm unknown = lateral_quadratic(q, G, kind);
    q->B = of_base(q->B);
    q->beta = with_bound(q->L.beta, form_beta_sizes(&q->N));
    const vm up = v_lt(v_set(0), q->beta.v);
    const vd exits = v_select(up, v_two(-1, 1), v_two(1, -1));
    const bounded_value plane =
        with_bound(-form_alpha_lanes(&q->L, 0), form_alpha_sizes(&q->N, 0));
    const bounded_value over = choose(v->pierced, q->beta, q->A);
    const vm unsure =
        m_or(m_not(m_or(v->pierced, v->spared)),
             m_or(m_and(m_not(v->pierced), unknown), m_not(certain(over))));
    return (stops){
        quotient(choose(v->pierced, plane, lateral_numerator(q, exits)), over),
        v_select(v->pierced, v_two(CYLINT_PART_CAP0, CYLINT_PART_CAP1),
                 v_set(CYLINT_PART_LATERAL)),
        exits,
        m_bits(unsure),
        !at_base(up),
        slopes_of(q)};
}

/* The entry root and the exit root, which come in this order unless A < 0. */
INLINE stops stops_unbounded(lanes_query *q, bounded_value G, int kind)
{
    const vm unknown = lateral_quadratic(q, G, kind);
    const vd exits = v_two(-1, 1);
    q->beta = (bounded_value){v_set(0), v_set(0)}; /* there are no caps */
    return (stops){quotient(lateral_numerator(q, exits), q->A),
                   v_set(CYLINT_PART_LATERAL),
                   exits,
                   m_bits(unknown),
                   at_base(v_lt(q->A.v, v_set(0))),
                   slopes_of(q)};
}

/* The stops that are hits, as bits of lanes. */
INLINE unsigned hits_of(const stops *at, const cylint_shape *shape,
                        const cylint_line *line, unsigned want, int *unsure)
{
    vm near;
    const vm in =
        within_domain(at->t, v_set(line->tmin), v_set(line->tmax), &near);
    const unsigned lateral = m_bits(v_eq(at->part, v_set(CYLINT_PART_LATERAL)));
    const unsigned present = lateral | cylint_caps_present(shape->ends);
    const unsigned hits = present & m_bits(in);
    *unsure = (at->unsure | (present & m_bits(near))) != 0;
    return want & CYLINT_WANT_NEAREST && hits == 3 ? 1u << at->first : hits;
}

/* Both roots in pairs. */
INLINE void round_both(lanes_root *r, const cylint_shape *shape,
                       const cylint_line *line, int kind, const stops *at)
{
    const int bounded = cylint_ends_are_planes(shape->ends);
    const double *top = bounded ? shape->top : shape->base;
    lanes_shape s;
    lanes_line l;
    broadcast_shape(&s, shape);
    broadcast_line(&l, line);
    if (cylint_has_end_points(kind))
        EACH(i, 3)
            s.base[i] = v_two(shape->base[i], top[i]);
    s.r[0] = v_two(shape->r0, bounded ? shape->r1 : shape->r0);
    *r = round_root(&at->slopes, &s, s.base, &l, kind, 1, at->exits, at->t,
                    at->part);
}

/* Both roots.  Returns whether the hits among them are certain. */
INLINE int roots_of(lanes_root *r, const cylint_shape *shape,
                    const cylint_line *line, int kind, const stops *at,
                    unsigned want, unsigned hits)
{
    lanes_root fast;
    if (want & CYLINT_WANT_FAST) {
        fast = *r = fast_root(&at->slopes, at->t);
        if (!(hits & ~m_bits(r->sure)))
            return 1;
    }
    if (!cylint_rounds_to_nearest()) /* would certify nothing */
        return 0;
    round_both(r, shape, line, kind, at);
    if (want & CYLINT_WANT_FAST)
        *r = choose_root(fast, *r);
    return !(hits & ~m_bits(r->sure));
}

/* The hits in their order. */
INLINE void write_hits(cylint_answer *answer, cylint_root_rest *rest,
                       const stops *at, const lanes_root *r, unsigned hits,
                       int bounded, unsigned want)
{
    double part[2], t[2], more[2], error[2];
    int n = 0;
    v_store(part, at->part);
    v_store(t, r->value);
    v_store(more, r->more);
    v_store(error, r->error);
    EACH(k, 2) {
        const int lane = k ^ at->first;
        if (!(hits >> lane & 1))
            continue;
        if (want & CYLINT_WANT_T)
            answer->hit[n].t = t[lane];
        if (want & CYLINT_WANT_PART) {
            answer->hit[n].part = (int)part[lane];
            answer->hit[n].side = bounded ? k : lane;
        }
        if (rest) {
            rest->more[n] = more[lane];
            rest->error[n] = error[lane];
        }
        n++;
    }
    answer->n = n;
}

/* From the stops on.  Returns n. */
INLINE int finish(ARGUMENTS, int kind, const stops *at)
{
    int unsure;
    lanes_root r = {v_set(0), v_set(0), v_set(0), m_from(0)};
    const unsigned hits = hits_of(at, shape, line, want, &unsure);
    if (unsure || (hits && want & CYLINT_WANT_T &&
                   !roots_of(&r, shape, line, kind, at, want, hits)))
        return CYLINT_UNDECIDED;
    answer->relation = CYLINT_RELATION_CROSS;
    write_hits(answer, rest, at, &r, hits, cylint_ends_are_planes(shape->ends),
               want);
    return answer->n;
}

/* One function of each kind; elliptic kinds share theirs. */
#define FINISH(kind)                                              \
    ASIDE int finish_##kind(ARGUMENTS, const stops *at)           \
    {                                                             \
        return finish(shape, line, want, answer, rest, kind, at); \
    }
FINISH(CYLINT_KIND_CYLINDER)
FINISH(CYLINT_KIND_CONE)
FINISH(CYLINT_KIND_ACONE)
FINISH(CYLINT_KIND_ECONE)
#define finish_CYLINT_KIND_ECYLINDER finish_CYLINT_KIND_ECONE

/* Computes G, and what is certain by signs. */
INLINE verdict classify(lanes_query *q, bounded_value *G,
                        const cylint_shape *shape, const cylint_line *line,
                        int kind, int bounded)
{
    load_terms_of_caps(q, shape, line, kind, bounded);
    load_sizes(q, shape, line, kind, bounded);
    if (bounded && passes_ball(q, shape))
        return (verdict){at_base(v_le(q->N.D[0][0], v_set(CYLINT_WINDOW))), 0,
                         m_from(0), m_from(0)};
    const vd value = form_G_lanes(&q->L);
    *G = with_bound(value, form_G_sizes(&q->N));
    if (bounded)
        *G = of_base(*G);
    verdict v =
        bounded ? classify_bounded(q, *G) : classify_unbounded(q, *G, kind);
    const int near = at_base(v_le(q->N.D[0][0], v_set(CYLINT_WINDOW)));
    v.misses &= near;
    v.crosses &= near;
    return v;
}

/* Relation and number, if they are all that is asked, of all of the line, and
 * all of the shape is there: then a line that crosses has both its hits. */
INLINE int answer_brief(const cylint_shape *shape, const cylint_line *line,
                        int kind, int bounded, unsigned want,
                        cylint_answer *answer)
{
    lanes_query q;
    bounded_value G;
    const verdict v = classify(&q, &G, shape, line, kind, bounded);
    answer->relation =
        v.crosses * CYLINT_RELATION_CROSS; /* CYLINT_RELATION_MISS is 0 */
    answer->n = v.crosses << !(want & CYLINT_WANT_NEAREST);
    if (__builtin_expect(!(v.misses | v.crosses), 0))
        return CYLINT_UNDECIDED;
    return answer->n;
}

/* The stops of a line that crosses: then 1, else 0 or CYLINT_UNDECIDED. */
INLINE int find_stops(const cylint_shape *shape, const cylint_line *line,
                      int kind, int bounded, cylint_answer *answer, stops *at)
{
    lanes_query q;
    bounded_value G;
    const verdict v = classify(&q, &G, shape, line, kind, bounded);
    answer->relation = CYLINT_RELATION_MISS;
    answer->n = 0;
    if (!v.crosses)
        return v.misses ? 0 : CYLINT_UNDECIDED;
    *at =
        bounded ? stops_bounded(&q, G, kind, &v) : stops_unbounded(&q, G, kind);
    return 1;
}

/* A kernel of its own for each kind, bounded or not, in full or in brief. */
#define KERNELS(kind, bounded)                                            \
    static int full_##kind##_##bounded(ARGUMENTS)                         \
    {                                                                     \
        stops at;                                                         \
        const int crosses =                                               \
            find_stops(shape, line, kind, bounded, answer, &at);          \
        return crosses != 1                                               \
                   ? crosses                                              \
                   : finish_##kind(shape, line, want, answer, rest, &at); \
    }                                                                     \
    static int brief_##kind##_##bounded(ARGUMENTS)                        \
    {                                                                     \
        (void)rest;                                                       \
        return answer_brief(shape, line, kind, bounded, want, answer);    \
    }
#define KIND(kind) KERNELS(kind, 0) KERNELS(kind, 1)
KIND(CYLINT_KIND_CYLINDER)
KIND(CYLINT_KIND_CONE)
KIND(CYLINT_KIND_ACONE)
KIND(CYLINT_KIND_ECYLINDER)
KIND(CYLINT_KIND_ECONE)

/* Those of a kind, by ends and brevity. */
#define CAPPED(kind)                      \
    {                                     \
        full_##kind##_1, brief_##kind##_1 \
    }
#define PARTLY(kind)                     \
    {                                    \
        full_##kind##_1, full_##kind##_1 \
    }
#define INFINITE(kind)                    \
    {                                     \
        full_##kind##_0, brief_##kind##_0 \
    }
#define BY_ENDS(kind, nappe)                                    \
    {                                                           \
        CAPPED(kind), PARTLY(kind), PARTLY(kind), PARTLY(kind), \
            INFINITE(kind), nappe                               \
    }
cylint_one_table CYLINT_ONE = {
    {NEITHER, NEITHER, NEITHER, NEITHER, NEITHER, NEITHER},
    BY_ENDS(CYLINT_KIND_CYLINDER, INFINITE(CYLINT_KIND_CYLINDER)),
    BY_ENDS(CYLINT_KIND_CONE, NEITHER),
    BY_ENDS(CYLINT_KIND_ACONE, NEITHER),
    BY_ENDS(CYLINT_KIND_ECYLINDER, INFINITE(CYLINT_KIND_ECYLINDER)),
    BY_ENDS(CYLINT_KIND_ECONE, NEITHER)};

#else

/* Without vectors of two lanes. */
#define UNDECIDED                                            \
    {                                                        \
        NEITHER, NEITHER, NEITHER, NEITHER, NEITHER, NEITHER \
    }
cylint_one_table CYLINT_ONE = {UNDECIDED, UNDECIDED, UNDECIDED,
                               UNDECIDED, UNDECIDED, UNDECIDED};

#endif
