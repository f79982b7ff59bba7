/*
 * xray.c - a picture of how much of each ray is inside the scene's solids
 *
 * The rays of some pixels at a time go to cylint_scene_sums(), which shares them
 * among threads.  The scale is computed after all lengths.
 */
#include <stdio.h>
#include <stdlib.h>

#include "report.h"
#include "xray.h"

static const double LN_2 = 0.6931471805599453;

enum { RAYS_AT_ONCE = 1 << 16 /* no pixel has more samples */ };

struct ray_block {
    double o[3][RAYS_AT_ONCE], d[3][RAYS_AT_ONCE];
    double sums[RAYS_AT_ONCE];
};

/* The lengths of all pixels, and what they are computed from. */
struct rays {
    const struct drawing *drawing;
    const cylint_scene *scene;
    struct ray_block *block;
    size_t pixels;
    double *lengths;
};

/* ------------------------------------------------------------- lengths -- */

/* The rays of `count` pixels from pixel `first` on, in the order of rows. */
static size_t fill_block(const struct rays *rays, size_t first, size_t count)
{
    const struct drawing *d = rays->drawing;
    const struct picture *picture = d->picture;
    const size_t width = (size_t)picture->width;
    struct ray_block *b = rays->block;
    size_t n = 0;
    for (size_t p = first; p < first + count; p++) {
        for (int i = 0; i < d->samples; i++, n++) {
            cylint_line ray;
            view_sample(d->view, picture->width, picture->height,
                        (int)(p % width), (int)(p / width), i, d->samples,
                        &ray);
            for (int k = 0; k < 3; k++) {
                b->o[k][n] = ray.o[k];
                b->d[k][n] = ray.d[k];
            }
        }
    }
    return n;
}

static void take_means(const struct rays *rays, size_t first, size_t count)
{
    const double *sum = rays->block->sums;
    const int samples = rays->drawing->samples;
    for (size_t p = first; p < first + count; p++) {
        double all = 0;
        for (int i = 0; i < samples; i++)
            all += *sum++;
        rays->lengths[p] = all / samples;
    }
}

static int measure_block(const struct rays *rays, size_t first, size_t count)
{
    const cylint_piece_rule all = {CYLINT_PIECES_UNION, NULL, NULL};
    const struct ray_block *b = rays->block;
    const cylint_lines lines = {fill_block(rays, first, count),
                                {b->o[0], b->o[1], b->o[2]},
                                {b->d[0], b->d[1], b->d[2]},
                                NULL,
                                NULL};
    if (cylint_scene_sums(rays->scene, &lines, &all, NULL, 1, 1,
                          rays->drawing->workers,
                          rays->block->sums) != CYLINT_SCENE_OK)
        return out_of_memory();
    take_means(rays, first, count);
    return 0;
}

static int measure_rays(const struct rays *rays)
{
    const size_t most = RAYS_AT_ONCE / (size_t)rays->drawing->samples;
    const size_t pixels = rays->pixels;
    struct progress shown;
    int status = 0;
    progress_start(&shown, rays->drawing->shows_progress, -1, "pixels", 0);
    for (size_t done = 0, n; status == 0 && done < pixels; done += n) {
        n = pixels - done < most ? pixels - done : most;
        status = measure_block(rays, done, n);
        progress_add(&shown, n, (double)(done + n), (double)pixels);
    }
    progress_end(&shown);
    return status;
}

/* --------------------------------------------------------------- scale -- */

/* Over the lengths that are finite and not 0; both 0 if there are none. */
struct summary {
    double mean, largest;
};

/* lint: out_of_memory() is not 0, so lengths were allocated */
static struct summary summary_of(const struct rays *rays)
{
    const double *lengths = rays->lengths;
    struct summary s = {0, 0};
    double sum = 0, n = 0;
    for (size_t p = 0; p < rays->pixels; p++)
        if (lengths[p] > s.largest && lengths[p] < HUGE_VAL)
            s.largest = lengths[p];
    for (size_t p = 0; p < rays->pixels; p++) {
        if (lengths[p] > 0 && lengths[p] < HUGE_VAL) {
            sum += lengths[p] / s.largest;
            n++;
        }
    }
    s.mean = n > 0 ? s.largest * (sum / n) : 0;
    return s;
}

/* The lengths 0 and infinity do not depend on the scale, which may then be 0. */
static double brightness(const struct xray *how, double largest, double length)
{
    if (how->scale == XRAY_LINEAR)
        return length > 0 ? fmin(length / largest, 1) : 0;
    return length > 0 ? exp(-how->mu * length) : 1;
}

/* Writes the pixels, and to the note what they show. */
static void write_pixels(struct picture *picture, const struct xray *how,
                         const struct rays *rays)
{
    const struct summary s = summary_of(rays);
    struct xray used = *how;
    if (how->scale == XRAY_LINEAR) {
        snprintf(picture->note, sizeof picture->note, "65535 length / %.17g",
                 s.largest);
    } else {
        if (how->scale == XRAY_AUTO)
            used.mu = s.mean > 0 ? LN_2 / s.mean : 1;
        snprintf(picture->note, sizeof picture->note,
                 "65535 exp(-%.17g length)", used.mu);
    }
    for (size_t p = 0; p < rays->pixels; p++) {
        const double share = brightness(&used, s.largest, rays->lengths[p]);
        const unsigned value = (unsigned)(65535 * share + 0.5);
        picture->pixels[2 * p] = (unsigned char)(value >> 8);
        picture->pixels[2 * p + 1] = (unsigned char)(value & 0xff);
    }
}

int xray_picture(const struct drawing *d, const struct xray *how,
                 const cylint_scene *scene)
{
    const size_t pixels =
        (size_t)d->picture->width * (size_t)d->picture->height;
    const struct rays rays = {d, scene, malloc(sizeof *rays.block), pixels,
                              calloc(pixels, sizeof *rays.lengths)};
    const int status =
        rays.block && rays.lengths ? measure_rays(&rays) : out_of_memory();
    if (status == 0)
        write_pixels(d->picture, how, &rays);
    if (status == 0 && d->shows_progress)
        fprintf(stderr, "%s: a pixel is %s\n", program, d->picture->note);
    free(rays.block);
    free(rays.lengths);
    return status;
}
