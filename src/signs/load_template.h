/*
 * load_template.h - a line and a shape as the terms of forms_template.h
 *
 * Stated once for all arithmetics.  The including file names by macros, which
 * end with this file:
 *
 *   FORM(name), LOAD_INLINE   the functions, and how they are declared
 *   SHAPE, LINE               the types that hold the data
 *   DIRECTION(l, i)           component i of the line's direction
 *   AXIS(s, i)                ... of the axis
 *   FROM_BASE(l, s, i), FROM_TOP(l, s, i)
 *                             ... of the line's origin from the centre of an end
 *   BEFORE_TOP(D, w)          D - w
 *   SEMI_AXIS_A(s, i), SEMI_AXIS_B(s, i), RADIUS(s, end), RADIUS_GROWTH(s)
 *   ONE                       1
 */

/* What depends on the shape alone. */
LOAD_INLINE void FORM(load_shape)(FORM(terms) *L, const SHAPE *s, int kind)
{
    L->kind = kind;
    EACH(i, 3) {
        L->w[i] = AXIS(s, i);
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

LOAD_INLINE void FORM(load_line)(FORM(terms) *L, const SHAPE *s, const LINE *l)
{
    (void)s;
    EACH(i, 3) {
        L->u[i] = DIRECTION(l, i);
        L->D[0][i] = FROM_BASE(l, s, i);
    }
}

/* After the others. */
LOAD_INLINE void FORM(load_top)(FORM(terms) *L, const SHAPE *s, const LINE *l)
{
    (void)s;
    EACH(i, 3)
        L->D[1][i] = cylint_has_end_points(L->kind)
                         ? FROM_TOP(l, s, i)
                         : BEFORE_TOP(L->D[0][i], L->w[i]);
}

#undef FORM
#undef LOAD_INLINE
#undef SHAPE
#undef LINE
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
