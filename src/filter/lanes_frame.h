/*
 * lanes_frame.h - the local coordinates of a capsule or rounded cone in each lane
 */
#ifndef CYLINT_LANES_FRAME_H
#define CYLINT_LANES_FRAME_H

#include "cylint.h"
#include "../numbers/simd.h"

/* See cylint_local in cylint.h.  axis_lo: of the row of z. */
typedef struct {
    vd xyz[3][3], axis_lo[3], height, slope, norm, reach, error;
    vd cosine, sine, cosine_lo, sine_lo;
} lanes_frame;

/* The same in all lanes. */
INLINE void broadcast_frame(lanes_frame *to, const cylint_local *f)
{
    EACH(i, 3) {
        EACH(j, 3)
            to->xyz[i][j] = v_set(f->xyz[i][j]);
        to->axis_lo[i] = v_set(f->xyz_lo[i][2]);
    }
    to->height = v_set(f->height);
    to->slope = v_set(f->slope);
    to->norm = v_set(f->norm);
    to->reach = v_set(f->reach);
    to->error = v_set(f->error);
    to->cosine = v_set(f->cosine);
    to->sine = v_set(f->sine);
    to->cosine_lo = v_set(f->cosine_lo);
    to->sine_lo = v_set(f->sine_lo);
}

/* Those of the shapes, each of which begins at shape[lane].  Returns r1, which
 * precedes them. */
INLINE vd frame_at(lanes_frame *f, const char *const shape[LANES])
{
/* four members in a row, from `name` on */
#define MEMBERS(name) v_columns(shape, offsetof(cylint_shape, name), four)
    vd four[4];
    MEMBERS(r1); /* r1, dr, dr_lo, xyz[0][0] */
    const vd r1 = four[0];
    f->xyz[0][0] = four[3];
    MEMBERS(local.xyz[0][1]);
    f->xyz[0][1] = four[0];
    f->xyz[0][2] = four[1];
    f->xyz[1][0] = four[2];
    f->xyz[1][1] = four[3];
    MEMBERS(local.xyz[1][2]);
    f->xyz[1][2] = four[0];
    EACH(i, 3)
        f->xyz[2][i] = four[i + 1];
    MEMBERS(local.height); /* height, slope, norm, reach */
    f->height = four[0];
    f->slope = four[1];
    f->norm = four[2];
    f->reach = four[3];
    MEMBERS(local.cosine); /* cosine, sine */
    f->cosine = four[0];
    f->sine = four[1];
    MEMBERS(local.xyz_lo[0][2]);
    f->axis_lo[0] = four[0];
    f->axis_lo[1] = four[3];
    MEMBERS(local.xyz_lo[2][2]); /* and height_lo, slope_lo, error */
    f->axis_lo[2] = four[0];
    f->error = four[3];
    MEMBERS(local.cosine_lo); /* and sine_lo */
    f->cosine_lo = four[0];
    f->sine_lo = four[1];
#undef MEMBERS
    return r1;
}

#endif
