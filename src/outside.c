/*
 * outside.c - a point near a hit that is certainly outside or inside the solid
 *
 * The exact sign of cylint_contains() tests every point.  The first ones are
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

enum { NEAR = 4, MASKS = 8, MOST_DOUBLINGS = 64 };

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

/* Whether p is on the outer side of the hit's part. */
static int is_beyond_part(const search *s, const double p[3])
{
    const cylint_shape *shape = s->shape;
    cylint_line line;
    cylint_query q;
    /* untaken 1 of 6: every known step is finite */
    if (cylint_is_round(shape->kind) || !cylint_is_bounded(shape) ||
        cylint_open_at(&q, shape, &line, p) != CYLINT_OK)
        return 1;
    switch (s->part) {
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

static int is_there(const search *s, const double p[3])
{
    return cylint_contains(s->shape, p) == s->side &&
           (s->side > 0 || is_beyond_part(s, p));
}

/* Writes the hit's point to p, but from `stepped` the coordinates i whose bits i in
 * `mask` are 1. */
static void step_by(const search *s, const double stepped[3], unsigned mask,
                    double p[3])
{
    for (int i = 0; i < 3; i++)
        p[i] = mask >> i & 1 ? stepped[i] : s->from[i];
}

/* Whether the step in the coordinates of a is shorter than that in those of b.
 * A coordinate of both has no influence, so the sums of squares are exact, or
 * lose a part of two squares that makes them longer than one. */
static int is_shorter(const search *s, const double stepped[3], unsigned a,
                      unsigned b)
{
    double most = 0, sum[2] = {0, 0};
    int count[2] = {0, 0};
    for (int i = 0; i < 3; i++)
        if ((a ^ b) >> i & 1)
            most = cylint_larger(most, fabs(stepped[i]));
    for (int i = 0; i < 3; i++)
        if ((a ^ b) >> i & 1) {
            const int e = -cylint_exponent(most), in_b = b >> i & 1;
            const double step =
                cylint_scaled(stepped[i], e) - cylint_scaled(s->from[i], e);
            sum[in_b] += step * step;
            count[in_b]++;
        }
    /* untaken 1 of 6: no known step is 2^26 times as long as one beside it */
    return sum[0] < sum[1] || (sum[0] == sum[1] && count[0] < count[1]);
}

/* The coordinates in which the direction is not 0. */
static unsigned useful(const search *s)
{
    unsigned mask = 0;
    for (int i = 0; i < 3; i++)
        mask |= (unsigned)(cylint_sign(s->towards[i]) != 0) << i;
    return mask;
}

/* The nearest neighbour of those `steps` away. */
static int try_neighbours(const search *s, int steps, double p[3])
{
    double stepped[3], q[3];
    unsigned best = 0;
    for (int i = 0; i < 3; i++)
        stepped[i] = moved(s->from[i], cylint_sign(s->towards[i]) > 0, steps);
    for (unsigned mask = 1; mask < MASKS; mask++) {
        if (mask & ~useful(s) || (best && !is_shorter(s, stepped, mask, best)))
            continue;
        step_by(s, stepped, mask, q);
        if (is_there(s, q))
            best = mask;
    }
    step_by(s, stepped, best, p);
    return best != 0;
}

/* Points from + x d of n directions d, x doubling from `least` on, below `most`. */
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

/* The largest step of the doubles at the hit. */
static double largest_step(const search *s)
{
    double most = 0;
    for (int i = 0; i < 3; i++)
        most = cylint_larger(most, cylint_next(fabs(s->from[i]), 1) -
                                       fabs(s->from[i]));
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
