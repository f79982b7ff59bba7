/*
 * forms_template.h - the mathematics, stated once
 *
 * Every sign that decides a verdict and every coefficient of a root is a
 * polynomial in the data.  They stand here as straight-line code over an
 * arithmetic that the including file names by macros.  All but INLINE end with
 * this file; those in brackets may be left out.  Without NUM the arithmetic is that
 * of bounded pairs (forms.h):
 *
 *   INLINE                  how its functions are declared
 *   NUM                     the type of a number
 *   FORM(name)              how the functions of this arithmetic are called
 *   ADD SUB MUL (x, y)      its operations
 *   [DATUM(x), DIFFERENCE(x, y), DIRECTION(l, i)]
 *                           a datum, the difference of two, and component i of
 *                           a line's direction; without them the terms are not
 *                           filled here
 *   [MEMORY]                a declaration in the terms, if it needs room
 *   [BEGIN, RETURN(x)]      first and last words of a form, if intermediate
 *                           results must be freed
 *   [FORMS_DECLARED]        the file defines the terms and declares the functions
 *   [FORMS_DEFINED]         it defines the functions only; neither: both
 *   [FORMS_OF_HITS]         with those of z, normal and phi of a hit, and
 *                           products of vectors
 *
 * The terms.  Line A + t u; D_i = A - p_i, the origin relative to the centre
 * of cap i; M_i = D_i x u, its moment about that centre.
 *
 * Circular kinds: axis w, vv = w.w, n = u x w, z = P.w/vv.  With X = P x w
 * (length: distance times |w|) the lateral surface is s |X|^2 = rho^2, where
 *
 *   cylinder   s = 1,  rho^2 = r0^2 vv
 *   cone       s = vv, rho = r0 vv + dr P.w          (both sides times vv)
 *   acone      s = 1,  rho = k P.w                   (r0 = 0, dr = r1 = k)
 *
 * Elliptic kinds: semi-axes a, b, height w; e = a x b, p = b x w, q = w x a,
 * det = a.p > 0; x = P.p/det, y = P.q/det, z = P.e/det.  With X = (P.p, P.q)
 * the surface is |X|^2 = rho^2, rho = det + kappa P.e, kappa = k - 1 = dr.
 *
 * Along the line X = X0 + t X1 and rho = rho0 + t rho1, so
 *
 *   Q(t) = A t^2 + 2 B t + C,   A = s X1.X1 - rho1^2, and so on,
 *
 * Q < 0 within.  Its discriminant, by Lagrange's identity in the Minkowski
 * form (s, s, s, -1), is s (|rho0 X1 - rho1 X0|^2 - s |X0 x X1|^2), and both
 * terms depend on the line's moment only, not on where its origin lies:
 *
 *   B^2 - A C = S G
 *   cylinder   S = vv     G = r0^2 |n|^2 - (w.M)^2
 *   cone       S = vv^2   G = vv |r0 n - dr M|^2 - (vv + dr^2) (w.M)^2
 *   acone      S = vv     G = the same with r0 = 0, dr = k and 1 for the
 *                             lone vv: k^2 vv |M|^2 - (1 + k^2) (w.M)^2
 *   elliptic   S = det^2  G = (U + kappa b.M)^2 + (V - kappa a.M)^2 - (w.M)^2
 *                             with U = u.p, V = u.q
 *
 * In this form far origins cost no digits; b^2 - ac loses all of them.
 *
 * The same moments decide where the line crosses the plane of cap i (beta
 * being u.w, or u.e; the point is P = w x M_i / beta):
 *
 *   E_i = -beta^2 (distance^2 - radius^2): positive within the cap's disc
 *   N_i = dQ/dz up to a positive factor: on which side of the chord's middle
 *
 * Round kinds.  Sphere, the ball about the base: X = D_0, X1 = n = u, rho = r_0,
 *
 *   S = 1,  G = r_0^2 |u|^2 - |M_0|^2.
 *
 * A capsule has the forms of its cylinder.  Round cone: the cone that touches both
 * balls touches ball i on a circle in the plane alpha_i = 0,
 *
 *   alpha_i = D_i.w + r_i dr,
 *
 * and is vv (vv - dr^2) |D_i|^2 - ... = 0, which is vv times
 *
 *   Q = (vv - dr^2) (|D_i|^2 - r_i^2) - alpha_i^2
 *     = |D_0 x w|^2 - |V|^2,   V = r_0 w + dr D_0.
 *
 * The first form of Q shows that the cone touches ball i where alpha_i = 0.  In the
 * second one the vector V = V_0 + t V_1 has the place of rho; V_1 = dr u.
 *
 *   S = vv - dr^2,  G = |r_0 n - dr M_0|^2 - (w.M_0)^2.
 *
 * The line crosses the plane of circle i at P / beta from p_i,
 *
 *   P = w x M_i - r_i dr u,
 *
 * and the disc in that circle is the part of the plane in ball i:
 *
 *   E_i = r_i^2 beta^2 - |P|^2        positive within the disc,
 *   N_i = P.u                         beta times half the growth of |D_i|^2
 *                                     along the line; dQ/dz has its sign.
 *
 * The side's roots are never compared with the planes: the signs of E_0,
 * E_1, N_0, N_1 and G determine their order.
 */

#ifndef NUM
#define NUM bounded_pair
#define ADD(x, y) bounded_pair_add(x, y)
#define SUB(x, y) bounded_pair_sub(x, y)
#define MUL(x, y) bounded_pair_mul(x, y)
#define DATUM(x) bounded_pair_of(x, 0)
#define DIFFERENCE(x, y) bounded_pair_difference(x, y)
#define DIRECTION(l, i) bounded_pair_of(l->d[i], l->d_lo[i])
#endif
#ifndef MEMORY
#define MEMORY
#endif
#ifndef BEGIN
#define BEGIN (void)L;
#define RETURN(x) return x;
#endif

#ifndef FORMS_DEFINED
typedef struct {
    MEMORY
    int kind;
    NUM u[3], w[3], D[2][3], r[2], dr; /* the data: fill() */
    NUM a[3], b[3], one;               /* a, b for elliptic kinds; one = 1 */
    NUM vv, n[3];                      /* circular */
    NUM e[3], p[3], q[3], det, U, V;   /* elliptic */
    NUM beta, M[2][3];
    int ready; /* parts of the terms that are computed: prepare() */
} FORM(terms);
#endif

#ifdef FORMS_DECLARED
INLINE void FORM(fill)(FORM(terms) *L, const cylint_shape *s,
                       const cylint_line *l, int kind);
INLINE void FORM(prepare)(FORM(terms) *L, cylint_form f, int end);
INLINE NUM FORM(form)(const FORM(terms) *L, cylint_form f, int end);
#ifdef FORMS_OF_HITS
INLINE NUM FORM(dot)(const FORM(terms) *L, const NUM x[3], const NUM y[3]);
INLINE void FORM(cross)(const FORM(terms) *L, const NUM x[3], const NUM y[3],
                        NUM xy[3]);
INLINE NUM FORM(combined)(const FORM(terms) *L, NUM a, NUM x, NUM b, NUM y);
INLINE const NUM *FORM(axial)(const FORM(terms) *L);
INLINE void FORM(gradient)(const FORM(terms) *L, NUM N[3]);
INLINE void FORM(about_axis)(const FORM(terms) *L, int number, NUM *x, NUM *y);
#endif
#else
#ifdef DATUM
/* Sets the terms that are data or differences of data. */
INLINE void FORM(fill)(FORM(terms) *L, const cylint_shape *s,
                       const cylint_line *l, int kind)
{
    L->kind = kind;
    EACH(i, 3) {
        L->u[i] = DIRECTION(l, i);
        L->D[0][i] = DIFFERENCE(l->o[i], cylint_base(s)[i]);
        if (cylint_has_end_points(kind)) {
            L->w[i] = DIFFERENCE(cylint_top(s)[i], cylint_base(s)[i]);
            L->D[1][i] = DIFFERENCE(l->o[i], cylint_top(s)[i]);
        } else {
            L->w[i] = DATUM(cylint_axis(s)[i]);
            L->D[1][i] = SUB(L->D[0][i], L->w[i]);
        }
        if (cylint_is_elliptic(kind)) {
            const double b = cylint_b(s)[i];
            L->a[i] = DATUM(cylint_a(s)[i]);
            L->b[i] = DATUM(cylint_left_handed(s) ? -b : b);
        }
    }
    L->r[0] = DATUM(cylint_r0(s));
    L->r[1] = DATUM(cylint_r1(s));
    L->dr = DIFFERENCE(cylint_r1(s), cylint_r0(s));
    L->one = DATUM(1);
}
#endif

INLINE NUM FORM(dot)(const FORM(terms) *L, const NUM x[3], const NUM y[3])
{
    BEGIN
    NUM sum = ADD(ADD(MUL(x[0], y[0]), MUL(x[1], y[1])), MUL(x[2], y[2]));
    RETURN(sum)
}

/* a x - b y. */
INLINE NUM FORM(combined)(const FORM(terms) *L, NUM a, NUM x, NUM b, NUM y)
{
    BEGIN
    NUM z = SUB(MUL(a, x), MUL(b, y));
    RETURN(z)
}

INLINE NUM FORM(minor)(const FORM(terms) *L, const NUM x[3], const NUM y[3],
                       int i, int j)
{
    BEGIN
    NUM m = SUB(MUL(x[i], y[j]), MUL(x[j], y[i]));
    RETURN(m)
}

INLINE void FORM(cross)(const FORM(terms) *L, const NUM x[3], const NUM y[3],
                        NUM xy[3])
{
    xy[0] = FORM(minor)(L, x, y, 1, 2);
    xy[1] = FORM(minor)(L, x, y, 2, 0);
    xy[2] = FORM(minor)(L, x, y, 0, 1);
}

INLINE int FORM(elliptic)(const FORM(terms) *L)
{
    return cylint_is_elliptic(L->kind);
}

/* The axial functional: z grows with P.axial. */
INLINE const NUM *FORM(axial)(const FORM(terms) *L)
{
    return FORM(elliptic)(L) ? L->e : L->w;
}

/* Sets the terms, from the data, that do not depend on the line's direction. */
INLINE void FORM(prepare_shape)(FORM(terms) *L)
{
    if (FORM(elliptic)(L)) {
        FORM(cross)(L, L->a, L->b, L->e);
        FORM(cross)(L, L->b, L->w, L->p);
        FORM(cross)(L, L->w, L->a, L->q);
        L->det = FORM(dot)(L, L->a, L->p);
    } else {
        L->vv = FORM(dot)(L, L->w, L->w);
    }
}

/* Computes the terms that form f of this end takes, each part once.  Before, the
 * data are filled, and `ready` is 0.  Part 3 is the moment about the top. */
INLINE void FORM(prepare)(FORM(terms) *L, cylint_form f, int end)
{
    const int parts = f < FORM_E ? 1 : end ? 3 : 2;
    if (L->ready < 1) {
        FORM(prepare_shape)(L);
        L->beta = FORM(dot)(L, L->u, FORM(axial)(L));
    }
    if (L->ready < 2 && parts >= 2) {
        if (FORM(elliptic)(L)) {
            L->U = FORM(dot)(L, L->u, L->p);
            L->V = FORM(dot)(L, L->u, L->q);
        } else if (L->kind == CYLINT_KIND_SPHERE) {
            EACH(i, 3)
                L->n[i] = L->u[i];
        } else {
            FORM(cross)(L, L->u, L->w, L->n);
        }
        FORM(cross)(L, L->D[0], L->u, L->M[0]);
    }
    if (L->ready < 3 && parts == 3)
        FORM(cross)(L, L->D[1], L->u, L->M[1]);
    if (L->ready < parts)
        L->ready = parts;
}

/* |r0 n - dr M|^2. */
INLINE NUM FORM(square_of_Y)(const FORM(terms) *L)
{
    BEGIN
    NUM Y[3];
    EACH(j, 3)
        Y[j] = FORM(combined)(L, L->r[0], L->n[j], L->dr, L->M[0][j]);
    NUM Y2 = FORM(dot)(L, Y, Y);
    RETURN(Y2)
}

/* z of the origin from the plane at end i, times a positive factor.  The plane
 * is that of the cap, or of the circle of a round kind. */
INLINE NUM FORM(form_alpha)(const FORM(terms) *L, int i)
{
    BEGIN
    NUM alpha = FORM(dot)(L, L->D[i], FORM(axial)(L));
    if (L->kind == CYLINT_KIND_RCONE)
        alpha = ADD(alpha, MUL(L->r[i], L->dr));
    RETURN(alpha)
}

/* rho = rho0 + t rho1 along the line; not of a round cone. */
INLINE NUM FORM(form_rho0)(const FORM(terms) *L)
{
    BEGIN
    NUM rho;
    switch (L->kind) {
    case CYLINT_KIND_CYLINDER:
    case CYLINT_KIND_SPHERE:
    case CYLINT_KIND_CAPSULE:
        rho = L->r[0];
        break;
    case CYLINT_KIND_CONE:
        rho = ADD(MUL(L->r[0], L->vv), MUL(L->dr, FORM(form_alpha)(L, 0)));
        break;
    case CYLINT_KIND_ACONE:
        rho = MUL(L->dr, FORM(form_alpha)(L, 0));
        break;
    default:
        rho = ADD(L->det, MUL(L->dr, FORM(form_alpha)(L, 0)));
    }
    RETURN(rho)
}

/* Component j of V_0 or V_1 of a round cone. */
INLINE NUM FORM(component_of_V)(const FORM(terms) *L, int number, int j)
{
    BEGIN
    NUM V = MUL(L->dr, number ? L->u[j] : L->D[0][j]);
    if (number == 0)
        V = ADD(MUL(L->r[0], L->w[j]), V);
    RETURN(V)
}

/* rho_i rho_j; of a round cone V_i.V_j. */
INLINE NUM FORM(rho_product)(const FORM(terms) *L, int i, int j)
{
    BEGIN
    NUM product, x[3], y[3];
    if (L->kind == CYLINT_KIND_RCONE) {
        EACH(k, 3) {
            x[k] = FORM(component_of_V)(L, i, k);
            y[k] = i == j ? x[k] : FORM(component_of_V)(L, j, k);
        }
        product = FORM(dot)(L, x, y);
    } else {
        x[0] = i ? MUL(L->dr, L->beta) : FORM(form_rho0)(L);
        product = MUL(x[0], i == j ? x[0] : MUL(L->dr, L->beta));
    }
    RETURN(product)
}

/* Component j of P, where the line crosses the plane of end i, times beta. */
INLINE NUM FORM(crossing)(const FORM(terms) *L, int i, int j)
{
    BEGIN
    NUM P = FORM(minor)(L, L->w, L->M[i], (j + 1) % 3, (j + 2) % 3);
    if (L->kind == CYLINT_KIND_RCONE)
        P = SUB(P, MUL(MUL(L->r[i], L->dr), L->u[j]));
    RETURN(P)
}

INLINE NUM FORM(form_E)(const FORM(terms) *L, int i)
{
    BEGIN
    NUM x = MUL(L->r[i], L->beta), E;
    if (FORM(elliptic)(L)) {
        NUM am = FORM(dot)(L, L->a, L->M[i]);
        NUM bm = FORM(dot)(L, L->b, L->M[i]);
        E = SUB(MUL(x, x), ADD(MUL(am, am), MUL(bm, bm)));
    } else {
        NUM P[3], x2 = MUL(x, x);
        EACH(j, 3)
            P[j] = FORM(crossing)(L, i, j);
        if (L->kind == CYLINT_KIND_ACONE)
            x2 = MUL(x2, L->vv);
        E = SUB(x2, FORM(dot)(L, P, P));
    }
    RETURN(E)
}

INLINE NUM FORM(form_N)(const FORM(terms) *L, int i)
{
    BEGIN
    NUM N;
    if (FORM(elliptic)(L)) {
        NUM am = FORM(dot)(L, L->a, L->M[i]);
        NUM bm = FORM(dot)(L, L->b, L->M[i]);
        N = SUB(MUL(am, L->V), MUL(bm, L->U));
    } else {
        N = FORM(dot)(L, L->M[i], L->n); /* (w x M_i).u */
        if (L->kind == CYLINT_KIND_CONE)
            N = MUL(L->vv, N);
    }
    if (cylint_is_tapered(L->kind))
        N = SUB(N, MUL(MUL(L->r[i], L->dr), L->kind == CYLINT_KIND_RCONE
                                                ? FORM(dot)(L, L->u, L->u)
                                                : MUL(L->beta, L->beta)));
    RETURN(N)
}

/* The ball about end i: below 0 if the line passes at a distance of more than its
 * radius. */
INLINE NUM FORM(form_end_ball)(const FORM(terms) *L, int i)
{
    BEGIN
    NUM r2 = MUL(L->r[i], L->r[i]);
    NUM x =
        SUB(MUL(r2, FORM(dot)(L, L->u, L->u)), FORM(dot)(L, L->M[i], L->M[i]));
    RETURN(x)
}

INLINE NUM FORM(form_G)(const FORM(terms) *L)
{
    if (L->kind == CYLINT_KIND_SPHERE)
        return FORM(form_end_ball)(L, 0);
    BEGIN
    NUM h = FORM(dot)(L, L->w, L->M[0]), h2 = MUL(h, h), G;
    switch (L->kind) {
    case CYLINT_KIND_CYLINDER:
    case CYLINT_KIND_CAPSULE:
        G = SUB(MUL(MUL(L->r[0], L->r[0]), FORM(dot)(L, L->n, L->n)), h2);
        break;
    case CYLINT_KIND_CONE:
        G = SUB(MUL(L->vv, FORM(square_of_Y)(L)),
                MUL(ADD(L->vv, MUL(L->dr, L->dr)), h2));
        break;
    case CYLINT_KIND_ACONE: {
        NUM k2 = MUL(L->dr, L->dr);
        G = SUB(MUL(MUL(k2, L->vv), FORM(dot)(L, L->M[0], L->M[0])),
                MUL(ADD(L->one, k2), h2));
        break;
    }
    case CYLINT_KIND_RCONE:
        G = SUB(FORM(square_of_Y)(L), h2);
        break;
    case CYLINT_KIND_ECYLINDER:
        G = SUB(ADD(MUL(L->U, L->U), MUL(L->V, L->V)), h2);
        break;
    default: {
        NUM x = ADD(L->U, MUL(L->dr, FORM(dot)(L, L->b, L->M[0])));
        NUM y = SUB(L->V, MUL(L->dr, FORM(dot)(L, L->a, L->M[0])));
        G = SUB(ADD(MUL(x, x), MUL(y, y)), h2);
    }
    }
    RETURN(G)
}

/* The square root of S, the factor between G and the discriminant, where S is a
 * square (cone vv, elliptic det); S itself for other kinds. */
INLINE NUM FORM(form_root_of_S)(const FORM(terms) *L)
{
    switch (L->kind) {
    case CYLINT_KIND_SPHERE:
        return L->one;
    case CYLINT_KIND_RCONE: {
        BEGIN
        NUM S = SUB(L->vv, MUL(L->dr, L->dr));
        RETURN(S)
    }
    default:
        return FORM(elliptic)(L) ? L->det : L->vv;
    }
}

INLINE NUM FORM(form_A)(const FORM(terms) *L)
{
    BEGIN
    NUM A;
    if (FORM(elliptic)(L)) {
        A = ADD(MUL(L->U, L->U), MUL(L->V, L->V));
    } else {
        A = FORM(dot)(L, L->n, L->n);
        if (L->kind == CYLINT_KIND_CONE)
            A = MUL(L->vv, A);
    }
    if (cylint_is_tapered(L->kind))
        A = SUB(A, FORM(rho_product)(L, 1, 1));
    RETURN(A)
}

/* X0 of the line's origin: three numbers, or two for elliptic kinds. */
INLINE void FORM(radial)(const FORM(terms) *L, NUM X[3])
{
    if (FORM(elliptic)(L)) {
        X[0] = FORM(dot)(L, L->D[0], L->p);
        X[1] = X[2] = FORM(dot)(L, L->D[0], L->q);
    } else if (L->kind == CYLINT_KIND_SPHERE) {
        EACH(i, 3)
            X[i] = L->D[0][i];
    } else {
        FORM(cross)(L, L->D[0], L->w, X);
    }
}

INLINE NUM FORM(form_B)(const FORM(terms) *L)
{
    BEGIN
    NUM X[3], B;
    FORM(radial)(L, X);
    if (FORM(elliptic)(L)) {
        B = ADD(MUL(X[0], L->U), MUL(X[1], L->V));
    } else {
        B = FORM(dot)(L, X, L->n);
        if (L->kind == CYLINT_KIND_CONE)
            B = MUL(L->vv, B);
    }
    if (cylint_is_tapered(L->kind))
        B = SUB(B, FORM(rho_product)(L, 0, 1));
    RETURN(B)
}

/* C = Q at the line's origin: its sign shows whether that point is inside. */
INLINE NUM FORM(form_C)(const FORM(terms) *L)
{
    BEGIN
    NUM X[3], C, rho2 = FORM(rho_product)(L, 0, 0);
    FORM(radial)(L, X);
    if (FORM(elliptic)(L)) {
        C = ADD(MUL(X[0], X[0]), MUL(X[1], X[1]));
    } else {
        C = FORM(dot)(L, X, X);
        if (L->kind == CYLINT_KIND_CONE)
            C = MUL(L->vv, C);
        if (L->kind == CYLINT_KIND_CYLINDER || L->kind == CYLINT_KIND_CAPSULE)
            rho2 = MUL(rho2, L->vv);
    }
    C = SUB(C, rho2);
    RETURN(C)
}

/* rho at the vertex of Q times A/s: on which nappe a chord lies. */
INLINE NUM FORM(form_T)(const FORM(terms) *L)
{
    BEGIN
    NUM T;
    if (FORM(elliptic)(L)) {
        NUM x = ADD(L->U, MUL(L->dr, FORM(dot)(L, L->b, L->M[0])));
        NUM y = SUB(L->V, MUL(L->dr, FORM(dot)(L, L->a, L->M[0])));
        T = ADD(MUL(L->U, x), MUL(L->V, y));
    } else {
        T = SUB(MUL(L->r[0], FORM(dot)(L, L->n, L->n)),
                MUL(L->dr, FORM(dot)(L, L->M[0], L->n)));
    }
    RETURN(T)
}

/* A form by its name; end: 0 or 1, for the forms of one end. */
INLINE NUM FORM(form)(const FORM(terms) *L, cylint_form f, int end)
{
    switch (f) {
    case FORM_ALPHA:
        return FORM(form_alpha)(L, end);
    case FORM_ROOT_OF_S:
        return FORM(form_root_of_S)(L);
    case FORM_C:
        return FORM(form_C)(L);
    case FORM_RHO0:
        return FORM(form_rho0)(L);
    case FORM_BETA:
        return L->beta;
    case FORM_RHO1:
        return MUL(L->dr, L->beta);
    case FORM_ALONG:
        return FORM(dot)(L, L->u, L->w);
    case FORM_E:
        return FORM(form_E)(L, end);
    case FORM_N:
        return FORM(form_N)(L, end);
    case FORM_G:
        return FORM(form_G)(L);
    case FORM_A:
        return FORM(form_A)(L);
    case FORM_B:
        return FORM(form_B)(L);
    case FORM_T:
        return FORM(form_T)(L);
    default:
        return FORM(form_end_ball)(L, end);
    }
}

#ifdef FORMS_OF_HITS
/* A component of the gradient of Q at the origin, halved: X = radial(),
 * slope = rho dr of tapered kinds that are not round. */
INLINE NUM FORM(gradient_component)(const FORM(terms) *L, const NUM X[3],
                                    NUM slope, int i)
{
    BEGIN
    NUM N;
    if (FORM(elliptic)(L)) {
        /* mutant '1' -> '2': X[2] is X[1] */
        N = ADD(MUL(X[0], L->p[i]), MUL(X[1], L->q[i]));
    } else {
        N = FORM(minor)(L, L->w, X, (i + 1) % 3, (i + 2) % 3);
        if (L->kind == CYLINT_KIND_CONE)
            N = MUL(L->vv, N);
    }
    if (cylint_is_tapered(L->kind))
        N = SUB(N, L->kind == CYLINT_KIND_RCONE
                       ? MUL(L->dr, FORM(component_of_V)(L, 0, i))
                       : MUL(slope, FORM(axial)(L)[i]));
    RETURN(N)
}

/* Half the gradient of Q at the origin, the outward normal of the surface through
 * it: of a ball D_0; s w x (P x w) - rho dr w; for elliptic kinds X_p p + X_q q -
 * rho kappa e; of other round kinds w x (D_0 x w) - dr V. */
INLINE void FORM(gradient)(const FORM(terms) *L, NUM N[3])
{
    NUM X[3], slope = L->one;
    FORM(radial)(L, X);
    if (cylint_is_tapered(L->kind) && !cylint_is_round(L->kind))
        slope = MUL(FORM(form_rho0)(L), L->dr);
    EACH(i, 3)
        N[i] = L->kind == CYLINT_KIND_SPHERE
                   ? L->D[0][i]
                   : FORM(gradient_component)(L, X, slope, i);
}

/* Where the origin lies about the axis: cosine and sine of phi times one
 * positive number; for circular kinds x still needs a factor |w|.  phi
 * counts from e x w, e the coordinate direction of the given number; for
 * elliptic kinds from a towards b. */
INLINE void FORM(about_axis)(const FORM(terms) *L, int number, NUM *x, NUM *y)
{
    if (FORM(elliptic)(L)) {
        *x = FORM(dot)(L, L->D[0], L->p);
        *y = FORM(dot)(L, L->D[0], L->q);
        return;
    }
    const int j = (number + 1) % 3, k = (number + 2) % 3;
    NUM from[3], to[3];
    from[number] = SUB(L->w[0], L->w[0]);
    from[j] = SUB(from[number], L->w[k]);
    from[k] = L->w[j];
    FORM(cross)(L, L->w, from, to);
    *x = FORM(dot)(L, L->D[0], from);
    *y = FORM(dot)(L, L->D[0], to);
}
#endif
#endif

#undef NUM
#undef FORM
#undef ADD
#undef SUB
#undef MUL
#undef DATUM
#undef DIFFERENCE
#undef DIRECTION
#undef MEMORY
#undef BEGIN
#undef RETURN
#undef FORMS_DECLARED
#undef FORMS_DEFINED
#undef FORMS_OF_HITS
