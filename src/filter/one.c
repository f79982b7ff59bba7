/*
 * one.c - one line and one shape
 *
 * Compiled once as it is and again for processors with a fused multiply-add: the
 * answers are the same bits.  A kernel for each solid decides nearly all questions:
 * verdicts by signs in doubles, without any root; roots by Newton's step on
 * residuals in pairs.  refine() goes on with what they do not decide.
 */
#define CYLINT_NARROW
#ifndef CYLINT_ONE
#define CYLINT_ONE cylint_one_plain
#endif
#ifndef CYLINT_SIGN_ON_LINE
#define CYLINT_SIGN_ON_LINE cylint_sign_on_line_plain
#endif
#include "../numbers/simd.h"
#include "filter.h"
#include "plane.h"

/* Half-spaces, and shapes and lines that the filter does not serve. */
static int no_solid(const cylint_shape *shape, const cylint_line *line,
                    cylint_question *q)
{
    const int n = cylint_intersect_plane(shape, line, q->want, q->answer);
    const unsigned members = q->want & CYLINT_WANT_BESIDE_T;
    q->next = CYLINT_REFINE_NONE;
    if (n == 1 && members)
        q->undecided[0] =
            cylint_plane_members(shape, line, members, q->described);
    return n;
}

#if LANES == 2

#include "refine.h"

/* An error of G above this share of it makes residuals in levels likely.  Only
 * time depends on it. */
#define CYLINT_LOCAL_GRAZING 0x1p-13

/* The line is nearly tangent, and an end is on the lateral surface. */
INLINE int is_grazing(const verdict *v, int solid)
{
    const vm lateral = m_not(v->pierced[0]);
    if (cylint_solid_is_round(solid))
        return 0;
    return (m_bits(m_and(lateral, v_lt(v_set(CYLINT_LOCAL_GRAZING) * v->G.v,
                                       v->G.e)))) != 0;
}

/* The answer to lines that G does not reject. */
INLINE int answer_after_G(const first_line *first, bounded_value G,
                          cylint_question *q, int roots, int solid)
{
    const source from = {q->shape, q->line};
    local_line l = no_line;
    forms f = no_forms;
    verdict v = no_verdict;
    set_line(&l, first, &from, solid);
    load_after_G(&l, &from, solid);
    if (solid == CYLINT_SOLID_NAPPE)
        set_Y_doubles(&l.in, f.Y);
    other_forms(&f, &l, solid);
    v.G = G;
    v.ball.computed = 0;
    judge(&v, &f, &l, solid);
    q->Q = v_first(l.Q);
    q->D = v_first(l.D);
    if (m_bits(v.misses) & 1)
        return write_miss(q->answer);
    if (!(m_bits(v.crosses) & 1))
        return leave_undecided(q, CYLINT_REFINE_LINE);
    if (!roots)
        return answer_by_signs(&l, &v, q, solid);
    if (!(m_bits(v.sided) & 1) || is_grazing(&v, solid) ||
        !cylint_rounds_to_nearest())
        return leave_undecided(q, CYLINT_REFINE_LINE);
    pair_line in;
    load_pairs(&in, &from, 1, solid);
    return answer_by_roots(&l, &v, &in, q, solid);
}

INLINE bounded_value test_of_G(const first_line *first, const source *from,
                               int solid)
{
    local_line l;
    forms f;
    set_line(&l, first, from, solid);
    first_form(&f, &l, solid);
    return bounded_G(&f, &l, solid);
}

/* The test of G.  Its values are passed in registers, so a miss saves none. */
#define FIRST vd p, vd v, vd from_base, vd w, vd Q, vd D, vd G, vd G_error
#define VALUES a.p, a.v, a.from_base, a.w, a.Q, a.D, G.v, G.e
#define KERNEL(name, signs, roots, solid)                                     \
    static int name(const cylint_shape *shape, const cylint_line *line,       \
                    cylint_question *q)                                       \
    {                                                                         \
        const source from = {shape, line};                                    \
        const first_line a = load_first(&from, solid);                        \
        const bounded_value G = test_of_G(&a, &from, solid);                  \
        if (m_bits(v_lt(G.v, -G.e)) & 1)                                      \
            return write_miss(q->answer);                                     \
        return q->want & CYLINT_WANT_T ? roots(q, VALUES) : signs(q, VALUES); \
    }
#define AFTER_G(name, roots, solid)                                          \
    ASIDE int name(cylint_question *q, FIRST)                                \
    {                                                                        \
        const first_line first = {p, v, from_base, w, Q, D};                 \
        return answer_after_G(&first, (bounded_value){G, G_error}, q, roots, \
                              solid);                                        \
    }
/* The signs at the ends of the domain. */
#define REFINE(name, solid)             \
    static int name(cylint_question *q) \
    {                                   \
        return refine_ends(q, solid);   \
    }
#define OWN(name, solid)            \
    AFTER_G(name##_signs, 0, solid) \
    AFTER_G(name##_roots, 1, solid) \
    KERNEL(name, name##_signs, name##_roots, solid)

OWN(cylinder, CYLINT_SOLID_CYLINDER)
OWN(cone, CYLINT_SOLID_CONE)
#if V_HAS_FMA
#define OTHERS(name, solid) OWN(name, solid)
#define REFINED(name, solid) REFINE(name##_refined, solid)
CYLINT_EACH_SOLID(REFINED)
#undef REFINED
#define REFINED(name, solid) [solid] = name##_refined,
#else
/* Without a fused multiply-add the code of a product in pairs is long: the other
 * solids share the code after the test of G, and all solids share any_refined. */
AFTER_G(any_signs, 0, cylint_prepared(q->shape))
AFTER_G(any_roots, 1, cylint_prepared(q->shape))
REFINE(any_refined, cylint_prepared(q->shape))
#define OTHERS(name, solid) KERNEL(name, any_signs, any_roots, solid)
#define REFINED(name, solid) [solid] = any_refined,
#endif
OTHERS(whole_cylinder, CYLINT_SOLID_WHOLE_CYLINDER)
OTHERS(double_cone, CYLINT_SOLID_DOUBLE_CONE)
OTHERS(nappe, CYLINT_SOLID_NAPPE)
OTHERS(sphere, CYLINT_SOLID_SPHERE)
OTHERS(capsule, CYLINT_SOLID_CAPSULE)
OTHERS(round_cone, CYLINT_SOLID_ROUND_CONE)

/* ------------------------------------------------------------ points ---- */

INLINE int contains_in_doubles(const cylint_shape *shape, const double point[3],
                               int solid)
{
    local_line l = no_line;
    load_place(&l, point, shape, solid);
    return side_of_place(place_in_doubles(&l, solid));
}

#define CONTAINS(name, solid)                                      \
    static int name##_contains(const cylint_shape *shape,          \
                               const double point[3])              \
    {                                                              \
        const int side = contains_in_doubles(shape, point, solid); \
        return side != 0 ? side : contains_in_pairs(shape, point); \
    }
CYLINT_EACH_SOLID(CONTAINS)

static int refine(cylint_question *q)
{
    static int (*const refined[CYLINT_SOLIDS])(cylint_question *) = {
        CYLINT_EACH_SOLID(REFINED)};
    int n = CYLINT_UNDECIDED;
    q->is_along = 0;
    if (q->next == CYLINT_REFINE_NONE || !cylint_rounds_to_nearest())
        return n;
    if (q->next == CYLINT_REFINE_ENDS)
        n = refined[cylint_prepared(q->shape)](q);
    /* mutant '==' -> '!=': slower, exact signs decide */
    if (n == CYLINT_UNDECIDED && q->next != CYLINT_REFINE_ROOTS)
        n = refine_line(q);
    if (n == CYLINT_UNDECIDED && q->next == CYLINT_REFINE_ROOTS)
        n = refine_roots(q);
    if (n != CYLINT_UNDECIDED && q->is_along)
        q->answer->relation = CYLINT_RELATION_ALONG;
    return n;
}

#define ONE(name, solid) [solid] = name,
#define SIDE(name, solid) [solid] = name##_contains,

#else

/* Without vectors of two lanes. */
static int refine(cylint_question *question)
{
    (void)question;
    return CYLINT_UNDECIDED;
}

static unsigned describe_known(const cylint_shape *shape,
                               const cylint_line *line, unsigned want,
                               const cylint_hit *known, cylint_hit *hit)
{
    (void)shape, (void)line, (void)known, (void)hit;
    return want;
}

#define ONE(name, solid) [solid] = no_solid,
#define SIDE(name, solid) [solid] = cylint_side_of_plane,

#endif

const cylint_one_kernels CYLINT_ONE = {
    {[CYLINT_SOLID_NONE] = no_solid, CYLINT_EACH_SOLID(ONE)},
    refine,
    {[CYLINT_SOLID_NONE] = cylint_side_of_plane, CYLINT_EACH_SOLID(SIDE)},
    describe_known};
