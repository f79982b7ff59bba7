/*
 * elliptic.c - the distance of elliptic kinds
 *
 * Not computed yet: the answer has the flag of a refused shape.
 */
#include "elliptic.h"

#include <math.h>

double cylint_elliptic_distance(const cylint_shape *shape,
                                const double point[3], unsigned want,
                                cylint_closest *answer)
{
    (void)shape;
    (void)point;
    (void)want;
    answer->flags = CYLINT_FLAG_INVALID;
    answer->part = -1;
    return answer->distance = HUGE_VAL;
}
