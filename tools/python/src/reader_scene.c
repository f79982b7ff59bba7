/*
 * reader_scene.c - reads a file of shapes and their labels
 */
#include "reader_scene.h"

#include "labels.h"

int cylint_python_read(const char *file, int ends, int round,
                       cylint_python_scene *read)
{
    struct scene scene = {0};
    struct labels labels = {0};
    labels_collect(&labels, &scene);
    const int status =
        scene_read(&scene, file, ends, round ? SWC_ROUND : SWC_CONES);
    cylint_member *members = NULL;
    size_t n = 0;
    if (status != 0) {
        scene_free(&scene);
    } else {
        solids_complete(&scene.solids);
        members = scene.solids.member;
        n = scene.solids.count;
        scene.solids.member = NULL; /* the caller's now */
        solids_free(&scene.solids);
    }
    *read = (cylint_python_scene){.shapes = scene.shapes,
                                  .members = members,
                                  .n_members = n,
                                  .count = status == 0 ? scene.count : 0,
                                  .label_bytes = labels.texts.bytes,
                                  .label_end = labels.texts.end};
    return status;
}
