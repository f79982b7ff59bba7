/*
 * xray.c - a picture of how much of each ray is inside the scene's solids
 *
 * The length of a ray is that of its pieces inside the union of all solids, in the
 * scene's units: places in several solids count once.  The scale is computed after
 * all lengths.
 */
#include <stdio.h>
#include <stdlib.h>

#include "picture.h"
#include "report.h"
#include "scene.h"
#include "view.h"

static const double LN_2 = 0.6931471805599453;

/* The lengths of all pixels, and what they are computed from. */
struct rays {
    const cylint_scene *scene;
    size_t pixels;
    double *lengths;
};

/* Adds the length of a ray inside the union.  Returns 0 if there is no memory. */
static int add_length(const cylint_scene *scene, const cylint_line *ray,
                      cylint_piece_memory *found, double *sum)
{
    const cylint_piece_rule all = {CYLINT_PIECES_UNION, NULL, NULL};
    double t = 0;
    found->n = 0;
    if (!cylint_add_pieces(scene, ray, &all, 0, found))
        return 0;
    for (size_t i = 0; i < found->n; i++)
        t += found->piece[i].t1 - found->piece[i].t0;
    *sum += t > 0 ? t * cylint_line_length(ray) : 0;
    return 1;
}

/* The mean over the samples of each pixel. */
static int measure_row(const struct drawing *d, const void *rays, int y)
{
    const struct rays *r = rays;
    const int width = d->picture->width;
    double *lengths = r->lengths + (size_t)y * (size_t)width;
    cylint_piece_memory found = {.n = 0};
    int has_memory = 1;
    for (int x = 0; x < width && has_memory; x++) {
        double sum = 0;
        for (int i = 0; i < d->samples && has_memory; i++) {
            cylint_line ray;
            view_sample(d, x, y, i, &ray);
            has_memory = add_length(r->scene, &ray, &found, &sum);
        }
        lengths[x] = sum / d->samples;
    }
    free(found.work.memory);
    free(found.piece);
    return has_memory;
}

/* --------------------------------------------------------------- scale -- */

/* lint: out_of_memory() is not 0, so lengths were allocated */
/* The mean of the lengths that are finite and not 0; 0 if there are none. */
static double mean_length(const struct rays *rays)
{
    double mean = 0, n = 0;
    for (size_t p = 0; p < rays->pixels; p++)
        if (rays->lengths[p] > 0 && rays->lengths[p] < HUGE_VAL)
            mean += (rays->lengths[p] - mean) / ++n;
    return mean;
}

/* Writes the pixels, and to the note what they show.  Whatever mu, a length of 0 is
 * white and infinity is black. */
static void write_pixels(struct picture *picture, double mu,
                         const struct rays *rays)
{
    if (mu == 0) {
        const double mean = mean_length(rays);
        mu = mean > 0 ? LN_2 / mean : 1;
    }
    snprintf(picture->note, sizeof picture->note, "65535 exp(-%.17g length)",
             mu);
    for (size_t p = 0; p < rays->pixels; p++) {
        const double length = rays->lengths[p];
        const double share = length > 0 ? exp(-mu * length) : 1;
        const unsigned value = (unsigned)(65535 * share + 0.5);
        picture->pixels[2 * p] = (unsigned char)(value >> 8);
        picture->pixels[2 * p + 1] = (unsigned char)(value & 0xff);
    }
}

int xray_picture(const struct drawing *d, double mu, const cylint_scene *scene)
{
    const size_t pixels =
        (size_t)d->picture->width * (size_t)d->picture->height;
    const struct rays rays = {scene, pixels,
                              calloc(pixels, sizeof *rays.lengths)};
    const int status =
        rays.lengths ? draw_rows(d, measure_row, &rays) : out_of_memory();
    if (status == 0)
        write_pixels(d->picture, mu, &rays);
    free(rays.lengths);
    return status;
}
