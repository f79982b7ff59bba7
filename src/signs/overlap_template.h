/*
 * overlap_template.h - whether a line crosses a bounded shape, and which of
 * planes and lateral roots bound the overlap
 *
 * Stated once for exact signs and for lanes.  The including file names by
 * macros, which end with this file:
 *
 *   FORM(name), OVERLAP_INLINE   the functions, and how they are declared
 *   TRUTH                        a truth value, for lanes a mask
 *   AND(a, b), OR(a, b)          may skip b, as && and || do
 *
 * and those of the sections that it needs.
 *
 * A bounded shape is convex, so the overlap is one interval.  It is the
 * intersection of two: Q < 0 (forms_template.h) and 0 < z < 1.  It begins
 * (end = 0) at the plane that the line comes to first or at the root where Q
 * falls, whichever is later.  It ends (end = 1) at the plane that the line
 * comes to last or at the root where Q rises, whichever is earlier.
 */

/*
 * The part: PART is its type, with the values CAP0, CAP1 and LATERAL.
 * CHOOSE(a, x, y) is x if a, else y.
 */
#ifdef PART
/* up: z grows along the line.  by_plane: a plane bounds the overlap. */
OVERLAP_INLINE PART FORM(part_at)(TRUTH up, TRUTH by_plane, int end)
{
    const PART cap[2] = {CAP0, CAP1};
    return CHOOSE(by_plane, CHOOSE(up, cap[end], cap[!end]), LATERAL);
}
#endif

/*
 * By values: VALUE is the type of a t with a bound on its error; LATER(s, t):
 * whether s is certainly the greater.
 */
#ifdef VALUE
typedef struct {
    TRUTH by_plane[2], by_root[2]; /* neither is true: uncertain */
} FORM(bounds);

OVERLAP_INLINE FORM(bounds)
    FORM(bounds_of)(const VALUE root[2], const VALUE plane[2])
{
    return (FORM(bounds)){{LATER(plane[0], root[0]), LATER(root[1], plane[1])},
                          {LATER(root[0], plane[0]), LATER(plane[1], root[1])}};
}
#endif

/*
 * By signs, without any root: CAPS is the type that holds E(c, i),
 * INWARD(c, i) and G(c).  POSITIVE(x), NEGATIVE(x) and NOT_POSITIVE(x):
 * whether x certainly is so.
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
#ifdef CAPS
OVERLAP_INLINE TRUTH FORM(crosses)(CAPS *c)
{
    return OR(OR(POSITIVE(E(c, 0)), POSITIVE(E(c, 1))),
              AND(AND(POSITIVE(INWARD(c, 0)), POSITIVE(INWARD(c, 1))),
                  POSITIVE(G(c))));
}

OVERLAP_INLINE TRUTH FORM(misses)(CAPS *c)
{
    return OR(AND(AND(NEGATIVE(E(c, 0)), NEGATIVE(E(c, 1))),
                  OR(NOT_POSITIVE(INWARD(c, 0)), NOT_POSITIVE(INWARD(c, 1)))),
              NEGATIVE(G(c)));
}
#endif

#undef FORM
#undef OVERLAP_INLINE
#undef TRUTH
#undef AND
#undef OR
#undef PART
#undef CHOOSE
#undef CAP0
#undef CAP1
#undef LATERAL
#undef VALUE
#undef LATER
#undef CAPS
#undef E
#undef INWARD
#undef G
#undef POSITIVE
#undef NEGATIVE
#undef NOT_POSITIVE
