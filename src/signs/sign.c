/*
 * sign.c - the sign of each form: in doubles, then in pairs, then exactly
 * [Shewchuk 1997]
 *
 * A filter's answer is final when the value exceeds the bound on its error
 * (error_bounds.h), or when pairs have no error.  Comparisons are written so
 * that a NaN falls to the next arithmetic.
 */
#include "sign.h"

#ifdef CYLINT_COUNT_STAGES
unsigned long long cylint_stages[CYLINT_STAGES];
#endif

/* ------------------------- the forms over bounded pairs and exact numbers -- */

#define INLINE

#define FORMS_DEFINED
#define FORM(name) cylint_##name##_pair
#include "forms_template.h"

#define FORMS_DEFINED
#define FORMS_OF_HITS
#define NUM exact
#define FORM(name) cylint_##name##_exact
#define ADD(x, y) cylint_exact_add(L->arena, x, y)
#define SUB(x, y) cylint_exact_sub(L->arena, x, y)
#define MUL(x, y) cylint_exact_mul(L->arena, x, y)
#define DATUM(x) cylint_exact_from(L->arena, x)
/* of data, not of the nearest doubles to differences */
#define DIFFERENCE(x, y) cylint_exact_difference(L->arena, x, y)
#define DIRECTION(l, i) \
    (l->segment ? DIFFERENCE(l->end[i], l->o[i]) : DATUM(l->d[i]))
#define BEGIN const int used_before = L->arena->used;
#define RETURN(x) return cylint_exact_keep(L->arena, used_before, x);
#include "forms_template.h"

/* -------------------------------------------------------- terms ------ */

/* The terms that the form takes, here and below. */
static terms_bounded *load_bounded(cylint_query *q, cylint_form f, int end)
{
    terms_bounded *L = &q->bounded_terms;
    if (!L->ready)
        fill_bounded(L, q->shape, q->line, q->kind);
    prepare_bounded(L, f, end);
    return L;
}

cylint_terms_pair *cylint_load_pairs(cylint_query *q, cylint_form f, int end)
{
    cylint_terms_pair *L = &q->pair_terms;
    if (!L->ready) {
        cylint_reached(PAIRS);
        cylint_fill_pair(L, q->shape, q->line, q->kind);
        cylint_shorten_axis(q, L->w);
    }
    cylint_prepare_pair(L, f, end);
    return L;
}

const cylint_terms_exact *cylint_load_exact(cylint_query *q, cylint_form f,
                                            int end)
{
    cylint_terms_exact *L = &q->exact;
    if (!L->ready) {
        cylint_reached(EXACT);
        L->arena = &q->arena;
        cylint_arena_open(L->arena);
        cylint_fill_exact(L, q->shape, q->line, q->kind);
    }
    cylint_prepare_exact(L, f, end);
    return L;
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

void cylint_query_open(cylint_query *q, const cylint_shape *shape,
                       const cylint_line *line)
{
    q->shape = shape;
    q->line = line;
    q->kind = shape->kind;
    q->ends = shape->ends;
    q->bounded_terms.ready = q->pair_terms.ready = q->exact.ready = 0;
    cylint_reached(FILTER);
    q->filters = filters_apply(shape, line);
    q->pairs = q->filters && cylint_rounds_to_nearest();
}

/* ---------------------------------------------------------- signs ------ */

static int are_whole(const double *x, int n)
{
    int small = 0;
    for (int i = 0; i < n; i++)
        small |= cylint_is_small(x[i], CYLINT_WHOLE_EXPONENT);
    return !small;
}

/* Whether no operation on the pairs underflows (error_bounds.h). */
static int pairs_are_whole(const cylint_query *q)
{
    const cylint_shape *s = q->shape;
    const cylint_line *l = q->line;
    return are_whole(s->library.number, CYLINT_AT_COLUMNS) &&
           are_whole(cylint_axis(s), CYLINT_NUMBERS - CYLINT_AT_AXIS) &&
           are_whole(l->o, 3) && are_whole(l->d, 3) && are_whole(l->end, 3);
}

int cylint_sign_of_pair(const cylint_query *q, bounded_pair x)
{
    return fabs(x.v.hi) > bounded_pair_error(x) ||
                   (x.error == 0 && pairs_are_whole(q))
               ? cylint_sign(x.v.hi)
               : CYLINT_SIGN_UNDECIDED;
}

static int sign_in_doubles(cylint_query *q, cylint_form f, int end)
{
    const bounded_double x = form_bounded(load_bounded(q, f, end), f, end);
    return fabs(x.v) > bounded_error(x) ? cylint_sign(x.v)
                                        : CYLINT_SIGN_UNDECIDED;
}

static int sign_in_pairs(cylint_query *q, cylint_form f, int end)
{
    return cylint_sign_of_pair(
        q, cylint_form_pair(cylint_load_pairs(q, f, end), f, end));
}

int cylint_exact_sign(cylint_query *q, cylint_form f, int end, int sign)
{
    if (sign != CYLINT_SIGN_UNDECIDED && !CYLINT_IS_PARANOID)
        return sign;
    const cylint_terms_exact *L = cylint_load_exact(q, f, end);
    const int used = q->arena.used;
    const int exactly = cylint_form_exact(L, f, end).sign;
    q->arena.used = used;
    cylint_contradiction(sign != CYLINT_SIGN_UNDECIDED && sign != exactly);
    return exactly;
}

int cylint_form_sign(cylint_query *q, cylint_form f, int end)
{
    int sign = q->filters ? sign_in_doubles(q, f, end) : CYLINT_SIGN_UNDECIDED;
    if (sign == CYLINT_SIGN_UNDECIDED && q->pairs)
        sign = sign_in_pairs(q, f, end);
    return cylint_exact_sign(q, f, end, sign);
}
