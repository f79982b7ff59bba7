/*
 * frame.h - lines of doubles in the floats of a scene's own coordinates
 *
 * Embree's rays and boxes are floats.  Floats near 0 and below 1 are fine
 * enough, so a scene is moved and scaled to lie there, and of every line
 * only the piece within the scene's box becomes floats.
 */
#ifndef CYLINT_FRAME_H
#define CYLINT_FRAME_H

#include "cylint.h"

/* What is x for the caller is (x - center) scale here, within [-1, 1]. */
typedef struct {
    double center[3], lo[3], hi[3];
    double scale; /* a power of two */
} cylint_frame;

/* Data beyond 2^+-CYLINT_FRAME_RANGE are not framed: nothing over- or
 * underflows then. */
#define CYLINT_FRAME_MOST 0x1p400
#define CYLINT_FRAME_LEAST 0x1p-400

/*
 * How far boxes reach beyond what they hold, in the frame: as far as a line
 * can be from its float ray, and what the box's own floats miss.  In units
 * of 2^-24, the most that rounding to a float below 2 errs by: the ray's
 * origin, below 2, 1; its direction, components at most 1, over a length of
 * at most 2.5, 2.5; the box 1; all that is done in doubles before, less than
 * 1/2 (cylint_frame_line).  Flushed subnormals err by 2^-126, and the sides
 * of boxes that are rounded outward only gain.  And Embree's walk errs
 * (bounds.h): at a face b, |b| <= 1, that the ray crosses within its length,
 * |b - o| <= 2.5, by 6 |b - o| for its reciprocal, |b| + |o| for the products
 * and |b - o| for the difference, together 20.5.
 */
#define CYLINT_FRAME_PAD 0x1ap-24

/* A line's piece within the frame: o + s d, 0 <= s <= length, where
 * t = entry + s / per_t, components of d at most 1. */
typedef struct {
    double o[3], d[3], length;
    double entry, per_t;
} cylint_frame_ray;

/* How far such a ray may be from its line, while still in doubles. */
#define CYLINT_FRAME_BLUR 0x1p-50

typedef enum {
    CYLINT_FRAME_PASSED,  /* the line has no point in the frame's box */
    CYLINT_FRAME_ENTERED, /* the ray is made */
    CYLINT_FRAME_WILD     /* no float ray is certainly near enough */
} cylint_frame_verdict;

/* The frame that holds the box.  0 if it cannot be framed. */
int cylint_frame_make(cylint_frame *frame, const double lo[3],
                      const double hi[3]);

/* Every point of the line's domain within the frame's box is within
 * CYLINT_FRAME_BLUR of the ray's point at its s, and within CYLINT_FRAME_PAD,
 * less a box's rounding, when the ray is rounded to floats; d is off by
 * 2^-52 of itself. */
cylint_frame_verdict cylint_frame_line(const cylint_frame *frame,
    const cylint_line *line, cylint_frame_ray *ray);

/* What is not below the s of any root that rounds to t or less; and a float
 * not below s. */
double cylint_frame_reach(const cylint_frame_ray *ray, double t);
float cylint_frame_float(double s);

#endif
