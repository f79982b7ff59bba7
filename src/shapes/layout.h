/*
 * layout.h - the members of a shape that are the library's
 *
 * cylint_shape has them as two arrays, so that its header shows none of them, and
 * so that the filter loads four neighbours at once.
 */
#ifndef CYLINT_LAYOUT_H
#define CYLINT_LAYOUT_H

#include "../numbers/compiler.h"
#include "cylint.h"

/* Of library.flag. */
enum {
    CYLINT_AT_IN_RANGE,   /* 1: doubles neither over- nor underflow */
    CYLINT_AT_PREPARED,   /* the solid (shape_facts.h), or 0: the local
                             coordinates are not accurate */
    CYLINT_AT_SURFACE,    /* sphere: the cylint_part that it is */
    CYLINT_AT_LEFT_HANDED /* elliptic: 1 where a.(b x h) < 0 */
};

/*
 * Of library.number.  Those of the local coordinates are explained in local.h.
 * From CYLINT_AT_COLUMNS to CYLINT_AT_SINE they are pairs: the low part of a number
 * stands CYLINT_LOW after it.
 */
enum {
    CYLINT_AT_BASE = 0, /* p0, c, or the apex v */
    /* radii at z = 0, 1; elliptic: 1, k; acone: 0 and the tangent of the half
     * angle */
    CYLINT_AT_R0 = 3,
    CYLINT_AT_R1 = 4,
    CYLINT_AT_COLUMNS = 5, /* (x, y, z): the sum of (P - base)[i] column i */
    CYLINT_AT_HEIGHT = 14, /* z of the top */
    CYLINT_AT_SLOPE,       /* of the lateral surface */
    CYLINT_AT_COSINE,      /* of the angle between axis and lateral surface; */
    CYLINT_AT_SINE,        /* circular and round kinds */
    CYLINT_AT_NORM,        /* of the matrix */
    CYLINT_AT_REACH,       /* height + the larger radius */
    CYLINT_LOW = 15,
    CYLINT_AT_ERROR = 33, /* of the matrix in pairs, relative to its norm */
    CYLINT_AT_AXIS = 34,  /* p1 - p0, h, or u: the nearest doubles */
    CYLINT_AT_TOP = 37,   /* p1; kinds made of two points only */
    CYLINT_AT_A = 40,     /* elliptic kinds: conjugate semi-axes */
    CYLINT_AT_B = 43,
    /* the error of an operation on doubles, and of the local coordinates in
     * doubles (error_bounds.h) */
    CYLINT_AT_UNIT = 46,
    CYLINT_NUMBERS = 47
};

/* The members by name: cylint_in_range(s), cylint_base(s), cylint_height(s). */
#define CYLINT_FLAG(name, at)                              \
    CYLINT_INLINE int cylint_##name(const cylint_shape *s) \
    {                                                      \
        return s->library.flag[at];                        \
    }
#define CYLINT_VECTOR(name, at)                                      \
    CYLINT_INLINE const double *cylint_##name(const cylint_shape *s) \
    {                                                                \
        return s->library.number + (at);                             \
    }
#define CYLINT_NUMBER(name, at)                               \
    CYLINT_INLINE double cylint_##name(const cylint_shape *s) \
    {                                                         \
        return s->library.number[at];                         \
    }
CYLINT_FLAG(in_range, CYLINT_AT_IN_RANGE)
CYLINT_FLAG(prepared, CYLINT_AT_PREPARED)
CYLINT_FLAG(surface, CYLINT_AT_SURFACE)
CYLINT_FLAG(left_handed, CYLINT_AT_LEFT_HANDED)
CYLINT_VECTOR(base, CYLINT_AT_BASE)
CYLINT_VECTOR(top, CYLINT_AT_TOP)
CYLINT_VECTOR(axis, CYLINT_AT_AXIS)
CYLINT_VECTOR(a, CYLINT_AT_A)
CYLINT_VECTOR(b, CYLINT_AT_B)
CYLINT_VECTOR(radii, CYLINT_AT_R0) /* r0 and r1 */
CYLINT_NUMBER(r0, CYLINT_AT_R0)
CYLINT_NUMBER(r1, CYLINT_AT_R1)
CYLINT_NUMBER(height, CYLINT_AT_HEIGHT)
CYLINT_NUMBER(slope, CYLINT_AT_SLOPE)
CYLINT_NUMBER(cosine, CYLINT_AT_COSINE)
CYLINT_NUMBER(sine, CYLINT_AT_SINE)
CYLINT_NUMBER(norm, CYLINT_AT_NORM)
CYLINT_NUMBER(reach, CYLINT_AT_REACH)
CYLINT_NUMBER(frame_error, CYLINT_AT_ERROR)
CYLINT_NUMBER(unit, CYLINT_AT_UNIT)
#undef CYLINT_FLAG
#undef CYLINT_VECTOR
#undef CYLINT_NUMBER

/* Column i of the matrix.  Another number of the shape follows. */
CYLINT_INLINE const double *cylint_column(const cylint_shape *s, int i)
{
    return s->library.number + CYLINT_AT_COLUMNS + 3 * i;
}

CYLINT_INLINE const double *cylint_column_lo(const cylint_shape *s, int i)
{
    return cylint_column(s, i) + CYLINT_LOW;
}

#endif
