/*
 * overlap_template.h - whether a line crosses a bounded shape
 *
 * Stated once for exact signs and for lanes.  The including file names by
 * macros, which end with this file:
 *
 *   FORM(name), OVERLAP_INLINE   the functions, and how they are declared
 *   TRUTH                        a truth value, for lanes a mask
 *   AND(a, b), OR(a, b)          may skip b, as && and || do
 *   CAPS                         the type that has the forms E and INWARD of
 *                                both caps, and G(c)
 *   POSITIVE(x), NEGATIVE(x), NOT_POSITIVE(x)
 *                                whether x certainly is so
 *   EITHER_END(SIGN, FORM, c), BOTH_ENDS(SIGN, FORM, c)
 *                                whether SIGN holds for the form of one cap, or
 *                                of both
 *
 * A bounded shape is convex, so the overlap is one interval.  It is the
 * intersection of two: Q < 0 (forms_template.h) and 0 < z < 1.  It begins
 * (end = 0) at the plane that the line comes to first or at the root where Q
 * falls, whichever is later.  It ends (end = 1) at the plane that the line
 * comes to last or at the root where Q rises, whichever is earlier.
 *
 * Whether the line crosses is decided by signs, without any root:
 *
 *   E_i > 0        the line crosses the plane of cap i within the disc, so the
 *                  plane bounds the overlap;
 *   E_i < 0        outside of the disc, or it is parallel to the plane: a root
 *                  bounds the overlap, if there is one;
 *   inward_i > 0   Q falls from plane i towards the shape.  The inward values
 *                  are -N_0 and N_1, the derivatives of Q up to a positive
 *                  factor.  If the line is parallel to the caps, they have the
 *                  sign of its distance from the plane, inward.
 *
 * If both inward values are positive, the minimum of Q is between the planes,
 * and G > 0 makes it negative.  If both E are negative and one inward value is
 * not positive, then Q > 0 between the planes.
 */
OVERLAP_INLINE TRUTH FORM(crosses)(CAPS *c)
{
    return OR(EITHER_END(POSITIVE, E, c),
              AND(BOTH_ENDS(POSITIVE, INWARD, c), POSITIVE(G(c))));
}

OVERLAP_INLINE TRUTH FORM(misses)(CAPS *c)
{
    /* untaken 2 of 10: no E is 0 here in any known case */
    return OR(
        AND(BOTH_ENDS(NEGATIVE, E, c), EITHER_END(NOT_POSITIVE, INWARD, c)),
        NEGATIVE(G(c)));
}

#undef FORM
#undef OVERLAP_INLINE
#undef TRUTH
#undef AND
#undef OR
#undef CAPS
#undef E
#undef INWARD
#undef G
#undef POSITIVE
#undef NEGATIVE
#undef NOT_POSITIVE
#undef EITHER_END
#undef BOTH_ENDS
