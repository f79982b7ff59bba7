/*
 * local_forms_template.h - the forms of a line in local coordinates
 *
 * Stated once for doubles and for pairs in two lanes.  The including file
 * names by macros, which end with this file:
 *
 *   V                      two numbers
 *   FORM(name)             the functions
 *   ADD SUB MUL (x, y)     lane by lane
 *   SUM_OF(x, y, z)        x y + z
 *   NEGATED(x)
 *   TRIMMED(x)             x without the cancelled digits in front, so that the
 *                          error of its square is relative to the square
 *   SUMS(x, y)             (x[0] + x[1], y[0] + y[1])
 *   TURNED(x), FIRSTS(x)   (x[1], x[0]); (x[0], x[0])
 *   PAIRED(x, y)           (x[0], y[0])
 *
 * In local coordinates (shapes/local.h) the line is (p, z) + t (v, w), p and v
 * in the plane, and the lateral surface |p|^2 = rho^2, rho = r + slope z.
 * Along the line
 *
 *   Q(t) = |p + t v|^2 - (rho + t slope w)^2 = A t^2 + 2 B t + C,
 *
 * Q < 0 within.  With z_i from the plane of cap i and X_i = w p - z_i v, the
 * forms of forms_template.h become
 *
 *   G   = |r v - slope X_0|^2 - (p x v)^2 = B^2 - A C
 *   E_i = r_i^2 w^2 - |X_i|^2             > 0: the line pierces cap i
 *   N_i = v . X_i - slope r_i w^2         dQ/dz at cap i, times w^2
 *   T   = v . Y, Y = r v - slope X_0      A rho at the vertex of Q
 *
 * A ball of radius r about a point of the axis, z from there, is
 *
 *   |p + t v|^2 + (z + t w)^2 = r^2,   that is   A t^2 + 2 B t + C < 0,
 *   A = v.v + w^2,  B = p.v + z w,  g = r^2 A - (p x v)^2 - |X|^2 = B^2 - A C.
 */

typedef struct {
    V p, v;     /* (x, y) */
    V z, r;     /* z from the plane of each cap, and its radius */
    V w, slope; /* the same number twice */
    V products; /* (v.v, p.v) */
} FORM(line);

/* The balls of a round kind: z from each centre, and the radius. */
typedef struct {
    V z, r;
} FORM(balls);

/* After the other members. */
INLINE void FORM(set_products)(FORM(line) *l)
{
    l->products = SUMS(MUL(l->v, l->v), MUL(l->p, l->v));
}

/* |x|^2. */
INLINE V FORM(square)(V x)
{
    const V squares = MUL(x, x);
    return ADD(squares, TURNED(squares));
}

/* X of a cap, z its z twice. */
INLINE V FORM(X)(const FORM(line) *l, V z)
{
    const V X = SUM_OF(NEGATED(z), l->v, MUL(l->w, l->p));
    return TRIMMED(X);
}

/* r v - slope X_0: of a straight shape r v. */
INLINE V FORM(Y)(const FORM(line) *l)
{
    const V Y = SUM_OF(NEGATED(l->slope), FORM(X)(l, FIRSTS(l->z)),
                       MUL(FIRSTS(l->r), l->v));
    return TRIMMED(Y);
}

/* p x v, in lane 1 its negative. */
INLINE V FORM(moment)(const FORM(line) *l)
{
    const V turned = MUL(l->p, TURNED(l->v));
    const V difference = SUB(turned, TURNED(turned));
    return TRIMMED(difference);
}

/* In lane 0. */
INLINE V FORM(G)(const FORM(line) *l, int tapered, const V *Y)
{
    const V moment = FORM(moment)(l);
    V square;
    if (tapered)
        square = FORM(square)(*Y);
    else
        square = MUL(MUL(l->r, l->r), FORM(square)(l->v));
    return SUM_OF(NEGATED(moment), moment, square);
}

/* In lane 0. */
INLINE V FORM(T)(const FORM(line) *l, const V *Y)
{
    const V products = MUL(l->v, *Y);
    return SUMS(products, products);
}

/* Of both caps. */
INLINE V FORM(E)(const FORM(line) *l)
{
    const V X0 = FORM(X)(l, FIRSTS(l->z));
    const V X1 = FORM(X)(l, FIRSTS(TURNED(l->z)));
    const V rw = MUL(l->r, l->w);
    return SUM_OF(rw, rw, NEGATED(SUMS(MUL(X0, X0), MUL(X1, X1))));
}

INLINE V FORM(N)(const FORM(line) *l, int tapered)
{
    const V vv = FIRSTS(l->products), pv = FIRSTS(TURNED(l->products));
    const V N = SUM_OF(l->z, NEGATED(vv), MUL(l->w, pv));
    if (!tapered)
        return N;
    const V rw = MUL(l->r, l->w);
    return SUM_OF(rw, NEGATED(MUL(l->slope, l->w)), N);
}

/* (A, B). */
INLINE V FORM(AB)(const FORM(line) *l, int tapered)
{
    if (!tapered)
        return l->products;
    const V rho1 = MUL(l->slope, l->w);
    const V rho0 = SUM_OF(l->slope, FIRSTS(l->z), FIRSTS(l->r));
    return SUM_OF(NEGATED(rho1), PAIRED(rho1, rho0), l->products);
}

/* A of a ball, twice. */
INLINE V FORM(ball_A)(const FORM(line) *l)
{
    const V squares = MUL(l->v, l->v);
    return SUM_OF(l->w, l->w, SUMS(squares, squares));
}

/* B of both balls. */
INLINE V FORM(ball_B)(const FORM(line) *l, const FORM(balls) *b)
{
    const V products = MUL(l->p, l->v);
    return SUM_OF(b->z, l->w, SUMS(products, products));
}

/* g of a ball, twice, z and r twice; of both balls. */
INLINE V FORM(one_ball_g)(const FORM(line) *l, V z, V r)
{
    const V X = FORM(X)(l, z), m = FORM(moment)(l), squares = MUL(X, X);
    const V square = SUM_OF(m, m, SUMS(squares, squares));
    return SUM_OF(MUL(r, r), FORM(ball_A)(l), NEGATED(square));
}

INLINE V FORM(ball_g)(const FORM(line) *l, const FORM(balls) *b)
{
    return PAIRED(
        FORM(one_ball_g)(l, FIRSTS(b->z), FIRSTS(b->r)),
        FORM(one_ball_g)(l, FIRSTS(TURNED(b->z)), FIRSTS(TURNED(b->r))));
}

#undef V
#undef FORM
#undef ADD
#undef SUB
#undef MUL
#undef SUM_OF
#undef NEGATED
#undef TRIMMED
#undef SUMS
#undef TURNED
#undef FIRSTS
#undef PAIRED
