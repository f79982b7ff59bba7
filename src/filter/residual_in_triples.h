/*
 * residual_in_triples.h - the residual at a root that pairs do not round
 *
 * A line that begins on the surface has a root near 0.  It is so small beside
 * the shape that the residual in pairs has too few digits.  Here are the forms
 * of the lateral surface and of a cap's plane in triples, at o + t d.
 */
#ifndef CYLINT_RESIDUAL_IN_TRIPLES_H
#define CYLINT_RESIDUAL_IN_TRIPLES_H

#include "../numbers/simd.h"
#include "../numbers/triple.h"
#include "../shapes/shape_facts.h"
#include "cylint.h"

#undef INLINE /* large functions, rarely called */
#define INLINE static inline
#define BEGIN (void)L;
#define RETURN(x) return x;
#define MEMORY
#define NUM triple
#define FORM(name) name##_triple
#define ADD(x, y) triple_add(x, y)
#define SUB(x, y) triple_sub(x, y)
#define MUL(x, y) triple_mul(x, y)
#include "../signs/forms_template.h"
#undef MEMORY
#undef BEGIN
#undef RETURN

/* A line whose origin is moved to o + t d. */
typedef struct {
    const cylint_line *line;
    double t;
} moved_line;

static inline triple moved_from(const moved_line *l, int i, double center)
{
    const pair D = two_diff(l->line->o[i], center);
    const pair step = two_prod(l->t, l->line->d[i]);
    const pair rest = two_prod(l->t, l->line->d_lo[i]);
    return triple_add(triple_sum(D.hi, D.lo, 0),
                      triple_add((triple){step.hi, step.lo, 0},
                                 (triple){rest.hi, rest.lo, 0}));
}

#define FORM(name) name##_triple
#define LOAD_INLINE INLINE
#define SHAPE cylint_shape
#define LINE moved_line
#define DIRECTION(l, i) triple_of(l->line->d[i])
#define AXIS(s, i) ((triple){s->axis[i], s->axis_lo[i], 0})
#define FROM_BASE(l, s, i) moved_from(l, i, s->base[i])
#define FROM_TOP(l, s, i) moved_from(l, i, s->top[i])
#define BEFORE_TOP(D, w) triple_sub(D, w)
#define SEMI_AXIS_A(s, i) triple_of(s->a[i])
#define SEMI_AXIS_B(s, i) triple_of(s->left_handed ? -s->b[i] : s->b[i])
#define RADIUS(s, end) triple_of(cylint_end_factor(s, end))
#define RADIUS_GROWTH(s) ((triple){s->dr, s->dr_lo, 0})
#define ONE triple_of(1)
#include "../signs/load_template.h"
#undef INLINE
#define INLINE CYLINT_INLINE

/* In local coordinates, of the part that holds the root: of the plane of `cap`
 * or, if cap is -1, of the lateral surface. */
ASIDE double residual_in_triples(const cylint_shape *shape,
                                 const cylint_line *line, double t, int cap,
                                 int kind)
{
    const moved_line moved = {line, t};
    terms_triple L;
    load_shape_triple(&L, shape, kind);
    load_line_triple(&L, shape, &moved);
    prepare_shape_triple(&L);
    if (cap >= 0)
        load_top_triple(&L, shape, &moved);
    const triple value =
        cap >= 0 ? form_alpha_triple(&L, cap) : form_C_triple(&L);
    return (value.a + value.b) /
           (cap >= 0 ? shape->local.scale : shape->local.square_scale);
}

#endif
