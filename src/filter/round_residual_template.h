/*
 * round_residual_template.h - the residual at a point of the line: of a ball,
 * and of the cone that touches both balls
 *
 * Stated once for lanes and for bounds on errors (tests/test_local_residuals.c).
 * The including file names by macros, which end with this file:
 *
 *   V, PAIR                two numbers; a struct of hi and lo
 *   FORM(name)             the functions
 *   ADD SUB (x, y)         lane by lane
 *   SUM_OF(x, y, z)        x y + z
 *   NEGATED(x)
 *   TWO_SUM TWO_PROD(x, y) a pair, without error
 *
 * The point is q = o - center + t d, where the centre is that of a ball of
 * radius r on the axis.  With z along the axis,
 *
 *   ball   |q|^2 - r^2
 *   cone   c^2 (|q|^2 - r^2) - (z + s r)^2,  s and c: sine and cosine of
 * shapes/local.h.
 *
 * Near a root the high parts cancel.  So the sum of x and y errs by at most
 * 2^-53 of the result and the rest, and the last sum by 2^-53 of the result:
 * newton_template.h counts both with the roundings of the quotient.
 */

/* One coordinate of q.  from: of o - center, exactly. */
INLINE PAIR FORM(moved)(PAIR from, V t, V d, V d_lo)
{
    const PAIR step = TWO_PROD(t, d);
    const PAIR sum = TWO_SUM(from.hi, step.hi);
    return (PAIR){sum.hi, ADD(sum.lo, ADD(from.lo, SUM_OF(t, d_lo, step.lo)))};
}

/* The low part of the square of q, of which high is that of the high part. */
INLINE V FORM(low_of_square)(PAIR q, PAIR high)
{
    return SUM_OF(ADD(ADD(q.hi, q.hi), q.lo), q.lo, high.lo);
}

/* |q|^2 - r^2. */
INLINE PAIR FORM(surplus)(const PAIR q[3], V r)
{
    const PAIR r2 = TWO_PROD(NEGATED(r), r);
    const PAIR x = TWO_PROD(q[0].hi, q[0].hi), y = TWO_PROD(q[1].hi, q[1].hi);
    const PAIR z = TWO_PROD(q[2].hi, q[2].hi);
    const PAIR a = TWO_SUM(r2.hi, x.hi), b = TWO_SUM(a.hi, y.hi);
    const PAIR c = TWO_SUM(b.hi, z.hi);
    const V squares =
        ADD(ADD(FORM(low_of_square)(q[0], x), FORM(low_of_square)(q[1], y)),
            ADD(FORM(low_of_square)(q[2], z), r2.lo));
    return (PAIR){c.hi, ADD(ADD(ADD(a.lo, b.lo), c.lo), squares)};
}

/* z + s r, shift = s r. */
INLINE PAIR FORM(height)(const PAIR q[3], const PAIR axis[3], PAIR shift)
{
    V head = shift.hi, rest = shift.lo;
    EACH(j, 3) {
        const PAIR product = TWO_PROD(q[j].hi, axis[j].hi);
        const PAIR sum = TWO_SUM(product.hi, head);
        const V low = SUM_OF(q[j].lo, axis[j].hi, product.lo);
        head = sum.hi;
        rest = ADD(ADD(rest, sum.lo), SUM_OF(q[j].hi, axis[j].lo, low));
    }
    return (PAIR){head, rest};
}

/* s r. */
INLINE PAIR FORM(shift)(PAIR sine, V r)
{
    const PAIR product = TWO_PROD(sine.hi, r);
    return (PAIR){product.hi, SUM_OF(sine.lo, r, product.lo)};
}

/* The residual of the ball.  The last sum needs no low part. */
INLINE V FORM(ball_residual)(const PAIR q[3], V r)
{
    const PAIR r2 = TWO_PROD(NEGATED(r), r);
    const PAIR x = TWO_PROD(q[0].hi, q[0].hi), y = TWO_PROD(q[1].hi, q[1].hi);
    const PAIR z = TWO_PROD(q[2].hi, q[2].hi);
    const PAIR a = TWO_SUM(r2.hi, x.hi), b = TWO_SUM(a.hi, y.hi);
    const V squares =
        ADD(ADD(FORM(low_of_square)(q[0], x), FORM(low_of_square)(q[1], y)),
            ADD(FORM(low_of_square)(q[2], z), r2.lo));
    return RESULT(b.hi, z.hi, ADD(ADD(a.lo, b.lo), squares));
}

/* The residual of the cone, from the surplus; square: c^2. */
INLINE V FORM(cone_residual)(PAIR surplus, PAIR square, PAIR height)
{
    const PAIR product = TWO_PROD(surplus.hi, square.hi);
    const PAIR high = TWO_PROD(height.hi, height.hi);
    const V low = SUM_OF(surplus.lo, square.hi,
                         SUM_OF(surplus.hi, square.lo, product.lo));
    return RESULT(product.hi, NEGATED(high.hi),
                  SUB(low, FORM(low_of_square)(height, high)));
}

/* The same of a capsule: c = 1. */
INLINE V FORM(cylinder_residual)(PAIR surplus, PAIR height)
{
    const PAIR high = TWO_PROD(height.hi, height.hi);
    return RESULT(surplus.hi, NEGATED(high.hi),
                  SUB(surplus.lo, FORM(low_of_square)(height, high)));
}

#undef V
#undef PAIR
#undef FORM
#undef ADD
#undef SUB
#undef SUM_OF
#undef NEGATED
#undef RESULT
#undef TWO_SUM
#undef TWO_PROD
