/*
 * sign.h - one question: a line, a shape, and the exact signs of their forms
 */
#ifndef CYLINT_SIGN_H
#define CYLINT_SIGN_H

#include "../numbers/diagnostics.h"
#include "../shapes/measure.h"
#include "forms.h"

/* --------------------------------------------------- one question ------ */

enum { /* the parts of cylint_query that are computed */
       CYLINT_READY_BOUNDED = 1,
       CYLINT_READY_MOMENTS = 2,
       CYLINT_READY_TOP = 4,
       CYLINT_READY_PAIR = 8,
       CYLINT_READY_PAIR_MOMENTS = 16,
       CYLINT_READY_PAIR_TOP = 32,
       CYLINT_READY_EXACT = 64,
       CYLINT_READY_EXACT_MOMENTS = 128,
       CYLINT_READY_EXACT_TOP = 256,
       CYLINT_READY_QUADRATIC = 512,
       CYLINT_READY_WHOLE = 1024
};

typedef struct {
    const cylint_shape *shape; /* as given, for exact answers */
    const cylint_line *line;
    int kind, ends;
    int filters;    /* 0: data out of range, exact stage only */
    int pairs;      /* 0: filters is 0, or rounding is directed and
                       two_prod() not exact */
    int t_exponent; /* t = 2^t_exponent * t of the filters */
    const cylint_shape *near_shape; /* for the filters: as given, or */
    const cylint_line *near_line;   /* scaled by powers of two */
    cylint_shape scaled_shape;
    cylint_line scaled_line;
    unsigned ready; /* which terms are there */
    terms_bounded bounded_terms;
    cylint_terms_pair pair_terms;
    int shortened; /* 1: the axis of the pairs is a unit vector */
    int whole;     /* 1: no operation on the pairs underflows */
    cylint_terms_exact exact;
    exact exact_coefficient[3]; /* A, B, C */
    cylint_arena arena;
} cylint_query;

void cylint_query_open(cylint_query *q, const cylint_shape *shape,
                       const cylint_line *line);

/* Whether a part is computed now for the first time. */
static inline int cylint_is_first(cylint_query *q, unsigned part)
{
    const unsigned before = q->ready;
    q->ready |= part;
    return !(before & part);
}

/* The terms of the slower arithmetics, without moments and with all but that
 * about the top.  The first call computes them. */
cylint_terms_pair *cylint_load_pairs(cylint_query *q);
cylint_terms_pair *cylint_load_pair_moments(cylint_query *q);
const cylint_terms_exact *cylint_load_exact(cylint_query *q);
const cylint_terms_exact *cylint_load_exact_moments(cylint_query *q);

/* Whether no operation on pairs of these data underflows (error_bounds.h). */
int cylint_is_whole(const cylint_shape *s, const cylint_line *l);

/* The sign of a form, exactly, by the cheapest arithmetic that is certain. */
int cylint_form_sign(cylint_query *q, cylint_form f, int end);

/* `sign`, or if that is uncertain the sign of the form in exact numbers. */
enum { CYLINT_SIGN_UNCERTAIN = 2 };
int cylint_exact_sign(cylint_query *q, cylint_form f, int end, int sign);

#endif
