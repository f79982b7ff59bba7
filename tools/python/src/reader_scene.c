/*
 * reader_scene.c - reads a file of shapes into an array
 */
#include "scene_read.h"

int cylint_python_read(const char *file, int ends, int round,
                       cylint_shape **shapes, size_t *count);

/* The caller frees *shapes.  Returns 0 or an exit status. */
int cylint_python_read(const char *file, int ends, int round,
                       cylint_shape **shapes, size_t *count)
{
    struct scene scene = {0};
    const int status =
        scene_read(&scene, file, ends, round ? SWC_ROUND : SWC_CONES);
    *shapes = scene.shapes;
    *count = status == 0 ? scene.count : 0;
    return status;
}
