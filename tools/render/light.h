/*
 * light.h - the colour along a line, and a picture of such lines
 */
#ifndef CYLINT_LIGHT_H
#define CYLINT_LIGHT_H

#include <stddef.h>
#include <stdint.h>

#include "cylint.h"
#include "cylint_scene.h"
#include "picture.h"
#include "vector.h"

enum shading {
    SHADE_LIGHT, /* sun with shadows, and the visible sky */
    SHADE_PLAIN, /* by the angle to the viewer; no further rays */
    SHADE_NORMAL /* the normal's coordinates as red, green and blue */
};

/* The background, from the picture's upper edge to its lower one. */
struct backdrop {
    int is_transparent;
    struct vector top, bottom;
};

/* The scene and its light. */
struct stage {
    const cylint_scene *scene;
    size_t count;            /* the number of shapes; the ground is the last */
    const uint32_t *colours; /* of shapes, 0xrrggbb */
    int has_solids; /* made of several shapes: their first boundaries are drawn */
    int has_ground;
    struct vector middle; /* of the scene without the ground */
    double size;
    enum shading shading;
    struct vector sun; /* unit vector towards it */
    struct vector up;  /* unit vector */
    struct backdrop backdrop;
};

/* Fills the picture, on several threads.  Returns 0 or an exit status. */
int trace(const struct drawing *drawing, const struct stage *stage);

#endif
