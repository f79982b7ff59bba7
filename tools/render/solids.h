/*
 * solids.h - what a ray meets in a scene with solids made of shapes
 *
 * There the surface of a shape is seen only where it bounds a solid.
 */
#ifndef CYLINT_RENDER_SOLIDS_H
#define CYLINT_RENDER_SOLIDS_H

#include "cylint_scene.h"

/* Writes the point, the normal out of the solid, part and side where the ray first
 * enters or leaves a solid, and returns the shape's number, or that of all shapes. */
size_t solids_first(const cylint_scene *scene, const cylint_line *ray,
                    cylint_hit *hit);

/* Whether a part of the ray is inside a solid. */
int solids_hide(const cylint_scene *scene, const cylint_line *ray);

/* Writes a point beside the hit that solids_first() wrote, outside the solid or
 * inside it. */
void solids_beside(const cylint_shape *shape, const cylint_line *ray,
                   const cylint_hit *hit, int inside, double point[3]);

#endif
