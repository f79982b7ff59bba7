/*
 * float_bounds.h - boxes of floats, rounded outward
 */
#ifndef CYLINT_BVH_FLOAT_BOUNDS_H
#define CYLINT_BVH_FLOAT_BOUNDS_H

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "../numbers/compiler.h"

/* The float `places` floats above x, below it if negative; no subnormal floats
 * between. */
static inline float cylint_float_after(float x, int places)
{
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    bits += (uint32_t)places * (1 - 2 * (bits >> 31));
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* The least float not below x, except subnormal floats: a thread may flush them
 * to zero, and Embree's threads do.  The rounding is unpredictable, so the code
 * has no branch. */
static inline float cylint_float_above(double x)
{
    if (fabs(x) < (double)FLT_MIN)
        return x > 0 ? FLT_MIN : 0;
    const float f = (float)x;
    return cylint_float_after(f, (double)f < x);
}

/* Whether cylint_float_above() is f for every number within e of x, and none of
 * these numbers is subnormal. */
static inline int cylint_is_float_above(float f, double x, double e)
{
    return fabs(x) - e > 2 * (double)FLT_MIN && x + e <= (double)f &&
           x - e > (double)cylint_float_after(f, -1);
}

/* The largest float not above x, except subnormal floats. */
static inline float cylint_float_below(double x)
{
    return -cylint_float_above(-x);
}

/* A bfloat16: the upper 16 bits of a float.  This one is not above x >= 0. */
static inline uint16_t cylint_bfloat16_below(double x)
{
    const float f = cylint_float_below(x);
    uint32_t bits;
    memcpy(&bits, &f, sizeof bits);
    return (uint16_t)(bits >> 16);
}

static inline float cylint_float_of_bfloat16(uint16_t half)
{
    const uint32_t bits = (uint32_t)half << 16;
    float f;
    memcpy(&f, &bits, sizeof f);
    return f;
}

/* A box of floats. */
typedef struct cylint_extent {
    float lower[3], upper[3];
} cylint_extent;

static inline cylint_extent cylint_float_box(const double lo[3],
                                             const double hi[3])
{
    return (cylint_extent){
        {cylint_float_below(lo[0]), cylint_float_below(lo[1]),
         cylint_float_below(lo[2])},
        {cylint_float_above(hi[0]), cylint_float_above(hi[1]),
         cylint_float_above(hi[2])}};
}

/* FLT_LARGE in Embree's sources.  Embree silently drops a primitive whose box
 * is empty or has a coordinate at or beyond this. */
#define CYLINT_EXTENT_LIMIT 1.844e18f

static inline int cylint_extent_is_valid(const cylint_extent *box)
{
    int valid = 1;
    EACH(j, 3)
        valid &= (-CYLINT_EXTENT_LIMIT < box->lower[j]) &
                 (box->lower[j] <= box->upper[j]) &
                 (box->upper[j] < CYLINT_EXTENT_LIMIT);
    return valid;
}

/* The empty box. */
static inline cylint_extent cylint_extent_empty(void)
{
    return (cylint_extent){{HUGE_VALF, HUGE_VALF, HUGE_VALF},
                           {-HUGE_VALF, -HUGE_VALF, -HUGE_VALF}};
}

static inline void cylint_extent_include(cylint_extent *box,
                                         const cylint_extent *by)
{
    EACH(j, 3) { /* fminf() is a call */
        const float lower = by->lower[j], upper = by->upper[j];
        box->lower[j] = lower < box->lower[j] ? lower : box->lower[j];
        box->upper[j] = upper > box->upper[j] ? upper : box->upper[j];
    }
}

/* Half the area of a box with these sides. */
static inline double cylint_half_area(const double side[3])
{
    return side[0] * side[1] + side[1] * side[2] + side[2] * side[0];
}

#endif
