/*
 * origin.c - the sign of a surface at a line's origin, in pairs, then exactly; and
 * at other points of the line, in pairs
 *
 * The kernels, which call this, did not decide it in doubles.  Most such points lie
 * exactly on the surface.  Two forms only, compiled here without the others, and
 * again for processors with a fused multiply-add, take a quarter of the time.
 */
#include "origin.h"
#include "sign.h"

#ifndef CYLINT_SIGN_ON_LINE
#define CYLINT_SIGN_ON_LINE cylint_sign_on_line_plain
#endif

#define INLINE static inline
#define FORM(name) origin_##name
#include "forms_template.h"

/* Whether t can be one of the data, and no operation on the forms underflows: of
 * elliptic kinds they would be of a higher degree than CYLINT_DEGREE. */
static int can_start_at(const cylint_query *q, pair t)
{
    return !cylint_is_elliptic(q->kind) &&
           !cylint_is_small(t.hi, CYLINT_WHOLE_EXPONENT) &&
           !cylint_is_small(t.lo, CYLINT_WHOLE_EXPONENT);
}

/* The line's origin moves to t. */
static void start_at(origin_terms *L, pair t)
{
    EACH(end, 2)
        EACH(i, 3)
            L->D[end][i] = bounded_pair_add(
                L->D[end][i], bounded_pair_mul((bounded_pair){t, 0}, L->u[i]));
}

static bounded_pair form_on_line(const cylint_query *q, pair t, cylint_form f,
                                 int end)
{
    origin_terms L;
    origin_fill(&L, q->shape, q->line, q->kind);
    if (cylint_sign(t.hi) != 0)
        start_at(&L, t);
    cylint_shorten_axis(q, L.w);
    if (f == FORM_C || cylint_is_elliptic(q->kind))
        origin_prepare_shape(&L);
    return f == FORM_C ? origin_form_C(&L) : origin_form_alpha(&L, end);
}

int CYLINT_SIGN_ON_LINE(const cylint_shape *shape, const cylint_line *line,
                        pair t, int surface)
{
    const int lateral = surface == CYLINT_LATERAL_SURFACE,
              at_origin = cylint_sign(t.hi) == 0;
    const cylint_form f = lateral ? FORM_C : FORM_ALPHA;
    const int end = lateral ? 0 : surface;
    int sign = CYLINT_SIGN_UNDECIDED;
    cylint_query q;
    cylint_query_open(&q, shape, line);
    if (q.pairs && (at_origin || can_start_at(&q, t))) {
        cylint_reached(PAIRS);
        sign = cylint_sign_of_pair(&q, form_on_line(&q, t, f, end));
    }
    return at_origin ? cylint_exact_sign(&q, f, end, sign) : sign;
}
