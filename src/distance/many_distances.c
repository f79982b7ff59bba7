/*
 * many_distances.c - many points and shapes
 *
 * Capped shapes are answered in lanes.  What these leave is answered one by one.
 */
#include "../dispatch.h"
#include "../numbers/bits.h"
#include "../shapes/measure.h"
#include "columns.h"
#include "lanes.h"

static void answer_row(const cylint_shape *shape, const cylint_points *points,
                       size_t row, unsigned want,
                       const cylint_closest_columns *answers)
{
    double point[3];
    cylint_read_point(points, row, point);
    cylint_closest answer;
    for (int k = 0; k < 3; k++)
        answer.point[k] = answer.normal[k] = NAN;
    cylint_distance(shape, point, want, &answer);
    cylint_write_closest(answers, row, &answer);
}

/* Lanes round to nearest, and flush no coordinate.  One or two points take
 * less time by themselves. */
static int has_lanes(unsigned want, size_t n)
{
    return n > 2 && cylint_rounds_to_nearest() &&
           !(want & (CYLINT_WANT_POINT | CYLINT_WANT_NORMAL) &&
             cylint_flushes_subnormals());
}

/* Answer i is that of point i and shape number each * i. */
static void write_rows(const cylint_shape *shapes, size_t each,
                       const cylint_points *points,
                       const cylint_closest_columns *answers)
{
    const unsigned want = cylint_wanted_of_closest(answers);
    const int in_lanes =
        (each || cylint_lane_class(shapes)) && has_lanes(want, points->n);
    size_t uncertain[CYLINT_POINT_BLOCK];
    for (size_t i = 0, end; i < points->n; i = end) {
        const size_t ahead = points->n - i;
        end = i + (ahead < CYLINT_POINT_BLOCK ? ahead : CYLINT_POINT_BLOCK);
        size_t n = end - i;
        if (in_lanes)
            n = CYLINT_OF_LANES(end - i > CYLINT_LANES_AVX512 / 2,
                                cylint_distance_lanes)(shapes, each, points, i,
                                                       end, answers, uncertain);
        for (size_t k = 0; k < n; k++) {
            const size_t row = in_lanes ? uncertain[k] : i + k;
            answer_row(shapes + each * row, points, row, want, answers);
        }
    }
}

void cylint_distance_points(const cylint_shape *shape,
                            const cylint_points *points,
                            const cylint_closest_columns *answers)
{
    write_rows(shape, 0, points, answers);
}

void cylint_distance_pairs(const cylint_shape *shapes,
                           const cylint_points *points,
                           const cylint_closest_columns *answers)
{
    write_rows(shapes, 1, points, answers);
}

/*
 * Whether the surface and the solid of a shape are certainly farther away than
 * `least`, because the ball about the shape is.  Where that is negative, whether
 * the point is outside.  The slack covers the roundings of both squares, eight at
 * most each.  The square of a `most` below 2^511 does not overflow.  2^-400 covers
 * what underflows.
 */
static int is_farther(const cylint_shape *s, const double point[3],
                      double least)
{
    if (!cylint_is_bounded(s) || !cylint_in_range(s))
        return 0;
    double center[3];
    const double radius = cylint_ball_about(s, center);
    const double X = point[0] - center[0], Y = point[1] - center[1],
                 Z = point[2] - center[2];
    const double most =
        (cylint_larger(least, 0) + radius) * CYLINT_SLACK + 0x1p-400;
    return most < 0x1p511 && X * X + Y * Y + Z * Z > most * most;
}

size_t cylint_closest_shape(const cylint_shape *shapes, size_t n,
                            const double point[3], double within, unsigned want,
                            cylint_closest *answer)
{
    if (within != within)
        return n;
    size_t best = n;
    double least = within;
    int64_t limit = cylint_rank(within) + 1; /* of the rank of a better one */
    for (size_t i = 0; i < n; i++) {
        cylint_closest one;
        one.part = 0;
        if (is_farther(shapes + i, point, least))
            continue;
        const double distance =
            cylint_distance(shapes + i, point, want & CYLINT_SIGNED, &one);
        const double size = want & CYLINT_SIGNED ? distance : fabs(distance);
        if (cylint_rank(size) < limit && one.part >= 0) {
            best = i;
            least = size;
            limit = cylint_rank(size);
        }
    }
    if (best < n)
        cylint_distance(shapes + best, point, want, answer);
    return best;
}
