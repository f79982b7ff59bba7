/*
 * local_forms_template.h - the forms of a line in local coordinates
 *
 * Stated once for doubles, for pairs and, in tests, for bounds on errors.  The
 * including file names by macros, which end with this file:
 *
 *   NUM                    a number
 *   FORM(name)             the functions
 *   SUB MUL (x, y)
 *   SUM_OF(x, y, z)        x y + z
 *   NEGATED(x)
 *   TRIMMED(x)             x without the cancelled digits in front, so that the
 *                          error of its square is relative to the square
 *
 * In local coordinates (shapes/local.h) the line is (p, z) + t (v, w), p and v
 * in the plane, and the lateral surface |p|^2 = rho^2, rho = r + slope z.
 * Along the line
 *
 *   Q(t) = |p + t v|^2 - (rho + t slope w)^2 = A t^2 + 2 B t + C,
 *
 * Q < 0 within.  With z_i from the plane of cap i and X_i = w p - z_i v, the
 * forms of signs/forms_template.h become
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

/* z and r: of cap 0. */
typedef struct {
    NUM p[2], v[2], z, w, r, slope;
    NUM vv, pv; /* |v|^2, p.v: set_products() */
} FORM(line);

INLINE NUM FORM(dot)(const NUM x[2], const NUM y[2])
{
    return SUM_OF(x[1], y[1], MUL(x[0], y[0]));
}

INLINE void FORM(set_products)(FORM(line) *l)
{
    l->vv = FORM(dot)(l->v, l->v);
    l->pv = FORM(dot)(l->p, l->v);
}

INLINE NUM FORM(square)(NUM x)
{
    return MUL(x, x);
}

/* Component i of X of the plane at z. */
INLINE NUM FORM(X)(const FORM(line) *l, NUM z, int i)
{
    const NUM X = SUM_OF(NEGATED(z), l->v[i], MUL(l->w, l->p[i]));
    return TRIMMED(X);
}

/* Y; of a straight shape r v. */
INLINE void FORM(set_Y)(const FORM(line) *l, NUM Y[2])
{
    EACH(i, 2) {
        const NUM y =
            SUM_OF(NEGATED(l->slope), FORM(X)(l, l->z, i), MUL(l->r, l->v[i]));
        Y[i] = TRIMMED(y);
    }
}

/* p x v. */
INLINE NUM FORM(moment)(const FORM(line) *l)
{
    const NUM m = SUB(MUL(l->p[0], l->v[1]), MUL(l->p[1], l->v[0]));
    return TRIMMED(m);
}

/* Y: of a tapered shape. */
INLINE NUM FORM(G)(const FORM(line) *l, int tapered, const NUM Y[2])
{
    const NUM m = FORM(moment)(l);
    NUM square;
    if (tapered)
        square = FORM(dot)(Y, Y);
    else
        square = MUL(FORM(square)(l->r), l->vv);
    return SUM_OF(NEGATED(m), m, square);
}

INLINE NUM FORM(T)(const FORM(line) *l, const NUM Y[2])
{
    return FORM(dot)(l->v, Y);
}

/* E and N of the cap of radius r whose plane is at z. */
INLINE NUM FORM(E)(const FORM(line) *l, NUM z, NUM r)
{
    const NUM X[2] = {FORM(X)(l, z, 0), FORM(X)(l, z, 1)};
    const NUM rw = MUL(r, l->w);
    return SUM_OF(rw, rw, NEGATED(FORM(dot)(X, X)));
}

INLINE NUM FORM(N)(const FORM(line) *l, NUM z, NUM r, int tapered)
{
    const NUM N = SUM_OF(z, NEGATED(l->vv), MUL(l->w, l->pv));
    if (!tapered)
        return N;
    return SUM_OF(MUL(r, l->w), NEGATED(MUL(l->slope, l->w)), N);
}

INLINE NUM FORM(A)(const FORM(line) *l, int tapered)
{
    if (!tapered)
        return l->vv;
    const NUM growth = MUL(l->slope, l->w);
    return SUM_OF(NEGATED(growth), growth, l->vv);
}

INLINE NUM FORM(B)(const FORM(line) *l, int tapered)
{
    if (!tapered)
        return l->pv;
    const NUM growth = MUL(l->slope, l->w);
    return SUM_OF(NEGATED(growth), SUM_OF(l->slope, l->z, l->r), l->pv);
}

/* A, B and g of the ball of radius r about the point at z of the axis. */
INLINE NUM FORM(ball_A)(const FORM(line) *l)
{
    return SUM_OF(l->w, l->w, l->vv);
}

INLINE NUM FORM(ball_B)(const FORM(line) *l, NUM z)
{
    return SUM_OF(z, l->w, l->pv);
}

INLINE NUM FORM(ball_g)(const FORM(line) *l, NUM z, NUM r)
{
    const NUM X[2] = {FORM(X)(l, z, 0), FORM(X)(l, z, 1)};
    const NUM m = FORM(moment)(l);
    const NUM square = SUM_OF(m, m, FORM(dot)(X, X));
    return SUM_OF(FORM(square)(r), FORM(ball_A)(l), NEGATED(square));
}

#undef NUM
#undef FORM
#undef SUB
#undef MUL
#undef SUM_OF
#undef NEGATED
#undef TRIMMED
