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
#include "nearest.h"

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

/* `stride`: 1 if each point has a shape of its own, 0 if there is one shape. */
static void rows(const cylint_shape *shapes, size_t stride,
                 const cylint_points *points,
                 const cylint_closest_columns *answers)
{
    const unsigned want = cylint_wanted_of_closest(answers);
    for (size_t i = 0; i < points->n; i++)
        answer_row(shapes + i * stride, points, i, want, answers);
}

/* Lanes round to nearest, and flush no coordinate.  One or two points take
 * less time by themselves. */
static int has_lanes(const cylint_closest_columns *to, size_t n)
{
    const unsigned geometry = CYLINT_WANT_POINT | CYLINT_WANT_NORMAL;
    return n > 2 && cylint_rounds_to_nearest() &&
           !(cylint_wanted_of_closest(to) & geometry &&
             cylint_flushes_subnormals());
}

static cylint_distance_lanes *kernel(void)
{
    return CYLINT_OF_BUILD(cylint_build_used(), cylint_distance_lanes_plain,
                           cylint_distance_lanes_avx2,
                           cylint_distance_lanes_avx512);
}

static void write_feature_of_row(const cylint_shape *s, int feature,
                                 const cylint_closest_columns *to, size_t row)
{
    feature = cylint_stated_feature(s, feature);
    if (to->feature)
        to->feature[row] = (signed char)feature;
    if (to->part)
        to->part[row] = (signed char)cylint_feature_part(feature);
}

/* Coordinates that lanes write, to arrays from `first` on; to `unwanted` where only
 * others of the vector are wanted. */
static void find_columns(double *to[3], double *const wanted_columns[3],
                         size_t first, double unwanted[3][CYLINT_POINT_BLOCK])
{
    const int any = wanted_columns[0] || wanted_columns[1] || wanted_columns[2];
    for (int k = 0; k < 3; k++)
        to[k] = wanted_columns[k] ? wanted_columns[k] + first
                : any             ? unwanted[k]
                                  : NULL;
}

/* lint: the lanes write all n features but those of the points left */
/* Points first to first + n - 1: one shape if `each` is 0, else a shape for each
 * point. */
static void block(const cylint_shape *shapes, size_t each,
                  cylint_distance_lanes *answer_many,
                  const cylint_points *points, size_t first, int n,
                  const cylint_closest_columns *answers)
{
    double unwanted[3][CYLINT_POINT_BLOCK];
    signed char feature[CYLINT_POINT_BLOCK];
    int rest[CYLINT_POINT_BLOCK];
    const unsigned want = cylint_wanted_of_closest(answers),
                   parted = want & CYLINT_WANT_PART;
    cylint_lane_columns to;
    const double *const xyz[3] = {
        points->xyz[0] + first, points->xyz[1] + first, points->xyz[2] + first};
    const cylint_shape *from = shapes + each * first;
    to.distance = answers->distance ? answers->distance + first : unwanted[0];
    to.feature = parted ? feature : NULL;
    find_columns(to.point, answers->point, first, unwanted);
    find_columns(to.normal, answers->normal, first, unwanted);
    const int left = answer_many(from, each != 0, xyz, n, &to, rest);
    int next = 0;
    for (int i = 0; i < n && (left > 0 || parted); i++) {
        const cylint_shape *shape = from + each * (size_t)i;
        if (next < left && rest[next] == i) {
            answer_row(shape, points, first + (size_t)i, want, answers);
            next++;
        } else if (parted) {
            write_feature_of_row(shape, feature[i], answers, first + (size_t)i);
        }
    }
}

static void blocks(const cylint_shape *shapes, size_t each,
                   const cylint_points *points,
                   const cylint_closest_columns *answers)
{
    for (size_t i = 0; i < points->n; i += CYLINT_POINT_BLOCK) {
        const size_t left = points->n - i;
        block(shapes, each, kernel(), points, i,
              left < CYLINT_POINT_BLOCK ? (int)left : CYLINT_POINT_BLOCK,
              answers);
    }
}

void cylint_distance_points(const cylint_shape *shape,
                            const cylint_points *points,
                            const cylint_closest_columns *answers)
{
    if (cylint_lane_class(shape) && has_lanes(answers, points->n))
        blocks(shape, 0, points, answers);
    else
        rows(shape, 0, points, answers);
}

void cylint_distance_pairs(const cylint_shape *shapes,
                           const cylint_points *points,
                           const cylint_closest_columns *answers)
{
    if (has_lanes(answers, points->n))
        blocks(shapes, 1, points, answers);
    else
        rows(shapes, 1, points, answers);
}

/*
 * Whether the surface and the solid of a shape are certainly farther away than
 * `least`, because the ball about the shape is.  Where that is negative, whether
 * the point is outside.  The slack covers the roundings of both
 * squares, eight at most each.  If the smaller one overflows, to infinity or to
 * the largest double, they are equal.  2^-400 covers what underflows.
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
    return X * X + Y * Y + Z * Z > most * most;
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
