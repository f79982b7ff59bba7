/*
 * cone_form_template.h - the quadratics of a cone and of a ball, from dot products
 *
 * For float_filter_lanes.h, which states them, and for the test of their errors
 * (tests/bounds/test_embree_float_bounds.c), which runs them over sizes and errors.
 * The including file defines NUM, ADD SUB MUL (x, y) and, with FORM(name), the
 * names of the functions and of two structs: `questions` with the members that are
 * read and written here, `quadratic` with a, b and c.  MOST(x, T) is x, whose size
 * is at most T if |u|, |w| and K are 1.
 */

/* Writes y0, z0, dz and the quadratic along the line; returns G. */
INLINE NUM FORM(cone_G)(FORM(questions) *q, FORM(quadratic) *to)
{
    const NUM part = MUL(q->r0, q->dr);
    const NUM height = ADD(MUL(q->T, q->alpha), part);
    q->y0 = MUL(height, q->per_ww); /* of a round kind: T is 1 */
    q->z0 = MUL(q->alpha, q->per_ww);
    q->dz = MUL(q->beta, q->per_ww);
    to->a = MOST(SUB(MUL(q->S, q->uu), MUL(MUL(q->T, q->beta), q->dz)), q->T);
    to->b = MOST(SUB(MUL(q->S, q->Du), MUL(height, q->dz)), q->T);
    to->c = MOST(SUB(SUB(MUL(q->S, q->DD), MUL(q->r0, q->r0)),
                     MUL(ADD(height, part), q->z0)),
                 q->T);
    return SUB(MUL(to->b, to->b), MUL(to->a, to->c));
}

/* G of a ball of radius r about the origin of x. */
INLINE NUM FORM(ball_G)(NUM uu, NUM xu, NUM xx, NUM r)
{
    return SUB(MUL(xu, xu), MUL(uu, SUB(xx, MUL(r, r))));
}

#undef NUM
#undef FORM
#undef ADD
#undef SUB
#undef MUL
#undef MOST
