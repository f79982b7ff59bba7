/*
 * picture.h - computes rows of pixels, and writes them to a PNG file
 */
#ifndef CYLINT_PICTURE_H
#define CYLINT_PICTURE_H

#include "output.h"

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

#endif
