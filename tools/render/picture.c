/*
 * picture.c - writes rows of pixels to a PNG file, whole or not at all
 */
#include <errno.h>
#include <fcntl.h>
#include <png.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "main.h"
#include "output.h"
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

/* --------------------------------------------------------- the target -- */

/* A file in progress.  `part` is its name until it is complete. */
struct target {
    const char *name;
    char *part; /* NULL: written in place */
    FILE *file;
};

static int failed(const struct target *t)
{
    complain_errno(t->name);
    return EXIT_IO;
}

/* Only an existing file can be other than a regular file. */
static int is_regular(const char *name)
{
    struct stat s;
    return stat(name, &s) != 0 || S_ISREG(s.st_mode);
}

static int name_part(struct target *t)
{
    const size_t capacity = strlen(t->name) + 40;
    t->part = malloc(capacity);
    if (!t->part) {
        return out_of_memory();
    }
    snprintf(t->part, capacity, "%s.%ld.part", t->name, (long)getpid());
    return 0;
}

static int target_open(struct target *t, const char *name)
{
    const int standard = strcmp(name, "-") == 0;
    *t = (struct target){standard ? "standard output" : name, NULL, NULL};
    if (standard) {
        t->file = stdout;
        return 0;
    }
    int flags = O_WRONLY;
    if (is_regular(name)) {
        flags |= O_CREAT | O_EXCL;
        if (name_part(t) != 0) {
            return EXIT_MEMORY;
        }
    }
    const int fd = open_file(t->part ? t->part : name, flags);
    t->file = fd >= 0 ? fdopen(fd, "wb") : NULL;
    if (!t->file) {
        const int status = failed(t);
        free(t->part);
        return status;
    }
    return 0;
}

/* Renames the complete file, or removes an incomplete one. */
static int target_close(struct target *t, int status)
{
    if (status == 0 && fflush(t->file) != 0) {
        status = failed(t);
    }
    if (fclose(t->file) != 0 && status == 0) {
        status = failed(t);
    }
    if (t->part && status == 0 && rename(t->part, t->name) != 0) {
        status = failed(t);
    }
    if (t->part && status != 0) {
        unlink(t->part);
    }
    free(t->part);
    return status;
}

int picture_try(const char *file)
{
    struct target t;
    if (strcmp(file, "-") == 0 || !is_regular(file)) {
        return 0;
    }
    const int status = target_open(&t, file);
    if (status == 0) {
        fclose(t.file);
    }
    if (status == 0 && t.part) {
        unlink(t.part);
        free(t.part);
    }
    return status;
}

/* ------------------------------------------------------------ the file -- */

static int last_errno; /* of a failed write: libpng only jumps */

static void write_bytes(png_structp png, png_bytep bytes, size_t n)
{
    if (fwrite(bytes, 1, n, png_get_io_ptr(png)) != n) {
        last_errno = errno;
        png_error(png, "write");
    }
}

static void flush_bytes(png_structp png)
{
    (void)png; /* when the file is closed */
}

/* The caller reports the error from errno. */
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

static int write_png(const struct picture *p, struct target *t)
{
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL,
                                              jump_back, keep_silent);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    int status = 0;
    last_errno = 0;
    if (info) {
        png_set_write_fn(png, t->file, write_bytes, flush_bytes);
    }
    if (!info || (!encode(png, info, p) && last_errno == 0)) {
        status = out_of_memory(); /* libpng's only other error */
    } else if (last_errno != 0) {
        errno = last_errno;
        status = failed(t);
    }
    png_destroy_write_struct(&png, &info);
    return status;
}

int picture_write(const struct picture *picture, const char *file)
{
    struct target t;
    const int status = target_open(&t, file);
    return status != 0 ? status : target_close(&t, write_png(picture, &t));
}
