/*
 * picture.c - writes rows of pixels to a PNG file
 */
#include <png.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "picture.h"
#include "report.h"

int picture_make(struct picture *picture, int width, int height, int channels)
{
    const size_t row = (size_t)width * (size_t)channels;
    *picture = (struct picture){width, height, channels, NULL};
    if (row <= SIZE_MAX / (size_t)height) {
        picture->pixels = malloc(row * (size_t)height);
    }
    return picture->pixels ? 0 : out_of_memory();
}

void picture_free(struct picture *picture)
{
    free(picture->pixels);
    picture->pixels = NULL;
}

/* libpng returns no errors: it jumps. */
struct writer {
    struct output *out;
    int status;
};

static void write_bytes(png_structp png, png_bytep bytes, size_t n)
{
    struct writer *w = png_get_io_ptr(png);
    w->status = output_write(w->out, (const char *)bytes, n);
    if (w->status != 0) {
        png_error(png, "write");
    }
}

static void flush_bytes(png_structp png)
{
    (void)png; /* nothing is buffered */
}

/* The fault has its message already. */
static void jump_back(png_structp png, png_const_charp what)
{
    (void)what;
    png_longjmp(png, 1);
}

static void keep_silent(png_structp png, png_const_charp what)
{
    (void)png;
    (void)what;
}

/* Returns 0 if libpng failed. */
static int encode(png_structp png, png_infop info, const struct picture *p)
{
    const size_t row = (size_t)p->width * (size_t)p->channels;
    if (setjmp(png_jmpbuf(png))) {
        return 0;
    }
    png_set_IHDR(png, info, (png_uint_32)p->width, (png_uint_32)p->height, 8,
                 p->channels == 4 ? PNG_COLOR_TYPE_RGB_ALPHA
                                  : PNG_COLOR_TYPE_RGB,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    png_write_info(png, info);
    for (int y = 0; y < p->height; y++) {
        png_write_row(png, p->pixels + (size_t)y * row);
    }
    png_write_end(png, info);
    return 1;
}

int picture_open(struct output *out, const char *file)
{
    out->row = 1;
    out->array = -1;
    return target_open(&out->target, strcmp(file, "-") == 0 ? NULL : file);
}

int picture_write(const struct picture *p, struct output *out)
{
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL,
                                              jump_back, keep_silent);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    struct writer writer = {out, 0};
    if (info) {
        png_set_write_fn(png, &writer, write_bytes, flush_bytes);
    }
    if (!info || (!encode(png, info, p) && writer.status == 0)) {
        writer.status = out_of_memory(); /* libpng's only other error */
    }
    png_destroy_write_struct(&png, &info);
    return writer.status;
}
