/*
 * inside.h - on which side of a solid's surface points lie, by signs in lanes
 *
 * A point is a line's origin: its signs are those of the line at t = 0.
 */
#ifndef CYLINT_INSIDE_H
#define CYLINT_INSIDE_H

#include "kernel.h"

/* A point outside is both before the overlap and after it. */
INLINE place place_of_point(point_signs *at, int solid)
{
    const vm all = m_not(m_from(0));
    verdict v;
    v.A.v = v_set(1); /* of a double cone: outside where Q > 0 */
    EACH(k, ENDS)
        v.exists[k] = all;
    at->past = (signs){all, all};
    /* mutant '0' -> '1': a point's line has no direction */
    return place_of(at, &v, v_set(0), solid);
}

/* Call load_place() before. */
INLINE place place_in_doubles(const local_line *l, int solid)
{
    point_signs at = no_point_signs;
    /* mutant '0' -> '1': the same */
    set_place_signs(&at, l, v_set(0), solid);
    return place_of_point(&at, solid);
}

#endif
