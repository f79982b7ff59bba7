/*
 * outside.c - a point near a hit that is certainly outside or inside the solid
 *
 * The exact sign of cylint_contains() tests every finite point.  The first ones are
 * the hit's point and its neighbours in the direction of the normal, 1 to NEAR
 * steps of the doubles in some of the coordinates; of these the nearest is
 * chosen.  A hit's coordinates are the nearest doubles, so one step nearly always
 * suffices.  Points farther along the normal follow.  From a rim the inside is not
 * in the direction of the normal: there points towards the middle of the axis
 * follow, which is in the interior of a bounded solid.  At the apex of a double
 * cone the outside is not in the direction of the normal: the last points are
 * farther and farther along all diagonals of the coordinates.
 *
 * A point outside of a rim may be beyond the cap only.  A ray that leaves the
 * lateral surface could then pass through the cap.  So the point must be on the
 * outer side of the part that the hit lies on.
 */
#include <string.h>

#include "intersect.h"

enum { NEAR = 4, MOST_DOUBLINGS = 64 };

static double moved(double x, int up, int steps)
{
    for (; steps > 0; steps--)
        x = cylint_next(x, up);
    return x;
}

typedef struct {
    const cylint_shape *shape;
    int side, part;
    double from[3], towards[3]; /* the hit and a direction to the side */
} search;

/* Whether an outside point p is on the outer side of the hit's part: it is if it is
 * on the inner side of all others, whose signs doubles nearly always decide. */
static int is_beyond_part(const search *s, const double p[3])
{
    const cylint_shape *shape = s->shape;
    const int part = s->part;
    cylint_line line;
    cylint_query q;
    if (cylint_is_round(shape->kind) || !cylint_is_bounded(shape))
        return 1;
    cylint_open_at(&q, shape, &line, p);
    if ((part == CYLINT_PART_CAP0 || cylint_form_sign(&q, FORM_ALPHA, 0) > 0) &&
        (part == CYLINT_PART_CAP1 || cylint_form_sign(&q, FORM_ALPHA, 1) < 0) &&
        (part == CYLINT_PART_LATERAL || cylint_form_sign(&q, FORM_C, 0) < 0))
        return 1;
    switch (part) {
    case CYLINT_PART_CAP0:
        return cylint_form_sign(&q, FORM_ALPHA, 0) < 0;
    case CYLINT_PART_CAP1:
        return cylint_form_sign(&q, FORM_ALPHA, 1) > 0;
    default:
        return cylint_form_sign(&q, FORM_C, 0) > 0 ||
               (cylint_is_tapered(shape->kind) &&
                cylint_form_sign(&q, FORM_RHO0, 0) < 0);
    }
}

/* Whether p is a point to return.  cylint_contains() is -1 for an infinite one. */
static int is_there(const search *s, const double p[3])
{
    return cylint_contains(s->shape, p) == s->side &&
           (s->side > 0 || (cylint_is_finite(p) && is_beyond_part(s, p)));
}

/* Writes the coordinates in the order of the lengths of their steps, and these
 * lengths times a power of two, so that no processor flushes them to zero. */
static void order_steps(const search *s, const double stepped[3], int order[3],
                        double length[3])
{
    enum { LARGE_EXPONENT = 1000 };
    const int most = cylint_exponent(cylint_largest(stepped));
    const int e = most < LARGE_EXPONENT ? LARGE_EXPONENT - most : 0;
    for (int i = 0; i < 3; i++) {
        int at = i;
        length[i] =
            fabs(cylint_scaled(stepped[i], e) - cylint_scaled(s->from[i], e));
        for (; at > 0 && length[i] < length[order[at - 1]]; at--)
            order[at] = order[at - 1];
        order[at] = i;
    }
}

/* Whether a^2 + b^2 < c^2, where c is the largest.  Each is a power of two
 * times an integer of at most 7, so the sum is exact, or it loses a part of the
 * smaller square, and then it is not less than c^2 if b is c. */
static int is_shorter(double a, double b, double c)
{
    const int e = -cylint_exponent(c);
    const double x = cylint_scaled(a, e), y = cylint_scaled(b, e),
                 z = cylint_scaled(c, e);
    return x * x + y * y < z * z;
}

/* Tries the neighbours `steps` away, the nearest first. */
static int try_neighbours(const search *s, int steps, double p[3])
{
    double stepped[3], length[3];
    int order[3];
    unsigned useful = 0;
    for (int i = 0; i < 3; i++) {
        const int sign = cylint_sign(s->towards[i]);
        stepped[i] = moved(s->from[i], sign > 0, steps);
        useful |= (unsigned)(sign != 0) << i;
    }
    order_steps(s, stepped, order, length);
    const unsigned a = 1u << order[0], b = 1u << order[1], c = 1u << order[2];
    const int ab_first =
        is_shorter(length[order[0]], length[order[1]], length[order[2]]);
    /* bits: the coordinates that are stepped */
    const unsigned masks[] = {
        a,     b,        ab_first ? a | b : c, ab_first ? c : a | b, a | c,
        b | c, a | b | c};
    for (size_t i = 0; i < sizeof masks / sizeof *masks; i++) {
        for (int j = 0; j < 3; j++)
            p[j] = masks[i] >> j & 1 ? stepped[j] : s->from[j];
        if (!(masks[i] & ~useful) && is_there(s, p))
            return 1;
    }
    return 0;
}

/* Tries the points from + x d along n directions d: x = least, 2 least, 4 least ...
 * below `most`. */
static int try_directions(const search *s, double d[][3], int n, double least,
                          double most, double p[3])
{
    double x = least;
    for (int k = 0; k < MOST_DOUBLINGS && x < most; k++, x *= 2)
        for (int j = 0; j < n; j++) {
            for (int i = 0; i < 3; i++)
                p[i] = s->from[i] + x * d[j][i];
            if (is_there(s, p))
                return 1;
        }
    return 0;
}

/* Along the diagonals. */
static int try_diagonals(const search *s, double least, double p[3])
{
    enum { DIAGONALS = 27 };
    double d[DIAGONALS][3];
    for (int j = 0; j < DIAGONALS; j++)
        for (int i = 0, digits = j; i < 3; i++, digits /= 3)
            d[j][i] = digits % 3 - 1;
    return try_directions(s, d, DIAGONALS, least, HUGE_VAL, p);
}

/* The largest step of the doubles at the hit, finite also at the largest double. */
static double largest_step(const search *s)
{
    double most = 0;
    for (int i = 0; i < 3; i++) {
        const double x =
            cylint_smaller(fabs(s->from[i]), cylint_next(DBL_MAX, 0));
        most = cylint_larger(most, cylint_next(x, 1) - x);
    }
    return most;
}

int cylint_outside(const cylint_shape *shape, const cylint_hit *hit, int side,
                   double point[3])
{
    search s = {.shape = shape, .side = side, .part = hit->part};
    for (int i = 0; i < 3; i++) {
        s.from[i] = hit->point[i];
        s.towards[i] = side > 0 ? -hit->normal[i] : hit->normal[i];
    }
    memcpy(point, s.from, sizeof s.from); /* point may be in *hit */
    if (is_there(&s, point))
        return 1;
    for (int steps = 1; steps <= NEAR; steps++)
        if (try_neighbours(&s, steps, point))
            return 1;
    if (try_directions(&s, &s.towards, 1, largest_step(&s), HUGE_VAL, point))
        return 1;
    if (side > 0 && cylint_is_bounded(shape)) {
        double center[3];
        cylint_ball_about(shape, center);
        for (int i = 0; i < 3; i++)
            s.towards[i] = center[i] - s.from[i];
        if (try_directions(&s, &s.towards, 1, 0x1p-52, 1, point))
            return 1;
    }
    if (try_diagonals(&s, largest_step(&s), point))
        return 1;
    memcpy(point, s.from, sizeof s.from);
    return 0;
}
