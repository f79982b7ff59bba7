/*
 * columns.h - the columns of many distances
 */
#ifndef CYLINT_DISTANCE_COLUMNS_H
#define CYLINT_DISTANCE_COLUMNS_H

#include "cylint_distance.h"

static inline int cylint_has_vector(double *const column[3])
{
    return column[0] || column[1] || column[2];
}

static inline void cylint_write_vector(double *const column[3], size_t row,
                                       const double x[3])
{
    for (int i = 0; i < 3; i++)
        if (column[i])
            column[i][row] = x[i];
}

/* The members that the columns need. */
static inline unsigned cylint_wanted_of_closest(
    const cylint_closest_columns *to)
{
    return (to->part || to->feature ? CYLINT_WANT_PART : 0u) |
           (cylint_has_vector(to->point) ? CYLINT_WANT_POINT : 0u) |
           (cylint_has_vector(to->normal) ? CYLINT_WANT_NORMAL : 0u);
}

static inline void cylint_write_closest(const cylint_closest_columns *to,
                                        size_t row,
                                        const cylint_closest *answer)
{
    if (to->distance)
        to->distance[row] = answer->distance;
    if (to->part)
        to->part[row] = (signed char)answer->part;
    if (to->feature)
        to->feature[row] = (signed char)answer->feature;
    cylint_write_vector(to->point, row, answer->point);
    cylint_write_vector(to->normal, row, answer->normal);
}

#endif
