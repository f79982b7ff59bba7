/*
 * overlap.c - where a line overlaps a shape, from exact signs
 *
 * A bounded shape is convex, so the overlap is one interval.  It is the
 * intersection of two: Q < 0 (signs/forms_template.h) and 0 < z < 1.  It begins
 * at the plane that the line comes to first or at the root where Q falls,
 * whichever is later.  It ends at the plane that the line comes to last or at the
 * root where Q rises, whichever is earlier.
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
 *
 * The planes of the two circles cut a round solid into a part of ball 0, a frustum
 * and a part of ball 1.  At each plane the sign of E shows whether the line is
 * inside the solid there, that of N whether it approaches the centre of the ball of
 * that plane.
 */
#include "roots.h"

static cylint_overlap no_overlap(void)
{
    cylint_overlap v = {
        CYLINT_RELATION_MISS, 0, {{ROOT_APEX, 0, 0, 0}, {ROOT_APEX, 0, 0, 0}}};
    return v;
}

static cylint_overlap one_stop(int relation, cylint_root root, int side,
                               int apex)
{
    cylint_overlap v = no_overlap();
    v.relation = relation;
    v.n = 1;
    v.at[0] = (cylint_stop){root, CYLINT_PART_LATERAL, side, apex};
    return v;
}

static cylint_overlap two_stops(int relation, cylint_stop first,
                                cylint_stop last)
{
    cylint_overlap v = {relation, 2, {first, last}};
    v.at[0].side = CYLINT_SIDE_ENTERING;
    v.at[1].side = CYLINT_SIDE_LEAVING;
    return v;
}

static cylint_overlap touch_at(cylint_stop s)
{
    cylint_overlap v =
        one_stop(CYLINT_RELATION_TOUCH, s.root, CYLINT_SIDE_BOTH, s.apex);
    v.at[0].part = s.part;
    return v;
}

static cylint_stop lateral(cylint_root root)
{
    return (cylint_stop){root, CYLINT_PART_LATERAL, 0, 0};
}

/* ------------------------------------------------- bounded shapes ------ */

static int radius_is_zero(const cylint_query *q, int cap)
{
    return cylint_sign(cylint_end_factor(q->shape, cap)) == 0;
}

/* Where the overlap begins (end = 0) or ends, from the sign of E at the plane on
 * that side, which is that of a cap.  On a rim (E = 0) the plane and the lateral
 * root have the same t; the part is lateral. */
static cylint_stop stop_at(const cylint_query *q, int E, int cap, int end)
{
    const cylint_root root = end ? ROOT_EXIT : ROOT_ENTRY;
    const int part = cap ? CYLINT_PART_CAP1 : CYLINT_PART_CAP0;
    if (E < 0)
        return lateral(root);
    if (E > 0 && cylint_is_round(q->kind))
        return (cylint_stop){root, part, 0, 0};
    return (cylint_stop){cap ? ROOT_CAP1 : ROOT_CAP0,
                         E > 0 ? part : CYLINT_PART_LATERAL, 0,
                         E == 0 && radius_is_zero(q, cap)};
}

/* Q <= 0 on one interval between its roots: a chord, a point or nothing. */
static cylint_overlap chord(cylint_query *q, int relation, int apex)
{
    const int G = cylint_form_sign(q, FORM_G, 0);
    if (G < 0)
        return no_overlap();
    if (G == 0)
        return one_stop(CYLINT_RELATION_TOUCH, ROOT_DOUBLE, CYLINT_SIDE_BOTH,
                        apex);
    return two_stops(relation, lateral(ROOT_ENTRY), lateral(ROOT_EXIT));
}

/* The overlap with the ball of an end, of a line that no other part of the solid
 * overlaps; none of solids that are not round. */
static cylint_overlap ball_chord(cylint_query *q, int end)
{
    cylint_stop begin = stop_at(q, 1, end, 0);
    const int discriminant =
        cylint_is_round(q->kind) ? cylint_form_sign(q, FORM_END_BALL, end) : -1;
    if (discriminant > 0)
        return two_stops(CYLINT_RELATION_CROSS, begin, stop_at(q, 1, end, 1));
    begin.root = ROOT_DOUBLE;
    return discriminant < 0 ? no_overlap() : touch_at(begin);
}

/* The line is parallel to the planes of the caps or circles. */
static cylint_overlap parallel_to_planes(cylint_query *q)
{
    const int above0 = cylint_form_sign(q, FORM_ALPHA, 0);
    if (above0 < 0)
        return ball_chord(q, 0);
    const int above1 = cylint_form_sign(q, FORM_ALPHA, 1);
    if (above1 > 0)
        return ball_chord(q, 1);
    if (above0 != 0 && above1 != 0)
        return chord(q, CYLINT_RELATION_CROSS, 0);
    return chord(q,
                 cylint_is_round(q->kind) ? CYLINT_RELATION_CROSS
                                          : CYLINT_RELATION_ALONG,
                 radius_is_zero(q, above1 == 0));
}

/* On the circle at one plane and outside the solid at the other.  grows: the
 * growth of the distance from the centre of that ball.  is_first: it is the
 * plane that the line comes to first. */
static cylint_overlap round_through_circle(const cylint_query *q, int end,
                                           int grows, int is_first)
{
    const cylint_stop at = stop_at(q, 0, end, 0);
    if (grows == 0)
        return touch_at(at);
    /* the other stop is on the ball (1) or lateral (-1) */
    const int E = is_first == (grows > 0) ? 1 : -1;
    const cylint_stop other = stop_at(q, E, end, grows < 0);
    return grows < 0 ? two_stops(CYLINT_RELATION_CROSS, at, other)
                     : two_stops(CYLINT_RELATION_CROSS, other, at);
}

/* A round kind, at neither plane inside the solid.  Where the line is outside at
 * both, it may pass through one ball beyond its plane, or through the lateral
 * surface twice. */
static cylint_overlap round_slab(cylint_query *q, int up, const int E[2],
                                 cylint_stop begin, cylint_stop end)
{
    const int first = !up, last = up, sign = up ? 1 : -1;
    const int N_first = sign * cylint_form_sign(q, FORM_N, first);
    if (E[0] == 0 && E[1] == 0)
        return two_stops(N_first == 0 ? CYLINT_RELATION_ALONG
                                      : CYLINT_RELATION_CROSS,
                         begin, end);
    if (E[first] == 0)
        return round_through_circle(q, first, N_first, 1);
    const int N_last = sign * cylint_form_sign(q, FORM_N, last);
    if (E[last] == 0)
        return round_through_circle(q, last, N_last, 0);
    const cylint_overlap v = N_first > 0 ? ball_chord(q, first) : no_overlap();
    if (v.n > 0)
        return v;
    if (N_last < 0)
        return ball_chord(q, last);
    return N_first < 0 ? chord(q, CYLINT_RELATION_CROSS, 0) : no_overlap();
}

/* The line crosses both planes.  up: z grows along it. */
static cylint_overlap slab(cylint_query *q, int up)
{
    const int E[2] = {cylint_form_sign(q, FORM_E, 0),
                      cylint_form_sign(q, FORM_E, 1)};
    const cylint_stop begin = stop_at(q, E[!up], !up, 0),
                      end = stop_at(q, E[up], up, 1);
    if (E[0] > 0 || E[1] > 0)
        return two_stops(CYLINT_RELATION_CROSS, begin, end);
    if (cylint_is_round(q->kind))
        return round_slab(q, up, E, begin, end);
    const int dips = cylint_form_sign(q, FORM_N, 0) < 0 &&
                     cylint_form_sign(q, FORM_N, 1) > 0;
    const int G = dips ? cylint_form_sign(q, FORM_G, 0) : -1;
    if (G > 0)
        return two_stops(CYLINT_RELATION_CROSS, begin, end);
    if (E[0] == 0 && E[1] == 0) /* a ruling: Q = 0 on all of the line */
        return two_stops(CYLINT_RELATION_ALONG, begin, end);
    if (E[0] == 0 || E[1] == 0)
        return touch_at(E[up] == 0 ? end : begin);
    return G < 0 ? no_overlap() : touch_at(lateral(ROOT_DOUBLE));
}

static cylint_overlap sphere(cylint_query *q)
{
    cylint_overlap v = chord(q, CYLINT_RELATION_CROSS, 0);
    for (int i = 0; i < v.n; i++)
        v.at[i].part = cylint_surface(q->shape);
    return v;
}

static cylint_overlap bounded(cylint_query *q)
{
    const int up = cylint_form_sign(q, FORM_BETA, 0);
    return up == 0 ? parallel_to_planes(q) : slab(q, up > 0);
}

/* ----------------------------------------------- unbounded shapes ------ */

/* A line that is as a whole inside, on the surface or outside.  side: -1, 0, 1. */
static cylint_overlap on_one_side(int side)
{
    cylint_overlap v = no_overlap();
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
               : chord(q, CYLINT_RELATION_CROSS, 0);
}

static cylint_overlap double_cone(cylint_query *q)
{
    const int A = cylint_form_sign(q, FORM_A, 0);
    if (A > 0) {
        cylint_overlap v = chord(q, CYLINT_RELATION_CROSS, 0);
        if (v.n == 1)
            v.at[0].apex = cylint_form_sign(q, FORM_T, 0) == 0;
        return v;
    }
    if (cylint_form_sign(q, FORM_G, 0) == 0)
        return A < 0 ? one_stop(CYLINT_RELATION_CROSS, ROOT_DOUBLE,
                                CYLINT_SIDE_BOTH, 1)
                     : parallel_to_ruling(q);
    if (A == 0)
        return cylint_form_sign(q, FORM_B, 0) > 0
                   ? one_stop(CYLINT_RELATION_CROSS, ROOT_EXIT,
                              CYLINT_SIDE_LEAVING, 0)
                   : one_stop(CYLINT_RELATION_CROSS, ROOT_ENTRY,
                              CYLINT_SIDE_ENTERING, 0);
    cylint_overlap v = two_stops(CYLINT_RELATION_CROSS, lateral(ROOT_EXIT),
                                 lateral(ROOT_ENTRY));
    v.at[0].side = CYLINT_SIDE_LEAVING;
    v.at[1].side = CYLINT_SIDE_ENTERING;
    return v;
}

/* The nappe where rho >= 0. */
static cylint_overlap nappe(cylint_query *q)
{
    const int A = cylint_form_sign(q, FORM_A, 0);
    if (A > 0) {
        cylint_overlap v = chord(q, CYLINT_RELATION_CROSS, 0);
        if (v.n == 0)
            return v;
        const int T = cylint_form_sign(q, FORM_T, 0);
        v.at[0].apex = v.n == 1 && T == 0;
        return T < 0 ? no_overlap() : v;
    }
    /* A <= 0: rho changes along the line, and grows with t or shrinks */
    const int grows = cylint_form_sign(q, FORM_BETA, 0) *
                      cylint_sign(cylint_radius_growth(q->shape).hi);
    const int side = grows > 0 ? CYLINT_SIDE_ENTERING : CYLINT_SIDE_LEAVING;
    const cylint_root root = grows > 0 ? ROOT_ENTRY : ROOT_EXIT;
    if (cylint_form_sign(q, FORM_G, 0) == 0) {
        if (A < 0)
            return one_stop(CYLINT_RELATION_CROSS, ROOT_APEX, side, 1);
        return cylint_form_sign(q, FORM_C, 0) == 0
                   ? one_stop(CYLINT_RELATION_ALONG, ROOT_APEX, side, 1)
                   : no_overlap();
    }
    if (A == 0 && cylint_form_sign(q, FORM_B, 0) * grows > 0)
        return no_overlap(); /* the half-line lies in the other nappe */
    return one_stop(CYLINT_RELATION_CROSS, root, side, 0);
}

/* A half-space, whose plane is that of cap 0. */
static cylint_overlap half_space(cylint_query *q)
{
    const int slope = cylint_form_sign(q, FORM_BETA, 0);
    if (slope != 0)
        return one_stop(CYLINT_RELATION_CROSS, ROOT_CAP0,
                        slope > 0 ? CYLINT_SIDE_LEAVING : CYLINT_SIDE_ENTERING,
                        0);
    return on_one_side(cylint_form_sign(q, FORM_ALPHA, 0));
}

cylint_overlap cylint_overlap_of(cylint_query *q)
{
    if (cylint_is_plane(q->kind))
        return half_space(q);
    if (q->kind == CYLINT_KIND_SPHERE)
        return sphere(q);
    if (cylint_ends_are_planes(q->ends))
        return bounded(q);
    if (!cylint_is_tapered(q->kind))
        return whole_cylinder(q);
    return cylint_is_nappe(q->shape) ? nappe(q) : double_cone(q);
}

int cylint_round_contains(cylint_query *q)
{
    cylint_shape ball;
    if (q->kind != CYLINT_KIND_SPHERE) {
        const int end = cylint_form_sign(q, FORM_ALPHA, 0) < 0   ? 0
                        : cylint_form_sign(q, FORM_ALPHA, 1) > 0 ? 1
                                                                 : -1;
        if (end >= 0) {
            cylint_ball_of(&ball, q->shape, end);
            cylint_query_open(q, &ball, q->line);
        }
    }
    return -cylint_form_sign(q, FORM_C, 0);
}
