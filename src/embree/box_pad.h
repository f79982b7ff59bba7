/*
 * box_pad.h - boxes that Embree's walk does not pass by
 */
#ifndef CYLINT_EMBREE_BOX_PAD_H
#define CYLINT_EMBREE_BOX_PAD_H

#include <math.h>

#include "../bvh/float_bounds.h"
#include "api.h"

/*
 * Boxes are widened by what Embree's walk errs.  For user geometries it knows
 * no robust mode, RTC_SCENE_FLAG_ROBUST or not.  Where a ray crosses a face b
 * it computes b r - o r, fused or not, in floats, r being about 1 / d: an
 * estimate, off by 1.5 2^-12 at most, and a Newton step, which squares that
 * and rounds three times, so off by less than 6 2^-24.  The products round by
 * 2^-24 of |b| and |o|, and so does their difference: it errs by at most |r|
 * times
 *
 *     2^-24 (6 |b - o| + |b| + |o| + |b - o|)
 *     <= 2^-21 |b - o| + 2^-23 |b|,         for |o| <= |b| + |b - o|,
 *
 * which is what moving the face by the latter does.  Faces are moved out by
 * as much for origins within so many sizes of the geometry's box, a size
 * S being its longest side, where |b - o| <= (sizes + 1) S; M is its largest
 * coordinate.
 *
 * That also settles which of two shapes hit at nearly the same t is nearer:
 * only the shapes can tell, but Embree passes by a box whose entry, as it
 * computes it, is beyond tfar (single rays), or not below it (packets).
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

/* The padded box, still one that Embree keeps. */
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
