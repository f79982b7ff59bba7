/*
 * record_frames.h - the local coordinates of shapes that are kept as records, in
 * lanes
 *
 * The wide text of shapes/upright_template.h, with the errors that it states; so
 * the bounds of error_bounds.h hold.
 */
#ifndef CYLINT_RECORD_FRAMES_H
#define CYLINT_RECORD_FRAMES_H

#include <stddef.h>

#include "../shapes/record.h"
#include "wide_frame.h"

#define CYLINT_WIDE
#include "../shapes/upright_template.h"

INLINE void set_pair(frames *to, int at, vpair x)
{
    to->of[at] = x.hi;
    to->of[at + CYLINT_LOW] = x.lo;
}

INLINE void set_row(frames *to, int row, const four *x)
{
    EACH(i, 3)
        set_pair(to, CYLINT_AT_COLUMNS + 3 * i + row, x->part[i]);
}

/* Of a cylinder, cone, capsule or round cone with accurate local coordinates and
 * both caps. */
ASIDE void frames_of_records(frames *to, const char *const record[LANES],
                             int solid)
{
    const int is_hull = solid == CYLINT_SOLID_ROUND_CONE;
    vd base[4], top[4];
    four axis;
    rows m;
    v_columns(record, offsetof(cylint_record, p0), base);
    v_columns(record, offsetof(cylint_record, p1), top);
    EACH(i, 4)
        axis.part[i] = v_two_sum(top[i], -base[i]);
    const inverse_lengths inverse =
        upright_rows(&m, &axis, is_hull ? -1 : 1, 0, NULL);
    const vpair height = last_of(&m.x), slope = last_of(&m.z);
    EACH(i, 4)
        to->of[CYLINT_AT_BASE + i] = base[i]; /* and r0 */
    to->of[CYLINT_AT_R1] = top[3];
    set_row(to, 0, &m.x);
    set_row(to, 1, &m.y);
    set_row(to, 2, &m.z);
    set_pair(to, CYLINT_AT_HEIGHT, height);
    set_pair(to, CYLINT_AT_SLOPE, slope);
    to->of[CYLINT_AT_ERROR] = v_set(CYLINT_LOCAL_ERROR);
    if (is_hull) {
        const vpair cosine = cosine_of_hull(&inverse);
        set_pair(to, CYLINT_AT_SINE, slope);
        set_pair(to, CYLINT_AT_COSINE, cosine);
        set_pair(to, CYLINT_AT_SLOPE, one_mul(axis.part[3], inverse.lateral));
        to->of[CYLINT_AT_ERROR] =
            v_set(CYLINT_LOCAL_ERROR) / (cosine.hi * cosine.hi);
    }
    to->of[CYLINT_AT_NORM] = v_set(CYLINT_LOCAL_NORM * CYLINT_SLACK);
    to->of[CYLINT_AT_REACH] =
        (height.hi + v_max(base[3], top[3])) * v_set(CYLINT_SLACK);
    to->fact[FACT_CAP0] = to->fact[FACT_CAP1] = m_if_all(1);
}

#endif
