/*
 * box_pad.h - boxes padded by the rounding error of Embree's traversal
 */
#ifndef CYLINT_EMBREE_BOX_PAD_H
#define CYLINT_EMBREE_BOX_PAD_H

#include <math.h>

#include "../bvh/float_bounds.h"
#include "api.h"

/*
 * Each face is moved out by the error of Embree's traversal, which has no robust
 * mode for user geometries, with or without RTC_SCENE_FLAG_ROBUST.  Embree
 * computes where a ray crosses a face b as b r - o r in floats, fused or not,
 * where r is about 1 / d: an estimate with an error of at most 1.5 2^-12, then a
 * Newton step, which squares that error and rounds three times: less than
 * 6 2^-24.  The products round by 2^-24 of |b| and |o|, and so does their
 * difference.  The error is at most |r| times
 *
 *     2^-24 (6 |b - o| + |b| + |o| + |b - o|)
 *     <= 2^-21 |b - o| + 2^-23 |b|,         for |o| <= |b| + |b - o|,
 *
 * and moving the face by that compensates it.  Faces are moved for origins within
 * `sizes` sizes of the geometry's box, where |b - o| <= (sizes + 1) S; a size S
 * is the longest side of the box, M its largest coordinate.
 *
 * The padding also keeps Embree from choosing between shapes hit at nearly the
 * same t: it skips a box whose computed entry is beyond tfar (single rays) or
 * not below it (packets).
 */
static inline double cylint_box_pad(const cylint_extent *all, int sizes)
{
    double S = 0, M = 0;
    for (int j = 0; j < 3; j++) {
        const double lower = all->lower[j], upper = all->upper[j];
        S = fmax(S, upper - lower);
        M = fmax(M, fmax(fabs(lower), fabs(upper)));
    }
    return 0x1p-21 * (sizes + 1) * S + 0x1p-23 * M;
}

/* The padded box, within the limits of Embree. */
static inline struct RTCBounds cylint_padded_box(const cylint_extent *box,
                                                 double pad)
{
    const double most = (double)CYLINT_EXTENT_LIMIT * (1 - 0x1p-23);
    double lo[3], hi[3];
    for (int j = 0; j < 3; j++) {
        lo[j] = fmax(box->lower[j] - pad, -most);
        hi[j] = fmin(box->upper[j] + pad, most);
    }
    const cylint_extent wider = cylint_float_box(lo, hi);
    return (struct RTCBounds){
        wider.lower[0], wider.lower[1], wider.lower[2], 0,
        wider.upper[0], wider.upper[1], wider.upper[2], 0};
}

#endif
