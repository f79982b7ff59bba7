/*
 * greys.c - reads a grey PNG file of 16 bits, for test_render.sh
 *
 *   greys FILE                 its description, then x y grey of all pixels
 *   greys FILE ball FOV MU     compares it with cylint_chord()
 *   greys FILE ball FOV linear LARGEST
 *
 * The ball has the radius 1 and its centre at the origin.  The picture was drawn with
 * --eye 0,0,10 --look-at 0,0,0 --up 0,1,0 --samples 1 and this --fov.
 */
#include <math.h>
#include <png.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cylint_pieces.h"

struct greys {
    int width, height;
    png_bytepp rows;
    const char *description;
};

static int grey(const struct greys *g, int x, int y)
{
    return 256 * g->rows[y][2 * x] + g->rows[y][2 * x + 1];
}

static void print_all(const struct greys *g)
{
    printf("%s\n", g->description);
    for (int y = 0; y < g->height; y++)
        for (int x = 0; x < g->width; x++)
            printf("%d %d %d\n", x, y, grey(g, x, y));
}

/* The length of the ray through the middle of a pixel inside the ball. */
static double length_of_ray(const struct greys *g, double fov, int x, int y)
{
    static const double centre[3] = {0, 0, 0}, eye[3] = {0, 0, 10};
    const double half_height = tan(0.5 * 0.017453292519943295 * fov);
    const double half_width = (double)g->width / g->height * half_height;
    const double d[3] = {(2 * (x + 0.5) / g->width - 1) * half_width,
                         (1 - 2 * (y + 0.5) / g->height) * half_height, -1};
    cylint_shape ball;
    cylint_line ray;
    cylint_interval chord[2];
    cylint_sphere(&ball, centre, 1, CYLINT_ENDS_CAPPED);
    cylint_ray(&ray, eye, d);
    return cylint_chord(&ball, &ray, chord) == 0
               ? 0
               : (chord[0].t1 - chord[0].t0) * cylint_line_length(&ray);
}

/* The textbook's length of the same chord: 2 sqrt(1 - b^2), b the distance of the ray
 * from the centre. */
static double textbook_length(const struct greys *g, double fov, int x, int y)
{
    const double half = tan(0.5 * 0.017453292519943295 * fov);
    const double aside =
        hypot((2 * (x + 0.5) / g->width - 1) * half * g->width / g->height,
              (1 - 2 * (y + 0.5) / g->height) * half);
    const double b = 10 * aside / hypot(aside, 1);
    return b < 1 ? 2 * sqrt(1 - b * b) : 0;
}

/* Returns how many pixels differ. */
static int compare(const struct greys *g, double fov, const char *mu,
                   const char *largest)
{
    int wrong = 0, inside = 0;
    for (int y = 0; y < g->height; y++) {
        for (int x = 0; x < g->width; x++) {
            const double length = length_of_ray(g, fov, x, y);
            const double share =
                largest ? length / atof(largest) : exp(-atof(mu) * length);
            const double error = fabs(length - textbook_length(g, fov, x, y));
            inside += length > 0;
            wrong +=
                grey(g, x, y) != (int)(65535 * share + 0.5) || !(error < 1e-9);
        }
    }
    printf("%d pixels show the ball, %d are wrong\n", inside, wrong);
    return wrong + (inside == 0);
}

int main(int argc, char **argv)
{
    FILE *file = argc > 1 ? fopen(argv[1], "rb") : NULL;
    png_structp png =
        png_create_read_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    png_textp text = NULL;
    if (!file || !info || setjmp(png_jmpbuf(png)))
        return 2;
    png_init_io(png, file);
    png_read_png(png, info, PNG_TRANSFORM_IDENTITY, NULL);
    if (png_get_bit_depth(png, info) != 16 ||
        png_get_color_type(png, info) != PNG_COLOR_TYPE_GRAY)
        return 2;
    const int texts = png_get_text(png, info, &text, NULL);
    const struct greys greys = {(int)png_get_image_width(png, info),
                                (int)png_get_image_height(png, info),
                                png_get_rows(png, info),
                                texts == 1 ? text->text : ""};
    int status = 0;
    if (argc >= 5 && strcmp(argv[2], "ball") == 0) {
        status = compare(&greys, atof(argv[3]), argv[4],
                         argc > 5 ? argv[5] : NULL) > 0;
    } else {
        print_all(&greys);
    }
    png_destroy_read_struct(&png, &info, NULL);
    fclose(file);
    return status;
}
