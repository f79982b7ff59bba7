/*
 * round_overlap.c - the overlap of a line and a round kind
 *
 * The planes of the two circles cut the solid into a part of ball 0, a frustum
 * and a part of ball 1 (signs/round_forms_template.h).  A line comes to the plane
 * `first`, then to `last`.  At each plane the sign of E shows whether the line is
 * inside the solid there, that of N whether it approaches the centre of the ball
 * of that plane.
 */
#include "overlap.h"

/* A stop on the ball about an end. */
static cylint_stop stop_on_ball(cylint_root root, int end)
{
    return (cylint_stop){root, end ? CYLINT_PART_CAP1 : CYLINT_PART_CAP0, 0, 0};
}

/* A stop on the circle about an end; at an end of radius 0, the apex. */
static cylint_stop stop_on_circle(const cylint_query *q, int end)
{
    return (cylint_stop){end ? ROOT_CAP1 : ROOT_CAP0, CYLINT_PART_LATERAL, 0,
                         cylint_radius_is_zero(q, end)};
}

/* The line meets the solid on one ball only, if at all. */
static cylint_overlap ball_chord(int discriminant, int end)
{
    cylint_overlap v = cylint_no_overlap();
    if (discriminant < 0)
        return v;
    if (discriminant > 0)
        return cylint_two_stops(CYLINT_RELATION_CROSS,
                                stop_on_ball(ROOT_ENTRY, end),
                                stop_on_ball(ROOT_EXIT, end));
    v = cylint_one_stop(CYLINT_RELATION_TOUCH, ROOT_DOUBLE, CYLINT_SIDE_BOTH,
                        0);
    v.at[0].part = end ? CYLINT_PART_CAP1 : CYLINT_PART_CAP0;
    return v;
}

/* The line is parallel to the planes. */
static cylint_overlap round_parallel(cylint_query *q)
{
    const int above0 = cylint_form_sign(q, FORM_ALPHA, 0);
    if (above0 < 0)
        return ball_chord(cylint_form_sign(q, FORM_END_BALL, 0), 0);
    const int above1 = cylint_form_sign(q, FORM_ALPHA, 1);
    if (above1 > 0)
        return ball_chord(cylint_form_sign(q, FORM_END_BALL, 1), 1);
    const int at_apex = (above0 == 0 && cylint_radius_is_zero(q, 0)) ||
                        (above1 == 0 && cylint_radius_is_zero(q, 1));
    return cylint_chord_overlap(q, CYLINT_RELATION_CROSS, at_apex);
}

/* Outside the solid at both planes: the line may pass through one ball beyond
 * its plane, or through the lateral surface twice. */
static cylint_overlap round_between(cylint_query *q, int up, int first,
                                    int last, int N_first, int N_last)
{
    if (up * N_first > 0) {
        const int discriminant = cylint_form_sign(q, FORM_END_BALL, first);
        if (discriminant >= 0)
            return ball_chord(discriminant, first);
    }
    if (up * N_last < 0)
        return ball_chord(cylint_form_sign(q, FORM_END_BALL, last), last);
    return up * N_first < 0 ? cylint_chord_overlap(q, CYLINT_RELATION_CROSS, 0)
                            : cylint_no_overlap();
}

/* On the circle at one plane and outside the solid at the other.  grows: the
 * growth of the distance from the centre of that ball.  is_first: it is the
 * plane that the line comes to first. */
static cylint_overlap round_through_circle(const cylint_query *q, int end,
                                           int grows, int is_first)
{
    const cylint_stop at = stop_on_circle(q, end);
    if (grows == 0)
        return cylint_touch_at(at);
    if (grows < 0)
        return cylint_two_stops(CYLINT_RELATION_CROSS, at,
                                is_first ? cylint_lateral_stop(ROOT_EXIT)
                                         : stop_on_ball(ROOT_EXIT, end));
    return cylint_two_stops(CYLINT_RELATION_CROSS,
                            is_first ? stop_on_ball(ROOT_ENTRY, end)
                                     : cylint_lateral_stop(ROOT_ENTRY),
                            at);
}

/* The line comes to both planes; up is the sign of dz/dt. */
static cylint_overlap round_slab(cylint_query *q, int up)
{
    const int first = up > 0 ? 0 : 1, last = 1 - first;
    const int Ef = cylint_form_sign(q, FORM_E, first),
              El = cylint_form_sign(q, FORM_E, last);
    const cylint_stop begin = Ef > 0    ? stop_on_ball(ROOT_ENTRY, first)
                              : Ef == 0 ? stop_on_circle(q, first)
                                        : cylint_lateral_stop(ROOT_ENTRY);
    const cylint_stop end = El > 0    ? stop_on_ball(ROOT_EXIT, last)
                            : El == 0 ? stop_on_circle(q, last)
                                      : cylint_lateral_stop(ROOT_EXIT);
    if (Ef > 0 || El > 0)
        return cylint_two_stops(CYLINT_RELATION_CROSS, begin, end);
    const int Nf = cylint_form_sign(q, FORM_N, first);
    if (Ef == 0 && El == 0)
        return cylint_two_stops(Nf == 0 ? CYLINT_RELATION_ALONG
                                        : CYLINT_RELATION_CROSS,
                                begin, end);
    if (Ef == 0)
        return round_through_circle(q, first, up * Nf, 1);
    const int Nl = cylint_form_sign(q, FORM_N, last);
    if (El == 0)
        return round_through_circle(q, last, up * Nl, 0);
    return round_between(q, up, first, last, Nf, Nl);
}

cylint_overlap cylint_round_overlap(cylint_query *q)
{
    if (q->kind == CYLINT_KIND_SPHERE) {
        cylint_overlap v = cylint_chord_overlap(q, CYLINT_RELATION_CROSS, 0);
        for (int i = 0; i < v.n; i++)
            v.at[i].part = cylint_surface(q->shape);
        return v;
    }
    const int up = cylint_form_sign(q, FORM_BETA, 0);
    return up == 0 ? round_parallel(q) : round_slab(q, up);
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
