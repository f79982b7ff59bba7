/*
 * root_quotient_template.h - a root as a quotient without cancellation, once
 * for doubles and once for pairs (root.c names the arithmetic by macros, which
 * end with this file)
 *
 * Errors are relative and to first order: the callers' slack of a few per
 * cent covers the products of errors, each of which is below 2^-10.
 */

typedef struct {
    VALUE num, den;
    double error;                     /* of num / den; above 1: unknown */
    double radical, radical_error, A; /* of side roots; A: at most |A| */
} FORM(quotient);

static double FORM(relative)(NUM x)
{
    return ERROR(x) / fabs(HIGH(OF(x)));
}

/* R = sqrt(S G), unknown unless G is certainly positive. */
static VALUE FORM(radical)(const FORM(terms) *L, double *error)
{
    const NUM G = FORM(form_G)(L), S = FORM(form_root_of_S)(L);
    const double eG = FORM(relative)(G);
    *error = 2;
    /* mutant '&&' -> '||': roots are computed where G > 0, and pairs that
     * compute G <= 0 decide nothing */
    /* mutant '>' -> '<': slower, the next stage decides */
    if (!(HIGH(OF(G)) > 0 && eG < CYLINT_FIRST_ORDER))
        return OF(G);
    /* without a square, S G may have underflowed */
    const VALUE R = CYLINT_RADICAL(L->kind, OF(S), OF(G), V_MUL, V_SQRT);
    if (cylint_S_is_square(L->kind) || HIGH(R) > CYLINT_RADICAL_LEAST)
        *error = eG + FORM(relative)(S) + ROUNDING;
    return R;
}

/* |B| + R, which one of the two forms of a root divides by, with its error;
 * num is for the caller to find.  *near: it is C that belongs there, for of
 * the two roots this one is nearer to the line's origin. */
static FORM(quotient)
    FORM(half_quotient)(const FORM(terms) *L, int exits, int *near)
{
    FORM(quotient) f;
    const NUM B = FORM(form_B)(L);
    const VALUE R = FORM(radical)(L, &f.radical_error);
    /* mutant '<' -> '<=': for B = 0 either sign is right */
    const int falls = HIGH(OF(B)) < 0;
    f.num = f.den = V_ADD(R, falls ? V_NEG(OF(B)) : OF(B));
    f.radical = HIGH(R);
    f.A = 0;
    f.error =
        f.radical_error > 1
            ? 2
            /* mutant '*' -> '+': slower, a larger bound */
            : (ERROR(B) + f.radical_error * f.radical) / HIGH(f.den) + ROUNDING;
    *near = falls != exits;
    return f;
}

static FORM(quotient) FORM(side_quotient)(const FORM(terms) *L, int exits)
{
    int near;
    FORM(quotient) f = FORM(half_quotient)(L, exits, &near);
    const NUM A = FORM(form_A)(L);
    f.A = fabs(HIGH(OF(A))) + ERROR(A);
    if (f.radical_error > 1)
        return f;
    const VALUE sum = f.den;
    if (near) {
        const NUM C = FORM(form_C)(L);
        f.num = exits ? V_NEG(OF(C)) : OF(C);
        f.error += FORM(relative)(C);
    } else {
        f.num = exits ? sum : V_NEG(sum);
        f.den = OF(A);
        f.error += FORM(relative)(A);
    }
    return f;
}

static FORM(quotient) FORM(quotient_of)(const FORM(terms) *L, cylint_root root)
{
    if (root == ROOT_ENTRY || root == ROOT_EXIT)
        return FORM(side_quotient)(L, root == ROOT_EXIT);
    const int middle = root == ROOT_DOUBLE;
    const NUM num =
        middle ? FORM(form_B)(L) : FORM(form_alpha)(L, root == ROOT_CAP1);
    const NUM den = middle ? FORM(form_A)(L) : L->beta;
    return (FORM(quotient)){V_NEG(OF(num)),
                            OF(den),
                            FORM(relative)(num) + FORM(relative)(den) +
                                ROUNDING,
                            0,
                            2,
                            0};
}

#undef NUM
#undef VALUE
#undef HIGH
#undef OF
#undef FORM
#undef V_ADD
#undef V_MUL
#undef V_NEG
#undef V_SQRT
#undef ERROR
#undef ROUNDING
