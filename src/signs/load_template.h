/*
 * load_template.h - a line and a shape as the terms of forms_template.h
 *
 * Stated once for all arithmetics.  The including file names by macros, which
 * end with this file:
 *
 *   FORM(name)                the function, which is static
 *   DATUM(x)                  a datum in this arithmetic
 *   DIFFERENCE(x, y)          x - y of two data
 *   DIRECTION(l, i)           component i of the line's direction
 *   BEFORE_TOP(D, w)          D - w
 *
 * Without DATUM and those after it, the arithmetic is that of bounded pairs.
 */
#ifndef DATUM
#define DATUM(x) bounded_pair_of(x, 0)
#define DIFFERENCE(x, y) bounded_pair_difference(x, y)
#define DIRECTION(l, i) bounded_pair_of(l->d[i], l->d_lo[i])
#define BEFORE_TOP(D, w) bounded_pair_sub(D, w)
#endif

static void FORM(fill)(FORM(terms) *L, const cylint_shape *s,
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
            L->D[1][i] = BEFORE_TOP(L->D[0][i], L->w[i]);
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

#undef FORM
#undef DATUM
#undef DIFFERENCE
#undef DIRECTION
#undef BEFORE_TOP
