/*
 * float_filter.h - hits of float rays, computed in doubles with error bounds
 *
 * For circular and round shapes, most questions by far.  An answer
 * is what cylint_intersect() returns, as far as floats show it, or UNCERTAIN.
 */
#ifndef CYLINT_EMBREE_FLOAT_FILTER_H
#define CYLINT_EMBREE_FLOAT_FILTER_H

#include <float.h>

#include "../bvh/swept_disc.h"
#include "../shapes/record.h"

typedef enum {
    CYLINT_FLOAT_FILTER_UNCERTAIN = -1, /* cylint_intersect() must decide */
    CYLINT_FLOAT_FILTER_MISS,           /* no hit in the domain */
    CYLINT_FLOAT_FILTER_HIT             /* t as a float is less than tfar */
} cylint_float_filter_result;

enum { CYLINT_HIT_FLOATS = 5 };

/*
 * A ray, the question which is its first hit on a piece of a shape, and the
 * answer.  o, d and near are floats, not checked yet.  near: a t near the shape, or
 * not finite if none is known.
 */
typedef struct cylint_float_filter_question {
    double o[3], d[3], tmin, near;
    /* of the shape; of a round kind with negative radii, of an angle cone with the
     * negative tangent as r0; NaN radii: the filter does not decide the shape */
    cylint_record record;
    float tfar;
    int ends; /* the shape's */
    cylint_shape_piece piece;
    int exit_only; /* only where the line leaves the shape */
    int describes; /* `floats` are wanted */
    /* the answer; of a HIT: t rounded up to a float, whether the line leaves the
     * shape there, and the floats if they are wanted: the normal, z and phi, equal
     * to the library's doubles rounded to floats */
    cylint_float_filter_result is;
    float t;
    int leaves;
    float floats[CYLINT_HIT_FLOATS];
} cylint_float_filter_question;

/* phi as a float below 1. */
static inline float cylint_angle_as_float(double phi)
{
    const float v = (float)phi;
    return v < 1 ? v : 1 - FLT_EPSILON / 2;
}

/* Answers n questions. */
typedef void cylint_float_filter(cylint_float_filter_question *const of[],
                                 int n);

/* The build in use for one question, or for many. */
cylint_float_filter *cylint_float_filter_used(int many);

/* All builds: two with one lane, and two with several. */
extern cylint_float_filter cylint_float_filter_plain, cylint_float_filter_fma,
    cylint_float_filter_avx2, cylint_float_filter_avx512;

#endif
