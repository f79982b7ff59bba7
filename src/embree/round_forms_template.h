/*
 * round_forms_template.h - the quadratics of round kinds, from dot products
 *
 * For float_filter_round.h, which states them, and for the test of their errors
 * (tests/bounds/test_embree_float_bounds.c), which runs them over sizes and
 * errors.
 * The including file defines NUM, ADD SUB MUL (x, y) and, with FORM(name), the
 * names of the functions; SMALL(x) is x, whose size is at most 1.
 */

/* D and u from the base: u.u, D.u, D.D, D.w, u.w; 1 / w.w; r0 and dr. */
typedef struct {
    NUM uu, Du, DD, alpha, beta, per_ww, r0, dr, one;
} FORM(round_terms);

typedef struct {
    NUM S, y0, z0, dz, a, b, c, G;
} FORM(round_cone);

/* The cone that touches both balls. */
INLINE void FORM(set_round_cone)(FORM(round_cone) *x,
                                 const FORM(round_terms) *t)
{
    const NUM height = ADD(t->alpha, MUL(t->r0, t->dr));
    x->S = SMALL(SUB(t->one, MUL(MUL(t->dr, t->dr), t->per_ww)));
    x->y0 = MUL(height, t->per_ww);
    x->z0 = MUL(t->alpha, t->per_ww);
    x->dz = MUL(t->beta, t->per_ww);
    x->a = SMALL(SUB(MUL(x->S, t->uu), MUL(t->beta, x->dz)));
    x->b = SUB(MUL(x->S, t->Du), MUL(height, x->dz));
    x->c = SUB(MUL(x->S, SUB(t->DD, MUL(t->r0, t->r0))), MUL(height, x->y0));
    x->G = SUB(MUL(x->b, x->b), MUL(x->a, x->c));
}

/* G of a ball of radius r about the origin of x. */
INLINE NUM FORM(round_ball_G)(NUM uu, NUM xu, NUM xx, NUM r)
{
    return SUB(MUL(xu, xu), MUL(uu, SUB(xx, MUL(r, r))));
}

#undef NUM
#undef FORM
#undef ADD
#undef SUB
#undef MUL
#undef SMALL
