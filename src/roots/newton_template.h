/*
 * newton_template.h - one step of Newton's, and a bound on its error
 *
 * Stated once for doubles (root.c) and for lanes (filter/surfaces.h).  The
 * including file names by macros, which end with this file:
 *
 *   FORM(name), NEWTON_INLINE    the functions, and how they are declared
 *   NUM, ABS(x), CONSTANT(x)     a number, its size, a double as a number
 *   SUM_OF(x, y, z)              x y + z
 *   QUOTIENT(x, y, inverse)      x / y; x times the inverse of y where that is
 *                                faster
 *   SLACK                        covers the terms of second order
 *
 * Let f be a polynomial of degree 1 or 2 with the root t and f'(t) = s.  Then
 *
 *   f(t0) = s (t0 - t) + c (t0 - t)^2,   c = f'' / 2,
 *   t     = t0 - delta + c (t0 - t)^2 / s,   delta = f(t0) / s.
 *
 * With the slope at t0 in place of s only the sign of the last term changes.
 * For the lateral quadric Q(t) = A t^2 + 2 B t + C these are s = 2 (A t + B)
 * and c = A; for a plane c = 0.  tests/bounds/prove/newton.g proves that SLACK
 * suffices.
 */

typedef struct {
    NUM delta, error; /* |t - (t0 - delta)| is at most the error */
} FORM(newton);

/* residual: f(t0), and slope, each with a bound on its error; curvature: at
 * least |c|; distance: at least |t0 - t|. */
NEWTON_INLINE FORM(newton)
    FORM(newton_step)(NUM residual, NUM residual_error, NUM slope,
                      NUM slope_error, NUM curvature, NUM distance)
{
    const NUM inverse = CONSTANT(1) / slope;
    /* mutant '*' -> '+': wider; slower */
    const NUM scaled = CONSTANT(SLACK) * ABS(inverse);
    const NUM relative =
        SUM_OF(scaled, slope_error, CONSTANT(SLACK * CYLINT_QUOTIENT_ROUNDING));
    const NUM delta = QUOTIENT(residual, slope, inverse);
    /* mutant '*' -> '+': wider, as these bounds are below 1; slower */
    const NUM first = SUM_OF(ABS(delta), relative, scaled * residual_error);
    /* mutant '*' -> '+': the same */
    const NUM error = SUM_OF(scaled * curvature * distance, distance, first);
    return (FORM(newton)){delta, error};
}

#undef FORM
#undef NEWTON_INLINE
#undef NUM
#undef ABS
#undef CONSTANT
#undef SUM_OF
#undef QUOTIENT
#undef SLACK
