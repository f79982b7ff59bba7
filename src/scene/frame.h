/*
 * frame.h - lines of doubles in a scene's own coordinates
 *
 * Nodes and blocks are made of floats.  Floats near 0 and below 1 are fine
 * enough and never overflow, so a scene is moved and scaled to lie there, and
 * of every line only the piece within the scene's box is looked at.
 */
#ifndef CYLINT_SCENE_FRAME_H
#define CYLINT_SCENE_FRAME_H

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

/* A line's piece within the frame: o + s d, 0 <= s <= length, where
 * t = entry + s / per_t, components of d at most 1. */
typedef struct {
    double o[3], d[3], length;
    double entry, per_t;
} cylint_frame_ray;

/* How far such a ray may be from its line, while still in doubles. */
#define CYLINT_FRAME_ERROR 0x1p-50

typedef enum {
    CYLINT_FRAME_MISSED,  /* the line has no point in the frame's box */
    CYLINT_FRAME_ENTERED, /* the ray is made */
    CYLINT_FRAME_UNUSABLE /* no ray is certainly near enough */
} cylint_frame_status;

/* The frame that holds the box.  0 if it cannot be framed. */
int cylint_frame_make(cylint_frame *frame, const double lo[3],
                      const double hi[3]);

/* Every point of the line's domain within the frame's box is within
 * CYLINT_FRAME_ERROR of the ray's point at its s; d is off by 2^-52 of
 * itself. */
cylint_frame_status cylint_frame_line(const cylint_frame *frame,
                                      const cylint_line *line,
                                      cylint_frame_ray *ray);

/* What is not below the s of any root that rounds to t or less. */
double cylint_frame_reach(const cylint_frame_ray *ray, double t);

#endif
