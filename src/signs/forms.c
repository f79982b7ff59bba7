/*
 * forms.c - the forms over bounded pairs and over exact numbers
 *
 * These are large and rarely needed, so the library has them once.
 */
#include "forms.h"

#define INLINE

#define FORMS_DEFINED
#define NUM bounded_pair
#define FORM(name) cylint_##name##_pair
#define ADD(x, y) bounded_pair_add(x, y)
#define SUB(x, y) bounded_pair_sub(x, y)
#define MUL(x, y) bounded_pair_mul(x, y)
#define DATUM(x) bounded_pair_of(x, 0)
#define DIFFERENCE(x, y) bounded_pair_difference(x, y)
#define DIRECTION(l, i) bounded_pair_of(l->d[i], l->d_lo[i])
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
