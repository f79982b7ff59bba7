/*
 * columns.h - the columns of many distances
 */
#ifndef CYLINT_DISTANCE_COLUMNS_H
#define CYLINT_DISTANCE_COLUMNS_H

#include "cylint_distance.h"

/* The members that the columns need. */
static inline unsigned cylint_wanted_of_closest(
    const cylint_closest_columns *to)
{
    return (to->part || to->feature ? CYLINT_WANT_PART : 0u) |
           (to->point[0] || to->point[1] || to->point[2] ? CYLINT_WANT_POINT
                                                         : 0u) |
           (to->normal[0] || to->normal[1] || to->normal[2] ? CYLINT_WANT_NORMAL
                                                            : 0u);
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
    for (int i = 0; i < 3; i++) {
        if (to->point[i])
            to->point[i][row] = answer->point[i];
        if (to->normal[i])
            to->normal[i][row] = answer->normal[i];
    }
}

#endif
