/*
 * pixels.c - prints the pixels of a PNG file, for test_render.sh
 *
 *   pixels FILE X Y   red green blue opacity of one pixel
 *   pixels FILE       x y red green blue opacity of all, a line each
 *   pixels FILE save  saves a scene whose first shape was refused: no text has one
 *
 * Of a file of 16 bits, an X-ray, it prints one number, the grey.
 */
#include <png.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cylint_scene.h"

static void print_pixel(const png_image *image, const void *pixels, unsigned x,
                        unsigned y)
{
    const size_t at = (size_t)y * image->width + x;
    const png_uint_16 *grey = pixels;
    const png_byte *p = (const png_byte *)pixels + 4 * at;
    if (image->format == PNG_FORMAT_LINEAR_Y)
        printf("%d\n", grey[at]);
    else
        printf("%d %d %d %d\n", p[0], p[1], p[2], p[3]);
}

static int save_refused(const char *file)
{
    static const double p[2][2][3] = {{{0, 0, 0}, {0, 0, 2}},
                                      {{2, 0, 0}, {2, 0, 2}}};
    cylint_shape shape[3];
    cylint_cylinder(&shape[0], p[0][0], p[0][0], 1, CYLINT_ENDS_CAPPED);
    for (int i = 0; i < 2; i++)
        cylint_cylinder(&shape[1 + i], p[i][0], p[i][1], 0.5,
                        CYLINT_ENDS_CAPPED);
    cylint_scene *scene = cylint_scene_new(shape, 3, 1, NULL);
    const int saved =
        scene && cylint_scene_save(scene, file) == CYLINT_SCENE_OK;
    cylint_scene_free(scene);
    return saved ? 0 : 2;
}

int main(int argc, char **argv)
{
    if (argc == 3)
        return save_refused(argv[1]);
    png_image image;
    memset(&image, 0, sizeof image);
    image.version = PNG_IMAGE_VERSION;
    if ((argc != 2 && argc != 4) ||
        !png_image_begin_read_from_file(&image, argv[1]))
        return 2;
    image.format = image.format & PNG_FORMAT_FLAG_LINEAR ? PNG_FORMAT_LINEAR_Y
                                                         : PNG_FORMAT_RGBA;
    void *pixels = malloc(PNG_IMAGE_SIZE(image));
    if (!pixels || !png_image_finish_read(&image, NULL, pixels, 0, NULL))
        return 2;
    if (argc == 4) {
        print_pixel(&image, pixels, (unsigned)atoi(argv[2]),
                    (unsigned)atoi(argv[3]));
    } else {
        for (unsigned y = 0; y < image.height; y++) {
            for (unsigned x = 0; x < image.width; x++) {
                printf("%u %u ", x, y);
                print_pixel(&image, pixels, x, y);
            }
        }
    }
    free(pixels);
    return 0;
}
