/*
 * bounds.h - boxes for Embree: float, outward, and whether it keeps them
 */
#ifndef CYLINT_EMBREE_BOUNDS_H
#define CYLINT_EMBREE_BOUNDS_H

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "api.h"

/* The float after x, which is normal. */
static inline float cylint_next_float(float x)
{
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    bits = bits >> 31 ? bits - 1 : bits + 1;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* The least float not below x, subnormal floats left out: Embree's threads
 * take them for zero. */
static inline float cylint_float_above(double x)
{
    if (fabs(x) < (double)FLT_MIN)
        return x > 0 ? FLT_MIN : 0;
    const float f = (float)x;
    return (double)f < x ? cylint_next_float(f) : f;
}

/* The largest not above it, likewise. */

static inline float cylint_float_below(double x)
{
    return -cylint_float_above(-x);
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

#endif
