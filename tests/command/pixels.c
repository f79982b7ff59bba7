/*
 * pixels.c - prints the pixels of a PNG file, for test_render.sh
 *
 *   pixels FILE X Y   red green blue opacity of one pixel
 *   pixels FILE       x y red green blue opacity of all, a line each
 */
#include <png.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void print_pixel(const png_image *image, const png_byte *pixels,
                        unsigned x, unsigned y)
{
    const png_byte *p = pixels + 4 * ((size_t)y * image->width + x);
    printf("%d %d %d %d\n", p[0], p[1], p[2], p[3]);
}

int main(int argc, char **argv)
{
    png_image image;
    memset(&image, 0, sizeof image);
    image.version = PNG_IMAGE_VERSION;
    if ((argc != 2 && argc != 4) ||
        !png_image_begin_read_from_file(&image, argv[1]))
        return 2;
    image.format = PNG_FORMAT_RGBA;
    png_byte *pixels = malloc(PNG_IMAGE_SIZE(image));
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
