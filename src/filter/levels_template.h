/*
 * levels_template.h - sums in levels
 *
 * a + b + c, where a sums numbers of the size of the data without error, b the
 * errors of a, without error, and c the errors of b.  Stated once for doubles
 * and for vectors.  The including file names by macros, which end with this
 * file:
 *
 *   REAL, PAIR, LEVELS        a number; a sum and its error; the struct
 *   FORM(name)                the functions
 *   ADD MUL (x, y)
 *   SUM_OF(x, y, z)           x y + z
 *   TWO_SUM(x, y)             x + y and its error
 *   PRODUCT_ERROR(x, y)       of x y
 */

typedef struct {
    REAL a, b, c;
} LEVELS;

INLINE void FORM(add_b)(LEVELS *sum, REAL x)
{
    const PAIR s = TWO_SUM(sum->b, x);
    sum->b = s.hi;
    sum->c = ADD(sum->c, s.lo);
}

INLINE void FORM(add_a)(LEVELS *sum, REAL x)
{
    const PAIR s = TWO_SUM(sum->a, x);
    sum->a = s.hi;
    FORM(add_b)(sum, s.lo);
}

/* Adds x y to a, or a product of the size of b to b. */
LEVELS_INLINE void FORM(add_product_to_a)(LEVELS *sum, REAL x, REAL y)
{
    const REAL p = MUL(x, y);
    FORM(add_a)(sum, p);
    FORM(add_b)(sum, PRODUCT_ERROR(x, y));
}

LEVELS_INLINE void FORM(add_product_to_b)(LEVELS *sum, REAL x, REAL y)
{
    const REAL p = MUL(x, y);
    FORM(add_b)(sum, p);
    sum->c = ADD(sum->c, PRODUCT_ERROR(x, y));
}

LEVELS_INLINE LEVELS FORM(square)(const LEVELS *x)
{
    const REAL twice_a = ADD(x->a, x->a);
    LEVELS xx = {MUL(x->a, x->a), PRODUCT_ERROR(x->a, x->a),
                 SUM_OF(twice_a, x->c, MUL(x->b, x->b))};
    FORM(add_product_to_b)(&xx, twice_a, x->b);
    return xx;
}

LEVELS_INLINE LEVELS FORM(levels_product)(const LEVELS *x, const LEVELS *y)
{
    LEVELS xy = {MUL(x->a, y->a), PRODUCT_ERROR(x->a, y->a),
                 SUM_OF(x->c, y->a, SUM_OF(x->a, y->c, MUL(x->b, y->b)))};
    FORM(add_product_to_b)(&xy, x->a, y->b);
    FORM(add_product_to_b)(&xy, x->b, y->a);
    return xy;
}

#undef REAL
#undef PAIR
#undef LEVELS
#undef FORM
#undef ADD
#undef MUL
#undef SUM_OF
#undef TWO_SUM
#undef PRODUCT_ERROR
