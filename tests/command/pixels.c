/*
 * pixels.c - prints the pixels of a PNG file, for test_render.sh
 *
 *   pixels FILE X Y   red green blue opacity of one pixel
 *   pixels FILE       x y red green blue opacity of all, a line each
 *
 * Of a file of 16 bits, an X-ray, it prints one number, the grey.
 */
#include <png.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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

int main(int argc, char **argv)
{
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
