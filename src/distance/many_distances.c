/*
 * many_distances.c - many points and shapes
 */
#include "../numbers/bits.h"
#include "cylint_distance.h"

/* The members that the columns need. */
static unsigned wanted(const cylint_closest_columns *to)
{
    return (to->part || to->feature ? CYLINT_WANT_PART : 0u) |
           (to->point[0] || to->point[1] || to->point[2] ? CYLINT_WANT_POINT
                                                         : 0u) |
           (to->normal[0] || to->normal[1] || to->normal[2] ? CYLINT_WANT_NORMAL
                                                            : 0u);
}

static void write_row(const cylint_closest_columns *to, size_t row,
                      const cylint_closest *answer)
{
    if (to->distance)
        to->distance[row] = answer->distance;
    if (to->part)
        to->part[row] = (signed char)answer->part;
    if (to->feature)
        to->feature[row] = (signed char)answer->feature;
    for (int i = 0; i < 3; i++) {
        if (to->point[i])
            to->point[i][row] = answer->point[i];
        if (to->normal[i])
            to->normal[i][row] = answer->normal[i];
    }
}

/* `stride`: 1 if each point has a shape of its own, 0 if there is one shape. */
static void rows(const cylint_shape *shapes, size_t stride,
                 const cylint_points *points,
                 const cylint_closest_columns *answers)
{
    const unsigned want = wanted(answers);
    for (size_t i = 0; i < points->n; i++) {
        const double point[3] = {points->xyz[0][i], points->xyz[1][i],
                                 points->xyz[2][i]};
        cylint_closest answer;
        for (int k = 0; k < 3; k++)
            answer.point[k] = answer.normal[k] = NAN;
        cylint_distance(shapes + i * stride, point, want, &answer);
        write_row(answers, i, &answer);
    }
}

void cylint_distance_points(const cylint_shape *shape,
                            const cylint_points *points,
                            const cylint_closest_columns *answers)
{
    rows(shape, 0, points, answers);
}

void cylint_distance_pairs(const cylint_shape *shapes,
                           const cylint_points *points,
                           const cylint_closest_columns *answers)
{
    rows(shapes, 1, points, answers);
}

size_t cylint_closest_shape(const cylint_shape *shapes, size_t n,
                            const double point[3], double within, unsigned want,
                            cylint_closest *answer)
{
    if (within != within)
        return n;
    size_t best = n;
    double least = within;
    for (size_t i = 0; i < n; i++) {
        cylint_closest one;
        one.part = 0;
        const double size = fabs(cylint_distance(shapes + i, point, 0, &one));
        if (one.part >= 0 && (best == n ? !cylint_less(least, size)
                                        : cylint_less(size, least))) {
            best = i;
            least = size;
        }
    }
    if (best < n)
        cylint_distance(shapes + best, point, want, answer);
    return best;
}
