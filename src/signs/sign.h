/*
 * sign.h - one question: a line, a shape, and the exact signs of their forms
 */
#ifndef CYLINT_SIGN_H
#define CYLINT_SIGN_H

#include "../numbers/diagnostics.h"
#include "../shapes/measure.h"
#include "forms.h"

/* --------------------------------------------------- one question ------ */

typedef struct {
    const cylint_shape *shape;
    const cylint_line *line;
    int kind, ends;
    int filters; /* 0: data out of range, exact stage only */
    int pairs;   /* 0: filters is 0, or rounding is directed and
                       two_prod() not exact */
    terms_bounded bounded_terms;
    cylint_terms_pair pair_terms;
    cylint_terms_exact exact;
    cylint_arena arena;
} cylint_query;

void cylint_query_open(cylint_query *q, const cylint_shape *shape,
                       const cylint_line *line);

/* The terms that a form of this end takes, in the slower arithmetics.  Computes
 * those that are not there yet. */
cylint_terms_pair *cylint_load_pairs(cylint_query *q, cylint_form f, int end);
const cylint_terms_exact *cylint_load_exact(cylint_query *q, cylint_form f,
                                            int end);

/* Signs and roots of a cylinder or capsule do not depend on the length of the axis
 * w.  Along a coordinate's direction it becomes a unit vector, by which products
 * are exact.  The bits of the stored axis show that: a component of w can have been
 * flushed to 0. */
static inline void cylint_shorten_axis(const cylint_query *q, bounded_pair w[3])
{
    const double *axis = cylint_axis(q->shape);
    if (q->kind != CYLINT_KIND_CYLINDER && q->kind != CYLINT_KIND_CAPSULE)
        return;
    for (int i = 0; i < 3; i++)
        if (cylint_runs_along(axis, i))
            w[i] = bounded_pair_of(cylint_sign(axis[i]), 0);
}

/* The sign of a form, exactly, by the cheapest arithmetic that is certain. */
int cylint_form_sign(cylint_query *q, cylint_form f, int end);

/* The sign of a form in pairs.  It is certain also of a form that is 0, if its
 * error is 0. */
int cylint_sign_of_pair(const cylint_query *q, bounded_pair x);

/* `sign`, or if that is undecided the sign of the form in exact numbers. */
int cylint_exact_sign(cylint_query *q, cylint_form f, int end, int sign);

#endif
