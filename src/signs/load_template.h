/*
 * load_template.h - a line and a shape as the terms of forms_template.h
 *
 * Stated once for all arithmetics.  The including file names by macros, which
 * end with this file:
 *
 *   FORM(name), LOAD_INLINE   the function, and how it is declared
 *   DIRECTION(l, i)           component i of the line's direction
 *   AXIS(s, i)                ... of the axis
 *   BEFORE_TOP(D, w)          D - w
 *   RADIUS_GROWTH(s)
 *   DATUM(x)                  the data are a cylint_shape and a cylint_line: x,
 *   DIFFERENCE(x, y)          and x - y, in this arithmetic
 *
 * or, if the data are not such, instead of the last two
 *
 *   SHAPE, LINE               the types that hold the data
 *   FROM_BASE(l, s, i), FROM_TOP(l, s, i)
 *                             component i of the line's origin from the centre of
 *                             an end
 *   SEMI_AXIS_A(s, i), SEMI_AXIS_B(s, i), RADIUS(s, end)
 *   ONE                       1
 */
#ifdef DATUM
#define SHAPE cylint_shape
#define LINE cylint_line
#define FROM_BASE(l, s, i) DIFFERENCE(l->o[i], cylint_base(s)[i])
#define FROM_TOP(l, s, i) DIFFERENCE(l->o[i], cylint_top(s)[i])
#define SEMI_AXIS_A(s, i) DATUM(cylint_a(s)[i])
#define SEMI_AXIS_B(s, i) \
    DATUM(cylint_left_handed(s) ? -cylint_b(s)[i] : cylint_b(s)[i])
#define RADIUS(s, end) DATUM(cylint_end_factor(s, end))
#define ONE DATUM(1)
#endif

LOAD_INLINE void FORM(fill)(FORM(terms) *L, const SHAPE *s, const LINE *l,
                            int kind)
{
    L->kind = kind;
    EACH(i, 3) {
        L->u[i] = DIRECTION(l, i);
        L->w[i] = AXIS(s, i);
        L->D[0][i] = FROM_BASE(l, s, i);
        L->D[1][i] = cylint_has_end_points(kind)
                         ? FROM_TOP(l, s, i)
                         : BEFORE_TOP(L->D[0][i], L->w[i]);
        if (cylint_is_elliptic(kind)) {
            L->a[i] = SEMI_AXIS_A(s, i);
            L->b[i] = SEMI_AXIS_B(s, i);
        }
    }
    L->r[0] = RADIUS(s, 0);
    L->r[1] = RADIUS(s, 1);
    L->dr = RADIUS_GROWTH(s);
    L->one = ONE;
}

#undef FORM
#undef LOAD_INLINE
#undef SHAPE
#undef LINE
#undef DATUM
#undef DIFFERENCE
#undef DIRECTION
#undef AXIS
#undef FROM_BASE
#undef FROM_TOP
#undef BEFORE_TOP
#undef SEMI_AXIS_A
#undef SEMI_AXIS_B
#undef RADIUS
#undef RADIUS_GROWTH
#undef ONE
