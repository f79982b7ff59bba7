/*
 * frame.h - the coordinates of a scene's hierarchy
 *
 * Nodes and leaves consist of floats.  Floats below 1 are accurate enough and do
 * not overflow, so the hierarchy uses coordinates in which the scene lies within
 * [-1, 1], and each line is clipped to the scene's box.
 */
#ifndef CYLINT_SCENE_FRAME_H
#define CYLINT_SCENE_FRAME_H

#include "../bvh/distant.h"
#include "../bvh/traverse.h"

/* A box of the caller's, and the view of the scene's shapes in which it lies within
 * [-1, 1]. */
typedef struct {
    double lo[3], hi[3];
    cylint_view view;
} cylint_frame;

/* Smaller boxes have no frame, so that nothing underflows. */
#define CYLINT_FRAME_LEAST 0x1p-400

/* The part of a line within the frame: o + s d, 0 <= s <= tmax, where
 * t = entry + s / per_t and no component of d is larger than 1. */
typedef struct {
    cylint_bvh_line line;
    double entry, per_t;
} cylint_frame_ray;

/* The largest error of the points of such a ray, in the frame's coordinates. */
#define CYLINT_FRAME_ERROR 0x1p-50

typedef enum {
    CYLINT_FRAME_MISSED,  /* the line has no point in the frame's box */
    CYLINT_FRAME_ENTERED, /* *ray is written */
    CYLINT_FRAME_UNUSABLE /* the error of the ray may be too large */
} cylint_frame_status;

/* Makes a box larger so that its frame is the same in every rounding mode: a file
 * keeps the box alone. */
void cylint_frame_round_box(double lo[3], double hi[3]);

/* Makes the frame of the box, but for the shapes of the view.  Returns 0 if the box
 * has none. */
int cylint_frame_make(cylint_frame *frame, const double lo[3],
                      const double hi[3]);

/* Every point of the line's domain within the frame's box is within
 * CYLINT_FRAME_ERROR of the ray's point at its s.  d has an error of 2^-52 of
 * itself. */
cylint_frame_status cylint_frame_line(const cylint_frame *frame,
                                      const cylint_line *line,
                                      cylint_frame_ray *ray);

/* An upper bound of the s of every root that rounds to t or less. */
double cylint_frame_reach(const cylint_frame_ray *ray, double t);

#endif
