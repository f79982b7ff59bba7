/*
 * picture.h - writes rows of pixels to a PNG file, whole or not at all
 */
#ifndef CYLINT_PICTURE_H
#define CYLINT_PICTURE_H

struct picture {
    int width, height;
    int channels;          /* 3: red, green, blue; 4: and opacity */
    unsigned char *pixels; /* height x width x channels, top row first, sRGB,
                              colour not multiplied by opacity */
};

/* All return 0, or report the fault and return an exit status.  `file` is "-" for
 * standard output. */
int picture_make(struct picture *picture, int width, int height, int channels);
/* Whether the file can be written; called before the work. */
int picture_try(const char *file);
/* Writes a new file beside `file` and renames it, so that `file` is the old one or
 * the complete new one.  A file that is not regular is written in place. */
int picture_write(const struct picture *picture, const char *file);

void picture_free(struct picture *picture);

#endif
