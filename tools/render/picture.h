/*
 * picture.h - rows of pixels to a PNG file, whole or not at all
 */
#ifndef CYLINT_PICTURE_H
#define CYLINT_PICTURE_H

struct picture {
    int width, height;
    int channels;          /* 3: red, green, blue; 4: and opacity */
    unsigned char *pixels; /* height x width x channels, top row first, sRGB,
                              colour not multiplied by opacity */
};

/* All return 0 or an exit status, having said what is wrong.  `file` is "-"
 * for standard output. */
int picture_make(struct picture *picture, int width, int height, int channels);
/* Whether a picture could be written, before the work is done. */
int picture_try(const char *file);
/* Beside `file` first, so that it is the old one or the whole new one; what
 * is not a regular file is written to as it is. */
int picture_write(const struct picture *picture, const char *file);

void picture_free(struct picture *picture);

#endif
