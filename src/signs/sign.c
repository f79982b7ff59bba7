/*
 * sign.c - the sign of each form: in doubles, then in pairs, then exactly
 *
 * A filter's answer is final when the value exceeds the bound on its error
 * (error_bounds.h).  Comparisons are written so that a NaN falls to the next
 * arithmetic.
 */
#include "sign.h"
#include "origin.h"

#ifdef CYLINT_COUNT_STAGES
unsigned long long cylint_stages[CYLINT_STAGES];
#endif

/* -------------------------------------------------------- scaling ------ */

static void scale_vector(double to[3], const double from[3], int e)
{
    for (int i = 0; i < 3; i++)
        to[i] = cylint_scaled(from[i], e);
}

/* Whether a vector is clear of overflow.  A coordinate that overflowed when it
 * was scaled is infinite, or, where rounding is directed, the largest double. */
static int is_in_range(const double x[3])
{
    return cylint_largest(x) <= cylint_power_of_two(CYLINT_LARGE_EXPONENT);
}

static int filters_apply(const cylint_shape *s, const cylint_line *l)
{
    double from[3];
    for (int i = 0; i < 3; i++)
        /* mutant '-' -> '+': a distance too large for the filters overflows,
         * and an infinite or NaN bound decides nothing */
        from[i] = l->o[i] - cylint_base(s)[i];
    return cylint_in_range(s) && l->in_range &&
           cylint_largest(from) <= CYLINT_WINDOW;
}

/* Copies of shape and line with lengths near 1 and a direction near 1.
 * What underflows here is covered by CYLINT_UNDERFLOW. */
static void scale_query(cylint_query *q)
{
    const cylint_shape *s = q->shape;
    const cylint_line *l = q->line;
    /* mutant '-' -> '': slower, the filters do not apply and exact
     * arithmetic decides */
    const int e = -cylint_length_exponent(s);
    cylint_shape *to = &q->scaled_shape;
    *to = *s;
    double *x = to->library.number;
    scale_vector(x + CYLINT_AT_BASE, cylint_base(s), e);
    if (cylint_has_end_points(s->kind)) {
        scale_vector(x + CYLINT_AT_TOP, cylint_top(s), e);
        for (int i = 0; i < 3; i++)
            x[CYLINT_AT_AXIS + i] = cylint_axis_pair(to, i).hi;
        x[CYLINT_AT_R0] = cylint_scaled(cylint_r0(s), e);
        x[CYLINT_AT_R1] = cylint_scaled(cylint_r1(s), e);
    } else {
        scale_vector(x + CYLINT_AT_AXIS, cylint_axis(s), e);
        scale_vector(x + CYLINT_AT_A, cylint_a(s), e);
        scale_vector(x + CYLINT_AT_B, cylint_b(s), e);
    }
    const double most = cylint_largest(l->d);
    /* mutant '1024' -> '1025': any power that brings the size into range */
    const int f = most > DBL_MAX ? -1024 : -cylint_any_exponent(most);
    q->scaled_line = *l;
    scale_vector(q->scaled_line.o, l->o, e);
    if (l->segment) {
        cylint_scaled_difference(q->scaled_line.d, q->scaled_line.d_lo, l->end,
                                 l->o, f);
    } else {
        scale_vector(q->scaled_line.d, l->d, f);
    }
    to->library.flag[CYLINT_AT_IN_RANGE] = cylint_is_in_window(to);
    cylint_measure_line(&q->scaled_line);
    q->near_shape = to;
    q->near_line = &q->scaled_line;
    q->t_exponent = f - e;
    q->filters = is_in_range(q->scaled_line.o) &&
                 is_in_range(cylint_base(to)) &&
                 filters_apply(to, &q->scaled_line);
}

/* -------------------------------------------------------- terms ------ */

static bounded_double bounded_of(double x)
{
    return (bounded_double){x, fabs(x)};
}

#define FORM(name) name##_bounded
#define LOAD_INLINE static
#define DATUM(x) bounded_of(x)
#define DIFFERENCE(x, y) bounded_of((x) - (y))
#define DIRECTION(l, i) bounded_of(l->d[i])
#define AXIS(s, i) bounded_of(cylint_axis(s)[i])
#define BEFORE_TOP(D, w) bounded_sub(D, w)
#define RADIUS_GROWTH(s) bounded_of(cylint_radius_growth(s).hi)
#include "load_template.h"

static bounded_pair bounded_pair_of(double hi, double lo)
{
    return (bounded_pair){{hi, lo}, 0};
}

/* Exact in rounding to nearest; counted as rounded, for the other modes. */
static bounded_pair bounded_pair_difference(double x, double y)
{
    const pair d = two_diff(x, y);
    return (bounded_pair){d, fabs(d.hi)};
}

#define FORM(name) cylint_##name##_pair
#define LOAD_INLINE static
#define DATUM(x) bounded_pair_of(x, 0)
#define DIFFERENCE(x, y) bounded_pair_difference(x, y)
#define DIRECTION(l, i) bounded_pair_of(l->d[i], l->d_lo[i])
#define AXIS(s, i) ((bounded_pair){cylint_axis_pair(s, i), 0})
#define BEFORE_TOP(D, w) bounded_pair_sub(D, w)
#define RADIUS_GROWTH(s) ((bounded_pair){cylint_radius_growth(s), 0})
#include "load_template.h"

cylint_terms_pair *cylint_load_pairs(cylint_query *q)
{
    cylint_terms_pair *L = &q->pair_terms;
    if (cylint_is_first(q, CYLINT_READY_PAIR)) {
        cylint_reached(PAIRS);
        cylint_fill_pair(L, q->near_shape, q->near_line, q->kind);
        cylint_prepare_pair(L);
    }
    return L;
}

cylint_terms_pair *cylint_load_pair_moments(cylint_query *q)
{
    cylint_terms_pair *L = cylint_load_pairs(q);
    if (cylint_is_first(q, CYLINT_READY_PAIR_MOMENTS))
        cylint_prepare_moments_pair(L);
    return L;
}

/* Differences of data, not the nearest doubles to them. */
#define FORM(name) cylint_##name##_exact
#define LOAD_INLINE static
#define DATUM(x) cylint_exact_from(L->arena, x)
#define DIFFERENCE(x, y) cylint_exact_difference(L->arena, x, y)
#define DIRECTION(l, i) \
    (l->segment ? DIFFERENCE(l->end[i], l->o[i]) : DATUM(l->d[i]))
#define AXIS(s, i)                                         \
    (cylint_has_end_points(kind)                           \
         ? DIFFERENCE(cylint_top(s)[i], cylint_base(s)[i]) \
         : DATUM(cylint_axis(s)[i]))
#define BEFORE_TOP(D, w) cylint_exact_add(L->arena, D, cylint_exact_neg(w))
#define RADIUS_GROWTH(s)                \
    (cylint_has_tangent(kind) ? L->r[1] \
                              : DIFFERENCE(cylint_r1(s), cylint_r0(s)))
#include "load_template.h"

const cylint_terms_exact *cylint_load_exact(cylint_query *q)
{
    cylint_terms_exact *L = &q->exact;
    if (cylint_is_first(q, CYLINT_READY_EXACT)) {
        cylint_reached(EXACT);
        L->arena = &q->arena;
        cylint_arena_open(L->arena);
        cylint_fill_exact(L, q->shape, q->line, q->kind);
        cylint_prepare_exact(L);
    }
    return L;
}

const cylint_terms_exact *cylint_load_exact_moments(cylint_query *q)
{
    const cylint_terms_exact *L = cylint_load_exact(q);
    if (cylint_is_first(q, CYLINT_READY_EXACT_MOMENTS))
        cylint_prepare_moments_exact(&q->exact);
    return L;
}

/* ---------------------------------------------------------- quanta ----- */

/* x is a multiple of 2^quantum and of no higher power. */
static int quantum(double x)
{
    const uint64_t bits = cylint_bits(x);
    if (bits << 1 == 0)
        return 1 << 20;
    /* the data are not subnormal here, or it comes out too small: harmless */
    return (int)(bits >> 52 & 0x7ff) - 1075 +
           cylint_lowest(bits | (uint64_t)1 << 52);
}

static int least_quantum(const double x[3])
{
    return quantum_add(quantum(x[0]),
                       quantum_add(quantum(x[1]), quantum(x[2])));
}

/* Of vectors, one for all components. */
typedef struct {
    int u, w, D, a, b, r[2], dr;
} data_quanta;

#define FORM(name) name##_quantum
#define LOAD_INLINE static
#define SHAPE data_quanta
#define LINE data_quanta
#define DIRECTION(l, i) l->u
#define AXIS(s, i) s->w
#define FROM_BASE(l, s, i) l->D
#define FROM_TOP(l, s, i) quantum_add(l->D, s->w)
#define BEFORE_TOP(D, w) quantum_add(D, w)
#define SEMI_AXIS_A(s, i) s->a
#define SEMI_AXIS_B(s, i) s->b
#define RADIUS(s, end) s->r[end]
#define RADIUS_GROWTH(s) s->dr
#define ONE 0
#include "load_template.h"

/* Quanta of the data; NULL unless doubles hold all data exactly. */
static const terms_quantum *quanta(cylint_query *q)
{
    terms_quantum *L = &q->quantum;
    if (!cylint_is_first(q, CYLINT_READY_QUANTUM))
        return q->quanta ? L : NULL;
    const cylint_shape *s = q->near_shape;
    const cylint_line *l = q->near_line;
    double D[3];
    q->quanta = q->near_shape == q->shape &&
                cylint_sign(cylint_radius_growth(s).lo) == 0 && q->pairs;
    /* a is 0 in circular kinds, top in elliptic ones */
    const double *const data_of[] = {
        l->o,          l->d,        cylint_base(s), cylint_axis(s),
        cylint_top(s), cylint_a(s), cylint_b(s)};
    for (int i = 0; i < 3; i++) {
        EACH(k, 7)
            q->quanta &= !cylint_too_small(data_of[k][i]);
        const pair d = two_diff(l->o[i], cylint_base(s)[i]);
        q->quanta &= d.lo == 0 && cylint_sign(l->d_lo[i]) == 0 &&
                     cylint_sign(cylint_axis_pair(s, i).lo) == 0;
        if (cylint_has_end_points(s->kind))
            q->quanta &= two_diff(l->o[i], cylint_top(s)[i]).lo == 0;
        D[i] = d.hi;
    }
    if (!q->quanta)
        return NULL;
    const data_quanta data = {least_quantum(l->d),
                              least_quantum(cylint_axis(s)),
                              least_quantum(D),
                              least_quantum(cylint_a(s)),
                              least_quantum(cylint_b(s)),
                              {quantum(cylint_r0(s)), quantum(cylint_r1(s))},
                              quantum(cylint_radius_growth(s).hi)};
    fill_quantum(L, &data, &data, q->kind);
    prepare_quantum(L);
    prepare_moments_quantum(L);
    prepare_top_quantum(L);
    return L;
}

void cylint_query_open(cylint_query *q, const cylint_shape *shape,
                       const cylint_line *line)
{
    q->shape = q->near_shape = shape;
    q->line = q->near_line = line;
    q->kind = shape->kind;
    q->ends = shape->ends;
    q->t_exponent = 0;
    q->ready = 0;
    cylint_reached(FILTER);
    q->filters = filters_apply(shape, line);
    if (!q->filters)
        scale_query(q);
    q->pairs = q->filters && cylint_rounds_to_nearest();
    if (q->filters) {
        terms_bounded *L = &q->bounded_terms;
        fill_bounded(L, q->near_shape, q->near_line, q->kind);
        prepare_bounded(L);
        prepare_moments_bounded(L);
    }
}

/* ---------------------------------------------------------- signs ------ */

/*
 * Every number on the way to a form is a multiple of its quantum and no
 * larger than its size.  If the size of the whole is below 2^53 quanta, so
 * is that of every part that is not multiplied by zero: then nothing was
 * rounded, and a zero is a zero.  Data on integer grids are such a case.
 */
static int no_rounding(double size, int e)
{
    return e > -CYLINT_SUM_EXPONENT && e < CYLINT_SUM_EXPONENT &&
           size < cylint_power_of_two(e + 53);
}

enum { UNCERTAIN = 2 };

/* Whether a form needs a moment about the top, which is not there yet. */
static int needs_top(cylint_query *q, cylint_form f, int end, unsigned ready)
{
    return end && f >= FORM_E && cylint_is_first(q, ready);
}

/* In doubles, then in pairs. */
static int sign_by_filters(cylint_query *q, cylint_form f, int end)
{
    if (needs_top(q, f, end, CYLINT_READY_TOP))
        prepare_top_bounded(&q->bounded_terms);
    const bounded_double b = form_bounded(&q->bounded_terms, f, end);
    if (fabs(b.v) > bounded_error(b))
        return cylint_sign(b.v);
    const terms_quantum *e = quanta(q);
    if (e && no_rounding(b.size, form_quantum(e, f, end))) {
        cylint_reached(QUANTA);
        return cylint_sign(b.v);
    }
    if (!q->pairs)
        return UNCERTAIN;
    cylint_terms_pair *L =
        f < FORM_E ? cylint_load_pairs(q) : cylint_load_pair_moments(q);
    if (needs_top(q, f, end, CYLINT_READY_PAIR_TOP))
        cylint_prepare_top_pair(L);
    const bounded_pair x = cylint_form_pair(L, f, end);
    return fabs(x.v.hi) > bounded_pair_error(x) ? cylint_sign(x.v.hi)
                                                : UNCERTAIN;
}

int cylint_form_sign(cylint_query *q, cylint_form f, int end)
{
    const int sign = q->filters ? sign_by_filters(q, f, end) : UNCERTAIN;
    if (sign != UNCERTAIN && !CYLINT_IS_PARANOID)
        return sign;
    const cylint_terms_exact *L =
        f < FORM_E ? cylint_load_exact(q) : cylint_load_exact_moments(q);
    if (needs_top(q, f, end, CYLINT_READY_EXACT_TOP))
        cylint_prepare_top_exact(&q->exact);
    const int used = q->arena.used;
    const int exactly = cylint_form_exact(L, f, end).sign;
    q->arena.used = used;
    cylint_contradiction(sign != UNCERTAIN && sign != exactly);
    return exactly;
}

int cylint_sign_at_origin(const cylint_shape *shape, const cylint_line *line,
                          int surface)
{
    cylint_query q;
    cylint_query_open(&q, shape, line);
    return surface == CYLINT_LATERAL_SURFACE
               ? cylint_form_sign(&q, FORM_C, 0)
               : cylint_form_sign(&q, FORM_ALPHA, surface);
}
