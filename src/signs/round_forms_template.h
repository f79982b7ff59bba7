/*
 * round_forms_template.h - the forms of round kinds; part of forms_template.h
 *
 * Sphere: the ball about the base, |D_0|^2 = r_0^2.  Along the line that is
 *
 *   A = u.u,  B = D_0.u,  C = |D_0|^2 - r_0^2,  S = 1,  G = r_0^2 u.u - |M_0|^2.
 *
 * Capsule and rcone: the balls of radius r_i about p_i.  The cone that touches
 * both touches ball i on a circle in the plane alpha_i = 0,
 *
 *   alpha_i = D_i.w + r_i dr,
 *
 * and is vv (vv - dr^2) |D_i|^2 - ... = 0, which is vv times
 *
 *   Q = (vv - dr^2) (|D_i|^2 - r_i^2) - alpha_i^2
 *     = |D_0 x w|^2 - |V|^2,   V = r_0 w + dr D_0.
 *
 * The first form of Q shows that the cone touches ball i where alpha_i = 0.
 * The second one gives A, B and C.  The discriminant is
 *
 *   B^2 - A C = S G,  S = vv - dr^2,  G = |r_0 n - dr M_0|^2 - (w.M_0)^2.
 *
 * The line meets the plane of circle i at P / beta from p_i,
 *
 *   P = w x M_i - r_i dr u,
 *
 * and the disc in that circle is the part of the plane in ball i:
 *
 *   E_i = r_i^2 beta^2 - |P|^2        positive within the disc,
 *   N_i = P.u                         beta times half the growth of |D_i|^2
 *                                     along the line; dQ/dz has its sign.
 *
 * All of this holds for a capsule, where dr = 0 and Q is that of a cylinder.
 */

/* r^2 |u|^2 - |M|^2: below 0 if the line, of moment M about a point, passes at
 * a distance of more than r from it. */
INLINE NUM FORM(form_ball)(const FORM(terms) *L, const NUM M[3], NUM r)
{
    BEGIN
    NUM x = SUB(MUL(MUL(r, r), FORM(dot)(L, L->u, L->u)), FORM(dot)(L, M, M));
    RETURN(x)
}

/* The ball about end i. */
INLINE NUM FORM(form_end_ball)(const FORM(terms) *L, int i)
{
    return FORM(form_ball)(L, L->M[i], L->r[i]);
}

INLINE NUM FORM(round_alpha)(const FORM(terms) *L, int i)
{
    BEGIN
    NUM alpha = FORM(dot)(L, L->D[i], L->w);
    if (L->kind == CYLINT_KIND_RCONE)
        alpha = ADD(alpha, MUL(L->r[i], L->dr));
    RETURN(alpha)
}

/* Component j of P. */
INLINE NUM FORM(round_pierced)(const FORM(terms) *L, int i, int j)
{
    BEGIN
    NUM P = FORM(minor)(L, L->w, L->M[i], (j + 1) % 3, (j + 2) % 3);
    if (L->kind == CYLINT_KIND_RCONE)
        P = SUB(P, MUL(MUL(L->r[i], L->dr), L->u[j]));
    RETURN(P)
}

INLINE NUM FORM(round_E)(const FORM(terms) *L, int i)
{
    BEGIN
    NUM x = MUL(L->r[i], L->beta), P[3];
    EACH(j, 3)
        P[j] = FORM(round_pierced)(L, i, j);
    NUM E = SUB(MUL(x, x), FORM(dot)(L, P, P));
    RETURN(E)
}

/* (w x M_i).u = M_i.n */
INLINE NUM FORM(round_N)(const FORM(terms) *L, int i)
{
    BEGIN
    NUM N = FORM(dot)(L, L->M[i], L->n);
    if (L->kind == CYLINT_KIND_RCONE)
        N = SUB(N, MUL(MUL(L->r[i], L->dr), FORM(dot)(L, L->u, L->u)));
    RETURN(N)
}

/* Component j of V. */
INLINE NUM FORM(round_V)(const FORM(terms) *L, int j)
{
    BEGIN
    NUM V = MUL(L->r[0], L->w[j]);
    if (L->kind == CYLINT_KIND_RCONE)
        V = ADD(V, MUL(L->dr, L->D[0][j]));
    RETURN(V)
}

INLINE NUM FORM(round_S)(const FORM(terms) *L)
{
    BEGIN
    NUM S = L->kind == CYLINT_KIND_SPHERE ? L->one : L->vv;
    if (L->kind == CYLINT_KIND_RCONE)
        S = SUB(S, MUL(L->dr, L->dr));
    RETURN(S)
}

INLINE NUM FORM(round_G)(const FORM(terms) *L)
{
    BEGIN
    if (L->kind == CYLINT_KIND_SPHERE)
        RETURN(FORM(form_end_ball)(L, 0))
    NUM h = FORM(dot)(L, L->w, L->M[0]);
    NUM Y2 = L->kind == CYLINT_KIND_CAPSULE
                 ? MUL(MUL(L->r[0], L->r[0]), FORM(dot)(L, L->n, L->n))
                 : FORM(square_of_Y)(L);
    NUM G = SUB(Y2, MUL(h, h));
    RETURN(G)
}

INLINE NUM FORM(round_A)(const FORM(terms) *L)
{
    BEGIN
    NUM uu = FORM(dot)(L, L->u, L->u);
    if (L->kind == CYLINT_KIND_SPHERE)
        RETURN(uu)
    NUM A = FORM(dot)(L, L->n, L->n);
    if (L->kind == CYLINT_KIND_RCONE)
        A = SUB(A, MUL(MUL(L->dr, L->dr), uu));
    RETURN(A)
}

INLINE NUM FORM(round_B)(const FORM(terms) *L)
{
    BEGIN
    if (L->kind == CYLINT_KIND_SPHERE)
        RETURN(FORM(dot)(L, L->D[0], L->u))
    NUM X[3];
    FORM(cross)(L, L->D[0], L->w, X);
    NUM B = FORM(dot)(L, X, L->n);
    if (L->kind == CYLINT_KIND_RCONE) {
        NUM V[3];
        EACH(j, 3)
            V[j] = FORM(round_V)(L, j);
        B = SUB(B, MUL(L->dr, FORM(dot)(L, V, L->u)));
    }
    RETURN(B)
}

INLINE NUM FORM(round_C)(const FORM(terms) *L)
{
    BEGIN
    NUM C;
    if (L->kind == CYLINT_KIND_SPHERE) {
        C = SUB(FORM(dot)(L, L->D[0], L->D[0]), MUL(L->r[0], L->r[0]));
    } else {
        NUM X[3], V[3];
        FORM(cross)(L, L->D[0], L->w, X);
        EACH(j, 3)
            V[j] = FORM(round_V)(L, j);
        C = SUB(FORM(dot)(L, X, X), FORM(dot)(L, V, V));
    }
    RETURN(C)
}
