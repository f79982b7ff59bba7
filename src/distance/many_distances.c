/*
 * many_distances.c - many points and shapes; points on a surface or beside it
 *
 * Distances from capped shapes are computed in lanes.  What is uncertain there, and
 * distances from all other shapes, are computed one by one.
 */
#include "../dispatch.h"
#include "../numbers/bits.h"
#include "../shapes/measure.h"
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

/* Lanes need rounding to nearest, and for point and normal a processor that does
 * not flush subnormal numbers.  One or two points take less time by themselves. */
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
 * `least`, because the ball about the shape is.  For a negative `least`: whether
 * the point is outside the ball.  The slack covers the roundings of both squares,
 * eight at most each.  The square of a `most` below 2^511 does not overflow; the
 * ball of an unbounded shape is infinite.  2^-400 covers what underflows.
 */
static int is_farther(const cylint_shape *s, const double point[3],
                      double least)
{
    double center[3];
    const double radius = cylint_ball_about(s, center);
    const double X = point[0] - center[0], Y = point[1] - center[1],
                 Z = point[2] - center[2];
    const double most =
        (cylint_larger(least, 0) + radius) * CYLINT_SLACK + 0x1p-400;
    /* mutant '+' -> '-': slower, more distances are computed */
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

/* --------------------------------------------------- on the surface --- */

/* The exponent of the distance of |x| from the next larger double. */
static int exponent_of_last_place(double x)
{
    const int e = cylint_exponent(x) - 52;
    /* mutant '>' -> '>=': -1074 gives -1074, too */
    return e > -1074 ? e : -1074;
}

/* Whether x <= y 2^e, for positive finite x and y.  The number that is scaled
 * grows, so it is exact or infinite. */
static int is_at_most(double x, double y, int e)
{
    return e < 0 ? !cylint_less(y, cylint_scaled(x, -e))
                 : !cylint_less(cylint_scaled(y, e), x);
}

/* Whether the distance of the point is at most `ulps` units. */
static int is_within_ulps(double distance, const double point[3], double ulps)
{
    const double size = fabs(distance);
    if (!(size <= DBL_MAX) || ulps != ulps || cylint_sign(ulps) < 0)
        return 0;
    if (cylint_sign(size) == 0 || ulps > DBL_MAX)
        return 1;
    return cylint_sign(ulps) != 0 &&
           is_at_most(size, ulps,
                      exponent_of_last_place(cylint_largest(point)));
}

int cylint_on_surface(const cylint_shape *shape, const double point[3],
                      double ulps)
{
    cylint_closest answer;
    /* mutant '0' -> '1': CYLINT_WANT_T has no effect here */
    const double distance = cylint_distance(shape, point, 0, &answer);
    return is_within_ulps(distance, point, ulps);
}

/* Answer i is that of point i and shape number each * i. */
static void write_on_surface(const cylint_shape *shapes, size_t each,
                             const cylint_points *points, double ulps,
                             signed char *on)
{
    double distance[CYLINT_POINT_BLOCK];
    const cylint_closest_columns to = {.distance = distance};
    for (size_t first = 0; first < points->n; first += CYLINT_POINT_BLOCK) {
        const size_t ahead = points->n - first;
        const cylint_points block = {
            ahead < CYLINT_POINT_BLOCK ? ahead : CYLINT_POINT_BLOCK,
            {points->xyz[0] + first, points->xyz[1] + first,
             points->xyz[2] + first}};
        write_rows(shapes + each * first, each, &block, &to);
        for (size_t i = 0; i < block.n; i++) {
            double point[3];
            cylint_read_point(&block, i, point);
            on[first + i] =
                (signed char)is_within_ulps(distance[i], point, ulps);
        }
    }
}

void cylint_on_surface_points(const cylint_shape *shape,
                              const cylint_points *points, double ulps,
                              signed char *on)
{
    write_on_surface(shape, 0, points, ulps, on);
}

void cylint_on_surface_pairs(const cylint_shape *shapes,
                             const cylint_points *points, double ulps,
                             signed char *on)
{
    write_on_surface(shapes, 1, points, ulps, on);
}
