/*
 * bounds.h - boxes for Embree: float, outward, and whether it keeps them
 */
#ifndef CYLINT_EMBREE_BOUNDS_H
#define CYLINT_EMBREE_BOUNDS_H

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "../each.h"
#include "api.h"

/* The float so many places after x; no subnormal ones between. */
static inline float cylint_float_after(float x, int places)
{
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    bits += (uint32_t)places * (1 - 2 * (bits >> 31));
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* The least float not below x, subnormal floats left out: Embree's threads
 * take them for zero.  Whether that is the next one cannot be foreseen, so
 * there is no branch. */
static inline float cylint_float_above(double x)
{
    if (fabs(x) < (double)FLT_MIN)
        return x > 0 ? FLT_MIN : 0;
    const float f = (float)x;
    return cylint_float_after(f, (double)f < x);
}

/* Whether f is that of all numbers within e of x, none of them subnormal. */
static inline int cylint_is_float_above(float f, double x, double e)
{
    return fabs(x) - e > 2 * (double)FLT_MIN && x + e <= (double)f &&
           x - e > (double)cylint_float_after(f, -1);
}

/* The largest not above it, likewise. */

static inline float cylint_float_below(double x)
{
    return -cylint_float_above(-x);
}

/* The upper half of a float that is not above x >= 0, and the float of it. */
static inline uint16_t cylint_half_below(double x)
{
    const float f = cylint_float_below(x);
    uint32_t bits;
    memcpy(&bits, &f, sizeof bits);
    return (uint16_t)(bits >> 16);
}

/* That of one that is not below it, likewise. */
static inline uint16_t cylint_half_above(double x)
{
    const float f = cylint_float_above(x);
    uint32_t bits;
    memcpy(&bits, &f, sizeof bits);
    return (uint16_t)((bits + 0xffff) >> 16);
}

static inline float cylint_float_of_half(uint16_t half)
{
    const uint32_t bits = (uint32_t)half << 16;
    float f;
    memcpy(&f, &bits, sizeof f);
    return f;
}

static inline struct RTCBounds cylint_float_box(const double lo[3],
                                                const double hi[3])
{
    return (struct RTCBounds){
        cylint_float_below(lo[0]), cylint_float_below(lo[1]),
        cylint_float_below(lo[2]), 0,
        cylint_float_above(hi[0]), cylint_float_above(hi[1]),
        cylint_float_above(hi[2]), 0};
}

/* Embree drops, without a word, primitives whose box is empty or not within
 * this, FLT_LARGE of its sources. */
#define CYLINT_EMBREE_LARGE 1.844e18f

static inline int cylint_keeps_side(float lo, float hi)
{
    return -CYLINT_EMBREE_LARGE < lo && lo <= hi && hi < CYLINT_EMBREE_LARGE;
}

static inline int cylint_keeps_box(const struct RTCBounds *box)
{
    return cylint_keeps_side(box->lower_x, box->upper_x) &&
           cylint_keeps_side(box->lower_y, box->upper_y) &&
           cylint_keeps_side(box->lower_z, box->upper_z);
}

/* That of nothing. */
static inline struct RTCBounds cylint_no_box(void)
{
    return (struct RTCBounds){HUGE_VALF, HUGE_VALF, HUGE_VALF, 0,
                              -HUGE_VALF, -HUGE_VALF, -HUGE_VALF, 0};
}

static inline void cylint_extend_side(float *lower, float *upper, float lo,
                                      float hi) /* fminf() is a call */
{
    *lower = lo < *lower ? lo : *lower;
    *upper = hi > *upper ? hi : *upper;
}

static inline void cylint_extend_box(struct RTCBounds *box,
                                     const struct RTCBounds *by)
{
    cylint_extend_side(&box->lower_x, &box->upper_x, by->lower_x, by->upper_x);
    cylint_extend_side(&box->lower_y, &box->upper_y, by->lower_y, by->upper_y);
    cylint_extend_side(&box->lower_z, &box->upper_z, by->lower_z, by->upper_z);
}

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
static inline double cylint_box_pad(const struct RTCBounds *all, int sizes)
{
    const double x = (double)all->upper_x - (double)all->lower_x;
    const double y = (double)all->upper_y - (double)all->lower_y;
    const double z = (double)all->upper_z - (double)all->lower_z;
    const double M = fmax(
        fmax(fmax(fabs((double)all->lower_x), fabs((double)all->lower_y)),
             fmax(fabs((double)all->lower_z), fabs((double)all->upper_x))),
        fmax(fabs((double)all->upper_y), fabs((double)all->upper_z)));
    return 0x1p-21 * (sizes + 1) * fmax(x, fmax(y, z)) + 0x1p-23 * M;
}

/* The padded box, still one that Embree keeps. */
static inline struct RTCBounds cylint_padded_box(const struct RTCBounds *box,
                                                 double pad)
{
    const double most = (double)CYLINT_EMBREE_LARGE * (1 - 0x1p-23);
    const double lo[3] = {fmax(box->lower_x - pad, -most),
                          fmax(box->lower_y - pad, -most),
                          fmax(box->lower_z - pad, -most)};
    const double hi[3] = {fmin(box->upper_x + pad, most),
                          fmin(box->upper_y + pad, most),
                          fmin(box->upper_z + pad, most)};
    return cylint_float_box(lo, hi);
}

#endif
