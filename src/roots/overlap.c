/*
 * overlap.c - the overlap of a line and a shape between planes, or an unbounded
 * one
 *
 * A bounded shape is convex, so the line overlaps it in one interval:
 * [where the lateral quadric Q <= 0] and [where 0 <= z <= 1].  The signs of
 * forms_template.h at the two planes of the caps decide which of these bounds
 * the overlap (overlap_template.h); no root is computed for that.
 */
#include "overlap.h"

int cylint_radius_is_zero(const cylint_query *q, int cap)
{
    return cylint_sign(cylint_end_factor(q->shape, cap)) == 0;
}

/* Q <= 0 on one interval between its roots: a chord, a point or nothing. */
cylint_overlap cylint_chord_overlap(cylint_query *q, int relation, int apex)
{
    const int G = cylint_form_sign(q, FORM_G, 0);
    if (G < 0)
        return cylint_no_overlap();
    if (G == 0)
        return cylint_one_stop(CYLINT_RELATION_TOUCH, ROOT_DOUBLE,
                               CYLINT_SIDE_BOTH, apex);
    return cylint_two_stops(relation, cylint_lateral_stop(ROOT_ENTRY),
                            cylint_lateral_stop(ROOT_EXIT));
}

/* The line runs parallel to the caps. */
static cylint_overlap parallel_to_caps(cylint_query *q)
{
    const int above0 = cylint_form_sign(q, FORM_ALPHA, 0);
    if (above0 < 0)
        return cylint_no_overlap();
    const int above1 = cylint_form_sign(q, FORM_ALPHA, 1);
    if (above1 > 0)
        return cylint_no_overlap();
    if (above0 != 0 && above1 != 0)
        return cylint_chord_overlap(q, CYLINT_RELATION_CROSS, 0);
    return cylint_chord_overlap(q, CYLINT_RELATION_ALONG,
                                cylint_radius_is_zero(q, above1 == 0));
}

/* The exact signs that decide the overlap with a bounded shape.  E is computed
 * at once, the others when they are needed. */
typedef struct {
    cylint_query *q;
    int E[2], inward[2], G;
} cap_signs;

enum { NOT_COMPUTED = 2 };

static int inward_sign(cap_signs *c, int cap)
{
    if (c->inward[cap] == NOT_COMPUTED)
        c->inward[cap] = (cap ? 1 : -1) * cylint_form_sign(c->q, FORM_N, cap);
    return c->inward[cap];
}

static int sign_G(cap_signs *c)
{
    if (c->G == NOT_COMPUTED)
        c->G = cylint_form_sign(c->q, FORM_G, 0);
    return c->G;
}

#define FORM(name) name##_exactly
#define OVERLAP_INLINE static
#define TRUTH int
#define AND(a, b) ((a) && (b))
#define OR(a, b) ((a) || (b))
#define CAPS cap_signs
#define E(c, i) ((c)->E[i])
#define INWARD(c, i) inward_sign(c, i)
#define G(c) sign_G(c)
#define POSITIVE(x) ((x) > 0)
#define NEGATIVE(x) ((x) < 0)
#define NOT_POSITIVE(x) ((x) <= 0)
#define EITHER_END(SIGN, FORM, c) (SIGN(FORM(c, 0)) || SIGN(FORM(c, 1)))
#define BOTH_ENDS(SIGN, FORM, c) (SIGN(FORM(c, 0)) && SIGN(FORM(c, 1)))
#include "../signs/overlap_template.h"

/* The part at an end of the overlap.  up: z grows along the line.  by_plane: a
 * plane bounds the overlap. */
static int part_of_end(int up, int by_plane, int end)
{
    if (!by_plane)
        return CYLINT_PART_LATERAL;
    return up == end ? CYLINT_PART_CAP1 : CYLINT_PART_CAP0;
}

/* Where the overlap begins (end = 0) or ends.  On a rim (E = 0) the plane and
 * the lateral root have the same t; the part is lateral. */
static cylint_stop stop_at(const cap_signs *c, int up, int end)
{
    const int cap = up ? end : !end;
    if (c->E[cap] < 0)
        return cylint_lateral_stop(end ? ROOT_EXIT : ROOT_ENTRY);
    return (cylint_stop){cap ? ROOT_CAP1 : ROOT_CAP0,
                         part_of_end(up, c->E[cap] > 0, end), 0,
                         c->E[cap] == 0 && cylint_radius_is_zero(c->q, cap)};
}

/* Bounded shapes; the line is not parallel to the caps.  up: z grows along
 * it. */
static cylint_overlap slab(cylint_query *q, int up)
{
    cap_signs c = {
        q,
        {cylint_form_sign(q, FORM_E, 0), cylint_form_sign(q, FORM_E, 1)},
        {NOT_COMPUTED, NOT_COMPUTED},
        NOT_COMPUTED};
    const cylint_stop begin = stop_at(&c, up, 0), end = stop_at(&c, up, 1);
    if (crosses_exactly(&c))
        return cylint_two_stops(CYLINT_RELATION_CROSS, begin, end);
    if (c.E[0] == 0 && c.E[1] == 0) /* a ruling: Q = 0 on all of the line */
        return cylint_two_stops(CYLINT_RELATION_ALONG, begin, end);
    if (c.E[0] == 0 || c.E[1] == 0)
        return cylint_touch_at(stop_at(&c, 1, c.E[1] == 0));
    if (misses_exactly(&c))
        return cylint_no_overlap();
    return cylint_one_stop(CYLINT_RELATION_TOUCH, ROOT_DOUBLE, CYLINT_SIDE_BOTH,
                           0);
}

static cylint_overlap bounded(cylint_query *q)
{
    const int up = cylint_form_sign(q, FORM_BETA, 0);
    return up == 0 ? parallel_to_caps(q) : slab(q, up > 0);
}

/* A line that is as a whole inside, on the surface or outside.  side: -1, 0, 1. */
static cylint_overlap on_one_side(int side)
{
    cylint_overlap v = cylint_no_overlap();
    v.relation = side < 0    ? CYLINT_RELATION_CROSS
                 : side == 0 ? CYLINT_RELATION_ALONG
                             : CYLINT_RELATION_MISS;
    return v;
}

/* A line parallel to the axis of a whole cylinder, or to a ruling. */
static cylint_overlap parallel_to_ruling(cylint_query *q)
{
    return on_one_side(cylint_form_sign(q, FORM_C, 0));
}

static cylint_overlap whole_cylinder(cylint_query *q)
{
    return cylint_form_sign(q, FORM_A, 0) == 0
               ? parallel_to_ruling(q)
               : cylint_chord_overlap(q, CYLINT_RELATION_CROSS, 0);
}

static cylint_overlap double_cone(cylint_query *q)
{
    const int A = cylint_form_sign(q, FORM_A, 0);
    if (A > 0) {
        cylint_overlap v = cylint_chord_overlap(q, CYLINT_RELATION_CROSS, 0);
        if (v.n == 1)
            v.at[0].apex = cylint_form_sign(q, FORM_T, 0) == 0;
        return v;
    }
    if (cylint_form_sign(q, FORM_G, 0) == 0)
        return A < 0 ? cylint_one_stop(CYLINT_RELATION_CROSS, ROOT_DOUBLE,
                                       CYLINT_SIDE_BOTH, 1)
                     : parallel_to_ruling(q);
    if (A == 0)
        return cylint_form_sign(q, FORM_B, 0) > 0
                   ? cylint_one_stop(CYLINT_RELATION_CROSS, ROOT_EXIT,
                                     CYLINT_SIDE_LEAVING, 0)
                   : cylint_one_stop(CYLINT_RELATION_CROSS, ROOT_ENTRY,
                                     CYLINT_SIDE_ENTERING, 0);
    cylint_overlap v =
        cylint_two_stops(CYLINT_RELATION_CROSS, cylint_lateral_stop(ROOT_EXIT),
                         cylint_lateral_stop(ROOT_ENTRY));
    v.at[0].side = CYLINT_SIDE_LEAVING;
    v.at[1].side = CYLINT_SIDE_ENTERING;
    return v;
}

/* The nappe where rho >= 0. */
static cylint_overlap nappe(cylint_query *q)
{
    const int A = cylint_form_sign(q, FORM_A, 0);
    if (A > 0) {
        cylint_overlap v = cylint_chord_overlap(q, CYLINT_RELATION_CROSS, 0);
        if (v.n == 0)
            return v;
        const int T = cylint_form_sign(q, FORM_T, 0);
        v.at[0].apex = v.n == 1 && T == 0;
        return T < 0 ? cylint_no_overlap() : v;
    }
    /* A <= 0: rho changes along the line, and grows with t or shrinks */
    const int grows = cylint_form_sign(q, FORM_BETA, 0) *
                      cylint_sign(cylint_radius_growth(q->shape).hi);
    const int side = grows > 0 ? CYLINT_SIDE_ENTERING : CYLINT_SIDE_LEAVING;
    const cylint_root root = grows > 0 ? ROOT_ENTRY : ROOT_EXIT;
    if (cylint_form_sign(q, FORM_G, 0) == 0) {
        if (A < 0)
            return cylint_one_stop(CYLINT_RELATION_CROSS, ROOT_APEX, side, 1);
        return cylint_form_sign(q, FORM_C, 0) == 0
                   ? cylint_one_stop(CYLINT_RELATION_ALONG, ROOT_APEX, side, 1)
                   : cylint_no_overlap();
    }
    if (A == 0 && cylint_form_sign(q, FORM_B, 0) * grows > 0)
        return cylint_no_overlap(); /* the half-line lies in the other nappe */
    return cylint_one_stop(CYLINT_RELATION_CROSS, root, side, 0);
}

/* A half-space, whose plane is that of cap 0. */
static cylint_overlap half_space(cylint_query *q)
{
    const int slope = cylint_form_sign(q, FORM_BETA, 0);
    if (slope != 0)
        return cylint_one_stop(
            CYLINT_RELATION_CROSS, ROOT_CAP0,
            slope > 0 ? CYLINT_SIDE_LEAVING : CYLINT_SIDE_ENTERING, 0);
    return on_one_side(cylint_form_sign(q, FORM_ALPHA, 0));
}

cylint_overlap cylint_overlap_of(cylint_query *q)
{
    if (cylint_is_plane(q->kind))
        return half_space(q);
    if (cylint_ends_are_planes(q->ends))
        return bounded(q);
    if (!cylint_is_tapered(q->kind))
        return whole_cylinder(q);
    return cylint_is_nappe(q->shape) ? nappe(q) : double_cone(q);
}
