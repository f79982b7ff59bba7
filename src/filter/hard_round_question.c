/*
 * hard_round_question.c - one line and one round kind, where doubles do not
 * decide
 *
 * As hard_question.c: forms in pairs, and residuals in levels for roots that
 * residuals in pairs do not round.
 */
#define CYLINT_NARROW
#include "../numbers/double_double.h" /* before simd.h */
#include "../numbers/simd.h"
#include "filter.h"

#ifndef CYLINT_HARD_ROUND
#define CYLINT_HARD_ROUND cylint_hard_round_plain
#define CYLINT_EXACT_ROUND cylint_exact_round_plain
#endif

#if LANES == 2

#include "round_roots.h"
#include "residual_in_levels.h"
#include "second_step.h"

/* As misses_at_once() and classify_round(), in pairs.  Writes the line rounded
 * to doubles again, and the quadratics of balls and cone. */
INLINE round_verdict classify_round_in_pairs(round_line *x,
                                             round_quadratic *ball,
                                             local_quadratic *cone,
                                             const cylint_shape *shape,
                                             const cylint_line *line, int kind)
{
    const int tapered = kind == ROUND_TAPERED;
    const vd rounding = v_set(CYLINT_ROUNDING);
    local_line *l = &x->l;
    round_verdict v = {{0, 0, m_from(0), 0, 0, 3, 0, 0}, v_set(0), v_set(0), 0};
    round_pairs in;
    load_round_pairs(&in, shape, line, kind);
    l->unit = shape->local.error;
    l->w = v_first(rounded(in.in.w));
    v.g = rounded(ball_g_pairs(&in.in, &in.balls));
    v.g_error = ball_error(x);
    if (kind == ROUND_BALL) {
        classify_sphere(&v);
    } else {
        vpair Y = twice(0, 0);
        if (tapered)
            Y = Y_pairs(&in.in);
        v.cone.G = v_first(rounded(G_pairs(&in.in, tapered, &Y)));
        v.cone.G_error = tapered ? cone_error(l, shape, rounded(Y))
                                 : disc_error(l, shape->r0);
        *cone = quadratic_in_pairs(l, &in.in, shape, tapered);
        v.cone.misses = v.cone.G < -v.cone.G_error;
        if (!v.cone.misses) {
            const unsigned balls =
                classify_cone(&v, x, shape, rounded(E_pairs(&in.in)),
                              rounded(N_pairs(&in.in, tapered)), tapered);
            if (balls)
                classify_balls(&v, balls);
        }
        v.cone.G_error += CYLINT_ROUNDING * fabs(v.cone.G); /* it was rounded */
    }
    *ball = quadratic_of_balls(x, &v, rounded(ball_A_pairs(&in.in)),
                               rounded(ball_B_pairs(&in.in, &in.balls)));
    /* as quadratic_in_pairs() */
    ball->radicand_error =
        v_sum_of(rounding, v_abs(ball->radicand), ball->radicand_error);
    ball->A_error = v_sum_of(rounding + rounding, ball->A, ball->A_error);
    ball->B_error = v_sum_of(rounding, v_abs(ball->B), ball->B_error);
    return v;
}

INLINE round_verdict classify_round_in_doubles(round_line *x,
                                               round_quadratic *ball,
                                               local_quadratic *cone,
                                               const cylint_shape *shape,
                                               int kind)
{
    round_verdict v = {{0, 0, m_from(0), 0, 0, 3, 1, 0}, v_set(0), v_set(0), 0};
    if (!misses_at_once(&v, x, shape, kind)) {
        classify_round(&v, x, shape, kind);
        if (v.cone.crosses && !v.chord)
            compute_balls(&v, x);
        *cone = quadratic_of(&x->l, shape, kind == ROUND_TAPERED);
        *ball = quadratic_of_balls(x, &v, ball_A_doubles(&x->l.in),
                                   ball_B_doubles(&x->l.in, &x->balls));
    }
    return v;
}

/* The residual of one lane at a root that pairs do not round. */
INLINE double exact_round_residual(const cylint_shape *shape,
                                   const cylint_line *line, double t,
                                   end_parts e, int lane)
{
    if (e.cap >> lane & 1)
        return ball_residual_in_levels(shape, line, t,
                                       (int)(e.top >> lane & 1));
    if (shape->kind == CYLINT_KIND_CAPSULE)
        return circular_residual(shape, line, t, -1, 0);
    return round_cone_residual_in_levels(shape, line, t);
}

/* Writes the hits, if need be after a second step. */
INLINE int write_corrected_round(local_roots r, const local_ends *at,
                                 end_parts e, double Q, double D, ARGUMENTS)
{
    const int ball = shape->kind == CYLINT_KIND_SPHERE;
    const end_parts parts =
        round_parts(e, shape, ball ? ROUND_BALL : ROUND_TAPERED);
    const unsigned present = ends_present(parts, shape);
    const unsigned missing = roots_missing(&r, present, line, want);
    if (missing) {
        const vd start = second_start(&r, at);
        double t[2], residual[2] = {0, 0};
        v_store(t, start);
        /* nearly always one of them: no branch depends on which */
        for (unsigned left = missing; left; left &= left - 1) {
            const int i = (int)(left >> 1 & ~left);
            residual[i] = exact_round_residual(shape, line, t[i], e, i);
        }
        const vd size = size_at(start, Q, D);
        const local_roots better =
            second_step(start, v_load(residual), size * size, shape, at);
        r = merged(&better, &r, missing);
        if (roots_missing(&r, present, line, want))
            return CYLINT_UNDECIDED;
    }
    return write_hits(&r, at->first, parts, present, shape, line, want, answer,
                      rest, 1);
}

int CYLINT_EXACT_ROUND(ARGUMENTS, const cylint_estimates *from)
{
    local_verdict v;
    local_ends at;
    local_roots r;
    load_estimates(from, &v, &at, &r);
    return write_corrected_round(
        r, &at, (end_parts){from->pierced, from->lanes}, from->Q, from->D,
        shape, line, want, answer, rest);
}

INLINE int round_answer_from(const round_line *x, const round_verdict *v,
                             const round_quadratic *q, ARGUMENTS, int kind)
{
    if ((v->cone.pierced | v->cone.spared) != 3)
        return CYLINT_UNDECIDED;
    const end_parts e = ends_of(v);
    const local_ends at = estimate_round(q, v->chord || x->l.w > 0);
    if (at.usable != 3)
        return CYLINT_UNDECIDED;
    return write_corrected_round(rounded_ends(x, shape, line, &at, e, kind),
                                 &at, e, x->l.Q, x->l.D, shape, line, want,
                                 answer, rest);
}

static int kernel_of(const cylint_shape *shape)
{
    return shape->kind == CYLINT_KIND_SPHERE    ? ROUND_BALL
           : shape->kind == CYLINT_KIND_CAPSULE ? ROUND_STRAIGHT
                                                : ROUND_TAPERED;
}

/* First in doubles, then in pairs.  Code for each kind would be twice as much
 * and no faster. */
int CYLINT_HARD_ROUND(ARGUMENTS)
{
    const int kind = kernel_of(shape);
    int n = CYLINT_UNDECIDED;
    round_line x;
    if (!cylint_rounds_to_nearest())
        return CYLINT_UNDECIDED;
    load_round(&x, shape, line, kind);
    for (int in_pairs = 0; in_pairs < 2 && n == CYLINT_UNDECIDED; in_pairs++) {
        round_quadratic q;
        local_quadratic cone = {0, 0, 0, 0};
        const round_verdict v =
            in_pairs ? classify_round_in_pairs(&x, &q, &cone, shape, line, kind)
                     : classify_round_in_doubles(&x, &q, &cone, shape, kind);
        answer->relation = v.cone.crosses * CYLINT_RELATION_CROSS;
        if (v.cone.misses)
            return answer->n = 0;
        if (!v.cone.crosses)
            continue;
        if (kind != ROUND_BALL)
            q = choose_cone(m_from(ends_of(&v).cap), &q, &v, &cone, shape,
                            kind == ROUND_TAPERED);
        n = round_answer_from(&x, &v, &q, shape, line, want, answer, rest,
                              kind);
    }
    return n;
}

#else

/* Without vectors of two lanes. */
int CYLINT_HARD_ROUND(CYLINT_ONE_ARGUMENTS)
{
    return cylint_undecided(shape, line, want, answer, rest);
}

int CYLINT_EXACT_ROUND(CYLINT_ONE_ARGUMENTS, const cylint_estimates *from)
{
    (void)from;
    return cylint_undecided(shape, line, want, answer, rest);
}

#endif
