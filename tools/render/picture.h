/*
 * picture.h - draws the rows of a picture, of light or as an X-ray, and writes it
 * to a PNG file
 */
#ifndef CYLINT_PICTURE_H
#define CYLINT_PICTURE_H

#include <stdint.h>

#include "cylint_scene.h"
#include "output.h"
#include "vector.h"

struct picture {
    int width, height;
    int channels;          /* 3: red, green, blue; 4: and opacity; both sRGB,
                              colour not multiplied by opacity.  1: grey, numbers of
                              16 bits, the high byte first, not a colour space */
    unsigned char *pixels; /* height x width x channels, top row first */
    char note[64];         /* a description in the file, if not empty */
};

struct view;

/* How a picture is drawn; its bytes do not depend on the number of workers. */
struct drawing {
    struct picture *picture;
    const struct view *view;
    int samples, workers;
};

/* Computes row y, counted from the top, from what `how` points to.  Returns 0 if
 * there is no memory. */
typedef int row_function(const struct drawing *drawing, const void *how, int y);

/* All return 0, or report the fault and return an exit status. */
/* Calls the function for all rows, on several threads. */
int draw_rows(const struct drawing *drawing, row_function *draw,
              const void *how);
int picture_make(struct picture *picture, int width, int height, int channels);
int picture_write(const struct picture *picture, struct output *out);

void picture_free(struct picture *picture);

/* --------------------------------------------------------------- light -- */

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

/* Fills the picture.  Returns 0 or an exit status. */
int trace(const struct drawing *drawing, const struct stage *stage);

/* -------------------------------------------------------------- X-rays -- */

/* Fills a grey picture of 16 bits and its note: a pixel is exp(-mu length), where
 * length is the mean of those of its rays.  mu 0: it is ln 2 divided by the mean of
 * the lengths of all pixels, without those that are 0 or infinite, so a pixel with
 * the mean length is half as bright as an empty one.  Returns 0 or an exit
 * status. */
int xray_picture(const struct drawing *drawing, double mu,
                 const cylint_scene *scene);

#endif
