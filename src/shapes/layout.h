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
 * From CYLINT_AT_COLUMNS on they are pairs: the low part of a number stands
 * CYLINT_LOW after it.
 */
enum {
    CYLINT_AT_BASE = 0, /* p0, c, or the apex v */
    CYLINT_AT_R0 = 3,   /* radii at z = 0, 1; elliptic: 1, k; acone: 0 and the
                              tangent of the half angle */
    CYLINT_AT_R1 = 4,   /* */
    CYLINT_AT_COLUMNS = 5, /* x, y, z gain (P - base)[i] times column i */
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
    CYLINT_NUMBERS = 46
};

CYLINT_INLINE int cylint_in_range(const cylint_shape *s)
{
    return s->library.flag[CYLINT_AT_IN_RANGE];
}

CYLINT_INLINE int cylint_prepared(const cylint_shape *s)
{
    return s->library.flag[CYLINT_AT_PREPARED];
}

CYLINT_INLINE int cylint_surface(const cylint_shape *s)
{
    return s->library.flag[CYLINT_AT_SURFACE];
}

CYLINT_INLINE int cylint_left_handed(const cylint_shape *s)
{
    return s->library.flag[CYLINT_AT_LEFT_HANDED];
}

CYLINT_INLINE const double *cylint_base(const cylint_shape *s)
{
    return s->library.number + CYLINT_AT_BASE;
}

CYLINT_INLINE const double *cylint_top(const cylint_shape *s)
{
    return s->library.number + CYLINT_AT_TOP;
}

CYLINT_INLINE const double *cylint_axis(const cylint_shape *s)
{
    return s->library.number + CYLINT_AT_AXIS;
}

CYLINT_INLINE const double *cylint_a(const cylint_shape *s)
{
    return s->library.number + CYLINT_AT_A;
}

CYLINT_INLINE const double *cylint_b(const cylint_shape *s)
{
    return s->library.number + CYLINT_AT_B;
}

/* r0 and r1. */
CYLINT_INLINE const double *cylint_radii(const cylint_shape *s)
{
    return s->library.number + CYLINT_AT_R0;
}

CYLINT_INLINE double cylint_r0(const cylint_shape *s)
{
    return s->library.number[CYLINT_AT_R0];
}

CYLINT_INLINE double cylint_r1(const cylint_shape *s)
{
    return s->library.number[CYLINT_AT_R1];
}

/* Column i of the matrix.  Another number of the shape follows. */
CYLINT_INLINE const double *cylint_column(const cylint_shape *s, int i)
{
    return s->library.number + CYLINT_AT_COLUMNS + 3 * i;
}

CYLINT_INLINE const double *cylint_column_lo(const cylint_shape *s, int i)
{
    return cylint_column(s, i) + CYLINT_LOW;
}

CYLINT_INLINE double cylint_height(const cylint_shape *s)
{
    return s->library.number[CYLINT_AT_HEIGHT];
}

CYLINT_INLINE double cylint_slope(const cylint_shape *s)
{
    return s->library.number[CYLINT_AT_SLOPE];
}

CYLINT_INLINE double cylint_cosine(const cylint_shape *s)
{
    return s->library.number[CYLINT_AT_COSINE];
}

CYLINT_INLINE double cylint_sine(const cylint_shape *s)
{
    return s->library.number[CYLINT_AT_SINE];
}

CYLINT_INLINE double cylint_norm(const cylint_shape *s)
{
    return s->library.number[CYLINT_AT_NORM];
}

CYLINT_INLINE double cylint_reach(const cylint_shape *s)
{
    return s->library.number[CYLINT_AT_REACH];
}

CYLINT_INLINE double cylint_frame_error(const cylint_shape *s)
{
    return s->library.number[CYLINT_AT_ERROR];
}

#endif
