/*
 * picture.c - computes rows of pixels on several threads, and writes them to a PNG
 * file
 */
#include <png.h>
#include <pthread.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "../../src/bvh/threads.h"
#include "picture.h"
#include "report.h"

static size_t row_bytes(const struct picture *p)
{
    return (size_t)p->width * (p->channels == 1 ? 2 : (size_t)p->channels);
}

int picture_make(struct picture *picture, int width, int height, int channels)
{
    *picture = (struct picture){width, height, channels, NULL, ""};
    const size_t row = row_bytes(picture);
    if (row <= SIZE_MAX / (size_t)height)
        picture->pixels = malloc(row * (size_t)height);
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
    if (w->status != 0)
        png_error(png, "write");
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

static void describe(png_structp png, png_infop info, const struct picture *p)
{
    static char key[] = "Description";
    char note[sizeof p->note];
    png_text text = {0};
    memcpy(note, p->note, sizeof note);
    text.compression = PNG_TEXT_COMPRESSION_NONE;
    text.key = key;
    text.text = note;
    if (*note)
        png_set_text(png, info, &text, 1);
}

static int colour_type(const struct picture *p)
{
    return p->channels == 1   ? PNG_COLOR_TYPE_GRAY
           : p->channels == 3 ? PNG_COLOR_TYPE_RGB
                              : PNG_COLOR_TYPE_RGB_ALPHA;
}

/* Returns 0 if libpng failed. */
static int encode(png_structp png, png_infop info, const struct picture *p)
{
    const size_t row = row_bytes(p);
    if (setjmp(png_jmpbuf(png)))
        return 0;
    png_set_IHDR(png, info, (png_uint_32)p->width, (png_uint_32)p->height,
                 p->channels == 1 ? 16 : 8, colour_type(p), PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (p->channels > 1)
        png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    describe(png, info, p);
    png_write_info(png, info);
    for (int y = 0; y < p->height; y++)
        png_write_row(png, p->pixels + (size_t)y * row);
    png_write_end(png, info);
    return 1;
}

int picture_write(const struct picture *p, struct output *out)
{
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL,
                                              jump_back, keep_silent);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    struct writer writer = {out, 0};
    if (info)
        png_set_write_fn(png, &writer, write_bytes, flush_bytes);
    if (!info || (!encode(png, info, p) && writer.status == 0))
        writer.status = out_of_memory(); /* libpng's only other error */
    png_destroy_write_struct(&png, &info);
    return writer.status;
}

/* ---------------------------------------------------------------- rows -- */

struct work {
    const struct drawing *drawing;
    row_function *draw;
    const void *how;

    pthread_mutex_t lock; /* protects the members below */
    int has_failed;
    size_t rows_done;
    struct progress progress;
};

static void draw_some(void *work, size_t from, size_t to)
{
    struct work *w = work;
    int has_memory = 1;
    for (size_t y = from; y < to && has_memory; y++)
        has_memory = w->draw(w->drawing, w->how, (int)y);
    pthread_mutex_lock(&w->lock);
    w->has_failed |= !has_memory;
    w->rows_done += to - from;
    progress_add(&w->progress, to - from, (double)w->rows_done,
                 w->drawing->picture->height);
    pthread_mutex_unlock(&w->lock);
}

int draw_rows(const struct drawing *d, row_function *draw, const void *how)
{
    struct work w = {.drawing = d,
                     .draw = draw,
                     .how = how,
                     .lock = PTHREAD_MUTEX_INITIALIZER};
    progress_start(&w.progress, 0, -1, "rows", 0);
    cylint_threads_share(d->workers, (size_t)d->picture->height, 1, 1,
                         draw_some, &w);
    progress_end(&w.progress);
    return w.has_failed ? out_of_memory() : 0;
}
